"""The thermal conductance of a joint by its parts, for each state of a loading curve."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from roughcontact.contact.curve import Curve
from roughcontact.contact.solution import Solution
from roughcontact.fluid.fluids import Gas
from roughcontact.fluid.joint_conductance import (
    ADDITIVE,
    NEAR_FIELD,
    RADIATES,
    TOLERANCE,
    coefficients,
    joint_conductance,
)
from roughcontact.labels.flux_columns import HEAT_PARTS_NAMES
from roughcontact.labels.note import Note, Rank
from roughcontact.validation import require_numbers

__all__ = ["ConductanceParts", "notes_on_heat_curve"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConductanceParts:
    """A measure of a loading curve: the parts of `roughcontact.joint_conductance` at each load.

    Parameters
    ----------
    conductivities : tuple of float
        Thermal conductivities of both bodies [W/(m K)].
    gas : Gas, optional
        With its pressure, and the accommodation coefficients of both bodies; none for vacuum.
    emissivities : tuple of float, optional
        Of both bodies [1], for radiation.
    temperature : float, optional
        Temperature of the joint in vacuum, for radiation [K]; left out with a gas, whose temperature is used.
    film : float
        Resistance of a film on the spots times area [m^2 K/W].

    Raises
    ------
    ValueError
        As `roughcontact.joint_conductance`, before any load is pressed.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 4e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=1, rolloff=64e-6, short_cutoff=32e-6)
    >>> air = rc.Gas("air", pressure=101325, accommodation=(0.9, 0.9))
    >>> parts = rc.ConductanceParts(conductivities=(50, 160), gas=air)
    >>> curve = rc.loading_curve(surface, 1.1e11, pressures=[1e7, 3e7], measures=[parts])
    >>> curve.measured["gas_conductance_per_area"].round(-2)  # W/(m^2 K)
    array([10900., 11600.])
    """

    conductivities: tuple[float, float]
    gas: Gas | None = None
    emissivities: tuple[float, float] | None = None
    temperature: float | None = None
    film: float = 0.0

    def __post_init__(self) -> None:
        require_numbers(self, conductivities="W/m/K", temperature="K", film="m^2*K/W")
        coefficients(**self._given())

    def __call__(self, solution: Solution, /) -> dict[str, float]:
        """Return the conductances of a state per nominal area [W/(m^2 K)] by name.

        Parameters
        ----------
        solution : Solution
            Of a map of heights.

        Returns
        -------
        dict of str to float
            Conductances [W/(m^2 K)] of ``spots``, ``gas``, ``radiation`` and ``joint``, each with
            ``_conductance_per_area`` after it; ``conductance_interaction`` and ``conductance_residual``, see
            `JointConductance`.
        """
        joint = joint_conductance(solution, **self._given())
        return {name: float(getattr(joint, found)) for name, found in HEAT_PARTS_NAMES.items()}

    def _given(self) -> dict[str, Any]:
        return {each.name: getattr(self, each.name) for each in fields(self)}


def notes_on_heat_curve(curve: Curve) -> Iterator[Note]:
    """Yield the notes on the conductance by parts along a curve; none if it was not measured."""
    columns = curve.measured
    if "conductance_interaction" not in columns:
        return
    interaction, residual = (columns[f"conductance_{name}"] for name in ("interaction", "residual"))
    if count := int(np.sum(interaction > ADDITIVE)):
        yield Note(
            Rank.USUAL,
            f"At {count} of {len(interaction)} loads the parts do not add up (h l/k_s up to "
            f"{interaction.max():.2g}): the conductance of the joint is solved as a whole there.",
        )
    if not (residual <= TOLERANCE).all():
        yield Note(
            Rank.WRONG, f"The drop across the joint is met to {residual.max():.0e}, not {TOLERANCE:.0e}."
        )
    if (columns["radiation_conductance_per_area"] > RADIATES * columns["joint_conductance_per_area"]).any():
        yield NEAR_FIELD
