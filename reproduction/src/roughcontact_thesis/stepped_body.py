"""The stepped indenter of the thesis' figures 15 to 17 as a body of rings, to be pressed."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

import roughcontact as rc
from roughcontact.theory.springs.stepped import SteppedIndenter

__all__ = ["INDENTER", "MODULUS", "RINGS", "full_steps", "stepped_body"]

INDENTER = SteppedIndenter(radius=1.0, height=1.0, ratio=2.0, hurst=0.5)
"""C and H as the thesis states them; lengths in units of r0, heights in units of h0."""
MODULUS = 1.0  # forces in units of E* r0 h0, stiffnesses in units of E* r0
RINGS = 32  # a disc or step: stiffnesses are right to 2e-4
_WIDEST = 3.0  # times the height of all steps above: the wall has reached the next one before


def stepped_body(indenter: SteppedIndenter, count: int, rings: int = RINGS) -> rc.RadialProfile:
    """Return the first `count` cylinders as heights on rings, which are narrow where a step may carry load.

    Parameters
    ----------
    indenter : SteppedIndenter
    count : int
        Number of cylinders.
    rings : int
        On each of them.
    """
    radii, below = indenter.radii(count), np.cumsum(indenter.heights(count))
    # As cosines: narrow at the rims, where pressure grows without limit, and not in the centre.
    edges = [radii[0] * np.sin(np.pi / 2 * np.arange(rings + 1) / rings)]
    heights = [np.zeros(rings)]
    share = (1 - np.cos(np.pi * np.arange(1, rings + 1) / rings)) / 2
    for inner, outer, depth in zip(radii[:-1], radii[1:], below[:-1], strict=True):
        edges.append(inner + (outer - inner) * share)
        heights.append(np.full(rings, -depth))
    name = f"{count} cylinders, C = {indenter.ratio:g}, H = {indenter.hurst:g}"
    return rc.RadialProfile(np.concatenate(heights), rc.RadialGrid(np.concatenate(edges)), (name,))


def full_steps(
    body: rc.RadialProfile, operator: rc.Operator, count: int, rings: int = RINGS
) -> tuple[rc.Solution, ...]:
    """Return the contact just before cylinder n + 1 touches, for n below `count`.

    The wall comes down to the rim of the next cylinder, where the surface has sunk least.

    Parameters
    ----------
    body : RadialProfile
        Of more than `count` cylinders, see `stepped_body`.
    operator : Operator
        `ring` of its grid.
    count : int
        Number of states.
    rings : int
        On each cylinder of the body.
    """
    states = []
    for n in range(count):
        # Without what comes later, and with a little of the depth at which it would come anyway.
        alone = np.where(np.arange(body.grid.size) < (n + 1) * rings, body.heights, np.nan)
        part, rim = rc.RadialProfile(alone, body.grid), (n + 2) * rings - 1
        step = -float(body.heights[rim])

        def gap_of_next(depth: float, part: rc.RadialProfile, rim: int, step: float) -> float:
            sunk = rc.press(part, MODULUS, depth=depth, operator=operator).displacement[rim]
            return step + float(sunk) - depth

        depth = float(brentq(gap_of_next, step, _WIDEST * step, (part, rim, step), rtol=1e-10))
        states.append(rc.press(part, MODULUS, depth=depth, operator=operator))
    return tuple(states)
