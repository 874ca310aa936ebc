"""Projected descent of the energy of a step of partial slip: the safeguard of Newton's method."""

from __future__ import annotations

from roughcontact.arrays import inner
from roughcontact.friction.slip_step import SlipState, SlipStep
from roughcontact.validation import Array

__all__ = ["descended"]

GRADIENT_STEPS = 3  # of a descent: enough to find the cells that slip; afterwards Newton's method is faster
SUFFICIENT = 0.1  # part of the decrease predicted by the slope that must be reached
SHORTER, MUCH_SHORTER = 0.5, 0.1  # bounds of the factor that shortens a trial that went too far
TRIALS = 20  # of a gradient step: after this number only rounding is left


def descended(step: SlipStep, state: SlipState, trial: SlipState) -> tuple[SlipState, int]:
    """Return a state of lower energy than `state`, from which a `trial` went too far, and the number of products.

    The first step goes to the lowest point between the two, at no cost: all states between them are within the limits,
    and the energy is quadratic. The next steps follow the negative gradient, projected onto the limits. Their length
    follows from the last curvature (Barzilai and Borwein, IMA J. Numer. Anal. 8, 141 (1988)) and is reduced until the
    energy falls in proportion (Bertsekas, IEEE Trans. Autom. Control 21, 174 (1976)). A sequence of such steps
    converges to the unique minimum.
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
    """Return traction and displacement at a fraction of the way from one state to another."""
    return (
        state.traction + part * (other.traction - state.traction),
        state.displacement + part * (other.displacement - state.displacement),
    )
