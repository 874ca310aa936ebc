"""Coulomb's law on a list of cells: tractions no larger than a limit, and slip against them.

Fields have shape ``(k, n)``: k components, one or two, of n cells.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

__all__ = ["AT_LIMIT", "at_limit", "directions", "lengths", "under_force", "violations", "within"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

AT_LIMIT = 1e-12  # part of the limit that is rounding: a traction as near to it is at it
FORCE = 1e-14  # of all the limits together: how well a sum over many cells meets a force
SINGULAR = 1e-12  # part of a slope that keeps it from being singular
PASSES = 100  # of Newton's method for the force, and of the search along a step of it: ten are many


def lengths(vectors: Array) -> Array:
    """Return the length of the vector of each cell, shape (n,)."""
    return np.asarray(np.abs(vectors[0]) if len(vectors) == 1 else np.hypot(vectors[0], vectors[1]))


def directions(vectors: Array, cells: Mask) -> Array:
    """Return unit vectors in `cells`, zero elsewhere."""
    size = lengths(vectors)
    return np.asarray(np.where(cells, vectors / np.where(size > 0, size, 1.0), 0.0))


def at_limit(traction: Array, limit: Array) -> Mask:
    """Return the cells whose traction is all that friction can hold."""
    return np.asarray(lengths(traction) >= limit * (1 - AT_LIMIT))


def within(traction: Array, limit: Array) -> Array:
    """Return the nearest traction that friction can hold."""
    size = lengths(traction)
    over = size > limit
    return np.asarray(traction * np.where(over, limit / np.where(over, size, 1.0), 1.0))


def violations(traction: Array, limit: Array, slip: Array) -> Array:
    """Return by how much each cell breaks Coulomb's law [m], shape (n,).

    Below the limit nothing may slip; at it, slip [m] is opposed to the traction, so that what counts is its distance
    from that ray. A traction beyond the limit is no answer at all.
    """
    held = at_limit(traction, limit)
    normal = directions(traction, held)
    forward = (slip * normal).sum(axis=0)
    astray = lengths(slip - forward * normal)
    violation = np.where(held & (forward <= 0), astray, lengths(slip))
    return np.where(lengths(traction) > limit * (1 + AT_LIMIT), np.inf, violation)


def under_force(traction: Array, limit: Array, total: Array) -> Array:
    """Return the nearest traction that friction can hold and that adds up to `total` over the cells.

    It is ``within(traction - shift, limit)`` with the shift that minimises a convex function, whose slope is the sum
    less what it exceeds `total` by: Newton's method, with a search along its steps.

    Parameters
    ----------
    traction : array, shape (k, n)
    limit : array, shape (n,)
    total : array, shape (k,)
        Shorter than the sum of the limits.
    """

    def excess(shift: Array) -> Array:
        return np.asarray(within(traction - shift[:, None], limit).sum(axis=1) - total)

    shift, enough = np.zeros(len(traction)), FORCE * (limit.sum() + np.abs(traction).sum())
    over = excess(shift)
    size = float(limit.max() + np.abs(traction).max())
    for _ in range(PASSES):
        if np.abs(over).max() <= enough:
            break
        direction = _newton_direction(traction - shift[:, None], limit, over)
        # Where the sum hardly falls any more, the direction leads far away.
        direction *= min(1.0, size / float(np.abs(direction).max()))
        shift, over = _searched(excess, shift, over, direction)
    return within(traction - shift[:, None], limit)


def _newton_direction(shifted: Array, limit: Array, over: Array) -> Array:
    """Return the shift that takes `over` away if the sum went on to fall as it does."""
    beyond = lengths(shifted) > limit
    part = (limit / np.where(beyond, lengths(shifted), 1.0))[beyond]
    normal = directions(shifted, beyond)[:, beyond]
    slope = ((~beyond).sum() + part.sum()) * np.eye(len(over)) - (part * normal) @ normal.T
    if not slope.trace() > 0:  # one component, and all cells at their limits
        return np.asarray(np.sign(over) * limit.max())
    return np.asarray(np.linalg.solve(slope + SINGULAR * slope.trace() * np.eye(len(over)), over))


def _searched(
    excess: Callable[[Array], Array], shift: Array, over: Array, direction: Array
) -> tuple[Array, Array]:
    """Return a shift along a direction, and its excess, where the excess along it is at most half as large."""
    least, most, part = 0.0, np.inf, 1.0
    start = float(direction @ over)
    for _ in range(PASSES):
        trial = shift + part * direction
        left = excess(trial)
        along = float(direction @ left)
        if abs(along) <= start / 2:
            break
        least, most = (part, most) if along > 0 else (least, part)
        part = (least + most) / 2 if most < np.inf else 8 * part
    return trial, left
