"""Operators from pressure to displacement, of half-spaces, layers, lines, rings and springs; stress below."""
