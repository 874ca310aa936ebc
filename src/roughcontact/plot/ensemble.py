"""Ensembles: means with the band of their error, and values fitted to them against a parameter."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import xarray
from matplotlib import colormaps
from matplotlib.axes import Axes

from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import pretty
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK, label_axes
from roughcontact.validation import Array

__all__ = ["fitted_values", "hollow_marks", "mean_curves", "shades"]

# Colours that are distinct for every reader; more groups than these get shades in their order.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
_NAMED = 12  # groups at most, to leave room for a legend
_BAND = 0.25  # opacity


def mean_curves(
    force: xarray.DataArray,
    mean: xarray.DataArray,
    ax: Axes | None = None,
    *,
    error: xarray.DataArray | None = None,
    resolved: xarray.DataArray | None = None,
) -> Axes:
    """Draw means over samples against force, both logarithmic, one line for each group.

    Parameters
    ----------
    force : DataArray
        Along the points, and along the groups if their forces differ; such as ``dimensionless_force`` of an export.
    mean : DataArray
        Along the points and at most one more dimension, whose values name the groups.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    error : DataArray, optional
        Half the width of a band about the mean, such as `roughcontact.statistics.standard_error`, or the standard
        deviation for the scatter of samples.
    resolved : DataArray of bool, optional
        Points that are not resolved are drawn thin and dotted.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If there is more than one dimension of groups.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray
    >>> import roughcontact as rc
    >>> force = xarray.DataArray(np.geomspace(1e-3, 1e-1, 7), dims="load", name="force", attrs={"units": "N"})
    >>> samples = xarray.DataArray(np.outer([0.9, 1.0, 1.1], force**0.6), dims=("sample", "load"), name="stiffness")
    >>> mean, error = rc.statistics.mean(samples), rc.statistics.standard_error(samples)
    >>> axes = rc.plot.mean_curves(force, mean, error=error)
    >>> axes.get_xscale(), len(axes.lines)
    ('log', 1)
    """
    points = force.dims[-1]
    groups = [d for d in mean.dims if d != points]
    if len(groups) > 1 or points not in mean.dims:
        raise InputError(
            f"curves lie along {points!r} and one dimension of groups, not along {', '.join(map(str, mean.dims))}",
            "select or average the others first",
        )
    axes = axes_for(ax)
    half = 0.0 * mean if error is None else error
    inside = mean.notnull() if resolved is None else resolved
    every = xarray.broadcast(force, mean, half, inside)
    rows = [np.atleast_2d(each.transpose(*groups, points).to_numpy()) for each in every]
    names = [_named(mean, groups[0], i) for i in range(len(rows[0]))] if groups else [""]
    for x, y, band, kept, name, colour in zip(*rows, names, shades(len(names)), strict=True):
        _curve(axes, (x, y, band), kept, name, colour)
    axes.set(xscale="log", yscale="log")
    label_axes(axes, _words(force), _words(mean), grid=True)
    if groups and len(names) <= _NAMED:
        axes.legend(title=_words(mean[groups[0]]), fontsize=TICK, title_fontsize=TICK, frameon=False)
    return axes


def fitted_values(
    fits: xarray.Dataset,
    name: str = "exponent",
    ax: Axes | None = None,
    *,
    along: str,
    label: str = "",
    colour: str = _COLOURS[0],
    shift: float = 0.0,
    resolved: xarray.DataArray | None = None,
) -> Axes:
    """Draw the results of `roughcontact.statistics.fit_power_laws` against a parameter, with their intervals.

    Parameters
    ----------
    fits : Dataset
        A dataset whose only dimension is `along`; ensembles without a fit are left out.
    name : str
        ``"exponent"`` or ``"prefactor"``.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    along : str
        The parameter.
    label : str
        Label in the legend.
    colour : str
    shift : float
        Shift of the marks along the axis, so that several series do not hide one another.
    resolved : DataArray of bool, optional
        Marks of loads that are not resolved are hollow.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If there are other dimensions.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray
    >>> import roughcontact as rc
    >>> force = np.geomspace(1e-3, 1e-1, 7)
    >>> stiffness = [np.outer([0.9, 1.0, 1.1], force**power) for power in (0.6, 0.55)]
    >>> dims = {"dimensionless_force": "load", "dimensionless_stiffness": ("hurst", "sample", "load")}
    >>> curves = xarray.Dataset({name: (dims[name], each) for name, each in zip(dims, (force, stiffness))})
    >>> window = rc.statistics.force_window(1e-3, 1e-1)
    >>> laws = rc.statistics.fit_power_laws(curves, window, rng=np.random.default_rng(1))
    >>> rc.plot.fitted_values(laws.assign_coords(hurst=[0.67, 0.82]), along="hurst").get_ylabel()
    'exponent'
    """
    if fits[name].dims != (along,):
        raise InputError(
            f"{name} lies along {', '.join(map(str, fits[name].dims))}, not only along {along!r}",
            "select first",
        )
    axes = axes_for(ax)
    x, y, low, high = (fits[each].to_numpy() for each in (along, name, f"{name}_low", f"{name}_high"))
    shown = np.isfinite(y)
    # A single sample has a value and no interval.
    arms = np.nan_to_num(np.stack([y - low, high - y])[:, shown])
    style: Any = {"fmt": "o", "markersize": 4, "capsize": 2, "linewidth": 1.0, "color": colour, "zorder": 3}
    axes.errorbar(x[shown] + shift, y[shown], np.maximum(arms, 0.0), label=label or None, **style)
    if resolved is not None and (hollow := shown & ~resolved.to_numpy()).any():
        axes.plot(x[hollow] + shift, y[hollow], **hollow_marks(colour), zorder=4)
    label_axes(axes, _words(fits[along]), _words(fits[name]), grid=True)
    return axes


def hollow_marks(colour: Any) -> dict[str, Any]:
    """Return the style of marks for loads that are not resolved, as in the picture of a curve."""
    return {"marker": "o", "markersize": 4, "linestyle": "", "color": colour, "markerfacecolor": "white"}


def _curve(
    axes: Axes, numbers: tuple[Array, Array, Array], inside: npt.NDArray[np.bool_], name: str, colour: Any
) -> None:
    """Draw one mean with its band; zeros are left out, because the axis is logarithmic."""
    x, y, half = numbers
    shown = np.isfinite(y) & (y > 0) & (x > 0)
    if not inside[shown].all():
        axes.plot(x[shown], y[shown], ":", color=colour, linewidth=0.9, zorder=2)
    kept = shown & inside
    axes.plot(x[kept], y[kept], "-", color=colour, linewidth=1.5, label=name or None, zorder=3)
    lower = np.where(half < y, y - half, np.nan)
    if (half[shown] > 0).any():
        band: Any = {"color": colour, "alpha": _BAND, "linewidth": 0, "zorder": 1}
        axes.fill_between(x[shown], lower[shown], (y + half)[shown], **band)


def shades(count: int) -> list[Any]:
    """Return `count` colours for lines on white."""
    if count <= len(_COLOURS):
        return list(_COLOURS[:count])
    # The last of viridis is too pale for a line on white.
    return list(colormaps["viridis"](np.linspace(0, 0.9, count)))


def _named(values: xarray.DataArray, dimension: Any, index: int) -> str:
    value = values[dimension].to_numpy()[index]
    return f"{value:g}" if values[dimension].dtype.kind in "fiu" else str(value)


def _words(values: xarray.DataArray) -> str:
    """Return the name of a variable with its unit, as on an axis."""
    unit = pretty(values.attrs.get("units", ""))
    name = str(values.name)
    known = VARIABLES[name].label if name in VARIABLES else name.replace("_", " ")
    return f"{known} [{unit}]" if unit else known
