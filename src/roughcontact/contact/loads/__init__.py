"""Choosing loads: the range that a grid resolves, the search for it, and what loads that are named will give."""
