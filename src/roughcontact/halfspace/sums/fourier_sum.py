"""Sums over the cells by fast Fourier transforms, of scalars and of tensors, free or periodic along each axis."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from roughcontact.arrays import DeviceTable, namespace
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.shear_influence import Influences
from roughcontact.halfspace.influence.tables import Periodic
from roughcontact.transforms import Convolution, fast_even_length, filtered, padded_length, workers_for
from roughcontact.validation import Array

__all__ = ["Parity", "TensorConvolution", "fourier_sum", "inverse_sum", "padded_lengths", "transfer_function"]

Pair = tuple[int, int]
Parity = tuple[bool, bool]
"""Whether a kernel is odd along y and along x."""


def fourier_sum(influence: Influences, grid: Grid) -> Convolution | TensorConvolution:
    """Return the convolution with an influence: exact on a free grid of any shape (thesis, eq. A.59 as corrected)."""
    kernel = influence.influence
    if isinstance(kernel, Periodic) and all(grid.periodic):
        return Convolution(kernel.transfer_function, _pair(grid.shape))
    if all(grid.periodic):
        return _convolution(influence.transfer_function(), _pair(grid.shape))
    table = influence.table(grid.shape)
    if table.ndim == 2:
        lengths = padded_lengths(grid, shared=True)
        return Convolution(transfer_function(table, (False, False), lengths, grid.periodic), lengths)
    lengths = padded_lengths(grid)
    # The odd component has the factor -i twice.
    parts = [
        (-1) ** odd * transfer_function(part, (odd, odd), lengths, grid.periodic)
        for part, odd in zip(table, (False, True, False), strict=True)
    ]
    return TensorConvolution(np.stack(parts), lengths)


def inverse_sum(influence: Influences, grid: Grid) -> Convolution | TensorConvolution:
    """Return the product of each wave of a displacement by itself, as if a free grid repeated itself."""
    lengths = [
        n if around else fast_even_length(n) for n, around in zip(grid.shape, grid.periodic, strict=True)
    ]
    kernel = influence.influence
    if isinstance(kernel, Periodic):
        return Convolution(partial(kernel.inverse, _pair(lengths)), _pair(lengths))
    return _convolution(influence.inverse(_pair(lengths)), _pair(lengths))


def padded_lengths(grid: Grid, shared: bool = False) -> Pair:
    """Return the lengths of the transforms: those of a period, or enough for a free axis.

    Where all kernels are even, the farthest offsets to both sides may be `shared`: they are equal.
    """
    return _pair(
        [
            n if around else padded_length(n) if shared else fast_even_length(2 * n - 1)
            for n, around in zip(grid.shape, grid.periodic, strict=True)
        ]
    )


def transfer_function(table: Array, parity: Parity, lengths: Pair, periodic: Sequence[bool]) -> Array:
    """Return the transform of a kernel, without the factor -i for each axis along which it is odd.

    Parameters
    ----------
    table : array, shape (ny, nx)
        At offsets of whole cells from zero up: along a periodic axis once around, along a free one up to half the
        length of the transform; zero at zero where it is odd.
    parity : pair of bool
        Whether it is odd along y and x.
    lengths : tuple of int
        Lengths ``(My, Mx)`` of the transforms, even along free axes.
    periodic : sequence of bool
        Along which axes the kernel is given all around.

    Returns
    -------
    array, shape (My//2 + 1, Mx//2 + 1)
        Rows beyond repeat in reverse, with the other sign if the kernel is odd along y.
    """
    import scipy.fft

    shape = [m if around else m // 2 + 1 for m, around in zip(lengths, periodic, strict=True)]
    transfer = np.zeros(shape)
    transfer[: table.shape[0], : table.shape[1]] = table
    workers = workers_for(lengths)
    for axis, (odd, around) in enumerate(zip(parity, periodic, strict=True)):
        if around:
            waves = scipy.fft.rfft(transfer, axis=axis, workers=workers)
            transfer = -waves.imag if odd else waves.real
        elif not odd:
            transfer = scipy.fft.dct(transfer, type=1, axis=axis, overwrite_x=True, workers=workers)
        elif lengths[axis] > 2:  # otherwise nothing is left between the two places that are zero
            inside = (slice(None),) * axis + (slice(1, -1),)
            transfer[inside] = scipy.fft.dst(transfer[inside], type=1, axis=axis, workers=workers)
    return np.ascontiguousarray(transfer)


class TensorConvolution:
    """Convolution of the fields x and y with a symmetric tensor whose xy component is odd along both axes.

    Parameters
    ----------
    transfer : array, shape (3, My//2 + 1, Mx//2 + 1)
        Transforms of xx, xy and yy, all real. Rows beyond repeat in reverse, of xy with the other sign.
    lengths : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the fields.
    """

    __slots__ = ("_transfer", "lengths")

    def __init__(self, transfer: Array, lengths: Pair) -> None:
        self._transfer, self.lengths = DeviceTable(transfer), lengths

    def apply(self, fields: Array) -> Array:
        """Return the convolution of fields of shape (2, ny, nx), padded by zeros, cut back to their own shape."""
        factors, xp, (my, _) = self._transfer.as_like(fields), namespace(fields), self.lengths
        upper = my // 2 + 1

        def multiply(spectrum: Any, columns: slice) -> None:
            for rows, sign in ((slice(0, upper), 1), (slice(upper, my), -1)):
                part = factors[:, :, columns]
                if sign < 0:
                    part = xp.flip(part[:, 1 : my - upper + 1, :], axis=1)
                x, y, across = spectrum[0, rows, :], spectrum[1, rows, :], sign * part[1, :, :]
                along_x = part[0, :, :] * x + across * y
                spectrum[1, rows, :] = part[2, :, :] * y + across * x
                spectrum[0, rows, :] = along_x

        return filtered(fields, multiply, self.lengths)


def _convolution(transfer: Array, lengths: Pair) -> Convolution | TensorConvolution:
    return Convolution(transfer, lengths) if transfer.ndim == 2 else TensorConvolution(transfer, lengths)


def _pair(lengths: Sequence[int]) -> Pair:
    y, x = lengths
    return y, x
