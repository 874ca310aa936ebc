"""The solution of a contact problem, and all quantities that follow from it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact import methods
from roughcontact.arrays import as_like, is_numpy, max_abs, on_host
from roughcontact.cached import cached_property
from roughcontact.contact.flow import Flow, flow_of
from roughcontact.contact.open_cells import ACCURACY, ROUNDING, mean_opening
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.spots import Spots, are_labelled, count_spots, find_spots
from roughcontact.contact.stiffness import (
    FrozenContact,
    cell_stiffness,
    elastic_contact,
    frozen_contact,
    full_contact_stiffness,
)
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import capabilities, exact_of
from roughcontact.labels.note import in_order
from roughcontact.labels.variables import unit_of
from roughcontact.solver.complementarity import weakly_active
from roughcontact.solver.control import Status
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import ROUNDING_FLOOR
from roughcontact.statistics.fit_window import CELLS, is_resolved
from roughcontact.surface.surface import Surface
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array

__all__ = ["Solution", "mean_pressure"]


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class Solution:
    """A pressure, its depth and its certificate; other quantities are computed once, on first access.

    Attributes
    ----------
    problem : ContactProblem
    pressure : array, shape of the grid
        Contact pressure [Pa].
    depth : float
        Approach of the bodies since first touch [m].
    status : Status
        How the solve ended.
    residual : float
        Largest violation of the conditions of contact relative to the largest displacement, from a product of the exact
        operator with this pressure.
    steps : int
        Number of products with the operator on the finest grid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> f"{solution.stiffness:.0f} N/m on {solution.contact_area * 1e12:.0f} um^2", solution.residual < 1e-8
    ('8493 N/m on 60 um^2', True)
    >>> solution.on_host().spots.count, solution.to_record()["units"]["force"]
    (1, 'N')
    >>> solution.to_dataset()["gap"].attrs["units"]
    'm'
    """

    problem: ContactProblem
    pressure: Array
    depth: float
    status: Status
    residual: float
    steps: int
    _frozen: FrozenContact | None = field(default=None, repr=False)

    @cached_property
    def displacement(self) -> Array:
        """Displacement of the surface [m]; its mean is zero on a periodic grid, otherwise it vanishes far away."""
        return exact_of(self.problem.operator).apply(self.pressure)

    @cached_property
    def gap(self) -> Array:
        """Deformed gap [m]; NaN where nothing was measured."""
        gap = self.displacement + self.problem.separation - self.depth
        return self._measure.xp.where(self.problem.measured, gap, np.nan)  # type: ignore[no-any-return]

    @cached_property
    def contact(self) -> npt.NDArray[np.bool_]:
        """Mask of the cells in contact: those that carry pressure."""
        return self.pressure > 0

    @cached_property
    @one_blas_thread()
    def force(self) -> float:
        """Normal force [N]; [N/m] on a line."""
        if not self._measure.on_host:
            return self._measure.total(self.pressure)
        cells = self._cells
        return float(self._measure.on(cells) @ self.pressure.ravel()[cells])

    @cached_property
    def contact_area(self) -> float:
        """Real contact area [m^2]; [m] on a line."""
        if not self._measure.on_host:
            return self._measure.total(self.contact)
        return float(self._measure.on(self._cells).sum())

    @property
    def nominal_area(self) -> float:
        """Area of all cells [m^2], missing ones included; for a line and for springs, the length [m]."""
        return self.problem.grid.area

    @property
    def contact_fraction(self) -> float:
        """Relative real contact area A/A0, missing cells included in A0."""
        return self.contact_area / self.nominal_area

    @property
    def nominal_pressure(self) -> float:
        """Force over the nominal area [Pa]; for a foundation of springs, over its length [N/m]."""
        return self.force / self.nominal_area

    @property
    def max_pressure(self) -> float:
        """Largest pressure of a cell [Pa]."""
        return max_abs(self.pressure)

    @property
    def mean_pressure(self) -> float:
        """Force over the real contact area [Pa]; NaN without contact."""
        return float(mean_pressure(self.force, self.contact_area))

    @cached_property
    def mean_gap(self) -> float:
        """Mean of the deformed gap over the measured cells [m]; plastic cells have a negative gap."""
        undeformed = self.problem.mean_separation
        mean = self._mean_displacement(self.pressure) + undeformed - self.depth
        if self._moves_no_mean:
            return mean
        error = self.residual * self._largest_displacement + ROUNDING * (undeformed + self.depth)
        if error <= ACCURACY * abs(mean):
            return mean  # otherwise, near full contact, its terms cancel
        return self._mean_opening(self.displacement + self.problem.separation - self.depth)

    @cached_property
    @one_blas_thread()
    def elastic_energy(self) -> float:
        """Elastic energy [J]: half the pressure times the displacement, which is depth - separation in contact."""
        if self.problem.plastic or not is_numpy(self.pressure):  # under a hardness part of the depth is flow
            return 0.5 * self._measure.dot(self.pressure, self.displacement)
        cells = self._cells
        work = self.pressure.ravel()[cells] * (self.depth - self.problem.separation.ravel()[cells])
        return 0.5 * float(self._measure.on(cells) @ work)

    @cached_property
    def frozen(self) -> FrozenContact:
        """The response of the present contact region, displaced as a whole."""
        if self._frozen is not None:
            return self._frozen
        return frozen_contact(self.problem.operator, elastic_contact(self.pressure, self.problem.hardness))

    @cached_property
    def plastic(self) -> npt.NDArray[np.bool_]:
        """Mask of the cells that flow at this load: their pressure is the hardness."""
        return self.pressure >= self.problem.hardness

    @cached_property
    def flow(self) -> Flow | None:
        """The plastic flow at this load, or at a larger one before; None without a hardness."""
        problem = self.problem
        if problem.flow is not None or not problem.plastic:
            return problem.flow
        gap = self.displacement + problem.separation - self.depth
        return flow_of(gap, self.plastic, problem.hardness, self._measure, problem.rise, problem.lifting)

    @property
    def flattened(self) -> Solution:
        """The same state as an elastic contact of the flattened surface; the same object if nothing has flowed.

        Its stiffness is that of unloading, to which all cells in contact contribute. Its gap is nowhere negative. Its
        surface, ``flattened.problem.surface``, is the flattened surface.
        """
        if self.flow is None or self.problem.flow is not None:
            return self  # not kept: a reference to itself would hold the maps until cycles are collected
        return self._flattened

    @cached_property
    def _flattened(self) -> Solution:
        whole = replace(self, problem=self.problem.after(self.flow))  # type: ignore[arg-type]
        # Without a plastic cell, all cells in contact contribute to the stiffness already.
        return replace(whole, _frozen=None) if bool(self._measure.xp.any(self.plastic)) else whole

    @property
    def stiffness(self) -> float:
        """Normal contact stiffness dF/dd at fixed contact region [N/m] (thesis, eq. 4.1).

        The region is that of the cells that carry pressure, so this is the slope of the force as the load is reduced.
        Under a hardness it is the slope as the load grows, to which cells at the hardness do not contribute; the slope
        as the load is reduced is the stiffness of `flattened`.
        """
        return self.frozen.stiffness

    @property
    def stiffness_residual(self) -> float:
        """Relative residual of the linear problem of the stiffness: its certificate."""
        return self.frozen.residual

    @cached_property
    def touching(self) -> npt.NDArray[np.bool_]:
        """Mask of the cells without pressure whose gap is zero within rounding and the residual.

        Such cells exist only in borderline states; a further load brings them into contact.
        """
        allowed = (ROUNDING_FLOOR + min(self.residual, self.problem.tolerance)) * max_abs(self.displacement)
        gap = self.displacement + self.problem.separation - self.depth
        return weakly_active(self.pressure, gap, allowed)

    @cached_property
    def loading_stiffness(self) -> float:
        """Slope dF/dd of the force as the load grows [N/m]: with the cells that are `touching` in contact.

        The force is a convex function of the depth, so this is never below `stiffness`; the two differ only if there
        are cells that are `touching`.
        """
        if not bool(self._measure.xp.any(self.touching)):
            return self.stiffness
        region = elastic_contact(self.pressure, self.problem.hardness) | self.touching
        return frozen_contact(self.problem.operator, region).stiffness

    @cached_property
    def interfacial_stiffness(self) -> float:
        """Stiffness against the mean gap, -dF/d(mean gap) at fixed contact region [N/m].

        1/k = 1/K + d(mean displacement)/dF; on a periodic grid without missing cells it equals `stiffness`.
        """
        k = self.stiffness
        if not 0 < k < np.inf:
            return k
        if self._moves_no_mean:
            return k
        # Decrease of the mean gap per unit depth.
        closing = 1 - self._mean_displacement(self.frozen.tangent)
        if not self.frozen.residual + ROUNDING <= ACCURACY * closing:
            closing = self._mean_opening(1 - exact_of(self.problem.operator).apply(self.frozen.tangent))
        return k / closing if closing else np.inf  # in full contact the gap cannot close

    @property
    def interfacial_stiffness_per_area(self) -> float:
        """Interfacial stiffness over the nominal area, K/A0 [Pa/m]; for a foundation, over its length [N/m^2]."""
        return self.interfacial_stiffness / self.nominal_area

    @cached_property
    def spots(self) -> Spots:
        """The connected parts of the contact (cells that share an edge)."""
        return find_spots(self.contact, self.pressure, self.problem.grid, self._measure)

    @property
    def spot_count(self) -> int:
        """Number of contact spots; the arrays may be on any device."""
        if are_labelled(self.pressure):
            return self.spots.count
        return count_spots(self.contact, self.problem.grid)

    def on_host(self) -> Solution:
        """Return the same solution in NumPy's memory, for spots, files and pictures.

        Returns
        -------
        Solution
            The same object if it is there already.
        """
        if self._measure.on_host:
            return self
        problem, surface, hardness = self.problem, self.problem.surface, self.problem.hardness
        if isinstance(surface, Surface):
            surface = replace(surface, heights=on_host(surface.heights))
        frozen = self._frozen and replace(self._frozen, tangent=on_host(self._frozen.tangent))
        hardness = hardness if isinstance(hardness, int | float) else on_host(hardness)
        flow = problem.flow and problem.flow.on_host()
        separation = on_host(problem.separation)
        bodies = replace(problem, separation=separation, surface=surface, hardness=hardness, flow=flow)
        return replace(self, problem=bodies, pressure=on_host(self.pressure), _frozen=frozen)

    @property
    def missing(self) -> int:
        """Number of cells without a height; they never touch."""
        return self.problem.missing

    @cached_property
    def edge_share(self) -> float:
        """Part of the force on the outermost cells of a free grid, at the edge of the map."""
        grid, pressure, xp = self.problem.grid, self.pressure, self._measure.xp
        weights = np.broadcast_to(self.problem.operator.weights, grid.shape)
        inner: tuple[slice, ...] = ()  # of the axes before, so that no corner is counted twice
        load = 0.0
        for count, ends in zip(grid.shape, grid.ends, strict=True):
            for end in {end % count for end in ends}:
                rim: Any = (*inner, end, ...)
                load += float(xp.sum(as_like(weights[rim].copy(), pressure) * pressure[rim]))
            inner = (*inner, slice(1 if 0 in ends else 0, -1 if ends else None))
        return load / self.force if load else 0.0

    @property
    def touches_edge(self) -> bool:
        """Whether contact reaches the edge of a free grid."""
        return self.edge_share > 0

    @cached_property
    def resolved(self) -> bool:
        """Whether the stiffness is above the one-cell artefact and below the full-contact stiffness."""
        size, cell = self._size_and_cell
        line = self.problem.geometry is Geometry.LINE
        whole = self.problem.grid.lengths[0] if line else full_contact_stiffness(self.problem)
        return bool(is_resolved(np.asarray(size), cell, whole))

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; notes on wrong numbers come first."""
        return in_order(methods.notes_on(self))

    @property
    def resolved_from_below(self) -> bool:
        """Whether the contact is so large that its numbers depend on the surface and not on the grid."""
        size, cell = self._size_and_cell
        return size >= CELLS * cell

    @property
    def _size_and_cell(self) -> tuple[float, float]:
        """The stiffness of the contact and of a cell; on a line the widths, because the stiffness grows too little."""
        if self.problem.geometry is Geometry.LINE:
            return self.contact_area, self.problem.grid.spacing[0]
        return self.flattened.stiffness, cell_stiffness(self.problem.operator)

    def __repr__(self) -> str:
        """Return the main numbers, without the fields."""
        xp, unit = self._measure.xp, unit_of("force", self.problem.geometry)
        return (
            f"Solution({self.status.value}, force {self.force:.4g} {unit}, depth {self.depth:.4g} m, "
            f"{int(xp.count_nonzero(self.contact))} cells in contact, residual {self.residual:.1e})"
        )

    pressure_histogram = methods.pressure_histogram
    gap_histogram = methods.gap_histogram
    to_dataset = methods.solution_dataset
    to_record = methods.solution_record
    plot = methods.plot_solution
    _repr_html_ = methods.solution_html

    @cached_property
    def _cells(self) -> npt.NDArray[np.intp]:
        """Flat indices of the cells in contact."""
        return np.flatnonzero(self.contact)

    @property
    def _measure(self) -> Measure:
        return self.problem.measure

    @property
    def _moves_no_mean(self) -> bool:
        """Whether no pressure moves the mean of the measured cells."""
        return self.problem.semidefinite and not self.missing

    @property
    def _largest_displacement(self) -> float:
        """A bound on the displacement [m], found without a product with the operator.

        No cell is displaced by more than the depth. If the body may bulge, a measured cell rises by no more than its
        separation, and a missing cell by any amount.
        """
        if capabilities(self.problem.operator).positive:
            return self.depth - self.problem.first_touch
        return max(self.depth, float(self._measure.xp.max(self.problem.separation)))

    def _mean_opening(self, opening: Array) -> float:
        """Mean over the measured cells of a field that is about zero in contact, computed from the open cells only."""
        problem, closed = self.problem, elastic_contact(self.pressure, self.problem.hardness)
        return mean_opening(exact_of(problem.operator), opening, closed, problem.measured)

    @one_blas_thread()
    def _mean_displacement(self, pressure: Array) -> float:
        """Mean displacement of the measured cells under a pressure, by reciprocity, without a product."""
        if self._moves_no_mean:
            return 0.0
        if not is_numpy(pressure):
            return self._measure.dot(pressure, self.problem.mean_response)
        cells = self._cells
        force = self._measure.on(cells) * pressure.ravel()[cells]
        return float(force @ self.problem.mean_response.ravel()[cells])


def mean_pressure(force: float | Array, contact_area: float | Array) -> Array:
    """Return the mean pressure in contact [Pa]; NaN without contact."""
    return force / np.where(np.asarray(contact_area) > 0, contact_area, np.nan)
