"""Theory: pure functions of numbers and of spectral moments, beside every computed curve."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

__all__ = [
    "asperities",
    "beat_wave",
    "bounds",
    "bush_gibson_thomas",
    "cattaneo",
    "conductance",
    "cosine",
    "finite_size",
    "gaussian_heights",
    "greenwood_williamson",
    "height_distribution",
    "hertz",
    "holm",
    "interaction",
    "jaeger",
    "law",
    "laws",
    "mindlin",
    "nayak",
    "persson",
    "persson_separation",
    "plasticity",
    "pohrt_popov",
    "power_law_indenter",
    "punch",
    "rough_sphere",
    "stepped",
    "thermal",
    "two_cosines",
    "waves",
]

if TYPE_CHECKING:  # type checkers and bundlers of programs read this
    from roughcontact.theory import (
        asperities,
        beat_wave,
        bounds,
        bush_gibson_thomas,
        cattaneo,
        conductance,
        cosine,
        finite_size,
        gaussian_heights,
        greenwood_williamson,
        height_distribution,
        hertz,
        holm,
        interaction,
        jaeger,
        law,
        laws,
        mindlin,
        nayak,
        persson,
        persson_separation,
        plasticity,
        pohrt_popov,
        power_law_indenter,
        punch,
        rough_sphere,
        stepped,
        thermal,
        two_cosines,
        waves,
    )


def __getattr__(name: str) -> ModuleType:
    if name not in __all__:
        raise AttributeError(
            f"module 'roughcontact.theory' has no attribute {name!r}; it has {', '.join(__all__)}"
        )
    return import_module(f"{__name__}.{name}")


def __dir__() -> list[str]:
    return __all__
