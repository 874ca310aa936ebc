"""Convolutions of real fields with even kernels, in machine code."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError
from roughcontact.kernels.buffers import aligned, empty
from roughcontact.kernels.calls import Operand
from roughcontact.kernels.loader import functions
from roughcontact.kernels.plane_plan import PlanePlan
from roughcontact.threads import threads
from roughcontact.validation import Array

__all__ = ["LARGE", "PARTS", "CompiledConvolution"]

LARGE = 200_000  # bytes of rows as padded from which on a second thread comes in time (timed by benchmarks/pairs.py)
PARTS = 4  # of the work for each thread, since not all are equally fast


@dataclass(frozen=True, slots=True, eq=False)
class CompiledConvolution:
    """A kernel, ready for fields of one shape and precision.

    Attributes
    ----------
    shape : tuple of int
        Of the fields.
    plan : PlanePlan
    multiplier : Operand
        Transform of the kernel in blocks of as many columns as there are lanes.
    edges, places : Operand
        Rows of the fields, and rows of the spectrum: columns lie in one piece.
    """

    shape: tuple[int, int]
    plan: PlanePlan
    multiplier: Operand
    edges: Operand
    places: Operand

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
        plan = PlanePlan.of(shape, lengths, precision)
        edges, places = (Operand(np.array([0, rows], np.int64)) for rows in (shape[0], plan.padded(shape[0])))
        return cls(shape, plan, Operand(plan.in_blocks(multiplier)), edges, places)

    def kernel(self) -> Array:
        """Return the multiplier as it was given."""
        my, half = self.plan.lengths[0], self.plan.lengths[1] // 2
        rows = self.multiplier.field.swapaxes(0, 1).reshape(my // 2 + 1, -1)
        return np.asarray(rows[:, : half + 1] * (4.0 * half * my))

    def apply(self, plane: Array) -> Array:
        """Return the convolution of a field, padded by zeros, cut back to its own shape."""
        if plane.shape != self.shape:  # machine code looks at nothing twice
            raise InputError(f"a field of shape {plane.shape} where {self.shape} is expected")
        plan, (ny, nx) = self.plan, self.shape
        convolve = functions("fft", plan.precision)["convolve"]
        lanes, blocks, scratch, rows = plan.lanes, plan.blocks, plan.scratch, plan.padded(ny)
        given = np.ascontiguousarray(plane, dtype=plan.precision)
        answer = empty((ny, nx), plan.precision)
        workers = threads() if ny * plan.lengths[1] * given.itemsize >= LARGE else 1
        parts = PARTS * workers
        memory = aligned(workers * scratch + blocks * rows * 2 * lanes, plan.precision)
        spectrum = Operand(memory[workers * scratch :])
        along = spectrum, rows, *plan.along, -(-rows // (parts * lanes)) * lanes
        pieces = spectrum, blocks, 1, self.edges, self.places
        across = *pieces, *plan.across, self.multiplier, -(-blocks // parts)
        convolve(given, answer, ny, nx, *along, *across, memory, scratch, plan.raw, workers=workers)
        return answer
