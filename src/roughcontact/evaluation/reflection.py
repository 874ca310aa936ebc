"""What ultrasound sees of a joint: the reflection along a curve, and where the stiffness can be inferred from it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from roughcontact.contact.curve import Curve
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, placed
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import REFLECTION
from roughcontact.labels.engineering_units import written
from roughcontact.labels.labelled import variable
from roughcontact.labels.note import Note, Rank
from roughcontact.materials import Elastic, Material, handbook, solids_of
from roughcontact.theory.joints import ultrasound
from roughcontact.validation import Array, numeric, pair

if TYPE_CHECKING:
    import xarray

__all__ = ["reflection", "reflection_notes", "waves_of"]

_LONG = 10.0  # wavelength over the distance of the spots, below which they scatter


@overload
def reflection(
    contact: Curve | Solution,
    bodies: tuple[Elastic, Elastic],
    frequency: float,
    *,
    densities: tuple[float, float] | None = None,
) -> dict[str, Array]: ...
@overload
def reflection(
    contact: xarray.Dataset,
    bodies: tuple[Elastic, Elastic],
    frequency: float,
    *,
    densities: tuple[float, float] | None = None,
) -> xarray.Dataset: ...
@numeric(frequency="Hz", densities="kg/m^3")
def reflection(
    contact: Curve | Solution | xarray.Dataset,
    bodies: tuple[Elastic, Elastic],
    frequency: float,
    *,
    densities: tuple[float, float] | None = None,
) -> dict[str, Array] | xarray.Dataset:
    """Return the reflection of a normal, longitudinal wave at a joint, by the interfacial stiffness per area K/A0.

    Parameters
    ----------
    contact : Curve, Solution or Dataset
        A contact of a map of heights. Under a hardness the stiffness of unloading is used, because a small oscillation
        is elastic. A dataset is that of a curve, from ``curve.to_dataset()`` or from a file.
    bodies : tuple of Solid, Material or str
        The body of the incident wave and the other body: solids, or materials of the `handbook` or their names.
    frequency : float
        Frequency of the wave [Hz].
    densities : tuple of float, optional
        Densities of both bodies [kg/m^3]; by default those of the materials.

    Returns
    -------
    dict of str to array, or Dataset
        Along the curve, or one value:

        * ``reflecting_stiffness_per_area`` [Pa/m], the K/A0 that the reflection follows from;
        * ``reflection`` and ``transmission`` [-], the sizes of the amplitudes of displacement;
        * ``error_amplification`` [-], the relative error of a K/A0 that is inferred from a measured reflection, over
          that of this reflection;
        * ``best_frequency`` [Hz], at which an error of the reflection changes K/A0 least;
        * ``wavelength_over_spot_distance`` [-]: below ten the spots scatter the wave;
        * ``measurable``, whether the amplification is at most 20; `roughcontact.theory.ultrasound` refuses to infer
          K/A0 from other reflections.

        For a dataset, the same dataset with these values as further columns.

    Raises
    ------
    ValueError
        If the contact is that of a profile, or is no contact; if there are not two elastic bodies, or a density is
        missing; or if a curve under a hardness lacks the stiffness of unloading.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 4e-6, periodic=True)
    >>> rng = np.random.default_rng(1)
    >>> rough = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=64e-6, short_cutoff=32e-6, rng=rng)
    >>> curve = rc.loading_curve(rough, ("steel", "steel"), pressures=[1e7, 1e8])
    >>> seen = rc.reflection(curve, ("steel", "steel"), 5e6)
    >>> seen["reflection"].round(3).tolist(), seen["measurable"].tolist()
    ([0.999, 0.973], [False, True])
    """
    impedances, speeds = waves_of(bodies, densities)
    stiffness, spots, area = _of_contact(contact)
    # An infinite stiffness, in full contact, has the reflection of a very large one.
    held, joint = np.minimum(stiffness / area, 1e100), np.isfinite(stiffness)
    factor = np.where(joint, ultrasound.expected_amplification(held, frequency, impedances), math.inf)
    ratio = np.where(joint, min(speeds) / frequency / np.sqrt(area / spots), math.inf)
    values = {
        "reflecting_stiffness_per_area": stiffness / area,
        "reflection": np.abs(ultrasound.reflection(held, frequency, impedances)),
        "transmission": np.abs(ultrasound.transmission(held, frequency, impedances)),
        "error_amplification": factor,
        "best_frequency": ultrasound.best_frequency(1.0, impedances) * stiffness / area,
        "wavelength_over_spot_distance": ratio,
        "measurable": factor <= ultrasound.LARGEST_AMPLIFICATION,
    }
    found = {name: np.asarray(value) for name, value in values.items()}
    if isinstance(contact, Curve | Solution):
        return found
    columns = {name: variable(name, ("load",), values) for name, values in found.items()}
    for _, _, attributes in columns.values():
        attributes["long_name"] += f", at {written(frequency, 'Hz')}"
    return contact.drop_vars(names_of(REFLECTION), errors="ignore").assign(columns)


def waves_of(
    bodies: tuple[Elastic, Elastic], densities: tuple[float, float] | None = None
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the acoustic impedances [Pa s/m] of two bodies, and their speeds of longitudinal waves [m/s].

    Raises
    ------
    ValueError
        If there are not two elastic bodies, or a density is missing.
    """
    if not isinstance(bodies, tuple | list) or len(bodies) != 2:
        raise InputError(
            "a reflection needs two elastic bodies", "give a pair, such as ('steel', 'aluminium')", "bodies"
        )
    with placed("bodies"):
        solids = solids_of(*bodies)
    named = [handbook(body) if isinstance(body, str) else body for body in bodies]
    own = [body.density for body in named if isinstance(body, Material)]
    if densities is None and len(own) < 2:
        raise InputError(
            "the density of a Solid is not known",
            "give the densities of both bodies, such as (7850.0, 2700.0)",
            "densities",
        )
    given = pair((own[0], own[1]) if densities is None else densities, "densities")
    with placed("bodies"):
        first, second = (
            ultrasound.speed(each.young_modulus, each.poisson_ratio, float(density))
            for each, density in zip(solids, given, strict=True)
        )
    return (first * float(given[0]), second * float(given[1])), (first, second)


def reflection_notes(found: Any, frequency: float) -> Iterator[Note]:
    """Yield the limits of a reflection at a frequency [Hz], from a dictionary or dataset of `reflection`."""
    lost, best, ratio = (
        np.atleast_1d(found[name])
        for name in ("error_amplification", "best_frequency", "wavelength_over_spot_distance")
    )
    lost = lost > ultrasound.LARGEST_AMPLIFICATION
    count, at = len(lost), written(frequency, "Hz")
    if lost.any():
        ends = best[lost & np.isfinite(best)]
        text = (
            f"At {np.sum(lost)} of {count} loads K/A0 cannot be inferred from the reflection at {at}: its relative "
            f"error is more than {ultrasound.LARGEST_AMPLIFICATION:g} times that of the reflection."
        )
        if ends.size:
            low, high = (written(float(end), "Hz", 2) for end in (ends.min(), ends.max()))
            text += f" The best frequency is {low if low == high else f'{low} to {high}'} at these loads."
        yield Note(Rank.LIMITED, text)
    if short := int(np.sum(ratio < _LONG)):
        highest = written(frequency * float(ratio.min()) / _LONG, "Hz", 2)
        yield Note(
            Rank.DOUBTFUL,
            f"At {short} of {count} loads the wavelength at {at} is less than {_LONG:g} times the distance of the "
            f"spots, which scatter the wave. K/A0 gives its reflection at all loads up to {highest}.",
        )


def _of_contact(contact: Curve | Solution | xarray.Dataset) -> tuple[Array, Array, float]:
    """Return the interfacial stiffness [N/m] of all cells in contact, the number of spots, and the nominal area."""
    if isinstance(contact, Solution):
        _require_map(contact.problem.geometry)
        stiffness = contact.flattened.interfacial_stiffness  # of plastic cells as well
        return np.asarray(stiffness), np.asarray(contact.spot_count), contact.nominal_area
    dataset: Any = contact.to_dataset() if isinstance(contact, Curve) else contact
    if not {"interfacial_stiffness", "spots", "nominal_area"} <= set(getattr(dataset, "data_vars", ())):
        raise InputError(
            f"reflection takes a Curve, a Solution or the dataset of a curve, not {type(contact).__name__}",
            "press the surface first",
            "contact",
        )
    _require_map(Geometry(dataset.attrs.get("geometry", "surface")))
    name = "unloading_interfacial_stiffness" if "hardness" in dataset else "interfacial_stiffness"
    if name not in dataset:
        raise InputError(
            "under a hardness a wave sees the stiffness of unloading, which this curve lacks",
            "compute the curve again, with the stiffness of unloading",
            "contact",
        )
    return dataset[name].to_numpy(), dataset["spots"].to_numpy(), float(dataset["nominal_area"])


def _require_map(geometry: Geometry) -> None:
    """Raise an error for a profile."""
    if geometry in (Geometry.LINE, Geometry.FOUNDATION):
        raise InputError("a profile has no reflection of ultrasound", "press a map of heights", "contact")
