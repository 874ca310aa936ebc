"""Interaction of asperities by the mean deflection of the body under a nominal contact of finite size.

Theories of independent asperities treat the mean plane of the surface as fixed. Under a nominal pressure p on an area
A0 this plane sinks into the body, by ``c p sqrt(A0)/E*`` on average: Ciavarella, Greenwood and Paggi (Wear 265, 729
(2008)) add this to the Greenwood-Williamson theory. The bodies approach further at the same load,

    approach = approach of the mean planes + c F/(E* L),    1/k = 1/K + c/(E* L),    L = sqrt(A0),

with the interfacial stiffness K. The second relation is exact for any elastic contact with its value of c, which lies
between 0.561 and 1.122 on a square. On a periodic surface the mean plane does not sink: k = K.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from roughcontact.theory.asperity_models import greenwood_williamson
from roughcontact.theory.asperity_models.interface import Interface
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.random_surfaces.partial_moments import Distribution
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.theory.tools.roots import concave_root
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["SQUARE", "finite_body", "law", "mean_gap"]

# c for a uniform pressure on a square, 0.9464.
SQUARE = 4 / math.pi * (math.log(1 + math.sqrt(2)) + (1 - math.sqrt(2)) / 3)
SOURCE = "Ciavarella, Greenwood and Paggi, Wear 265, 729 (2008)"


@numeric
def mean_gap(
    plane: float | Array, interface: Interface, modulus: float, area: float, *, deflection: float = SQUARE
) -> Array:
    """Return the distance of the flat from the mean plane, which sinks under the load [m].

    Parameters
    ----------
    plane : float or array
        Height of the flat above the undeformed mean plane [m].
    interface : Interface
        `greenwood_williamson.Population` or `bush_gibson_thomas.Summits`.
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].
    deflection : float
        c, the mean deflection in p sqrt(A0)/E* [-]; by default that of a uniform pressure on a square; 0 on a periodic
        surface.

    Returns
    -------
    array
        The unique root s of ``s = plane + c p(s) sqrt(A0)/E*``; ``interface.pressure`` gives the load there.

    Raises
    ------
    ValueError
        If the flat is pushed below the lowest separation at which the theory holds.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import greenwood_williamson, interaction
    >>> interface = greenwood_williamson.population(rc.Moments(1e-12, 0.005, 1e9), 1e11)
    >>> gap = interaction.mean_gap(3e-6, interface, 1e11, 1e-6)
    >>> sunk = interaction.SQUARE * interface.pressure(gap) * 1e-3 / 1e11
    >>> round(float(gap - sunk) * 1e6, 6)  # the plane it was moved to [um]
    3.0
    """
    height = np.asarray(plane, dtype=np.float64)
    factor = _compliance(modulus, area, deflection) * area
    lowest = interface.lowest
    if math.isfinite(lowest):
        require(
            lowest - factor * interface.pressure(lowest) <= height,
            f"at this height of the flat the separation falls below {lowest:.4g} m, where {type(interface).__name__} "
            "does not hold",
        )

    def before_load(gap: Array) -> tuple[Array, Array]:
        return gap - factor * interface.pressure(gap), 1 + factor * interface.stiffness(gap)

    # The function increases, and is concave because the pressure is convex.
    return concave_root(before_load, height, np.maximum(height, lowest), scale=interface.scale)


@numeric
def finite_body(law: LoadingLaw, modulus: float, area: float, *, deflection: float = SQUARE) -> LoadingLaw:
    """Return a theory of the interface with the compliance of the body under a finite nominal contact.

    Parameters
    ----------
    law : LoadingLaw
        A law with an "interfacial_stiffness".
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].
    deflection : float
        See `mean_gap`.

    Returns
    -------
    LoadingLaw
        The law with a further "stiffness", that against the approach of the bodies; the energy of the body, ``c F^2/(2
        E* L)``, is added to an "elastic_energy".

    Raises
    ------
    ValueError
        If the law has no interfacial stiffness.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import interaction, persson
    >>> waves = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> law = interaction.finite_body(persson.law(waves, 1e11, 1e-6), 1e11, 1e-6)
    >>> bool(law.predict("stiffness", 1.0) < law.predict("interfacial_stiffness", 1.0))  # springs in series
    True
    """
    require("interfacial_stiffness" in law.quantities, f"{law.name} has no interfacial stiffness")
    compliance = _compliance(modulus, area, deflection)
    of_interface = law.quantities["interfacial_stiffness"]
    more = dict(law.quantities)

    more["stiffness"] = partial(_stiffness, of_interface, compliance)
    if "elastic_energy" in more:
        more["elastic_energy"] = partial(_energy, more["elastic_energy"], compliance)
    return replace(law, name=f"{law.name} on a finite body", quantities=more)


def _stiffness(of_interface: Callable[[Array], Array], compliance: float, force: Array) -> Array:
    interface = of_interface(force)
    return interface / (1 + compliance * interface)  # 1/k = 1/K + c/(E* L)


def _energy(of_asperities: Callable[[Array], Array], compliance: float, force: Array) -> Array:
    return of_asperities(force) + compliance * force**2 / 2


@numeric
def law(
    moments: ProfileMoments,
    modulus: float,
    area: float,
    *,
    distribution: Distribution = "gaussian",
    deflection: float = SQUARE,
) -> LoadingLaw:
    """Return Greenwood and Williamson's theory with interaction (Ciavarella, Greenwood and Paggi 2008).

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
    deflection : float
        See `mean_gap`.

    Returns
    -------
    LoadingLaw
        That of `greenwood_williamson.law` and "stiffness".

    Notes
    -----
    As a function of the force, interaction changes only the approach and therefore the "stiffness": the number of
    contacts and the area at a load are the same. It is an estimate that assumes a uniform load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import interaction
    >>> law = interaction.law(rc.Moments(1e-12, 0.005, 1e9), 1e11, 1e-6)
    >>> interface, body = law.predict("interfacial_stiffness", 1.0), 1e11 * 1e-3 / interaction.SQUARE
    >>> round(float(law.predict("stiffness", 1.0) * (1 / interface + 1 / body)), 6)  # springs in series
    1.0
    """
    independent = greenwood_williamson.law(moments, modulus, area, distribution=distribution)
    interacting = finite_body(independent, modulus, area, deflection=deflection)
    return replace(interacting, name="Ciavarella-Greenwood-Paggi", source=SOURCE)


def _compliance(modulus: float, area: float, deflection: float) -> float:
    """Return the mean deflection per force, c/(E* sqrt(A0)) [m/N]."""
    require(
        0 <= deflection < math.inf, f"the mean deflection must be finite and not negative, not {deflection}"
    )
    length = math.sqrt(positive(area, "the nominal area [m^2]"))
    return deflection / (float(positive(modulus, "the reduced modulus [Pa]")) * length)
