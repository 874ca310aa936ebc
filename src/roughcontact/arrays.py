"""Fast Fourier transforms of real fields: the only file that knows which library does them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import scipy.fft

__all__ = ["convolve", "even_multiplier", "fast_even_length"]

Array = npt.NDArray[np.float64]

# Columns of the padded spectrum that are transformed, multiplied and transformed back in one go: few enough
# to stay in a core's cache, which halves the time of a product (benchmarks/transforms.py).
SLAB = 32


def fast_even_length(least: int) -> int:
    """Return the next even length from `least` up that has only the prime factors 2, 3 and 5."""
    return 2 * int(scipy.fft.next_fast_len(max(1, -(-least // 2)), real=True))


def even_multiplier(table: Array, padded: tuple[int, int]) -> Array:
    """Return the transform of an even kernel given at offsets from zero up.

    Parameters
    ----------
    table : array, shape (ny, nx)
        Kernel at offsets of whole cells, ``ny <= My//2 + 1`` and ``nx <= Mx//2 + 1``.
    padded : tuple of int
        Even lengths ``(My, Mx)`` of the transforms.

    Returns
    -------
    array, shape (My//2 + 1, Mx//2 + 1)
        Real, since the kernel is even; rows beyond repeat in reverse.
    """
    ny, nx = (m // 2 + 1 for m in padded)
    even = np.zeros((ny, nx))
    even[: table.shape[0], : table.shape[1]] = table
    return np.asarray(scipy.fft.dctn(even, type=1, overwrite_x=True))


def convolve(field: Array, multiplier: Array, padded: tuple[int, int]) -> Array:
    """Return the convolution of `field`, padded by zeros to `padded`, cut back to its own shape.

    Parameters
    ----------
    field : array, shape (ny, nx)
    multiplier : array, shape (My//2 + 1, Mx//2 + 1)
        Real transform of an even kernel, as `even_multiplier` returns it.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.

    Notes
    -----
    Only the rows that hold data are transformed along x, and the padded columns exist for one slab at a time.
    """
    ny, nx = field.shape
    my, mx = padded
    spectrum = scipy.fft.rfft(field, n=mx, axis=1)
    upper = my // 2 + 1
    for start in range(0, spectrum.shape[1], SLAB):
        part = slice(start, start + SLAB)
        column = scipy.fft.fft(spectrum[:, part], n=my, axis=0)
        factor = multiplier[:, part]
        column[:upper] *= factor
        column[upper:] *= factor[my - upper : 0 : -1]
        spectrum[:, part] = scipy.fft.ifft(column, axis=0, overwrite_x=True)[:ny]
    return np.asarray(scipy.fft.irfft(spectrum, n=mx, axis=1, overwrite_x=True)[:, :nx])
