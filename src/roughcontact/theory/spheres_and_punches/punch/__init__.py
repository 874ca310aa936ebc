"""Flat punches: the contact stiffness of a region of given shape, and pressures in closed form."""

from types import ModuleType as _Module

from roughcontact.theory.spheres_and_punches.punch.annulus import annulus as annulus
from roughcontact.theory.spheres_and_punches.punch.closed import (
    disc as disc,
    disc_displacement as disc_displacement,
    disc_pressure as disc_pressure,
    ellipse as ellipse,
    ellipse_pressure as ellipse_pressure,
    strip as strip,
    strip_pressure as strip_pressure,
)
from roughcontact.theory.spheres_and_punches.punch.polygon import (
    SQUARE as SQUARE,
    TRIANGLE as TRIANGLE,
    Computed as Computed,
    shape_factor as shape_factor,
    square as square,
    triangle as triangle,
)
from roughcontact.theory.spheres_and_punches.punch.two_discs import two_discs as two_discs

__all__ = [
    name for name, each in globals().items() if not (name.startswith("_") or isinstance(each, _Module))
]
