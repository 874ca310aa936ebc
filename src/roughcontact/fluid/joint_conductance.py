"""Conductance of a joint: its spots, films on them, the gas beside them, and radiation.

Heat crosses a cell through a resistance r beside that of the bodies: of a film in contact, of the gas and radiation on
open cells. The flux j of a unit drop fulfils ``(C + r) j = 1``, where C is the operator of the contact times
``E*/k_s``: the exact analogy of `roughcontact.conductance`, with one more term on the diagonal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.constants import Stefan_Boltzmann
from scipy.sparse.linalg import LinearOperator, cg

from roughcontact.arrays import is_numpy
from roughcontact.cached import cached_property
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.fluid.fluids import Gas
from roughcontact.grid import Grid
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, exact_of, self_influences
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.theory.joints.conductance import harmonic_mean
from roughcontact.validation import Array, Mask, exactly_one, numeric, pair, require

__all__ = ["JointConductance", "coefficients", "joint_conductance"]

ADDITIVE = 0.2  # h l/k_s of gas and radiation, up to which they add to the spots; tests/fluid/test_joint_conductance.py
RADIATES = 0.01  # of the total, from which a note on radiation is made
NEAR_FIELD = Note(
    Rank.LIMITED,
    "Radiation counts here. Gaps below about 2 mm K over the temperature exchange more than computed.",
)
TOLERANCE = 1e-7  # of the drop, root mean square; the error of the conductance is about its square
MOST_STEPS = 5000


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class JointConductance:
    """The conductance of a joint per nominal area and its parts [W/(m^2 K)]; of an electrical joint [S/m^2].

    Attributes
    ----------
    solution : Solution
        The contact; under a hardness the flattened one, since plastic cells conduct as well.
    conductivity : float
        Of both bodies in series, their harmonic mean k_s [W/(m K)] or [S/m].
    film : float
        Resistance of the film on the spots times area [m^2 K/W] or [ohm m^2].
    gas_cells : array, shape of the grid
        Conductance of the gas per area of each cell [W/(m^2 K)]: 0 in contact, and where no height is known.
    radiation_coefficient : float
        Conductance of the radiation per open area [W/(m^2 K)].

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 4e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=1, rolloff=64e-6, short_cutoff=32e-6)
    >>> steel = rc.handbook("steel")
    >>> solution = rc.press(surface, (steel, steel), pressure=3e7)
    >>> rc.joint_conductance(solution, conductivities=(steel.conductivity, steel.conductivity)).gas
    0.0
    """

    solution: Solution
    conductivity: float
    film: float
    gas_cells: Array
    radiation_coefficient: float

    @cached_property
    def spots(self) -> float:
        """Conductance of the spots with their film; without a film, that of `roughcontact.conductance`."""
        if self.film:
            return self._solve(np.zeros(self.gas_cells.shape))[0]
        return self._unit * self.solution.interfacial_stiffness_per_area

    @cached_property
    def gas(self) -> float:
        """Conductance of the gas over the open cells."""
        return float(self.gas_cells.mean())

    @property
    def radiation(self) -> float:
        """Conductance of the radiation over the open cells."""
        return self.radiation_coefficient * float(np.mean(self._open))

    @property
    def parts_sum(self) -> float:
        """Sum of the parts, without their interaction in the bodies."""
        return self.spots + self.gas + self.radiation

    @property
    def interaction(self) -> float:
        """Of gas and radiation times the longer side of the map over k_s [1]: small where the parts add."""
        return (self.gas + self.radiation) * max(self.solution.problem.grid.lengths) / self.conductivity

    @property
    def additive(self) -> bool:
        """Whether `total` is the sum of the parts: `interaction` is at most 0.2."""
        return self.interaction <= ADDITIVE

    @property
    def total(self) -> float:
        """The conductance: the sum of the parts, or `solved` where they do not add."""
        return self.parts_sum if self.additive else self.solved

    @property
    def solved(self) -> float:
        """The conductance with all parts in one solve."""
        return self._solution_of_all[0]

    @property
    def residual(self) -> float:
        """Error of the unit drop in `solved`, root mean square: its certificate."""
        return self._solution_of_all[1]

    @property
    def residual_of_total(self) -> float:
        """Error of the unit drop in `total`, root mean square: that of `solved`, and 0 for a sum."""
        return 0.0 if self.additive else self.residual

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences."""
        return in_order(self._ranked_notes())

    def _ranked_notes(self) -> Iterator[Note]:
        """Yield the notes with their ranks."""
        if not self.additive:
            yield Note(
                Rank.USUAL,
                f"The parts do not add up (h l/k_s = {self.interaction:.2g}): the total is solved as a whole.",
            )
            if not self.residual <= TOLERANCE:
                yield Note(
                    Rank.WRONG,
                    f"The drop is met to {self.residual:.0e}, where {TOLERANCE:.0e} was asked for.",
                )
        if self.radiation > RADIATES * self.total:
            yield NEAR_FIELD
        if self.solution.missing:
            yield Note(
                Rank.LIMITED,
                f"{self.solution.missing} cells hold no height: no gas conducts and no radiation crosses there.",
            )

    def __repr__(self) -> str:
        """Return the parts and the total."""
        parts = ", ".join(f"{name} {getattr(self, name):.4g}" for name in ("spots", "gas", "radiation"))
        return f"JointConductance({parts}, total {self.total:.4g})"

    @property
    def _unit(self) -> float:
        """Conductance over stiffness."""
        return self.conductivity / self.solution.problem.modulus

    @property
    def _open(self) -> Mask:
        return ~self.solution.contact & self.solution.problem.measured

    @cached_property
    def _solution_of_all(self) -> tuple[float, float]:
        return self._solve(self.gas_cells + self.radiation_coefficient * self._open)

    def _solve(self, beside: Array) -> tuple[float, float]:
        """Return the conductance with a conductance beside the spots [W/(m^2 K)], and the error of the drop."""
        solution = self.solution
        contact, operator = solution.contact, exact_of(solution.problem.operator)
        if not self.film and contact.all():
            return np.inf, 0.0
        with np.errstate(divide="ignore"):
            compliance = np.where(contact, self.film, 1 / beside) * self._unit
        initial = None if self.film else solution.frozen.tangent
        stiffness, displacement, error = stiffness_on_springs(operator, compliance, initial)
        # The drop across the interface, without that in the bodies beside a free map.
        drop = 1 - float(displacement[solution.problem.measured].mean())
        return self._unit * stiffness / (solution.nominal_area * drop), error


def stiffness_on_springs(
    operator: Operator, compliance: Array, initial: Array | None = None
) -> tuple[float, Array, float]:
    """Return the response of cells that are bonded through springs and displaced as a whole: ``(A + c) p = 1``.

    Parameters
    ----------
    operator : Operator
        Of a map, whose cells are of one size.
    compliance : array, shape of the grid
        Of the spring of each cell [m/Pa]; infinite for a cell that carries nothing.
    initial : array, optional
        Pressure per displacement on cells without a spring [Pa/m], to start from.

    Returns
    -------
    tuple
        Force [N/m] and displacement of the body [1], per unit displacement, and the error of the latter, root mean
        square.
    """
    cells = np.flatnonzero(np.isfinite(compliance))
    own = compliance.ravel()[cells]
    diagonal = own + np.broadcast_to(self_influences(operator), compliance.shape).ravel()[cells]

    def displaced(pressure: Array) -> Array:
        field = np.zeros(compliance.shape)
        field.ravel()[cells] = pressure
        return operator.apply(field)

    def linear(function: Callable[[Array], Array]) -> LinearOperator:
        return LinearOperator((len(cells),) * 2, matvec=function, dtype=np.float64)

    start = 1 / diagonal
    if initial is not None:
        start = np.where(own > 0, start, initial.ravel()[cells])
    pressure, _ = cg(
        linear(lambda p: displaced(p).ravel()[cells] + own * p),
        np.ones(len(cells)),
        start,
        rtol=0.5 * TOLERANCE,
        maxiter=MOST_STEPS,
        M=linear(lambda r: r / diagonal),
    )
    displacement = displaced(pressure)
    left = 1 - displacement.ravel()[cells] - own * pressure
    area = float(np.ravel(operator.weights)[0])
    return area * float(pressure @ (1 + left)), displacement, float(np.sqrt(np.mean(left**2)))


def _film_unit(given: Mapping[str, Any]) -> str:
    return "m^2*K/W" if given.get("resistivities") is None else "ohm*m^2"


@numeric(conductivities="W/m/K", resistivities="ohm*m", film=_film_unit, temperature="K")
def joint_conductance(
    solution: Solution,
    *,
    conductivities: tuple[float, float] | None = None,
    resistivities: tuple[float, float] | None = None,
    gas: Gas | None = None,
    emissivities: tuple[float, float] | None = None,
    temperature: float | None = None,
    film: float = 0.0,
) -> JointConductance:
    """Return the conductance of a joint with its parts: spots with a film, gas in the gap, and radiation.

    Parameters
    ----------
    solution : Solution
        Of a map of heights.
    conductivities, resistivities : tuple of float
        Thermal conductivities of both bodies [W/(m K)], or their electrical resistivities [ohm m].
    gas : Gas, optional
        With its pressure, and the accommodation coefficients of both bodies; none for vacuum.
    emissivities : tuple of float, optional
        Of both bodies [1], for radiation.
    temperature : float, optional
        Temperature of the joint in vacuum, for radiation [K]; left out with a gas, whose temperature is used.
    film : float
        Resistance of a film on the spots, such as an oxide, times area [m^2 K/W] or [ohm m^2]. It is in series with the
        constriction of each spot, so both are solved together.

    Returns
    -------
    JointConductance
        Parts, their sum, and the total.

    Raises
    ------
    ValueError
        If the contact is not that of a map in memory of NumPy; if the gas has no accommodation coefficients; if
        radiation has no temperature, or two; or if a number is out of range.

    Notes
    -----
    The gas conducts ``k_g/(g + M)`` on each cell, where g is the gap and M the jump distance of the temperature
    (Yovanovich): exact for a continuum and for free molecules, an interpolation between. Contact cells have no gas.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 4e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=1, rolloff=64e-6, short_cutoff=32e-6)
    >>> solution = rc.press(surface, 1.1e11, pressure=3e7)
    >>> air = rc.Gas("air", pressure=101325, accommodation=(0.9, 0.9))
    >>> joint = rc.joint_conductance(solution, conductivities=(50, 160), gas=air)
    >>> joint.total == joint.spots + joint.gas, abs(joint.solved / joint.total - 1) < 0.01
    (True, True)
    """
    problem, grid = solution.problem, solution.problem.grid
    if (
        problem.geometry is not Geometry.SURFACE
        or not isinstance(grid, Grid)
        or not is_numpy(solution.pressure)
    ):
        raise InputError(
            "the conductance of a joint needs a map of heights in NumPy's memory",
            "press a Surface",
            "solution",
        )
    mean, radiation = coefficients(
        conductivities=conductivities,
        resistivities=resistivities,
        gas=gas,
        emissivities=emissivities,
        temperature=temperature,
        film=film,
    )
    flat = solution.flattened
    cells = np.zeros(grid.shape)
    if gas is not None:
        is_open = ~flat.contact & problem.measured
        cells[is_open] = gas.conductance(np.maximum(flat.gap[is_open], 0.0))
    cells.flags.writeable = False
    return JointConductance(flat, mean, film, cells, radiation)


def coefficients(
    *,
    conductivities: tuple[float, float] | None = None,
    resistivities: tuple[float, float] | None = None,
    gas: Gas | None = None,
    emissivities: tuple[float, float] | None = None,
    temperature: float | None = None,
    film: float = 0.0,
) -> tuple[float, float]:
    """Return the conductivity of both bodies in series and the conductance of radiation [W/(m^2 K)].

    Raises
    ------
    ValueError
        If the arguments of `joint_conductance` make no sense together.
    """
    exactly_one(conductivities=conductivities, resistivities=resistivities)
    if resistivities is not None and (gas is not None or emissivities is not None):
        raise InputError("gas and radiation carry no current", "give conductivities", "gas, emissivities")
    if resistivities is not None:
        mean = 2 / sum(map(float, pair(resistivities, "resistivities")))
    else:
        assert conductivities is not None
        mean = harmonic_mean(conductivities)
        require(mean > 0, "an insulator has no conductance", place="conductivities")
    if not 0 <= film < np.inf:
        raise about("the film", f"must have a finite resistance of 0 or more, not {film}")
    if gas is not None:
        if not isinstance(gas, Gas):
            raise about("the gas", f"must be an rc.Gas, not {gas!r}")
        _ = gas.jump_distance  # raises an error without pressure and accommodation
        if temperature is not None:
            raise InputError("the gas has a temperature already", "leave temperature out", "temperature")
    radiation = 0.0
    if emissivities is not None:
        radiation = _radiation(emissivities, gas.temperature if gas is not None else temperature)
    return mean, radiation


def _radiation(emissivities: tuple[float, float], temperature: float | None) -> float:
    """Return the conductance of radiation between two plates [W/(m^2 K)], for a small difference of temperature."""
    both = pair(emissivities, "emissivities")
    require(np.max(both) <= 1, "an emissivity is at most 1", place="emissivities")
    if temperature is None or not 0 < temperature < np.inf:
        raise InputError("radiation depends on the temperature", "give temperature=300 [K]", "temperature")
    return float(4 * Stefan_Boltzmann * temperature**3 / (1 / both[0] + 1 / both[1] - 1))
