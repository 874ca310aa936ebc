"""Averages of ensembles: which loads count, means with their errors, and these in words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, cast

import numpy as np

from roughcontact.solver.control import Status
from roughcontact.statistics.samples import mean, standard_error

if TYPE_CHECKING:
    import xarray

__all__ = ["apart", "converged", "exponential", "logarithm", "means", "plus_minus", "same_for_all", "slope"]

_CONVERGED = [status.value for status in Status if status.converged]


def converged(exported: xarray.Dataset) -> xarray.Dataset:
    """Return an export whose loads that missed their tolerance are missing."""
    met = exported["status"].isin(_CONVERGED)
    numbers = [
        name for name, each in exported.data_vars.items() if each.dtype.kind == "f" and "load" in each.dims
    ]
    return exported.assign(
        {name: exported[name].where(met) for name in numbers if "sample" in exported[name].dims}
    )


def means(values: Mapping[str, xarray.DataArray]) -> xarray.Dataset:
    """Return the mean of each variable over the samples and, as ``NAME_error``, its standard error."""
    import xarray

    found = {}
    for name, each in values.items():
        found[name], found[f"{name}_error"] = mean(each), standard_error(each)
    return xarray.Dataset(found)


def apart(exported: xarray.Dataset) -> xarray.Dataset:
    """Return averages without the parameters of the case that do not vary."""
    return exported.drop_vars([name for name, each in exported.coords.items() if not each.dims])


def same_for_all(values: xarray.DataArray) -> xarray.DataArray:
    """Return what all samples have in common but for rounding, which an export keeps once or for each."""
    return values.max("sample") if "sample" in values.dims else values


def plus_minus(averages: xarray.Dataset, name: str, form: str = ".2f") -> str:
    """Return a mean with its standard error in words; of one sample the mean alone."""
    value, error = float(averages[name]), float(averages[f"{name}_error"])
    spread = "" if math.isnan(error) else f" ± {error:{form.replace('+', '')}}"
    return f"{value:{form}}{spread}"


def logarithm(values: xarray.DataArray) -> xarray.DataArray:
    """Return the natural logarithm, with its labels."""
    return cast("xarray.DataArray", np.log(values))


def exponential(values: xarray.DataArray) -> xarray.DataArray:
    """Return the exponential, with its labels."""
    return cast("xarray.DataArray", np.exp(values))


def slope(values: xarray.DataArray, places: xarray.DataArray, along: str) -> xarray.DataArray:
    """Return the slope of the straight line through values over places, by least squares; NaN is left out."""
    there = places.where(values.notnull())
    away = there - there.mean(along)
    return (values * away).sum(along) / (away**2).sum(along)
