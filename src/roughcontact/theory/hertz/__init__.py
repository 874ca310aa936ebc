"""Smooth bodies: Hertz' contact of a paraboloid, a cylinder and an elliptic paraboloid with a half-space."""

from __future__ import annotations

from roughcontact.theory.hertz.elliptic import EllipticContact, elliptic
from roughcontact.theory.hertz.line import LineContact, line
from roughcontact.theory.hertz.point import PointContact, law, point

__all__ = ["EllipticContact", "LineContact", "PointContact", "elliptic", "law", "line", "point"]
