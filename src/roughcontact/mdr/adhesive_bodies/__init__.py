"""Adhesive contact of bodies of revolution."""
