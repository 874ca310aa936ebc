"""Summits that push each other down, and Newton's method for their balance.

The unknowns are the signed compressions w of all summits: ``w_i + sum_j F_j/(pi E* r_ij) + fall_i - d = 0`` with
``F_j = (4/3) E* sqrt(R_j) max(w_j, 0)^(3/2)``, its fall below the highest summit, and the depth d of the flat. If w is
negative, the summit does not touch and -w is its gap: one smooth equation holds for all summits, and no set of
contacts has to be guessed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.theory.tools.roots import concave_root
from roughcontact.validation import Array, number, positive, require, require_numbers

__all__ = ["Asperities", "balance", "independent_depth"]

TOLERANCE = 1e-12  # of the balance over the depth of the flat, and of the force
STEPS = 60
SHORTEST = 1e-4  # fraction of a Newton step
MOST = 5e7  # numbers in the matrix of influences, 0.4 GB


@dataclass(frozen=True, slots=True, eq=False)
class Asperities:
    """Summits of a surface on an elastic half-space.

    Parameters
    ----------
    x, y : array, shape (n,)
        Positions [m]; for the summits of a surface: columns and rows times the spacing.
    height : array, shape (n,)
        Height above a common plane [m].
    radius : array, shape (n,)
        Radius of curvature [m].
    modulus : float
        Reduced modulus E* [Pa].

    Raises
    ------
    ValueError
        If the arrays are not of one length, not finite, a radius is not positive, or two summits are in one place.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import asperities
    >>> x, y = np.array([0.0, 1e-3]), np.zeros(2)
    >>> summits = asperities.Asperities(x, y, np.array([0.0, -1e-6]), np.full(2, 1e-3), modulus=1e9)
    >>> summits.fall.tolist(), asperities.press(summits, depth=5e-7).count  # the lower one is not reached
    ([0.0, 1e-06], 1)
    """

    x: Array
    y: Array
    height: Array
    radius: Array
    modulus: float

    def __post_init__(self) -> None:
        require_numbers(self)
        for name in ("x", "y", "height", "radius"):
            given = np.array(number(getattr(self, name), f"{name} [m]"), ndmin=1)
            require(np.isfinite(given), f"{name} must be finite [m]", place=name)
            require(
                given.ndim == 1 and given.size > 0 and given.size == np.size(self.x),
                f"x, y, height and radius must be of one length above 0, not {name} of shape {given.shape}",
                place=name,
            )
            object.__setattr__(self, name, given)
        positive(self.radius, "a radius [m]")
        positive(self.modulus, "the reduced modulus [Pa]")
        places = np.unique(np.stack([self.x, self.y]), axis=1)
        require(places.shape[1] == self.x.size, "two summits are in the same place", "remove the lower one")

    @property
    def fall(self) -> Array:
        """Distance of each summit below the highest one [m], shape (n,)."""
        return np.asarray(self.height.max() - self.height)

    @property
    def coefficient(self) -> Array:
        """Coefficient of Hertz' law, force over compression to the power 3/2 [N/m^1.5], shape (n,)."""
        return np.asarray(4 / 3 * self.modulus * np.sqrt(self.radius))


@dataclass(frozen=True, slots=True, eq=False)
class _State:
    """A trial: compressions and the depth of the flat, with their residuals."""

    compression: Array  # w, signed, shape (n,)
    depth: float
    touching: npt.NDArray[np.intp]  # indices, shape (m,)
    influence: Array  # deflection of any summit per compression of a touching summit, shape (n, m)
    rate: Array  # dF/dw = 2 E* a, shape (m,)
    excess: Array  # left side of the balance, shape (n,)
    missing: float  # force still to be found
    error: float


def balance(asperities: Asperities, depth: float, force: float | None = None) -> tuple[Array, float, float]:
    """Return the compression of each summit (0 without contact) [m], the depth of the flat [m], and dF/dd [N/m].

    Parameters
    ----------
    asperities : Asperities
    depth : float
        Displacement of the flat since it touched the highest summit [m]; with a force only an initial guess.
    force : float, optional
        Total force on the summits [N].

    Raises
    ------
    ValueError
        If the matrix of influences of the summits in reach does not fit in memory.
    RuntimeError
        If the iteration does not converge.
    """
    state = _state(asperities, depth - asperities.fall, depth, force)
    for _ in range(STEPS):
        touching = state.touching
        tangent = state.influence[touching] + np.eye(touching.size)
        sides = np.stack([-state.excess[touching], np.ones(touching.size)], axis=1)
        own, with_flat = np.linalg.solve(tangent, sides).T
        stiffness = float(state.rate @ with_flat)
        if state.error <= TOLERANCE:
            return np.maximum(state.compression, 0.0), state.depth, stiffness
        deeper = 0.0 if force is None else float(state.missing - state.rate @ own) / stiffness
        change = own + deeper * with_flat
        step = deeper - state.excess - state.influence @ change
        step[touching] = change
        state = _search(asperities, state, step, deeper, force)
    raise RuntimeError(
        f"the balance of {asperities.fall.size} summits was met to {state.error:.2g} instead of {TOLERANCE:g} "
        f"in {STEPS} steps: spots have probably merged; use a smaller load"
    )


def independent_depth(asperities: Asperities, force: float) -> float:
    """Return the depth of the flat [m] at which summits without interaction carry a force [N]."""
    fall, coefficient = asperities.fall, asperities.coefficient

    def minus_force(depth: Array) -> tuple[Array, Array]:
        excess = np.maximum(depth - fall, 0.0)
        return np.array([-(excess**1.5 @ coefficient)]), np.array([-1.5 * (np.sqrt(excess) @ coefficient)])

    # With only the highest summit, the depth would be larger.
    start = (force / coefficient[np.argmin(fall)]) ** (2 / 3)
    return float(concave_root(minus_force, np.array([-force]), np.array([start]), scale=0.0)[0])


def _state(asperities: Asperities, compression: Array, depth: float, force: float | None) -> _State:
    modulus = asperities.modulus
    touching = np.flatnonzero(compression > 0)
    require(
        touching.size * compression.size <= MOST,
        f"{touching.size} of {compression.size} summits are in reach of the flat",
        "take a smaller load, or a surface without its shortest waves",
    )
    w, radius = compression[touching], asperities.radius[touching]
    spot = np.sqrt(radius * w)
    forces = asperities.coefficient[touching] * w**1.5
    dx = asperities.x[:, None] - asperities.x[touching]
    dy = asperities.y[:, None] - asperities.y[touching]
    distance = np.sqrt(dx**2 + dy**2)
    distance[touching, np.arange(touching.size)] = np.inf  # its own contribution is w
    inside = distance < spot
    influence = np.divide(1 / (math.pi * modulus), distance, out=distance)
    # Inside a spot r is limited to its radius. The deflection there, F/(pi E* a), is linear in w. With 1/r instead,
    # either of two close summits could carry the whole force: the solution would not be unique.
    deflection = np.minimum(influence, 1 / (math.pi * modulus * spot)) @ forces
    excess = compression + deflection + asperities.fall - depth
    rate = 2 * modulus * spot
    influence *= rate
    influence[inside] = 4 / (3 * math.pi)
    missing = 0.0 if force is None else force - float(forces.sum())
    # A summit without contact is only wrong if it should touch.
    off = np.maximum(compression - excess, 0.0)
    off[touching] = np.abs(excess[touching])
    error = float(off.max()) / abs(depth)
    if force is not None:
        error = max(error, abs(missing) / force)
    return _State(compression, depth, touching, influence, rate, excess, missing, error)


def _search(asperities: Asperities, state: _State, step: Array, deeper: float, force: float | None) -> _State:
    """Return the first step of a line search by halving that reduces the residual."""
    length = 1.0
    while True:
        trial = _state(asperities, state.compression + length * step, state.depth + length * deeper, force)
        if length < SHORTEST or (trial.touching.size and trial.error <= (1 - 1e-3 * length) * state.error):
            return trial
        length /= 2
