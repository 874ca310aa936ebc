"""Statistics over the samples of a study: means, scatter, standard errors.

All functions take labelled data and drop the dimensions of the samples; NaN is a sample that is missing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.statistics.ensemble_mean import mean_over_samples

if TYPE_CHECKING:
    import xarray

__all__ = [
    "count",
    "dimensions",
    "geometric_mean",
    "mean",
    "scatter",
    "standard_deviation",
    "standard_error",
    "summary",
]

Array = npt.NDArray[Any]


def mean(values: xarray.DataArray, samples: str | Sequence[str] = "sample") -> xarray.DataArray:
    """Return the arithmetic mean over the samples.

    Parameters
    ----------
    values : DataArray
        Numbers; NaN is a sample that is missing.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    DataArray
        In the unit of the values, without the dimensions of the samples.

    Raises
    ------
    ValueError
        If no samples lie along a dimension.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> stiffness = xarray.DataArray([1.0, 2.0, 6.0], dims="sample", name="stiffness", attrs={"units": "N/m"})
    >>> rc.statistics.mean(stiffness).item()
    3.0
    """
    return _along(values, samples, mean_over_samples, "mean of {}")


def geometric_mean(values: xarray.DataArray, samples: str | Sequence[str] = "sample") -> xarray.DataArray:
    """Return the geometric mean over the samples.

    Parameters
    ----------
    values : DataArray
        Numbers; NaN is a sample that is missing.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    DataArray
        In the unit of the values: zero if a sample is zero, NaN if a sample is negative.

    Raises
    ------
    ValueError
        If no samples lie along a dimension.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> rc.statistics.geometric_mean(xarray.DataArray([1.0, 2.0, 4.0], dims="sample")).item()
    2.0
    """
    return _along(values, samples, lambda v: mean_over_samples(v, "geometric"), "geometric mean of {}")


def standard_deviation(values: xarray.DataArray, samples: str | Sequence[str] = "sample") -> xarray.DataArray:
    """Return the standard deviation of the population that the samples are drawn from.

    Parameters
    ----------
    values : DataArray
        Numbers; NaN is a sample that is missing.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    DataArray
        In the unit of the values, with n - 1; NaN for one sample.

    Raises
    ------
    ValueError
        If no samples lie along a dimension.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> rc.statistics.standard_deviation(xarray.DataArray([1.0, 2.0, 3.0], dims="sample")).item()
    1.0
    """
    return _along(values, samples, _deviation, "standard deviation of {}")


def standard_error(values: xarray.DataArray, samples: str | Sequence[str] = "sample") -> xarray.DataArray:
    """Return the standard error of the arithmetic mean.

    Parameters
    ----------
    values : DataArray
        Numbers; NaN is a sample that is missing.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    DataArray
        In the unit of the values; NaN for one sample.

    Raises
    ------
    ValueError
        If no samples lie along a dimension.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> rc.statistics.standard_error(xarray.DataArray([1.0, 2.0, 3.0, 4.0, 5.0], dims="sample")).round(3).item()
    0.707
    """
    return _along(values, samples, lambda v: _deviation(v) / np.sqrt(_there(v)), "standard error of {}")


def scatter(values: xarray.DataArray, samples: str | Sequence[str] = "sample") -> xarray.DataArray:
    """Return the standard deviation over the mean (thesis, fig. 18).

    Parameters
    ----------
    values : DataArray
        Numbers; NaN is a sample that is missing.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    DataArray
        A pure number; 0 where all samples are equal.

    Raises
    ------
    ValueError
        If no samples lie along a dimension.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> rc.statistics.scatter(xarray.DataArray([1.0, 2.0, 3.0], dims="sample")).item()
    0.5
    """

    def ratio(v: Array) -> Array:
        deviation, over = _deviation(v), mean_over_samples(v)
        # Before first contact all values are zero.
        return np.where(deviation == 0, 0.0, deviation / over)

    return _along(values, samples, ratio, "standard deviation over mean of {}", "1")


def count(values: xarray.DataArray, samples: str | Sequence[str] = "sample") -> xarray.DataArray:
    """Return the number of samples that are not missing.

    Parameters
    ----------
    values : DataArray
        Numbers; NaN is a sample that is missing.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    DataArray
        A whole number.

    Raises
    ------
    ValueError
        If no samples lie along a dimension.

    Examples
    --------
    >>> import math
    >>> import xarray
    >>> import roughcontact as rc
    >>> rc.statistics.count(xarray.DataArray([1.0, math.nan, 3.0], dims="sample")).item()
    2
    """
    return _along(values, samples, _there, "number of samples of {}", "1")


STATISTICS: Mapping[str, Callable[..., xarray.DataArray]] = MappingProxyType(
    {
        each.__name__: each
        for each in (mean, geometric_mean, standard_deviation, standard_error, scatter, count)
    }
)


def summary(
    dataset: xarray.Dataset, names: Sequence[str] | None = None, samples: str | Sequence[str] = "sample"
) -> xarray.Dataset:
    """Return all statistics of variables, as ``NAME_mean``, ``NAME_geometric_mean`` and so on.

    Parameters
    ----------
    dataset : Dataset
        As `roughcontact.study.export` makes it.
    names : sequence of str, optional
        Variables of numbers or truth values; by default all that lie along the samples. Other variables are the same
        in all samples, and are kept.
    samples : str or sequence of str
        Dimensions of the samples.

    Returns
    -------
    Dataset
        Without the dimensions of the samples.

    Raises
    ------
    ValueError
        If the dataset has no such variable or dimension, or the variable holds words.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> dataset = xarray.Dataset({"stiffness": (("hurst", "sample"), [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0]])})
    >>> rc.statistics.summary(dataset)["stiffness_mean"].values.tolist()
    [2.0, 4.0]
    """
    over = dimensions(samples)
    if absent := [d for d in over if d not in dataset.sizes]:
        raise InputError(
            f"no samples lie along {absent[0]!r}; there are {_listed(dataset.sizes)}", place="samples"
        )
    numbers = [str(name) for name, values in dataset.data_vars.items() if values.dtype.kind in "fiub"]
    chosen = [n for n in numbers if set(over) <= set(dataset[n].dims)] if names is None else list(names)
    if unknown := [name for name in chosen if name not in numbers]:
        raise InputError(f"there are no numbers named {unknown[0]!r}; there are {_listed(numbers)}")
    # Assigned together: a dataset looks at all its variables each time that it gets new ones.
    found: dict[str, xarray.DataArray] = {}
    for name in chosen:
        values = dataset[name]
        if not set(over) <= set(values.dims):
            found[name] = values
            continue
        if values.dtype.kind == "b" and "case_status" in dataset:
            # False for a missing case is not a result.
            values = values.astype(np.float64).where(dataset["case_status"] == "done")
        for word, statistic in STATISTICS.items():
            found[f"{name}_{word}"] = statistic(values, over)
    return dataset.drop_vars([*dataset.data_vars, *over], errors="ignore").assign(found)


def dimensions(samples: str | Sequence[str]) -> tuple[str, ...]:
    """Return the dimensions of samples; a single one may be given as a name."""
    return (samples,) if isinstance(samples, str) else tuple(samples)


def _along(
    values: xarray.DataArray,
    samples: str | Sequence[str],
    function: Callable[[Array], Array],
    words: str,
    unit: str | None = None,
) -> xarray.DataArray:
    """Return `function`, applied to an array with the samples first, as a variable with its description."""
    over = dimensions(samples)
    if absent := [d for d in over if d not in values.dims]:
        raise InputError(
            f"no samples of {values.name} lie along {absent[0]!r}; it has {_listed(values.dims)}",
            place="samples",
        )
    first = values.transpose(*over, ...)
    kept = first.isel(dict.fromkeys(over, 0), drop=True)
    table = first.to_numpy().astype(np.float64).reshape(-1, kept.size)
    with np.errstate(all="ignore"):  # empty means, and infinities
        result = kept.copy(data=function(table).reshape(kept.shape))
    result.attrs["long_name"] = words.format(values.attrs.get("long_name", values.name))
    if unit is not None:
        result.attrs["units"] = unit
    return result


def _there(values: Array) -> Array:
    return np.asarray((~np.isnan(values)).sum(axis=0))


def _deviation(values: Array) -> Array:
    """Return the standard deviation with n - 1 over samples along the first axis."""
    there = _there(values)
    away = np.where(np.isnan(values), 0.0, values - mean_over_samples(values))
    return np.asarray(np.where(there > 1, np.sqrt((away**2).sum(axis=0) / (there - 1)), np.nan))


def _listed(names: Any) -> str:
    return ", ".join(map(str, names)) or "none"
