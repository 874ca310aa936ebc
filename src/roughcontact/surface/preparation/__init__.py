"""Preparation of a measured surface for analysis or contact."""
