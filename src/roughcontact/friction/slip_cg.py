"""Preconditioned conjugate gradients on the free part: both components where cells stick, rotation where they slip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import inner, namespace, on_host
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.validation import Array

__all__ = ["Correction", "Freedom", "corrected"]


@dataclass(frozen=True, slots=True, eq=False)
class Freedom:
    """The admissible changes of a traction, to first order.

    Parameters
    ----------
    normal : array, shape (k, n)
        Unit vectors in which the traction of slipping cells is fixed, zero in cells that stick.
    rotation : array, shape (n,)
        Ratio of slip to traction of slipping cells [m/Pa]: slip rotates with the traction that it opposes.
    held : bool
        Whether the force is given: then no change may have a resultant.
    """

    normal: Array
    rotation: Array
    held: bool

    def project(self, field: Array) -> Array:
        """Return the free part of a field."""
        along = namespace(field).sum(field * self.normal, axis=0)
        free: Array = field - along * self.normal
        return free


@dataclass(frozen=True, slots=True, eq=False)
class Correction:
    """A change of traction [Pa], its displacement [m], and the number of products."""

    traction: Array
    displacement: Array
    steps: int


def corrected(
    interface: ContactCells, freedom: Freedom, error: Array, *, reduction: float, max_steps: int
) -> Correction:
    """Return the free change of traction that removes `error` [m], by preconditioned conjugate gradients.

    Parameters
    ----------
    interface : ContactCells
    freedom : Freedom
    error : array, shape (k, n)
        Displacement that the change should add.
    reduction : float
        Part of the error, in the norm of the preconditioner, that may remain.
    max_steps : int
        Largest number of products.

    Notes
    -----
    In cells that stick, the preconditioner is the inverse of a periodic half-space, wave by wave. In cells that slip
    it is the diagonal: compared with rotation, the half-space is compliant only for long waves.
    """
    precondition = _preconditioner(interface, freedom)
    change, displacement, steps = interface.zeros(), interface.zeros(), 0
    r = freedom.project(error)
    z = precondition(r)
    s = z  # search direction
    rho = inner(r, z)
    enough = reduction**2 * rho
    while rho > enough and steps < max_steps:
        A_s = interface.estimate(s)
        steps += 1
        free_A_s = freedom.project(A_s) + freedom.rotation * s
        curvature = inner(s, free_A_s)
        if not curvature > 0:  # the search direction is only rounding
            break
        alpha = rho / curvature
        change += alpha * s
        displacement += alpha * A_s
        r = r - alpha * free_A_s
        z = precondition(r)
        rho, previous = inner(r, z), rho
        s = z + rho / previous * s
    return Correction(change, displacement, steps)


def _preconditioner(interface: ContactCells, freedom: Freedom) -> Callable[[Array], Array]:
    """Return a map from errors [m] to free changes of traction [Pa], without resultant if the force is held."""
    xp = namespace(freedom.normal)
    sticks = ~xp.any(freedom.normal != 0, axis=0)
    diagonal = 1 / (interface.self_influence + freedom.rotation)

    def answer(r: Array) -> Array:
        z = xp.where(sticks, interface.approximate_inverse(xp.where(sticks, r, 0.0)), r * diagonal)
        return freedom.project(z)

    if not freedom.held:
        return answer
    # Responses to common displacements; a combination of them removes a resultant.
    common = [answer(freedom.project(unit)) for unit in interface.units()]
    shares = np.linalg.pinv(np.array([on_host(xp.sum(z, axis=1)) for z in common]).T)

    def without_resultant(r: Array) -> Array:
        z = answer(r)
        for part, response in zip(shares @ on_host(xp.sum(z, axis=1)), common, strict=True):
            z -= float(part) * response
        return z

    return without_resultant
