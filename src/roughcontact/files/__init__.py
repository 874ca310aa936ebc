"""Files: measured surfaces in, results out."""
