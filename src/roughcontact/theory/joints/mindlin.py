"""Tangential stiffness from the normal stiffness, and the displacement of a contact before gross slip.

In a round contact without slip the ratio of the stiffnesses is that of the moduli, ``k/k_t = E*/G*``, with
``1/G* = sum (2 - nu)/(4G)`` (Mindlin 1949; thesis, eqs 4.5 and 7.4). It is exact if normal pressure moves both
surfaces sideways by equal amounts (equal bodies, or both incompressible), and a good approximation for other contact
regions: along the long side of a rectangle of 4 : 1 the ratio is 5 % higher at nu = 0.3.

`ratio` in the signatures is E*/G*, one to 1.5 for solids with Poisson's ratio 0 to 1/2.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Literal, Protocol

from roughcontact.errors import InputError
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import Array, moderate, number, numeric, positive, require, scalar, shown

__all__ = [
    "ElasticSolid",
    "fractal_gross_slip",
    "gross_slip",
    "law",
    "pair_ratio",
    "ratio",
    "slip_constant",
    "tangential_stiffness",
]


class ElasticSolid(Protocol):
    """The attributes that a body must have; `roughcontact.Solid` has them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import mindlin
    >>> steel = rc.Solid(210e9, 0.3)
    >>> f"{steel.shear_modulus / 1e9:.1f} GPa", round(mindlin.pair_ratio(steel), 4)
    ('80.8 GPa', 1.2143)
    """

    @property
    def shear_modulus(self) -> float:
        """Shear modulus G [Pa]; infinite of a rigid body."""

    @property
    def poisson_ratio(self) -> float:
        """Poisson's ratio [-]."""


def ratio(poisson_ratio: float) -> float:
    """Return k/k_t of two bodies of equal Poisson's ratio, or one against a rigid body, ``(2 - nu)/(2(1 - nu))``.

    Thesis, eqs 4.5 and 7.4: 1 at nu = 0, 1.5 at nu = 1/2.

    Parameters
    ----------
    poisson_ratio : float
        nu of both bodies [-].

    Returns
    -------
    float
        E*/G* [-].

    Raises
    ------
    ValueError
        If Poisson's ratio is not above -1 and at most 1/2.

    Examples
    --------
    >>> from roughcontact.theory import mindlin
    >>> [round(mindlin.ratio(nu), 4) for nu in (0.0, 0.3, 0.5)]
    [1.0, 1.2143, 1.5]
    """
    nu = scalar(poisson_ratio, "Poisson's ratio")
    require(-1 < nu <= 0.5, f"Poisson's ratio must be above -1 and at most 0.5, not {nu}")
    return (2 - nu) / (2 * (1 - nu))


def pair_ratio(first: ElasticSolid, second: ElasticSolid | None = None) -> float:
    """Return k/k_t = E*/G* of two solids (beside thesis, eq. 4.5); without a `second` its partner is rigid.

    Parameters
    ----------
    first : ElasticSolid
        One body.
    second : ElasticSolid, optional
        The other body; by default rigid.

    Returns
    -------
    float
        E*/G* [-].

    Raises
    ------
    ValueError
        If both are rigid, or one is not a solid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import mindlin
    >>> round(mindlin.pair_ratio(rc.Solid(210e9, 0.3), rc.Solid(70e9, 0.3)), 4)  # of one Poisson's ratio: its own
    1.2143
    """
    bodies = (first,) if second is None else (first, second)
    for body in bodies:
        if not (hasattr(body, "shear_modulus") and hasattr(body, "poisson_ratio")):
            raise InputError(f"a solid with shear_modulus and poisson_ratio is needed, not {shown(body)}")
    sideways = sum((2 - body.poisson_ratio) / (4 * body.shear_modulus) for body in bodies)
    inwards = sum((1 - body.poisson_ratio) / (2 * body.shear_modulus) for body in bodies)
    require(inwards > 0, "two rigid bodies have no stiffness", "give one of them a finite shear modulus")
    return sideways / inwards


@numeric
def tangential_stiffness(stiffness: float | Array, ratio: float) -> Array:
    """Return k_t [N/m] of a contact without slip from its normal stiffness k [N/m] (thesis, eqs 4.5 and 7.5).

    Parameters
    ----------
    stiffness : float or array
        Normal stiffness k, infinite in full contact [N/m].
    ratio : float
        E*/G* [-], see `mindlin.ratio` and `mindlin.pair_ratio`.

    Returns
    -------
    float or array
        k_t [N/m].

    Examples
    --------
    >>> from roughcontact.theory import mindlin
    >>> round(float(mindlin.tangential_stiffness(1.2e5, mindlin.ratio(0.5))), 3)
    80000.0
    """
    k = number(stiffness, "the stiffness [N/m]")
    # Infinite in full contact.
    require(k >= 0, "a stiffness must not be negative [N/m]", value=k, place="stiffness")
    return k / positive(ratio, "the ratio E*/G*")


@numeric
def law(mechanical: LoadingLaw, ratio: float) -> LoadingLaw:
    """Return the law of the tangential stiffness ``"tangential_stiffness"`` [N/m] from the stiffness of another law.

    For the power law of a rough surface it is eq. 7.5 of the thesis.

    Parameters
    ----------
    mechanical : LoadingLaw
        A law that predicts a "stiffness".
    ratio : float
        E*/G* [-], see `mindlin.ratio` and `mindlin.pair_ratio`.

    Returns
    -------
    LoadingLaw
        "tangential_stiffness".

    Raises
    ------
    ValueError
        If the law predicts no stiffness.

    Examples
    --------
    >>> from roughcontact.theory import hertz, mindlin
    >>> law = mindlin.law(hertz.law(1e-2, 1e11), ratio=1.2)
    >>> round(float(hertz.law(1e-2, 1e11).predict("stiffness", 1.0) / law.predict("tangential_stiffness", 1.0)), 6)
    1.2
    """
    positive(ratio, "the ratio E*/G*")
    return mechanical.derived(
        "stiffness", {"tangential_stiffness": partial(tangential_stiffness, ratio=ratio)}
    )


@numeric
def gross_slip(depth: float | Array, friction: float, ratio: float) -> Array:
    """Return the tangential displacement [m] at which a contact begins to slip as a whole, ``mu (E*/G*) d``.

    It holds for any shape, smooth or rough (Ciavarella 1998, Jaeger 1998; basis of thesis, eq. 7.6). See `jaeger` for
    partial slip.

    Parameters
    ----------
    depth : float or array
        Indentation depth d at the normal force [m].
    friction : float
        Coefficient of friction mu [-].
    ratio : float
        E*/G*, see `ratio` and `pair_ratio`.

    Returns
    -------
    float or array
        Displacement of the bodies [m].

    Examples
    --------
    >>> from roughcontact.theory import mindlin
    >>> round(float(mindlin.gross_slip(1e-7, 0.3, mindlin.ratio(0.3))) * 1e9, 3)  # [nm]
    36.429
    """
    mu = positive(friction, "the friction coefficient")
    return mu * positive(ratio, "the ratio E*/G*") * positive(depth, "the depth [m]", zero=True)


@numeric
def slip_constant(
    theta: float,
    hurst: float,
    prefactor: float | None = None,
    *,
    constants: Literal["consistent", "printed"] = "consistent",
) -> float:
    """Return Z of `fractal_gross_slip` [m^(1/(H+1))] (thesis, eq. 7.7).

    Parameters
    ----------
    theta : float
        h L^-H [m^(1-H)], see `pohrt_popov.theta`.
    hurst : float
        Hurst exponent H, above 0 and at most 2.
    prefactor : float, optional
        zeta of the power law 7.2, by default that of eq. 4.74.
    constants : {"consistent", "printed"}
        ``(H+1)/(zeta H) Theta^(1/(H+1))``, which makes 7.6 the depth of eq. 7.2; or eq. 7.7 as printed, whose 0.2055
        and 0.086 come from another fit. They correspond to another zeta: 4 % above that of eq. 4.74 at H = 0.3, 7 %
        below at 0.5, 18 % below at 1 and 2.

    Returns
    -------
    float
        Z [m^(1/(H+1))].

    Raises
    ------
    ValueError
        If a number is out of range, or a prefactor is given with the printed constants, which include one.

    Examples
    --------
    >>> from roughcontact.theory import mindlin, pohrt_popov
    >>> theta = pohrt_popov.theta(0.8, 1e-6, 1e-3)
    >>> constant = mindlin.slip_constant(float(theta), 0.8)
    >>> depth = pohrt_popov.depth(1.0, 0.8, 1e-6, 1e-3, 1e11)
    >>> round(constant * 1e-11 ** (0.8 / 1.8) / float(depth), 6)  # Z (F/E*)^(H/(H+1)) is the depth
    1.0
    """
    size, alpha = float(positive(theta, "theta [m^(1-H)]")), _exponent(hurst)
    if constants == "printed":
        require(prefactor is None, "the printed constants include a prefactor", "omit prefactor")
        return math.pow(0.086 * size, alpha) / (0.2055 * (1 - alpha))
    require(
        constants == "consistent",
        f"constants must be 'consistent' or 'printed', not {constants!r}",
        place="constants",
    )
    zeta = pohrt_popov.prefactor(hurst) if prefactor is None else positive(prefactor, "the prefactor")
    return math.pow(size, alpha) / (float(zeta) * (1 - alpha))


@numeric
def fractal_gross_slip(
    force: float | Array, modulus: float, hurst: float, constant: float, *, friction: float, ratio: float
) -> Array:
    """Return the largest tangential displacement before gross slip of a fractal [m] (thesis, eq. 7.6).

    ``u_max = mu C_m Z (F/E*)^(H/(H+1))``: it does not depend on the size of the surface.

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    modulus : float
        Reduced modulus E* [Pa].
    hurst : float
        Hurst exponent H, above 0 and at most 2.
    constant : float
        Z [m^(1/(H+1))], see `slip_constant`.
    friction, ratio : float
        mu and C_m = E*/G* [-].

    Returns
    -------
    float or array
        u_max [m].

    Examples
    --------
    >>> from roughcontact.theory import mindlin
    >>> constant = mindlin.slip_constant(1e-3, 1.0)
    >>> slip = mindlin.fractal_gross_slip([1.0, 4.0], 1e11, 1.0, constant, friction=0.3, ratio=1.2)
    >>> round(float(slip[1] / slip[0]), 6)  # as F^(1/2) for H = 1
    2.0
    """
    load = positive(force, "the force [N]", zero=True) / positive(modulus, "the modulus [Pa]")
    depth = positive(constant, "the constant Z") * load ** (1 - _exponent(hurst))
    return gross_slip(depth, friction, ratio)


def _exponent(hurst: float) -> float:
    """Return 1/(H+1)."""
    h = scalar(hurst, "hurst")
    require(
        0 < h <= pohrt_popov.SMOOTH,
        f"the Hurst exponent must be above 0 and at most 2, where k ~ F^(1/(H+1)), not {h}",
    )
    return 1 / (moderate(h, "hurst") + 1)
