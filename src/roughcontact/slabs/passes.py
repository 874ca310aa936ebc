"""Passes over whole fields in machine code: of an array of NumPy, or of one in slabs by all its processes."""

from __future__ import annotations

from typing import Any, Protocol

from roughcontact.kernels import loader, planes
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.validation import Array, Mask

__all__ = ["Passes", "SlabPasses", "passes_over"]


class Passes(Protocol):
    """The functions of `roughcontact.kernels.planes` for the fields of one solve."""

    def fit(self, *fields: Any) -> bool:
        """Whether they take some fields."""
        ...

    def extremes(self, pressure: Array, displacement: Array, separation: Array, /) -> planes.Extremes | None:
        """Return the extremes; None where some pressure or displacement is no finite number."""
        ...

    def predict_active(
        self,
        pressure: Array,
        displacement: Array,
        separation: Array,
        /,
        *,
        depth: float,
        least: float,
        a_ii: float,
    ) -> tuple[Mask, int, int]:
        """Return the cells predicted in contact, and counts."""
        ...

    def positive_total(self, pressure: Array, separation: Array, /) -> float:
        """Return the sum of a pressure where it is positive and no cell is missing."""
        ...

    def positive_part(self, pressure: Array, separation: Array, scale: float, /) -> Array:
        """Return a scaled pressure, zero where it would be negative or a cell is missing."""
        ...

    def raise_blocks(self, separation: Array, share: float, /) -> Array | None:
        """Return the mean of each block of 2 x 2 cells, less a share of how far they stand out of their plane.

        None where there are other blocks.
        """
        ...


def passes_over(field: Any) -> Passes | None:
    """Return the passes over a field and others of its kind; None where they are not in machine code."""
    if isinstance(field, SlabArray):
        return SlabPasses(field.functions) if field.functions.agreed(loader.takes(field.local)) else None
    return planes if loader.takes(field) else None


class SlabPasses:
    """Passes over the rows of this process, with the totals of all."""

    def __init__(self, functions: Any) -> None:
        self._agreed, self._combine = functions.agreed, functions.combined

    def fit(self, *fields: Any) -> bool:
        """Whether the rows of every process fit."""
        return bool(self._agreed(planes.fit(*(field.local for field in fields))))

    def extremes(self, pressure: Any, displacement: Any, separation: Any) -> planes.Extremes | None:
        """Return the extremes of all rows."""
        return planes.extremes(pressure.local, displacement.local, separation.local, self._combine)

    def predict_active(
        self, pressure: Any, displacement: Any, separation: Any, *, depth: float, least: float, a_ii: float
    ) -> tuple[Any, int, int]:
        """Return the cells predicted in contact, in slabs, and the counts of all rows."""
        here = pressure.local, displacement.local, separation.local, self._combine
        found, stay, wrong = planes.predict_active(*here, depth=depth, least=least, a_ii=a_ii)
        return pressure.like(found), stay, wrong

    def positive_total(self, pressure: Any, separation: Any) -> float:
        """Return the sum over all rows."""
        return planes.positive_total(pressure.local, separation.local, self._combine)

    def positive_part(self, pressure: Any, separation: Any, scale: float) -> Any:
        """Return the pressure in slabs."""
        return pressure.like(planes.positive_part(pressure.local, separation.local, scale))

    def raise_blocks(self, separation: Any, share: float) -> Any:
        """Return the blocks in slabs, each on the process that holds its rows."""
        blocks = planes.raise_blocks(separation.local, share)
        return separation.in_blocks(blocks, 2) if self._agreed(blocks is not None) else None
