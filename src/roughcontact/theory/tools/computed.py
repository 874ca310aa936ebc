"""A computed loading curve as a law of the force, interpolated between its points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np
from scipy.interpolate import PchipInterpolator

from roughcontact.errors import InputError
from roughcontact.theory.law import LoadingLaw
from roughcontact.validation import Array, number, shown

__all__ = ["ComputedCurve", "LogCubic", "as_law"]

ROUNDING = 1e-12  # tolerance for end points that leave the range by rounding of a difference of forces


class ComputedCurve(Protocol):
    """A loading curve in points; `roughcontact.Curve` and the `IndentationCurve` of `roughcontact.mdr` implement it."""

    @property
    def force(self) -> Array:
        """Normal forces [N], shape (n,), increasing."""

    @property
    def depth(self) -> Array:
        """Indentation depths [m], shape (n,)."""

    @property
    def stiffness(self) -> Array:
        """Contact stiffnesses [N/m], shape (n,)."""


def as_law(loading: LoadingLaw | ComputedCurve) -> LoadingLaw:
    """Return a law unchanged, and a computed curve as a law that interpolates its points.

    Depth and stiffness are monotone cubics in the logarithms between the lowest and the highest point that are
    positive and finite; a power law stays a power law. Without force the depth is 0. Elsewhere they are NaN, that is
    unknown.

    Raises
    ------
    ValueError
        If it is neither, or the curve has fewer than two points of increasing force.
    """
    if isinstance(loading, LoadingLaw):
        return loading
    if missing := [name for name in ("force", "depth", "stiffness") if not hasattr(loading, name)]:
        raise InputError(
            "a LoadingLaw, or a computed curve with force, depth and stiffness, is needed, not "
            f"{shown(loading)} without {', '.join(missing)}",
            place="loading",
        )
    force = np.atleast_1d(number(loading.force, "the forces of the curve [N]"))
    depth = np.atleast_1d(number(loading.depth, "the depths of the curve [m]"))
    stiffness = np.atleast_1d(number(loading.stiffness, "the stiffnesses of the curve [N/m]"))
    return LoadingLaw(
        "the computed curve",
        "",
        {"depth": partial(_depth, LogCubic.of(force, depth)), "stiffness": LogCubic.of(force, stiffness)},
        (0.0, float(force.max(initial=0.0)) * (1 + ROUNDING)),
    )


@dataclass(frozen=True, slots=True, eq=False)
class LogCubic:
    """A monotone cubic through the logarithms of positive points; NaN beyond them."""

    cubic: PchipInterpolator
    ends: tuple[float, float]

    @classmethod
    def of(cls, force: Array, values: Array) -> LogCubic:
        """Return the cubic through those values at strictly increasing forces that are positive and finite."""
        right = (force > 0) & (values > 0) & np.isfinite(force) & np.isfinite(values)
        x, y = force[right], values[right]
        if len(x) < 2 or not (np.diff(x) > 0).all():
            raise InputError(
                f"a computed curve needs at least two points of strictly increasing force, not {len(x)} "
                f"between {x.min(initial=np.inf):g} and {x.max(initial=0):g} N"
            )
        return cls(PchipInterpolator(np.log(x), np.log(y), extrapolate=False), (x[0], x[-1]))

    def __call__(self, f: Array) -> Array:
        """Return the values at forces."""
        low, high = self.ends
        inside = (f >= low * (1 - ROUNDING)) & (f <= high * (1 + ROUNDING))
        return np.where(inside, np.exp(self.cubic(np.log(np.clip(f, low, high)))), np.nan)


def _depth(points: LogCubic, force: Array) -> Array:
    return np.where(force == 0, 0.0, points(force))
