"""The contact: inequality, solvers, stiffness, curves."""
