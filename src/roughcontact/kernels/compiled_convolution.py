"""Convolutions of real fields with even kernels, in machine code."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.buffers import aligned, empty
from roughcontact.kernels.constants import APART, HALF, WIDTH
from roughcontact.kernels.loader import functions
from roughcontact.threads import join_in, threads
from roughcontact.validation import Array

__all__ = ["CompiledConvolution", "fits"]

Indices = npt.NDArray[np.int64]

LARGE = 600_000  # bytes of rows as padded from which on a second thread comes in time (timed by benchmarks/pairs.py)
PARTS = 4  # of the work for each thread, since not all are equally fast


def fits(lengths: tuple[int, int]) -> bool:
    """Whether transforms of such lengths are there: rows even, both without prime factors beyond five."""
    return lengths[1] % 2 == 0 and all(_radices(n, False) for n in (lengths[0], lengths[1] // 2))


@dataclass(frozen=True, slots=True, eq=False)
class CompiledConvolution:
    """A kernel, ready for fields of one shape and precision.

    Attributes
    ----------
    shape, lengths : tuple of int
        Of the fields, and of the transforms.
    precision : str
    rows, columns : FourierPlan
        Along a row, whose neighbours are taken for complex numbers, and along a column.
    pairs : array
        Twiddle factors that tell neighbours in a row apart.
    multiplier : array
        Transform of the kernel in blocks of as many columns as there are lanes.
    folded : int array
        Row of the multiplier for each place in a column, whose waves are in digit-reversed order.
    """

    shape: tuple[int, int]
    lengths: tuple[int, int]
    precision: str
    rows: FourierPlan
    columns: FourierPlan
    pairs: Array
    multiplier: Array
    folded: Indices

    @classmethod
    def of(
        cls, multiplier: Array, shape: tuple[int, int], lengths: tuple[int, int], precision: str
    ) -> CompiledConvolution:
        """Make a kernel ready.

        Parameters
        ----------
        multiplier : array, shape (My//2 + 1, Mx//2 + 1)
            Real transform of an even kernel, rows from 0 up.
        shape : tuple of int
            Of the fields.
        lengths : tuple of int
            ``(My, Mx)`` of the transforms, at least those of the fields.
        precision : {"float32", "float64"}
            Of the fields.
        """
        (ny, nx), (my, mx), lanes = shape, lengths, WIDTH // np.dtype(precision).itemsize
        half = mx // 2
        rows = _plan(half, -(-nx // 2), precision)
        columns = _plan(my, ny, precision)
        blocks = half // lanes + 1
        # Planes are large: no more than the answer is made.
        ordered = np.zeros((blocks, my // 2 + 1, lanes), dtype=precision)
        full, scale = (blocks - 1) * lanes, 1 / (4.0 * half * my)
        whole = multiplier[:, :full].reshape(my // 2 + 1, blocks - 1, lanes).swapaxes(0, 1)
        np.multiply(whole, scale, out=ordered[:-1], casting="same_kind")
        np.multiply(multiplier[:, full:], scale, out=ordered[-1, :, : half + 1 - full], casting="same_kind")
        folded = np.minimum(columns.waves, my - columns.waves)
        pairs = _twiddles(np.arange(half // 2 + 1), mx, precision)
        return cls(shape, lengths, precision, rows, columns, pairs, ordered, folded)

    def kernel(self) -> Array:
        """Return the multiplier as it was given."""
        my, half = self.lengths[0], self.lengths[1] // 2
        rows = self.multiplier.swapaxes(0, 1).reshape(my // 2 + 1, -1)
        return np.asarray(rows[:, : half + 1] * (4.0 * half * my))

    def apply(self, plane: Array) -> Array:
        """Return the convolution of a field, padded by zeros, cut back to its own shape."""
        if plane.shape != self.shape:  # machine code looks at nothing twice
            raise ValueError(f"a field of shape {plane.shape} where {self.shape} is expected")
        convolve = functions("fft", self.precision)["convolve"]
        (ny, nx), (my, mx), lanes = self.shape, self.lengths, self.multiplier.shape[-1]
        half, blocks, rows = mx // 2, len(self.multiplier), -(-ny // lanes) * lanes
        given = np.ascontiguousarray(plane, dtype=self.precision)
        answer = empty((ny, nx), self.precision)
        workers = threads() if ny * mx * given.itemsize >= LARGE else 1
        parts = PARTS * workers
        # What a thread needs: rows as they come and in order, or one column.
        raw = -(-half // lanes) * 2 * lanes * lanes
        size = max(raw + blocks * 2 * lanes * lanes, my * 2 * lanes)
        counters = np.zeros(6 * APART, np.int64)
        memory = aligned(workers * size + blocks * rows * 2 * lanes, self.precision)
        spectrum = memory[workers * size :], rows
        along = half, *self.rows.arguments, self.rows.order, self.pairs
        across = my, *self.columns.arguments, self.folded, self.multiplier
        share = -(-rows // (parts * lanes)) * lanes, -(-blocks // parts)

        def join(k: int) -> None:
            scratch = memory[k * size :], raw
            convolve(counters, given, answer, ny, nx, *spectrum, *along, *across, *share, *scratch)

        join_in(join, workers)
        return answer


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
        """What the kernel is told."""
        return self.radices, len(self.radices), self.twiddles


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
