"""Persson's theory: area, pressure, separation and stiffness as functions of the magnification."""
