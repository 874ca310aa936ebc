"""Generated surfaces: random ones from spectra, smooth shapes, punches, examples."""
