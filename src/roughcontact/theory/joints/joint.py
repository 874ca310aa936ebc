"""The correlations of thermal joints as laws of the contact: its area, and its stiffness by the exact analogy.

A contact that conducts heat as h per nominal area has the interfacial stiffness ``E* h/k_s`` per area (thesis, eq. 4.4
corrected): the conductivities cancel, and the law can be compared with a computed curve of any bodies.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from roughcontact.theory.joints import thermal
from roughcontact.theory.joints.conductance import stiffness_from_thermal
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.validation import Array, numeric

__all__ = ["cooper_mikic_yovanovich", "mikic"]

_ALIKE = (1.0, 1.0)  # conductivities of both bodies: any values give the same stiffness


@numeric
def mikic(moments: ProfileMoments, modulus: float, area: float) -> LoadingLaw:
    """Return Mikic's law of elastic spots: ``A = F/(E* m/sqrt2)``, stiffness ~ F^0.94.

    Parameters
    ----------
    moments : ProfileMoments
        Moments of the sum of both surfaces.
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].

    Returns
    -------
    LoadingLaw
        "contact_area" and "interfacial_stiffness", up to a pressure of 5 % of E* m/sqrt2.

    Notes
    -----
    Mikic, Int. J. Heat Mass Transfer 17, 205 (1974); the fit is that of `thermal.elastic_conductance`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import joint
    >>> k = joint.mikic(rc.Moments(1e-12, 0.005, 1e9), 1e11, 1e-4).predict("interfacial_stiffness", [100.0, 200.0])
    >>> round(float(k[1] / k[0]), 4)  # 2^0.94
    1.9185
    """
    return _law(thermal.elastic_law(moments, modulus, _ALIKE, area), modulus, area, plastic=False)


@numeric
def cooper_mikic_yovanovich(
    moments: ProfileMoments, hardness: float, modulus: float, area: float
) -> LoadingLaw:
    """Return the law of plastic spots: ``A = F/H``, stiffness ~ F^0.95.

    Parameters
    ----------
    moments : ProfileMoments
        Moments of the sum of both surfaces.
    hardness : float
        H of the softer body at the size of the spots [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].

    Returns
    -------
    LoadingLaw
        "contact_area" and "interfacial_stiffness", up to a pressure of 5 % of the hardness. The stiffness is that of
        all spots on unloading, as for the conductance; the stiffness of a curve with a hardness does not include the
        plastic cells.

    Notes
    -----
    Cooper, Mikic and Yovanovich, Int. J. Heat Mass Transfer 12, 279 (1969), in the fit of Yovanovich (1982), see
    `thermal.plastic_conductance`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import joint
    >>> law = joint.cooper_mikic_yovanovich(rc.Moments(1e-12, 0.005, 1e9), 1e9, 1e11, 1e-4)
    >>> f"{law.predict('contact_area', 100.0):.1e}"
    '1.0e-07'
    """
    return _law(thermal.plastic_law(moments, hardness, _ALIKE, area), modulus, area, plastic=True)


def _law(conducting: LoadingLaw, modulus: float, area: float, *, plastic: bool) -> LoadingLaw:
    """Return the law of area and stiffness of a joint from the law of its conductance."""
    stiffness: Callable[[Array], Array] = partial(
        stiffness_from_thermal, modulus=modulus, conductivities=_ALIKE
    )
    mechanical = conducting.derived("thermal_conductance", {"interfacial_stiffness": stiffness})
    # The fit ends at a force of a known fraction of the mean pressure of the spots over the nominal area.
    pressure = conducting.domain[1] / (thermal.FIT_LIMIT * area)
    return LoadingLaw(
        conducting.name,
        conducting.source,
        {"contact_area": partial(_area, pressure), **mechanical.quantities},
        conducting.domain,
        plastic=plastic,
    )


def _area(pressure: float, force: Array) -> Array:
    return force / pressure
