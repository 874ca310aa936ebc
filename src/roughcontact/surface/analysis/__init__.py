"""What a surface is like: spectra, correlation, Hurst exponent, summits."""
