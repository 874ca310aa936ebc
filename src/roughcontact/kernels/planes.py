"""Whole fields for machine code, of any shape: in parts, on several threads where they are large."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.buffers import empty
from roughcontact.kernels.constants import WIDTH
from roughcontact.kernels.loader import address, code_for
from roughcontact.threads import spread

__all__ = ["Levels", "Look", "levels", "look", "mark", "narrow", "widen"]

Field = npt.NDArray[Any]  # of single or double precision
Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

CELLS = 2**17  # cells that are taken at once; totals are made part by part, whatever the threads
SEVERAL = 4  # parts from which on threads are worth waking


@dataclass(frozen=True, slots=True)
class Look:
    """What there is to see of a pressure, over all cells; levels are separation and displacement together.

    Attributes
    ----------
    highest, lowest : float
        Level [m] of those that carry something, and of all.
    displacement : float
        The largest [m].
    strongest, weakest : float
        Pressure [Pa].
    least : float
        Pressure of those that carry something [Pa]; infinite without any.
    nearest : float
        Lowest level of those that carry nothing [m]; infinite without any.
    level : float
        Sum over those that carry something [m].
    count : int
        How many they are.
    """

    highest: float
    lowest: float
    displacement: float
    strongest: float
    weakest: float
    least: float
    nearest: float
    level: float
    count: int


class Levels(NamedTuple):
    """The highest and the lowest level of some cells [m], and their mean."""

    highest: float
    lowest: float
    mean: float


def look(pressure: Array, displacement: Array, separation: Array) -> Look | None:
    """Return what there is to see; None where some pressure or displacement is no finite number."""
    run = code_for("judging", pressure)["look"]
    found = _totals(run, 7, 10, pressure, displacement, separation)
    highest, raised, moved, strongest, weakened, least, nearest, level, count, nothing = found
    if nothing != 0:  # or is no number
        return None
    return Look(highest, -raised, moved, strongest, -weakened, -least, -nearest, level, int(count))


def mark(
    pressure: Array, displacement: Array, separation: Array, *, depth: float, least: float, own: float
) -> tuple[Mask, int, int]:
    """Return the cells that carry something or whose gap is below the least, but for wrong ones; and how many both are.

    Those are wrong whose gap is more than what they carry would displace, if each moved itself by `own` alone [m/Pa].
    """
    region = empty(pressure.shape, bool)
    given = pressure, displacement, separation, depth, least, own, region
    stay, wrong = _totals(code_for("judging", pressure)["mark"], 0, 2, *given)
    return region, int(stay), int(wrong)


def levels(separation: Array, displacement: Array, region: Mask) -> Levels:
    """Return the levels of a region that has some cell."""
    code = code_for("judging", separation)
    highest, raised, total, count = _totals(code["levels"], 2, 4, separation, displacement, region)
    return Levels(highest, -raised, total / count)


def narrow(
    separation: Array,
    displacement: Array,
    pressure: Array,
    region: Mask,
    *,
    depth: float,
    unit: float,
    inside: Field,
    lacking: Field,
    base: Field,
) -> None:
    """Write, in a unit: one inside a region and zero elsewhere, what is lacking of a depth, and the pressure."""
    fields = separation, displacement, pressure, region
    run = code_for("scaling", inside)["narrow"]
    _totals(run, 0, 0, *fields, depth, 1 / unit, inside, lacking, base)


def widen(pressure: Array, change: Field, inside: Field, unit: float) -> Array:
    """Return a pressure with its change, in a unit, zero where it would be negative and outside."""
    answer = empty(pressure.shape, np.float64)
    _totals(code_for("scaling", inside)["widen"], 0, 0, pressure, change, inside, unit, answer)
    return answer


def _totals(run: Callable[..., None], most: int, count: int, *arguments: Field | Mask | float) -> list[float]:
    """Run a function over all cells; return the largest over all parts of its first totals, sums of the others."""
    size = next(a.size for a in arguments if isinstance(a, np.ndarray))
    assert CELLS % WIDTH == 0
    starts = range(0, max(size, 1), CELLS)
    totals = np.zeros((len(starts), count))
    given = [(address(a), a.itemsize) if isinstance(a, np.ndarray) else (a, 0) for a in arguments]

    # With the arrays themselves: they live as long as anyone works on them.
    def part(start: int, _: object = arguments) -> None:
        at = [first + start * step if step else first for first, step in given]
        ends = (address(totals[start // CELLS]),) if count else ()
        run(min(CELLS, size - start), *at, *ends)

    spread(part, starts, SEVERAL)
    return [*totals[:, :most].max(axis=0).tolist(), *totals[:, most:].sum(axis=0).tolist()]
