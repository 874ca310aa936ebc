"""Holm's contacts: the constriction resistance of one spot, of several, and the equivalent radius.

Holm, Electric Contacts (1967); several spots after Greenwood, Brit. J. Appl. Phys. 17, 1621 (1966). Results are
stiffnesses over E*, the contact length [m] that `conductance` converts to ohms or K/W: a disc of radius a has ``k/E* =
2a``, and the resistance ``(rho1 + rho2)/(4a)``.
"""

from __future__ import annotations

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number, numeric, positive, require

__all__ = ["cluster_radius", "contact_length", "holm_radius", "spot_resistance", "spots_resistance"]


@numeric
def spot_resistance(radius: float | Array, resistivities: tuple[float, float]) -> Array:
    """Return the constriction resistance of a round spot between two half-spaces [ohm], (rho1 + rho2)/(4a).

    Parameters
    ----------
    radius : float or array
        a [m].
    resistivities : tuple of float
        rho of both bodies [ohm m]. With 1/lambda, the inverse conductivities [m K/W], it is thermal [K/W].

    Returns
    -------
    float or array
        R [ohm]; infinite for radius 0.

    Examples
    --------
    >>> from roughcontact.theory import holm
    >>> round(float(holm.spot_resistance(1e-6, (1.7e-8, 1.7e-8))) * 1e3, 3)  # [mOhm] of copper
    8.5
    """
    rho = _resistivity(resistivities)
    with np.errstate(divide="ignore"):
        return np.asarray(rho / (2 * positive(radius, "the radius [m]", zero=True)))


def spots_resistance(radii: Array, positions: Array, resistivities: tuple[float, float]) -> float:
    """Return the resistance of round spots of a plane between two half-spaces [ohm] (Greenwood 1966).

    ``R = rho/(2 sum a_i) + (rho/pi) sum_{i != j} a_i a_j/s_ij / (sum a_i)^2`` with the mean rho of both.
    It assumes that the current of each spot is proportional to its radius, and that the other spots are points: valid
    for spots much smaller than their distances. See `contact_length` for the arguments and errors.

    Parameters
    ----------
    radii : array, shape (n,)
        a_i [m].
    positions : array, shape (n, 2)
        Centres of the spots [m].
    resistivities : tuple of float
        Resistivity rho of both bodies [ohm m].

    Returns
    -------
    float
        R [ohm].

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import holm
    >>> radii, places = np.full(2, 1e-6), np.array([[0.0, 0.0], [1.0, 0.0]])
    >>> round(holm.spots_resistance(radii, places, (1.7e-8, 1.7e-8)) * 1e3, 3)  # half of one spot's
    4.25
    """
    return _resistivity(resistivities) / contact_length(radii, positions)


def contact_length(radii: Array, positions: Array) -> float:
    """Return k/E* [m] of round spots of a plane (Greenwood 1966): 2a for one, twice the sum of the radii if far apart.

    Parameters
    ----------
    radii : array, shape (n,)
        a_i [m].
    positions : array, shape (n, 2)
        Centres of the spots [m].

    Returns
    -------
    float
        k/E* [m].

    Raises
    ------
    ValueError
        If a radius is not positive, or two spots overlap: then use `roughcontact.contact_stiffness`.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import holm
    >>> round(holm.contact_length(np.full(1, 3e-6), np.zeros((1, 2))) * 1e6, 6)  # 2a [um]
    6.0
    """
    a, centre = np.asarray(number(radii, "radii [m]")), np.asarray(number(positions, "positions [m]"))
    if a.ndim != 1 or a.size == 0 or centre.shape != (a.size, 2):
        raise InputError(f"spots need radii (n,) and positions (n, 2), not {a.shape} and {centre.shape}")
    if not (np.isfinite(a).all() and (a > 0).all() and np.isfinite(centre).all()):
        raise about("radii", "must be positive, and radii and positions finite")
    mutual = 0.0
    # One row of distances at a time: there may be many spots.
    for i in range(a.size - 1):
        distance = np.hypot(*(centre[i + 1 :] - centre[i]).T)
        if (distance < a[i] + a[i + 1 :]).any():
            raise InputError(
                f"spot {i} overlaps another: the formula is for separate spots",
                "compute such a region with roughcontact.contact_stiffness",
            )
        mutual += 2 * a[i] * float(np.sum(a[i + 1 :] / distance))
    total = float(a.sum())
    return float(1 / (1 / (2 * total) + mutual / (np.pi * total**2)))


@numeric
def holm_radius(stiffness: float | Array, modulus: float) -> Array:
    """Return the radius [m] of the round spot with this stiffness and therefore this conductance: k/(2 E*).

    Also called contact length or Hertz radius (thesis, section 4.2, after eq. 4.6).

    Parameters
    ----------
    stiffness : float or array
        Contact stiffness k [N/m].
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        Radius [m].

    Examples
    --------
    >>> from roughcontact.theory import holm
    >>> round(float(holm.holm_radius(2e5, 1e11)) * 1e6, 6)  # [um]
    1.0
    """
    return positive(stiffness, "the stiffness [N/m]", zero=True) / (2 * positive(modulus, "the modulus [Pa]"))


@numeric
def cluster_radius(stiffness: float, local: float, modulus: float) -> float:
    """Return Holm's radius of a cluster [m]: ``1/k = 1/k_local + 1/(2 E* radius)``.

    Parameters
    ----------
    stiffness : float
        Total stiffness k [N/m].
    local : float
        Stiffness [N/m] of the independent spots, ``2 E* sum a_i``, or that against the mean gap.
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    float
        Radius [m].

    Raises
    ------
    ValueError
        If the total stiffness is not below that of the spots: then there is no cluster.

    Examples
    --------
    >>> from roughcontact.theory import holm
    >>> round(holm.cluster_radius(1e5, 2e5, 1e11) * 1e6, 6)  # [um]
    1.0
    """
    k, apart = positive(stiffness, "the stiffness [N/m]"), positive(local, "the local stiffness [N/m]")
    require(
        k < apart,
        f"a cluster is softer than its separate spots: {k} N/m is not below {apart} N/m",
    )
    return float(k * apart / (2 * positive(modulus, "the modulus [Pa]") * (apart - k)))


def _resistivity(resistivities: tuple[float, float]) -> float:
    """Return the mean of both [ohm m]."""
    both = positive(resistivities, "the resistivity [ohm m]", zero=True)
    require(
        np.shape(both) == (2,),
        f"the resistivity [ohm m] of each body is needed, not {resistivities}",
    )
    return float(np.mean(both))
