"""Averages of a study: means and errors of all its numbers, and the power laws of its loading curves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.errors import InputError
from roughcontact.solver.control import Status
from roughcontact.statistics.common_forces import on_common
from roughcontact.statistics.fit import fit_power_laws
from roughcontact.statistics.fit_window import Window
from roughcontact.statistics.power_law import ROUNDING
from roughcontact.statistics.samples import dimensions, summary
from roughcontact.validation import RngLike, as_generator

if TYPE_CHECKING:
    import xarray

__all__ = ["averages", "combinations", "sample_dimensions"]

_CONVERGED = [status.value for status in Status if status.converged]
# Dimensions of independent samples: those of a study, and those of a case that draws many lines at once.
_SAMPLES = ("sample", "line")


def sample_dimensions(dataset: xarray.Dataset) -> tuple[str, ...]:
    """Return the dimensions along which the independent samples of a study lie.

    Parameters
    ----------
    dataset : Dataset
        As `roughcontact.study.export` makes it.

    Returns
    -------
    tuple of str
        ``sample``, and ``line`` if each sample consists of many lines.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> rc.statistics.sample_dimensions(xarray.Dataset({"stiffness": (("hurst", "sample"), [[1.0, 2.0, 3.0]])}))
    ('sample',)
    """
    return tuple(name for name in _SAMPLES if name in dataset.sizes)


def averages(
    dataset: xarray.Dataset,
    window: Window | None = None,
    *,
    rng: RngLike,
    samples: str | Sequence[str] | None = None,
) -> xarray.Dataset:
    """Return means, scatter and errors of all numbers of a study, and the power laws of its loading curves.

    Points that missed their tolerance are ignored.

    Parameters
    ----------
    dataset : Dataset
        As `roughcontact.study.export` makes it.
    window : Window, optional
        Window in which power laws are fitted, see `fit_power_laws`.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        For the intervals of the laws.
    samples : str or sequence of str, optional
        Dimensions of the samples; by default those of `sample_dimensions`.

    Returns
    -------
    Dataset
        ``NAME_mean``, ``NAME_standard_error`` and the other statistics of `summary`, for every number that varies
        between samples; constants are kept. For loading curves also the laws of `fit_power_laws`, with ``law_count``
        and ``law_samples`` as the numbers of forces and samples, and the attribute ``window``; without laws, the
        attribute ``no_power_law`` holds the reason. ``cases`` counts the completed cases, ``resolved_samples`` the
        samples in which a load is resolved, and ``law_resolved`` the forces of a law that are resolved in at least
        half of the samples.

    Raises
    ------
    ValueError
        If no samples lie along a dimension, or `rng` is no seed.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=3, parameters=fixed, table={"hurst": [0.6, 0.8]})
    >>> rc.study.run(study, "few").done
    6
    >>> with rc.study.Store.open("few") as store:
    ...     found = rc.statistics.averages(rc.study.export(store), rng=np.random.default_rng(1))
    >>> dict(found["stiffness_mean"].sizes), found["cases"].values.tolist()
    ({'hurst': 2, 'load': 3}, [3, 3])
    """
    rng = as_generator(rng)
    over = sample_dimensions(dataset) if samples is None else dimensions(samples)
    if not over or any(d not in dataset.sizes for d in over):
        raise InputError(
            f"no samples lie along {' or '.join(over or _SAMPLES)}",
            "pass the dataset of study.export",
            place="samples",
        )
    answered = dataset.assign(
        {name: _answered(dataset, values) for name, values in dataset.data_vars.items()}
    )
    numbers = [
        str(name)
        for name, values in answered.data_vars.items()
        if values.dtype.kind in "fiub"
        and name != "resolved"
        and (set(over) <= set(values.dims) or not set(over) & set(values.dims))
    ]
    result = summary(answered, numbers, over)
    if "case_status" in dataset:
        result["cases"] = _done(dataset["case_status"], over)
        if "resolved" in dataset:
            result["resolved_samples"] = _resolved_samples(dataset, over)
    try:
        common = _on_common_forces(dataset, over)
        laws = fit_power_laws(common, window, rng=rng, samples=over)
    except ValueError as error:
        return result.assign_attrs(no_power_law=str(error))
    laws = laws.rename(count="law_count", samples="law_samples")
    if "resolved_samples" in result:
        laws["law_resolved"] = _resolved_forces(common, laws, result["cases"], over)
    return result.assign(laws.data_vars).assign_attrs(window=laws.attrs["window"])


def combinations(averaged: xarray.Dataset) -> Iterator[tuple[dict[str, Any], xarray.Dataset]]:
    """Yield, for each combination of the varying parameters, their values by name and the averages.

    Parameters
    ----------
    averaged : Dataset
        As `averages` makes it of the export of a study.

    Yields
    ------
    tuple of dict and Dataset
        In the order of the study.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=3, parameters=fixed, table={"hurst": [0.6, 0.8]})
    >>> rc.study.run(study, "few").done
    6
    >>> with rc.study.Store.open("few") as store:
    ...     found = rc.statistics.averages(rc.study.export(store), rng=np.random.default_rng(1))
    >>> [(varied["hurst"], f"{point['rms_slope_mean']:.4f}") for varied, point in rc.statistics.combinations(found)]
    [(0.6, '0.0140'), (0.8, '0.0119')]
    """
    cases = averaged["cases"]
    for place in np.ndindex(cases.shape):
        point = averaged.isel(dict(zip(cases.dims, place, strict=True)))
        yield {name: point[name].item() for name in _varying(averaged)}, point


def _varying(averaged: xarray.Dataset) -> tuple[str, ...]:
    """Return the names of the varying parameters: the dimensions of the cases, and the variables along their rows."""
    dims = averaged["cases"].dims
    in_rows = [name for name, values in averaged.coords.items() if values.dims == ("row",) and name != "row"]
    return tuple(str(name) for d in dims for name in (in_rows if d == "row" else [d]))


def _on_common_forces(dataset: xarray.Dataset, over: Sequence[str]) -> xarray.Dataset:
    """Return loading curves interpolated at common forces that all of them reach, if samples have different forces.

    Raises
    ------
    InputError
        If the loads go up and down.
    """
    if "branch" in dataset:
        raise InputError("the loads go up and down: these are no loading curves")
    force = dataset.get("dimensionless_force")
    own = [] if force is None or "load" not in force.dims else [d for d in over if d in force.dims]
    if force is None or not own or float((force.max(own) / force.min(own)).max()) <= 1 + ROUNDING:
        return dataset
    low, high = float(force.min("load").max()), float(force.max("load").min())
    return on_common(dataset, np.geomspace(low, high, dataset.sizes["load"])) if low < high else dataset


def _resolved_samples(dataset: xarray.Dataset, over: Sequence[str]) -> xarray.DataArray:
    """Return in how many samples each load is resolved, of those that met the tolerance."""
    resolved = _answered(dataset, dataset["resolved"].astype(float)) == 1
    counted = ((dataset["case_status"] == "done") & resolved).sum(over)
    return counted.assign_attrs(long_name="samples in which the load is resolved", units="1")


def _resolved_forces(
    common: xarray.Dataset, laws: xarray.Dataset, cases: xarray.DataArray, over: Sequence[str]
) -> xarray.DataArray:
    """Return how many forces of each law are resolved in half of the samples or more."""
    force = common["dimensionless_force"]
    force = force.max([d for d in over if d in force.dims])
    inside = (force >= laws["window_low"] * (1 - ROUNDING)) & (force <= laws["window_high"] * (1 + ROUNDING))
    resolved = inside & (2 * _resolved_samples(common, over) >= cases)
    counted = resolved.sum([d for d in resolved.dims if d not in cases.dims])
    return counted.assign_attrs(
        long_name="number of forces in the fit that half of the samples resolve", units="1"
    )


def _done(status: xarray.DataArray, over: Sequence[str]) -> xarray.DataArray:
    done = (status == "done").sum([d for d in over if d in status.dims])
    return done.assign_attrs(long_name="completed samples of the combination", units="1")


def _answered(dataset: xarray.Dataset, values: xarray.DataArray) -> xarray.DataArray:
    """Return numbers along the loads, NaN where a load missed its tolerance."""
    if values.dtype.kind != "f" or "status" not in dataset:
        return values
    status = dataset["status"]
    return values.where(status.isin(_CONVERGED)) if set(status.dims) <= set(values.dims) else values
