"""Elastic contact of rough surfaces: certified pressure, area, stiffness and depth against load."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

# The public names and the rooms they live in; a room is opened when its name is first asked for.
_ROOMS = {
    "Grid": "grid",
    "Solid": "material",
    "reduced_modulus": "material",
    "reduced_shear_modulus": "material",
    "Surface": "surface.surface",
    "self_affine": "surface.fourier",
    "SelfAffineSpectrum": "surface.spectrum",
    "half_space": "halfspace.build",
    "Force": "contact.problem",
    "Depth": "contact.problem",
    "ContactProblem": "contact.problem",
    "Solution": "contact.solution",
    "Status": "contact.status",
    "ConvergenceError": "contact.status",
    "ActiveSet": "contact.active_set",
    "PolonskyKeer": "contact.polonsky_keer",
    "press": "contact.press",
    "contact_stiffness": "contact.stiffness",
    "prescribed_displacement": "contact.prescribed",
    "loading_path": "contact.loading",
    "loading_curve": "contact.loading",
    "Curve": "contact.curve",
    "PowerLaw": "contact.curve",
    "read": "files.read",
    "ReadError": "files.errors",
}

__all__ = ["__version__", *_ROOMS]

if TYPE_CHECKING:
    from roughcontact.contact.active_set import ActiveSet as ActiveSet
    from roughcontact.contact.curve import Curve as Curve
    from roughcontact.contact.curve import PowerLaw as PowerLaw
    from roughcontact.contact.loading import loading_curve as loading_curve
    from roughcontact.contact.loading import loading_path as loading_path
    from roughcontact.contact.polonsky_keer import PolonskyKeer as PolonskyKeer
    from roughcontact.contact.prescribed import prescribed_displacement as prescribed_displacement
    from roughcontact.contact.press import press as press
    from roughcontact.contact.problem import ContactProblem as ContactProblem
    from roughcontact.contact.problem import Depth as Depth
    from roughcontact.contact.problem import Force as Force
    from roughcontact.contact.solution import Solution as Solution
    from roughcontact.contact.status import ConvergenceError as ConvergenceError
    from roughcontact.contact.status import Status as Status
    from roughcontact.contact.stiffness import contact_stiffness as contact_stiffness
    from roughcontact.files.errors import ReadError as ReadError
    from roughcontact.files.read import read as read
    from roughcontact.grid import Grid as Grid
    from roughcontact.halfspace.build import half_space as half_space
    from roughcontact.material import Solid as Solid
    from roughcontact.material import reduced_modulus as reduced_modulus
    from roughcontact.material import reduced_shear_modulus as reduced_shear_modulus
    from roughcontact.surface.fourier import self_affine as self_affine
    from roughcontact.surface.spectrum import SelfAffineSpectrum as SelfAffineSpectrum
    from roughcontact.surface.surface import Surface as Surface


def __getattr__(name: str) -> Any:
    if name not in _ROOMS:
        raise AttributeError(f"module 'roughcontact' has no attribute {name!r}")
    value = getattr(import_module(f"roughcontact.{_ROOMS[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
