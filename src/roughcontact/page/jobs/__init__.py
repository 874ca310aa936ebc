"""The computations of a worker of the page."""
