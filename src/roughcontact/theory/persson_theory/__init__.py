"""Persson's theory: area, pressure, separation and stiffness as roughness is added wave by wave."""
