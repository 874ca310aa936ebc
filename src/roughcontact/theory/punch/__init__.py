"""Flat punches: the contact stiffness of a region of given shape, and pressures where they are known."""

from __future__ import annotations

from roughcontact.theory.punch.annulus import annulus
from roughcontact.theory.punch.closed import (
    disc,
    disc_displacement,
    disc_pressure,
    ellipse,
    ellipse_pressure,
    strip,
    strip_pressure,
)
from roughcontact.theory.punch.polygon import SQUARE, TRIANGLE, Computed, shape_factor, square, triangle
from roughcontact.theory.punch.two_discs import two_discs

__all__ = [
    "SQUARE",
    "TRIANGLE",
    "Computed",
    "annulus",
    "disc",
    "disc_displacement",
    "disc_pressure",
    "ellipse",
    "ellipse_pressure",
    "shape_factor",
    "square",
    "strip",
    "strip_pressure",
    "triangle",
    "two_discs",
]
