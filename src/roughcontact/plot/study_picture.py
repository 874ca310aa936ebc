"""A study in one picture: means with the band of their error, and what varies with a parameter."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.errors import InputError
from roughcontact.plot.drawing.ticks import TICK
from roughcontact.plot.ensemble import fitted_values, mean_curves, shades
from roughcontact.recipe.texts import choose
from roughcontact.statistics.averages import combinations

__all__ = ["study_figure"]

_FORCES = ("dimensionless_force", "dimensionless_force_mean", "force", "force_mean")
_LAW = "dimensionless_stiffness"  # the quantity whose power law there may be
_WIDE = 16.0  # from this ratio on, values of a parameter stand on a logarithmic axis
_APART = 0.006  # of the axis, between the marks of series


def study_figure(averaged: xarray.Dataset, quantity: str, along: str | None = None) -> Figure:
    """Return the picture of one quantity of a study: against force with its laws, or against what varies.

    Parameters
    ----------
    averaged : Dataset
        As `roughcontact.statistics.averages` makes it.
    quantity : str
        Along the loads, or without a dimension of its own.
    along : str, optional
        The parameter on the axis; by default the number of which there are most values.

    Returns
    -------
    Figure

    Raises
    ------
    ValueError
        If the study has no such quantity or parameter, or the quantity lies along other dimensions.

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
    >>> figure = rc.plot.study_figure(found, "dimensionless_stiffness")
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]  # a curve for each Hurst exponent
    ['0.6', '0.8']
    """
    name = f"{quantity}_mean"
    if name not in averaged:
        known = [str(each).removesuffix("_mean") for each in averaged if str(each).endswith("_mean")]
        raise InputError(f"no {quantity!r} differs between samples", choose(quantity, known), "quantity")
    points = [d for d in averaged[name].dims if d not in averaged["cases"].dims]
    numbers = _numbers(averaged)
    if along is not None and along not in numbers:
        raise InputError(
            f"{along!r} is no number that varies",
            choose(along, tuple(numbers)) if numbers else "leave it out: no number varies",
            "along",
        )
    chosen = along or max(numbers, key=lambda each: len(numbers[each]), default=None)
    if points == ["load"]:
        return _curves(averaged, quantity, chosen)
    if points:
        raise InputError(
            f"{quantity!r} lies along {', '.join(map(str, points))}", "choose one along the loads, or none"
        )
    if chosen is None:
        raise InputError(f"{quantity!r} is one number, and nothing varies", "take the command study table")
    figure = Figure(figsize=(5.6, 4.2), layout="constrained")
    _against(figure.subplots(), averaged, quantity, chosen)
    return figure


def _numbers(averaged: xarray.Dataset) -> dict[str, set[float]]:
    """Return the values of the parameters that vary and are numbers."""
    found: dict[str, set[float]] = {}
    for parameters, _ in combinations(averaged):
        for name, value in parameters.items():
            if isinstance(value, int | float) and not isinstance(value, bool):
                found.setdefault(name, set()).add(value)
    return {name: values for name, values in found.items() if len(values) > 1}


def _curves(averaged: xarray.Dataset, quantity: str, along: str | None) -> Figure:
    """Return means against force, and beside them the exponents of their laws where there are some."""
    there = "exponent" in averaged and bool(averaged["exponent"].notnull().any())
    laws = quantity == _LAW and along is not None and there
    figure = Figure(figsize=(10.0 if laws else 5.6, 4.4), layout="constrained")
    axes = figure.subplots(1, 2) if laws else [figure.subplots()]
    force = next((name for name in _FORCES if name in averaged and "load" in averaged[name].dims), None)
    if force is None:
        raise InputError("the study has no forces along its loads", "choose a quantity without loads")
    resolved = averaged["resolved_mean"] >= 0.5 if "resolved_mean" in averaged else None
    mean_curves(
        _grouped(averaged, averaged[force]).rename(force.removesuffix("_mean")),
        _grouped(averaged, averaged[f"{quantity}_mean"]).rename(quantity),
        axes[0],
        error=_grouped(averaged, averaged[f"{quantity}_standard_error"]),
        resolved=None if resolved is None else _grouped(averaged, resolved),
    )
    words = f"means and their standard errors{'' if resolved is None else '; dotted: not resolved'}"
    if quantity == _LAW and there:
        _draw_laws(axes[0], averaged)
        words = "means, their standard errors, power laws (dashed); dotted: not resolved"
    axes[0].set_title(words, fontsize=TICK)
    if laws and along is not None:
        _against(axes[1], averaged, "exponent", along)
    return figure


def _grouped(averaged: xarray.Dataset, values: xarray.DataArray) -> xarray.DataArray:
    """Return values with one dimension for all combinations, named by what varies."""
    groups = [d for d in averaged["cases"].dims if d in values.dims]
    if not groups or (len(groups) == 1 and groups[0] != "row"):
        return values.transpose(*groups, ...)
    labels = [
        ", ".join(_word(value) for value in parameters.values()) for parameters, _ in combinations(averaged)
    ]
    name = ", ".join(next(combinations(averaged))[0])
    missing = [d for d in averaged["cases"].dims if d not in values.dims]
    whole = values.expand_dims({d: averaged.sizes[d] for d in missing})
    bare = whole.reset_coords(drop=True).drop_vars([d for d in whole.dims if d in whole.coords])
    stacked = bare.stack({name: averaged["cases"].dims}, create_index=False)
    return stacked.assign_coords({name: labels}).transpose(name, ...)


def _draw_laws(axes: Axes, averaged: xarray.Dataset) -> None:
    """Draw the power laws over their windows."""
    for _, point in combinations(averaged):
        window = np.array([point["window_low"].item(), point["window_high"].item()])
        law = point["prefactor"].item() * window ** point["exponent"].item()
        axes.plot(window, law, "--", color="black", linewidth=0.8, zorder=4)


def _against(axes: Axes, averaged: xarray.Dataset, quantity: str, along: str) -> None:
    """Draw a number of every combination with its error against a parameter, one series for all else that varies."""
    series: dict[str, list[tuple[float, float, float, float]]] = {}
    for parameters, point in combinations(averaged):
        others = ", ".join(f"{name} = {_word(value)}" for name, value in parameters.items() if name != along)
        series.setdefault(others, []).append((float(parameters[along]), *_with_limits(point, quantity)))
    places = np.array([row[0] for rows in series.values() for row in rows])
    wide = places.min() > 0 and places.max() >= _WIDE * places.min()
    if wide:
        axes.set_xscale("log")
    step = 0.0 if wide else _APART * float(np.ptp(places))
    attributes = averaged[quantity if quantity in averaged else f"{quantity}_mean"].attrs
    for k, ((label, rows), colour) in enumerate(zip(series.items(), shades(len(series)), strict=True)):
        x, y, low, high = np.array(sorted(rows)).T
        values = {quantity: y, f"{quantity}_low": low, f"{quantity}_high": high}
        fits = xarray.Dataset({n: (along, v, attributes) for n, v in values.items()}, {along: x})
        fits[along].attrs.update(averaged[along].attrs)
        fitted_values(fits, quantity, axes, along=along, label=label, colour=colour, shift=step * k)
    axes.set_title(
        "95 % intervals" if f"{quantity}_low" in averaged else "means and their standard errors",
        fontsize=TICK,
    )
    if len(series) > 1:
        axes.legend(fontsize=TICK, frameon=False)


def _with_limits(point: xarray.Dataset, quantity: str) -> tuple[float, float, float]:
    """Return a number and the ends of its interval: of a law its own, of a mean a standard error on either side."""
    if f"{quantity}_low" in point:
        return tuple(point[name].item() for name in (quantity, f"{quantity}_low", f"{quantity}_high"))
    value, error = (point[f"{quantity}_{word}"].item() for word in ("mean", "standard_error"))
    return value, value - error, value + error


def _word(value: Any) -> str:
    return f"{value:g}" if isinstance(value, int | float) else str(value)
