"""Theories of a joint from its specification, without heights: per nominal area, against pressure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.evaluation.conduction import Conductors
from roughcontact.labels.labelled import variable
from roughcontact.materials import Modulus, as_modulus
from roughcontact.surface.generation.specification import SurfaceSpecification
from roughcontact.theory import laws
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.random_surfaces.waves import Waves
from roughcontact.validation import Array, number, numeric, positive

if TYPE_CHECKING:
    import xarray

__all__ = ["WITHOUT_SIZE", "theory_table"]

LONGEST = (
    1e3  # roll-off wavelengths in the longest wave: longer waves have a millionth of the mean square height
)
_OF_A_JOINT = {"moments", "spectrum", "hardness", "modulus", "area"}
WITHOUT_SIZE = tuple(
    name for name, law in laws.LAWS.items() if _OF_A_JOINT.issuperset(law.needs) and name != "cgp"
)
"""The theories for joints of any size. The body of ``"cgp"`` ends at the edge of the contact."""
_PER_AREA = {
    "contact_area": "contact_fraction",
    "interfacial_stiffness": "interfacial_stiffness_per_area",
    "mean_gap": "mean_gap",
}


@numeric(modulus="Pa", pressures="Pa", hardness="Pa", resistivities="ohm*m", conductivities="W/m/K")
def theory_table(
    joint: SurfaceSpecification,
    modulus: Modulus,
    names: str | Sequence[str],
    pressures: npt.ArrayLike,
    *,
    hardness: float | None = None,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
) -> xarray.Dataset:
    """Return the predictions of theories for a joint of two nominally flat faces, per nominal area.

    Parameters
    ----------
    joint : SurfaceSpecification
        As `roughcontact.specified` returns it.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    names : str or sequence of str
        Laws of ``roughcontact.theory.laws.LAWS`` that need no size of the joint: ``"cmy"``, ``"mikic"``, ``"gw"``,
        ``"persson"`` and others. ``"cmy"`` and ``"mikic"`` take rms height and slope only.
    pressures : array_like, shape (n,)
        Nominal pressures [Pa].
    hardness : float, optional
        Hardness of the softer body [Pa], for theories of bodies that yield.
    resistivities, conductivities : tuple of float, optional
        Electrical resistivities [ohm m] and thermal conductivities [W/(m K)] of both bodies.

    Returns
    -------
    Dataset
        Along ``theory`` and ``load``: ``contact_fraction``, ``interfacial_stiffness_per_area`` [Pa/m], ``mean_gap``
        [m], and conductances and resistances per area, such as ``thermal_conductance_per_area`` (h_c) [W/(m^2 K)].
        Conductances are those of the spots in vacuum: gas in the gap, films and radiation are not included. Values are
        NaN if a theory does not give them, and beyond the pressure up to which it holds. ``"ceb"`` and
        ``"kogut-etsion"`` give no conductance: their stiffness is that of first loading, while the conductance follows
        from that of unloading.

    Raises
    ------
    ValueError
        If a theory is unknown, needs the size of the joint, or needs a number that the specification does not contain.

    Examples
    --------
    >>> import roughcontact as rc
    >>> joint = rc.specified(sigma=(1.2e-6, 1.2e-6), slope=(0.12, 0.12))
    >>> found = rc.theory_table(joint, 50e9, "cmy", [1e6, 1e7], hardness=1e9, conductivities=(167.0, 16.2))
    >>> found["thermal_conductance_per_area"].values.round(-1).tolist()
    [[5210.0, 46480.0]]
    """
    if not isinstance(joint, SurfaceSpecification):
        raise InputError(
            "theory_table takes the specification of a joint",
            "give rc.specified(sigma=..., slope=...), or take rc.loading_laws for a surface",
            "joint",
        )
    wanted = [names] if isinstance(names, str) else list(names)
    value, loads = (
        as_modulus(modulus),
        np.atleast_1d(positive(number(pressures, "pressures [Pa]"), "pressures [Pa]")),
    )
    conducts = resistivities is not None or conductivities is not None
    conductors = Conductors(resistivities, conductivities) if conducts else None
    rows = []
    for name in wanted:
        law = _law(name, joint, value, hardness)
        yields_first = "hardness" in laws.LAWS[name].needs and not law.plastic
        rows.append(_columns(law, loads, value, None if yields_first else conductors))
    missing = np.full(loads.shape, np.nan)
    import xarray

    along = ("theory", "load")
    columns = {
        name: variable(name, along, [row.get(name, missing) for row in rows])
        for name in dict.fromkeys(name for row in rows for name in row)
    }
    scales = {"modulus": variable("modulus", (), value)}
    if hardness is not None:
        scales["hardness"] = variable("hardness", (), hardness)
    coordinates = {
        "theory": ("theory", wanted, {"long_name": "theory of the joint"}),
        "nominal_pressure": variable("nominal_pressure", ("load",), loads),
    }
    return xarray.Dataset(
        columns | scales, coordinates, {"Conventions": "CF-1.11", "title": "theories of a joint"}
    )


def _law(name: str, joint: SurfaceSpecification, modulus: float, hardness: float | None) -> LoadingLaw:
    """Return a law of one square metre of a joint, whose forces are therefore its pressures."""
    if name not in WITHOUT_SIZE:
        why = "needs the size of the joint" if name in laws.LAWS else "is unknown"
        raise InputError(f"the theory {name!r} {why}", f"choose from {', '.join(WITHOUT_SIZE)}", "names")
    given: dict[str, Any] = {"area": 1.0, "moments": joint}
    if "spectrum" in laws.LAWS[name].needs:
        spectrum = joint.spectrum
        given["spectrum"] = Waves.of_spectrum(spectrum, q_min=spectrum.q_rolloff / LONGEST)
    if "hardness" in laws.LAWS[name].needs:
        if hardness is None:
            raise InputError(
                f"the theory {name!r} needs a hardness, which does not follow from the roughness",
                "give the `hardness` of the softer body, such as 1e9 (Pa)",
                "hardness",
            )
        given["hardness"] = hardness
    return laws.named(name, modulus=modulus, **given)


def _columns(
    law: LoadingLaw, loads: Array, modulus: float, conductors: Conductors | None
) -> dict[str, Array]:
    """Return the columns of a law per nominal area."""
    found = {name: law.predict(own, loads) for own, name in _PER_AREA.items() if own in law.quantities}
    stiffness = found.get("interfacial_stiffness_per_area")
    if conductors is None or stiffness is None:
        return found
    known = np.isfinite(stiffness)
    for name, values in conductors.of(stiffness[known], modulus).items():
        found[f"{name}_per_area"] = column = np.full(loads.shape, np.nan)
        column[known] = values
    return found
