"""What is meant by a name that a module or a value does not have: the end of its AttributeError."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import FrozenInstanceError
from types import MappingProxyType
from typing import Any, NoReturn, TypeVar

__all__ = ["MEANT", "did_you_mean", "hinted"]

T = TypeVar("T")

_FILES = {
    "save": "rc.write(curve, 'curve.nc') or to_csv('curve.csv')",
    "to_netcdf": "rc.write(curve, 'curve.nc')",
    "to_xarray": "to_dataset()",
}
_CURVE = _FILES | {"area": "contact_area", "displacement": "depth", "gap": "mean_gap", "load": "force"}
_TABLE = dict.fromkeys(("to_dataframe", "to_pandas"), "to_dataset().to_dataframe()")
_BRANCHES = (
    "force",
    "depth",
    "stiffness",
    "contact_area",
    "interfacial_stiffness",
    "mean_gap",
    "nominal_pressure",
)
_STATE = {
    **dict.fromkeys(("to_dataframe", "to_pandas"), "to_record() or to_dataset()"),
    **dict.fromkeys(("save", "to_netcdf"), "rc.write(solution, 'state.nc')"),
    "area": "contact_area",
    "grid": "problem.operator.grid",
    "modulus": "problem.modulus",
    "surface": "problem.surface",
    "to_xarray": "to_dataset()",
}
_SOLID = {"e": "young_modulus", "g": "shear_modulus", "nu": "poisson_ratio"}

MEANT: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        "roughcontact": {
            "curve": "rc.loading_curve",
            "generate": "rc.self_affine",
            "load": "rc.read",
            "load_curve": "rc.read_curve",
            "loop": "rc.loading_loop",
            "open": "rc.read",
            "psd": "rc.power_spectrum",
            "save": "rc.write",
            "solve": "rc.press",
            "sphere": "rc.shapes.sphere",
            "to_csv": "rc.write",
        },
        "Surface": {
            **dict.fromkeys(("data", "values", "z"), "heights"),
            **dict.fromkeys(("extent", "lengths"), "grid.lengths"),
            **dict.fromkeys(("sa", "slope"), "rc.areal_parameters(surface)"),
            **dict.fromkeys(("sq", "std"), "rms"),
            "crop": "cropped",
            "detrend": "levelled",
            "level": "levelled",
            "ndim": "grid.ndim",
            "periodic": "grid.periodic",
            "psd": "rc.power_spectrum(surface)",
            "save": "rc.write(surface, 'part.npz')",
            "show": "plot()",
            "size": "grid.lengths or grid.size",
            "spacing": "grid.spacing",
            "to_csv": "rc.write(surface, 'heights.txt')",
            "to_xarray": "to_dataset()",
        },
        "Solution": _STATE,
        "AdhesiveState": _STATE,
        "DetachmentState": _STATE,
        "Curve": {
            **_CURVE,
            "exponent": "fit().exponent",
            "pressure": "nominal_pressure",
            "to_pandas": "to_dataframe()",
        },
        "AdhesiveCurve": _CURVE | _TABLE,
        "DetachmentCurve": _CURVE | _TABLE,
        "Loop": {
            **{name: f"loading.{name} or unloading.{name}" for name in _BRANCHES},
            "area": "loading.contact_area or unloading.contact_area",
            **_FILES,
            **_TABLE,
        },
        "Solid": _SOLID,
        "Material": {
            **{name: f"solid.{meant}" for name, meant in _SOLID.items()},
            **{name: f"solid.{name}" for name in _SOLID.values()},
        },
        "Grid": dict.fromkeys(("dx", "dy"), "spacing")
        | dict.fromkeys(("n", "nx", "ny"), "shape")
        | {"extent": "lengths"},
    }
)
"""Names that users guess, by where they look for them, in lower case; misspelt ones are found by likeness."""


def did_you_mean(owner: str, name: str, known: Iterable[str]) -> str:
    """Return the end of a message about a `name` that an `owner` does not have; empty where nothing is like it.

    Parameters
    ----------
    owner : str
        Name of the module or class.
    name : str
        What was looked for.
    known : iterable of str
        Names that the owner has.
    """
    meant = MEANT.get(owner, {}).get(name.casefold())
    if meant is None:
        from difflib import get_close_matches  # late: it takes as long to import as all of a package's names

        meant = " or ".join(get_close_matches(name, known))
    return f"; did you mean {meant}?" if meant else ""


def hinted(cls: type[T]) -> type[T]:
    """Give a frozen class errors that say what is meant where a name is looked up that it does not have, or is set.

    Both stay an AttributeError. Python asks for neither of the two methods while a name is found.
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
    # With its name, so that Python adds no suggestion of its own to ours.
    raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}{hint}", name=name)


def _refuse(value: Any, name: str, new: Any) -> NoReturn:
    """Raise the AttributeError about a name that cannot be set; that of slots is not to be understood."""
    kind = type(value).__name__
    raise FrozenInstanceError(f"cannot set {name!r}: a {kind} is frozen; make a new {kind}")
