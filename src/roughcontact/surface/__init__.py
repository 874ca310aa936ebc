"""Surfaces: measured or generated heights, their preparation, spectra and parameters."""
