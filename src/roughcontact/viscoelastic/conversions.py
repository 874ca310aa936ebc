"""Viscoelastic materials from creep, from two bodies, and from a modulus of shear or tension; all exact.

E* = 4G(3K + G)/(3K + 4G) with a constant bulk modulus K is a sum of viscoelastic functions (s: Laplace variable),

    E* = G + 9K/4 - (27 K^2/4)/(4G + 3K)                       with G(s)
    E* = 27 K^2/(9K - E) - 9 K^2/(3K + E)                      with Young's modulus E(s)

whose inverses have exponential terms with times between those of G or E.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.materials import Modulus, as_modulus
from roughcontact.validation import Array, exactly_one, number, numeric, require
from roughcontact.viscoelastic.prony_series import Creep, Viscoelastic, checked_material, partner_terms

__all__ = ["Kind", "from_creep", "in_series", "reduced"]

Kind = Literal["young", "shear", "reduced"]


@numeric(instantaneous="Pa^-1", compliances="Pa^-1", times="s", fluidity="1/(Pa*s)")
def from_creep(
    instantaneous: float,
    compliances: Sequence[float] | Array,
    times: Sequence[float] | Array,
    *,
    fluidity: float = 0.0,
) -> Viscoelastic:
    """Return the material with ``J(t) = J_0 + fluidity t + sum J_j (1 - exp(-t/theta_j))``, exactly.

    Parameters
    ----------
    instantaneous : float
        J_0 [1/Pa]; 0 gives a material with a dashpot.
    compliances, times : sequence of float
        J_j [1/Pa], not negative, and the different retardation times theta_j [s].
    fluidity : float
        Inverse of a reduced viscosity [1/(Pa s)]; 0 for a solid.

    Returns
    -------
    Viscoelastic

    Raises
    ------
    ValueError
        If a compliance is negative, a time is not positive, or two times are equal.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> rubber = viscoelastic.from_creep(1 / 3, [2 / 3], [3.0])  # in MPa and s
    >>> [round(value, 9) for value in (rubber.equilibrium, *rubber.moduli, *rubber.times)]
    [1.0, 2.0, 1.0]
    """
    J, theta = (
        np.asarray(number(values, name)) for name, values in (("compliances", compliances), ("times", times))
    )
    if J.ndim != 1 or J.shape != theta.shape:
        raise about("compliances", f"and times must be lists of one length, not {J.shape} and {theta.shape}")
    require(
        np.append(J, (instantaneous, fluidity)) >= 0, "compliances must not be negative", place="compliances"
    )
    require(
        (theta > 0) & (theta < np.inf), "retardation times must be positive [s]", place="times", value=theta
    )
    require(
        len(set(theta.tolist())) == len(theta),
        "the retardation times must differ",
        "add the compliances of equal times",
        place="times",
    )
    return _from_creep(Creep(instantaneous, fluidity, tuple(J.tolist()), tuple(theta.tolist())))


def in_series(first: Viscoelastic, second: Viscoelastic | Modulus) -> Viscoelastic:
    """Return the reduced modulus of two bodies in contact: their creep compliances add, exactly.

    Parameters
    ----------
    first : Viscoelastic
    second : Viscoelastic, float, Solid, Material or str
        The other body; a number is its reduced modulus E/(1 - nu^2) [Pa].

    Returns
    -------
    Viscoelastic

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> pair = viscoelastic.in_series(viscoelastic.standard_solid(2.0, 6.0, 1.0), 2.0)
    >>> round(pair.equilibrium, 12), round(pair.instantaneous, 12)  # 1/(1/2 + 1/2) and 1/(1/6 + 1/2)
    (1.0, 1.5)
    """
    if not isinstance(second, Viscoelastic):
        second = Viscoelastic(as_modulus(second))
    a, b = checked_material(first).creep(), second.creep()
    times, compliances = _merged(
        (theta, J) for each in (a, b) for theta, J in zip(each.times, each.compliances, strict=True)
    )
    bands = [each for each in (a.band, b.band) if each is not None]
    band = (max(low for low, _ in bands), min(high for _, high in bands)) if bands else None
    if band is not None and band[0] >= band[1]:
        raise InputError(
            f"the bands of the two materials do not overlap: {a.band} and {b.band} s",
            "extrapolate one with dataclasses.replace(material, band=None)",
            "second",
        )
    creep = Creep(
        a.instantaneous + b.instantaneous,
        a.fluidity + b.fluidity,
        compliances,
        times,
        band,
    )
    return _from_creep(creep)


@numeric(bulk="Pa")
def reduced(
    modulus: Viscoelastic, kind: Kind, *, poisson: float | None = None, bulk: float | None = None
) -> Viscoelastic:
    """Return the reduced modulus E*(t) of a body whose Young's or shear modulus is known, exactly.

    Parameters
    ----------
    modulus : Viscoelastic
        The modulus in time, as if it were the reduced modulus.
    kind : str
        ``"young"``, ``"shear"``, or ``"reduced"``, which is returned unchanged.
    poisson : float, optional
        Poisson's ratio if it is constant in time [-].
    bulk : float, optional
        Bulk modulus if it is constant in time [Pa]. Give one of the two.

    Returns
    -------
    Viscoelastic

    Raises
    ------
    ValueError
        If the kind is unknown, or the ratio or the bulk modulus is out of range.

    Examples
    --------
    >>> from roughcontact import Viscoelastic, viscoelastic
    >>> shear = Viscoelastic(1e6, (9e6,), (0.1,))
    >>> round(viscoelastic.reduced(shear, "shear", poisson=0.5).instantaneous)  # 2 G/(1 - nu)
    40000000
    >>> body = viscoelastic.reduced(shear, "shear", bulk=1e9)
    >>> round(body.instantaneous), len(body.times)  # 4 G (3K + G)/(3K + 4G)
    (39605263, 2)
    """
    checked_material(modulus)
    if kind not in ("young", "shear", "reduced"):
        raise about("kind", f"must be 'young', 'shear' or 'reduced', not {kind!r}")
    if kind == "reduced":
        require(
            poisson is None and bulk is None,
            "a reduced modulus needs no ratio and no bulk modulus",
            place="kind",
        )
        return modulus
    if exactly_one(poisson=poisson, bulk=bulk)[0] == "poisson":
        assert poisson is not None
        require(
            -1 < poisson <= 0.5, f"poisson must be above -1 and at most 0.5, not {poisson:g}", place="poisson"
        )
        factor = 1 / (1 - poisson**2) if kind == "young" else 2 / (1 - poisson)
        moduli = tuple(factor * E for E in modulus.moduli)
        return replace(
            modulus, equilibrium=factor * modulus.equilibrium, moduli=moduli, dashpot=factor * modulus.dashpot
        )
    assert bulk is not None
    K, start = bulk, modulus.equilibrium
    lowest = modulus.instantaneous / 9 if kind == "young" else 0.0  # E < 9 K
    require(lowest < K < math.inf, f"bulk must be finite and above {lowest:g} Pa", place="bulk", value=K)
    if kind == "shear":
        stiff = replace(
            modulus,
            equilibrium=4 * start + 3 * K,
            moduli=tuple(4 * G for G in modulus.moduli),
            dashpot=4 * modulus.dashpot,
        ).creep()
        terms = [
            *zip(modulus.times, modulus.moduli, strict=True),
            *((theta, 27 * K**2 / 4 * J) for J, theta in zip(stiff.compliances, stiff.times, strict=True)),
        ]
        equilibrium, dashpot = 4 * start * (3 * K + start) / (3 * K + 4 * start), modulus.dashpot
    else:
        require(
            modulus.dashpot == 0,
            "Young's modulus with a dashpot exceeds 9 K",
            "give poisson instead",
            place="bulk",
        )
        soft = replace(modulus, equilibrium=start + 3 * K).creep()
        rest = partner_terms(9 * K - modulus.instantaneous, 0.0, modulus.moduli, modulus.times)
        terms = [
            *((theta, 9 * K**2 * J) for J, theta in zip(soft.compliances, soft.times, strict=True)),
            *((tau, 27 * K**2 * e) for tau, e in rest),
        ]
        equilibrium, dashpot = 36 * K**2 * start / ((3 * K + start) * (9 * K - start)), 0.0
    times, moduli = _merged(terms)
    return replace(modulus, equilibrium=equilibrium, moduli=moduli, times=times, dashpot=dashpot)


def _from_creep(creep: Creep) -> Viscoelastic:
    """Return the material of a creep function, by the roots of its transform."""
    terms = partner_terms(creep.instantaneous, creep.fluidity, creep.compliances, creep.times)
    rate = creep.fluidity + math.fsum(J / tau for J, tau in zip(creep.compliances, creep.times, strict=True))
    total = creep.instantaneous + math.fsum(creep.compliances)
    require(total + rate > 0, "a material needs a compliance", place="compliances")
    return Viscoelastic(
        0.0 if creep.fluidity else 1 / total,
        tuple(E for _, E in terms),
        tuple(tau for tau, _ in terms),
        0.0 if creep.instantaneous else 1 / rate,
        creep.band,
    )


def _merged(terms: Iterable[tuple[float, float]]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return times and weights, of equal times the sum of their weights."""
    found: dict[float, float] = {}
    for time, weight in terms:
        found[time] = found.get(time, 0.0) + weight
    return tuple(found), tuple(found.values())
