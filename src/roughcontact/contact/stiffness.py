"""The stiffness of a frozen contact region: its force per unit displacement (thesis, eq. 4.1 and A.1.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import namespace
from roughcontact.contact.problem import ContactProblem
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.operator import Operator, exact_of, is_semidefinite, self_influence
from roughcontact.materials import Modulus
from roughcontact.progress.events import task
from roughcontact.solver.control import Tangent, checked_tolerance
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.prescribed import checked_region, prescribe
from roughcontact.validation import Array, Mask, numeric

__all__ = [
    "FrozenContact",
    "cell_stiffness",
    "contact_stiffness",
    "elastic_contact",
    "frozen_contact",
    "full_contact_stiffness",
]


TOLERANCE = 1e-7  # of the unit displacement; the error of the stiffness is about its square


@dataclass(frozen=True, slots=True, eq=False)
class FrozenContact:
    """The response of a region that is displaced as a whole, like a flat punch of its shape.

    Attributes
    ----------
    stiffness : float
        Force per unit displacement [N/m]; infinite for a whole periodic grid.
    residual : float
        Largest error of the unit displacement.
    tangent : array
        Pressure per unit displacement [Pa/m], zero outside the region.
    """

    stiffness: float
    residual: float
    tangent: Array


def elastic_contact(pressure: Array, hardness: float | Array) -> Mask:
    """Return the cells whose pressure grows on a further approach: it lies between zero and the hardness."""
    return (pressure > 0) & (pressure < hardness)


def frozen_contact(
    operator: Operator, region: Mask, *, tangent: Tangent | None = None, tolerance: float = TOLERANCE
) -> FrozenContact:
    """Return the response of `region` to a unit displacement; a given `tangent` is used or improved."""
    operator, xp = exact_of(operator), namespace(region)
    if not bool(xp.any(region)):
        return FrozenContact(0.0, 0.0, xp.zeros(region.shape, dtype=xp.float64, device=region.device))
    if is_semidefinite(operator) and bool(xp.all(region)):
        return FrozenContact(
            math.inf, 0.0, xp.full(region.shape, math.inf, dtype=xp.float64, device=region.device)
        )
    if tangent is not None and tangent.error <= tolerance:
        return FrozenContact(
            Measure(operator.weights, xp).total(tangent.pressure), tangent.error, tangent.pressure
        )
    initial = None if tangent is None else tangent.pressure
    with task("Stiffness of", shape=region.shape):
        answer = prescribe(operator, region, 1.0, tolerance, initial=initial)
    return FrozenContact(answer.work, answer.residual, answer.pressure)  # work per square of displacement


@numeric(modulus="Pa")
def contact_stiffness(
    mask: Mask,
    grid: AnyGrid,
    modulus: Modulus,
    *,
    operator: Operator | None = None,
    tolerance: float = TOLERANCE,
) -> float:
    """Return the stiffness of a given contact region pressed as a flat punch [N/m].

    Parameters
    ----------
    mask : bool array, shape ``grid.shape``
        The cells in contact; ones and zeros are accepted. Arrays of other libraries are processed on their devices.
    grid : Grid or RadialGrid
        Free or periodic.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    operator : Operator, optional
        A body other than the half-space on the grid; on a line the stiffness is per unit length [N/m^2].
    tolerance : float
        Largest error of the unit displacement on the region; between 1e-14 and 1e-2.

    Returns
    -------
    float
        Zero for an empty mask, infinite for a whole periodic grid.

    Raises
    ------
    ValueError
        If the mask does not fit the grid or holds numbers other than ones and zeros, or if the tolerance is out of
        range.
    RuntimeError
        If the tolerance was not reached.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> disc = ~np.isnan(rc.shapes.flat_disc(grid, radius=20e-6).heights)
    >>> f"{rc.contact_stiffness(disc, grid, 1e9) / (2 * 1e9 * 20e-6):.1f} of 2 E* a"
    '1.0 of 2 E* a'
    """
    region, tolerance = checked_region(mask, grid.shape), checked_tolerance(tolerance)
    body = body_on(grid, modulus, operator)
    frozen = frozen_contact(body, region, tolerance=tolerance)
    if frozen.residual > tolerance:
        raise RuntimeError(
            f"the stiffness was found only to {frozen.residual:.1e}; ask for a larger tolerance"
        )
    return frozen.stiffness


def cell_stiffness(operator: Operator) -> float:
    """Return the stiffness of a single cell in contact [N/m] (thesis, eq. 4.16 and its neighbour 4.15)."""
    influence = self_influence(operator)
    return float(np.ravel(operator.weights)[0]) / influence if influence > 0 else math.inf


def full_contact_stiffness(problem: ContactProblem) -> float:
    """Return the stiffness with all measured cells in contact [N/m]; infinite for a whole periodic surface.

    Its displacement has an error of a thousandth, small enough for a limit.
    """
    return problem.once(
        "full_contact_stiffness",
        lambda: frozen_contact(problem.operator, problem.measured, tolerance=1e-3).stiffness,
    )
