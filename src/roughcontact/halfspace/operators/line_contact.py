"""The half-space under loads that do not change along one direction: line contact, per unit length."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Periodic, Strip, Tables
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator, Sum
from roughcontact.halfspace.operators.operator import Capabilities, capabilities
from roughcontact.materials import Modulus, as_modulus
from roughcontact.validation import Array, numeric

__all__ = ["LineOperator", "line"]

Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class LineOperator:
    """A line is a plane of one row, one metre wide.

    Parameters
    ----------
    plane : InfluenceOperator
        On a grid of shape ``(1, n)`` and spacing ``(1, dx)``.
    """

    plane: InfluenceOperator

    @property
    def grid(self) -> Grid:
        """Grid of one axis."""
        plane = self.plane.grid
        return Grid(plane.shape[1:], plane.spacing[1:], plane.periodic[1:])

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol: what its plane can, except tiles."""
        plane = capabilities(self.plane)
        return Capabilities(
            exact=None if self.plane.exact is None else LineOperator(self.plane.exact),
            geometry=Geometry.LINE,
            modulus=plane.modulus,
            positive=plane.positive,
            single_precision=plane.single_precision,
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
        )

    @property
    def weights(self) -> float:
        """Width of a cell [m]: force per unit length of a unit pressure."""
        return self.plane.weights

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa], both of shape (n,)."""
        return self.plane.apply(pressure[None, ...])[0, ...]

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (all cells without)."""
        return self.plane.as_matrix(cells)

    def restrict(self, window: tuple[slice, ...]) -> LineOperator:
        """Return the map between the cells of `window`, with no pressure outside and the same reference length."""
        return LineOperator(self.plane.restrict((slice(0, 1), *window)))

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between a list of cells, with no pressure elsewhere."""
        return self.plane.submatrix(cells)

    def coarsened(self, grid: Grid) -> LineOperator | None:
        """Return the same body on `grid`, whose cells are larger; None for a window of a periodic one."""
        coarse = self.plane.coarsened(_plane(grid))
        return None if coarse is None else LineOperator(coarse)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]: every wave by E* q/2."""
        return self.plane.approximate_inverse(displacement[None, ...])[0, ...]


@numeric(modulus="Pa", reference_length="m")
def line(
    grid: Grid,
    modulus: Modulus,
    *,
    reference_length: float | None = None,
    method: Sum = "fft",
) -> LineOperator:
    """Return the half-space under loads that do not change along y: cylinders and rough lines.

    Everything is per unit length along y: forces [N/m], stiffness [N/m^2], energy [J/m], contact area [m].

    Parameters
    ----------
    grid : Grid
        Grid of one axis, free or periodic.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    reference_length : float, optional
        Of a free line: distance from a load at which its displacement is zero [m]; by default the grid's length.
        Depths depend on it, by ``2 F ln(L2/L1)/(pi E*)``: a line load sinks without bound into an endless body.
        Pressures at given force do not. With ``2 sqrt(R1 R2)/e`` the depth is the approach of the axes of two cylinders
        of one material, see the notes.
    method : {"fft", "moving-grid", "multilevel"}
        How the sum over the cells is done, see `half_space`; the latter two on a free line.

    Returns
    -------
    LineOperator
        Displacement [m] from pressure [Pa] on the cells of the line.

    Raises
    ------
    ValueError
        If the grid has two axes or is one of rings, the reference length is shorter than the grid or given for a
        periodic one, or the method is not for it.

    Notes
    -----
    Strips of constant pressure, and means of the displacement over strips (thesis, eqs A.37 to A.46 as
    corrected); a periodic line answers each wave by 2/(E* q), mean displacement zero.

    A cylinder of radius R that is pressed from two opposite sides is shortened, from the contact of half width a to its
    axis, by ``F (1 - nu^2)/(pi E) (2 ln(4 R/a) - 1)`` (Johnson, Contact Mechanics, 1985, section 5.6). The depth of
    Hertz' line contact is ``F/(pi E*) (2 ln(2 L/a) + 1)``. So the depth is the approach of the axes of two cylinders if
    ``L = (2/e) R1^w R2^(1 - w)``, w the share of the first body in 1/E*: ``2 sqrt(R1 R2)/e`` for one material, 0.74 of
    the geometric mean of their radii. The grid must be shorter than that.

    Examples
    --------
    >>> import math
    >>> import roughcontact as rc
    >>> grid = rc.Grid(256, 1e-6)
    >>> solution = rc.press(rc.shapes.paraboloid(grid, 1e-3), 1e9, force=1e2, operator=rc.line(grid, 1e9))
    >>> f"half width {math.sqrt(4 * 1e2 * 1e-3 / (math.pi * 1e9)) * 1e6:.1f} um by Hertz"
    'half width 11.3 um by Hertz'
    >>> f"width {solution.contact_area * 1e6:.0f} um"
    'width 22 um'
    """
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 1:
        raise InputError("a line contact needs a grid of one axis", "use Grid(n, spacing)")
    plane = _plane(grid)
    if all(grid.periodic):
        if reference_length is not None:
            raise InputError(
                "a periodic line has no reference length: its mean displacement is zero", "leave it out"
            )
        kernel: Periodic | Strip = Periodic(plane, value)
    else:
        length = grid.lengths[0]
        reference = length if reference_length is None else float(reference_length)
        if not (math.isfinite(reference) and reference >= length * (1 - 1e-9)):
            raise InputError(
                f"the reference length must be finite and at least that of the grid, {length:.10g} m, not "
                f"{reference:g}: with a shorter one a load would lift the far end"
            )
        kernel = Strip(plane.spacing, value, reference)
    body = InfluenceOperator(plane, Tables(kernel, plane.shape), positive=isinstance(kernel, Strip))
    return LineOperator(body.summed(method))


def _plane(grid: Grid) -> Grid:
    return Grid((1, *grid.shape), (1.0, *grid.spacing), (all(grid.periodic), *grid.periodic))
