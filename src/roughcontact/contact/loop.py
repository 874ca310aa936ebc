"""A loop of loads: first loading, during which the surface flows, then elastic unloading and reloading."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice

import numpy as np

from roughcontact import methods
from roughcontact.contact.curve import Curve, collect
from roughcontact.contact.curve_record import CurvePoint
from roughcontact.contact.flow import Flow, FlowModel
from roughcontact.contact.loading import solutions_along, suitable
from roughcontact.contact.problem import Body
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.solution import Solution
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit, unit_of
from roughcontact.materials import Modulus
from roughcontact.solver.control import Solver
from roughcontact.solver.loads import Loads
from roughcontact.validation import Array, numeric, require

__all__ = ["BRANCHES", "Loop", "closed_loop", "collect_loop", "loading_loop", "loads_of_loop"]

BRANCHES = ("loading", "unloading", "reloading")


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class Loop:
    """A surface that is pressed for the first time, unloaded and pressed again.

    Attributes
    ----------
    loading : Curve
        First loading, up to the largest load; ``loading.flow`` is its flow.
    unloading, reloading : Curve
        From the largest load down to the smallest, and up again, on the flattened surface; all cells in contact
        contribute to the stiffness. Depths count from the first touch of the original surface.
    surface : Surface or RadialProfile
        The original surface.
    flattened : Surface or RadialProfile
        The surface after the largest load, with its provenance.
    flow : Flow
        The flow at the largest load.
    residual_depth : float
        Depth at which the flattened surface is touched without force [m]: the permanent part of the approach.
    residual_gap : float
        Mean gap of the flattened surface at that touch [m].

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2])
    >>> f"{loop.dissipated_work * 1e9:.1f} of {loop.work * 1e9:.1f} nJ are lost", loop.converged
    ('6.5 of 25.7 nJ are lost', True)
    >>> loop.to_dataset()["residual_depth"].attrs["units"]
    'm'
    """

    loading: Curve
    unloading: Curve
    reloading: Curve
    surface: Body
    flattened: Body
    flow: Flow
    residual_depth: float
    residual_gap: float

    @property
    def curves(self) -> dict[str, Curve]:
        """The three branches by name, in their order."""
        return {name: getattr(self, name) for name in BRANCHES}

    def __iter__(self) -> Iterator[CurvePoint]:
        """Yield the loads of first loading, of unloading and of reloading, each as a record."""
        return chain.from_iterable(self.curves.values())

    @property
    def converged(self) -> bool:
        """Whether every load of every branch met its tolerance."""
        return all(status.converged for curve in self.curves.values() for status in curve.status)

    @property
    def dissipated_work(self) -> float:
        """Work of loading that unloading does not return [J]: the area of the loop, equal to the energy of flow.

        NaN if the surface rises and the loads are too few for the work of the rise, see `Flow`.
        """
        return self.flow.energy

    @property
    def work(self) -> float:
        """Work of first loading [J]: the elastic energy at the largest load plus the dissipated work."""
        return float(self.loading.elastic_energy[-1]) + self.dissipated_work

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes on first loading. A power law describes first loading, not unloading."""
        return self.loading.notes

    def __repr__(self) -> str:
        """Return the range of the loop, without its arrays."""
        unit = unit_of("force", self.loading.geometry)
        return (
            f"Loop({len(self.loading)} loads up to {self.loading.force[-1]:.4g} {unit}, residual depth "
            f"{self.residual_depth:.4g} m, {self.flow!r})"
        )

    to_csv = methods.csv_of
    to_dataset = methods.loop_dataset
    to_record = methods.loop_record
    plot = methods.plot_loop
    _repr_html_ = methods.loop_html


@numeric(modulus="Pa", forces=force_unit, pressures="Pa", hardness="Pa")
def loading_loop(
    surface: Body,
    modulus: Modulus,
    *,
    hardness: Hardness,
    forces: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    flow: FlowModel = "removed",
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
) -> Loop:
    """Press a surface for the first time, unload it and press it again.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    hardness : float, array, function, Material or str
        Pressure that no cell exceeds [Pa]: the hardness of the softer body, see `press`.
    forces, pressures : array, shape (n,)
        At most one: strictly increasing forces [N] or nominal pressures [Pa], of which the last is the largest load.
        Unloading and reloading use the same loads. Without any, 24 forces that suit the surface, see `load_range`.
    flow : {"removed", "raised"}
        What happens to material that flows, see `loading_path`.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.

    Returns
    -------
    Loop
        Three curves, the flattened surface, and the flow.

    Raises
    ------
    ValueError
        If the input makes no sense.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2])
    >>> f"{loop.residual_depth * 1e9:.0f} of {loop.loading.depth[-1] * 1e9:.0f} nm stay"
    '78 of 303 nm stay'
    >>> f"k {loop.loading.stiffness[-1]:.3g} N/m, and {loop.unloading.stiffness[0]:.3g} N/m as it is unloaded"
    'k 8.3e+05 N/m, and 1.15e+06 N/m as it is unloaded'
    """
    require(
        hardness is not None, "a loop needs a hardness: without one nothing flows, and loading is unloading"
    )
    loads = Loads.given(forces=forces, pressures=pressures) or suitable(surface, modulus, operator, hardness)
    whole = loads_of_loop(loads)
    path = solutions_along(surface, modulus, whole, operator, solver, tolerance, hardness, flow)
    return collect_loop(path, len(loads.values))


def loads_of_loop(loads: Loads) -> Loads:
    """Return rising loads, up, down and up again.

    Raises
    ------
    ValueError
        If the loads do not rise.
    """
    values = loads.rising("a loop goes down them and up again by itself").values
    return Loads(loads.kind, np.concatenate([values, values[::-1], values]))


def collect_loop(path: Iterator[Solution], count: int) -> Loop:
    """Drain a path of loads, up, down and up again, into a loop; only the fields at the largest load are kept."""
    turn: list[Solution] = []

    def watched() -> Iterator[Solution]:
        for solution in islice(path, count):
            turn[:] = [solution]
            yield solution

    return closed_loop(collect(watched()), turn[0], path)


def closed_loop(loading: Curve, turn: Solution, path: Iterator[Solution]) -> Loop:
    """Return the loop of a curve of first loading, its last state, and the path of the loads that follow."""
    unloading, reloading = (collect(islice(path, len(loading))) for _ in range(2))
    before, after = turn.problem.surface, turn.flattened.problem
    assert turn.flow is not None
    assert before is not None
    assert after.surface is not None
    touch = after.first_touch
    return Loop(
        loading, unloading, reloading, before, after.surface, turn.flow, touch, after.mean_separation - touch
    )
