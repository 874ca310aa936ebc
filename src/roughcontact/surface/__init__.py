"""Surfaces: heights, generation, preparation."""
