"""Convolutions of a field with an even kernel: in machine code where there is some, else by the field's own library."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import Placed, convolve, fast_even_length, is_numpy
from roughcontact.kernels import loader
from roughcontact.kernels.compiled_convolution import CompiledConvolution, fits

__all__ = ["Convolution", "padded_length"]

Array = npt.NDArray[np.float64]
Pair = tuple[int, int]

ROWS = 8  # that machine code takes at once


class Convolution:
    """A product with an even kernel for fields of any library, in double or single precision.

    Parameters
    ----------
    multiplier : array, shape (My//2 + 1, Mx//2 + 1)
        Real transform of the kernel, rows and columns from 0 up, as `roughcontact.arrays.even_multiplier` returns it.
    lengths : tuple of int
        ``(My, Mx)`` of the transforms, at least those of the fields.
    """

    __slots__ = ("_multiplier", "_placed", "_ready", "lengths")

    def __init__(self, multiplier: Array, lengths: Pair) -> None:
        self.lengths = lengths
        self._multiplier: Array | None = multiplier
        self._placed: Placed | None = None
        self._ready: dict[tuple[tuple[int, ...], np.dtype[Any]], Any] = {}

    def apply(self, field: Array) -> Array:
        """Return the convolution of a field, padded by zeros to `lengths`, cut back to its own shape."""
        ready = self._ready.get((field.shape, field.dtype)) if is_numpy(field) else None
        if ready is None:
            if is_numpy(field) and field.dtype.kind in "biu":
                return self.apply(field.astype(np.float64))
            if not _in_machine_code(field, self.lengths):
                if self._placed is None:
                    self._placed = Placed(self._kernel())
                return convolve(field, self._placed.beside(field), self.lengths)
            ready = self._prepare((field.shape[0], field.shape[1]), field.dtype)
        answer: Array = ready.apply(field)
        return answer

    def _prepare(self, shape: Pair, dtype: np.dtype[Any]) -> Any:
        """Return the machine's kernel for fields of one shape and precision."""
        if shape[0] > self.lengths[0] or shape[1] > self.lengths[1]:
            raise ValueError(f"a field of shape {shape} is larger than transforms of {self.lengths}")
        ready = CompiledConvolution.of(self._kernel(), shape, self.lengths, dtype.name)
        self._ready[shape, dtype] = ready
        if dtype == np.float64:
            self._multiplier = None  # planes are large: none is kept twice
        return ready

    def _kernel(self) -> Array:
        """Return the multiplier, from what was made of it in double precision if that is all there is."""
        multiplier = self._multiplier  # another thread may let go of it meanwhile
        if multiplier is not None:
            return multiplier
        found: Array = next(
            ready.kernel() for (_, dtype), ready in list(self._ready.items()) if dtype == np.float64
        )
        return found


def padded_length(cells: int) -> int:
    """Return the length of a transform of so many cells that nothing comes round: at least ``2 cells - 2``.

    Offsets ``cells - 1`` and ``-(cells - 1)`` may share a place, since the kernel is even.
    """
    if cells < ROWS:
        return fast_even_length(2 * cells - 2)
    return 4 * fast_even_length(-(-(2 * cells - 2) // 4))


def _in_machine_code(field: Array, lengths: Pair) -> bool:
    if not is_numpy(field) or field.ndim != 2 or field.shape[0] < ROWS or not loader.takes(field):
        return False
    return fits(lengths)
