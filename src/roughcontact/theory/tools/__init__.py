"""Numerical tools for several theories: checked numbers, roots, quadrature, inverses."""
