"""Convolution of a pair of fields with a symmetric tensor whose xy component is odd along both axes."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import Placed, namespace
from roughcontact.halfspace.subsurface.field_transform import parity_multiplier
from roughcontact.transforms import filtered

__all__ = ["convolve_pair", "tensor_multiplier"]

Array = npt.NDArray[np.float64]


def tensor_multiplier(table: Array, padded: tuple[int, int]) -> Array:
    """Return the transforms of xx and yy, even along both axes, and xy, odd along both.

    Parameters
    ----------
    table : array, shape (3, ny, nx)
        At offsets of whole cells from zero up, ``ny <= My/2`` and ``nx <= Mx/2``.
    padded : tuple of int
        Even lengths ``(My, Mx)`` of the transforms, as `padded_lengths` returns them.

    Returns
    -------
    array, shape (3, My//2 + 1, Mx//2 + 1)
        All real: i times i is -1. Rows beyond repeat in reverse, of xy with the other sign.
    """
    xx, yy = (parity_multiplier(part, (False, False), padded) for part in table[:2])
    return np.stack([xx, yy, -parity_multiplier(table[2], (True, True), padded)])


def convolve_pair(pair: Array, multiplier: Placed | Array, padded: tuple[int, int]) -> Array:
    """Return the convolution of the fields x and y with a tensor, padded by zeros, cut back to their own shape.

    Parameters
    ----------
    pair : array, shape (2, ny, nx)
        Of any library, on any device, in double or single precision: so is the answer.
    multiplier : array or Placed array, shape (3, My//2 + 1, Mx//2 + 1)
        As `tensor_multiplier` returns it.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the fields.
    """
    factors = multiplier.beside(pair) if isinstance(multiplier, Placed) else multiplier
    xp, (my, _) = namespace(pair), padded
    upper = my // 2 + 1

    def multiply(spectrum: Any, columns: slice) -> None:
        for rows, sign in ((slice(0, upper), 1), (slice(upper, my), -1)):
            part = factors[:, :, columns]
            if sign < 0:
                part = xp.flip(part[:, 1 : my - upper + 1, :], axis=1)
            x, y, across = spectrum[0, rows, :], spectrum[1, rows, :], sign * part[2, :, :]
            along_x = part[0, :, :] * x + across * y
            spectrum[1, rows, :] = part[1, :, :] * y + across * x
            spectrum[0, rows, :] = along_x

    return filtered(pair, multiply, padded)
