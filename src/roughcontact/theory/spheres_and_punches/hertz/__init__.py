"""Smooth bodies: Hertz' contact of a paraboloid, a cylinder and an elliptic paraboloid with a half-space."""

from __future__ import annotations

from roughcontact.theory.spheres_and_punches.hertz.elliptic import EllipticContact, elliptic
from roughcontact.theory.spheres_and_punches.hertz.line import LineContact, line
from roughcontact.theory.spheres_and_punches.hertz.point import PointContact, law, point

__all__ = ["EllipticContact", "LineContact", "PointContact", "elliptic", "law", "line", "point"]
