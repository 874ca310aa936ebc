"""Loading curves, drawn on axes that the caller owns."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from roughcontact.contact.stiffness import CELLS
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.engineering_units import Scale
from roughcontact.plot.points import Column, draw_points
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.plot.theory_lines import draw_laws
from roughcontact.plot.ticks import readable_ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from roughcontact.contact.compare import Law
    from roughcontact.contact.curve import Curve, PowerLaw

__all__ = ["area_curve", "depth_curve", "stiffness_curve"]

Array = npt.NDArray[Any]

_POINTS, _LAW, _LIMIT = "#0072b2", "#d55e00", "0.3"  # blue and vermilion: every eye tells them apart
_ROOM = 1.7  # space beyond the outermost line of a logarithmic axis, as a factor


def stiffness_curve(
    axes: Axes, curve: Curve, law: PowerLaw | None = None, theories: Sequence[Law] = ()
) -> None:
    """Draw stiffness against force, both logarithmic.

    Resolved points are filled, the others open. `law` is drawn strongly over its window and thinly
    beyond. Horizontal lines mark the stiffness of twenty cells (not on a line contact, where widths tell
    what is resolved) and that of all measured cells in contact. The outer axes give force and stiffness
    without dimension. `theories` are drawn as lines in colours of their own.
    """
    x, y = _draw(axes, curve, "stiffness")
    values = curve.stiffness[np.isfinite(curve.stiffness) & (curve.stiffness > 0)]
    limits = _limits(curve)
    levels = [*values, *(level for level, *_ in limits)] or [1.0]
    low, high = min(levels) / _ROOM, max(levels) * _ROOM
    axes.set_ylim(low * y.factor, high * y.factor)
    readable_ticks(axes.yaxis, high / low)
    if law is not None:
        _draw_law(axes, curve, law, (x, y))
    draw_laws(axes, theories, "stiffness", _forces(curve), (x, y))
    beside = axes.get_yaxis_transform()
    for level, place, side, text in limits:
        axes.axhline(level * y.factor, color=_LIMIT, linewidth=0.9, linestyle=(0, (6, 3)), zorder=1)
        axes.text(
            place, level * y.factor, text, transform=beside, ha=side, va="bottom", fontsize=TICK, color=_LIMIT
        )
    if axes.get_legend_handles_labels()[0]:
        # The corner between the curve and its upper limit is the one that stays free.
        top = math.log(curve.full_contact_stiffness / low) / math.log(high / low) if limits[1:] else 1.0
        axes.legend(loc="upper left", bbox_to_anchor=(0.0, top - 0.005), fontsize=TICK, frameon=False)
    _outer(axes, curve, (x, y))


def area_curve(axes: Axes, curve: Curve, theories: Sequence[Law] = ()) -> None:
    """Draw the real contact area against force, both logarithmic; the right axis is relative to the nominal area."""
    x, y = _draw(axes, curve, "contact_area")
    draw_laws(axes, theories, "contact_area", _forces(curve), (x, y))
    right = axes.secondary_yaxis("right", functions=_shares_of(curve.nominal_area * y.factor))
    right.set_ylabel("relative real contact area A/A0", fontsize=LABEL)
    right.tick_params(labelsize=TICK, which="both")


def depth_curve(axes: Axes, curve: Curve, theories: Sequence[Law] = ()) -> None:
    """Draw the indentation depth, since first touch, against force, both logarithmic."""
    draw_laws(axes, theories, "depth", _forces(curve), _draw(axes, curve, "depth"))


def _limits(curve: Curve) -> list[tuple[float, float, Literal["left", "right"], str]]:
    """Return the stiffnesses between which a curve is resolved: level [N/m], place along the axis, side, text."""
    limits: list[tuple[float, float, Literal["left", "right"], str]] = [
        (CELLS * curve.cell_stiffness, 0.985, "right", f"{CELLS} x one cell"),
        (curve.full_contact_stiffness, 0.015, "left", "full contact"),
    ]
    if curve.geometry is Geometry.LINE:  # there it is the width that counts
        limits = limits[1:]
    # A periodic surface in full contact is infinitely stiff: that limit has no line.
    return [limit for limit in limits if math.isfinite(limit[0])]


def _forces(curve: Curve) -> tuple[float, float]:
    """Return the smallest and the largest force that a logarithmic axis can show."""
    loads = curve.force[curve.force > 0]
    return (float(loads.min()), float(loads.max())) if loads.size else (1.0, 1.0)


def _draw(axes: Axes, curve: Curve, name: str) -> tuple[Scale, Scale]:
    """Draw one quantity of the curve against force; return the scales of both axes."""
    force, column = (
        Column(np.asarray(getattr(curve, n)), VARIABLES[n].label, unit_of(n, curve.geometry))
        for n in ("force", name)
    )
    return draw_points(axes, force, column, np.asarray(curve.resolved), _POINTS)


def _draw_law(axes: Axes, curve: Curve, law: PowerLaw, scales: tuple[Scale, Scale]) -> None:
    x, y = scales
    within = np.array(law.window)
    loads = curve.force[curve.force > 0]
    beyond = np.array([min(loads.min(), within[0]), max(loads.max(), within[1])])
    text = rf"$\bar{{k}} = {law.prefactor:.3g}\;\bar{{F}}^{{\;{law.exponent:.3f}}}$"
    axes.plot(beyond * x.factor, law.stiffness(beyond) * y.factor, color=_LAW, linewidth=0.8, zorder=2)
    axes.plot(
        within * x.factor, law.stiffness(within) * y.factor, color=_LAW, linewidth=2, zorder=4, label=text
    )


def _outer(axes: Axes, curve: Curve, scales: tuple[Scale, Scale]) -> None:
    """Put the quantities without dimension on the upper and the right axis."""
    outer = [axes.secondary_yaxis("right", functions=_shares_of(curve.stiffness_scale * scales[1].factor))]
    outer[0].set_ylabel(rf"$\bar{{k}}$ = {VARIABLES['dimensionless_stiffness'].label}", fontsize=LABEL)
    if curve.force_scale > 0:  # a flat surface has no height to compare with
        outer.append(axes.secondary_xaxis("top", functions=_shares_of(curve.force_scale * scales[0].factor)))
        outer[1].set_xlabel(rf"$\bar{{F}}$ = {VARIABLES['dimensionless_force'].label}", fontsize=LABEL)
    for each in outer:
        each.tick_params(labelsize=TICK, which="both")


def _shares_of(unit: float) -> Any:
    """Return the two functions of an axis that counts in `unit`: there and back."""
    return (lambda value: value / unit), (lambda share: share * unit)
