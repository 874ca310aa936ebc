"""Bush, Gibson and Thomas' theory: all summits of a Gaussian surface as independent elliptic Hertz contacts.

Heights and both curvatures of the summits have the joint density that follows from the spectrum (Wear 35, 87 (1975);
Nayak 1971). With ``elliptic=False`` a summit is replaced by a sphere of its geometric mean curvature (Greenwood, Wear
261, 191 (2006)): a simpler model, whose load is lower by 1 to 3 % at the same separation.

Like Greenwood and Williamson's theory, it does not include the body below the mean plane of the surface: its stiffness
is interfacial. See `interaction` for the body.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.special import erfc, ndtri_exp

from roughcontact.theory.asperity_models.interface import loading_law
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.random_surfaces.nayak import bandwidth, free_variance
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments, moment
from roughcontact.theory.random_surfaces.summit_integrals import log_integrals
from roughcontact.theory.spheres_and_punches.hertz.elliptic import elliptic as hertz
from roughcontact.theory.tools.roots import concave_root
from roughcontact.validation import Array, number, numeric, positive, require, require_numbers

__all__ = ["Summits", "asymptotic_fraction", "asymptotic_pressure", "law"]

ELLIPTIC = "Bush, Gibson and Thomas, Wear 35, 87 (1975)"
CIRCULAR = "Greenwood, Wear 261, 191 (2006)"
FEW = 32  # pressures that are inverted one by one
INFINITY = 100.0  # in sqrt(m0): the load, exp(-5000), is 0 in double precision


@dataclass(frozen=True, slots=True)
class Summits:
    """All summits of a surface against a flat; results are per nominal area.

    Parameters
    ----------
    moments : ProfileMoments
        Of an isotropic Gaussian surface whose Nayak parameter is above 3/2.
    modulus : float
        Reduced modulus E* [Pa].
    elliptic : bool
        Whether both curvatures of a summit count, or only their geometric mean.

    Raises
    ------
    ValueError
        If no surface has these moments, see `nayak.bandwidth` and `nayak.free_variance`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import bush_gibson_thomas as bgt
    >>> summits = bgt.Summits(rc.Moments(1e-12, 0.005, 1e9), modulus=1e11)
    >>> height = summits.separation(1e6)  # of the flat above the mean plane, at 1 MPa
    >>> f"{float(height) * 1e6:.2f} um, {float(summits.pressure(height)):.6g} Pa"
    '3.33 um, 1e+06 Pa'
    >>> f"A/A0 = {float(summits.contact_fraction(height)):.2e}"
    'A/A0 = 1.64e-04'
    >>> f"{float(summits.spot_density(height)) * 1e-6:.0f} spots/mm^2"
    '8 spots/mm^2'
    >>> f"{float(summits.stiffness(height)) * 1e-12:.1f} N/um/mm^2, {float(summits.energy(height)):.3f} J/m^2"
    '3.7 N/um/mm^2, 0.254 J/m^2'
    """

    moments: ProfileMoments
    modulus: float
    elliptic: bool = True

    def __post_init__(self) -> None:
        require_numbers(self)
        positive(self.modulus, "the reduced modulus [Pa]")
        free_variance(self.nayak)

    @property
    def nayak(self) -> float:
        """Nayak's parameter [-]."""
        return bandwidth(self.moments)

    @property
    def lowest(self) -> float:
        """The smallest separation [m]: 0, where the flat would reach the mean plane of the surface."""
        return 0.0

    @property
    def scale(self) -> float:
        """The length over which pressures change [m]: the rms height."""
        return math.sqrt(self.moments.m0)

    def pressure(self, separation: float | Array) -> Array:
        """Return the nominal pressure [Pa] at a separation of the mean planes [m], which must not be negative.

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            p [Pa].
        """
        return self._force_scale * np.exp(self._log_loads(self._plane(separation), 1.5)[0])

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
        slope = 1.5 * self._force_scale / self.scale
        return slope * np.exp(self._log_loads(self._plane(separation), 0.5)[0])

    def energy(self, separation: float | Array) -> Array:
        """Return the elastic energy of the summits per nominal area [J/m^2]: the work of the pressure.

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            U/A0 [J/m^2].
        """
        work = self._force_scale * self.scale / 2.5
        return work * np.exp(self._log_loads(self._plane(separation), 2.5)[0])

    def contact_fraction(self, separation: float | Array) -> Array:
        """Return the real contact area over the nominal one [-].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            A/A0 [-].
        """
        factor = _area_factor if self.elliptic else None
        (log_value,) = log_integrals((1,), self._plane(separation), self.nayak, 1, factor)
        return np.asarray(math.sqrt(self.nayak) / 2 * np.exp(log_value))

    def spot_density(self, separation: float | Array) -> Array:
        """Return the number of summits in contact per nominal area [1/m^2].

        Parameters
        ----------
        separation : float or array
            Distance of the flat from the mean plane of the surface [m], not negative.

        Returns
        -------
        float or array
            Contacts per area [1/m^2].
        """
        (log_value,) = log_integrals((0,), self._plane(separation), self.nayak, 0, None)
        return np.asarray(self.moments.m4 / (2 * math.pi * self.moments.m2) * np.exp(log_value))

    def separation(self, pressure: float | Array) -> Array:
        """Return the separation of the mean planes [m] at a nominal pressure [Pa]; infinite without load.

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
            If a pressure is negative, or so high that the flat would pass the mean plane of the surface.
        """
        load = positive(pressure, "the pressure [Pa]", zero=True)
        highest = float(self.pressure(0.0))
        require(
            load <= highest * (1 + 1e-12),
            f"at {highest:.4g} Pa the flat reaches the mean plane of the surface, the limit of this theory",
            value=load,
        )
        plane = np.full(np.shape(load), np.inf)
        target = np.log(load[load > 0] / self._force_scale)
        if target.size > FEW:
            # The inverse is smooth: from a spline through a few of its points Newton's method needs almost no
            # iterations. A margin
            # keeps these points apart if all targets are equal.
            known = np.linspace(target.min() - 0.01, target.max() + 0.01, FEW)
            start = make_interp_spline(known, self._invert(known, self._first_guess(known)))(target)
        else:
            start = self._first_guess(target)
        plane[load > 0] = np.maximum(self._invert(target, start), 0.0)
        return np.asarray(self.scale * plane)

    def _first_guess(self, target: Array) -> Array:
        """Return the plane at which the limit of high separations, p ~ erfc(s0/sqrt(2))/4, gives the load."""
        log_tail = target + math.log(self.nayak**0.75 * 4 / (3 * math.sqrt(math.pi)))
        return np.asarray(-ndtri_exp(np.minimum(log_tail, math.log(0.5))))

    def _invert(self, target: Array, start: Array) -> Array:
        """Return the plane at which the logarithm of the scaled pressure has the target values."""

        def log_load(at: Array) -> tuple[Array, Array]:
            value, slope = self._log_loads(at, 1.5, 0.5)
            return value, -1.5 * np.exp(slope - value)

        return concave_root(log_load, target, start)

    @property
    def _force_scale(self) -> float:
        """The pressure [Pa] that the integral of order 3/2 multiplies."""
        return float(self.modulus * math.sqrt(self.moments.m2) * self.nayak**0.75 * 2 / (3 * math.pi))

    def _log_loads(self, plane: Array, *orders: float) -> list[Array]:
        return log_integrals(orders, plane, self.nayak, 0.5, _force_factor if self.elliptic else None)

    def _plane(self, separation: float | Array) -> Array:
        """Return the height of the flat above the mean plane of the surface, in sqrt(m0)."""
        return np.asarray(np.minimum(_above_the_mean(separation) / self.scale, INFINITY))


def _above_the_mean(separation: float | Array) -> Array:
    s = number(separation, "the separation [m]")
    require(
        s >= 0,
        "a separation must not be negative: the flat would pass the mean plane of the surface",
        value=s,
        place="separation",
    )
    return s


def _force_factor(ratio: Array) -> Array:
    """Return the force of summits over that of a sphere of their geometric mean curvature, at the same depth [-]."""
    return np.asarray(hertz(1.0, radii=(np.sqrt(ratio), 1 / np.sqrt(ratio)), depth=1.0).force / (4 / 3))


def _area_factor(ratio: Array) -> Array:
    """Return the contact area of summits over that of a sphere of their geometric mean curvature [-]."""
    return np.asarray(
        hertz(1.0, radii=(np.sqrt(ratio), 1 / np.sqrt(ratio)), depth=1.0).contact_area / math.pi
    )


@numeric
def asymptotic_fraction(pressure: float | Array, moments: ProfileMoments, modulus: float) -> Array:
    """Return the contact fraction in the limit of no load, ``A/A0 = sqrt(pi/m2) p/E*`` [-].

    It is the same for both models and all spectra: 2.507 p/(E* g) with the rms slope g, pi/2 times Persson's. A wide
    spectrum approaches it only at contact fractions far below any real one: with Nayak's parameter 100, the area at 1
    % is half of the limit.

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p [Pa].
    moments : ProfileMoments
        Profile moments of an isotropic Gaussian surface.
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        A/A0 [-].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import bush_gibson_thomas as bgt
    >>> moments = rc.Moments(1e-12, 0.005, 1e9)  # rms slope 0.1
    >>> round(float(bgt.asymptotic_fraction(1e6, moments, 1e11)) * 1e11 * 0.1 / 1e6, 4)  # sqrt(2 pi)
    2.5066
    """
    slope = math.sqrt(moment(moments, "m2"))
    ratio = positive(pressure, "the pressure [Pa]", zero=True) / positive(modulus, "the reduced modulus [Pa]")
    return np.asarray(math.sqrt(math.pi) / slope * ratio)


@numeric
def asymptotic_pressure(separation: float | Array, moments: ProfileMoments, modulus: float) -> Array:
    """Return the pressure in the limit of high separation s, ``E* sqrt(m2/pi) erfc(s/sqrt(2 m0))/4`` [Pa].

    The contact area is then half the area of the heights above the flat. The limit is accurate to a few per cent from
    s = 3 sqrt(m0) on if Nayak's parameter is near 2, and only at much larger s for wide spectra.

    Parameters
    ----------
    separation : float or array
        Distance of the flat from the mean plane of the surface [m], not negative.
    moments : ProfileMoments
        Profile moments of an isotropic Gaussian surface.
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        p [Pa].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import bush_gibson_thomas as bgt
    >>> moments = rc.Moments(1e-12, 0.005, 1e9)
    >>> round(float(bgt.asymptotic_pressure(3e-6, moments, 1e11)))
    2692657
    """
    m0, m2 = moment(moments, "m0"), moment(moments, "m2")
    height = _above_the_mean(separation) / math.sqrt(2 * m0)
    return np.asarray(
        float(positive(modulus, "the reduced modulus [Pa]")) * math.sqrt(m2 / math.pi) * erfc(height) / 4
    )


@numeric
def law(moments: ProfileMoments, modulus: float, area: float, *, elliptic: bool = True) -> LoadingLaw:
    """Return the theory for a surface with these moments, as functions of the force.

    Parameters
    ----------
    moments : ProfileMoments
        See `Summits`.
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].
    elliptic : bool
        Whether both curvatures of a summit count, or only their geometric mean.

    Returns
    -------
    LoadingLaw
        "interfacial_stiffness", "contact_area", "mean_gap", "spots" and "elastic_energy", see
        ``interface.loading_law``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import bush_gibson_thomas as bgt
    >>> law = bgt.law(rc.Moments(1e-12, 0.005, 1e9), 1e11, area=1e-6)
    >>> round(float(law.predict("contact_area", 1.0)) * 1e12)  # [um^2] of 1e6
    164
    """
    name, source = ("Bush-Gibson-Thomas", ELLIPTIC) if elliptic else ("Greenwood (simplified BGT)", CIRCULAR)
    return loading_law(Summits(moments, modulus, elliptic), area, name=name, source=source)
