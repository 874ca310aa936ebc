"""Projected conjugate gradients: directions that keep a pressure within its bounds, one product each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from roughcontact.solver.inner_operator import Driver
from roughcontact.solver.vectors import Fields

__all__ = ["Descent", "Stride", "descend"]

ALIKE = 0.01  # of what may be lacking: what a region may lack on the mean, where that is none
LEFT = 0.1  # of what may be lacking: what the pressure that is farthest out of bounds may displace
SLIGHT = 0.1  # of what is lacking: what cells that go to their bounds may displace, all told, to be as good as none
# The rest was found by counting products (`benchmarks/steps.py`).
CAREFUL = 0.9  # of the step that is expected: a longer one lets go of cells for nothing
LEAST, MOST = 0.5, 1.1  # times a step that takes cells to their bounds: they are to go there, and no further
BOUND = 0.7, 1.1  # times what was expected: what such a step tells of the next, at least and at most
FREE = 0.5, 1.5  # what any other does


@dataclass(frozen=True, slots=True)
class Stride:
    """How far the next direction is expected to go, in units of what the preconditioner finds; at first a guess."""

    expected: float = 1.0
    known: bool = False

    @property
    def next(self) -> float:
        """How far to go."""
        return CAREFUL * self.expected

    def after(self, best: float, *, lifts: bool) -> Stride:
        """Return what is expected after the best step was so long; one that took cells to their bounds tells less."""
        least, most = BOUND if lifts else FREE
        if self.known:
            best = min(max(best, least * self.expected), most * self.expected)
        return Stride(best, known=True)


class Descent(NamedTuple):
    """What became of a descent.

    Attributes
    ----------
    lack : float
        Largest displacement that is lacking on the region [m].
    steps : int
        Products.
    stride : Stride
        For the next.
    """

    lack: float
    steps: int
    stride: Stride


def descend(
    driver: Driver,
    fields: Fields,
    stride: Stride,
    *,
    conserve: bool,
    own: float,
    limit: float,
    max_steps: int,
) -> Descent:
    """Change the pressure to what gives a region the displacement it lacks, and let go of cells that would pull.

    Parameters
    ----------
    driver : Driver
    fields : Fields
        Of the solve. Cells that are let go of, or reach the hardness, are free no longer.
    stride : Stride
        What the last descent learned.
    conserve : bool
        Whether the force is kept; then a displacement that is lacking everywhere alike is none.
    own : float
        Displacement of a cell per unit pressure on itself [m/Pa].
    limit : float
        Stop when the largest lack on the region [m] is no more than this.
    max_steps : int
        Largest number of products.

    Notes
    -----
    Which cells a direction takes to their bounds hangs on how far it goes, and how far it should go is known after its
    product. So the step is guessed: cells that it would take out of bounds go to them, the rest goes on, and of all
    that one product is taken; it tells the best multiple. Where no cell is at a bound these are conjugate gradients,
    as of `roughcontact.solver.conjugate_gradients`, whatever was guessed. Cells that go to their bounds go most of the
    way, even uphill: what they still miss or overshoot goes with the next step.
    """
    area, steps = fields.begin(), 0
    if conserve:
        fields.level(ALIKE * limit)
    size = fields.size()
    if conserve and not area > 0:  # none is there to take the force
        return Descent(size, steps, stride)
    last, resultant = None, 1.0
    while steps < max_steps and (size > limit or own * fields.excess() > LEFT * limit):
        if last is None:
            resultant, last = fields.share() if conserve else 1.0, fields.measure(fields.v)
        found = fields.precondition()
        if not found.descent >= 0:
            break
        alike = found.alike / resultant if conserve else 0.0
        curvature = last.curvature - alike * last.force
        beta = (
            -(found.overlap - alike * found.force) / curvature
            if curvature > 0 and last.curvature > 0
            else 0.0
        )
        shift = (found.force + beta * last.force) / resultant
        lifted, area, force = fields.bound(beta, shift, stride.next)
        lifts = own * lifted > SLIGHT * size
        if conserve:
            if not area > 0:
                break
            if force:
                fields.share_out(force)
            resultant = fields.share()
        last = fields.measure(driver.apply(fields.t))
        steps += 1
        if not last.curvature > 0:  # rounding has eaten the direction
            size = fields.size()
            break
        # Few cells that go to their bounds where much is lacking say nothing of how far the rest should go, unless they
        # do more than the rest, and the product is theirs: a shorter step would only make it more so.
        theirs = abs(last.descent - last.free) > abs(last.free)
        lifts = lifts or (lifted > 0 and theirs and last.free < LEAST * last.curvature)
        alpha = (last.descent if lifts else last.free) / last.curvature
        if alpha > 0:
            stride = stride.after(alpha * stride.next, lifts=lifts)
        elif lifted:  # no direction to go on from
            last, lifts = last._replace(curvature=0.0), True
        else:
            size = fields.size()
            break
        if lifts:
            alpha = min(max(alpha, LEAST), MOST)
        # Cells that are left may lack something alike, which is none.
        size = fields.advance(alpha, (last.answer - last.lack / alpha) / area if conserve else 0.0)
    return Descent(size, steps, stride)
