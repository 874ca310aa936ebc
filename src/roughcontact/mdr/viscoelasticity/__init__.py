"""Viscoelastic bodies and foundations."""
