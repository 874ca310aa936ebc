"""Arrays of any library: their devices, their functions, and copies on their devices."""

from __future__ import annotations

from typing import Any

import array_api_compat
import numpy as np

from roughcontact.errors import InputError
from roughcontact.kernels import buffers
from roughcontact.validation import Array

__all__ = [
    "DeviceTable",
    "as_like",
    "divide",
    "inner",
    "is_array",
    "is_numpy",
    "max_abs",
    "multiply",
    "namespace",
    "on_host",
    "require_floating",
    "require_no_unit",
    "require_numpy",
    "subtract",
    "wants_gradient",
]


def namespace(array: Any) -> Any:
    """Return the functions for an array by the names of the array API standard: NumPy, CuPy, PyTorch, ..."""
    if isinstance(array, np.ndarray):
        require_no_unit(array)
        return np
    return array_api_compat.array_namespace(array)


def is_array(value: Any) -> bool:
    """Whether a value is an array of a library that follows the array API standard, NumPy or another."""
    if isinstance(value, np.ndarray):
        return True
    return bool(array_api_compat.is_array_api_obj(value))


def is_numpy(array: Any) -> bool:
    """Whether an array is on the host, where SciPy supports it."""
    return isinstance(array, np.ndarray)


def require_numpy(field: object, method: str) -> None:
    """Raise a TypeError for an array of another library, for which `method` would return an array of NumPy."""
    if not isinstance(field, np.ndarray):
        raise TypeError(f"{method} supports only arrays of NumPy; use 'fft' for those of {type(field)}")


def require_no_unit(field: Any) -> None:
    """Raise a ValueError for an array of astropy, because NumPy's functions would drop its unit."""
    if type(field) is not np.ndarray and isinstance(field, np.ndarray) and hasattr(field, "unit"):
        raise InputError(
            f"a field is read as plain SI numbers, not in {field.unit}", "give its numbers", place="field"
        )


def require_floating(field: Any) -> None:
    """Raise a ValueError for whole numbers in an array of a library other than NumPy, which converts them itself."""
    if is_numpy(field) or namespace(field).isdtype(field.dtype, ("real floating", "complex floating")):
        return
    raise InputError(
        f"a field must hold floating numbers, not {field.dtype}", "convert it to float64", place="field"
    )


def wants_gradient(array: Any) -> bool:
    """Whether a library would record operations on an array, to differentiate them."""
    return bool(getattr(array, "requires_grad", False))


def on_host(array: Any) -> Array:
    """Return an array in NumPy's memory, for files and pictures; the same array if it is there already."""
    if isinstance(array, np.ndarray):
        return array
    if array_api_compat.is_cupy_array(array):
        return np.asarray(array.get(), dtype=np.float64)
    torch = array_api_compat.is_torch_array(array)
    host = "cpu" if torch else namespace(array).__array_namespace_info__().default_device()
    here = array_api_compat.to_device(array, host)
    xp = namespace(here)
    return np.asarray(xp.astype(here, xp.float64, copy=False))  # NumPy lacks some precisions


def as_like(values: Array, array: Any) -> Any:
    """Return an array of the host in the library, on the device and in the precision of `array`."""
    if isinstance(array, np.ndarray):
        return values
    return namespace(array).asarray(values, dtype=array.dtype, device=array_api_compat.device(array))


def inner(a: Any, b: Any) -> float:
    """Return the sum of the products of the entries of two arrays."""
    return float(np.vdot(a, b)) if isinstance(a, np.ndarray) else float(namespace(a).sum(a * b))


def max_abs(array: Any) -> float:
    """Return max(abs(array)); NaN if any entry is NaN."""
    if isinstance(array, np.ndarray):
        return max(float(array.max()), -float(array.min()))
    xp = namespace(array)
    return max(float(xp.max(array)), -float(xp.min(array)))


def divide(values: Any, unit: float, precision: str) -> Any:
    """Return an array divided by a unit, in "float32" or "float64"."""
    if isinstance(values, np.ndarray):
        answer = buffers.empty(values.shape, precision)
        return np.divide(values, unit, out=answer, dtype=np.float64, casting="same_kind")
    xp = namespace(values)
    return xp.astype(values / unit, getattr(xp, precision))


def subtract(values: Any, number: Any) -> Any:
    """Return an array minus a number, in the precision of the array if it is floating."""
    if isinstance(values, np.ndarray) and values.dtype.kind == "f":
        return np.subtract(values, number, out=buffers.empty(values.shape, values.dtype), casting="same_kind")
    return values - number


def multiply(values: Any, unit: float) -> Any:
    """Return an array times a unit, in double precision."""
    if isinstance(values, np.ndarray):
        return np.multiply(values, unit, out=buffers.empty(values.shape, np.float64), dtype=np.float64)
    xp = namespace(values)
    return unit * xp.astype(values, xp.float64)


class DeviceTable:
    """A table on the host, and its copies on the devices of the arrays that it is multiplied with."""

    __slots__ = ("_copies", "host")

    def __init__(self, host: Array) -> None:
        self.host = host
        self._copies: dict[Any, Any] = {}

    def as_like(self, array: Any) -> Any:
        """Return the table in the library, on the device and in the precision of `array`.

        Raises
        ------
        ValueError
            If an array of a library other than NumPy does not hold floating numbers. NumPy converts whole numbers
            itself.
        """
        if isinstance(array, np.ndarray) and (array.dtype == self.host.dtype or array.dtype.kind in "biu"):
            return self.host
        require_floating(array)
        device = array_api_compat.device(array)
        key = (type(array), str(device), str(array.dtype))
        if key not in self._copies:
            self._copies[key] = namespace(array).asarray(self.host, dtype=array.dtype, device=device)
        return self._copies[key]
