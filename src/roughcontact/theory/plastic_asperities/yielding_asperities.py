"""Independent yielding spheres of random height: regimes of the interference, each with sums of powers.

Theories of elastic-plastic asperities have a common first yield, at an interference that depends on hardness and
modulus, and differ in the load of an asperity beyond it. In units of the interference, load and area at first yield,
every regime is a sum of powers with pure numbers: one quadrature over the heights serves all theories.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from scipy.special import log_ndtr

from roughcontact.theory.law import LoadingLaw, composed, over_area
from roughcontact.theory.random_surfaces.nayak import summits
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.theory.tools.quadrature import gauss
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, number, positive, require, require_numbers, scalar

__all__ = ["Regime", "YieldingAsperities", "asperity_law", "hardness_factor", "yielding_population"]

Powers = tuple[tuple[float, float], ...]  # (coefficient, exponent), summed

NODES = 64  # in each regime: enough for rounding accuracy, see the tests
LEFT_OUT = 90.0  # exp(-45) of the density at its highest point within reach is below rounding
HIGHEST = 60.0  # standard deviations: exp(-1800) underflows


@dataclass(frozen=True, slots=True)
class Regime:
    """Load and area of one sphere from an interference up to the next regime.

    Parameters
    ----------
    start : float
        Start of the regime, in interferences at first yield [-].
    load : tuple of (float, float)
        Coefficients and exponents of the interference, whose sum is the load over that at first yield.
    area : tuple of (float, float)
        The same for the contact area.
    """

    start: float
    load: Powers
    area: Powers


HERTZ = Regime(0.0, ((1.0, 1.5),), ((1.0, 1.0),))


def hardness_factor(poisson: float) -> float:
    """Return K, the largest pressure of Hertz at first yield over the hardness, ``0.454 + 0.41 nu`` [-].

    Parameters
    ----------
    poisson : float
        Poisson's ratio nu of the softer body, from 0 to 1/2 [-].

    Returns
    -------
    float
        K [-].
    """
    nu = scalar(poisson, "poisson [-]")
    require(
        0 <= nu <= 0.5,
        f"poisson: the fit of the first yield holds from 0 to 0.5, not for {nu}",
        place="poisson",
    )
    return 0.454 + 0.41 * nu


@dataclass(frozen=True, slots=True)
class YieldingAsperities:
    """Spheres of one radius and Gaussian heights that yield; all results are per nominal area.

    Parameters
    ----------
    regimes : tuple of Regime
        In increasing order; the first is `HERTZ`.
    density : float
        Asperities per area [1/m^2].
    radius : float
        Radius R of each asperity [m].
    std : float
        Standard deviation of their heights [m].
    mean_height : float
        Mean of their heights above the mean plane of the surface [m]. Separations are counted from that plane.
    modulus : float
        Reduced modulus E* [Pa].
    yield_pressure : float
        Largest pressure of Hertz at first yield, K H [Pa].
    """

    regimes: tuple[Regime, ...]
    density: float
    radius: float
    std: float
    mean_height: float
    modulus: float
    yield_pressure: float

    def __post_init__(self) -> None:
        require_numbers(self)
        positive(self.modulus, "the reduced modulus [Pa]")
        positive(self.yield_pressure, "the pressure at first yield [Pa]")

    @property
    def critical_interference(self) -> float:
        """Interference at which a sphere begins to yield, ``(pi K H/(2 E*))^2 R`` [m]."""
        return (math.pi * self.yield_pressure / (2 * self.modulus)) ** 2 * self.radius

    @property
    def critical_area(self) -> float:
        """Contact area of a sphere at first yield, pi R times the interference [m^2]."""
        return math.pi * self.radius * self.critical_interference

    @property
    def critical_load(self) -> float:
        """Load of a sphere at first yield, two thirds of the largest pressure on its area [N]."""
        return 2 / 3 * self.yield_pressure * self.critical_area

    @property
    def lowest(self) -> float:
        """The smallest separation [m]: 0, where the flat would reach the mean plane of the surface."""
        return 0.0

    def pressure(self, separation: float | Array) -> Array:
        """Return the nominal pressure [Pa] at a height of the flat above the mean plane of the surface [m].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            p [Pa].

        Raises
        ------
        ValueError
            If the separation is negative: the flat would pass the mean plane, the limit of the theory.
        """
        return np.asarray(np.exp(self._log_pressure(self._plane(separation))))

    def stiffness(self, separation: float | Array) -> Array:
        """Return -dp/ds on first loading, the interfacial stiffness per nominal area [Pa/m].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            K/A0 [Pa/m].
        """
        plane, width = self._plane(separation), self._width
        slopes = [tuple((c * n, n - 1) for c, n in regime.load if n) for regime in self.regimes]
        mean = self._mean(plane, slopes)
        # A jump of the load of a sphere contributes with the density of spheres at the jump.
        for before, after in pairwise(self.regimes):
            jump = _sum(after.load, after.start) - _sum(before.load, after.start)
            at = np.maximum(plane, 0.0) ** 2 - (plane + after.start * width) ** 2
            mean = mean + jump * width * np.exp(at / 2) / math.sqrt(2 * math.pi)
        scale = self.density * self.critical_load / self.critical_interference
        return scale * mean * np.exp(_log_peak(plane))

    def contact_fraction(self, separation: float | Array) -> Array:
        """Return the real contact area over the nominal one [-]; above 1 if spots must overlap.

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            A/A0 [-].
        """
        return self._area(separation, 0)

    def yielded_fraction(self, separation: float | Array) -> Array:
        """Return the area of the spots that have begun to yield over the nominal one [-].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            Part of the nominal area [-].
        """
        return self._area(separation, 1)

    def spot_density(self, separation: float | Array) -> Array:
        """Return the number of asperities in contact per area [1/m^2].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            Contacts per area [1/m^2].
        """
        return np.asarray(self.density * np.exp(log_ndtr(-self._plane(separation))))

    def separation(self, pressure: float | Array) -> Array:
        """Return the height of the flat above the mean plane of the surface [m] at a nominal pressure [Pa].

        Without load the flat is at infinity.

        Parameters
        ----------
        pressure : float or array
            Nominal pressure p [Pa].

        Returns
        -------
        float or array
            Separation [m].

        Raises
        ------
        ValueError
            If a pressure is negative, or pushes the flat below the mean plane of the surface.
        """
        load = positive(pressure, "the pressure [Pa]", zero=True)
        highest = float(self.pressure(0.0))
        require(
            load <= highest * (1 + 1e-12),
            f"at {highest:.4g} Pa the flat reaches the mean plane of the surface, the limit of this theory",
            value=load,
        )
        plane = np.full(np.shape(load), np.inf)
        wanted, lowest = np.log(load[load > 0]), float(self._plane(0.0))
        plane[load > 0] = bisect(
            lambda t: self._log_pressure(t) < wanted, np.full(wanted.shape, lowest), np.asarray(HIGHEST)
        )
        return np.maximum(self.mean_height + self.std * plane, 0.0)

    @property
    def _width(self) -> float:
        """Interference at first yield in standard deviations of the heights."""
        return self.critical_interference / self.std

    def _plane(self, separation: float | Array) -> Array:
        height = number(separation, "the separation [m]")
        require(
            height >= 0,
            "a separation must not be negative: the flat would pass the mean plane",
            value=height,
            place="separation",
        )
        return np.asarray((height - self.mean_height) / self.std)

    def _log_pressure(self, plane: Array) -> Array:
        mean = self._mean(plane, [regime.load for regime in self.regimes])
        return np.asarray(math.log(self.density * self.critical_load) + np.log(mean) + _log_peak(plane))

    def _area(self, separation: float | Array, first: int) -> Array:
        """Return the area of the asperities in the regimes from `first` on."""
        plane = self._plane(separation)
        areas = [regime.area if each >= first else () for each, regime in enumerate(self.regimes)]
        scale = self.density * self.critical_area
        return np.asarray(scale * self._mean(plane, areas) * np.exp(_log_peak(plane)))

    def _mean(self, plane: Array, functions: list[Powers]) -> Array:
        """Return the mean of a function of the interference over all heights, without its factor `_log_peak`.

        The function is given by sums of powers in each regime, the plane in standard deviations above the mean height.
        """
        t, width = plane[..., None], self._width
        far = math.sqrt(LEFT_OUT)
        low, high = np.maximum(0.0, -t - far), -t + np.sqrt(np.maximum(t, 0.0) ** 2 + LEFT_OUT)
        x, weights = gauss(NODES)
        ends = [*(regime.start * width for regime in self.regimes), math.inf]
        total = np.zeros(plane.shape)
        for powers, start, end in zip(functions, ends, ends[1:], strict=False):
            # In the root of the interference half-integer powers at 0 are polynomials.
            first, last = np.sqrt(np.clip(start, low, high)), np.sqrt(np.clip(end, low, high))
            root = first + (last - first) * x
            density = np.exp((np.maximum(t, 0.0) ** 2 - (t + root**2) ** 2) / 2)
            total += (_sum(powers, root**2 / width) * density * 2 * root * (last - first)) @ weights
        return total / math.sqrt(2 * math.pi)


def yielding_population(
    regimes: tuple[Regime, ...], moments: ProfileMoments, yield_pressure: float, modulus: float
) -> YieldingAsperities:
    """Return the spheres that replace the summits of a surface (McCool 1986; see `nayak.summits`).

    Parameters
    ----------
    regimes : tuple of Regime
        Regimes of each sphere.
    moments : ProfileMoments
        Of an isotropic Gaussian surface.
    yield_pressure : float
        Largest pressure of Hertz at first yield, K H [Pa].
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    YieldingAsperities
    """
    mean = summits(moments)
    return YieldingAsperities(
        regimes, mean.density, mean.radius, mean.std, mean.mean_height, modulus, yield_pressure
    )


def asperity_law(asperities: YieldingAsperities, area: float, *, name: str, source: str) -> LoadingLaw:
    """Return the predictions for a nominal area, as functions of the force.

    Parameters
    ----------
    asperities : YieldingAsperities
        The theory, with its parameters.
    area : float
        Nominal area A0 [m^2].
    name, source : str
        See `LoadingLaw`.

    Returns
    -------
    LoadingLaw
        "interfacial_stiffness" on first loading, "contact_area", "mean_gap" and "spots", up to the force at which the
        flat would reach the mean plane.
    """
    nominal = float(positive(area, "the nominal area [m^2]"))
    at_load = asperities.separation
    return LoadingLaw(
        name,
        source,
        {
            "interfacial_stiffness": partial(over_area, composed(asperities.stiffness, at_load), nominal),
            "contact_area": partial(over_area, composed(asperities.contact_fraction, at_load), nominal),
            "mean_gap": partial(_mean_gap, asperities, nominal),
            "spots": partial(over_area, composed(asperities.spot_density, at_load), nominal),
        },
        domain=(0.0, nominal * float(asperities.pressure(0.0))),
    )


def _mean_gap(asperities: YieldingAsperities, area: float, force: Array) -> Array:
    return asperities.separation(force / area)


def _sum(powers: Powers, x: float | Array) -> Array:
    """Return the sum of powers at interferences."""
    return sum((c * np.asarray(x) ** n for c, n in powers), np.zeros(np.shape(x)))


def _log_peak(plane: Array) -> Array:
    """Return the logarithm of the factor of the mean: the normal density at the plane over that at 0."""
    return np.asarray(-(np.maximum(plane, 0.0) ** 2) / 2)
