"""Level a surface, or take out its form: what remains is what is called rough."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

from roughcontact.surface.form import round_form
from roughcontact.surface.polynomial import polynomial_trend

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["levelled", "without_form"]

_DEGREES = {"mean": 0, "plane": 1, "quadratic": 2}


def levelled(surface: Surface, kind: Literal["mean", "plane", "quadratic"] = "plane") -> Surface:
    """Return the surface less its mean height, its least-squares plane or its least-squares quadratic.

    On a line the plane is a straight line and the quadratic a parabola. Missing points are ignored and stay.
    """
    if kind not in _DEGREES:
        raise ValueError(f"levelling must be 'mean', 'plane' or 'quadratic', not {kind!r}")
    heights = surface.heights - polynomial_trend(surface.heights, _DEGREES[kind])
    return replace(
        surface, heights=heights, provenance=(*surface.provenance, f"least-squares {kind} removed")
    )


def without_form(surface: Surface, form: int | Literal["sphere", "cylinder"]) -> Surface:
    """Return the surface less the form that fits it best, by least squares of the heights.

    Parameters
    ----------
    surface : Surface
    form : int or {"sphere", "cylinder"}
        Total degree of a polynomial, up to 12; or a sphere; or a cylinder that lies in any direction and may be
        tilted along it. On a line both are an arc of a circle.

    Raises
    ------
    ValueError
        If the form is none of these, or the fit of a sphere or cylinder does not converge.

    Notes
    -----
    Differences of heights are made small, not distances normal to the form: for caps much flatter than half a
    sphere the two agree.
    """
    if isinstance(form, str):
        trend, words = round_form(surface.heights, surface.grid.spacing, form)
    elif isinstance(form, int) and not isinstance(form, bool) and 0 <= form <= 12:
        trend, words = polynomial_trend(surface.heights, form), f"polynomial of degree {form}"
    else:
        raise ValueError(f"form must be a degree from 0 to 12, 'sphere' or 'cylinder', not {form!r}")
    return replace(
        surface, heights=surface.heights - trend, provenance=(*surface.provenance, f"form removed: {words}")
    )
