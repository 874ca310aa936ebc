"""Answers as labelled data: an `xarray.Dataset` for files and notebooks, a plain record for scripts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import dataset_of, plain_values, sizes, units_of, variable, word, words

if TYPE_CHECKING:
    import xarray

    from roughcontact.contact.compare import Comparison
    from roughcontact.contact.conduction import Conductors
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution

__all__ = [
    "check_conducting",
    "curve_dataset",
    "curve_record",
    "plain_values",
    "solution_dataset",
    "solution_record",
    "stiffness_for",
    "with_conductance",
    "with_theories",
]

_CURVE_POINTS = (
    "force",
    "depth",
    "stiffness",
    "interfacial_stiffness",
    "contact_area",
    "mean_gap",
    "elastic_energy",
    "spots",
    "dimensionless_force",
    "dimensionless_stiffness",
    "residual",
    "stiffness_residual",
    "resolved",
)
_CURVE_SCALES = ("modulus", "rms", "full_contact_stiffness", "cell_stiffness", "nominal_area")
_SOLUTION_MAPS = ("pressure", "displacement", "gap", "contact")
_SOLUTION_SCALARS = (
    "force",
    "depth",
    "stiffness",
    "interfacial_stiffness",
    "contact_area",
    "contact_fraction",
    "mean_gap",
    "elastic_energy",
    "residual",
    "steps",
    "missing",
    "touches_edge",
)


def curve_dataset(curve: Curve) -> xarray.Dataset:
    """Return a loading curve as a dataset.

    Every array of the curve is a variable along ``load``; the secant stiffness, which belongs to
    pairs of neighbours, lies along ``interval``; the scales are variables without a dimension, or
    along ``axis`` (y, then x). Each carries ``units`` and ``long_name``. On a line the units are per length.
    """
    kind = curve.geometry
    data = {name: variable(name, ("load",), getattr(curve, name), kind) for name in _CURVE_POINTS}
    data["status"] = variable("status", ("load",), words(curve.status))
    data["secant_stiffness"] = variable("secant_stiffness", ("interval",), curve.secant_stiffness, kind)
    data |= {name: variable(name, (), getattr(curve, name), kind) for name in _CURVE_SCALES}
    if math.isfinite(curve.hardness):
        data["hardness"] = variable("hardness", (), curve.hardness, kind)
    data |= sizes(curve.lengths, curve.spacing, curve.periodic)
    return dataset_of(data, {}, "normal contact stiffness of a rough surface against load", kind)


def solution_dataset(solution: Solution) -> xarray.Dataset:
    """Return one loaded state as a dataset.

    Maps lie along ``y, x`` with the cell centres [m] as coordinates, profiles along ``x``, rings along ``r``. Row 0
    is the top of the picture, so y points down. Scalars are variables without a dimension, areas and loads of the
    spots lie along ``spot`` (1, 2, ... as in ``spot_label``). On a line the units are per length.
    """
    problem, spots = solution.problem, solution.spots
    grid, kind = problem.grid, problem.geometry
    axes = kind.axes
    data = {name: variable(name, axes, getattr(solution, name), kind) for name in _SOLUTION_MAPS}
    if problem.surface is not None:
        data["heights"] = variable("heights", axes, problem.surface.heights)
    data["spot_label"] = variable("spot_label", axes, spots.labels)
    data["spot_area"] = variable("spot_area", ("spot",), spots.areas, kind)
    data["spot_load"] = variable("spot_load", ("spot",), spots.loads, kind)
    data |= {name: variable(name, (), getattr(solution, name), kind) for name in _SOLUTION_SCALARS}
    data["spots"] = variable("spots", (), spots.count)
    data["status"] = variable("status", (), word(solution.status))
    data |= {name: variable(name, (), value, kind) for name, value in _scales(solution).items()}
    data |= sizes(grid.lengths, grid.spacing, grid.periodic)
    coordinates = {
        axis: variable(axis, (axis,), values) for axis, values in zip(axes, grid.coordinates, strict=True)
    }
    coordinates["spot"] = (("spot",), np.arange(1, spots.count + 1), {"long_name": "number of the spot"})
    dataset = dataset_of(data, coordinates, "contact of a rough surface under load", kind)
    if solution.notes:
        dataset.attrs["notes"] = "\n".join(solution.notes)
    return dataset


def curve_record(curve: Curve) -> dict[str, Any]:
    """Return a loading curve as plain numbers, words and lists that JSON can hold.

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.
    """
    names = (*_CURVE_POINTS, "secant_stiffness", *_CURVE_SCALES, "lengths", "spacing", "periodic")
    record = {name: plain_values(getattr(curve, name)) for name in names}
    record["status"] = words(curve.status)
    return record | {"geometry": curve.geometry.value, "units": units_of(record, curve.geometry)}


def solution_record(solution: Solution) -> dict[str, Any]:
    """Return the scalars of one loaded state as plain numbers and words that JSON can hold.

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.
    """
    grid, kind = solution.problem.grid, solution.problem.geometry
    record = {name: plain_values(getattr(solution, name)) for name in _SOLUTION_SCALARS}
    record["spots"] = int(solution.spots.count)
    record["status"] = word(solution.status)
    record["notes"] = list(solution.notes)
    record |= {name: plain_values(value) for name, value in _scales(solution).items()}
    record |= {
        name: plain_values(getattr(grid, name)) for name in ("shape", "lengths", "spacing", "periodic")
    }
    return record | {"geometry": kind.value, "units": units_of(record, kind)}


def with_conductance(dataset: xarray.Dataset, conductors: Conductors, of: str = "total") -> xarray.Dataset:
    """Return the dataset of a curve with what it conducts as further columns along ``load``.

    Parameters
    ----------
    dataset : xarray.Dataset
        As `curve_dataset` makes it, or as it was read from a file.
    conductors : Conductors
        The two bodies.
    of : {"total", "interface"}
        See `roughcontact.conductance`.

    Raises
    ------
    ValueError
        If the dataset is not that of a curve, or that of a line contact or of a body that gives way.
    """
    stiffness = stiffness_for(of)
    missing = [name for name in ("force", stiffness, "modulus") if name not in dataset]
    if missing or dataset[stiffness].dims != ("load",):
        raise ValueError(f"not a stiffness curve: {' and '.join(missing or ['load'])} is missing")
    check_conducting(Geometry(dataset.attrs.get("geometry", "surface")), "hardness" in dataset)
    found = conductors.of(dataset[stiffness].to_numpy(), float(dataset["modulus"]))
    return dataset.assign({name: variable(name, ("load",), values) for name, values in found.items()})


def stiffness_for(of: str) -> str:
    """Return the name of the stiffness that a conductance follows from.

    Raises
    ------
    ValueError
        If `of` is neither "total" nor "interface".
    """
    names = {"total": "stiffness", "interface": "interfacial_stiffness"}
    if of not in names:
        raise ValueError(f"of must be 'total' or 'interface', not {of!r}")
    return names[of]


def check_conducting(geometry: Geometry, yielding: bool) -> None:
    """Refuse a curve whose stiffness does not tell what its contact conducts.

    Raises
    ------
    ValueError
        If it is that of a line, or of a body that gives way.
    """
    if geometry is Geometry.LINE:
        raise ValueError(
            "a line contact has no conductance of its own: it hangs on how far away the bodies end"
        )
    if yielding:
        raise ValueError(
            "under a hardness the cells that give way conduct, but the stiffness of a curve leaves them out: take "
            "the conductance of each solution of loading_path"
        )


def with_theories(dataset: xarray.Dataset, comparisons: Mapping[str, Comparison]) -> xarray.Dataset:
    """Return the dataset of a curve with what theories say as further columns along ``load``.

    A column is named by the key of its comparison and the quantity: ``persson_contact_area``. Where a theory does not
    hold it is NaN.
    """
    columns = {}
    for key, comparison in comparisons.items():
        for quantity, values in comparison.predicted.items():
            attributes = dict(dataset[quantity].attrs)
            attributes["long_name"] = f"{attributes['long_name']}, by {comparison.name}"
            attributes["references"] = comparison.source
            columns[f"{key.replace('-', '_')}_{quantity}"] = (("load",), values, attributes)
    return dataset.assign(columns)


def _scales(solution: Solution) -> dict[str, float]:
    """Return the numbers by which one loaded state is judged and that it has no attribute for."""
    problem = solution.problem
    scales = {
        "largest_pressure": float(solution.pressure.max()),
        "nominal_pressure": solution.force / problem.grid.area,
        "stiffness_residual": solution.frozen.residual,
        "modulus": problem.modulus,
    }
    return scales if problem.surface is None else scales | {"rms": problem.surface.rms}
