"""Averages of ensembles: which loads count, means with their errors, logarithms and slopes of labelled arrays."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import xarray

import roughcontact as rc
from roughcontact.solver.control import Status
from roughcontact.statistics.samples import mean, scatter, standard_error
from roughcontact.study.study import Study
from roughcontact_thesis.figures import Scale, Studies

__all__ = [
    "RMS",
    "converged",
    "counts",
    "curve_statistics",
    "exponential",
    "logarithm",
    "means",
    "outlook_studies",
    "rms_heights",
    "same_for_all",
    "slope",
    "surface_study",
    "without_parameters",
]

RMS = 0.01  # of the surfaces, over their side
_CONVERGED = [status.value for status in Status if status.converged]


def surface_study(name: str, parameters: dict[str, Any], **given: Any) -> Study:
    """Return a study of surfaces of unit side; further keywords are those of `Study`."""
    common = {"size": 1.0, "modulus": 1.0, "rms": RMS}
    return Study(name=name, parameters=common | parameters, **given)


def outlook_studies(name: str, scale: Scale, parameters: dict[str, Any], **given: Any) -> Studies:
    """Return the one study of a question of the outlook, see `surface_study`."""
    return (surface_study(f"outlook-{name}{'-small' if scale == 'small' else ''}", parameters, **given),)


def converged(exported: xarray.Dataset) -> xarray.Dataset:
    """Return an export whose loads that missed their tolerance are missing."""
    met = exported["status"].isin(_CONVERGED)
    numbers = [
        name
        for name, each in exported.data_vars.items()
        if each.dtype.kind == "f" and {"load", "sample"} <= {*each.dims}
    ]
    return exported.assign({name: exported[name].where(met) for name in numbers})


def means(**values: xarray.DataArray) -> xarray.Dataset:
    """Return the mean of each variable over the samples and, as ``NAME_error``, its standard error."""
    found = {}
    for name, each in values.items():
        found[name], found[f"{name}_error"] = mean(each), standard_error(each)
    return xarray.Dataset(found)


def curve_statistics(force: xarray.DataArray, stiffness: xarray.DataArray) -> xarray.Dataset:
    """Return the mean stiffness at every force, its standard error and its scatter."""
    found = means(stiffness=stiffness).assign(scatter=scatter(stiffness))
    return xarray.Dataset({"force": force}).assign(found.data_vars)


def without_parameters(exported: xarray.Dataset) -> xarray.Dataset:
    """Return averages without the parameters of the case that do not vary."""
    return exported.drop_vars([name for name, each in exported.coords.items() if not each.dims])


def counts(exported: xarray.Dataset) -> dict[str, int]:
    """Return how many samples an export holds, and the largest number of cells a side."""
    return {"surfaces": exported.sizes["sample"], "cells": int(exported["points"].max())}


def same_for_all(values: xarray.DataArray) -> xarray.DataArray:
    """Return what all samples have in common but for rounding, which an export keeps once or for each."""
    return values.max("sample") if "sample" in values.dims else values


def logarithm(values: xarray.DataArray) -> xarray.DataArray:
    """Return the natural logarithm, with its labels."""
    return cast("xarray.DataArray", np.log(values))


def exponential(values: xarray.DataArray) -> xarray.DataArray:
    """Return the exponential, with its labels."""
    return cast("xarray.DataArray", np.exp(values))


def rms_heights(points: int, hurst: xarray.DataArray, shortest: xarray.DataArray) -> xarray.DataArray:
    """Return the rms height of waves on a square of unit side down to the shortest, with one factor of the spectrum."""
    grid = rc.Grid((points, points), 1 / points)

    def height(hurst: float, shortest: float) -> float:
        return rc.grid_moments(grid, rc.SelfAffineSpectrum(hurst, short_cutoff=shortest)).rms_height

    found: xarray.DataArray = xarray.apply_ufunc(height, hurst, shortest, vectorize=True, keep_attrs=False)
    return found


def slope(values: xarray.DataArray, places: xarray.DataArray, along: str) -> xarray.DataArray:
    """Return the slope of the straight line through values over places, by least squares; NaN is left out."""
    there = places.where(values.notnull())
    away = there - there.mean(along)
    return (values * away).sum(along) / (away**2).sum(along)
