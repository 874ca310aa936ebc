"""What a pressure amounts to: its depth, its residual, and the contact region that it lets guess."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.kernels import planes
from roughcontact.solver.control import Terms
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Judge
from roughcontact.solver.projection import depth_of
from roughcontact.solver.trial import Trial

__all__ = ["Guess", "Verdict", "guess_region", "judge_pressure"]

Mask = npt.NDArray[np.bool_]


class Verdict(NamedTuple):
    """How far a pressure is from what is asked.

    Attributes
    ----------
    depth : float
        The one that is given, or that leaves no gap on the mean of the cells between the bounds [m].
    residual : float
        See `Judge.residual`.
    scale : float
        What that is relative to [m].
    """

    depth: float
    residual: float
    scale: float


@dataclass(frozen=True, slots=True, eq=False)
class Guess:
    """Cells whose pressure is free, how many they are, how many were wrong, and all of them that have some pressure."""

    region: Mask
    count: int
    wrong: int
    taken: Mask


def judge_pressure(judge: Judge, measure: Measure, terms: Terms, trial: Trial) -> Verdict:
    """Return the verdict on a pressure."""
    if not measure.varies and trial.fits_machine_code(terms.hardness):
        return _judged_at_once(judge, terms, trial)
    pressure, displacement, separation = trial
    gap = displacement + separation
    between = (pressure > 0) & (pressure < terms.hardness)
    depth = depth_of(measure, gap, pressure, between) if terms.depth is None else terms.depth
    gap -= depth
    return Verdict(depth, judge.residual(pressure, displacement, gap), judge.scale(displacement))


def guess_region(terms: Terms, trial: Trial, *, depth: float, allowed: float, own: float = math.inf) -> Guess:
    """Return the cells that carry something or would penetrate by more than is allowed [m].

    With a self influence `own` [m/Pa] those are wrong, and are none of them, on which a projected step of one cell
    leaves nothing. Cells at the hardness are free where their gap is more than is allowed.
    """
    pressure, displacement, separation = trial
    if trial.fits_machine_code(terms.hardness):
        region, count, wrong = planes.predict_active(*trial, depth=depth, least=-allowed, own=own)
        return Guess(region, count, wrong, region | (pressure > 0) if wrong else region)
    xp, carrying = namespace(pressure), pressure > 0
    gap = displacement + separation - depth
    region, wrong = carrying | (gap < -allowed), 0
    if terms.hardness < math.inf:
        held = pressure >= terms.hardness
        region = (region & ~held) | (held & (gap > allowed))
    if own < math.inf:
        pulls = region & (pressure * own < gap)
        region, wrong = region & ~pulls, int(xp.count_nonzero(pulls))
    return Guess(region, int(xp.count_nonzero(region)), wrong, region | carrying)


def _judged_at_once(judge: Judge, terms: Terms, trial: Trial) -> Verdict:
    seen = planes.extremes(*trial)
    if seen is None or (not seen.count and terms.depth is None):
        return Verdict(math.nan if terms.depth is None else terms.depth, math.inf, math.nan)
    depth = seen.level / seen.count if terms.depth is None else terms.depth
    residual = math.inf
    if seen.weakest >= 0:
        violation = max(depth - seen.lowest, seen.highest - depth)
        residual = judge.relative(violation, seen.displacement, seen.strongest)
    return Verdict(depth, residual, seen.displacement)
