"""The curve of tangential loading: force, displacement and dissipated energy, load by load."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.contact.solution import Solution
from roughcontact.friction.slide import Loads, slide_path
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.guesses import hinted
from roughcontact.halfspace.shear.shear_operator import ShearOperator
from roughcontact.material import Bodies
from roughcontact.solver.control import Status
from roughcontact.validation import Array, numeric

__all__ = ["SlipCurve", "slide_curve"]

# Attributes of a state that become columns of the curve.
_COLUMNS = ("force", "displacement", "stick_area", "slip_area", "dissipated", "elastic_energy", "residual")


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class SlipCurve:
    """Points of a tangential loading path, in the order of time.

    Attributes
    ----------
    force, displacement : array, shape (n, 2)
        Tangential force [N] and displacement [m], x and y.
    stick_area, slip_area : array, shape (n,)
        Area that sticks and area that slips [m^2].
    dissipated : array, shape (n,)
        Energy dissipated by friction in the step that ends at the point [J].
    elastic_energy : array, shape (n,)
        Elastic energy of the tangential displacement [J].
    residual : array, shape (n,)
    status : tuple of Status
    capacity : float
        Largest force that friction holds, mu P [N].

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> curve = rc.slide_curve(pressed, rubber, friction=0.5, forces=rc.load_cycle(0.25e-3, steps=2))
    >>> f"{len(curve)} loads, {curve.dissipated_energy[-1] * 1e9:.3f} nJ lost"
    '10 loads, 0.028 nJ lost'
    >>> curve.to_dataset()["tangential_displacement"].attrs["units"], len(curve.to_record()["stick_area"])
    ('m', 10)
    """

    force: Array
    displacement: Array
    stick_area: Array
    slip_area: Array
    dissipated: Array
    elastic_energy: Array
    residual: Array
    status: tuple[Status, ...]
    capacity: float

    def __len__(self) -> int:
        return len(self.force)

    @property
    def dissipated_energy(self) -> Array:
        """Energy dissipated by friction since the start [J], shape (n,)."""
        return np.cumsum(self.dissipated)

    def __repr__(self) -> str:
        """Return the range of the curve, not its numbers."""
        converged = sum(status.converged for status in self.status)
        largest = float(np.hypot(*self.force.T).max())
        return (
            f"SlipCurve({converged} of {len(self)} points converged, forces up to {largest:.4g} of "
            f"{self.capacity:.4g} N, {self.dissipated.sum():.4g} J dissipated)"
        )

    to_csv = methods.csv_of
    to_dataset = methods.slip_curve_dataset
    to_record = methods.slip_curve_record


@numeric(forces="N", displacements="m")
def slide_curve(
    solution: Solution,
    bodies: Bodies,
    *,
    friction: float,
    forces: Loads | None = None,
    displacements: Loads | None = None,
    along: Sequence[float] | None = None,
    operator: ShearOperator | None = None,
    tolerance: float = 1e-8,
) -> SlipCurve:
    """Return displacement, slip area and dissipated energy along a path of loads; see `slide_path`.

    Parameters
    ----------
    solution : Solution
        The pressed contact, of a surface of two axes, free or periodic.
    bodies : Solid or pair of Solids
        The bodies of the pressed contact; a single one is pressed against a rigid body.
    friction : float
        Coefficient of friction mu.
    forces, displacements : array, shape (n,) or (n, 2)
        Give exactly one: tangential forces [N] or displacements [m] in any order, up and down; see `load_cycle`.
    along : pair of floats, optional
        Direction (x, y) of the traction, see `slide`.
    operator : ShearOperator, optional
        Another body than the half-spaces on the grid, see `slide`.
    tolerance : float
        Largest residual.

    Returns
    -------
    SlipCurve
        One point for each load; fields are not kept.

    Raises
    ------
    ValueError
        If the input is invalid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3)
    >>> pressed = rc.press(ball, rubber, force=1e-3)
    >>> curve = rc.slide_curve(pressed, rubber, friction=0.5, forces=[0.1e-3, 0.2e-3, 0.3e-3])
    >>> bool(curve.slip_area[0] < curve.slip_area[-1])
    True
    """
    path = slide_path(
        solution,
        bodies,
        friction=friction,
        forces=forces,
        displacements=displacements,
        along=along,
        operator=operator,
        tolerance=tolerance,
    )
    return collect(path)


def collect(path: Iterable[TangentialSolution]) -> SlipCurve:
    """Collect a path, of at least one load, into a curve; fields are not kept."""
    rows, status = [], []
    for state in path:
        rows.append([getattr(state, name) for name in _COLUMNS])
        status.append(state.status)
        capacity = state.problem.capacity
    columns = {name: np.array(values) for name, values in zip(_COLUMNS, zip(*rows, strict=True), strict=True)}
    return SlipCurve(**columns, status=tuple(status), capacity=capacity)
