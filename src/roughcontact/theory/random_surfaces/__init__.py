"""Random surfaces: waves, summits, moments."""
