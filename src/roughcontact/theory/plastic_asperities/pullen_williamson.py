"""Pullen and Williamson: plastic contact under large loads, in which the displaced material rises elsewhere.

Metal flows at constant volume. Material that is displaced from the contact rises uniformly over the whole area without
contact (Proc. R. Soc. A 327, 159 (1972)). As the contact area grows, less area is left to rise, and more pressure is
needed: ``A/A0 = (p/H)/(1 + p/H)``. The mean pressure on the spots is H/(1 - A/A0), and the contact is never full. At
small loads the area is p/H, and the pressure on it is the hardness.

The area without contact keeps its shape and is only raised by u. All points above the height c = d - u are therefore
in contact, with the distance d of the flat from the mean plane. Volume is conserved if u is the mean over the nominal
area of the excess of the heights above c. The area determines c by the bearing curve of the initial heights
(Abbott's), and c determines u and d. Elastic deformation is neglected.

The paper was not available: the formula of the area was checked in its limits; the rise, the mean gap and the
stiffness are derived from it here.
"""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from scipy.special import ndtri

from roughcontact.theory.law import LoadingLaw, over_area
from roughcontact.theory.random_surfaces.partial_moments import log_gaussian
from roughcontact.validation import Array, finite, numeric, positive, positive_scalar, require

__all__ = ["contact_fraction", "flattened", "law", "mean_gap", "rise", "stiffness"]

SOURCE = "Pullen and Williamson, Proc. R. Soc. A 327, 159 (1972)"


@numeric
def contact_fraction(pressure: float | Array, hardness: float | Array) -> Array:
    """Return the real contact area over the nominal one, ``(p/H)/(1 + p/H)`` [-].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p [Pa].
    hardness : float or array
        H of the softer body, the mean pressure on a spot far from others [Pa].

    Returns
    -------
    float or array
        A/A0 [-].

    Raises
    ------
    ValueError
        If the pressure is negative, or the hardness not positive.

    Examples
    --------
    >>> from roughcontact.theory import pullen_williamson
    >>> [round(float(pullen_williamson.contact_fraction(p, 1e9)), 4) for p in (1e6, 1e9, 9e9)]
    [0.001, 0.5, 0.9]
    """
    p = positive(pressure, "the pressure [Pa]", zero=True)
    return np.asarray(p / (p + positive(hardness, "the hardness [Pa]")))


@numeric
def rise(pressure: float | Array, hardness: float | Array, rms: float | Array) -> Array:
    """Return the rise of the part of a Gaussian surface without contact [m].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p [Pa].
    hardness : float or array
        H of the softer body [Pa].
    rms : float or array
        Root mean square height [m].

    Returns
    -------
    float or array
        u [m], the mean of the heights above the cut ``c``.

    Raises
    ------
    ValueError
        If a number is out of range.

    Examples
    --------
    >>> import math
    >>> from roughcontact.theory import pullen_williamson
    >>> u = pullen_williamson.rise(1e9, 1e9, 1e-6)  # half of the area in contact: cut at the mean plane
    >>> round(float(u) * math.sqrt(2 * math.pi) / 1e-6, 6)
    1.0
    """
    return _height(rms) * _mean_above(_cut(pressure, hardness))


@numeric
def mean_gap(pressure: float | Array, hardness: float | Array, rms: float | Array) -> Array:
    """Return the mean gap of a Gaussian surface [m]: the distance of the flat from the fixed mean plane.

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p, above 0 [Pa].
    hardness : float or array
        H of the softer body [Pa].
    rms : float or array
        Root mean square height [m].

    Returns
    -------
    float or array
        d [m].

    Raises
    ------
    ValueError
        If a number is out of range.

    Examples
    --------
    >>> from roughcontact.theory import pullen_williamson
    >>> gap = pullen_williamson.mean_gap([1e6, 1e9, 1e12], 1e9, 1e-6)
    >>> [f"{value:.3g}" for value in gap]
    ['3.09e-06', '3.99e-07', '2.77e-10']
    """
    # The mean depth below the cut, by the symmetry of the heights.
    return _height(rms) * _mean_above(-_cut(pressure, hardness))


@numeric
def stiffness(pressure: float | Array, hardness: float | Array, rms: float | Array) -> Array:
    """Return the derivative of the pressure by the mean gap, -dp/dd, on first loading [Pa/m].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p, above 0 [Pa].
    hardness : float or array
        H of the softer body [Pa].
    rms : float or array
        Root mean square height [m].

    Returns
    -------
    float or array
        -dp/dd [Pa/m].

    Raises
    ------
    ValueError
        If a number is out of range.

    Notes
    -----
    ``H phi(t)/(rms (1 - A/A0)^3)`` with the normal density phi at the cut t. On unloading the joint is elastic and
    stiffer.

    Examples
    --------
    >>> from roughcontact.theory import pullen_williamson
    >>> slope = pullen_williamson.stiffness(1e8, 1e9, 1e-6)
    >>> near = [pullen_williamson.mean_gap(p, 1e9, 1e-6) for p in (0.999e8, 1.001e8)]
    >>> round(float(2e5 / (near[0] - near[1]) / slope), 5)
    1.0
    """
    t = _cut(pressure, hardness)
    density = np.exp(-(t**2) / 2) / math.sqrt(2 * math.pi)
    return np.asarray(hardness * density * (1 + pressure / np.asarray(hardness)) ** 3 / _height(rms))


@numeric
def flattened(heights: Array, pressure: float, hardness: float) -> Array:
    """Return the heights of a surface after plastic contact with a flat; their mean does not change.

    Parameters
    ----------
    heights : array
        Heights of the surface, any shape, of cells of equal area [m].
    pressure : float
        Nominal pressure p, above 0 [Pa].
    hardness : float
        H of the softer body [Pa].

    Returns
    -------
    array
        Heights [m]: those in contact at the level of the flat, the others raised.

    Raises
    ------
    ValueError
        If a height is missing, or a number is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import pullen_williamson
    >>> before = np.random.default_rng(1).normal(size=100000) * 1e-6
    >>> after = pullen_williamson.flattened(before, 2.5e8, 1e9)
    >>> round(float(np.mean(after == after.max())), 3), bool(abs(after.mean() - before.mean()) < 1e-18)
    (0.2, True)
    """
    h = finite(heights, "heights [m]")
    require(np.size(h) > 0, "heights of a surface are needed, not an empty array", place="heights")
    _loaded(pressure)
    cut = np.quantile(h, 1 - contact_fraction(pressure, positive_scalar(hardness, "the hardness [Pa]")))
    raised = float(np.maximum(h - cut, 0.0).mean())
    return np.asarray(np.minimum(h, cut) + raised)


@numeric
def law(hardness: float, area: float) -> LoadingLaw:
    """Return the contact area as a function of the force.

    Parameters
    ----------
    hardness : float
        H of the softer body [Pa].
    area : float
        Nominal area A0 [m^2].

    Returns
    -------
    LoadingLaw
        "contact_area".

    Raises
    ------
    ValueError
        If a number is not positive and finite.

    Notes
    -----
    A computed curve with a `hardness` limits every pressure to it: its area is at least F/H. In this law the area is
    below F/H, increasingly at larger loads, because neighbours support each other. The mean gap of a computed curve
    counts plastic cells as negative, that of `mean_gap` does not: it is not part of the law.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import pullen_williamson
    >>> steel = rc.handbook("steel")
    >>> law = pullen_williamson.law(steel.hardness, 1e-6)
    >>> round(float(law.predict("contact_area", steel.hardness * 1e-6)) / 1e-6, 6)
    0.5
    """
    most, nominal = positive_scalar(hardness, "the hardness [Pa]"), positive_scalar(area, "the area [m^2]")
    return LoadingLaw(
        "Pullen-Williamson",
        SOURCE,
        {"contact_area": partial(over_area, partial(contact_fraction, hardness=most), nominal)},
    )


def _cut(pressure: float | Array, hardness: float | Array) -> Array:
    """Return the height above which all points are in contact, in rms heights above the mean plane."""
    _loaded(pressure)
    # Both parts of the area are computed, which avoids the difference of numbers near 1.
    part = contact_fraction(pressure, hardness)
    rest = np.asarray(hardness / (np.asarray(pressure) + hardness))
    return np.where(part < 0.5, -ndtri(part), ndtri(rest))


def _mean_above(t: Array) -> Array:
    """Return the mean over all heights of the excess above t, for a normal distribution."""
    return np.asarray(np.exp(log_gaussian(1.0, t)))


def _height(rms: float | Array) -> Array:
    return positive(rms, "rms [m]")


def _loaded(pressure: float | Array) -> None:
    positive(pressure, "the pressure [Pa] (without load the gap is infinite)")
