"""Fourier transforms along the rows and columns of planes, as machine code takes them: plans, factors, multipliers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.calls import Operand
from roughcontact.kernels.constants import HALF, WIDTH
from roughcontact.validation import Array

__all__ = ["Indices", "PlanePlan", "fits"]

Indices = npt.NDArray[np.int64]


def fits(lengths: tuple[int, int]) -> bool:
    """Whether transforms of such lengths are there: rows even, both without prime factors beyond five."""
    return lengths[1] % 2 == 0 and all(_radices(n, False) for n in (lengths[0], lengths[1] // 2))


@dataclass(frozen=True, slots=True, eq=False)
class PlanePlan:
    """Transforms of planes of one size and precision, and how their spectra lie in blocks of columns.

    Attributes
    ----------
    lengths : tuple of int
        ``(My, Mx)`` of the transforms.
    precision : {"float32", "float64"}
    lanes, blocks : int
        How many rows or columns go at once, and how many such blocks of columns there are.
    raw, scratch : int
        Numbers that a thread works in: of rows as they come from a transform, and in all, either of rows, as they come
        and in order, or of one block of columns.
    along, across : tuple
        Arguments of the kernels for transforms along rows, whose neighbours are taken for complex numbers and separated
        by further twiddle factors; and along columns, with the row of a multiplier for each place, whose waves are
        in digit-reversed order.
    """

    lengths: tuple[int, int]
    precision: str
    lanes: int
    blocks: int
    raw: int
    scratch: int
    along: tuple[Any, ...]
    across: tuple[Any, ...]

    @classmethod
    def of(cls, shape: tuple[int, int], lengths: tuple[int, int], precision: str) -> PlanePlan:
        """Return the plan for planes of a shape, padded to some lengths."""
        (ny, nx), (my, mx), lanes = shape, lengths, WIDTH // np.dtype(precision).itemsize
        half = mx // 2
        blocks, raw = half // lanes + 1, -(-half // lanes) * 2 * lanes * lanes
        scratch = max(raw + blocks * 2 * lanes * lanes, my * 2 * lanes)
        rows, columns = _plan(half, -(-nx // 2), precision), _plan(my, ny, precision)
        pairs = _twiddles(np.arange(half // 2 + 1), mx, precision)
        folded = np.minimum(columns.waves, my - columns.waves)
        along = half, *rows.arguments, Operand(rows.order), Operand(pairs)
        across = my, *columns.arguments, Operand(folded)
        return cls(lengths, precision, lanes, blocks, raw, scratch, along, across)

    def padded(self, rows: int) -> int:
        """Return the number of rows for which a spectrum of `rows` has memory."""
        return -(-rows // self.lanes) * self.lanes

    def in_blocks(self, multiplier: Array) -> Array:
        """Return some columns of a multiplier, of which the first begins a block, as columns are multiplied by it.

        It makes up for transforms there and back without a factor.
        """
        (my, mx), lanes, count = self.lengths, self.lanes, multiplier.shape[1]
        # Planes are large: no more than the answer is made.
        ordered = np.zeros((-(-count // lanes), my // 2 + 1, lanes), dtype=self.precision)
        full, scale = count // lanes, 1 / (4.0 * (mx // 2) * my)
        whole = multiplier[:, : full * lanes].reshape(my // 2 + 1, full, lanes).swapaxes(0, 1)
        np.multiply(whole, scale, out=ordered[:full], casting="same_kind")
        for block in ordered[full:]:  # one, or none
            rest = multiplier[:, full * lanes :]
            np.multiply(rest, scale, out=block[:, : count % lanes], casting="same_kind")
        return ordered


@dataclass(frozen=True, slots=True, eq=False)
class FourierPlan:
    """A Fourier transform whose waves come in digit-reversed order.

    Attributes
    ----------
    radices : int array
    twiddles : array
        Factors of all sweeps, one after the other.
    waves, order : int array
        The wave at each place, and the place of each wave, after the last that of the first again.
    """

    radices: Indices
    twiddles: Array
    waves: Indices
    order: Indices

    @property
    def arguments(self) -> tuple[Any, ...]:
        """Arguments of the kernel."""
        return Operand(self.radices), len(self.radices), Operand(self.twiddles)


@lru_cache(maxsize=64)
def _plan(length: int, filled: int, precision: str) -> FourierPlan:
    """Return a transform of numbers of which only the first are filled."""
    radices = _radices(length, 2 * filled <= length)
    waves, rest, stride, part = np.zeros(length, np.int64), np.arange(length), 1, length
    twiddles = []
    for digit in radices:
        radix = digit or 4
        m = part // radix
        twiddles.append(_twiddles(np.outer(np.arange(m), np.arange(1, radix)).ravel(), part, precision))
        waves += rest // m * stride
        rest, stride, part = rest % m, stride * radix, m
    order = np.zeros(length + 1, np.int64)
    order[waves] = np.arange(length)
    none = np.zeros(0, dtype=precision)
    return FourierPlan(np.array(radices, np.int64), np.concatenate([*twiddles, none]), waves, order)


def _radices(length: int, half: bool) -> tuple[int, ...]:
    """Return the radices of a length, the first HALF if only half of it is filled; none if there are none."""
    radices: list[int] = []
    if half and length % 4 == 0:
        radices, length = [HALF], length // 4
    for radix in (4, 2, 3, 5):
        while length % radix == 0:
            radices, length = [*radices, radix], length // radix
    return tuple(radices) if length == 1 else ()


def _twiddles(steps: Indices, length: int, precision: str) -> Array:
    """Return real and imaginary parts of ``exp(-2 pi i k / length)`` for steps k."""
    waves = np.exp(-2j * math.pi / length * steps)
    return np.stack([waves.real, waves.imag], axis=-1).ravel().astype(precision)
