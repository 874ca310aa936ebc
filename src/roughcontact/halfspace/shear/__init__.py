"""Tangential traction: influence functions, operators and sums."""
