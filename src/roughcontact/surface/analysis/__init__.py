"""Analysis of surfaces: spectra, correlation, Hurst exponent, summits."""
