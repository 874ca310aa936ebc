"""Removal of the tilt or the form of a surface, which leaves its roughness."""

from __future__ import annotations

from typing import Literal

from roughcontact.errors import about
from roughcontact.surface.in_memory import on_host_only, on_host_or_in_slabs
from roughcontact.surface.preparation.form import round_form
from roughcontact.surface.preparation.polynomial import polynomial_trend
from roughcontact.surface.surface import Surface
from roughcontact.validation import require

__all__ = ["levelled", "without_form"]

# The degree of the polynomial that is removed, and its name in the provenance.
_TRENDS = {
    "mean": (0, "mean height removed"),
    "plane": (1, "tilt removed by a least-squares plane"),
    "quadratic": (2, "least-squares quadratic removed"),
}


@on_host_or_in_slabs
def levelled(surface: Surface, kind: Literal["mean", "plane", "quadratic", "auto"] = "plane") -> Surface:
    """Return the surface without its mean height, its tilt or its curvature, by least squares.

    Missing points are ignored and stay missing.

    Parameters
    ----------
    surface : Surface
    kind : {"plane", "mean", "quadratic", "auto"}
        The trend to remove: the least-squares plane, and with it the tilt; only the mean height; or the least-squares
        polynomial of the second degree. On a line these are a straight line, the mean and a parabola. ``"auto"`` is
        the mean for a surface that is periodic in every direction, which has no tilt, and otherwise the plane.

    Returns
    -------
    Surface
        The surface with one more line of provenance.

    Raises
    ------
    ValueError
        If `kind` is none of these.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> tilted = rough.with_heights(rough.heights + 0.01 * grid.coordinates[1], "tilted by 0.01 along x")
    >>> f"rms {tilted.rms * 1e9:.0f} nm, {tilted.levelled().rms * 1e9:.0f} nm without the tilt"
    'rms 191 nm, 94 nm without the tilt'
    """
    if kind == "auto":
        kind = "mean" if all(surface.grid.periodic) else "plane"
    known = "'mean', 'plane', 'quadratic' or 'auto'"
    require(kind in _TRENDS, f"levelling must be {known}, not {kind!r}", place="kind")
    degree, line = _TRENDS[kind]
    return surface.with_heights(surface.heights - polynomial_trend(surface.heights, degree), line)


@on_host_only
def without_form(surface: Surface, form: int | Literal["sphere", "cylinder"]) -> Surface:
    """Return the surface without the form that fits it best, by least squares of the heights.

    Parameters
    ----------
    surface : Surface
    form : int or {"sphere", "cylinder"}
        Total degree of a polynomial, up to 12; or a sphere; or a cylinder that lies in any direction and may be
        tilted along it. On a line both are an arc of a circle.

    Returns
    -------
    Surface
        The surface less its form, which the provenance describes.

    Raises
    ------
    ValueError
        If the form is none of these, or the fit of a sphere or cylinder does not converge.

    Notes
    -----
    Differences of heights are minimised, not distances normal to the form: for caps much flatter than half a
    sphere the two agree.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> rough = rc.self_affine(grid, hurst=0.8, rms=1e-8, rng=np.random.default_rng(1))
    >>> lens = rough + rc.shapes.sphere(grid, radius=1e-3)
    >>> f"rms {lens.rms * 1e9:.0f} nm, {lens.without_form('sphere').rms * 1e9:.0f} nm without the sphere"
    'rms 217 nm, 9 nm without the sphere'
    """
    if isinstance(form, str):
        trend, words = round_form(surface.heights, surface.grid.spacing, form)
    elif isinstance(form, int) and not isinstance(form, bool) and 0 <= form <= 12:
        trend, words = polynomial_trend(surface.heights, form), f"polynomial of degree {form}"
    else:
        raise about("form", f"must be a degree from 0 to 12, 'sphere' or 'cylinder', not {form!r}")
    return surface.with_heights(surface.heights - trend, f"form removed: {words}")
