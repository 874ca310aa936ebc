"""Projected descent of the energy of a step of partial slip: the safeguard of Newton's method."""

from __future__ import annotations

from roughcontact.arrays import inner
from roughcontact.friction.slip_step import SlipState, SlipStep
from roughcontact.validation import Array

__all__ = ["descended"]

GRADIENT_STEPS = 3  # of a descent: enough to find the cells that slip; Newton's method is faster at the rest
SUFFICIENT = 0.1  # part of what the slope promises that must come true
SHORTER, MUCH_SHORTER = 0.5, 0.1  # bounds of what a trial that went too far is shortened by
TRIALS = 20  # of a gradient step: what is wrong after so many is rounding


def descended(step: SlipStep, state: SlipState, trial: SlipState) -> tuple[SlipState, int]:
    """Return a state of lower energy than `state`, from which a `trial` went too far, and the number of products.

    First to the lowest point between the two, at no cost: whatever lies between is within the limits too, and the
    energy is quadratic. Then along its slope, projected on the limits, as far as the curvature that was last met allows
    (Barzilai and Borwein, IMA J. Numer. Anal. 8, 141 (1988)), or less, until the energy falls in proportion
    (Bertsekas, IEEE Trans. Autom. Control 21, 174 (1976)): a sequence of such steps cannot but end at the minimum,
    which is the only one.
    """
    slope, curvature, square = _between(state, trial)
    part = min(1.0, -slope / curvature) if slope < 0 < curvature else 0.0
    if part > 0:
        state = trial if part == 1 else step.state(*_mixed(state, trial, part))
    length = square / curvature if curvature > 0 else 1 / step.interface.self_influence
    steps = 0
    for _ in range(GRADIENT_STEPS):
        for _ in range(TRIALS):
            reached = step.state(step.admitted(state.traction - length * state.slipped))
            steps += 1
            slope, curvature, square = _between(state, reached)
            if slope + curvature / 2 <= SUFFICIENT * slope:
                break
            length *= max(MUCH_SHORTER, min(SHORTER, -slope / curvature)) if curvature > 0 else SHORTER
        else:
            break
        state = reached
        length = square / curvature if curvature > 0 else length
    return state, steps


def _between(state: SlipState, other: SlipState) -> tuple[float, float, float]:
    """Return slope and curvature of the energy from one state to another, and the squared distance."""
    way = other.traction - state.traction
    curvature = inner(way, other.displacement - state.displacement)
    return inner(state.slipped, way), curvature, inner(way, way)


def _mixed(state: SlipState, other: SlipState, part: float) -> tuple[Array, Array]:
    """Return traction and displacement a part of the way from one state to another."""
    return (
        state.traction + part * (other.traction - state.traction),
        state.displacement + part * (other.displacement - state.displacement),
    )
