"""Surfaces that are made: random ones by spectra, smooth shapes, punches, examples."""
