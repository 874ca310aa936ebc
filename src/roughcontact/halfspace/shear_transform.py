"""Convolution of a pair of fields with a symmetric tensor whose xy component is odd along both axes."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.arrays import SLAB
from roughcontact.halfspace.field_transform import parity_multiplier

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


def convolve_pair(pair: Array, multiplier: Array, padded: tuple[int, int]) -> Array:
    """Return the convolution of the fields x and y with a tensor, padded by zeros, cut back to their own shape.

    Parameters
    ----------
    pair : array, shape (2, ny, nx)
    multiplier : array, shape (3, My//2 + 1, Mx//2 + 1)
        As `tensor_multiplier` returns it.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the fields.

    Notes
    -----
    As `roughcontact.arrays.convolve`: only rows that hold data are transformed along x, and the padded columns exist
    for one slab at a time.
    """
    _, ny, nx = pair.shape
    my, mx = padded
    spectrum = scipy.fft.rfft(pair, n=mx, axis=2)
    upper = my // 2 + 1
    for start in range(0, spectrum.shape[2], SLAB):
        part = slice(start, start + SLAB)
        column = scipy.fft.fft(spectrum[:, :, part], n=my, axis=1)
        xx, yy, xy = multiplier[:, :, part]
        _multiply(column[:, :upper], xx, yy, xy)
        beyond = slice(my - upper, 0, -1)
        _multiply(column[:, upper:], xx[beyond], yy[beyond], -xy[beyond])
        spectrum[:, :, part] = scipy.fft.ifft(column, axis=1, overwrite_x=True)[:, :ny]
    return np.asarray(scipy.fft.irfft(spectrum, n=mx, axis=2, overwrite_x=True)[:, :, :nx])


def _multiply(column: npt.NDArray[np.complex128], xx: Array, yy: Array, xy: Array) -> None:
    x, y = column[0].copy(), column[1]
    column[0] *= xx
    column[0] += xy * y
    y *= yy
    y += xy * x
