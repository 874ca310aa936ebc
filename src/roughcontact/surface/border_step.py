"""Whether a map that is pressed as periodic closes at its border, or steps from one edge to the opposite one."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from roughcontact.arrays import on_host

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface
    from roughcontact.validation import Array

__all__ = ["OPEN", "BorderStep", "border_steps", "open_border"]

OPEN = 3.0  # times the steps inside: random periodic maps reach 1.8, waves 1.4; 1 in 370 profiles is above
PAIRS = 128  # of rows: on larger maps all of them would take the memory of several maps
ROUNDING = 1e-9  # of the rms height: rows that are equal differ by less


class BorderStep(NamedTuple):
    """The step of the heights across a border of a periodic map.

    Attributes
    ----------
    height : float
        Root mean square of the differences between the last and the first row [m].
    ratio : float
        The same over the root mean square of the differences between neighbouring rows inside; NaN without any.
    """

    height: float
    ratio: float


def border_steps(surface: Surface) -> tuple[BorderStep, ...]:
    """Return the steps of a map of heights along its periodic axes. Pairs with a missing height are left out.

    On a random surface that repeats itself, the border is like any other pair of rows, and the ratio is near 1. On a
    self-affine map of n rows that does not repeat itself, the ratio is about n^H if the longest wave is longer than the
    map, and smaller otherwise. Of many rows about `PAIRS` evenly spaced pairs are compared, to save memory.
    """
    steps = []
    for axis in (axis for axis, repeats in enumerate(surface.grid.periodic) if repeats):
        rows = np.moveaxis(on_host(surface.heights), axis, 0)
        every = -(-len(rows) // PAIRS)
        across, inside = _rms(rows[0] - rows[-1]), _rms(rows[1::every] - rows[:-1:every])
        steps.append(BorderStep(across, across / inside if inside > 0 else np.nan))
    return tuple(steps)


def open_border(surface: Surface) -> BorderStep | None:
    """Return the largest step by ratio of a periodic map that does not close; None if it closes along all axes."""
    steps = [step for step in border_steps(surface) if step.ratio > OPEN]
    # The rms height takes the memory of several maps, too.
    steps = [step for step in steps if step.height > ROUNDING * surface.rms]
    return max(steps, key=lambda step: step.ratio, default=None)


def _rms(differences: Array) -> float:
    """Return the root mean square of what is known; NaN without any."""
    known = differences[np.isfinite(differences)]
    return float(np.sqrt(np.mean(known**2))) if known.size else float("nan")
