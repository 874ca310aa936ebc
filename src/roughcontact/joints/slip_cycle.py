"""Shear of an interface per area, computed by partial slip: first loading and one full cycle at constant pressure.

The displacement of the surfaces is that of the bodies less the mean elastic displacement of the map, which is zero on
a periodic map. For Poisson's ratio 0 and without missing cells it is the mean slip ``mu C [g(p - tau/mu) - g(p)]`` of
the law from the normal curve, with the mean gap g.

Energy dissipated in a step is the slip of each cell times the traction at the end of the step, as in `slide`. This is
exact for Poisson's ratio 0, however large the steps are. The polygon through the points of a loop has the area that
results from the mean traction of each step, to rounding, because the trapezoidal rule is exact for the elastic part.
It is smaller than the loss by a part that falls as the square of the steps.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from roughcontact import methods
from roughcontact.arrays import as_like, inner, namespace, on_host
from roughcontact.contact.solution import Solution
from roughcontact.friction.slide import load_cycle, slide_path
from roughcontact.friction.slip_problem import Load, SlipProblem
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.friction.tangential_stiffness import TOLERANCE, displaced
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.joints.masing import ShearCycle
from roughcontact.joints.shear_law import FLOWED, ShearLaw
from roughcontact.labels.cycle_columns import CYCLE, CYCLE_NAMES, ESTIMATE
from roughcontact.labels.labelled import centres, dataset_of, variables_of
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.materials import Elastic, solids_of
from roughcontact.solver.control import Status
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, exactly_one, number, numeric, positive_scalar, require

if TYPE_CHECKING:
    import xarray

__all__ = ["SlipCycle", "shear_cycle"]

_ROUNDING = 1e-9  # of a traction that is mu p


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class SlipCycle:
    """First loading and a full cycle of an interface under shear, computed by partial slip, per nominal area.

    Displacements and tractions are the components along the load.

    Attributes
    ----------
    loop : ShearCycle
        The cycle after first loading, from the largest displacement to its opposite and back; its loss per cycle
        [J/m^2] is the mean of `heat`.
    first_displacement, first_traction : array, shape (n,)
        First loading, the backbone, from zero to the amplitude [m], [Pa].
    bodies_displacement : array, shape (m,)
        Displacement of body 2 against body 1, far from the contact, along the loop [m]. On a periodic map, the surfaces
        have the same displacement.
    heat : array, shape (ny, nx)
        Energy that friction dissipates in the cycle in each cell, per area [J/m^2].
    tangential_stiffness_per_area : float
        K_t/A0 while nothing slips [Pa/m].
    stiffness_ratio : float
        K/K_t, normal over tangential interfacial stiffness of the same contact; E*/G* for a disc.
    balance : float
        Area of the loop of `bodies_displacement` less the energy that the cells dissipate at the mean traction of each
        step and the change of elastic energy, relative to the loss: rounding.
    residual : float
        Largest residual of all states.
    status : Status
        How the solves ended: of the first state that missed the tolerance, or of the last one.
    reversal : TangentialSolution
        The state at the end of the cycle.
    shear_strength : float
        Largest tangential traction of a cell [Pa].
    law : ShearLaw or None
        The law from the normal curve to compare with.
    estimate : ShearCycle or None
        Its cycle of the same amplitude.

    Examples
    --------
    >>> import roughcontact as rc
    >>> bodies = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))
    >>> grid = rc.Grid((32, 32), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, short_cutoff=4e-6)
    >>> curve = rc.loading_curve(surface, bodies, pressures=[1e6, 2e6, 4e6, 6e6, 8e6])
    >>> law = rc.shear_law(curve, bodies, friction=0.3)
    >>> pressed = rc.press(surface, bodies, pressure=8e6)
    >>> cycle = rc.shear_cycle(pressed, bodies, friction=0.3, traction=1.2e6, steps=2, law=law)
    >>> f"{cycle.loop.loss * 1e3:.2f} mJ/m^2, damping {cycle.loop.damping:.3f}; K/K_t {cycle.stiffness_ratio:.3f}"
    '6.83 mJ/m^2, damping 0.094; K/K_t 1.000'
    >>> f"the loss from the normal curve differs by {100 * cycle.differences['loss']:.1f} %"
    'the loss from the normal curve differs by -0.5 %'
    >>> cycle.to_dataset()["heat"].attrs["units"]
    'J m-2'
    """

    loop: ShearCycle
    first_displacement: Array
    first_traction: Array
    bodies_displacement: Array
    heat: Array
    tangential_stiffness_per_area: float
    stiffness_ratio: float
    balance: float
    residual: float
    status: Status
    reversal: TangentialSolution
    shear_strength: float = math.inf
    law: ShearLaw | None = None
    estimate: ShearCycle | None = None

    @property
    def pressure(self) -> float:
        """Nominal pressure [Pa]."""
        return self.reversal.problem.pressed.nominal_pressure

    @property
    def slip_fraction(self) -> float:
        """Part of the contact that slips at the reversal."""
        return self.reversal.slip_area / self.reversal.problem.pressed.contact_area

    @property
    def stick_fraction(self) -> float:
        """Part of the contact that sticks at the reversal."""
        return self.reversal.stick_area / self.reversal.problem.pressed.contact_area

    @property
    def closure(self) -> float:
        """Distance between the ends of the loop, relative to the amplitude: 0 if the cycle is steady."""
        ends = [each[-1] / each[0] - 1 for each in (self.loop.displacement, self.loop.traction)]
        return float(np.abs(ends).max())

    @property
    def differences(self) -> dict[str, float]:
        """Difference of the law from the computed values, relative to them: positive if the law is larger.

        Displacement and traction are those at the reversal, of which the prescribed one has no difference. Empty
        without a law.
        """
        if self.law is None or self.estimate is None:
            return {}
        estimate, loop = self.estimate, self.loop
        pairs = {
            "displacement": (estimate.displacement[0], loop.displacement[0]),
            "traction": (estimate.traction[0], loop.traction[0]),
            "loss": (estimate.loss, loop.loss),
            "stiffness": (self.law.stiffness(self.pressure), self.tangential_stiffness_per_area),
        }
        return {name: float(by_law / computed - 1) for name, (by_law, computed) in pairs.items()}

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences, the most important first."""
        return in_order(self._notes())

    def _notes(self) -> Iterator[Note]:
        pressed, limit = self.reversal.problem.pressed, self.reversal.problem.limit
        if not self.status.converged:
            yield Note(Rank.WRONG, f"Residual {self.residual:.1e}: {self.status.message}")
        if beyond := int(namespace(limit).count_nonzero(limit > self.shear_strength)):
            share, strength = 100 * beyond / limit.shape[0], self.shear_strength
            text = f"On {share:.3g} % of the contact, mu p exceeds the shear strength of {strength:.3g} Pa"
            yield Note(Rank.WRONG, f"{text}: Coulomb's law is wrong there.")
        yield from (Note(Rank.DOUBTFUL, text) for text in self.reversal.notes)
        if pressed.flow is not None:
            yield Note(Rank.LIMITED, FLOWED)
        if not all(pressed.problem.grid.periodic):
            areas = [
                np.trapezoid(self.loop.traction, moved)
                for moved in (self.loop.displacement, self.bodies_displacement)
            ]
            yield Note(
                Rank.LIMITED,
                "The edges of the map are free: the loss is the area of the loop of the bodies. The loop of the "
                "surfaces, to which a law from the normal curve refers, has "
                f"{areas[0] / areas[1]:.3g} times this area.",
            )

    def to_dataset(self) -> xarray.Dataset:
        """Return the cycle as a dataset: loop, first loading, the map of the heat, and the cycle of the law.

        The loop lies along ``loop``, first loading along ``first``, the loop of the law along ``estimate``, and the
        heat along ``y, x`` with the cell centres [m] as coordinates; row 0 is the top of the picture.

        Returns
        -------
        xarray.Dataset
            Variables with units and long names.
        """
        data = variables_of(self, CYCLE, Geometry.SURFACE, CYCLE_NAMES)
        if self.estimate is not None:
            data |= variables_of(self, ESTIMATE, Geometry.SURFACE, CYCLE_NAMES)
        places = centres(self.reversal.problem.operator.grid, Geometry.SURFACE)
        title = "a cycle of an interface under shear, per nominal area"
        return dataset_of(data, places, title, Geometry.SURFACE).assign_attrs(notes="\n".join(self.notes))

    def __repr__(self) -> str:
        """Return the main numbers, without the fields."""
        s, tau = self.loop.displacement[0], self.loop.traction[0]
        return (
            f"SlipCycle({self.status.value}, {tau:.4g} Pa and {s:.4g} m at {self.pressure:.4g} Pa, "
            f"{self.loop.loss:.4g} J/m^2 a cycle, residual {self.residual:.1e})"
        )

    plot = methods.shear_loop


@numeric(traction="Pa", displacement="m", shear_strength="Pa")
def shear_cycle(
    solution: Solution,
    bodies: Elastic | tuple[Elastic, Elastic],
    *,
    friction: float,
    traction: Load | None = None,
    displacement: Load | None = None,
    steps: int = 10,
    along: Sequence[float] | None = None,
    law: ShearLaw | None = None,
    shear_strength: float | None = None,
    tolerance: float = 1e-8,
) -> SlipCycle:
    """Compute first loading and a full cycle of a pressed contact under shear, per nominal area, by partial slip.

    Parameters
    ----------
    solution : Solution
        The pressed contact of a map: after plastic flow, a state of `loading_path` whose pressure was reduced.
    bodies : Solid, Material, str, or a pair of them
        The bodies of the pressed contact; a single one is pressed against a rigid body.
    friction : float
        Coefficient of friction mu.
    traction, displacement : float or pair of floats
        Give exactly one amplitude: of the nominal tangential traction, at most mu p [Pa], or, on a periodic map, of the
        displacement [m]; as (x, y), or one number along x (along `along`, if given).
    steps : int
        Number of equal steps of first loading; the cycle has four times as many.
    along : pair of floats, optional
        Let traction act only in this direction (x, y), see `slide`.
    law : ShearLaw, optional
        The law from the normal curve, of the same bodies and friction, to compare with.
    shear_strength : float, optional
        Largest traction that a cell bears [Pa], for a note where mu p exceeds it.
    tolerance : float
        Largest residual.

    Returns
    -------
    SlipCycle
        Loop, backbone, stiffness and heat; if a state misses its tolerance, its `status` shows it.

    Raises
    ------
    ValueError
        If the input is invalid, or the law belongs to other bodies, another friction or other pressures.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3)
    >>> pressed = rc.press(ball, rubber, force=1e-3)
    >>> rc.shear_cycle(pressed, rubber, friction=0.5, traction=2e3, steps=2)
    SlipCycle(converged, 2000 Pa and 2.443e-07 m at 9766 Pa, 0.0001251 J/m^2 a cycle, residual 3.2e-09)
    """
    name, amplitude = exactly_one(traction=traction, displacement=displacement)
    size, p = float(np.linalg.norm(number(amplitude, name))), solution.nominal_pressure
    limit = positive_scalar(friction, "the friction coefficient") * p
    require(size > 0, f"the amplitude of the {name} must not be zero", place=name)
    require(
        name == "displacement" or size <= limit * (1 + _ROUNDING),
        f"the surfaces slide under more than mu p = {limit:.6g} Pa, and {size:.6g} Pa are given",
        "give a smaller traction, or press harder",
        place=name,
    )
    require(
        name == "traction" or (solution.problem.semidefinite and not solution.missing),
        "the displacement of the surfaces is prescribed only on a periodic map without missing cells",
        "give a traction",
        place=name,
    )
    require(
        solution.flattened.interfacial_stiffness < math.inf,
        "every cell is in contact, so the surfaces cannot move against each other while they stick",
        "press with a smaller load",
        place="solution",
    )
    strength = math.inf
    if shear_strength is not None:
        strength = positive_scalar(shear_strength, "the shear strength [Pa]")
    solids = solids_of(*bodies) if isinstance(bodies, tuple) else solids_of(bodies)
    loads = load_cycle(amplitude, steps=steps)
    estimate = None
    if law is not None:
        require(
            (law.friction, law.bodies) == (friction, solids),
            f"the law has friction {law.friction:g} and {law.bodies}, the cycle friction {friction:g} and {solids}",
            "use the same for both",
            place="law",
        )
        estimate = law.cycle(p, **{name: size})
    path = slide_path(
        solution,
        solids if len(solids) == 2 else solids[0],
        friction=friction,
        forces=loads * solution.nominal_area if name == "traction" else None,
        displacements=loads if name == "displacement" else None,
        along=along,
        tolerance=tolerance,
    )
    return replace(_collected(path, steps), shear_strength=strength, law=law, estimate=estimate)


def _collected(path: Iterator[TangentialSolution], steps: int) -> SlipCycle:
    """Return the cycle of the states of first loading and of the cycle; their fields are not kept."""
    first = last = next(path)
    problem, pressed = first.problem, first.problem.pressed
    direction = np.array([first.load.x, first.load.y]) / math.hypot(first.load.x, first.load.y)
    mean = _mean_response(problem, direction)
    xp, area = namespace(mean), pressed.nominal_area
    heat, at_mean, stored, rows, states = 0.0 * mean[0, ...], 0.0, 0.0, [(0.0, 0.0, 0.0)], []
    for count, state in enumerate(chain([first], path), 1):
        moved = float(direction @ state.displacement)
        rows.append((float(direction @ state.force) / area, moved, moved - inner(mean, state.traction)))
        states.append((state.status, state.residual))
        if count == steps:
            stored = state.elastic_energy
        if count > steps:
            slipped = state.slip - last.slip
            heat = heat - xp.sum(state.traction * slipped, axis=0)
            at_mean -= inner(last.traction + state.traction, slipped) / 2
        last = state
    traction, bodies, surfaces = np.array(rows).T
    cell, tangential = problem.interface.area, _sticking(problem, direction, mean)
    loss, energy = float(xp.sum(heat)) * cell / area, traction[steps] * surfaces[steps] / 2
    balance = np.trapezoid(traction[steps:], bodies[steps:])
    balance -= (at_mean * cell + last.elastic_energy - stored) / area
    return SlipCycle(
        ShearCycle(surfaces[steps:], traction[steps:], loss, float(loss / (4 * math.pi * energy))),
        surfaces[: steps + 1],
        traction[: steps + 1],
        bodies[steps:],
        heat,
        tangential / area,
        pressed.flattened.interfacial_stiffness / tangential,
        float(balance / loss) if loss else 0.0,
        max(residual for _, residual in states),
        next((status for status, _ in states if not status.converged), last.status),
        last,
    )


def _mean_response(problem: SlipProblem, direction: Array) -> Array:
    """Return the mean displacement of the measured cells along a direction per traction of each cell [m/Pa].

    It is the displacement under a uniform traction on these cells, because the operator is symmetric.
    """
    pressed = problem.pressed.problem
    measured = namespace(pressed.separation).astype(pressed.measured, pressed.separation.dtype)
    count = float(namespace(measured).sum(measured))
    return problem.operator.apply(as_like(direction[:, None, None], measured) * measured[None, ...] / count)


@one_blas_thread()
def _sticking(problem: SlipProblem, direction: Array, mean: Array) -> float:
    """Return the force over the displacement of the surfaces along a direction while nothing slips [N/m]."""
    cells = problem.interface
    tractions = [displaced(cells, unit, TOLERANCE)[0] for unit in cells.units()]
    along = cells.basis @ direction
    forces = np.array([on_host(namespace(each).sum(each, axis=1)) * cells.area for each in tractions])
    moved = np.linalg.solve(forces.T, along)  # displacement of the bodies under a unit force
    traction = sum(part * each for part, each in zip(moved.tolist(), tractions, strict=True))
    return float(1 / (along @ moved - inner(mean, cells.prolong(traction))))
