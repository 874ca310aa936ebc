"""What a contact conducts: electricity and heat, from its stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from roughcontact.contact.curve import Curve
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import variable
from roughcontact.solver.control import Depth
from roughcontact.theory import conductance as theory
from roughcontact.validation import number

if TYPE_CHECKING:
    import xarray

__all__ = ["Conductors", "conductance", "with_conductance"]

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
        Of a surface, of rings, or of a Winkler foundation. Of a solution under a hardness the cells that give
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
        If the materials make no sense, if the contact is that of a line, whose conductance per length depends on the
        reference length, or if it is a curve under a hardness, whose stiffness leaves out cells that conduct.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3)
    >>> copper = rc.conductance(solution, resistivities=(1.7e-8, 1.7e-8))
    >>> f"{copper['electrical_resistance'] * 1e3:.1f} mOhm"
    '2.0 mOhm'
    """
    materials = Conductors(resistivities, conductivities)
    stiffness = _stiffness_for(of)
    if not isinstance(contact, Curve | Solution):
        raise ValueError(
            f"a Curve or a Solution conducts, not {type(contact).__name__}: press the surface first"
        )
    if isinstance(contact, Solution) and contact.problem.hardness < math.inf:
        # Plastic cells conduct as well: the stiffness of the whole region, as if it were elastic.
        elastic = replace(contact.problem, control=Depth(0.0), hardness=math.inf)
        contact = replace(contact, problem=elastic, _frozen=None)
    scales = contact.problem if isinstance(contact, Solution) else contact
    _require_conducting(scales.geometry, scales.hardness < math.inf)
    return materials.of(np.asarray(getattr(contact, stiffness), dtype=np.float64), scales.modulus)


def with_conductance(dataset: xarray.Dataset, conductors: Conductors, of: str = "total") -> xarray.Dataset:
    """Return the dataset of a curve with what it conducts as further columns along ``load``.

    Parameters
    ----------
    dataset : xarray.Dataset
        As `roughcontact.Curve.to_dataset` makes it, or as it was read from a file.
    conductors : Conductors
        The two bodies.
    of : {"total", "interface"}
        See `roughcontact.conductance`.

    Raises
    ------
    ValueError
        If the dataset is not that of a curve, or that of a line contact or of a plastic body.
    """
    stiffness = _stiffness_for(of)
    missing = [name for name in ("force", stiffness, "modulus") if name not in dataset]
    if missing or dataset[stiffness].dims != ("load",):
        raise ValueError(f"not a stiffness curve: {' and '.join(missing or ['load'])} is missing")
    _require_conducting(Geometry(dataset.attrs.get("geometry", "surface")), "hardness" in dataset)
    found = conductors.of(dataset[stiffness].to_numpy(), float(dataset["modulus"]))
    return dataset.assign({name: variable(name, ("load",), values) for name, values in found.items()})


def _stiffness_for(of: str) -> str:
    """Return the name of the stiffness that a conductance follows from."""
    names = {"total": "stiffness", "interface": "interfacial_stiffness"}
    if of not in names:
        raise ValueError(f"of must be 'total' or 'interface', not {of!r}")
    return names[of]


def _require_conducting(geometry: Geometry, yielding: bool) -> None:
    """Refuse a curve that does not say what its contact conducts: that of a line, or of a plastic body."""
    if geometry is Geometry.LINE:
        raise ValueError(
            "a line contact has no conductance of its own: it depends on how far away the bodies end"
        )
    if yielding:
        raise ValueError(
            "under a hardness the plastic cells conduct, but the stiffness of a curve leaves them out: take "
            "the conductance of each solution of loading_path"
        )
