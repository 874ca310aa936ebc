"""Between which stiffnesses a result on a grid can speak of the surface and not of the grid."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.theory.spheres_and_punches.punch.polygon import square
from roughcontact.validation import Array, Mask, numeric, positive, require

__all__ = [
    "CELL",
    "KING",
    "WINDOW",
    "cell",
    "full_contact_stiffness",
    "king_full_contact_stiffness",
    "resolved",
    "spring",
    "window",
]

# Of one square cell under uniform pressure, k/(E* spacing) = pi/K00 with K00 = 4 ln(1 + sqrt 2) (thesis, eq. 4.15).
CELL = math.pi / (4 * math.log(1 + math.sqrt(2)))
# Stiffnesses below this many cells are discarded (thesis, section 4.3).
WINDOW = 20.0
# The thesis' shape factor of the square (after King; eqs 4.7 and 4.14): 0.9 % low, here to redraw its figures.
KING = 1.012


@numeric
def cell(modulus: ArrayLike, spacing: ArrayLike) -> Array:
    """Return the stiffness of a single cell in contact, 0.891107 E* spacing [N/m] (thesis, eq. 4.16).

    An artefact of the grid: a flat square of the size of the cell has 1.152298.

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    spacing : float or array
        Side of the square cell [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact_thesis import bounds
    >>> round(float(bounds.cell(1e11, 1e-6)), 1)
    89110.7
    """
    return CELL * positive(modulus, "modulus [Pa]") * positive(spacing, "spacing [m]")


@numeric
def spring(modulus: ArrayLike, spacing: ArrayLike) -> Array:
    """Return the stiffness of a single spring of the method of dimensionality reduction, E* spacing [N/m].

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    spacing : float or array
        Distance of the springs [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact_thesis import bounds
    >>> round(float(bounds.spring(1e11, 1e-6)), 1)
    100000.0
    """
    return positive(modulus, "modulus [Pa]") * positive(spacing, "spacing [m]")


@numeric
def full_contact_stiffness(modulus: ArrayLike, length: ArrayLike) -> Array:
    """Return the stiffness that no contact inside a square exceeds, 1.152298 E* L [N/m] (thesis, eqs 4.7 and 4.14).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    length : float or array
        Side L of the square [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact_thesis import bounds
    >>> round(float(bounds.full_contact_stiffness(1e11, 1e-3) / 1e11 / 1e-3), 6)
    1.152298
    """
    return square(modulus, length)


@numeric
def king_full_contact_stiffness(modulus: ArrayLike, length: ArrayLike) -> Array:
    """Return the full-contact stiffness [N/m] as printed, 2 E* 1.012 L/sqrt(pi) = 1.1419 E* L (eqs 4.7 and 4.14).

    0.9 % too low, see `full_contact_stiffness`: a converged result exceeds it. Only to redraw the thesis' figures.

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    length : float or array
        Side L of the square [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact_thesis import bounds
    >>> round(float(bounds.king_full_contact_stiffness(1.0, 1.0)), 4)
    1.1419
    """
    scale = positive(modulus, "modulus [Pa]") * positive(length, "length [m]")
    return 2 * KING / math.sqrt(math.pi) * scale


@numeric
def window(
    modulus: ArrayLike, length: ArrayLike, spacing: ArrayLike, *, cells: float = WINDOW
) -> tuple[Array, Array]:
    """Return the stiffnesses between which a grid resolves a surface [N/m] (thesis, section 4.3).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    length : float or array
        Side L of the square [m].
    spacing : float or array
        Side of a cell [m].
    cells : float
        How many times the stiffness of one cell is enough.

    Returns
    -------
    lowest, highest : float or array
        `cells` times that of one cell (eq. 4.16), and the full-contact stiffness (eq. 4.14).

    Raises
    ------
    ValueError
        If nothing lies between: the grid is too coarse.

    Examples
    --------
    >>> from roughcontact_thesis import bounds
    >>> lowest, highest = bounds.window(1e11, 1e-3, 1e-6)
    >>> round(float(highest / lowest), 1)  # 20 cells of a thousand a side: less than two decades
    64.7
    """
    lowest = positive(cells, "cells") * cell(modulus, spacing)
    highest = full_contact_stiffness(modulus, length)
    require(
        lowest < highest,
        f"{cells} single cells are stiffer than the whole square: the spacing must be below "
        f"{square(1.0, 1.0) / (cells * CELL):.3g} of the length"
    )
    return lowest, highest


@numeric
def resolved(
    stiffness: ArrayLike, modulus: ArrayLike, length: ArrayLike, spacing: ArrayLike, *, cells: float = WINDOW
) -> Mask:
    """Return whether a stiffness lies inside the `window`.

    Parameters
    ----------
    stiffness : float or array
        Contact stiffness k [N/m].
    modulus : float or array
        Reduced modulus E* [Pa].
    length : float or array
        Side L of the square [m].
    spacing : float or array
        Side of a cell [m].
    cells : float
        How many times the stiffness of one cell is enough.

    Returns
    -------
    bool or array
        True where k is at least the lowest stiffness of the window and below the highest.

    Examples
    --------
    >>> from roughcontact_thesis import bounds
    >>> bounds.resolved([1e5, 1e7, 1e9], 1e11, 1e-3, 1e-6).tolist()
    [False, True, False]
    """
    lowest, highest = window(modulus, length, spacing, cells=cells)
    k = positive(stiffness, "stiffness [N/m]", zero=True)
    return np.asarray((k >= lowest) & (k < highest))
