"""The factor of the line's spectrum that gives it the stiffness of the surface (thesis, eq. 4.75 and fig. 29)."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.mdr.lines.lattice_sums import lambda_rms
from roughcontact.validation import Array, moderate, number, positive_scalar, scalar

__all__ = ["calibrated_lambda", "force_ratio", "matched_lambda"]

ROUNDING = 1e-9  # a point on the edge of the window belongs to it, whatever its last digit


def calibrated_lambda(
    hurst: float, *, line_prefactor: float, surface_prefactor: float, modes: int | None = None
) -> float:
    """Return lambda of C1D = lambda q C2D for which line and surface follow one power law (thesis, eq. 4.75).

    ``lambda = lambda_rms (zeta_line / zeta_surface)^(2/alpha)``, alpha = 1/(H + 1), from H = 2 on 1/3, with the
    prefactors zeta of ``k/(E* L) = zeta (F/(E* h L))^alpha``, each with the rms height h of its own line or
    surface. A line of this spectrum is used as it is, and not brought to the rms height of the surface.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, at least 0: below, stiffness is no power law of force.
    line_prefactor, surface_prefactor : float
        zeta of lines and of surfaces, with this alpha on both sides.
    modes : int, optional
        See `lambda_rms`.

    Returns
    -------
    float
        lambda [-].

    Raises
    ------
    ValueError
        If H is out of range, or a prefactor is not positive.

    Notes
    -----
    Prefactors enter with the power 2/alpha: 5 % in one of them are 20 % in lambda at H = 1. A fit that is free to
    choose alpha, or that uses another window, has another prefactor: take `matched_lambda` of measured curves.
    For a single wave (H to infinity) the prefactors are ``(3/(sqrt(2) pi^2))^(1/3)`` and ``(6/(4 pi^2))^(1/3)``, and
    lambda is 4: the line's crest has half the radius of the surface's, as in the contact of a sphere.

    Examples
    --------
    >>> from roughcontact_thesis import calibration
    >>> equal = calibration.calibrated_lambda(1.0, line_prefactor=0.85, surface_prefactor=0.85)
    >>> round(equal, 4)  # of equal prefactors lambda_rms
    2.5069
    """
    scalar(hurst, "Hurst exponent")
    if not (math.isfinite(hurst) and hurst >= 0):
        raise about(
            "hurst", f"must be finite and at least 0, where stiffness is a power of force, not {hurst}"
        )
    for name, value in (("line_prefactor", line_prefactor), ("surface_prefactor", surface_prefactor)):
        moderate(positive_scalar(value, name), name)
    steepness = 2 * min(hurst + 1, 3)
    return lambda_rms(hurst, modes) * math.pow(line_prefactor / surface_prefactor, steepness)


def matched_lambda(
    hurst: float,
    line: tuple[Array, Array],
    surface: tuple[Array, Array],
    *,
    window: tuple[float, float],
    modes: int | None = None,
) -> float:
    """Return lambda of C1D = lambda q C2D for which line and surface are equally stiff in a window (thesis, fig. 29).

    ``lambda = lambda_rms ratio^2`` with the `force_ratio` of both: a line that is higher by this ratio takes its
    forces times the ratio. Neither curve has to be a power law.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, at least -1.
    line, surface : tuple of array
        See `force_ratio`.
    window : tuple of float
        See `force_ratio`.
    modes : int, optional
        See `lambda_rms`: of the grid on which line and surface have this spectrum.

    Returns
    -------
    float
        lambda [-].

    Raises
    ------
    ValueError
        As `force_ratio` and `lambda_rms` do.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import lattice_sums
    >>> from roughcontact_thesis import calibration
    >>> force = np.geomspace(1e-3, 1e-1, 9)
    >>> curve = (force, 0.85 * force**0.5)
    >>> matched = calibration.matched_lambda(1.0, curve, curve, window=(0.03, 0.2))
    >>> round(matched / lattice_sums.lambda_rms(1.0), 6)  # curves that agree ask for no correction
    1.0
    """
    return lambda_rms(hurst, modes) * force_ratio(line, surface, window) ** 2


def force_ratio(
    line: tuple[Array, Array], surface: tuple[Array, Array], window: tuple[float, float]
) -> float:
    """Return what force a surface takes over that of a line of the same rms height at one stiffness.

    Parameters
    ----------
    line, surface : tuple of array
        Forces F/(E* h L) and stiffnesses k/(E* L) of an ensemble, each with its own h, at rising forces. Between
        two points the curve is a power law; points that are no stiffer than one before them are left out.
    window : tuple of float
        Lowest and highest stiffness k/(E* L): one window for both, inside which both are resolved.

    Returns
    -------
    float
        The geometric mean of the ratio over the window, every ratio of stiffnesses counting alike.

    Raises
    ------
    ValueError
        If forces do not rise, or a curve does not reach all over the window.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact_thesis import calibration
    >>> force = np.geomspace(1e-3, 1e-1, 9)
    >>> ratio = calibration.force_ratio((force, force**0.5), (2 * force, force**0.5), (0.05, 0.2))
    >>> round(ratio, 6)
    2.0
    """
    low, high = window
    if not (0 < low < high < math.inf):
        raise about("window", f"must be a lower and a higher stiffness k/(E* L), not {low} and {high}")
    below, above = _inside(line, window, "line"), _inside(surface, window, "surface")
    # Both are straight between all their points together, so that the trapezoidal rule is exact.
    x = np.unique(np.concatenate([np.log(window), below[0], above[0]]))
    x = x[(x >= math.log(low)) & (x <= math.log(high))]
    difference = np.interp(x, *above) - np.interp(x, *below)
    return math.exp(float(np.trapezoid(difference, x)) / (x[-1] - x[0]))


def _inside(curve: tuple[Array, Array], window: tuple[float, float], name: str) -> tuple[Array, Array]:
    """Return ln k and ln F of the points of a curve in a window and of those next to it."""
    force, stiffness = (np.asarray(number(values, name)) for values in curve)
    if force.ndim != 1 or force.shape != stiffness.shape:
        raise InputError(
            f"the {name} must have a stiffness for each force, in a row, not {stiffness.shape} for {force.shape}"
        )
    under = np.flatnonzero(stiffness <= window[0] * (1 + ROUNDING))
    first = under[-1] if under.size else -1
    over = np.flatnonzero(stiffness >= window[1] * (1 - ROUNDING))
    over = over[over > first]
    if first < 0 or not over.size:
        raise InputError(
            f"the {name} goes from k/(E* L) = {stiffness.min():.3g} to {stiffness.max():.3g}, and not all over the "
            f"window from {window[0]:.3g} to {window[1]:.3g}",
            "more forces, or a narrower window",
        )
    part = slice(first, over[0] + 1)
    force, stiffness = force[part], stiffness[part]
    if not ((force > 0).all() and (np.diff(force) > 0).all()):
        raise InputError(f"the forces of the {name} must be positive and rise")
    # The first force that takes a stiffness: a mean over few samples may rest, or fall a little.
    rises = np.concatenate([[True], stiffness[1:] > np.maximum.accumulate(stiffness)[:-1]])
    return np.log(stiffness[rises]), np.log(force[rises])
