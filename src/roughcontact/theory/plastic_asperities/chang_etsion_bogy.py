"""Chang, Etsion and Bogy: asperities that keep their volume as they yield, under a flat.

Up to first yield an asperity follows Hertz. Beyond it, the summit flows at constant volume: its contact area is ``pi R
w (2 - w_c/w)`` with the interference w, and the mean pressure on it is K H (J. Tribol. 109, 257 (1987)). At first
yield the mean pressure of Hertz is two thirds of K H, and the load of an asperity jumps by half. This jump is a
property of the theory and is smoothed by the spread of heights. Asperities do not interact.
"""

from __future__ import annotations

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.plastic_asperities.yielding_asperities import (
    HERTZ,
    Regime,
    YieldingAsperities,
    asperity_law,
    hardness_factor,
    yielding_population,
)
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.validation import numeric, positive

__all__ = ["law", "population"]

SOURCE = "Chang, Etsion and Bogy, J. Tribol. 109, 257 (1987); parameters: McCool, Wear 107, 37 (1986)"
# K H on pi R (2 w - w_c), over two thirds of K H on pi R w_c.
REGIMES = (HERTZ, Regime(1.0, ((3.0, 1.0), (-1.5, 0.0)), ((2.0, 1.0), (-1.0, 0.0))))


@numeric
def population(
    moments: ProfileMoments, hardness: float, modulus: float, *, poisson: float = 0.3
) -> YieldingAsperities:
    """Return the asperities of a surface, as functions of the separation of the mean planes.

    Parameters
    ----------
    moments : ProfileMoments
        Moments of an isotropic Gaussian surface.
    hardness : float
        H of the softer body [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    poisson : float
        Poisson's ratio of the softer body [-], on which the pressure at first yield depends slightly:
        K = 0.454 + 0.41 nu.

    Returns
    -------
    YieldingAsperities
        Its `pressure`, `contact_fraction`, `yielded_fraction`, `stiffness`, `spot_density`, and `separation`.

    Raises
    ------
    ValueError
        If a number is out of range, or the moments are not those of an isotropic Gaussian surface.

    Notes
    -----
    For very high hardness it is the theory of Greenwood and Williamson; for very low hardness the area is that of
    spheres cut by the flat, 2 pi R w, and the pressure on it is K H.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import chang_etsion_bogy
    >>> soft = chang_etsion_bogy.population(rc.Moments(1e-12, 0.005, 1e9), 1e7, 1e11)
    >>> round(float(soft.pressure(2e-6) / soft.contact_fraction(2e-6)) / 1e7, 3)  # K of the hardness
    0.577
    """
    pressure = hardness_factor(poisson) * float(positive(hardness, "the hardness [Pa]"))
    return yielding_population(REGIMES, moments, pressure, modulus)


@numeric
def law(
    moments: ProfileMoments, hardness: float, modulus: float, area: float, *, poisson: float = 0.3
) -> LoadingLaw:
    """Return the theory for a surface with these moments, as functions of the force.

    Parameters
    ----------
    moments : ProfileMoments
        Of an isotropic Gaussian surface.
    hardness : float
        H of the softer body [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].
    poisson : float
        See `population`.

    Returns
    -------
    LoadingLaw
        "interfacial_stiffness" on first loading, "contact_area", "mean_gap" and "spots".

    Raises
    ------
    ValueError
        As for `population`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import chang_etsion_bogy
    >>> steel = rc.handbook("steel")
    >>> modulus = rc.reduced_modulus(steel.solid, steel.solid)
    >>> law = chang_etsion_bogy.law(
    ...     rc.Moments(1e-12, 0.005, 1e9), steel.hardness, modulus, 1e-6, poisson=steel.solid.poisson_ratio
    ... )
    >>> f"{law.predict('contact_area', 1.0) * steel.hardness:.3f}"  # the load over K: nearly all flows
    '1.746'
    """
    asperities = population(moments, hardness, modulus, poisson=poisson)
    return asperity_law(asperities, area, name="Chang-Etsion-Bogy", source=SOURCE)
