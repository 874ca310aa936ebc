"""Fast Fourier transforms of real fields, and their convolutions with even kernels.

They use machine code if there is some for a field, otherwise the transforms of the field's library.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from roughcontact.arrays import DeviceTable, is_numpy, namespace, require_floating
from roughcontact.errors import InputError
from roughcontact.kernels import buffers, loader
from roughcontact.kernels.compiled_convolution import CompiledConvolution
from roughcontact.kernels.plane_plan import fits
from roughcontact.slabs.exchange import filtered_in_slabs, is_in_slabs
from roughcontact.slabs.rows import Edges
from roughcontact.slabs.slab_convolution import SlabConvolution
from roughcontact.threads import limit_threads, spread, threads
from roughcontact.validation import Array

__all__ = [
    *("Convolution", "convolve", "even_multiplier", "fast_even_length", "filtered", "padded_length"),
    "workers_for",
]

Pair = tuple[int, int]

# Columns of the padded spectrum that are transformed, multiplied and transformed back in one go: few enough
# to stay in a core's cache, which halves the time of a product (benchmarks/transforms.py).
SLAB = 32
ROWS = 2**18  # cells of the padded rows that are transformed together
LARGE = 2**19  # cells of a transform from which several threads are faster
CELLS = 2**15  # of a slab: if there are few rows, as on a line, more columns are transformed together
FEWEST_ROWS = 8  # that machine code transforms together


class Convolution:
    """A product with an even kernel for fields of any library, in double or single precision.

    Parameters
    ----------
    multiplier : array, shape (My//2 + 1, Mx//2 + 1), or function
        Real transform of the kernel, rows and columns from 0 up, as `even_multiplier` returns it. A function takes
        columns, a slice, and returns these columns: for a plane in slabs, each process makes only its part.
    lengths : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the fields.
    """

    __slots__ = ("_dealt", "_multiplier", "_ready", "_table", "lengths")

    def __init__(self, multiplier: Array | Callable[[slice], Array], lengths: Pair) -> None:
        self.lengths = lengths
        self._multiplier: Array | Callable[[slice], Array] | None = multiplier
        self._table: DeviceTable | None = None
        self._ready: dict[tuple[tuple[int, ...], np.dtype[Any]], Any] = {}
        # For planes in slabs; None if not all processes have machine code for them.
        self._dealt: dict[tuple[Edges, int, np.dtype[Any]], SlabConvolution | None] = {}

    def apply(self, field: Array) -> Array:
        """Return the convolution of a field, padded by zeros to `lengths`, on the cells of the field."""
        ready = self._ready.get((field.shape, field.dtype)) if is_numpy(field) else None
        if ready is None:
            if is_in_slabs(field):
                return self._in_slabs(field)
            if is_numpy(field) and field.dtype.kind in "biu":
                return self.apply(field.astype(np.float64))
            if not _in_machine_code(field, self.lengths):
                if self._table is None:
                    self._table = DeviceTable(self._kernel())
                return convolve(field, self._table.as_like(field), self.lengths)
            ready = self._prepare((field.shape[0], field.shape[1]), field.dtype)
        answer: Array = ready.apply(field)
        return answer

    def _prepare(self, shape: Pair, dtype: np.dtype[Any]) -> Any:
        """Return the machine code for fields of one shape and precision."""
        if shape[0] > self.lengths[0] or shape[1] > self.lengths[1]:
            raise InputError(f"a field of shape {shape} is larger than transforms of {self.lengths}")
        ready = CompiledConvolution.of(self._kernel(), shape, self.lengths, dtype.name)
        self._ready[shape, dtype] = ready
        if dtype == np.float64:
            self._multiplier = None  # planes are large: keep only one copy
        return ready

    def _in_slabs(self, field: Any) -> Array:
        buffers.release()  # planes in slabs are large, and the exchange of columns needs memory
        kind = field.edges, field.functions.rank, field.dtype
        if kind not in self._dealt:
            self._dealt[kind] = self._deal(field)
        ready = self._dealt[kind]
        if ready is not None:
            return ready.apply(field)  # type: ignore[return-value]

        def multiply(spectrum: Any, columns: slice) -> None:
            _multiply_even(spectrum, self._columns(columns).astype(field.dtype, copy=False))

        return filtered_in_slabs(field, multiply, self.lengths)  # type: ignore[return-value]

    def _deal(self, field: Any) -> SlabConvolution | None:
        """Return the machine code for planes in slabs like this one; None if a process has none."""
        require_floating(field)
        periodic, tall = field.shape == self.lengths, field.shape[0] >= FEWEST_ROWS
        here = periodic and tall and fits(self.lengths) and loader.takes(field.local)
        if not all(field.functions.communicator.allgather(here)):
            return None
        edges, rank = field.edges, field.functions.rank
        return SlabConvolution.of(self._columns, self.lengths, field.dtype.name, edges, rank)

    def _columns(self, part: slice) -> Array:
        """Return some columns of the multiplier."""
        given = self._multiplier
        columns: Array = given(part) if callable(given) else self._kernel()[:, part]
        return columns

    def _kernel(self) -> Array:
        """Return the multiplier; from its copy in double precision if only that is left."""
        multiplier = self._multiplier  # another thread may drop it meanwhile
        if callable(multiplier):
            self._multiplier = multiplier = multiplier(slice(None))
        if multiplier is not None:
            return multiplier
        found: Array = next(
            ready.kernel() for (_, dtype), ready in list(self._ready.items()) if dtype == np.float64
        )
        return found


def padded_length(cells: int) -> int:
    """Return the length of a transform without wrap-around for `cells` cells: at least ``2 cells - 2``.

    Offsets ``cells - 1`` and ``-(cells - 1)`` may share a place, because the kernel is even.
    """
    if cells < FEWEST_ROWS:
        return fast_even_length(2 * cells - 2)
    return 4 * fast_even_length(-(-(2 * cells - 2) // 4))


def _in_machine_code(field: Array, lengths: Pair) -> bool:
    if not is_numpy(field) or field.ndim != 2 or field.shape[0] < FEWEST_ROWS or not loader.takes(field):
        return False
    return fits(lengths)


def fast_even_length(least: int) -> int:
    """Return the next even length from `least` up that has only the prime factors 2, 3 and 5."""
    import scipy.fft

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
        Real, because the kernel is even; further rows repeat in reverse.
    """
    import scipy.fft

    ny, nx = (m // 2 + 1 for m in padded)
    even = np.zeros((ny, nx))
    even[: table.shape[0], : table.shape[1]] = table
    return np.asarray(scipy.fft.dctn(even, type=1, overwrite_x=True))


def convolve(field: Array, multiplier: DeviceTable | Array, padded: tuple[int, int]) -> Array:
    """Return the convolution of `field`, padded by zeros to `padded`, on the cells of the field.

    Parameters
    ----------
    field : array, shape (ny, nx)
        Of any library, on any device, in double or single precision; the result is of the same kind.
    multiplier : array or DeviceTable, shape (My//2 + 1, Mx//2 + 1)
        Real transform of an even kernel, as `even_multiplier` returns it.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.
    """
    factors = multiplier.as_like(field) if isinstance(multiplier, DeviceTable) else multiplier

    def multiply(spectrum: Any, columns: slice) -> None:
        _multiply_even(spectrum, factors[:, columns])

    return filtered(field, multiply, padded)


def _multiply_even(spectrum: Any, factors: Any) -> None:
    upper = factors.shape[0]
    spectrum[:upper, :] *= factors
    spectrum[upper:, :] *= namespace(factors).flip(factors[1 : spectrum.shape[0] - upper + 1, :], axis=0)


def workers_for(lengths: tuple[int, int]) -> int:
    """Return the number of threads of a transform."""
    return threads() if lengths[0] * lengths[1] >= LARGE else 1


def filtered(field: Array, multiply: Callable[[Any, slice], None], padded: tuple[int, int]) -> Array:
    """Return `field`, padded by zeros to `padded`, with its spectrum multiplied, on the cells of the field.

    Parameters
    ----------
    field : array, shape (..., ny, nx)
        One field or several, of any library.
    multiply : function
        It takes columns of the spectrum, shape ``(..., My, n)``, and their places among the ``Mx//2 + 1`` columns, and
        multiplies them in place.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.

    Notes
    -----
    On the host only the rows that hold data are transformed along x, and the padded columns exist for one slab at a
    time.
    """
    if is_numpy(field):
        return _on_host(field, multiply, padded)
    xp, (*_, ny, nx) = namespace(field), field.shape
    spectrum = xp.fft.rfftn(field, s=padded, axes=(-2, -1))
    multiply(spectrum, slice(None))
    return xp.fft.irfftn(spectrum, s=padded, axes=(-2, -1))[..., :ny, :nx]  # type: ignore[no-any-return]


def _on_host(field: Array, multiply: Callable[[Any, slice], None], padded: tuple[int, int]) -> Array:
    import scipy.fft

    *_, ny, nx = field.shape
    my, mx = padded
    workers = workers_for(padded)
    if my == ny:  # no part of the spectrum is empty
        spectrum = scipy.fft.rfft(field, n=mx, axis=-1, workers=workers)
        spectrum = scipy.fft.fft(spectrum, axis=-2, overwrite_x=True, workers=workers)
        multiply(spectrum, slice(None))
        spectrum = scipy.fft.ifft(spectrum, axis=-2, overwrite_x=True, workers=workers)
        whole: Array = scipy.fft.irfft(spectrum, n=mx, axis=-1, overwrite_x=True, workers=workers)
        return whole if mx == nx else np.ascontiguousarray(whole[..., :nx])
    # Rows and columns are padded a few at a time, so that the padded plane never exists as a whole.
    kind = np.complex64 if field.dtype == np.float32 else np.complex128
    spectrum = np.empty((*field.shape[:-1], mx // 2 + 1), kind)
    answer = np.empty(field.shape, spectrum.real.dtype)

    def along_rows(part: slice) -> None:
        spectrum[..., part, :] = scipy.fft.rfft(field[..., part, :], n=mx, axis=-1)

    def along_columns(part: slice) -> None:
        column = scipy.fft.fft(spectrum[..., part], n=my, axis=-2)
        multiply(column, part)
        spectrum[..., part] = scipy.fft.ifft(column, axis=-2, overwrite_x=True)[..., :ny, :]

    def back_along_rows(part: slice) -> None:
        whole = scipy.fft.irfft(spectrum[..., part, :], n=mx, axis=-1, overwrite_x=True)
        answer[..., part, :] = whole[..., :nx]

    rows = _parts(ny, max(1, ROWS // mx))
    with limit_threads(workers):
        spread(along_rows, rows)
        spread(along_columns, _parts(spectrum.shape[-1], max(SLAB, CELLS // my)))
        spread(back_along_rows, rows)
    return answer


def _parts(length: int, size: int) -> list[slice]:
    return [slice(start, start + size) for start in range(0, length, size)]
