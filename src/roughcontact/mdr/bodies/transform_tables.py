"""Bodies known as functions or as samples: their transforms as tables."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from roughcontact.errors import InputError, about
from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.mdr.bodies.chebyshev import FINEST, Function, Panels, fit, interpolate
from roughcontact.mdr.bodies.terms import TableTerm
from roughcontact.mdr.bodies.transform import FUNCTION, height_of, transform_of
from roughcontact.validation import Array, number, require, scalar, shown

__all__ = ["from_function", "from_samples", "from_two_functions"]

NOISE = 1e-14  # of the largest value: a decrease of the transform below this is rounding
FALL = 1e-9  # likewise, of the value from which it decreases


def from_function(function: Function, radius: float, *, transformed: bool) -> Profile:
    """Return the body whose height, or whose transform, is a function of the radius."""
    scalar(radius, "radius")
    if not (np.isfinite(radius) and radius > 0):
        raise InputError(
            f"the radius of the body must be above 0 [m], not {radius}",
            "give a positive radius",
            place="radius",
        )
    if not callable(function):
        raise InputError(
            f"a function of the radius is needed, not {shown(function)}: for samples use sampled",
            place="function",
        )
    try:
        # Two radii, because a function of single numbers may accept an array with one.
        start = float(np.asarray(function(np.zeros(2)), dtype=np.float64).ravel()[0])
    except (TypeError, ValueError) as error:
        raise about(
            "the function",
            f"must accept an array of radii, like np.cosh and unlike math.cosh, but: {error}",
        ) from error
    require(
        np.isfinite(start),
        f"the function must be finite at its apex, not {start} at radius 0",
        place="function",
    )
    return _profile(fit(lambda x: function(x) - start, radius, tolerance=FUNCTION), transformed)


def from_samples(places: Array, values: Array, *, sharp: bool, transformed: bool) -> Profile:
    """Return the body whose height, or whose transform, is a cubic spline through samples."""
    x, y = np.asarray(number(places, "places")), np.asarray(number(values, "values"))
    if x.ndim != 1 or x.shape != y.shape or len(x) < 4:
        raise InputError(
            f"at least four radii and one height for each are needed, not {x.shape} and {y.shape}"
        )
    if not (np.isfinite(x).all() and np.isfinite(y).all()):
        raise InputError("the samples of a profile must be finite", "omit points that were not measured")
    if x[0] != 0 or (np.diff(x) <= 0).any():
        raise InputError(f"the radii must increase strictly from 0 on, not from {x[0]:g}")
    spline = CubicSpline(x, y - y[0], bc_type=("not-a-knot" if sharp else (1, np.zeros(())), "not-a-knot"))
    return _profile(interpolate(spline, x, 4), transformed)


def from_two_functions(
    height: Function, transform: Function, radius: float, breaks: tuple[float, ...], *, noise: float = 0.0
) -> Profile:
    """Return the body whose height and transform are both known functions, to a relative `noise`, of the radius."""
    f, g = (fit(function, radius, tolerance=max(FUNCTION, noise)) for function in (height, transform))
    return _tabled(f, g, _flat(f), breaks)


def _profile(given: Panels, transformed: bool) -> Profile:
    height, transform = (height_of(given), given) if transformed else (given, transform_of(given))
    return _tabled(height, transform, _flat(given), _kinks(given))


def _tabled(height: Panels, transform: Panels, flat: float, breaks: tuple[float, ...]) -> Profile:
    rises = _rises(transform)
    term = TableTerm(height, transform, transform.derivative(), transform.primitive(), flat, breaks, rises)
    return Profile(((1.0, term),), float(transform.edges[-1]), rises=rises)


def _rises(transform: Panels) -> bool:
    """Return whether the transform never decreases, except by rounding."""
    share = np.arange(6) / 6
    x = (transform.edges[:-1, None] + np.diff(transform.edges)[:, None] * share).ravel()
    values = transform(np.append(x, transform.edges[-1]))
    highest = np.maximum.accumulate(np.maximum(values, 0))
    return bool((highest - values <= FALL * highest + NOISE * np.abs(values).max()).all())


def _flat(given: Panels) -> float:
    """Return the radius up to which the function vanishes."""
    size = np.abs(given.coefficients).sum(axis=1)
    above = np.nonzero(size > NOISE * size.max())[0]
    require(len(above) > 0, "the profile is flat", "for a flat face use flat_punch")
    # Panels that shrink towards zero have a smallest one, and a power of r is not a flat face.
    first = float(given.edges[above[0]])
    return first if size[: above[0]].max(initial=0.0) == 0 else 0.0


def _kinks(given: Panels) -> tuple[float, ...]:
    """Return the positions, except zero, at which the panels have the smallest size."""
    end, width = given.edges[-1], np.diff(given.edges)
    finest = (width <= 2 * FINEST * end) & (given.edges[:-1] > 4 * FINEST * end)
    first = finest & ~np.append(False, finest[:-1])
    return tuple(given.edges[:-1][first].tolist())
