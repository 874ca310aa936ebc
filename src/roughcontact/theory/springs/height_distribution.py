"""Force and stiffness of a line on springs, from the distribution of its heights (thesis, section 4.5.2).

In the method of dimensionality reduction the springs under a rough line are independent. The force therefore follows
from only the density Phi(z) of heights, with z measured downwards from the highest peak (thesis, eq. 4.59):

    F(u) = E* L int_0^u Phi(z) (u - z) dz,    k(u) = E* L int_0^u Phi(z) dz.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad
from scipy.interpolate import PPoly

from roughcontact.theory.law import LoadingLaw, composed
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, finite, numeric, positive, require

__all__ = [
    "HeightDistribution",
    "density_exponent",
    "from_density",
    "from_samples",
    "legacy_density_exponent",
    "legacy_stiffness_exponent",
    "stiffness_exponent",
]

# Relative error allowed for an integral of a density.
PRECISION = 1e-8
# Largest depth [m] in the search for a force.
FARTHEST = 1e300


@dataclass(frozen=True, slots=True, eq=False)
class HeightDistribution:
    """Heights of a line below its highest peak, as two integrals of their density.

    Parameters
    ----------
    name : str
        Name for legends.
    fraction : callable
        int_0^u Phi(z) dz [-]: the part of the line above the depth u [m]; array in, array out.
    excess : callable
        int_0^u Phi(z) (u - z) dz [m]: the mean excess of the line above the depth u; array in, array out.
    source : str
        Equation.

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> even = height_distribution.from_density(lambda z: 1e6)  # as many heights at every depth
    >>> F = even.force(1e-7, 1e-3, 1e11)
    >>> f"{float(F):.3f} N at {float(even.depth(F, 1e-3, 1e11)) * 1e9:.3f} nm"
    '0.500 N at 100.000 nm'
    >>> law = even.law(1e-3, 1e11)
    >>> f"{float(even.stiffness(1e-7, 1e-3, 1e11)):.0f} N/m", f"{float(law.predict('stiffness', F)):.0f} N/m"
    ('10000000 N/m', '10000000 N/m')
    """

    name: str
    fraction: Callable[[Array], Array]
    excess: Callable[[Array], Array]
    source: str = "thesis, eq. 4.59"

    @numeric
    def force(self, depth: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
        """Return F(u) [N] at indentation depths u from first touch [m], of a line of a `length` [m] (eq. 4.59).

        Parameters
        ----------
        depth : float or array
            Indentation depth u from first touch [m].
        length : float or array
            Length L of the line [m].
        modulus : float or array
            Reduced modulus E* [Pa].

        Returns
        -------
        float or array
            F [N].
        """
        u = positive(depth, "depth [m]", zero=True)
        return _scale(length, modulus) * self.excess(u)

    @numeric
    def stiffness(self, depth: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
        """Return k(u) = dF/du [N/m] at indentation depths u from first touch [m] (thesis, eq. 4.61).

        Parameters
        ----------
        depth : float or array
            Indentation depth u from first touch [m].
        length : float or array
            Length L of the line [m].
        modulus : float or array
            Reduced modulus E* [Pa].

        Returns
        -------
        float or array
            k [N/m].
        """
        u = positive(depth, "depth [m]", zero=True)
        return _scale(length, modulus) * self.fraction(u)

    @numeric
    def depth(self, force: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
        """Return the indentation depth u [m] at normal forces [N]: the inverse of `force`.

        Parameters
        ----------
        force : float or array
            Normal force F [N].
        length : float or array
            Length L of the line [m].
        modulus : float or array
            Reduced modulus E* [Pa].

        Returns
        -------
        float or array
            u [m].
        """
        wanted = positive(force, "force [N]", zero=True) / _scale(length, modulus)
        loaded = wanted > 0
        # A line carries at most its length times the depth.
        low, high = np.where(loaded, wanted, 1.0), np.where(loaded, wanted, 1.0)
        while (short := loaded & (self.excess(high) < wanted)).any():
            low, high = np.where(short, high, low), np.where(short, 2 * high, high)
            require(high < FARTHEST, "no depth gives this force: the density has no heights near the peak")
        return np.where(loaded, bisect(lambda u: self.excess(u) > wanted, low, high), 0.0)[()]

    @numeric
    def law(self, length: float, modulus: float) -> LoadingLaw:
        """Return stiffness and depth as functions of force: the exact k(F) of these heights on springs.

        Parameters
        ----------
        length : float
            Length L of the line [m].
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        LoadingLaw
            "stiffness" and "depth".
        """
        # A wrong body is refused now, not at the first force.
        _scale(length, modulus)
        line = {"length": length, "modulus": modulus}
        return LoadingLaw(
            self.name,
            self.source,
            {
                "stiffness": composed(partial(self.stiffness, **line), partial(self.depth, **line)),
                "depth": partial(self.depth, **line),
            },
        )


def from_density(
    density: Callable[[float], float], *, name: str = "Heights", breaks: Sequence[float] = ()
) -> HeightDistribution:
    """Return the distribution with a given density.

    Parameters
    ----------
    density : callable
        Phi(z) [1/m] at a depth z > 0 below the highest peak [m]: a number in, a number out. It may have a root
        singularity at 0.
    name : str
        For legends.
    breaks : sequence of float
        Depths [m] where the density jumps or is singular, such as its end.

    Returns
    -------
    HeightDistribution

    Raises
    ------
    ValueError
        At evaluation: if an integral misses the relative error of 1e-8, because `breaks` are missing.

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> even = height_distribution.from_density(lambda z: 1e6)  # as many heights at every depth
    >>> round(float(even.stiffness(1e-7, 1e-3, 1e11)))  # a tenth of a line of E* L is in contact
    10000000
    """
    inner = tuple(sorted(float(positive(z, "breaks [m]")) for z in breaks))
    return HeightDistribution(
        name, partial(_integrals, density, inner, 0), partial(_integrals, density, inner, 1)
    )


def from_samples(depth: ArrayLike, density: ArrayLike, *, name: str = "Heights") -> HeightDistribution:
    """Return the distribution whose density is sampled, and linear between the samples.

    Parameters
    ----------
    depth : array
        Increasing depths z >= 0 below the highest peak [m], shape (n,).
    density : array
        Phi(z) [1/m], shape (n,); assumed to be 0 before the first depth and after the last.
    name : str
        For legends.

    Returns
    -------
    HeightDistribution

    Raises
    ------
    ValueError
        If the shapes differ, the depths do not increase, or a number is negative.

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> even = height_distribution.from_samples([0.0, 1e-6], [1e6, 1e6])  # heights spread evenly over 1 um
    >>> round(float(even.force(1e-6, 1e-3, 1e11)), 6)  # E* L u/2
    50.0
    """
    z, phi = positive(depth, "depth [m]", zero=True), positive(density, "density [1/m]", zero=True)
    require(
        z.ndim == 1 and z.shape == phi.shape and len(z) > 1,
        f"depth and density must be lists of one length, at least 2, not of shapes {z.shape} and {phi.shape}",
        place="depth",
    )
    require(np.diff(z) > 0, "depth must increase from sample to sample", place="depth")
    once = PPoly(np.array([np.diff(phi) / np.diff(z), phi[:-1]]), z).antiderivative()
    twice = once.antiderivative()
    return HeightDistribution(name, partial(_sampled_fraction, once), partial(_sampled_excess, once, twice))


@numeric
def stiffness_exponent(density_exponent: ArrayLike) -> Array:
    """Return alpha = (beta + 1)/(beta + 2) of k ~ F^alpha for Phi ~ z^beta (thesis, eqs 4.60 to 4.63) [-].

    Parameters
    ----------
    density_exponent : float or array
        beta, above -1: otherwise the density has no integral.

    Returns
    -------
    float or array
        alpha [-].

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> round(float(height_distribution.stiffness_exponent(-0.5)), 6)  # a parabola: k ~ F^(1/3)
    0.333333
    """
    beta = finite(density_exponent, "density_exponent")
    require(
        beta > -1,
        "density_exponent must exceed -1: the density has no integral otherwise",
        value=beta,
        place="density_exponent",
    )
    return (beta + 1) / (beta + 2)


@numeric
def density_exponent(stiffness_exponent: ArrayLike) -> Array:
    """Return beta = (2 alpha - 1)/(1 - alpha) of Phi ~ z^beta for k ~ F^alpha (thesis, eq. 4.64) [-].

    Parameters
    ----------
    stiffness_exponent : float or array
        alpha, between 0 and 1: at 1 the density is exponential, and there is no highest peak.

    Returns
    -------
    float or array
        beta [-].

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> round(float(height_distribution.density_exponent(1 / 3)), 6)
    -0.5
    """
    alpha = np.asarray(stiffness_exponent, dtype=np.float64)[()]
    require(
        (alpha > 0) & (alpha < 1),
        "stiffness_exponent must lie between 0 and 1; at 1 there is no highest peak",
        place="stiffness_exponent",
    )
    return (2 * alpha - 1) / (1 - alpha)


def legacy_density_exponent(modes: ArrayLike) -> Array:
    """Return beta = -1/2 + (1/2) log2 N of the thesis, a heuristic (eq. 4.72), to reproduce its figures.

    N waves of independent phases have beta = N/2 - 1 (`beat_wave`), which agrees only at N = 1 and 2; adjacent
    harmonics of one line have beta near 0 for every N above 1.

    Parameters
    ----------
    modes : float or array
        Number N of waves, at least 1.

    Returns
    -------
    float or array
        beta [-].

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> float(height_distribution.legacy_density_exponent(2))
    0.0
    """
    n = positive(modes, "modes")
    require(n >= 1, "modes must be at least 1", value=n, place="modes")
    return (np.log2(n) - 1) / 2


def legacy_stiffness_exponent(modes: ArrayLike) -> Array:
    """Return alpha = (1 + log2 N)/(3 + log2 N) of the thesis, a heuristic (eq. 4.73), to reproduce its fig. 25.

    The curve k(F) of low Hurst exponents does not depend on the number of grid points (`gaussian_heights`); a fitted
    exponent does, because the lower end of the window of the fit falls with 1/N.

    Parameters
    ----------
    modes : float or array
        Number N of waves, at least 1.

    Returns
    -------
    float or array
        alpha [-].

    Examples
    --------
    >>> from roughcontact.theory import height_distribution
    >>> round(float(height_distribution.legacy_stiffness_exponent(1)), 6)  # one wave: 1/3, as Hertz
    0.333333
    """
    return stiffness_exponent(legacy_density_exponent(modes))


def _scale(length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return E* L [N/m]."""
    return positive(modulus, "modulus [Pa]") * positive(length, "length [m]")


def _sampled_fraction(once: PPoly, u: Array) -> Array:
    return once(np.clip(u, once.x[0], once.x[-1]))


def _sampled_excess(once: PPoly, twice: PPoly, u: Array) -> Array:
    first, end = once.x[0], once.x[-1]
    value: Array = twice(np.clip(u, first, end)) + once(end) * np.maximum(u - end, 0.0)
    return value


def _integrals(
    density: Callable[[float], float], breaks: tuple[float, ...], order: int, depth: Array
) -> Array:
    """Return int_0^u Phi(z) (u - z)^order dz at depths u."""

    def at(u: float) -> float:
        ends = [0.0, *(z for z in breaks if z < u), u] if u > 0 else []  # at 0 there may be a singularity
        return math.fsum(_integral(lambda z: density(z) * (u - z) ** order, *part) for part in pairwise(ends))

    value: Array = np.vectorize(at, otypes=[np.float64])(depth)[()]
    return value


def _integral(function: Callable[[float], float], low: float, high: float) -> float:
    # With the full output, problems are returned as numbers, not as warnings.
    value, error, *_ = quad(function, low, high, epsabs=0.0, epsrel=PRECISION / 100, limit=200, full_output=1)
    require(
        error <= PRECISION * abs(value),
        f"the density cannot be integrated from {low:.6g} m to {high:.6g} m",
        "name the depths where it jumps or is singular in breaks",
    )
    return float(value)
