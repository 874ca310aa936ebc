"""One step of tangential loading: the problem, and the residual of a state."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import as_like, inner, namespace, on_host
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.friction.coulomb import (
    at_limit,
    directions,
    lengths,
    projected,
    projected_to_force,
    violations,
)
from roughcontact.solver.control import Status
from roughcontact.solver.optimality import ROUNDING_FLOOR
from roughcontact.validation import Array

__all__ = ["SlipState", "SlipStep", "Slipped"]


@dataclass(frozen=True, slots=True, eq=False)
class SlipStep:
    """One step of tangential loading, from a state of rest to another.

    Parameters
    ----------
    interface : ContactCells
    limit : array, shape (n,)
        Largest traction of each cell [Pa].
    traction, slip : array, shape (k, n)
        Traction at the start of the step [Pa], and slip of the cells until then [m].
    force, shift : NumPy array, shape (k,), or None
        One of the two: the force [N] or the displacement of the bodies [m] at the end of the step.
    scale : float
        Largest displacement of a cell at the start [m].
    tolerance : float
        Largest residual.
    """

    interface: ContactCells
    limit: Array
    traction: Array
    slip: Array
    force: Array | None
    shift: Array | None
    scale: float
    tolerance: float

    def state(self, traction: Array, displacement: Array | None = None) -> SlipState:
        """Return the state of a traction that friction can hold; by default with its exact displacement."""
        moved = self.interface.apply(traction) if displacement is None else displacement
        normal = directions(traction, at_limit(traction, self.limit))
        shift = self.shift_of(moved, normal)
        slipped = self.slipped(moved, shift)
        residual = self.residual(traction, moved, slipped)
        return SlipState(traction, moved, displacement is None, normal, shift, slipped, residual)

    def energy(self, state: SlipState) -> float:
        """Return the energy that is minimal at the end of the step [J per area of a cell]."""
        stored = inner(state.traction, state.displacement / 2 - self.slip)
        if self.shift is None:  # the work of a given force is the same for all tractions that add up to it
            return stored
        return stored - float(self.shift @ on_host(namespace(state.traction).sum(state.traction, axis=1)))

    def admitted(self, traction: Array) -> Array:
        """Return the nearest traction that friction can hold, under the force if one is given."""
        if self.force is None:
            return projected(traction, self.limit)
        return projected_to_force(traction, self.limit, self.force / self.interface.area)

    def shift_of(self, displacement: Array, normal: Array) -> Array:
        """Return the displacement of the bodies [m]: the given one, or that of a traction.

        `normal` are unit vectors of the traction in the cells at their limit, zero elsewhere.
        """
        if self.shift is not None:
            return self.shift
        level = displacement - self.slip
        return _common_displacement(level, normal, self.limit, self.interface.self_influence)

    def slipped(self, displacement: Array, shift: Array) -> Array:
        """Return the slip of the step [m]."""
        moved: Array = displacement - as_like(shift[:, None], displacement)
        return moved - self.slip

    def residual(self, traction: Array, displacement: Array, slipped: Array) -> float:
        """Return the largest violation of Coulomb's law relative to the largest displacement of the step.

        The scale is at least the rounding error of the largest displacement by the traction of the same cell: a
        uniform traction on all cells of a period displaces nothing, and only rounding is left.
        """
        xp = namespace(traction)
        violation = float(xp.max(violations(traction, self.limit, slipped)))
        if violation == 0:
            return 0.0
        scale = max(self.scale, float(xp.max(lengths(displacement))))
        relative = violation / scale if scale > 0 else math.inf
        rounding = ROUNDING_FLOOR * self.interface.self_influence * float(xp.max(lengths(traction)))
        return min(relative, ROUNDING_FLOOR) if violation <= rounding else relative


@dataclass(frozen=True, slots=True, eq=False)
class SlipState:
    """A traction that friction can hold, and its residual in the step.

    Parameters
    ----------
    traction, displacement : array, shape (k, n)
        Of the cells [Pa], [m].
    exact : bool
        Whether the displacement is the exact product of this traction, as a certificate requires.
    normal : array, shape (k, n)
        Unit vectors of the traction in cells at their limit, zero elsewhere.
    shift : NumPy array, shape (k,)
        Displacement of the bodies [m].
    slipped : array, shape (k, n)
        Slip of the step [m], the gradient of the energy.
    residual : float
    """

    traction: Array
    displacement: Array
    exact: bool
    normal: Array
    shift: Array
    slipped: Array
    residual: float


@dataclass(frozen=True, slots=True, eq=False)
class Slipped:
    """The end of a step: traction [Pa], its displacement [m] on the cells, that of the bodies [m], and its residual."""

    traction: Array
    displacement: Array
    shift: Array
    residual: float
    steps: int
    status: Status


def _common_displacement(level: Array, normal: Array, limit: Array, self_influence: float) -> Array:
    """Return the displacement [m] that the free parts of `level` have in common, shape (k,), as a NumPy array.

    Parameters
    ----------
    level : array, shape (k, n)
        Displacement of the cells less their earlier slip [m]; less the result it is their present slip.
    normal : array, shape (k, n)
        Unit vectors of the traction in cells at their limit, where only changes across them are free; zero elsewhere.
    limit : array, shape (n,)
        Largest traction [Pa].
    self_influence : float
        Displacement of a cell per traction on itself [m/Pa].

    Notes
    -----
    It is the mean with the weights of the preconditioner: a cell that slips far under little traction follows any
    displacement and does not determine it.
    """
    xp = namespace(level)

    def forward_of(shift: Array) -> Array:
        return xp.sum((level - as_like(shift[:, None], level)) * normal, axis=0)  # type: ignore[no-any-return]

    across = level - xp.sum(level * normal, axis=0) * normal
    weight = xp.ones_like(limit)
    for _ in range(2):  # the weights need a first result: which cells slip, and how far
        free = float(xp.sum(weight)) * np.eye(level.shape[0]) - on_host((weight * normal) @ normal.T)
        shift = np.asarray(np.linalg.lstsq(free, on_host(across @ weight), rcond=None)[0], np.float64)
        forward = forward_of(shift)
        weight = 1 / (1 + xp.clip(-forward, 0.0, None) / (limit * self_influence))
    if bool(xp.all(xp.any(normal != 0, axis=0) & (forward > 0))):
        # All slip, and all the wrong way: the free part does not determine the shift. None slips forward from here on:
        pull = on_host(normal @ limit)
        pull /= np.sqrt(pull @ pull)
        leaning = as_like(pull, normal) @ normal
        if bool(xp.all(leaning > 0)):
            mean = on_host(xp.mean(level, axis=1))
            return np.asarray(mean + pull * float(xp.max(forward_of(mean) / leaning)))
    return shift
