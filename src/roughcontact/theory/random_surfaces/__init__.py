"""What is known of random surfaces: waves, summits, moments."""
