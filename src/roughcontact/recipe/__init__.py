"""A job as one value: the surface, the bodies, the loads, and the results to compute."""
