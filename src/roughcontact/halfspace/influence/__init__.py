"""Influence functions: the displacement of the surface under a uniform pressure on one cell, in closed form."""
