"""Adhesion: the law of attraction, equilibria, their stability, jumps, loops, and detachment."""
