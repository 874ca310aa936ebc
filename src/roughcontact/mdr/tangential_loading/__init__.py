"""Tangential loading of bodies of revolution."""
