"""Convolutions of one field with several kernels, each even or odd along each axis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.transforms import SLAB, fast_even_length

__all__ = ["Parity", "convolve_each", "padded_lengths", "parity_multiplier"]

Array = npt.NDArray[np.float64]
Parity = tuple[bool, bool]
"""Whether a kernel is odd along y and along x."""


def padded_lengths(shape: tuple[int, ...]) -> tuple[int, int]:
    """Return even lengths of transforms in which no two offsets of a grid of `shape` share a place."""
    ny, nx = shape
    return fast_even_length(2 * ny - 1), fast_even_length(2 * nx - 1)


def parity_multiplier(
    table: Array, parity: Parity, padded: tuple[int, int], periodic: Sequence[bool] = (False, False)
) -> Array:
    """Return the transform of a kernel, without the factor -i for each axis along which it is odd.

    Parameters
    ----------
    table : array, shape (ny, nx)
        At offsets of whole cells from zero up: along a periodic axis once around, along a free one up to half the
        length of the transform; zero at zero where it is odd.
    parity : pair of bool
        Whether it is odd along y and x.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, even along free axes.
    periodic : sequence of bool
        Along which axes the kernel is given all around.

    Returns
    -------
    array, shape (My//2 + 1, Mx//2 + 1)
        Rows beyond repeat in reverse, with the other sign if the kernel is odd along y.
    """
    lengths = [m if around else m // 2 + 1 for m, around in zip(padded, periodic, strict=True)]
    multiplier = np.zeros(lengths)
    multiplier[: table.shape[0], : table.shape[1]] = table
    for axis, (odd, around) in enumerate(zip(parity, periodic, strict=True)):
        if around:
            waves = scipy.fft.rfft(multiplier, axis=axis)
            multiplier = -waves.imag if odd else waves.real
        elif not odd:
            multiplier = scipy.fft.dct(multiplier, type=1, axis=axis, overwrite_x=True)
        elif padded[axis] > 2:  # else nothing is left between the two places that are zero
            inside = (slice(None),) * axis + (slice(1, -1),)
            multiplier[inside] = scipy.fft.dst(multiplier[inside], type=1, axis=axis)
    return np.asarray(multiplier)


def convolve_each(
    field: Array, multipliers: Sequence[Array], parities: Sequence[Parity], padded: tuple[int, int]
) -> Iterator[Array]:
    """Yield the convolution of `field`, padded by zeros to `padded`, with each kernel, cut back to its own shape.

    Parameters
    ----------
    field : array, shape (ny, nx)
    multipliers : arrays, shape (My//2 + 1, Mx//2 + 1)
        As `parity_multiplier` returns them.
    parities : pairs of bool
        Of each kernel.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.

    Notes
    -----
    As in `roughcontact.transforms.convolve`, only rows that hold data are transformed along x, and the padded columns
    exist for one slab at a time. The field is transformed once.
    """
    ny, nx = field.shape
    my, mx = padded
    rows = scipy.fft.rfft(field, n=mx, axis=1)
    spectra = np.empty((len(multipliers), *rows.shape), rows.dtype)
    upper = my // 2 + 1
    for start in range(0, rows.shape[1], SLAB):
        part = slice(start, start + SLAB)
        column = scipy.fft.fft(rows[:, part], n=my, axis=0)
        for spectrum, multiplier, (odd_y, odd_x) in zip(spectra, multipliers, parities, strict=True):
            factor = multiplier[:, part] * (-1j) ** (odd_y + odd_x)
            product = np.empty_like(column)
            np.multiply(column[:upper], factor, out=product[:upper])
            np.multiply(column[upper:], factor[my - upper : 0 : -1], out=product[upper:])
            if odd_y:
                product[upper:] *= -1
            spectrum[:, part] = scipy.fft.ifft(product, axis=0, overwrite_x=True)[:ny]
    for spectrum in spectra:
        yield np.asarray(scipy.fft.irfft(spectrum, n=mx, axis=1)[:, :nx])
