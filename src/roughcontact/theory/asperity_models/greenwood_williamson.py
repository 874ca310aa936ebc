"""Greenwood and Williamson's theory: independent asperities of one shape and random height under a flat.

The load is the sum over the asperities above the flat, each compressed by its excess height (Proc. R. Soc. A 295, 300
(1966); thesis, section 3.1). The deformation of the body between asperities is neglected: the stiffness is that
against the distance of the mean planes, an *interfacial* stiffness. See `interaction` for the body underneath.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import gammaln

from roughcontact.errors import InputError
from roughcontact.theory.asperity_models.interface import loading_law
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.random_surfaces.nayak import summits
from roughcontact.theory.random_surfaces.partial_moments import DISTRIBUTIONS, Distribution
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.theory.tools.roots import concave_root
from roughcontact.validation import Array, number, numeric, positive, require, require_numbers, scalar, shown

__all__ = ["Asperity", "Population", "law", "population"]

ROUNDING = 1e-12  # tolerance for a flat that rests on the lowest asperity
SOURCE = "Greenwood and Williamson, Proc. R. Soc. A 295, 300 (1966); parameters: McCool, Wear 107, 37 (1986)"


@dataclass(frozen=True, slots=True)
class Asperity:
    """One asperity: a spring of force ``coefficient * depth**exponent`` (thesis, eq. 3.2).

    Parameters
    ----------
    coefficient : float
        c [N/m^exponent].
    exponent : float
        beta, from 1 to 11 [-]: 3/2 of a sphere, 1 + 1/H of a tip of height r^H, 1 of a flat end. A spring that softens
        is not an axisymmetric asperity and has no contact area.
    modulus : float
        Reduced modulus E* [Pa].

    Examples
    --------
    >>> from roughcontact.theory import greenwood_williamson, hertz
    >>> sphere = greenwood_williamson.Asperity.hertz(1e-2, 1e11)
    >>> d = hertz.point(1e11, radius=1e-2, force=1.0).depth
    >>> round(float(sphere.coefficient * d**sphere.exponent), 9)  # the force
    1.0
    """

    coefficient: float
    exponent: float
    modulus: float

    def __post_init__(self) -> None:
        require_numbers(self)
        positive(self.coefficient, "the coefficient of an asperity")
        positive(self.modulus, "the reduced modulus [Pa]")
        n = scalar(self.exponent, "the exponent of an asperity")
        require(1 <= n <= 11, f"an asperity's exponent must lie from 1 to 11, not {n}")

    @classmethod
    @numeric
    def hertz(cls, radius: float, modulus: float) -> Asperity:
        """Return a sphere of the given radius [m] on a body of reduced modulus [Pa].

        Parameters
        ----------
        radius : float
            Radius of curvature R [m].
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        Asperity
        """
        reduced = float(positive(modulus, "the reduced modulus [Pa]"))
        return cls(4 / 3 * reduced * math.sqrt(positive(radius, "the radius [m]")), 1.5, reduced)

    @property
    def area_coefficient(self) -> float:
        """Factor c_A of the contact area ``c_A depth**(2 exponent - 2)``, from the stiffness 2 E* times the radius."""
        return math.pi * (self.coefficient * self.exponent / (2 * self.modulus)) ** 2


@dataclass(frozen=True, slots=True)
class Population:
    """Asperities of one shape whose heights are random; all results are per nominal area.

    Parameters
    ----------
    asperity : Asperity
        Shape of each asperity.
    density : float
        Asperities per area [1/m^2].
    std : float
        Standard deviation of their heights [m].
    mean_height : float
        Mean of their heights above the mean plane of the surface [m]. Separations are counted from that plane.
    distribution : {"gaussian", "exponential"}
        Distribution of the heights. The exponential one, ``exp(-z/std)/std`` (thesis, eq. 3.1), begins at
        ``mean_height - std``.

    Raises
    ------
    ValueError
        If it is not an Asperity, or a number is out of range.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import greenwood_williamson
    >>> sphere = greenwood_williamson.Asperity.hertz(2e-5, 1e11)
    >>> summits = greenwood_williamson.Population(sphere, density=6e9, std=1e-6)
    >>> height = summits.separation(1e6)  # of the flat above the mean of the summits, at 1 MPa
    >>> f"{float(height) * 1e6:.2f} um, {float(summits.pressure(height)):.6g} Pa"
    '2.98 um, 1e+06 Pa'
    >>> f"A/A0 = {float(summits.contact_fraction(height)):.2e}"
    'A/A0 = 1.52e-04'
    >>> f"{float(summits.spot_density(height)) * 1e-6:.0f} spots/mm^2"
    '9 spots/mm^2'
    >>> f"{float(summits.stiffness(height)) * 1e-12:.1f} N/um/mm^2, {float(summits.energy(height)):.3f} J/m^2"
    '3.6 N/um/mm^2, 0.260 J/m^2'
    """

    asperity: Asperity
    density: float
    std: float
    mean_height: float = 0.0
    distribution: Distribution = "gaussian"

    def __post_init__(self) -> None:
        require_numbers(self)
        if not isinstance(self.asperity, Asperity):
            raise InputError(
                f"an Asperity is needed, such as Asperity.hertz(radius, modulus), not {shown(self.asperity)}",
                place="asperity",
            )
        positive(self.density, "the density of asperities [1/m^2]")
        positive(self.std, "the standard deviation of asperity heights [m]")
        mean = scalar(self.mean_height, "mean_height [m]")
        require(math.isfinite(mean), f"mean_height must be finite [m], not {mean}", place="mean_height")
        require(
            isinstance(self.distribution, str) and self.distribution in DISTRIBUTIONS,
            f"distribution must be one of {sorted(DISTRIBUTIONS)}, not {self.distribution!r}",
            place="distribution",
        )

    @property
    def origin(self) -> float:
        """Height above the mean plane of the surface from which the distribution counts its heights [m]."""
        return self.mean_height - (self.std if self.distribution == "exponential" else 0.0)

    @property
    def lowest(self) -> float:
        """The smallest separation that the flat may have [m]: 0, or that of the lowest exponential height."""
        return max(0.0, self.origin) if self.distribution == "exponential" else 0.0

    @property
    def scale(self) -> float:
        """The length over which pressures change [m]: the standard deviation of heights."""
        return self.std

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
            If the separation is below `lowest`: the flat would pass the mean plane of the surface, or touch every
            asperity of exponential heights, and there the theory does not hold.
        """
        return self._above(separation, self.asperity.coefficient, self.asperity.exponent)

    def stiffness(self, separation: float | Array) -> Array:
        """Return -dp/ds, the interfacial stiffness per nominal area [Pa/m].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            K/A0 [Pa/m].
        """
        n = self.asperity.exponent
        return self._above(separation, self.asperity.coefficient * n, n - 1)

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
        return self._above(separation, self.asperity.area_coefficient, 2 * self.asperity.exponent - 2)

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
        return self._above(separation, 1.0, 0.0)

    def energy(self, separation: float | Array) -> Array:
        """Return the elastic energy of the asperities per area [J/m^2]: the work of the pressure.

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            U/A0 [J/m^2].
        """
        n = self.asperity.exponent
        return self._above(separation, self.asperity.coefficient / (n + 1), n + 1)

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
            If a pressure is negative, or pushes the flat below `lowest`.
        """
        load = positive(pressure, "the pressure [Pa]", zero=True)
        highest = float(self.pressure(self.lowest))
        require(load <= highest * (1 + ROUNDING), f"at {highest:.4g} Pa the flat {self._end()}", value=load)
        n, plane = self.asperity.exponent, np.full(np.shape(load), np.inf)
        scale = self.density * self.asperity.coefficient * self.std**n
        plane[load > 0] = self._plane(np.log(load[load > 0] / scale))
        return np.maximum(self.origin + self.std * plane, self.lowest)

    def _end(self) -> str:
        """Return a description of the limit of the theory."""
        if self.lowest > 0:
            return "touches every asperity, the limit of the exponential law"
        return "reaches the mean plane of the surface, the limit of this theory"

    def _plane(self, log_moment: Array) -> Array:
        """Return the standardised height t of the flat at which ln F_n(t) has a value, n the asperity's exponent."""
        n, log_at = self.asperity.exponent, DISTRIBUTIONS[self.distribution]
        if self.distribution == "exponential":
            return np.asarray(gammaln(n + 1) - log_moment)

        def log_load(plane: Array) -> tuple[Array, Array]:
            value = log_at(n, plane)
            return value, -n * np.exp(log_at(n - 1, plane) - value)

        # F_n(t) is near |t|^n far below the mean and falls like exp(-t^2/2) above.
        falls = log_at(n, 0.0) - log_moment
        start = np.where(falls > 0, np.sqrt(2 * np.abs(falls)), -np.exp(log_moment / n))
        return concave_root(log_load, log_moment, start)

    def _above(self, separation: float | Array, coefficient: float, order: float) -> Array:
        """Return the mean per area of ``coefficient * excess**order`` over the asperities above the flat."""
        height = number(separation, "the separation [m]")
        require(
            height >= self.lowest - ROUNDING * self.std,
            f"a separation must be at least {self.lowest:.4g} m, where the flat {self._end()}",
            value=height,
            place="separation",
        )
        plane = (height - self.origin) / self.std
        if self.distribution == "exponential":
            plane = np.where(np.abs(plane) < ROUNDING, 0.0, plane)
        moment = np.exp(DISTRIBUTIONS[self.distribution](order, plane))
        return np.asarray(self.density * coefficient * self.std**order * moment)


@numeric
def population(
    moments: ProfileMoments, modulus: float, *, distribution: Distribution = "gaussian"
) -> Population:
    """Return the spheres that replace the summits of a surface (McCool 1986; see `nayak.summits`).

    Parameters
    ----------
    moments : ProfileMoments
        Of an isotropic Gaussian surface.
    modulus : float
        Reduced modulus E* [Pa].
    distribution : {"gaussian", "exponential"}
        Distribution of the summit heights; both with the mean and the standard deviation from the moments.

    Returns
    -------
    Population

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import greenwood_williamson
    >>> asperities = greenwood_williamson.population(rc.Moments(1e-12, 0.005, 1e9), 1e11)
    >>> round(asperities.density / 1e9, 3), round(asperities.std / 1e-6, 3)
    (6.126, 0.989)
    """
    mean = summits(moments)
    sphere = Asperity.hertz(mean.radius, modulus)
    return Population(sphere, mean.density, mean.std, mean.mean_height, distribution)


@numeric
def law(
    moments: ProfileMoments, modulus: float, area: float, *, distribution: Distribution = "gaussian"
) -> LoadingLaw:
    """Return the theory for a surface with these moments, as functions of the force.

    Parameters
    ----------
    moments : ProfileMoments
        Profile moments of an isotropic Gaussian surface.
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].
    distribution : {"gaussian", "exponential"}
        Distribution of the summit heights.

    Returns
    -------
    LoadingLaw
        "interfacial_stiffness", "contact_area", "mean_gap", "spots" and "elastic_energy". With exponential
        heights the stiffness is F/std (thesis, eq. 3.9). There is no "stiffness", which needs the compliance of the
        body, see `interaction`.

    Raises
    ------
    ValueError
        If the moments are not those of an isotropic Gaussian surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import greenwood_williamson
    >>> law = greenwood_williamson.law(rc.Moments(1e-12, 0.005, 1e9), 1e11, 1e-6, distribution="exponential")
    >>> stiffness = law.predict("interfacial_stiffness", [1.0, 2.0])
    >>> round(float(stiffness[1] / stiffness[0]), 6)  # in proportion to the force
    2.0
    """
    asperities = population(moments, modulus, distribution=distribution)
    name = "Greenwood-Williamson" + (", exponential" if distribution == "exponential" else "")
    return loading_law(asperities, area, name=name, source=SOURCE)
