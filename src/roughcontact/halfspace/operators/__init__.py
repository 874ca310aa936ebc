"""Operators: the linear maps from pressure to displacement."""
