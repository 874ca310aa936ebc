"""Coulomb's law on a list of cells: tractions no larger than a limit, and slip against them.

Fields have shape ``(k, n)``: k components, one or two, of n cells, in arrays of any library. Vectors of k entries that
belong to no cell are NumPy arrays.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from roughcontact.arrays import as_like, inner, namespace, on_host
from roughcontact.validation import Array, Mask

__all__ = ["AT_LIMIT", "at_limit", "directions", "lengths", "projected", "projected_to_force", "violations"]


AT_LIMIT = 1e-12  # relative rounding error of the limit: a traction this close to the limit is at the limit
FORCE = 1e-14  # relative to the sum of the limits: accuracy of a force as a sum over many cells
SINGULAR = 1e-12  # relative shift of a slope that keeps it from being singular
LARGE = 10.0  # times the limits: above it, rounding of the tractions costs the force some of its digits
PASSES = 100  # of Newton's method for the force, and of its line search: usually fewer than ten


def lengths(vectors: Array) -> Array:
    """Return the length of the vector of each cell, shape (n,)."""
    xp, x = namespace(vectors), vectors[0, :]
    return xp.abs(x) if vectors.shape[0] == 1 else xp.hypot(x, vectors[1, :])  # type: ignore[no-any-return]


def directions(vectors: Array, cells: Mask) -> Array:
    """Return unit vectors in `cells`, zero elsewhere."""
    xp, size = namespace(vectors), lengths(vectors)
    return xp.where(cells, vectors / xp.where(size > 0, size, 1.0), 0.0)  # type: ignore[no-any-return]


def at_limit(traction: Array, limit: Array) -> Mask:
    """Return the cells whose traction is at the limit of friction."""
    return lengths(traction) >= limit * (1 - AT_LIMIT)


def projected(traction: Array, limit: Array) -> Array:
    """Return the nearest traction that friction can hold."""
    xp, size = namespace(traction), lengths(traction)
    over = size > limit
    scaled: Array = traction * xp.where(over, limit / xp.where(over, size, 1.0), 1.0)
    return scaled


def violations(traction: Array, limit: Array, slip: Array) -> Array:
    """Return the violation of Coulomb's law in each cell [m], shape (n,).

    Below the limit no cell may slip. At the limit, slip [m] is opposed to the traction: its distance from that ray is
    the violation. A traction beyond the limit is not admissible.
    """
    xp, held = namespace(traction), at_limit(traction, limit)
    normal = directions(traction, held)
    forward = xp.sum(slip * normal, axis=0)
    astray = lengths(slip - forward * normal)
    violation = xp.where(held & (forward <= 0), astray, lengths(slip))
    return xp.where(lengths(traction) > limit * (1 + AT_LIMIT), np.inf, violation)  # type: ignore[no-any-return]


def projected_to_force(traction: Array, limit: Array, total: Array) -> Array:
    """Return the nearest traction that friction can hold and that adds up to `total` over the cells.

    It is ``projected(traction - shift, limit)`` with the shift that minimises a convex function, whose slope is
    `total` less the sum. The method is Newton's, with a line search.

    Parameters
    ----------
    traction : array, shape (k, n)
    limit : array, shape (n,)
    total : array, shape (k,)
        Shorter than the sum of the limits.
    """
    nearest = _nearest(traction, limit, total)
    if inner(traction, traction) <= LARGE**2 * inner(limit, limit):
        return nearest
    return _nearest(nearest, limit, total)  # again, without the rounding error of large tractions


def _nearest(traction: Array, limit: Array, total: Array) -> Array:
    """Return the result of `projected_to_force`, with a sum as accurate as the rounding of `traction`."""
    xp = namespace(traction)

    def shifted(shift: Array) -> Array:
        result: Array = traction - as_like(shift[:, None], traction)
        return result

    def excess(shift: Array) -> Array:
        return on_host(xp.sum(projected(shifted(shift), limit), axis=1)) - total

    shift = np.zeros(traction.shape[0])
    enough = FORCE * (float(xp.sum(limit)) + float(xp.sum(xp.abs(traction))))
    over = excess(shift)
    size = float(xp.max(limit)) + float(xp.max(xp.abs(traction)))
    for _ in range(PASSES):
        if np.abs(over).max() <= enough:
            break
        direction = _newton_direction(shifted(shift), limit, over)
        # Where the sum has almost stopped decreasing, the Newton step is far too long.
        direction *= min(1.0, size / float(np.abs(direction).max()))
        shift, over = _searched(excess, shift, over, direction)
    return projected(shifted(shift), limit)


def _newton_direction(shifted: Array, limit: Array, over: Array) -> Array:
    """Return the shift that would remove `over` if the sum were linear."""
    xp, size = namespace(shifted), lengths(shifted)
    beyond = size > limit
    part = xp.where(beyond, limit / xp.where(beyond, size, 1.0), 1.0)
    normal = directions(shifted, beyond)
    slope = float(xp.sum(part)) * np.eye(len(over)) - on_host((part * normal) @ normal.T)
    if not slope.trace() > 0:  # one component, and all cells at their limits
        return np.asarray(np.sign(over) * float(xp.max(limit)))
    return np.asarray(np.linalg.solve(slope + SINGULAR * slope.trace() * np.eye(len(over)), over))


def _searched(
    excess: Callable[[Array], Array], shift: Array, over: Array, direction: Array
) -> tuple[Array, Array]:
    """Return a shift along a direction at which the excess along it is at most half as large, and its excess."""
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
