"""The tangential stiffness of a contact region that sticks: its force per unit displacement."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import inner, namespace
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.friction.slip_cg import Freedom, corrected
from roughcontact.friction.slip_problem import shear_body
from roughcontact.grid import Grid
from roughcontact.halfspace.shear.shear_operator import ShearOperator
from roughcontact.material import Bodies
from roughcontact.solver.control import checked_tolerance
from roughcontact.solver.prescribed import checked_region
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, Mask

__all__ = ["TangentialStiffness", "displaced", "frozen_shear", "tangential_stiffness"]


TOLERANCE = 1e-7  # of the unit displacement; the relative error of the stiffness is about its square
MAX_STEPS = 5000


@dataclass(frozen=True, slots=True, eq=False)
class TangentialStiffness:
    """The response of a sticking region to a common displacement.

    Attributes
    ----------
    matrix : array, shape (2, 2)
        Force along x and y [N] per displacement along x and y [m]; symmetric. Zero for an empty region, infinite on
        the diagonal for the whole periodic grid.
    residual : float
        Largest error of the unit displacements.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> strip = np.zeros((16, 16), bool)
    >>> strip[6:10, 2:14] = True  # four by twelve cells, the longer side along x
    >>> stiffness = rc.tangential_stiffness(strip, rc.Grid((16, 16), 1e-6), rc.Solid(1e9, 0.3))
    >>> values, directions = stiffness.principal
    >>> values.round(), abs(directions[0]).round(6)
    (array([7048., 7654.]), array([1., 0.]))
    """

    matrix: Array
    residual: float

    @property
    def principal(self) -> tuple[Array, Array]:
        """The two principal stiffnesses [N/m], the smaller first, and their directions (x, y), one a row."""
        if not np.isfinite(self.matrix).all():
            return np.diag(self.matrix), np.eye(2)
        values, vectors = np.linalg.eigh(self.matrix)
        return values, vectors.T


def tangential_stiffness(
    mask: Mask,
    grid: Grid,
    bodies: Bodies,
    *,
    operator: ShearOperator | None = None,
    tolerance: float = TOLERANCE,
) -> TangentialStiffness:
    """Return the stiffness of a given contact region against tangential displacement, if no cell slips.

    For a disc it is 2 G* a in every direction (Mindlin 1949; thesis, eq. 4.5), which is the normal stiffness divided
    by E*/G*. For other regions it depends on the direction: along the longer side of a rectangle it is smaller.

    Parameters
    ----------
    mask : bool array, shape ``grid.shape``
        The cells in contact, for instance ``solution.contact``. For arrays of another library the computation runs in
        that library.
    grid : Grid
        Of two axes, free or periodic.
    bodies : Solid or pair of Solids
        A single solid is pressed against a rigid body. The coupling of normal and tangential displacements of unlike
        bodies is neglected.
    operator : ShearOperator, optional
        Another body than the half-spaces on the grid.
    tolerance : float
        Largest error of the unit displacement on the region; between 1e-14 and 1e-2.

    Returns
    -------
    TangentialStiffness
        The matrix of force per displacement [N/m] and its residual.

    Raises
    ------
    ValueError
        If the mask does not fit the grid or holds other numbers than ones and zeros, if the grid has not two
        axes, or if the tolerance is out of range.
    RuntimeError
        If the tolerance was not reached.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> strip = np.zeros((16, 16), bool)
    >>> strip[6:10, 2:14] = True  # four by twelve cells, the longer side along x
    >>> along, across = np.diag(rc.tangential_stiffness(strip, rc.Grid((16, 16), 1e-6), rc.Solid(1e9, 0.3)).matrix)
    >>> bool(along < across)
    True
    """
    body = shear_body(grid, bodies, operator)
    cells, tolerance = checked_region(mask, grid.shape), checked_tolerance(tolerance)
    frozen = frozen_shear(body, cells, tolerance=tolerance)
    if not frozen.residual <= tolerance:
        raise RuntimeError(
            f"the residual of the stiffness is only {frozen.residual:.1e}; ask for a larger tolerance"
        )
    return frozen


@one_blas_thread()
def frozen_shear(
    operator: ShearOperator, region: Mask, *, tolerance: float = TOLERANCE
) -> TangentialStiffness:
    """Return the result of `tangential_stiffness` with the residual that was reached, whatever it is."""
    if not bool(namespace(region).any(region)):
        return TangentialStiffness(np.zeros((2, 2)), 0.0)
    interface = ContactCells.of(operator, region)
    if interface.floating:
        return TangentialStiffness(np.diag([math.inf, math.inf]), 0.0)
    xp = namespace(region)
    answers = [displaced(interface, unit, tolerance) for unit in interface.units()]
    # With the products of errors and tractions added, the error of the whole matrix is a product of two errors.
    matrix = np.array(
        [
            [float(xp.sum(traction[of, :])) + inner(other, error) for of, (other, _) in enumerate(answers)]
            for traction, error in answers
        ]
    )
    residual = max(float(xp.max(xp.abs(error))) for _, error in answers)
    return TangentialStiffness((matrix + matrix.T) / 2 * interface.area, residual)


def displaced(interface: ContactCells, wanted: Array, tolerance: float) -> tuple[Array, Array]:
    """Return the traction for the given displacements of the cells, and its errors from a separate exact product."""
    xp, traction = namespace(wanted), interface.zeros()
    sticks = Freedom(traction, traction[0, :], held=False)
    error, worst, steps = wanted, 1.0, 0
    while worst > tolerance and steps < MAX_STEPS:
        found = corrected(
            interface, sticks, error, reduction=0.1 * tolerance / worst, max_steps=MAX_STEPS - steps
        )
        traction = traction + found.traction
        error = wanted - interface.apply(traction)
        before, worst, steps = worst, float(xp.max(xp.abs(error))), steps + found.steps + 1
        if worst > 0.9 * before:  # rounding prevents further progress
            break
    return traction, error
