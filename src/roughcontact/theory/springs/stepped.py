"""The stepped indenter: discs r_n = r0 C^n whose steps h_n = h0 C^(Hn) follow the fractal law (thesis, section 4.4.1).

Between two steps the contact is a disc with constant stiffness, so force over depth is piecewise linear. It is a model
of the scaling: the surface is assumed to stay level around a disc until the next step touches.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.validation import Array, numeric, positive, require, require_numbers, whole

__all__ = ["SteppedIndenter"]


@dataclass(frozen=True, slots=True)
class SteppedIndenter:
    """Cylinders of radius r_n and height h_n, the smallest (n = 0) on top (thesis, eqs 4.20 and 4.21).

    Parameters
    ----------
    radius : float
        r0 [m].
    height : float
        h0 [m].
    ratio : float
        C, above 1.
    hurst : float
        H, not negative; up to 1 in the thesis.

    Raises
    ------
    ValueError
        If C is not above 1 or H is negative.

    Notes
    -----
    A whole disc counts as soon as its rim touches. In reality the next cylinder touches with an annulus around a gap:
    its stiffness lies between that of the whole disc and `punch.annulus` of the radii r_(n-1) and r_n, more than 94 %
    of the disc for C = 1.5, 98 % for C = 2.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import stepped
    >>> steps = stepped.SteppedIndenter(radius=1e-6, height=1e-8, ratio=2.0, hurst=1.0)
    >>> (steps.radii(3) * 1e6).round(6).tolist(), (steps.heights(3) * 1e9).round(6).tolist()  # [um] and [nm]
    ([1.0, 2.0, 4.0], [10.0, 20.0, 40.0])
    >>> force, stiffness = steps.corners(3, 1e11)  # where the next step touches
    >>> (stiffness / 2e11 * 1e6).round(6).tolist()  # radii [um]
    [1.0, 2.0, 4.0]
    >>> bool(np.allclose(steps.stiffness(0.99 * force, 3, 1e11), stiffness))
    True
    """

    radius: float
    height: float
    ratio: float
    hurst: float

    def __post_init__(self) -> None:
        require_numbers(self)
        positive(self.radius, "radius [m]")
        positive(self.height, "height [m]")
        require(
            self.ratio > 1,
            f"ratio must exceed 1: each disc is wider than the one above it, not {self.ratio}",
            place="ratio",
        )
        require(
            self.hurst >= 0,
            f"hurst must not be negative: the steps of wider discs are higher, not {self.hurst}",
            place="hurst",
        )

    def radii(self, count: int) -> Array:
        """Return r_n of the first `count` discs [m] (thesis, eq. 4.20).

        Parameters
        ----------
        count : int
            Number of discs.

        Returns
        -------
        array
            r_n [m], shape (count,).
        """
        return self.radius * self.ratio ** np.arange(whole(count, "count"), dtype=np.float64)

    def heights(self, count: int) -> Array:
        """Return h_n of the first `count` discs [m] (thesis, eq. 4.21).

        Parameters
        ----------
        count : int
            Number of discs.

        Returns
        -------
        array
            h_n [m], shape (count,).
        """
        order = np.arange(whole(count, "count"), dtype=np.float64)
        return self.height * self.ratio ** (self.hurst * order)

    def corners(self, count: int, modulus: ArrayLike) -> tuple[Array, Array]:
        """Return forces [N] and stiffnesses [N/m] just before disc n + 1 touches, for n below `count`.

        k_n = 2 E* r_n (thesis, eq. 4.22, which lacks the 2), and F_n = k_0 h_0 + ... + k_n h_n, of which eq. 4.23
        keeps the last term. Far from the tip this term is a constant share, and k_n ~ F_n^(1/(1+H)) (eq. 4.24).

        Parameters
        ----------
        count : int
            Number of discs.
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        array, array
            Forces [N] and stiffnesses [N/m], each of shape (count,).
        """
        k: Array = 2 * positive(modulus, "modulus [Pa]") * self.radii(count)
        return np.cumsum(k * self.heights(count)), k

    @numeric
    def stiffness(self, force: ArrayLike, count: int, modulus: ArrayLike) -> Array:
        """Return the stiffness at a force [N/m]: a staircase (thesis, fig. 17).

        Parameters
        ----------
        force : float or array
            Normal force [N].
        count : int
            Number of discs of the indenter; the last one has no end.
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        float or array
            k [N/m].
        """
        forces, k = self.corners(count, modulus)
        reached = np.searchsorted(forces, positive(force, "force [N]", zero=True), side="right")
        return k[np.minimum(reached, count - 1)]
