"""Joints: conductance and partial slip."""
