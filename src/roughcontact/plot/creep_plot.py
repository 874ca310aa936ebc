"""A viscoelastic contact in time: area and depth against logarithmic time, and the main numbers in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from roughcontact.errors import InputError
from roughcontact.labels.column import names_of, shown_in
from roughcontact.labels.engineering_units import scale
from roughcontact.labels.flow_columns import FLOW_OF_CURVE
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import label_axes
from roughcontact.plot.facts import quantity, size_of

if TYPE_CHECKING:
    from roughcontact.viscoelastic.time_steps import History
    from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve

__all__ = ["CREEP_COLUMNS", "CREEP_PER_AREA", "creep_curve", "creep_facts"]

_COLOURS = ("#0072b2", "#d55e00")
_OF_FLOW = names_of(shown_in("joint", FLOW_OF_CURVE))
CREEP_COLUMNS = ("time", "force", "depth", "contact_area", "stiffness", "mean_gap", *_OF_FLOW)
CREEP_PER_AREA = ("time", "nominal_pressure", "depth", "contact_fraction", "stiffness", "mean_gap", *_OF_FLOW)
"""The columns of a table of times, under forces or depths and under nominal pressures."""


def creep_curve(
    curve: ViscoelasticCurve,
    ax: Axes | None = None,
    *,
    quantities: tuple[str, str] = ("contact_area", "depth"),
) -> Axes:
    """Draw two quantities against the time since the start, which is logarithmic; marks are the given times.

    Parameters
    ----------
    curve : ViscoelasticCurve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantities : tuple of two str
        Columns of the curve: on the left and on the right axis.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the curve has no such column.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.viscoelastic_curve(ball, rubber, times=[0, 100], forces=[1e-6, 1e-6])
    >>> curve.plot(quantities=("contact_area", "mean_gap")).get_xlabel()
    'time since the start [s]'
    """
    axes = axes_for(ax)
    elapsed = curve.time - curve.time[0]
    later = elapsed > 0
    for place, name, colour in zip((axes, axes.twinx()), quantities, _COLOURS, strict=True):
        if name not in VARIABLES or not isinstance(values := getattr(curve, name, None), np.ndarray):
            raise InputError(
                f"the curve has no column {name!r}", "choose contact_area, depth or force", "quantities"
            )
        unit = scale(float(np.abs(values).max(initial=0.0)), unit_of(name, curve.geometry))
        place.plot(elapsed[later], values[later] * unit.factor, color=colour, linewidth=1.1)
        marks = later & curve.prescribed
        place.plot(elapsed[marks], values[marks] * unit.factor, "o", color=colour, markersize=3.5)
        label_axes(
            place, "time since the start [s]", f"{VARIABLES[name].label} [{unit.unit}]", grid=place is axes
        )
        place.yaxis.label.set_color(colour)
    axes.set_xscale("log")
    return axes


def creep_facts(curve: ViscoelasticCurve, history: History) -> list[tuple[str, str]]:
    """Return the main numbers of a history as a whole, line by line."""
    problem, material, kind = history.contact.problem, history.contact.material, curve.geometry
    met = "met" if all(status.converged for status in curve.status) else "MISSED"
    error, leak = curve.time_error[-1], np.abs(curve.energy_leak).max()
    largest = (curve.stored_energy + curve.dissipated_energy).max()
    moduli = [quantity("modulus", modulus) for modulus in (material.instantaneous, material.equilibrium)]
    sudden = "infinite at once (a dashpot)" if material.dashpot else f"{moduli[0]} at once"
    work, stored, lost = (
        quantity(name, float(getattr(curve, name)[-1]), kind)
        for name in ("work", "stored_energy", "dissipated_energy")
    )
    return [
        ("surface", size_of(problem.grid)),
        (
            "reduced modulus",
            f"{sudden}, {moduli[1]} after a long time; {len(material.times)} relaxation times",
        ),
        ("states", f"{len(curve)}, of which {curve.prescribed.sum()} are at given times"),
        ("largest certificate", f"{curve.residual.max():.1e} (tolerance {problem.tolerance:.0e}: {met})"),
        ("largest residual of time", f"{curve.time_residual.max():.1e}"),
        ("error of time", "not estimated for fixed steps" if np.isnan(error) else f"{error:.1e}, estimated"),
        ("energy at the end", f"work {work}, stored {stored}, dissipated {lost}"),
        ("energy balance", f"{leak / largest if largest else 0.0:.1e} of the largest energy"),
    ]
