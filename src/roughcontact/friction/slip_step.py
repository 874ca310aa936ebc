"""One step of tangential loading: what is asked, and how far an answer is from it."""

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
        Where the step starts [Pa], and how far the cells have slipped until then [m].
    force, shift : NumPy array, shape (k,), or None
        One of them: the force [N] or the displacement of the bodies [m] at the end of the step.
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
        """Return the state of a traction that friction can hold; its exact displacement is found if none is given."""
        moved = self.interface.apply(traction) if displacement is None else displacement
        normal = directions(traction, at_limit(traction, self.limit))
        shift = self.shift_of(moved, normal)
        slipped = self.slipped(moved, shift)
        residual = self.residual(traction, moved, slipped)
        return SlipState(traction, moved, displacement is None, normal, shift, slipped, residual)

    def energy(self, state: SlipState) -> float:
        """Return what is lowest at the end of the step [J per area of a cell]."""
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
        """Return the displacement of the bodies [m]: the one that is given, or that belongs to a traction.

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

        What is rounding of what the largest traction does in its own cell counts as no more: uniform traction on all
        cells of a period moves nothing, and there all is rounding.
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
    """A traction that friction can hold, and how far it is from the end of the step.

    Parameters
    ----------
    traction, displacement : array, shape (k, n)
        Of the cells [Pa], [m].
    exact : bool
        Whether the displacement is the exact product of this very traction: what a certificate stands on.
    normal : array, shape (k, n)
        Unit vectors of the traction in cells at their limit, zero elsewhere.
    shift : NumPy array, shape (k,)
        Displacement of the bodies [m].
    slipped : array, shape (k, n)
        Slip of the step [m], which is the slope of the energy.
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
    """The end of a step: traction [Pa], its displacement [m] on the cells, that of the bodies [m], and how good."""

    traction: Array
    displacement: Array
    shift: Array
    residual: float
    steps: int
    status: Status


def _common_displacement(level: Array, normal: Array, limit: Array, self_influence: float) -> Array:
    """Return the displacement [m] that the free parts of `level` have in common, shape (k,), as NumPy's array.

    Parameters
    ----------
    level : array, shape (k, n)
        Displacement of the cells less what they had slipped before [m]: less the answer it is their slip now.
    normal : array, shape (k, n)
        Unit vectors of the traction in cells at their limit, where only what lies across is free; zero elsewhere.
    limit : array, shape (n,)
        Largest traction [Pa].
    self_influence : float
        Displacement of a cell per traction on itself [m/Pa].

    Notes
    -----
    The mean with the weights of the preconditioner: a cell that slips far under little traction follows any
    displacement, and does not determine it.
    """
    xp = namespace(level)

    def forward_of(shift: Array) -> Array:
        return xp.sum((level - as_like(shift[:, None], level)) * normal, axis=0)  # type: ignore[no-any-return]

    across = level - xp.sum(level * normal, axis=0) * normal
    weight = xp.ones_like(limit)
    for _ in range(2):  # the weights need a first answer: which cells slip, and how far
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
