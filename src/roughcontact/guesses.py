"""Suggestions for a name that a module or a value does not have, at the end of the AttributeError."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import FrozenInstanceError
from types import MappingProxyType
from typing import Any, NoReturn, TypeVar

__all__ = ["MEANT", "WITHOUT", "did_you_mean", "hinted"]

T = TypeVar("T")

_CURVE = {
    "rc.write(curve, 'curve.nc') or to_csv('curve.csv')": "save to_netcdf",
    "to_dataset()": "to_xarray",
    "contact_area": "area",
    "depth": "displacement",
    "mean_gap": "gap",
}
_TABLE = {"to_dataset().to_dataframe()": "to_dataframe to_pandas"}
_STATE = {
    "to_record() or to_dataset()": "to_dataframe to_pandas to_xarray",
    "rc.write(solution, 'state.nc')": "save to_netcdf",
    "contact_area": "area",
    "problem.modulus": "modulus",
    "problem.surface": "surface",
}
_BUDGET = {
    f"rc.error_budget(solution)[{name!r}]": name
    for name in ("corrected_contact_area", "corrected_contact_fraction")
}
_SOLID = {"young_modulus": "e young", "shear_modulus": "g", "poisson_ratio": "nu poisson"}
_BRANCHES = ("force", "depth", "stiffness", "contact_area", "mean_gap", "nominal_pressure")
_DERIVATIVES = "sensitivity sensitivities derivative derivatives gradient gradients"
_GUESSED = {
    "roughcontact": _BUDGET
    | {
        "rc.sensitivity": "derivative derivatives gradient",
        "rc.read": "load open",
        "rc.write": "save to_csv",
        "rc.press": "solve",
        "rc.loading_curve": "curve",
        "rc.loading_loop": "loop",
        "rc.power_spectrum": "psd",
    },
    "Surface": {
        "heights": "data values z",
        "rms": "sq std",
        "grid.periodic": "periodic",
        "grid.spacing": "spacing",
        "grid.lengths": "lengths extent",
        "grid.lengths or grid.size": "size",
        "cropped": "crop",
        "levelled": "level detrend",
        "rc.write(surface, 'part.npz')": "save",
        "to_dataset()": "to_xarray",
    },
    "Solution": _STATE | _BUDGET | {"rc.sensitivity(solution)": _DERIVATIVES},
    **dict.fromkeys(("AdhesiveState", "DetachmentState"), _STATE),
    "Curve": _CURVE
    | {"rc.sensitivity(solution) of each solution of rc.loading_path": _DERIVATIVES}
    | {"nominal_pressure": "pressure", "fit().exponent": "exponent", "to_dataframe()": "to_pandas"},
    **dict.fromkeys(("AdhesiveCurve", "DetachmentCurve"), _CURVE | _TABLE),
    "Loop": _TABLE | {f"loading.{name} or unloading.{name}": name for name in _BRANCHES},
    "Solid": _SOLID,
    "Material": {f"solid.{meant}": f"{meant} {names}" for meant, names in _SOLID.items()},
}
MEANT: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        owner: {name: meant for meant, names in table.items() for name in names.split()}
        for owner, table in _GUESSED.items()
    }
)
"""Names that users guess, in lower case, by the class or module; misspelt names are found by similarity."""

_STEPS = "on a grid {} changes in steps, so it has no derivative"
_AREA = (
    f"{_STEPS}; no other number stands for it exactly: for its trend, fit rc.loading_curve over loads that change many "
    "cells"
)
_STEPPING = {
    _AREA.format("the contact area"): "area contact_area contact_fraction",
    _AREA.format("the number of spots"): "spots spot_count",
    f"{_STEPS.format('the stiffness')}: use secant_stiffness": "stiffness interfacial_stiffness",
}
WITHOUT: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        "Sensitivity": {
            f"{name}{held}": reason
            for reason, names in _STEPPING.items()
            for name in names.split()
            for held in ("", "_at_force", "_at_depth")
        }
    }
)
"""Why a class does not have a name that users guess, and what to do."""


def did_you_mean(owner: str, name: str, known: Iterable[str]) -> str:
    """Return the end of a message about a `name` that an `owner` does not have; empty if no name is similar.

    Parameters
    ----------
    owner : str
        Name of the module or class.
    name : str
        Name that was looked up.
    known : iterable of str
        Names that the owner has.
    """
    if reason := WITHOUT.get(owner, {}).get(name):
        return f": {reason}"
    meant = MEANT.get(owner, {}).get(name.casefold())
    if meant is None:
        from difflib import get_close_matches  # late: it takes as long to import as all of a package's names

        meant = " or ".join(get_close_matches(name, known))
    return f"; did you mean {meant}?" if meant else ""


def hinted(cls: type[T]) -> type[T]:
    """Give a frozen class errors with a suggestion, for a missing attribute and for an attempt to set one.

    Both are AttributeErrors. Python calls neither of the two methods for a name that is found.
    """
    for name, method in (("__getattr__", _lookup), ("__setattr__", _refuse)):
        setattr(cls, name, method)
    return cls


def _lookup(value: Any, name: str) -> Any:
    """Raise the AttributeError about a name that was not found."""
    kind = type(value)
    if name.startswith("_") or hasattr(kind, name):
        return object.__getattribute__(value, name)  # raises: Python's own error, or that of a property
    hint = did_you_mean(kind.__name__, name, [each for each in dir(value) if not each.startswith("_")])
    # With `name`, Python adds no second suggestion.
    raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}{hint}", name=name)


def _refuse(value: Any, name: str, new: Any) -> NoReturn:
    """Raise the AttributeError about a name that cannot be set; Python's message for slots is obscure."""
    kind = type(value).__name__
    raise FrozenInstanceError(f"cannot set {name!r}: a {kind} is frozen; make a new {kind}")
