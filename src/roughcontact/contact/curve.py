"""The curve: stiffness, area, depth and more against load, with the scales that make it dimensionless."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from operator import index

import numpy as np
import numpy.typing as npt

from roughcontact import methods
from roughcontact.arrays import on_host
from roughcontact.contact.curve_record import CurvePoint
from roughcontact.contact.flow_curve import FlowCurve, flow_curve, flow_point
from roughcontact.contact.measures import StateMeasure, measured_at, measured_columns
from roughcontact.contact.notes.solution_notes import notes_on_few_cells, notes_on_load
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution, mean_pressure
from roughcontact.contact.stiffness import cell_stiffness, full_contact_stiffness
from roughcontact.errors import InputError
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry, length_scale
from roughcontact.labels.column import names_of, stored_in
from roughcontact.labels.contact_columns import CERTIFICATES, CURVE, FLOW, HARDNESS, POINTS
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.labels.records import records
from roughcontact.labels.variables import force_unit, unit_of
from roughcontact.solver.control import Status
from roughcontact.statistics.fit_window import DECADE, fitted_loads, is_resolved
from roughcontact.statistics.local_exponent import LocalExponent, local_exponents
from roughcontact.statistics.power_law import FORCE_LIMIT, ROUNDING, PowerLaw, fit_power_law
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, number, numeric

__all__ = ["CURVE_POINTS", "Curve", "collect"]


REMEDY = (
    "leave the loads out, so that suitable ones are chosen, or use a finer grid, or another window of forces"
)


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class Curve:
    """Points of a loading curve, in the order of the loads.

    Attributes
    ----------
    force, depth, stiffness, interfacial_stiffness : array, shape (n,)
        [N], [m], [N/m], [N/m]. `stiffness` is dF/dd at the frozen contact region (a
        staircase in load); `secant_stiffness` is the finite difference that averages over its steps.
    contact_area, max_pressure, mean_gap, elastic_energy : array, shape (n,)
        [m^2], [Pa], [m], [J]; `max_pressure` is the largest of a cell.
    spots : int array, shape (n,)
        Number of contact spots.
    residual, stiffness_residual : array, shape (n,)
        Certificates of the pressure and of the stiffness.
    status : tuple of Status
    modulus : float
        Reduced modulus [Pa].
    lengths, spacing : tuple of float
        Sides of the grid and of a cell [m], y first.
    rms : float
        Root mean square height of the surface [m].
    periodic : tuple of bool
    cell_stiffness, full_contact_stiffness : float
        Stiffness of one cell, and of all measured cells in contact [N/m].
    nominal_area : float
        Area of all cells [m^2], of rings about a hole without it; length of a line [m].
    geometry : Geometry
        Geometry of the cells. On a line, forces, stiffness, areas and energy are per unit length.
    hardness : float
        Pressure that no cell exceeds [Pa]; cells that reach it do not contribute to the stiffness.
    flow : FlowCurve, optional
        Plastic flow along the curve, and the stiffness of unloading; None without a hardness.
    state_notes : tuple of (float, Note)
        Notes on the states, each with its force [N]: those on the largest load, and those on single cells on the
        first resolved load, where such cells carry the largest share of the force.
    measured : dict of str to array, shape (n,)
        Numbers of each state by the `measures` that were given to `loading_curve`.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e9, forces=np.geomspace(1e-2, 1e-1, 9))
    >>> curve
    Curve(9 of 9 points resolved, force 0.01 to 0.1 N)
    >>> [round(each.exponent, 2) for each in curve.local_exponents("contact_area")]  # of Hertz 2/3
    [0.67, 0.68]
    >>> curve[-1].status, [point.spots for point in curve if point.force < 0.02]
    (<Status.CONVERGED: 'converged'>, [1, 1, 1])
    """

    force: Array
    depth: Array
    stiffness: Array
    interfacial_stiffness: Array
    contact_area: Array
    max_pressure: Array
    mean_gap: Array
    elastic_energy: Array
    spots: npt.NDArray[np.intp]
    residual: Array
    stiffness_residual: Array
    status: tuple[Status, ...]
    modulus: float
    lengths: tuple[float, ...]
    spacing: tuple[float, ...]
    rms: float
    periodic: tuple[bool, ...]
    cell_stiffness: float
    full_contact_stiffness: float
    nominal_area: float
    geometry: Geometry = Geometry.SURFACE
    hardness: float = math.inf
    flow: FlowCurve | None = None
    state_notes: tuple[tuple[float, Note], ...] = ()
    measured: Mapping[str, Array] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.force)

    def __getitem__(self, place: int) -> CurvePoint:
        """Return one load as a record; negative places count from the end."""
        return tuple(self)[index(place)]

    def __iter__(self) -> Iterator[CurvePoint]:
        """Yield the loads in their order, each as a record."""
        return records(CurvePoint, self, self.flow)

    @property
    def resolved(self) -> npt.NDArray[np.bool_]:
        """Mask of points between the one-cell artefact and full contact, solved to their tolerance."""
        solved = np.array([status is Status.CONVERGED for status in self.status], dtype=bool)
        if self.geometry is Geometry.LINE:
            return solved & is_resolved(self.contact_area, self.spacing[0], self.lengths[0])
        stiffness = self.stiffness if self.flow is None else self.flow.unloading_stiffness
        return solved & is_resolved(stiffness, self.cell_stiffness, self.full_contact_stiffness)

    @property
    def length(self) -> float:
        """The length L of the dimensionless numbers [m].

        The square root of the area of the map, or of the disc within the outermost ring; the length of a line.
        """
        return length_scale(self.geometry, self.lengths)

    @property
    def force_scale(self) -> float:
        """E* h L [N] (thesis, eq. 4.13); for a line contact, E* h [N/m]."""
        return self.rms * self.stiffness_scale

    @property
    def stiffness_scale(self) -> float:
        """E* L [N/m] (thesis, eq. 4.8); for a line contact, E* [N/m^2]."""
        return self.modulus * (1.0 if self.geometry is Geometry.LINE else self.length)

    @property
    def dimensionless_force(self) -> Array:
        """Force over E* h L (thesis, eq. 4.13); NaN for a flat surface."""
        return self.force / self.force_scale if self.rms > 0 else np.full(len(self), np.nan)

    @property
    def dimensionless_stiffness(self) -> Array:
        """Stiffness over E* L (thesis, eq. 4.8)."""
        return self.stiffness / self.stiffness_scale

    @property
    def nominal_pressure(self) -> Array:
        """Force over the nominal area [Pa]; for a foundation of springs, over its length [N/m]."""
        return self.force / self.nominal_area

    @property
    def mean_pressure(self) -> Array:
        """Force over the real contact area [Pa]; NaN without contact."""
        return mean_pressure(self.force, self.contact_area)

    @property
    def contact_fraction(self) -> Array:
        """Relative real contact area A/A0, missing cells included in A0."""
        return self.contact_area / self.nominal_area

    @property
    def interfacial_stiffness_per_area(self) -> Array:
        """Interfacial stiffness over the nominal area, K/A0 [Pa/m]; for a foundation, over its length [N/m^2].

        It does not depend on the size of a joint. `stiffness` has no such value: on a free grid it contains the
        compliance of the body under the map, and this part grows with the map.
        """
        return self.interfacial_stiffness / self.nominal_area

    @property
    def secant_stiffness(self) -> Array:
        """Finite difference dF/dd between neighbouring points [N/m], shape (n - 1,).

        Infinite where the depth does not grow with the force, as in the full contact of a periodic surface.
        """
        force, depth = np.diff(self.force), np.diff(self.depth)
        moves = (depth > 0) | ((depth < 0) & (force < 0))
        return np.asarray(np.divide(force, depth, out=np.full(len(force), np.inf), where=moves))

    @numeric(window=force_unit)
    def fit(self, window: tuple[float, float] | None = None) -> PowerLaw:
        """Return the power law k ~ F^alpha through the points of a window of force (thesis, eq. 4.53).

        Parameters
        ----------
        window : tuple of float, optional
            Lowest and highest force [N]. By default the resolved points up to a dimensionless force of 0.07; all
            resolved points if these span less than a decade, and on lines.

        Returns
        -------
        PowerLaw
            Exponent, prefactor and scatter, from least squares of the logarithms.

        Raises
        ------
        ValueError
            If the window is not a force and a larger one, if fewer than three points lie in it, or if the resolved
            points span less than a decade of force.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
        >>> curve = rc.loading_curve(ball, 1e9, forces=np.geomspace(1e-2, 1e-1, 9))
        >>> f"k ~ F^{curve.fit().exponent:.2f}", curve.fit().rule  # of Hertz 1/3
        ('k ~ F^0.34', 'all 9 resolved loads')
        """
        unit = unit_of("force", self.geometry)
        if window is None:
            limit = math.inf if self.geometry is Geometry.LINE else FORCE_LIMIT * self.force_scale
            inside, rule = fitted_loads(self.force, self.resolved, limit, unit)
        else:
            ends = np.asarray(number(window, "window [N]"))
            if ends.shape != (2,) or not 0 <= ends[0] < ends[1]:
                raise InputError(f"a window goes from a force to a larger one, not {window}", place="window")
            low, high = ends * (1 - ROUNDING, 1 + ROUNDING)
            inside = (self.force >= low) & (self.force <= high) & (self.stiffness > 0)
            inside &= np.isfinite(self.stiffness)
            rule = f"{int(inside.sum())} loads from {ends[0]:.3g} to {ends[1]:.3g} {unit}"
        if (points := int(inside.sum())) < 3:
            few = f"a power law needs at least 3 resolved points in the range of forces that is fitted, not {points}"
            raise InputError(few, REMEDY)
        span = self.force[inside].max() / self.force[inside].min()
        if window is None and span < DECADE:
            short = (
                f"a power law needs a decade of force, and the resolved points span a factor of {span:.2g}"
            )
            raise InputError(short, REMEDY)
        return fit_power_law(
            self.force[inside], self.stiffness[inside], self.force_scale, self.stiffness_scale, rule
        )

    def local_exponents(self, quantity: str = "stiffness") -> tuple[LocalExponent, ...]:
        """Return the exponents d ln y/d ln F of a quantity over windows of half a decade of the resolved forces.

        Parameters
        ----------
        quantity : str
            A quantity of this curve, such as ``"stiffness"``, ``"interfacial_stiffness"`` or ``"contact_area"``.

        Returns
        -------
        tuple of LocalExponent
            Each with its window, its standard error and the number of its points; empty where fewer than four points
            are resolved.

        Raises
        ------
        ValueError
            If the curve has no such quantity.
        """
        if quantity not in (*CURVE_POINTS, "spots"):
            raise InputError(f"a curve has no {quantity!r}; it has {', '.join(CURVE_POINTS)}")
        values = np.asarray(getattr(self, quantity), dtype=np.float64)
        shown = self.resolved & np.isfinite(values) & (values > 0)
        return local_exponents(self.force[shown], values[shown])

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; notes on wrong numbers come first."""
        doubts = (Note(Rank.DOUBTFUL, doubt) for doubt in self.doubts)
        return in_order((*doubts, *methods.curve_notes(self)))

    @property
    def doubts(self) -> tuple[str, ...]:
        """Reasons to doubt the curve as a whole, in sentences; they stand among the `notes`."""
        return methods.curve_doubts(self)

    def __repr__(self) -> str:
        """Return the range of the curve, without its arrays."""
        resolved = f"{int(self.resolved.sum())} of {len(self)} points resolved"
        unit = unit_of("force", self.geometry)
        doubt = "".join(f"; {note.partition(':')[0]}" for note in self.doubts[:1])
        return f"Curve({resolved}, force {self.force[0]:.4g} to {self.force[-1]:.4g} {unit}{doubt})"

    compare = methods.compare
    to_csv = methods.csv_of
    to_dataset = methods.curve_dataset
    to_record = methods.curve_record
    to_dataframe = methods.curve_dataframe
    plot = methods.plot_curve
    _repr_html_ = methods.curve_html


CURVE_POINTS = stored_in(Curve, POINTS)
"""The columns that a curve takes from each state; the other columns follow from them."""
_TAKEN = tuple(name for table in (*CURVE.values(), FLOW, (HARDNESS,)) for name in names_of(table))


@one_blas_thread()
def collect(path: Iterable[Solution], measures: Sequence[StateMeasure] = ()) -> Curve:
    """Drain a loading path into a curve; fields are not kept."""
    points: list[tuple[float, ...]] = []
    status: list[Status] = []
    flows: list[tuple[float, ...]] = []
    measured: list[dict[str, float]] = []
    problem: ContactProblem | None = None
    hardness = 0.0
    on_largest: tuple[float, tuple[Note, ...]] = (-math.inf, ())
    few: tuple[tuple[float, Note], ...] | None = None
    names = (*CURVE_POINTS, *names_of(CERTIFICATES))
    for solution in path:
        problem = problem or solution.problem
        if solution.problem.plastic:  # on unloading nothing limits the pressure
            hardness = max(hardness, solution.problem.spec.largest_hardness)
        flows.append(flow_point(solution))
        points.append((*(getattr(solution, name) for name in names), solution.spot_count))
        status.append(solution.status)
        measured.append(measured_at(solution, measures, _TAKEN))
        if few is None and solution.status.converged and solution.resolved_from_below:
            few = tuple((solution.force, note) for note in notes_on_few_cells(solution))
        if solution.force >= on_largest[0]:
            on_largest = solution.force, tuple(notes_on_load(solution))
        del solution  # with its maps, before the next load is solved
    if problem is None:
        raise InputError("a curve needs at least one load")
    *columns, spots = np.array(points).T
    surface = problem.surface
    return Curve(
        **dict(zip(names, columns, strict=True)),
        spots=spots.astype(np.intp),
        status=tuple(status),
        modulus=problem.modulus,
        lengths=problem.grid.lengths,
        spacing=problem.grid.spacing,
        rms=float(np.std(on_host(problem.separation[problem.measured]))) if surface is None else surface.rms,
        periodic=problem.grid.periodic,
        cell_stiffness=cell_stiffness(problem.operator),
        # An error of a thousandth in the displacement is small enough for a limit of nine tenths.
        full_contact_stiffness=full_contact_stiffness(problem),
        nominal_area=problem.grid.area,
        geometry=problem.geometry,
        hardness=hardness or math.inf,
        flow=flow_curve(flows),
        state_notes=(*((on_largest[0], note) for note in on_largest[1]), *(few or ())),
        measured=measured_columns(measured),
    )
