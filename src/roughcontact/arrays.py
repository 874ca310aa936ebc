"""Arrays of any library, and fast Fourier transforms of real fields: the one file that knows the libraries."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import array_api_compat
import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.kernels import buffers as room
from roughcontact.threads import limit_threads, spread, threads

__all__ = [
    "Placed",
    "beside",
    "convolve",
    "even_multiplier",
    "fast_even_length",
    "filtered",
    "inner",
    "is_array",
    "is_numpy",
    "largest",
    "less",
    "namespace",
    "numbers",
    "on_host",
    "over",
    "require_floating",
    "require_numpy",
    "times",
    "wants_gradient",
]

Array = npt.NDArray[np.float64]

# Columns of the padded spectrum that are transformed, multiplied and transformed back in one go: few enough
# to stay in a core's cache, which halves the time of a product (benchmarks/transforms.py).
SLAB = 32
ROWS = 2**18  # cells of the padded rows that are transformed in one go
LARGE = 2**19  # cells of a transform from which on several threads are worth waking
CELLS = 2**15  # of a slab: of few rows, as on a line, more columns go at once


def namespace(array: Any) -> Any:
    """Return the functions for an array by the names of the array API standard: NumPy, CuPy, PyTorch, ..."""
    if isinstance(array, np.ndarray):
        return np
    return array_api_compat.array_namespace(array)


def is_array(value: Any) -> bool:
    """Whether a value is an array of a library that follows the array API standard, NumPy or another."""
    if isinstance(value, np.ndarray):
        return True
    return bool(array_api_compat.is_array_api_obj(value))


def is_numpy(array: Any) -> bool:
    """Whether an array lives on the host, where SciPy can work on it."""
    return isinstance(array, np.ndarray)


def require_numpy(field: object, method: str) -> None:
    """Raise a TypeError for an array of another library, whose sum by `method` would come back as one of NumPy."""
    if not isinstance(field, np.ndarray):
        raise TypeError(f"{method} is for NumPy's arrays; 'fft' is for those of {type(field)} too")


def require_floating(field: Any) -> None:
    """Raise a ValueError for an array of another library than NumPy, which converts itself, of whole numbers."""
    if is_numpy(field) or namespace(field).isdtype(field.dtype, ("real floating", "complex floating")):
        return
    raise ValueError(f"a field must hold floating numbers, not {field.dtype}: convert it to float64")


def wants_gradient(array: Any) -> bool:
    """Whether a library would record what is done to an array, to differentiate it."""
    return bool(getattr(array, "requires_grad", False))


def on_host(array: Any) -> Array:
    """Return an array in NumPy's memory, as it is if there already: for files and pictures, at the rim."""
    if isinstance(array, np.ndarray):
        return array
    if array_api_compat.is_cupy_array(array):
        return np.asarray(array.get(), dtype=np.float64)
    torch = array_api_compat.is_torch_array(array)
    host = "cpu" if torch else namespace(array).__array_namespace_info__().default_device()
    return np.asarray(array_api_compat.to_device(array, host), dtype=np.float64)


def beside(values: Array, array: Any) -> Any:
    """Return some numbers of the host in the library, on the device and in the precision of `array`."""
    if isinstance(array, np.ndarray):
        return values
    return namespace(array).asarray(values, dtype=array.dtype, device=array_api_compat.device(array))


def numbers(array: Any) -> Array:
    """Return the few entries of an array, such as the sums of its fields, on the host: each is fetched by itself."""
    if isinstance(array, np.ndarray):
        return array
    entries = namespace(array).reshape(array, (-1,))
    return np.array([float(entries[i]) for i in range(entries.shape[0])]).reshape(tuple(array.shape))


def inner(a: Any, b: Any) -> float:
    """Return the sum of the products of the entries of two arrays."""
    return float(np.vdot(a, b)) if isinstance(a, np.ndarray) else float(namespace(a).sum(a * b))


def largest(array: Any) -> float:
    """Return the largest size of an entry; not a number if one is none."""
    if isinstance(array, np.ndarray):
        return max(float(array.max()), -float(array.min()))
    xp = namespace(array)
    return max(float(xp.max(array)), -float(xp.min(array)))


def over(values: Any, unit: float, precision: str) -> Any:
    """Return floating numbers over a unit, in "float32" or "float64"."""
    if isinstance(values, np.ndarray):
        answer = room.empty(values.shape, precision)
        return np.divide(values, unit, out=answer, dtype=np.float64, casting="same_kind")
    xp = namespace(values)
    return xp.astype(values / unit, getattr(xp, precision))


def less(values: Any, number: Any) -> Any:
    """Return numbers less another, in their precision if they have one."""
    if isinstance(values, np.ndarray) and values.dtype.kind == "f":
        return np.subtract(values, number, out=room.empty(values.shape, values.dtype), casting="same_kind")
    return values - number


def times(values: Any, unit: float) -> Any:
    """Return floating numbers times a unit, in double precision."""
    if isinstance(values, np.ndarray):
        return np.multiply(values, unit, out=room.empty(values.shape, np.float64), dtype=np.float64)
    xp = namespace(values)
    return unit * xp.astype(values, xp.float64)


class Placed:
    """A table that was made on the host, and its copies beside the arrays that it is multiplied with."""

    __slots__ = ("_copies", "host")

    def __init__(self, host: Array) -> None:
        self.host = host
        self._copies: dict[Any, Any] = {}

    def beside(self, array: Any) -> Any:
        """Return the table in the library, on the device and in the precision of `array`.

        Raises
        ------
        ValueError
            If the array of another library than NumPy, which brings whole numbers up to the table's precision
            itself, holds no floating numbers.
        """
        if isinstance(array, np.ndarray) and (array.dtype == self.host.dtype or array.dtype.kind in "biu"):
            return self.host
        require_floating(array)
        device = array_api_compat.device(array)
        key = (type(array), str(device), str(array.dtype))
        if key not in self._copies:
            self._copies[key] = namespace(array).asarray(self.host, dtype=array.dtype, device=device)
        return self._copies[key]


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


def convolve(field: Array, multiplier: Placed | Array, padded: tuple[int, int]) -> Array:
    """Return the convolution of `field`, padded by zeros to `padded`, cut back to its own shape.

    Parameters
    ----------
    field : array, shape (ny, nx)
        Of any library, on any device, in double or single precision: so is the answer.
    multiplier : array or Placed array, shape (My//2 + 1, Mx//2 + 1)
        Real transform of an even kernel, as `even_multiplier` returns it.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.
    """
    factors = multiplier.beside(field) if isinstance(multiplier, Placed) else multiplier

    def multiply(spectrum: Any, columns: slice) -> None:
        _multiply_even(spectrum, factors[:, columns])

    return filtered(field, multiply, padded)


def _multiply_even(spectrum: Any, factors: Any) -> None:
    upper = factors.shape[0]
    spectrum[:upper, :] *= factors
    spectrum[upper:, :] *= namespace(factors).flip(factors[1 : spectrum.shape[0] - upper + 1, :], axis=0)


def _workers(lengths: tuple[int, int]) -> int:
    """Return how many threads a transform takes."""
    return threads() if lengths[0] * lengths[1] >= LARGE else 1


def filtered(field: Array, multiply: Callable[[Any, slice], None], padded: tuple[int, int]) -> Array:
    """Return `field`, padded by zeros to `padded`, with its spectrum multiplied, cut back to its own shape.

    Parameters
    ----------
    field : array, shape (..., ny, nx)
        Of any library, or several of them.
    multiply : function
        Takes columns of the spectrum, shape ``(..., My, n)``, and which ones of ``Mx//2 + 1`` they are, and multiplies
        them in place.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.

    Notes
    -----
    Only the rows that hold data are transformed along x, and on the host the padded columns exist for one slab at a
    time.
    """
    if is_numpy(field):
        return _on_host(field, multiply, padded)
    xp = namespace(field)
    (*_, ny, nx), (my, mx) = field.shape, padded
    spectrum = xp.fft.fft(xp.fft.rfft(field, n=mx, axis=-1), n=my, axis=-2)
    multiply(spectrum, slice(None))
    return xp.fft.irfft(xp.fft.ifft(spectrum, n=my, axis=-2)[..., :ny, :], n=mx, axis=-1)[..., :nx]  # type: ignore[no-any-return]


def _on_host(field: Array, multiply: Callable[[Any, slice], None], padded: tuple[int, int]) -> Array:
    *_, ny, nx = field.shape
    my, mx = padded
    workers = _workers(padded)
    if my == ny:  # no part of the spectrum is empty
        spectrum = scipy.fft.rfft(field, n=mx, axis=-1, workers=workers)
        spectrum = scipy.fft.fft(spectrum, axis=-2, overwrite_x=True, workers=workers)
        multiply(spectrum, slice(None))
        spectrum = scipy.fft.ifft(spectrum, axis=-2, overwrite_x=True, workers=workers)
        whole: Array = scipy.fft.irfft(spectrum, n=mx, axis=-1, overwrite_x=True, workers=workers)
        return whole if mx == nx else np.ascontiguousarray(whole[..., :nx])
    # Rows and columns are padded a few at a time: the padded plane is never there as a whole.
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
