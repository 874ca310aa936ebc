"""Records at common forces, interpolated from records with different forces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.solver.control import Status
from roughcontact.statistics.fit_window import is_resolved
from roughcontact.statistics.power_law import ROUNDING
from roughcontact.units import in_si
from roughcontact.validation import number

if TYPE_CHECKING:
    import xarray

__all__ = ["on_common"]

Array = npt.NDArray[Any]
_LIMITS = ("cell_stiffness", "full_contact_stiffness")  # of the stiffness of a resolved load
_LINE = Geometry.LINE.value  # whose loads are resolved by their width


def on_common(
    dataset: xarray.Dataset, values: npt.ArrayLike, at: str = "dimensionless_force", along: str = "load"
) -> xarray.Dataset:
    """Return a dataset whose records stand at common values of one of their variables.

    Numbers are interpolated on straight lines between the logarithms of neighbouring points, exact for power laws,
    and never beyond the first or the last: there they are NaN, as between two points of which one is missing or not
    above zero. A truth value is true between two points if it is true at both; a word is kept if both points have it,
    otherwise it is empty. Whether a load of a loading curve is resolved follows from its interpolated stiffness.

    Parameters
    ----------
    dataset : Dataset
        As `roughcontact.study.export` makes it.
    values : array, shape (n,)
        Values of `at` for the result, above zero: the coordinate of a dimension of this name, in place of `along`.
    at : str
        A variable along `along`, in any order.
    along : str
        Dimension of the points of a record. Variables without it stay as they are.

    Returns
    -------
    Dataset
        With the coordinate `at` in place of the dimension `along`.

    Raises
    ------
    ValueError
        If the dataset has no such variable along `along`, or a value is not above zero.

    Examples
    --------
    >>> import xarray
    >>> import roughcontact as rc
    >>> curves = {"dimensionless_force": ("load", [0.01, 0.04]), "dimensionless_stiffness": ("load", [0.1, 0.2])}
    >>> found = rc.statistics.on_common(xarray.Dataset(curves), [0.01, 0.02, 0.08])
    >>> found["dimensionless_stiffness"].round(3).values.tolist()  # NaN beyond the last load
    [0.1, 0.141, nan]
    """
    import xarray

    if at not in dataset or along not in dataset[at].dims:
        raise InputError(f"no variable {at!r} lies along {along!r}: the points have no positions")
    wanted = np.asarray(number(in_si(values, dataset[at].attrs.get("units"), "values"), "values"))
    if wanted.ndim != 1 or not (np.isfinite(wanted) & (wanted > 0)).all():
        raise InputError("the common values are finite numbers above zero, in one row")
    places = dataset[at].transpose(..., along)
    table = places.to_numpy().reshape(-1, places.sizes[along])
    found = np.stack([_between(row, wanted) for row in table], axis=1)
    lower, upper, share = (
        xarray.DataArray(part.reshape((*places.shape[:-1], len(wanted))), dims=(*places.dims[:-1], at))
        for part in found
    )
    pair = lower.astype(int), upper.astype(int)
    moved = {
        name: _read(variable.variable, along, pair, share)
        for name, variable in dataset.data_vars.items()
        if name != at and along in variable.dims
    }
    result = dataset.drop_dims(along).assign(moved)
    if "resolved" in moved and set(_LIMITS) <= set(dataset) and dataset.attrs.get("geometry") != _LINE:
        stiffness = result["unloading_stiffness" if "unloading_stiffness" in result else "stiffness"]
        resolved = xarray.apply_ufunc(is_resolved, stiffness, *(result[name] for name in _LIMITS))
        if "status" in moved:
            resolved &= result["status"] == Status.CONVERGED.value
        result["resolved"] = resolved.assign_attrs(dataset["resolved"].attrs)
    order = [d for d in dataset.sizes if d != along]
    return result.assign_coords({at: (at, wanted, places.attrs)}).transpose(*order, at, missing_dims="ignore")


def _between(places: Array, wanted: Array) -> tuple[Array, Array, Array]:
    """Return the points below and above each value, and its relative position between them: 0 to 1, or NaN."""
    order = np.argsort(places, kind="stable")
    order = order[places[order] > 0]
    if not len(order):
        none = np.zeros(len(wanted))
        return none, none, np.full(len(wanted), np.nan)
    x, w = np.log(places[order]), np.log(wanted)
    first = np.clip(np.searchsorted(x, w, side="right") - 1, 0, max(len(x) - 2, 0))
    second = np.minimum(first + 1, len(x) - 1)
    # A value that differs from a point only by rounding is this point; this matters at the ends of a record.
    at_first, at_second = (np.abs(w - x[i]) <= ROUNDING for i in (first, second))
    step = np.where(x[second] > x[first], x[second] - x[first], np.inf)
    share = np.where(at_first, 0.0, np.where(at_second, 1.0, (w - x[first]) / step))
    outside = (w < x[first] - ROUNDING) | (w > x[second] + ROUNDING)
    return order[first], order[second], np.where(outside, np.nan, share)


def _across(values: xarray.Variable, like: xarray.Variable) -> Array:
    """Return values broadcast to the dimensions of `like`, which include theirs."""
    known = values.transpose(*(d for d in like.dims if d in values.dims)).to_numpy()
    return known[tuple(slice(None) if d in values.dims else np.newaxis for d in like.dims)]


def _read(
    variable: xarray.Variable,
    along: str,
    pair: tuple[xarray.DataArray, xarray.DataArray],
    share: xarray.DataArray,
) -> xarray.Variable:
    """Return a variable interpolated between the points of each pair."""
    import xarray

    first, second = (variable.isel({along: place.variable}) for place in pair)
    a, b, t = first.to_numpy(), second.to_numpy(), _across(share.variable, first)
    between: Array
    nothing: Any
    if variable.dtype.kind == "b":
        between, nothing = a & b, False
    elif variable.dtype.kind in "fiu":
        with np.errstate(all="ignore"):
            logs = (1 - t) * np.log(np.where(a > 0, a, np.nan)) + t * np.log(np.where(b > 0, b, np.nan))
        between, nothing = np.where(a == b, a, np.exp(logs)), np.nan
    else:
        between, nothing = np.where(a == b, a, ""), ""
    inside = np.where(t == 0, a, np.where(t == 1, b, between))
    return xarray.Variable(first.dims, np.where(np.isnan(t), nothing, inside), variable.attrs)
