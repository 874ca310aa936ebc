"""Fast sums over the cells of a half-space."""
