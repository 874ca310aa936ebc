"""Power laws of curves, and statistics of ensembles."""
