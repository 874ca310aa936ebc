"""Stress and displacement below the surface."""
