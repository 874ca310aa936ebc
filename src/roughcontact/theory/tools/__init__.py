"""What several theories compute with: checked numbers, roots, quadrature, inverses."""
