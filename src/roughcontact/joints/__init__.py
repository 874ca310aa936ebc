"""Joints under shear, per nominal area and as a whole."""
