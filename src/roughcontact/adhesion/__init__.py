"""Surfaces that attract each other: the law of attraction, equilibria, their stability, jumps, and loops."""
