"""Bodies of revolution and their transforms."""
