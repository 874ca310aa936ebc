"""Measurements of a surface: many maps and their combined spectrum, and topography from the stiffness of a joint."""
