"""Surfaces: heights measured or made, their preparation, spectra and parameters."""
