"""The answer of an inference as labelled data and as plain values."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from roughcontact.labels.labelled import described, plain_values, variable
from roughcontact.measurement.joint_data import JointClosures
from roughcontact.measurement.joint_inference import (
    SHARES,
    JointInference,
    closure_quantiles,
    ends,
    stiffness_quantiles,
)
from roughcontact.measurement.joint_plan import JointPlan
from roughcontact.validation import Array

if TYPE_CHECKING:
    import xarray

__all__ = [
    *("LEVELS", "MeasuredPoints"),
    *("inference_dataset", "inference_record", "measured_points", "plan_dataset"),
]

LEVELS = (0.5, 0.9)  # of intervals and bands


class MeasuredPoints(NamedTuple):
    """What was measured, in words and in numbers, and what other joints of the posterior would show."""

    name: str
    words: str
    unit: str
    pressures: Array
    values: Array
    errors: Array

    def bands(self, inference: JointInference, pressures: Array) -> Array:
        """Return the predicted values, low, median and high, for each of the `LEVELS`, shape (levels, 3, pressures)."""
        quantiles = closure_quantiles if self.name == "closure" else stiffness_quantiles
        shares = [share for level in LEVELS for share in ends(level)]
        return quantiles(inference, pressures, shares).reshape(len(LEVELS), 3, -1)


def measured_points(inference: JointInference) -> MeasuredPoints:
    """Return the stiffnesses with their errors, or the closures since the first load."""
    data = inference.data
    errors = np.sqrt(np.diagonal(data.noise))
    if isinstance(data, JointClosures):
        words = "closure since the first load"
        since = (np.pad(each, (1, 0)) for each in (data.measured, errors))
        return MeasuredPoints("closure", words, "m", data.pressures, *since)
    words = "interfacial stiffness per area K/A0"
    stiffness = np.exp(data.measured)
    name = "interfacial_stiffness_per_area"
    return MeasuredPoints(name, words, "Pa m-1", data.pressures, stiffness, stiffness * errors)


def inference_dataset(inference: JointInference) -> xarray.Dataset:
    """Return the measurement with its predictive bands along ``load``, the effective height, and the parameters.

    Prior and posterior of the parameters lie along ``parameter`` and ``share``, which holds 5, 50 and 95 %.

    Parameters
    ----------
    inference : JointInference

    Returns
    -------
    xarray.Dataset
        Variables with units and long names; attributes with the notes and the verdict on the model.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
    >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
    >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
    >>> found.to_dataset()["effective_height"].attrs["units"]
    'm'
    """
    import xarray

    points = measured_points(inference)
    columns: dict[str, Any] = {
        points.name: described("load", points.values, points.words, points.unit),
        f"{points.name}_error": described("load", points.errors, f"error of the {points.words}", points.unit),
        "effective_height": described((), inference.effective_height, "rms^a rolloff^(1 - a), median", "m"),
    }
    for level, (low, median, high) in zip(LEVELS, points.bands(inference, points.pressures), strict=True):
        ends = zip(("low", "high"), (low, high), inference.interval(level), strict=True)
        for end, predicted, height in ends:
            name, words = f"{end}_{100 * level:.0f}", f"{end} end of {level:.0%}"
            columns[f"predicted_{name}"] = described("load", predicted, f"predicted, {words}", points.unit)
            columns[f"effective_height_{name}"] = described((), height, f"effective height, {words}", "m")
        columns["predicted"] = described("load", median, f"predicted {points.words}, median", points.unit)
    rows = inference.parameters
    quantiles = {name: [getattr(each, name) for each in rows] for name in ("prior", "posterior")}
    along = ("parameter", "share")
    columns |= {
        "exponent": described((), inference.exponent, "exponent a of the stiffness"),
        "p_value": described((), inference.p_value, "probability that a joint of the model departs as far"),
        **{
            name: (along, np.reshape(values, (len(rows), len(SHARES))), {"long_name": f"{name} quantiles"})
            for name, values in quantiles.items()
        },
        "nats": described("parameter", [each.nats for each in rows], "information gained"),
        "unit": ("parameter", [each.unit for each in rows], {"long_name": "unit of the parameter"}),
    }
    coordinates = {
        "nominal_pressure": variable("nominal_pressure", ("load",), points.pressures),
        "parameter": ("parameter", [each.name for each in rows], {"long_name": "parameter of the model"}),
        "share": described("share", list(SHARES), "probability below the quantile"),
    }
    attributes = {
        "Conventions": "CF-1.11",
        "title": "inference from the stiffness of a joint",
        "fits": str(inference.fits).lower(),
        "departs": inference.departs,
        "notes": "\n".join(inference.notes),
    }
    return xarray.Dataset(columns, coordinates, attributes).reset_coords("nominal_pressure")


def inference_record(inference: JointInference) -> dict[str, Any]:
    """Return an inference as plain values, for JSON; units stand once, under ``"units"``.

    Parameters
    ----------
    inference : JointInference

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
    >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
    >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
    >>> found.to_record()["fits"]
    True
    """
    dataset = inference.to_dataset()
    parts = {str(name): each for name, each in dataset.items() if each.dims in (("load",), ())}
    parameters = [
        {
            "name": each.name,
            "unit": each.unit,
            "prior": plain_values(each.prior),
            "posterior": plain_values(each.posterior),
            "nats": each.nats,
            "informed": each.informed,
        }
        for each in inference.parameters
    ]
    return {
        **{name: plain_values(each.to_numpy()) for name, each in parts.items()},
        "fits": inference.fits,
        "departs": inference.departs,
        "parameters": parameters,
        "explanations": [dataclasses.asdict(each) for each in inference.explanations],
        "notes": list(inference.notes),
        "units": {name: unit for name, each in parts.items() if (unit := each.attrs["units"]) != "1"},
    }


def plan_dataset(plan: JointPlan) -> xarray.Dataset:
    """Return the widths of a plan along ``area`` and ``number``, and those without one load along ``load``.

    Parameters
    ----------
    plan : JointPlan

    Returns
    -------
    xarray.Dataset

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> topography = rc.JointTopography(rms=1.2e-6, rms_error=0.5, rolloff=1e-4, rolloff_error=0.3)
    >>> plan = rc.plan_joint(
    ...     np.geomspace(7e6, 140e6, 5), errors=0.05, gain=0.03, modulus=115e9, modulus_error=0.02,
    ...     areas=np.array([1e-6, 2e-6]), profile=topography,
    ... )
    >>> dict(plan.to_dataset().sizes)
    {'area': 2, 'number': 5, 'load': 5}
    """
    import xarray

    words = "standard deviation of ln h_eff"
    columns = {"width": described(("area", "number"), plan.width, words)}
    if plan.without.size:
        columns["width_without"] = described("load", plan.without, f"{words} without this load")
        columns["nominal_pressure"] = variable("nominal_pressure", ("load",), plan.pressures)
    coordinates = {
        "area": described("area", plan.areas, "nominal area of a joint", "m2"),
        "number": described("number", plan.specimens, "number of joints"),
    }
    return xarray.Dataset(
        columns, coordinates, {"Conventions": "CF-1.11", "title": "plan of a measurement of joints"}
    )
