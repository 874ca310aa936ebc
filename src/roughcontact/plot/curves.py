"""Pictures of loading curves with theories.

All axes are logarithmic, with force or nominal pressure along x. Resolved points are filled, the others open.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import Any

import numpy as np
import numpy.typing as npt
import xarray
from matplotlib.axes import Axes

from roughcontact.contact.compare import Law
from roughcontact.contact.curve import Curve
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.engineering_units import Scale, pretty, scale
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.error_bars import Errors, error_bars
from roughcontact.plot.drawing.level import free_place, level
from roughcontact.plot.drawing.ticks import TICK, label_axes, outer_axis, readable_ticks
from roughcontact.statistics.fit_window import CELLS
from roughcontact.statistics.power_law import PowerLaw
from roughcontact.validation import Array, numeric, require

__all__ = [
    "OF_FORCE",
    "PER_AREA",
    *("areal_curve", "draw_points", "force_curve", "resistance_curve"),
]

_POINTS, _LAW = "#0072b2", "#d55e00"  # blue and vermilion: distinct also for colour-blind readers
_RESISTANCES = {"electrical_resistance": _POINTS, "thermal_resistance": _LAW}
# Colours that are distinct from the points and from each other for every reader, and dashes for readers without colour
# vision. Five colours and four dashes give twenty different lines.
_LAWS = ("#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c564b")
_DASHES = ("-", (0, (5, 1.5)), (0, (3, 1.5, 1, 1.5)), (0, (1, 1)))
OF_FORCE = ("stiffness", "contact_area", "depth")  # quantities against force
# Quantities against nominal pressure, and the quantity of the patch for which theories have functions.
PER_AREA = {
    "interfacial_stiffness_per_area": "interfacial_stiffness",
    "contact_fraction": "contact_area",
    "mean_gap": "mean_gap",
}
_SMOOTH = 200  # points of a line
_FULL = "full contact"
_ROOM = 1.7  # factor of space beyond the outermost line of a logarithmic axis


@numeric
def force_curve(
    curve: Curve,
    ax: Axes | None = None,
    *,
    quantity: str = "stiffness",
    law: PowerLaw | None = None,
    theories: Sequence[Law] = (),
    errors: Errors | None = None,
) -> Axes:
    """Draw the stiffness, the real contact area or the depth against force, both logarithmic.

    Resolved points are filled, the others open. With the stiffness, horizontal lines mark that of twenty cells (except
    on a line contact, which is resolved by its width) and that of all measured cells in contact, and the outer axes
    show force and stiffness without dimension. With the area, the right axis shows the relative area. The depth counts
    from first touch.

    Parameters
    ----------
    curve : Curve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantity : {"stiffness", "contact_area", "depth"}
    law : PowerLaw, optional
        A law of the stiffness, such as ``curve.fit()``: a strong line over its window and a thin line beyond.
    theories : sequence of Law, optional
        Theories to draw, such as those of `roughcontact.loading_laws`; each has its colour.
    errors : mapping of float to ErrorBudget, optional
        Errors by force [N], drawn as bars.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the quantity is unknown, or a law is given with a quantity other than a stiffness.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e9, forces=np.geomspace(1e-2, 1e-1, 9))
    >>> axes = rc.plot.force_curve(curve, law=curve.fit())
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('force [mN]', 'stiffness [kN/m]')
    >>> laws = [rc.theory.hertz.law(radius=1e-4, modulus=1e9)]
    >>> [rc.plot.force_curve(curve, quantity=each, theories=laws).get_ylabel() for each in ("contact_area", "depth")]
    ['contact area [µm²]', 'depth [µm]']
    """
    require(
        quantity in OF_FORCE,
        f"quantity must be one of {', '.join(OF_FORCE)}, not {quantity!r}",
        place="quantity",
    )
    stiffness = quantity == "stiffness"
    require(
        stiffness or law is None,
        "law applies only to the stiffness",
        f"leave it out with {quantity!r}",
        place="law",
    )
    axes = axes_for(ax)
    _, y = scales = _draw(axes, curve, quantity)
    limits = _limits(curve) if stiffness else {}
    if stiffness:
        levels = [
            *curve.stiffness[np.isfinite(curve.stiffness) & (curve.stiffness > 0)],
            *limits.values(),
        ] or [1.0]
        low, high = min(levels) / _ROOM, max(levels) * _ROOM
        axes.set_ylim(low * y.factor, high * y.factor)
        readable_ticks(axes.yaxis, high / low)
    if law is not None:
        _draw_law(axes, curve, law, scales)
    _draw_laws(axes, theories, quantity, _forces(curve), scales)
    error_bars(axes, errors or {}, quantity, scales)
    for words, value in limits.items():
        place = free_place(axes, value * y.factor, ("left", "bottom") if words == _FULL else None)
        level(axes, value * y.factor, words, (0, (6, 3)), **place)
    if stiffness:
        if axes.get_legend_handles_labels()[0]:
            # The corner between the curve and its upper limit stays free, except for theories.
            top = math.log(limits[_FULL] / low) / math.log(high / low) if _FULL in limits else 1.0
            corner: Any = {"loc": "upper left", "bbox_to_anchor": (0.0, top - 0.005)}
            axes.legend(**({"loc": "best"} if theories else corner), fontsize=TICK, frameon=False)
        _outer(axes, curve, scales)
    elif quantity == "contact_area":
        parts = _parts_of(curve.nominal_area * y.factor)
        outer_axis(axes, "right", "relative real contact area A/A0", parts)
    return axes


@numeric
def areal_curve(
    curve: Curve,
    ax: Axes | None = None,
    *,
    quantity: str = "interfacial_stiffness_per_area",
    law: PowerLaw | None = None,
    theories: Sequence[Law] = (),
    units: Mapping[str, Scale] | None = None,
    errors: Errors | None = None,
) -> Axes:
    """Draw K/A0, A/A0 or the mean gap, which do not depend on the size of a joint, against nominal pressure.

    Parameters
    ----------
    curve : Curve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantity : {"interfacial_stiffness_per_area", "contact_fraction", "mean_gap"}
    law : PowerLaw, optional
        A law of k. The law and the limits of resolved points are drawn with K/A0 only on a periodic grid, where k = K.
    theories : sequence of Law, optional
        Theories to draw, such as those of `roughcontact.loading_laws`.
    units : mapping of str to Scale, optional
        Units of the axes, by ``"nominal_pressure"`` and the quantity.
    errors : mapping of float to ErrorBudget, optional
        Errors by force [N], drawn as bars.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the quantity is unknown.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e6, 1e7, 6))
    >>> bar = rc.plot.Scale(1e-5, "bar")
    >>> axes = rc.plot.areal_curve(curve, quantity="mean_gap", units={"nominal_pressure": bar})
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('nominal pressure [bar]', 'mean gap [nm]')
    """
    require(
        quantity in PER_AREA,
        f"quantity must be one of {', '.join(PER_AREA)}, not {quantity!r}",
        place="quantity",
    )
    axes = axes_for(ax)
    of_theory = PER_AREA[quantity]
    words = [
        (VARIABLES[each].label, unit_of(each, curve.geometry)) for each in ("nominal_pressure", quantity)
    ]
    numbers = (curve.nominal_pressure, np.asarray(getattr(curve, quantity)))
    given = tuple((units or {}).get(each) for each in ("nominal_pressure", quantity))
    x, y = draw_points(axes, numbers, words, np.asarray(curve.resolved), _POINTS, given)
    # From values of the patch to those of the picture: per nominal area, except for the gap.
    of_force = Scale(x.factor / curve.nominal_area, x.unit)
    of_patch = y if of_theory == quantity else Scale(y.factor / curve.nominal_area, y.unit)
    low, high = axes.get_ylim()
    is_of_k = quantity == "interfacial_stiffness_per_area" and np.array_equal(
        curve.stiffness, curve.interfacial_stiffness
    )
    if law is not None and is_of_k:
        _draw_law(axes, curve, law, (of_force, of_patch))
    axes.set_ylim(low, high)
    _draw_laws(axes, theories, of_theory, _forces(curve), (of_force, of_patch))
    error_bars(axes, errors or {}, quantity, (of_force, y))
    for text, value in _limits(curve).items() if is_of_k else ():
        place = value * of_patch.factor
        if low <= place <= high:
            level(axes, place, text, (0, (6, 3)), **free_place(axes, place))
    return axes


def resistance_curve(dataset: xarray.Dataset, name: str, ax: Axes | None = None) -> Axes:
    """Draw one resistance against force, or one per area against pressure; infinite values are left out.

    Parameters
    ----------
    dataset : Dataset
        The result of `roughcontact.conductance` for the dataset of a curve.
    name : str
        Name of the resistance in it, such as ``"electrical_resistance_per_area"``.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e6, 1e7, 6))
    >>> heat = rc.conductance(curve.to_dataset(), conductivities=(50.0, 200.0))
    >>> rc.plot.resistance_curve(heat, "thermal_resistance_per_area").get_ylabel()
    'thermal resistance per area [mm²·K/W]'
    """
    axes = axes_for(ax)
    load = "nominal_pressure" if name.endswith("_per_area") else "force"
    numbers = (dataset[load].to_numpy(), dataset[name].to_numpy())
    included = "" if load == "nominal_pressure" else ", spreading resistance included"
    labels = {load: VARIABLES[load].label, name: name.replace("_", " ") + included}
    words = [(label, dataset[each].attrs["units"]) for each, label in labels.items()]
    given = tuple(
        None if unit == VARIABLES[each].unit else Scale(1.0, unit)
        for each, (_, unit) in zip(labels, words, strict=True)
    )
    colour = _RESISTANCES[name.removesuffix("_per_area")]
    draw_points(axes, numbers, words, dataset["resolved"].to_numpy().astype(bool), colour, given)
    if axes.lines:
        axes.legend(fontsize=TICK, frameon=False)
    return axes


def _limits(curve: Curve) -> dict[str, float]:
    """Return the stiffnesses [N/m] between which a curve is resolved, by their names."""
    limits = {_FULL: curve.full_contact_stiffness}
    if curve.geometry is not Geometry.LINE:  # a line is resolved by its width
        limits = {f"{CELLS} x one cell": CELLS * curve.cell_stiffness} | limits
    # A periodic surface in full contact is infinitely stiff, so this limit has no line.
    return {words: value for words, value in limits.items() if math.isfinite(value)}


def _forces(curve: Curve) -> tuple[float, float]:
    """Return the smallest and the largest force that a logarithmic axis can show."""
    loads = curve.force[curve.force > 0]
    return (float(loads.min()), float(loads.max())) if loads.size else (1.0, 1.0)


def _draw(axes: Axes, curve: Curve, name: str) -> tuple[Scale, Scale]:
    """Draw one quantity of the curve against force; return the scales of both axes."""
    force, values = (np.asarray(getattr(curve, n)) for n in ("force", name))
    words = [(VARIABLES[n].label, unit_of(n, curve.geometry)) for n in ("force", name)]
    return draw_points(axes, (force, values), words, np.asarray(curve.resolved), _POINTS)


def draw_points(
    axes: Axes,
    numbers: tuple[Array, Array],
    words: Sequence[tuple[str, str]],
    resolved: npt.NDArray[np.bool_],
    colour: str,
    units: tuple[Scale | None, ...] = (None, None),
) -> tuple[Scale, Scale]:
    """Draw values against loads and label both axes by names and units, by default SI; return their scales.

    Zero and infinite values are left out, because the axes are logarithmic.
    """
    loads, values = numbers
    x, y = (
        Scale(given.factor, pretty(given.unit))
        if given
        else scale(float(np.max(each, initial=0.0, where=np.isfinite(each))), unit)
        for each, (_, unit), given in zip(numbers, words, units, strict=True)
    )
    axes.set(xscale="log", yscale="log")
    shown = np.isfinite(values) & (values > 0) & (loads > 0)
    size = 4.5 if loads.size <= 60 else 3.0
    for chosen, fill, text in ((resolved, colour, "resolved"), (~resolved, "white", "not resolved")):
        points = shown & chosen
        style: Any = {"markersize": size, "color": colour, "markerfacecolor": fill, "zorder": 3}
        if points.any():
            axes.plot(loads[points] * x.factor, values[points] * y.factor, "o", label=text, **style)
    for axis, drawn in ((axes.xaxis, loads[shown]), (axes.yaxis, values[shown])):
        if drawn.size:
            readable_ticks(axis, float(drawn.max() / drawn.min()))
    (force, _), (name, _) = words
    labels = (f"{text} [{each.unit}]" if each.unit else text for text, each in ((force, x), (name, y)))
    label_axes(axes, *labels, grid=True)
    return x, y


def _draw_laws(
    axes: Axes, laws: Sequence[Law], quantity: str, forces: tuple[float, float], scales: tuple[Scale, Scale]
) -> None:
    """Draw the prediction of each theory for a quantity between two `forces` [N].

    A theory has the same style in all pictures, even if it does not have every quantity. The axes keep the limits of
    the computed points.
    """
    x, y = scales
    force = np.geomspace(*forces, _SMOOTH)
    limits = axes.get_ylim()
    for law, colour, dashes in zip(laws, cycle(_LAWS), cycle(_DASHES), strict=False):
        if quantity not in law.quantities:
            continue
        values = law.predict(quantity, force)
        shown = np.isfinite(values) & (values > 0)
        style: Any = {"color": colour, "linestyle": dashes, "linewidth": 1.4, "zorder": 2.5}
        axes.plot(force[shown] * x.factor, values[shown] * y.factor, label=law.name, **style)
    axes.set_ylim(limits)


def _draw_law(axes: Axes, curve: Curve, law: PowerLaw, scales: tuple[Scale, Scale]) -> None:
    x, y = scales
    within = np.array(law.window)
    loads = np.append(_forces(curve), within)
    beyond = np.array([loads.min(), loads.max()])
    text = rf"$\bar{{k}} = {law.prefactor:.3g}\;\bar{{F}}^{{\;{law.exponent:.3f}}}$"
    for force, width, order, name in ((beyond, 0.8, 2, None), (within, 2, 4, text)):
        stiffness = law.stiffness(force) * y.factor
        axes.plot(force * x.factor, stiffness, color=_LAW, linewidth=width, zorder=order, label=name)


def _outer(axes: Axes, curve: Curve, scales: tuple[Scale, Scale]) -> None:
    """Put the quantities without dimension on the upper and the right axis."""
    name = rf"$\bar{{k}}$ = {_without_length('dimensionless_stiffness', curve)}"
    outer_axis(axes, "right", name, _parts_of(curve.stiffness_scale * scales[1].factor))
    if curve.force_scale > 0:  # a flat surface has no height to compare with
        name = rf"$\bar{{F}}$ = {_without_length('dimensionless_force', curve)}"
        outer_axis(axes, "top", name, _parts_of(curve.force_scale * scales[0].factor))


def _without_length(name: str, curve: Curve) -> str:
    """Return the formula of a dimensionless quantity: on a line, where loads are per length, without L."""
    label = VARIABLES[name].label
    return label.replace("E* L", "E*").replace("(E*)", "E*") if curve.geometry is Geometry.LINE else label


def _parts_of(unit: float) -> Any:
    """Return the two functions of an axis in multiples of `unit`: forward and inverse."""
    return (lambda value: value / unit), (lambda part: part * unit)
