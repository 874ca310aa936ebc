"""The sphere or the cylinder that fits the measured heights best."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from roughcontact.errors import InputError
from roughcontact.validation import Array

__all__ = ["round_form"]


# Points used in the fit: enough for five numbers.
_POINTS = 40_000
_STEP = 1e-6  # of central differences: their error is about 1e-10 for numbers of order one


def round_form(heights: Array, spacing: tuple[float, ...], kind: str) -> tuple[Array, str]:
    """Return the heights [m] of the fitted sphere or cylinder on the grid, and its description.

    The circle passes through a height at the centre of the map, with a slope and a signed curvature 1/R there: it
    passes smoothly through a plane at zero curvature, and its centre may lie anywhere.
    """
    from scipy.optimize import least_squares

    if kind not in ("sphere", "cylinder"):
        raise InputError(
            f"form must be a degree from 0 to 12, 'sphere' or 'cylinder', not {kind!r}", place="kind"
        )
    axes = [(np.arange(n) - (n - 1) / 2) * step for n, step in zip(heights.shape, spacing, strict=True)]
    scale = max(float(np.abs(axis).max()) for axis in axes)
    if heights.ndim == 1:
        axes = [np.zeros(1), *axes]
    y, x = np.broadcast_arrays(axes[0][:, None] / scale, axes[1] / scale)
    z = heights.reshape(y.shape) / scale
    places = np.flatnonzero(~np.isnan(z))
    chosen = places[:: max(1, places.size // _POINTS)]
    px, py, pz = (values.reshape(-1)[chosen] for values in (x, y, z))

    model: Callable[[Array, Array, Array], Array]
    if heights.ndim == 1 or kind == "sphere":
        model, fixed = _sphere, heights.ndim == 1
    else:
        model, fixed = _cylinder, False
    start = _start(px, py, pz, model)
    free = np.array([True, True, True, not fixed] + [True] * (len(start) - 4))

    def with_free(values: Array) -> Array:
        whole = start.copy()
        whole[free] = values
        return whole

    def misfit(values: Array) -> Array:
        return model(with_free(values), px, py) - pz

    def derivatives(values: Array) -> Array:
        # All parameters are of order one, and some are zero: the step is the same for each. Older versions of SciPy
        # use a
        # step relative to the value, which gives only rounding for values near zero.
        columns = [misfit(values + step) - misfit(values - step) for step in _STEP * np.eye(values.size)]
        return np.stack(columns, axis=1) / (2 * _STEP)

    fit = least_squares(misfit, start[free], derivatives, method="lm", xtol=1e-12, ftol=1e-12, gtol=1e-12)
    parameters = with_free(fit.x)
    trend = model(parameters, x, y) * scale
    if fit.status < 1 or not np.isfinite(trend).all():
        raise InputError(f"no {kind} fits these heights: {fit.message}", "remove a polynomial instead")
    curvature = parameters[1] / scale
    radius = "infinite radius" if curvature == 0 else f"radius {1 / abs(curvature):.6g} m"
    words = f"{kind} of {radius}, {'concave' if curvature > 0 else 'convex'}"
    return trend.reshape(heights.shape), words


def _arc(curvature: float, slope: Array, square: Array, steepness: float) -> Array:
    """Return the height over a point of the circle: linear part `slope`, squared distance, from that point."""
    level = 1 / math.sqrt(1 + steepness)  # the vertical part of the normal
    c = curvature / 2 * square + level * slope
    # Beyond the equator there is no height: a trial is limited to it.
    return np.asarray(2 * c / (level + np.sqrt(np.maximum(level**2 - 2 * curvature * c, 0))))


def _sphere(p: Array, x: Array, y: Array) -> Array:
    """Height, curvature, slopes along x and y, all at the centre of the map."""
    return np.asarray(p[0] + _arc(p[1], p[2] * x + p[3] * y, x**2 + y**2, p[2] ** 2 + p[3] ** 2))


def _cylinder(p: Array, x: Array, y: Array) -> Array:
    """Height, curvature, slope across, direction across, slope along."""
    across = x * np.cos(p[3]) + y * np.sin(p[3])
    along = y * np.cos(p[3]) - x * np.sin(p[3])
    return np.asarray(p[0] + _arc(p[1], p[2] * across, across**2, p[2] ** 2) + p[4] * along)


def _start(x: Array, y: Array, z: Array, model: Callable[[Array, Array, Array], Array]) -> Array:
    """Return first parameters from the quadratic through the points."""
    terms = np.stack([np.ones_like(x), x, y, x**2 / 2, x * y, y**2 / 2], axis=1)
    c, gx, gy, hxx, hxy, hyy = np.linalg.lstsq(terms, z, rcond=None)[0]
    if model is _sphere:
        curvature = (hxx + hyy) / 2 if np.ptp(y) > 0 else hxx
        return np.array([c, np.clip(curvature, -0.3, 0.3), gx, gy])
    values, vectors = np.linalg.eigh(np.array([[hxx, hxy], [hxy, hyy]]))
    bent = int(np.argmax(np.abs(values)))
    nx, ny = vectors[:, bent]
    curvature = np.clip(values[bent], -0.3, 0.3)
    return np.array([c, curvature, gx * nx + gy * ny, math.atan2(ny, nx), gy * nx - gx * ny])
