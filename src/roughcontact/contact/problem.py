"""The contact problem: a separation, an operator, and a control."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np

from roughcontact.arrays import is_numpy, namespace
from roughcontact.contact.flow import Flow
from roughcontact.contact.size_law import SizeLaw
from roughcontact.errors import InputError, about
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, exact_of, geometry_of, is_semidefinite
from roughcontact.kernels import buffers
from roughcontact.labels.engineering_units import written
from roughcontact.labels.variables import unit_of
from roughcontact.materials import Material
from roughcontact.solver.control import Control, Depth, Force, Specification, checked_tolerance
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.projection import bearing_force
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.units import PLAIN, in_si
from roughcontact.validation import Array, Mask, scalar

__all__ = [
    "Body",
    "ContactProblem",
    "separation_of",
]

T = TypeVar("T")

Body = Surface | RadialProfile
"""A body that can be pressed: heights on a grid."""


_UNITS = {"separation": "m", "modulus": "Pa", "hardness": "Pa", "rise": "m", "lifting": "J"}
# Rounding of a mean over any number of cells: a depth equal to the mean, as the user computes it, is allowed.
ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class ContactProblem:
    """Find a pressure with ``gap >= 0, pressure >= 0, pressure * gap = 0`` (thesis, eqs A.2 to A.5).

    Parameters
    ----------
    separation : array, shape ``operator.grid.shape``
        Undeformed gap at first touch [m]: zero at its smallest, infinite where nothing was measured.
    operator : Operator
        Displacement [m] from pressure [Pa].
    control : Force or Depth
        The prescribed force or depth.
    tolerance : float
        Largest residual of a solution, see ``roughcontact.solver.optimality``.
    surface : Surface or RadialProfile, optional
        The surface that the separation comes from.
    modulus : float
        Reduced modulus E* [Pa], for the record; NaN if the operator does not have it.
    hardness : float or array, shape of the grid
        Pressure that no cell exceeds [Pa]. Cells at this pressure are perfectly plastic: the flat may stand below their
        surface.
    size_law : function, optional
        Hardness [Pa] from the radii of contact spots [m], see `roughcontact.NixGao`; in the problem of a solution,
        `hardness` holds its values.
    rise : float
        Rise of the surface by flow [m]; the separation includes it.
    lifting : float
        Work of this rise against the force along the loads so far [J]; NaN if unknown.
    flow : Flow, optional
        Flow under larger loads; the separation includes it.
    softer : Material, optional
        The softer body, if the bodies were given as materials; its hardness does not limit the pressure here.

    Raises
    ------
    ValueError
        If the separation does not fit the operator's grid, the tolerance or hardness is out of range, or the control
        cannot be met.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 1e-6)
    >>> gap = -rc.shapes.paraboloid(grid, radius=1e-4).heights
    >>> problem = rc.ContactProblem(gap - gap.min(), rc.half_space(grid, 1e9), rc.Force(1e-3))
    >>> problem.missing, problem.geometry.value
    (0, 'surface')
    """

    separation: Array
    operator: Operator
    control: Control
    tolerance: float = 1e-8
    surface: Body | None = None
    modulus: float = math.nan
    hardness: float | Array = math.inf
    size_law: SizeLaw | None = None
    rise: float = 0.0
    lifting: float = 0.0
    flow: Flow | None = None
    softer: Material | None = None
    _memo: dict[str, Any] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        for name, unit in _UNITS.items():
            if type(value := getattr(self, name)) not in PLAIN:
                object.__setattr__(self, name, in_si(value, unit, name))
        if tuple(self.separation.shape) != self.grid.shape:
            raise InputError(
                f"a separation of shape {self.separation.shape} does not fit the operator's grid {self.grid.shape}",
                place="separation",
            )
        checked_tolerance(self.tolerance)
        if isinstance(self.hardness, int | float):
            if not scalar(self.hardness, "hardness") > 0:
                raise about("the hardness", f"must be positive [Pa], not {self.hardness}")
        elif tuple(self.hardness.shape) != self.grid.shape:
            raise InputError(
                f"a hardness is one number [Pa], or one for each cell of the grid {self.grid.shape}, not an array of "
                f"shape {tuple(self.hardness.shape)}",
                place="hardness",
            )
        if isinstance(self.control, Force) and self.plastic:
            strongest = bearing_force(self.measure, self.measured, self.spec)
            if self.control.value >= strongest:
                unit = unit_of("force", self.geometry)
                given, most = written(self.control.value, unit, 6), written(strongest, unit, 6)
                raise InputError(
                    f"a force of {given} exceeds {most}, the most that all measured cells can carry at this hardness",
                    "press by less, or give a greater hardness",
                    "force",
                )
        if not (isinstance(self.control, Depth) and self.semidefinite) or self.missing:
            return  # missing cells never touch and may bulge: there is no full contact
        if self.plastic or self.size_law is not None:
            return  # a plastic body can be pressed to any depth
        mean = self.mean_separation
        # Flow is accurate to the tolerance of the load that caused it.
        allowed = ROUNDING if self.flow is None else max(ROUNDING, self.tolerance)
        if self.control.value > mean * (1 + allowed):
            raise InputError(
                f"a depth of {self.control.value:.6g} m exceeds the mean separation {mean:.6g} m: there a periodic "
                "surface is in full contact and its stiffness infinite",
                "give a smaller depth, or a force",
                "depth",
            )

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for copies and pickles, without the values of `once`: not all of them can be pickled."""
        return vars(self) | {"_memo": {}}

    @property
    def grid(self) -> AnyGrid:
        """The grid of the operator."""
        return self.operator.grid

    @property
    def measured(self) -> Mask:
        """Cells that hold a height."""
        return self.measure.xp.isfinite(self.separation)  # type: ignore[no-any-return]

    @property
    def missing(self) -> int:
        """Number of cells without a height."""
        return int(self.measure.xp.count_nonzero(~self.measured))

    @property
    def spec(self) -> Specification:
        """The specification for the solver."""
        return Specification(self.control, self.tolerance, self.hardness)

    @property
    def geometry(self) -> Geometry:
        """Geometry of the cells; the units of the results depend on it."""
        return geometry_of(self.operator)

    @property
    def semidefinite(self) -> bool:
        """Whether a constant pressure causes no displacement."""
        return is_semidefinite(self.operator)

    @property
    def plastic(self) -> bool:
        """Whether a hardness limits the pressure."""
        return self.spec.plastic

    @property
    def first_touch(self) -> float:
        """Depth of first touch [m]: not zero if the surface has flowed."""
        if self.flow is None:
            return -self.rise
        return self.once("first_touch", lambda: float(self.measure.xp.min(self.separation)))

    @property
    def measure(self) -> Measure:
        """Sums over the cells, with the array library of the fields."""
        return self.once("measure", lambda: Measure(self.operator.weights, namespace(self.separation)))

    def under(self, control: Control) -> ContactProblem:
        """Return the same bodies under another control.

        Parameters
        ----------
        control : Force or Depth
            The new force or depth.

        Returns
        -------
        ContactProblem
            It shares the values of `once`.

        Raises
        ------
        ValueError
            If the control cannot be met.

        Examples
        --------
        >>> import roughcontact as rc
        >>> grid = rc.Grid((32, 32), 1e-6)
        >>> gap = -rc.shapes.paraboloid(grid, radius=1e-4).heights
        >>> problem = rc.ContactProblem(gap - gap.min(), rc.half_space(grid, 1e9), rc.Force(1e-3))
        >>> problem.under(rc.Depth(1e-7)).control
        Depth(value=1e-07)
        """
        other = replace(self, control=control)
        object.__setattr__(other, "_memo", self._memo)  # values that depend only on the bodies are shared
        return other

    def raised(self, rise: float, lifting: float = 0.0) -> ContactProblem:
        """Return the same bodies with the surface raised as a whole; depths count as before.

        Parameters
        ----------
        rise : float
            The rise [m].
        lifting : float
            Work of the rise against the force [J].

        Returns
        -------
        ContactProblem

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> problem = rc.press(ball, 1e11, force=0.2, hardness=2e9).problem
        >>> raised = problem.raised(1e-8)
        >>> f"{(problem.separation - raised.separation).max() * 1e9:.1f} nm nearer"
        '10.0 nm nearer'
        """
        rise, lifting = in_si(rise, "m", "rise"), in_si(lifting, "J", "lifting")
        return self._moved(self.separation - rise, rise=self.rise + rise, lifting=self.lifting + lifting)

    def after(self, flow: Flow) -> ContactProblem:
        """Return the elastic contact of the surface that a load has flattened; depths count as before.

        Parameters
        ----------
        flow : Flow
            The flow under the load.

        Returns
        -------
        ContactProblem
            Elastic, without a hardness: valid up to that load.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> pressed = rc.press(ball, 1e11, force=0.2, hardness=2e9)
        >>> elastic = pressed.problem.after(pressed.flow)
        >>> elastic.hardness, elastic.surface.provenance[-1][:9]
        (inf, 'flattened')
        """
        surface = None if self.surface is None else flow.flatten(self.surface)
        separation = self.separation + flow.depth
        return self._moved(separation, surface=surface, hardness=math.inf, size_law=None, flow=flow)

    def moved(self, separation: Array, control: Control) -> ContactProblem:
        """Return the same bodies with another separation, under another control.

        Parameters
        ----------
        separation : array, shape of the grid
            The new separation [m].
        control : Force or Depth
            The new control.

        Returns
        -------
        ContactProblem

        Examples
        --------
        >>> import roughcontact as rc
        >>> problem = rc.press(rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4), 1e9, force=1e-3).problem
        >>> problem.moved(2 * problem.separation, rc.Depth(1e-7)).mean_separation / problem.mean_separation
        2.0
        """
        return self._moved(separation, control=control)

    def _moved(self, separation: Array, **changes: Any) -> ContactProblem:
        """Return bodies with a changed surface: values that depend on the separation are computed again."""
        if is_numpy(separation):
            separation.flags.writeable = False
        other = replace(self, separation=separation, **changes)
        of_surface = ("mean_separation", "first_touch", "separation_at_touch", "border_step")
        other._memo.update({name: each for name, each in self._memo.items() if name not in of_surface})
        return other

    @property
    def mean_response(self) -> Array:
        """Mean displacement of the measured cells per unit force on each cell [m/N], by reciprocity.

        Shape of the grid.
        """

        def respond() -> Array:
            xp = self.measure.xp
            measured = xp.astype(self.measured, self.separation.dtype)
            # By reciprocity, a unit pressure on the measured cells displaces a cell as much as a force on it displaces
            # them.
            return exact_of(self.operator).apply(measured) / self.measure.total(measured)

        return self.once("mean_response", respond)

    @property
    def mean_separation(self) -> float:
        """Mean undeformed gap of the measured cells [m]."""
        return self.once("mean_separation", lambda: self.measure.mean(self.separation, self.measured))

    def once(self, name: str, compute: Callable[[], T]) -> T:
        """Return a value that depends only on the bodies, computed once for all loads on them.

        Parameters
        ----------
        name : str
            The key of the value.
        compute : function
            Without arguments; called if there is no value for the name.

        Returns
        -------
        object
            The first result of `compute`.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
        >>> problem = rc.press(ball, 1e9, force=1e-3).problem
        >>> first = problem.once("deepest", lambda: float(problem.separation.max()))
        >>> problem.once("deepest", lambda: None) == first  # what was computed first
        True
        """
        if name not in self._memo:
            self._memo.setdefault(name, compute())  # concurrent threads all get the first value
        value: T = self._memo[name]
        return value


def separation_of(surface: Body) -> Array:
    """Return the undeformed gap at first touch [m], in double precision; infinite where nothing was measured."""
    xp = namespace(surface.heights)
    # No certificate could be met in single precision.
    heights = xp.astype(surface.heights, xp.float64, copy=False)
    if is_numpy(heights):  # planes are large: only the result and a mask are allocated
        apart = buffers.empty(heights.shape, np.float64)
        np.subtract(np.fmax.reduce(heights, axis=None), heights, out=apart)
        np.copyto(apart, math.inf, where=np.isnan(apart))
        apart.flags.writeable = False
        return apart
    missing = xp.isnan(heights)
    separation: Array = xp.max(xp.where(missing, -math.inf, heights)) - heights
    return xp.where(missing, math.inf, separation)  # type: ignore[no-any-return]
