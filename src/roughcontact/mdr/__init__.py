"""The method of dimensionality reduction: bodies of revolution and rough lines on springs."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

__all__ = [
    "adhesion",
    "adhesive_path",
    "calibration",
    "equivalent_line",
    "foundation",
    "indentation",
    "indenter",
    "lattice_sums",
    "lee_radok",
    "line_curves",
    "line_scan",
    "random_lines",
    "rough_line",
    "sliding_friction",
    "slip_history",
    "tangential",
    "viscoelastic",
    "viscoelastic_history",
]

if TYPE_CHECKING:  # type checkers and bundlers of programs read this
    from roughcontact.mdr import (
        adhesion,
        adhesive_path,
        calibration,
        equivalent_line,
        foundation,
        indentation,
        indenter,
        lattice_sums,
        lee_radok,
        line_curves,
        line_scan,
        random_lines,
        rough_line,
        sliding_friction,
        slip_history,
        tangential,
        viscoelastic,
        viscoelastic_history,
    )


def __getattr__(name: str) -> ModuleType:
    if name not in __all__:
        raise AttributeError(
            f"module 'roughcontact.mdr' has no attribute {name!r}; it has {', '.join(__all__)}"
        )
    return import_module(f"{__name__}.{name}")


def __dir__() -> list[str]:
    return __all__
