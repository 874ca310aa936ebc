"""The curve of tangential loading: force, displacement and what friction takes, load by load."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.contact.solution import Solution
from roughcontact.friction.slide_path import Loads, slide_path
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.halfspace.shear.shear_operator import ShearOperator
from roughcontact.material import Bodies
from roughcontact.solver.status import Status
from roughcontact.validation import numeric

if TYPE_CHECKING:
    import xarray

__all__ = ["SlipCurve", "slide_curve"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class SlipCurve:
    """Points of a tangential loading path, in the order of time.

    Attributes
    ----------
    force, displacement : array, shape (n, 2)
        Tangential force [N] and displacement [m], x and y.
    stick_area, slip_area : array, shape (n,)
        Area that holds and area that slips [m^2].
    dissipated : array, shape (n,)
        Energy that friction took in the step that ends at the point [J].
    elastic_energy : array, shape (n,)
        Elastic energy of the tangential displacement [J].
    residual : array, shape (n,)
    status : tuple of Status
    capacity : float
        Largest force that friction holds, mu P [N].
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
        """Energy that friction has taken since the start [J], shape (n,)."""
        return np.cumsum(self.dissipated)

    def __repr__(self) -> str:
        """Say what the curve spans, not its numbers."""
        converged = sum(status.converged for status in self.status)
        largest = float(np.hypot(*self.force.T).max())
        return (
            f"SlipCurve({converged} of {len(self)} points converged, forces up to {largest:.4g} of "
            f"{self.capacity:.4g} N, {self.dissipated.sum():.4g} J dissipated)"
        )

    def to_dataset(self) -> xarray.Dataset:
        """Return the curve as an `xarray.Dataset` with units and long names."""
        from roughcontact.friction.slip_dataset import slip_curve_dataset

        return slip_curve_dataset(self)

    def to_record(self) -> dict[str, Any]:
        """Return the curve as plain values, for JSON."""
        from roughcontact.friction.slip_dataset import slip_curve_record

        return slip_curve_record(self)


@numeric
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
    """Return displacement, slip area and dissipated energy along a path of loads; see `slide_path`."""
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
    """Drain a path, of at least one load, into a curve; fields are not kept."""
    points: list[tuple[float, ...]] = []
    status: list[Status] = []
    for state in path:
        points.append(_point(state))
        status.append(state.status)
        capacity = state.problem.capacity
    columns = np.array(points).T
    return SlipCurve(
        force=columns[0:2].T,
        displacement=columns[2:4].T,
        stick_area=columns[4],
        slip_area=columns[5],
        dissipated=columns[6],
        elastic_energy=columns[7],
        residual=columns[8],
        status=tuple(status),
        capacity=capacity,
    )


def _point(state: TangentialSolution) -> tuple[float, ...]:
    return (
        *state.force,
        *state.displacement,
        state.stick_area,
        state.slip_area,
        state.dissipated,
        state.elastic_energy,
        state.residual,
    )
