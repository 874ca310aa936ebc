"""Bodies of revolution that attract what they touch."""
