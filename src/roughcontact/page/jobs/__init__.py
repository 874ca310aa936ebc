"""What a worker computes for the page."""
