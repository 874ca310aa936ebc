"""Parts of a curve that add columns to it."""
