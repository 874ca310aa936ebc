"""A study in one picture: means with the band of their error, against force or against a parameter."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import scale
from roughcontact.plot.drawing.parameter_labels import parameter_labels
from roughcontact.plot.drawing.ticks import LABEL, TICK, readable_ticks
from roughcontact.plot.ensemble import fitted_values, hollow_marks, mean_curves, shades
from roughcontact.recipe.texts import choose
from roughcontact.statistics.averages import combinations
from roughcontact.validation import Array

__all__ = ["study_figure"]

_FORCES = ("dimensionless_force", "dimensionless_force_mean", "force", "force_mean")
_LAW = "dimensionless_stiffness"  # the quantity that may have a power law
_WIDE = 16.0  # ratio of the values of a parameter from which their axis is logarithmic
_APART = 0.006  # of the axis: distance between the marks of series
_FEW = 7  # lines at most in one panel with a legend
_COLUMNS = 3  # of panels
_VISIBLE = 0.01  # relative; closer curves coincide in a picture
_MOST = 0.5  # of the samples: resolved part from which a mean counts as resolved


def study_figure(
    averaged: xarray.Dataset, quantity: str, along: str | None = None, *, at: str = ""
) -> Figure:
    """Return the picture of one quantity of a study: against force with its laws, or against a parameter.

    Parameters
    ----------
    averaged : Dataset
        The result of `roughcontact.statistics.averages`.
    quantity : str
        A quantity along the loads, or without a dimension.
    along : str, optional
        The parameter on the axis; with curves, the parameter that differs within a panel. By default the number with
        the most values; with curves, only among the numbers that change them.
    at : str, optional
        The load of the averages in words, such as ``"1 MPa"``, for the title.

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
            f"{along!r} is not a number that varies",
            choose(along, tuple(numbers))
            if numbers
            else "leave it out, because no parameter with numbers varies",
            "along",
        )
    averaged = _in_engineering_units(averaged, quantity)
    if "resolved_samples" in averaged:
        averaged["resolved"] = averaged["resolved_samples"] >= _MOST * averaged["cases"]
    if points == ["load"]:
        return _curves(averaged, quantity, along, numbers)
    chosen = along or _most_values(numbers)
    if points:
        raise InputError(
            f"{quantity!r} lies along {', '.join(map(str, points))}", "choose one along the loads, or none"
        )
    if chosen is None:
        raise InputError(f"{quantity!r} is one number, and nothing varies", "use the command study table")
    figure = Figure(figsize=(5.6, 4.2), layout="constrained")
    axes = figure.subplots()
    _against(axes, averaged, quantity, chosen)
    if at:
        axes.set_title(f"{axes.get_title()}, at {at}", fontsize=TICK)
    return figure


def _in_engineering_units(averaged: xarray.Dataset, quantity: str) -> xarray.Dataset:
    """Return the averages with the drawn quantity and the forces in units with short numbers."""

    def scaled(name: str, largest: str) -> xarray.DataArray:
        values = averaged[name]
        chosen = scale(float(abs(averaged[largest]).max()), values.attrs.get("units", ""))
        return (chosen.factor * values).assign_attrs(values.attrs | {"units": chosen.unit})

    mean, error = f"{quantity}_mean", f"{quantity}_standard_error"
    names = {name: name for name in _FORCES if name in averaged} | {error: mean, mean: mean}
    return averaged.assign({name: scaled(name, largest) for name, largest in names.items()})


def _most_values(numbers: Mapping[str, set[float]]) -> str | None:
    return max(numbers, key=lambda each: len(numbers[each]), default=None)


def _numbers(averaged: xarray.Dataset) -> dict[str, set[float]]:
    """Return the values of the parameters that vary and are numbers."""
    found: dict[str, set[float]] = {}
    for parameters, _ in combinations(averaged):
        for name, value in parameters.items():
            if isinstance(value, int | float) and not isinstance(value, bool):
                found.setdefault(name, set()).add(value)
    return {name: values for name, values in found.items() if len(values) > 1}


def _curves(
    averaged: xarray.Dataset, quantity: str, along: str | None, numbers: Mapping[str, set[float]]
) -> Figure:
    """Return means against force, and beside them the exponents of their laws, if there are any."""
    force = next((name for name in _FORCES if name in averaged and "load" in averaged[name].dims), None)
    if force is None:
        raise InputError("the study has no forces along its loads", "choose a quantity without loads")
    if along is None:
        changing = {name: each for name, each in numbers.items() if _change(averaged, quantity, force, name)}
        along = _most_values(changing or numbers)
    there = quantity == _LAW and "exponent" in averaged and bool(averaged["exponent"].notnull().any())
    panels, title = _panels(averaged, along)
    count = len(panels) + (there and along is not None)
    columns = min(math.ceil(math.sqrt(count)), _COLUMNS)
    rows = math.ceil(count / columns)
    figure = Figure(figsize=(1.0 + 4.6 * columns, 0.4 + 4.0 * rows), layout="constrained")
    places = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, (words, lines) in zip(places, panels.items(), strict=False):
        _draw_means(axes, lines, title, force, quantity)
        if there:
            _draw_laws(axes, lines.values())
        axes.set_title(words, fontsize=TICK)
        if axes is not places[0] and (legend := axes.get_legend()) is not None:
            legend.remove()  # the legend of the first panel serves all panels
    for axis in ("xaxis", "yaxis"):
        shared = [getattr(axes, axis) for axes in places[: len(panels)]]
        ends = np.array([each.get_view_interval() for each in shared])
        low, high = ends.min(), ends.max()
        for each in shared:
            each.set_view_interval(low, high, ignore=True)
            readable_ticks(each, high / low)
    if there and along is not None:
        _against(places[len(panels)], averaged, "exponent", along)
    for axes in places[count:]:
        axes.remove()
    dotted = "; dotted: not resolved" if "resolved" in averaged else ""
    laws = ", power laws (dashed)" if there else ""
    figure.suptitle(f"means and their standard errors{laws}{dotted}", fontsize=TICK)
    return figure


def _change(averaged: xarray.Dataset, quantity: str, force: str, name: str) -> bool:
    """Return whether curves that differ in only one parameter lie apart."""
    groups: dict[tuple[object, ...], list[tuple[Array, Array]]] = {}
    for parameters, point in combinations(averaged):
        others = tuple(value for each, value in parameters.items() if each != name)
        x, y = (point[each].to_numpy() for each in (force, f"{quantity}_mean"))
        shown = (x > 0) & (y > 0)
        order = np.argsort(x[shown])
        groups.setdefault(others, []).append((np.log(x[shown][order]), np.log(y[shown][order])))
    return any(_are_apart(group[0], curve) for group in groups.values() for curve in group[1:])


def _are_apart(one: tuple[Array, Array], other: tuple[Array, Array]) -> bool:
    """Return whether two curves, by their logarithms, differ visibly at a force that both reach."""
    (x, y), (places, values) = one, other
    if not x.size or not places.size:
        return bool(x.size or places.size)
    # Rounding must not separate the ends of curves with equal forces.
    common = (x >= places[0] - _VISIBLE) & (x <= places[-1] + _VISIBLE)
    return not common.any() or bool(np.abs(np.interp(x, places, values) - y)[common].max() > _VISIBLE)


def _panels(averaged: xarray.Dataset, along: str | None) -> tuple[dict[str, dict[str, xarray.Dataset]], str]:
    """Return the means of each panel, by its title and the label of each line, and the title of the lines.

    A few lines share one panel. If there are more, each panel has the lines that differ in one parameter.
    """
    points, labels = list(combinations(averaged)), parameter_labels(averaged)
    counts = {name: len({parameters[name] for parameters, _ in points}) for name in labels}
    chosen = along or max(counts, key=counts.__getitem__, default=None)
    lines = list(labels) if len(points) <= _FEW or chosen is None else [chosen]
    found: dict[str, dict[str, xarray.Dataset]] = {}
    for parameters, point in points:
        panel = ", ".join(labels[name].equation(parameters[name]) for name in labels if name not in lines)
        line = ", ".join(labels[name].value(parameters[name]) for name in lines)
        found.setdefault(panel, {})[line] = point
    return found, ", ".join(labels[name].title for name in lines)


def _draw_means(
    axes: Axes, lines: Mapping[str, xarray.Dataset], title: str, force: str, quantity: str
) -> None:
    """Draw the means of some combinations against force, a line for each."""

    def along_lines(name: str) -> xarray.DataArray:
        each = [point[name].reset_coords(drop=True) for point in lines.values()]
        if not title:
            return each[0]
        return xarray.concat(each, xarray.DataArray(list(lines), dims=title, name=title))

    first = next(iter(lines.values()))
    mean_curves(
        along_lines(force).rename(force.removesuffix("_mean")),
        along_lines(f"{quantity}_mean").rename(quantity),
        axes,
        error=along_lines(f"{quantity}_standard_error"),
        resolved=along_lines("resolved") if "resolved" in first else None,
    )


def _draw_laws(axes: Axes, points: Iterable[xarray.Dataset]) -> None:
    """Draw the power laws over their windows."""
    for point in points:
        window = np.array([point["window_low"].item(), point["window_high"].item()])
        law = point["prefactor"].item() * window ** point["exponent"].item()
        axes.plot(window, law, "--", color="black", linewidth=0.8, zorder=4)


def _against(axes: Axes, averaged: xarray.Dataset, quantity: str, along: str) -> None:
    """Draw a number with its error against a parameter, one series for each combination of the other parameters."""
    series: dict[str, list[tuple[float, float, float, float, bool]]] = {}
    labels = parameter_labels(averaged)
    others = [name for name in labels if name != along]
    marked = "resolved" in averaged and averaged["resolved"].dims == averaged["cases"].dims  # at one load
    for parameters, point in combinations(averaged):
        words = ", ".join(labels[name].value(parameters[name]) for name in others)
        resolved = not marked or bool(point["resolved"])
        row = float(parameters[along]), *_with_limits(point, quantity), resolved
        series.setdefault(words, []).append(row)
    chosen = labels[along].scale
    places = chosen.factor * np.array([row[0] for rows in series.values() for row in rows])
    wide = places.min() > 0 and places.max() >= _WIDE * places.min()
    if wide:
        axes.set_xscale("log")
    middle = (len(series) - 1) / 2
    step = 0.0 if wide else _APART * float(np.ptp(places))
    attributes = averaged[quantity if quantity in averaged else f"{quantity}_mean"].attrs
    for k, ((label, rows), colour) in enumerate(zip(series.items(), shades(len(series)), strict=True)):
        x, y, low, high, resolved = np.array(sorted(rows)).T
        values = {quantity: y, f"{quantity}_low": low, f"{quantity}_high": high, "resolved": resolved == 1}
        data = {n: (along, v, attributes) for n, v in values.items()}
        fits = xarray.Dataset(data, {along: (along, chosen.factor * x, {"units": chosen.unit})})
        style: dict[str, Any] = {"label": label, "colour": colour, "shift": step * (k - middle)}
        fitted_values(fits, quantity, axes, along=along, resolved=fits["resolved"], **style)
    if step and len(series) > 1:
        axes.set_xlabel(f"{axes.get_xlabel()}; marks of one value stand side by side", fontsize=LABEL)
    axes.set_title(
        "95 % intervals" if f"{quantity}_low" in averaged else "means and their standard errors",
        fontsize=TICK,
    )
    handles, _ = axes.get_legend_handles_labels()
    if not all(row[-1] for rows in series.values() for row in rows):
        handles.append(Line2D([], [], label="not resolved", **hollow_marks("black")))
    if handles:
        title = ", ".join(labels[name].title for name in others)
        # Beside the axes, where it hides no mark.
        axes.legend(
            handles=handles,
            title=title,
            fontsize=TICK,
            title_fontsize=TICK,
            frameon=False,
            loc="upper left",
            bbox_to_anchor=(1, 1),
        )


def _with_limits(point: xarray.Dataset, quantity: str) -> tuple[float, float, float]:
    """Return a number and the ends of its interval: that of the law, or a standard error on either side of a mean."""
    if f"{quantity}_low" in point:
        return tuple(point[name].item() for name in (quantity, f"{quantity}_low", f"{quantity}_high"))
    value, error = (point[f"{quantity}_{word}"].item() for word in ("mean", "standard_error"))
    return value, value - error, value + error
