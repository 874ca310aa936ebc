"""Whole fields for machine code, of any shape: in parts, on several threads where they are large."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.buffers import empty
from roughcontact.kernels.constants import WIDTH
from roughcontact.kernels.loader import code_for, functions
from roughcontact.threads import threads
from roughcontact.validation import Array, Mask

__all__ = [
    "Combine",
    "Extremes",
    "LevelRange",
    "add_scaled",
    "extremes",
    "fit",
    "level_range",
    "positive_part",
    "positive_total",
    "predict_active",
    "raise_blocks",
    "run_on_plane",
    "scale_down",
]

Field = npt.NDArray[Any]  # of single or double precision
# Makes totals of all processes that hold a field from those of this one: the largest of the first n, sums of the rest.
Combine = Callable[[list[float], int], list[float]]

CELLS = 2**14  # cells that are taken at once; totals are made part by part, whatever the threads
SEVERAL = 4  # parts from which on a second thread comes in time


@dataclass(frozen=True, slots=True)
class Extremes:
    """The extremes of a pressure over all cells; levels are separation and displacement together.

    Attributes
    ----------
    highest, lowest : float
        Level [m] of those under pressure, and of all.
    displacement : float
        The largest [m].
    strongest, weakest : float
        Pressure [Pa].
    least : float
        Smallest positive pressure [Pa]; infinite without any.
    nearest : float
        Lowest level of those without pressure [m]; infinite without any.
    level : float
        Sum of the levels of those under pressure [m].
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


class LevelRange(NamedTuple):
    """The highest and the lowest level of some cells [m], and their mean."""

    highest: float
    lowest: float
    mean: float


def fit(*fields: Any) -> bool:
    """Whether some fields of one shape lie in memory as machine code takes them, in double precision."""
    wanted = np.dtype(np.float64), getattr(fields[0], "shape", None), True
    for field in fields:
        if not isinstance(field, np.ndarray) or wanted != (
            field.dtype,
            field.shape,
            field.flags.c_contiguous,
        ):
            return False
    return True


def extremes(
    pressure: Array, displacement: Array, separation: Array, combine: Combine | None = None
) -> Extremes | None:
    """Return the extremes; None where some pressure or displacement is no finite number.

    This pass and that of `predict_active` save 6 % of a press with half of 512 x 512 periodic cells in contact, on two
    threads, over the passes that NumPy takes (benchmarks/pairs.py, "flat-half").
    """
    run = functions("plane_kernels", "float64")["extremes"]
    found = run_on_plane(run, 7, 10, pressure, displacement, separation, combine=combine)
    highest, raised, moved, strongest, weakened, least, nearest, level, count, nothing = found
    if nothing != 0:  # or NaN
        return None
    return Extremes(highest, -raised, moved, strongest, -weakened, -least, -nearest, level, int(count))


def predict_active(
    pressure: Array,
    displacement: Array,
    separation: Array,
    combine: Combine | None = None,
    *,
    depth: float,
    least: float,
    a_ii: float,
) -> tuple[Mask, int, int]:
    """Return the cells under pressure or whose gap is below the least, except dropped ones, and the numbers of both.

    A cell is dropped if its gap is more than ``a_ii p``, the displacement of the cell by its own pressure.
    """
    region = empty(pressure.shape, bool)
    given = pressure, displacement, separation, depth, least, a_ii, region
    run = functions("plane_kernels", "float64")["predict_active"]
    stay, wrong = run_on_plane(run, 0, 2, *given, combine=combine)
    return region, int(stay), int(wrong)


def level_range(
    separation: Array, displacement: Array, region: Mask, combine: Combine | None = None
) -> LevelRange:
    """Return the levels of a region that has some cell."""
    run = functions("plane_kernels", "float64")["level_range"]
    fields = separation, displacement, region
    highest, raised, total, count = run_on_plane(run, 2, 4, *fields, combine=combine)
    return LevelRange(highest, -raised, total / count)


def scale_down(
    pressure: Array,
    displacement: Array,
    separation: Array,
    region: Mask,
    into: tuple[Field, Field, Field],
    *,
    depth: float,
    unit: float,
) -> None:
    """Write, in a unit: one inside a region and zero elsewhere, the residual of a depth, and the pressure."""
    fields = pressure, displacement, separation, depth, 1 / unit, region
    run_on_plane(code_for("plane_kernels", into[0])["scale_down"], 0, 0, *fields, *into)


def add_scaled(pressure: Array, change: Field, inside: Field, unit: float) -> Array:
    """Return a pressure with its change, in a unit, zero where it would be negative and outside."""
    answer = empty(pressure.shape, np.float64)
    run = code_for("plane_kernels", inside)["add_scaled"]
    run_on_plane(run, 0, 0, pressure, change, inside, unit, answer)
    return answer


def positive_total(pressure: Array, separation: Array, combine: Combine | None = None) -> float:
    """Return the sum of a pressure where it is positive and no cell is missing."""
    run = functions("plane_kernels", "float64")["positive_total"]
    return run_on_plane(run, 0, 1, pressure, separation, combine=combine)[0]


def positive_part(pressure: Array, separation: Array, scale: float) -> Array:
    """Return a scaled pressure, zero where it would be negative or a cell is missing."""
    answer = empty(pressure.shape, np.float64)
    run = functions("plane_kernels", "float64")["positive_part"]
    run_on_plane(run, 0, 0, pressure, separation, scale, answer)
    return answer


def raise_blocks(separation: Array, share: float) -> Array | None:
    """Return the mean of each block of 2 x 2 cells [m], less a share of how far they stand out of their plane.

    It is no less than the lowest of them. Shape (ny/2, nx/2); None where a side is odd, or the plane does not fit.
    """
    ny, nx = separation.shape
    if ny % 2 or nx % 2 or not fit(separation):
        return None
    blocks = empty((ny // 2, nx // 2), np.float64)
    workers = threads() if separation.size >= SEVERAL * CELLS else 1
    run = functions("block_kernels", "float64")["raise_blocks"]
    run(ny, nx, share, separation, blocks, workers=workers)
    return blocks


def run_on_plane(
    run: Callable[..., None],
    most: int,
    count: int,
    field: Field,
    *others: Field | Mask | float,
    combine: Combine | None = None,
) -> list[float]:
    """Run a function over all cells; return the largest over all parts of its first totals, sums of the others."""
    assert CELLS % WIDTH == 0
    parts = max(-(-field.size // CELLS), 1)
    totals = np.empty((parts, count))
    workers = threads() if parts >= SEVERAL else 1
    run(field.size, CELLS, field, *others, *((totals,) if count else ()), workers=workers)
    found: list[float] = totals[0].tolist()
    return combine(found, most) if combine else found
