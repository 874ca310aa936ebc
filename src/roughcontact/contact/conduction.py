"""What a contact conducts: electricity and heat, from its stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact.contact.curve import Curve
from roughcontact.contact.dataset import check_conducting, stiffness_for
from roughcontact.contact.solution import Solution
from roughcontact.solver.control import Depth
from roughcontact.theory import conductance as theory
from roughcontact.validation import number

__all__ = ["Conductors", "conductance"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Conductors:
    """How well the two bodies conduct.

    Parameters
    ----------
    resistivities : tuple of float, optional
        Electrical resistivity of both bodies [ohm m]; 0 for a superconductor.
    conductivities : tuple of float, optional
        Thermal conductivity of both bodies [W/(m K)]; infinite for an isothermal body, 0 for an insulator.

    Raises
    ------
    ValueError
        If neither is given, or not for both bodies, a number is negative, or nothing limits the conductance.
    """

    resistivities: tuple[float, float] | None = None
    conductivities: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if self.resistivities is None and self.conductivities is None:
            raise ValueError("give the resistivities [ohm m] or the conductivities [W/(m K)] of both bodies")
        for pair in (self.resistivities, self.conductivities):
            if pair is not None and np.shape(number(pair, "the numbers of both bodies")) != (2,):
                raise ValueError(f"give the numbers of both bodies, such as (1.7e-8, 1.7e-8), not {pair!r}")
        self.of(np.zeros(0), 1.0)  # what makes no sense is refused here

    def of(self, stiffness: Array, modulus: float) -> dict[str, Array]:
        """Return the conductances and resistances of contacts by `stiffness` [N/m] at reduced `modulus` [Pa]."""
        found: dict[str, Array] = {}
        if self.resistivities is not None:
            electrical = theory.electrical(stiffness, modulus, self.resistivities)
            found |= {
                "electrical_conductance": electrical,
                "electrical_resistance": theory.resistance(electrical),
            }
        if self.conductivities is not None:
            thermal = theory.thermal(stiffness, modulus, self.conductivities)
            found |= {"thermal_conductance": thermal, "thermal_resistance": theory.resistance(thermal)}
        return found


def conductance(
    contact: Curve | Solution,
    *,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
    of: Literal["total", "interface"] = "total",
) -> dict[str, Array]:
    """Return what a contact conducts: an exact analogy with its stiffness (thesis, eqs 4.2, 4.4 as corrected).

    Parameters
    ----------
    contact : Curve or Solution
        Of a surface, of rings, or of a foundation of springs. Of a solution under a hardness the cells that give
        way conduct like the others.
    resistivities, conductivities : tuple of float
        At least one of the two, see `Conductors`.
    of : {"total", "interface"}
        The total conductance of two half-spaces, the macro-constriction towards the contact included, from the
        stiffness; or that of the interface alone, from the interfacial stiffness.

    Returns
    -------
    dict of str to array
        ``electrical_conductance`` [S] and ``electrical_resistance`` [ohm], ``thermal_conductance`` [W/K] and
        ``thermal_resistance`` [K/W], what was asked for: along the curve, or one number. Films, gas and
        radiation carry nothing here.

    Raises
    ------
    ValueError
        If the materials make no sense, the contact is that of a line, whose conductance per length hangs on the
        reference length, or of a curve under a hardness, whose stiffness leaves out cells that conduct.
    """
    materials = Conductors(resistivities, conductivities)
    stiffness = stiffness_for(of)
    if not isinstance(contact, Curve | Solution):
        raise ValueError(
            f"a Curve or a Solution conducts, not {type(contact).__name__}: press the surface first"
        )
    if isinstance(contact, Solution) and contact.problem.hardness < math.inf:
        # What gives way conducts as well: the stiffness of the whole region, as if it were elastic.
        elastic = replace(contact.problem, control=Depth(0.0), hardness=math.inf)
        contact = replace(contact, problem=elastic, _frozen=None)
    scales = contact.problem if isinstance(contact, Solution) else contact
    check_conducting(scales.geometry, scales.hardness < math.inf)
    return materials.of(np.asarray(getattr(contact, stiffness), dtype=np.float64), scales.modulus)
