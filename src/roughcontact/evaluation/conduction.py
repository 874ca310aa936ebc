"""Electrical and thermal conductance of a contact, from its stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, overload

import numpy as np

from roughcontact.contact.curve import Curve
from roughcontact.contact.flow_curve import FlowCurve
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.evaluation.below import is_half_space
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import CONDUCTION, CONDUCTION_PER_AREA
from roughcontact.labels.labelled import variable
from roughcontact.theory.joints import conductance as theory
from roughcontact.validation import Array, number, numeric

if TYPE_CHECKING:
    import xarray

__all__ = ["Conductors", "conductance", "part_words", "with_conductance"]


# The part that a conductance belongs to, and the stiffness that it follows from.
_PARTS = {"interface": "interfacial_stiffness", "total": "stiffness"}


@dataclass(frozen=True, slots=True)
class Conductors:
    """The resistivities or conductivities of the two bodies.

    Parameters
    ----------
    resistivities : tuple of float, optional
        Electrical resistivity of both bodies [ohm m]; 0 for a superconductor.
    conductivities : tuple of float, optional
        Thermal conductivity of both bodies [W/(m K)]; infinite for an isothermal body, 0 for an insulator.

    Raises
    ------
    ValueError
        If neither is given, or only for one body; if a number is negative, or nothing limits the conductance.
    """

    resistivities: tuple[float, float] | None = None
    conductivities: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if self.resistivities is None and self.conductivities is None:
            raise InputError(
                "neither resistivities nor conductivities are given",
                "give the resistivities [ohm m] or the conductivities [W/(m K)] of both bodies",
                "resistivities, conductivities",
            )
        for pair in (self.resistivities, self.conductivities):
            if pair is not None and np.shape(number(pair, "the numbers of both bodies")) != (2,):
                raise InputError(
                    f"{pair!r} is not a pair of numbers",
                    "give the numbers of both bodies, such as (1.7e-8, 1.7e-8)",
                )
        self.of(np.zeros(0), 1.0)  # raises an error if the values make no sense

    def given(self) -> dict[str, tuple[float, float]]:
        """Return the given values, by the names of the fields."""
        pairs = {"resistivities": self.resistivities, "conductivities": self.conductivities}
        return {name: pair for name, pair in pairs.items() if pair is not None}

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


@overload
def conductance(
    contact: Curve | Solution,
    *,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
    of: Literal["interface", "total"] = "interface",
) -> dict[str, Array]: ...
@overload
def conductance(
    contact: xarray.Dataset,
    *,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
    of: Literal["interface", "total"] = "interface",
) -> xarray.Dataset: ...
@numeric(resistivities="ohm*m", conductivities="W/m/K")
def conductance(
    contact: Curve | Solution | xarray.Dataset,
    *,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
    of: Literal["interface", "total"] = "interface",
) -> dict[str, Array] | xarray.Dataset:
    """Return conductances and resistances by the exact analogy with the stiffness (thesis, eqs 4.2, 4.4 as corrected).

    Parameters
    ----------
    contact : Curve, Solution or Dataset
        A contact of a surface, of rings, or of a Winkler foundation. Under a hardness, plastic cells conduct like the
        others, so the stiffness of unloading is used. A dataset is that of a curve, from ``curve.to_dataset()`` or from
        a file.
    resistivities, conductivities : tuple of float
        At least one of the two, see ``Conductors``.
    of : {"interface", "total"}
        The conductance of the interface, from the interfacial stiffness; or the total conductance of two half-spaces
        that touch only on this patch, from the stiffness. The total includes the spreading resistance of the patch (its
        macro-constriction).

    Returns
    -------
    dict of str to array, or Dataset
        ``electrical_conductance`` [S] and ``electrical_resistance`` [ohm] for resistivities, ``thermal_conductance``
        [W/K] and ``thermal_resistance`` [K/W] for conductivities: along the curve, or one number. For the interface
        also over the nominal area: ``electrical_conductance_per_area`` [S/m^2], ``electrical_resistance_per_area`` [ohm
        m^2], ``thermal_conductance_per_area`` (h_c) [W/(m^2 K)] and ``thermal_resistance_per_area`` [m^2 K/W]. Films,
        gas and radiation are not included, see `roughcontact.joint_conductance`. For a dataset, the same dataset with
        these values as further columns, which `roughcontact.plot.resistance_curve` draws.

    Raises
    ------
    ValueError
        If the materials make no sense; if the solution is that of a layer, or, for the total, that of a map that is
        periodic along one axis; if the contact is that of a line, whose conductance per length depends on the
        reference length; if it is a curve under a hardness without the stiffness of unloading; or if `of` is
        ``"interface"`` for a Winkler foundation, which has no interfacial stiffness.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3)
    >>> copper = rc.conductance(solution, resistivities=(1.7e-8, 1.7e-8), of="total")
    >>> f"{copper['electrical_resistance'] * 1e3:.1f} mOhm"
    '2.0 mOhm'
    """
    materials = Conductors(resistivities, conductivities)
    _require_part(of)
    if not isinstance(contact, Curve | Solution):
        if not hasattr(contact, "data_vars"):
            raise InputError(
                f"conductance takes a Curve, a Solution or a Dataset, not {type(contact).__name__}",
                "press the surface first",
                place="contact",
            )
        return with_conductance(contact, materials, of)
    if isinstance(contact, Solution):
        contact = contact.flattened  # plastic cells conduct as well
        _require_half_spaces(contact, of)
    scales = contact.problem if isinstance(contact, Solution) else contact
    name = _PARTS[of]
    known: Curve | Solution | FlowCurve | None = contact
    if isinstance(contact, Curve) and contact.hardness < math.inf:
        name, known = f"unloading_{name}", contact.flow
    _require_conducting(scales.geometry, known is None, of)
    stiffness = np.asarray(getattr(known, name), dtype=np.float64)
    return _of_part(materials.of(stiffness, scales.modulus), contact.nominal_area, of)


def with_conductance(
    dataset: xarray.Dataset, conductors: Conductors, of: str = "interface"
) -> xarray.Dataset:
    """Return the dataset of a curve with conductances and resistances as columns along ``load``, replacing old ones.

    Parameters
    ----------
    dataset : xarray.Dataset
        The result of `roughcontact.Curve.to_dataset`, or a dataset read from a file.
    conductors : Conductors
        The two bodies.
    of : {"interface", "total"}
        See `roughcontact.conductance`; the long name of each column contains it.

    Raises
    ------
    ValueError
        If the dataset is not that of a curve; if it is that of a line contact, or of a plastic body without its
        stiffness of unloading; or if `of` is ``"interface"`` for a Winkler foundation.
    """
    _require_part(of)
    plastic, stiffness = "hardness" in dataset, _PARTS[of]
    missing = [name for name in ("force", stiffness, "modulus", "nominal_area") if name not in dataset]
    if missing or dataset[stiffness].dims != ("load",):
        raise InputError(f"not a stiffness curve: {' and '.join(missing or ['load'])} is missing")
    stiffness = f"unloading_{stiffness}" if plastic else stiffness
    _require_conducting(Geometry(dataset.attrs.get("geometry", "surface")), stiffness not in dataset, of)
    found = conductors.of(dataset[stiffness].to_numpy(), float(dataset["modulus"]))
    columns, words = {}, part_words(dataset, of)
    for name, values in _of_part(found, float(dataset["nominal_area"]), of).items():
        columns[name] = variable(name, ("load",), values)
        columns[name][2]["long_name"] += f", of {words}"
    return dataset.drop_vars(names_of(CONDUCTION + CONDUCTION_PER_AREA), errors="ignore").assign(columns)


def part_words(dataset: xarray.Dataset, of: str) -> str:
    """Return in words the part that a conductance of a curve's dataset belongs to."""
    if of == "interface":
        return "the interface only"
    if dataset["periodic"].to_numpy().all():
        return "the interface: a periodic map has no spreading resistance"
    return "the whole patch between two half-spaces, its spreading resistance included"


def _of_part(found: dict[str, Array], area: float, of: str) -> dict[str, Array]:
    """Return conductances and resistances, for the interface also over the nominal area.

    The spreading resistance of a patch falls with its side, not with its area, so the total has no value per area.
    """
    if of != "interface":
        return found
    areal = {
        f"{name}_per_area": values * area if name.endswith("resistance") else values / area
        for name, values in found.items()
    }
    return found | areal


def _require_part(of: str) -> None:
    """Raise an error if `of` is neither the interface nor the total."""
    if of not in _PARTS:
        raise about(
            "of", f"must be 'interface' or 'total' (the spreading resistance of the patch in it), not {of!r}"
        )


def _require_half_spaces(solution: Solution, of: str) -> None:
    """Raise an error for a body to which the analogy does not apply; a curve does not hold its body."""
    if sum(solution.problem.grid.periodic) == 1 and of == "total":
        raise InputError(
            "the total conductance of a map that is periodic along one axis depends on the size of the bodies",
            "use of='interface'",
            "of",
        )
    if solution.problem.geometry is Geometry.SURFACE and not is_half_space(solution.on_host()):
        raise InputError(
            "stiffness and conductance are proportional only for half-spaces",
            "press a map of heights without operator=",
            "contact",
        )


def _require_conducting(geometry: Geometry, hidden: bool, of: str) -> None:
    """Raise an error for a line, and for a curve without the stiffness of all cells in contact."""
    if geometry is Geometry.LINE:
        raise InputError(
            "the conductance of a line contact depends on the size of the bodies",
            "press a map of heights",
        )
    if geometry is Geometry.FOUNDATION and of == "interface":
        raise InputError("a Winkler foundation has only a total conductance", "use of='total'")
    if hidden:
        raise InputError(
            "under a hardness the plastic cells conduct, but the stiffness of this curve leaves them out",
            "compute the curve again, with the stiffness of unloading",
        )
