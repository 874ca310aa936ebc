"""A rough rigid surface that slides steadily over a periodic viscoelastic plane."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughcontact import methods
from roughcontact.arrays import is_numpy
from roughcontact.cached import cached_property
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.press import grid_of, make_problem, solve
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.guesses import hinted
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.progress.events import task
from roughcontact.solver.control import Status
from roughcontact.solver.loads import control_of
from roughcontact.surface.surface import Surface
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, Mask, exactly_one, number, numeric, scalar, shown
from roughcontact.viscoelastic.prony_series import Viscoelastic, checked_material
from roughcontact.viscoelastic.sliding_solver import solve_sliding
from roughcontact.viscoelastic.wave_operator import WaveOperator, passing, wave_vectors

__all__ = ["SlidingContact", "at_rest", "limits_of", "moving", "steady_sliding", "unit_vector"]

COARSE = 0.1  # of the friction: error estimate from which on a note is made


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class SlidingContact:
    """The steady state of a rough rigid surface that slides over a viscoelastic plane, of one period.

    Attributes
    ----------
    problem : ContactProblem
        Surface, force and tolerance; the operator of the plane at this speed.
    material : Viscoelastic
        Of the plane.
    speed : float
        [m/s]
    direction : array, shape (2,)
        Unit vector (x, y) along which the surface slides.
    pressure : array, shape of the grid
        [Pa]
    displacement : array, shape of the grid
        Displacement of the plane [m]; its mean is zero.
    depth : float
        Approach of the bodies since first touch, from the mean plane [m].
    residual : float
        Largest violation of the conditions of contact, relative to the largest displacement, for the pressure as
        returned.
    solves : int
        Linear solves and symmetric contact problems.
    status : Status

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> sliding = rc.steady_sliding(surface, rubber, speed=0.1, pressure=1e5)
    >>> f"friction coefficient {sliding.friction_coefficient:.3f}, contact {sliding.contact_fraction:.2f}"
    'friction coefficient 0.009, contact 0.09'
    """

    problem: ContactProblem
    material: Viscoelastic
    speed: float
    direction: Array
    pressure: Array
    displacement: Array
    depth: float
    residual: float
    solves: int
    status: Status

    @cached_property
    def gap(self) -> Array:
        """Gap between the bodies [m]; a violation of the conditions is negative."""
        return np.asarray(self.displacement + self.problem.separation - self.depth)

    @cached_property
    def contact(self) -> Mask:
        """Mask of the cells in contact: those that carry pressure."""
        return np.asarray(self.pressure > 0)

    @property
    def contact_fraction(self) -> float:
        """Relative real contact area [-]."""
        return float(np.count_nonzero(self.contact) / self.contact.size)

    @property
    def nominal_pressure(self) -> float:
        """Force over the nominal area [Pa]."""
        return float(self.pressure.mean())

    @property
    def max_pressure(self) -> float:
        """Largest contact pressure of a cell [Pa]."""
        return float(self.pressure.max())

    @property
    def mean_gap(self) -> float:
        """Mean gap [m]."""
        return float(self.gap.mean())

    @cached_property
    def friction(self) -> Array:
        """Mean traction (x, y) by which the surface drags the plane [Pa], shape (2,); on the surface it is opposite.

        The sum over all waves of the displacement. A part across `direction` arises on anisotropic surfaces.
        """
        return -self._mean_with_slope(self.displacement)

    @property
    def friction_coefficient(self) -> float:
        """Friction along `direction` over the nominal pressure [-]."""
        return float(self.friction @ self.direction) / self.nominal_pressure

    @property
    def friction_across(self) -> float:
        """Friction across `direction`, to the left in (x, y), over the nominal pressure [-]; it does no work."""
        x, y = self.direction
        return float(self.friction @ (-y, x)) / self.nominal_pressure

    @property
    def dissipation(self) -> float:
        """Power that the plane dissipates per nominal area [W/m^2]: friction times speed."""
        return float(self.friction @ self.direction) * self.speed

    @cached_property
    def friction_error(self) -> float:
        """Estimate of the error of the friction coefficient by the grid [-].

        In contact both surfaces have the same slope. On a grid the mean of pressure times slope differs.
        """
        heights = -self.problem.separation
        by_heights = self._mean_with_slope(heights) @ self.direction
        return float(abs(by_heights + self.friction @ self.direction)) / self.nominal_pressure

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences."""
        return in_order(filter(None, limits_of(self)))

    def _mean_with_slope(self, field: Array) -> Array:
        """Return the mean of the pressure times the slope (x, y) of a field."""
        waves = np.fft.rfft2(field)
        slopes: list[Array] = []
        for q, n in zip(wave_vectors(self._grid), self._grid.shape, strict=True):
            if n % 2 == 0:  # the slope of a Nyquist wave is zero in every cell
                q.flat[n // 2] = 0
            slopes.insert(0, np.fft.irfft2(1j * q * waves, s=field.shape))  # x, then y
        return np.array([float(np.mean(self.pressure * slope)) for slope in slopes])

    @property
    def _grid(self) -> Grid:
        assert isinstance(self.problem.grid, Grid)
        return self.problem.grid

    to_dataset = methods.sliding_dataset

    def __repr__(self) -> str:
        """Return the main numbers."""
        return (
            f"SlidingContact({self.speed:.4g} m/s, friction coefficient {self.friction_coefficient:.4g}, contact "
            f"fraction {self.contact_fraction:.4g}, {self.status.value})"
        )


def limits_of(state: SlidingContact) -> Iterator[Note | None]:
    """Yield a note for each limit of a state that is exceeded, and None for each of the others."""
    grid, friction, error = state.problem.grid, abs(state.friction_coefficient), state.friction_error
    assert isinstance(grid, Grid)
    missed = f"The residual is {state.residual:.1e}, where {state.problem.tolerance:.0e} was asked for."
    yield None if state.status.converged else Note(Rank.WRONG, missed)
    longest = max((*state.material.creep().times, 0.0)) * state.speed
    period = min(
        length / abs(part)
        for length, part in zip(grid.lengths[::-1], state.direction, strict=True)
        if abs(part) > 1e-12
    )
    early = Note(
        Rank.DOUBTFUL,
        f"The surface moves by {longest:.3g} m in the longest retardation time, more than its period of "
        f"{period:.3g} m: the plane meets the same summits before it has recovered.",
    )
    yield early if longest > period else None
    coarse = f"The grid may change the friction coefficient by {error:.1e}: use smaller cells."
    yield Note(Rank.DOUBTFUL, coarse) if state.speed and error > COARSE * friction else None
    highest = state.speed * float(np.hypot(*(np.abs(each).max() for each in wave_vectors(grid))))
    lowest, (short, long) = 2 * math.pi * state.speed / period, state.material.band or (0.0, math.inf)
    outside = Note(
        Rank.DOUBTFUL,
        f"Waves load the plane at {lowest:.1e} to {highest:.1e} rad/s, partly outside the band of the "
        "material's data.",
    )
    yield outside if state.speed and (highest * short > 1 or lowest * long < 1) else None


@numeric(speed="m/s", pressure="Pa", force="N")
def steady_sliding(
    surface: Surface,
    material: Viscoelastic,
    *,
    speed: float,
    direction: Sequence[float] = (1.0, 0.0),
    pressure: float | None = None,
    force: float | None = None,
    tolerance: float = 1e-8,
    start: SlidingContact | Solution | None = None,
) -> SlidingContact:
    """Slide a rough rigid surface steadily over a viscoelastic half-space, on one period of both.

    The friction is the hysteresis of the half-space: tractions on the contact and adhesion are not part of it.

    Parameters
    ----------
    surface : Surface
        Heights [m], positive toward the half-space, periodic along both axes.
    material : Viscoelastic
        Of the half-space: a solid, see `roughcontact.viscoelastic`.
    speed : float
        Speed of the surface, 0 or more [m/s].
    direction : pair of floats
        Direction (x, y) in which the surface slides; its length has no meaning.
    pressure, force : float
        Exactly one: nominal pressure [Pa], or normal force on the map [N].
    tolerance : float
        Largest residual; see docs/concepts/results.md.
    start : SlidingContact or Solution, optional
        Contact of the same surface to start from, as at a lower speed; by default the contact at rest.

    Returns
    -------
    SlidingContact

    Raises
    ------
    ValueError
        If the surface is not a periodic map without missing heights, or the material has no relaxed modulus.
    ConvergenceError
        If the tolerance was missed. It carries the best state.

    Notes
    -----
    A wave q of the pressure is answered by ``2/(|q| E*(q.v))``, with the complex modulus E*. Waves along the track, q.v
    = 0, keep the relaxed modulus at any speed. The method is described in docs/concepts/sliding-hysteresis.md.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> grid = rc.Grid((64, 64), 1e-5, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=5e-6, rng=1, rolloff=3.2e-4, short_cutoff=4e-5)
    >>> sliding = rc.steady_sliding(surface, rubber, speed=0.01, pressure=1e5)
    >>> sliding.status.value, sliding.friction.shape
    ('converged', (2,))
    """
    rest = at_rest(surface, material, pressure, force, tolerance)
    found = moving(rest, material, scalar(speed, "speed"), unit_vector(direction), start)
    if not found.status.converged:
        raise ConvergenceError(found)
    return found


def at_rest(
    surface: Surface, material: Viscoelastic, pressure: float | None, force: float | None, tolerance: float
) -> ContactProblem:
    """Return the problem of the relaxed material; refuse what cannot slide."""
    grid = grid_of(surface)
    if not isinstance(grid, Grid) or grid.ndim != 2 or not all(grid.periodic):
        raise InputError(
            "steady sliding needs a map that is periodic along both axes",
            "if the surface repeats itself, make the grid with periodic=True",
            "surface",
        )
    if not is_numpy(surface.heights) or not np.isfinite(surface.heights).all():
        raise InputError(
            "steady sliding needs all heights, in NumPy's memory", "fill them: surface.filled()", "surface"
        )
    if not checked_material(material).equilibrium > 0:
        raise about(
            "the material",
            "has no relaxed modulus: it would sink without end",
            "give it an equilibrium modulus",
        )
    control = control_of(*exactly_one(pressure=pressure, force=force), grid)
    return make_problem(surface, material.equilibrium, control, None, tolerance=tolerance)


def unit_vector(direction: Sequence[float]) -> Array:
    """Return a direction (x, y) with the length 1."""
    vector = np.asarray(number(direction, "direction"))
    if vector.shape != (2,) or not (np.isfinite(vector).all() and vector.any()):
        raise about("the direction", f"must be a vector (x, y) that is not zero, not {shown(direction)}")
    return np.asarray(vector / np.hypot(*vector))


def moving(
    rest: ContactProblem,
    material: Viscoelastic,
    speed: float,
    direction: Array,
    start: SlidingContact | Solution | None,
) -> SlidingContact:
    """Return the steady state at a speed, of whatever status."""
    if not 0 <= speed < math.inf:
        raise about("the speed", f"must be 0 or more and finite [m/s], not {speed}")
    grid = rest.grid
    assert isinstance(grid, Grid)
    if start is not None and start.pressure.shape != grid.shape:
        raise about(
            "start", f"must be a contact on the grid {grid.shape} of the surface, not {start.pressure.shape}"
        )
    with task("Sliding", shape=grid.shape), one_blas_thread():
        pressure = solve(rest).pressure if start is None else start.pressure
        vx, vy = -speed * direction  # of the plane past the surface
        operator = WaveOperator(grid, passing(material, (float(vx), float(vy))))
        state = solve_sliding(operator, rest.separation, rest.spec, pressure)
    for each in (state.pressure, state.displacement):
        each.flags.writeable = False
    return SlidingContact(
        replace(rest, operator=operator),
        material,
        speed,
        direction,
        state.pressure,
        state.displacement,
        state.depth,
        state.residual,
        state.solves,
        state.status,
    )
