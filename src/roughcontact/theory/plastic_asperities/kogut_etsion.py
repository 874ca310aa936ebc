"""Kogut and Etsion: asperities from first yield to full plasticity, by fits to finite elements, under a flat.

From the interference w_c of first yield on, load and area of a sphere of an elastic and perfectly plastic material
follow powers of w/w_c that were fitted to finite elements, with one pair up to 6 w_c and another up to 110 w_c
(J. Appl. Mech. 69, 657 (2002)). Beyond, it is assumed to be fully plastic, with the area 2 pi R w of a cut sphere and
the pressure H (Tribol. Trans. 46, 383 (2003)). Asperities do not interact.
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

SOURCE = (
    "Kogut and Etsion, J. Appl. Mech. 69, 657 (2002), Tribol. Trans. 46, 383 (2003); "
    "parameters: McCool, Wear 107, 37 (1986)"
)
FITTED = (
    HERTZ,
    Regime(1.0, ((1.03, 1.425),), ((0.93, 1.136),)),
    Regime(6.0, ((1.40, 1.263),), ((0.94, 1.146),)),
)
FULLY_PLASTIC = 110.0


@numeric
def population(
    moments: ProfileMoments, hardness: float, modulus: float, *, poisson: float = 0.3
) -> YieldingAsperities:
    """Return the asperities of a surface, as functions of the separation of the mean planes.

    Parameters
    ----------
    moments : ProfileMoments
        Of an isotropic Gaussian surface.
    hardness : float
        H of the softer body, 2.8 times its yield stress in the fits [Pa].
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
    The fits are not continuous: at w_c the load of an asperity jumps by 3 % and its area falls by 7 %, at 6 w_c both
    grow by 2 to 3 %, and at 110 w_c both by 7 to 8 % (Poisson's ratio 0.3), the mean pressure by less than 1 %. The
    spread of heights smooths these jumps.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import kogut_etsion
    >>> soft = kogut_etsion.population(rc.Moments(1e-12, 0.005, 1e9), 1e6, 1e11)
    >>> round(float(soft.pressure(2e-6) / soft.contact_fraction(2e-6)) / 1e6, 3)  # the hardness
    1.0
    """
    h, factor = float(positive(hardness, "the hardness [Pa]")), hardness_factor(poisson)
    # H on 2 pi R w, over two thirds of K H on pi R w_c.
    last = Regime(FULLY_PLASTIC, ((3 / factor, 1.0),), ((2.0, 1.0),))
    return yielding_population((*FITTED, last), moments, factor * h, modulus)


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
        H of the softer body, 2.8 times its yield stress in the fits [Pa].
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
    >>> from roughcontact.theory import kogut_etsion
    >>> steel = rc.handbook("steel")
    >>> modulus = rc.reduced_modulus(steel.solid, steel.solid)
    >>> law = kogut_etsion.law(
    ...     rc.Moments(1e-12, 0.005, 1e9), steel.hardness, modulus, 1e-6, poisson=steel.solid.poisson_ratio
    ... )
    >>> f"{law.predict('contact_area', 1.0) * steel.hardness:.3f}"  # the load: nearly all flows
    '1.043'
    """
    asperities = population(moments, hardness, modulus, poisson=poisson)
    return asperity_law(asperities, area, name="Kogut-Etsion", source=SOURCE)
