"""Choosing loads: the range that a grid resolves, the search for it, and the outlook of given loads."""
