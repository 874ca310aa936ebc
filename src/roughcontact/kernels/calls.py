"""The one layer that calls machine code: kernels take NumPy's arrays as they are, and nobody else knows addresses."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from roughcontact.kernels.signature import Parameter

__all__ = ["Function", "Operand", "address"]


class Operand:
    """An array whose address is found once: a function takes it as it takes the array, in less time.

    Attributes
    ----------
    field : array
    """

    __slots__ = ("dtype", "field", "pointer")

    def __init__(self, field: npt.NDArray[Any]) -> None:
        self.field, self.dtype, self.pointer = field, field.dtype, _pointer(field)


class Function:
    """A kernel in machine code. What it works on lives as long as it does.

    Raises
    ------
    TypeError
        Before the call: if arguments are more or fewer than the parameters, an array has another type of numbers than
        the kernel's or they do not lie one after the other, or a single number is none.
    """

    __slots__ = ("_dtypes", "_run", "name")

    def __init__(self, name: str, parameters: Sequence[Parameter], place: int) -> None:
        self.name = name
        self._dtypes = [np.dtype(p.dtype) if p.array else None for p in parameters]
        self._run = ctypes.CFUNCTYPE(None, *(p.ctype for p in parameters))(place)

    def __call__(self, *arguments: Any) -> None:
        """Run it; that arrays are as large as the kernel asks for is not checked."""
        if len(arguments) != len(self._dtypes):
            raise TypeError(f"{self.name} takes {len(self._dtypes)} arguments, not {len(arguments)}")
        # A solve makes some hundred calls: types of numbers are compared by identity first.
        given = [
            argument
            if dtype is None
            else argument.pointer
            if type(argument) is Operand and argument.dtype is dtype
            else self._checked(argument, dtype)
            for argument, dtype in zip(arguments, self._dtypes, strict=True)
        ]
        try:
            self._run(*given)
        except ctypes.ArgumentError as error:
            raise TypeError(f"{self.name}: {error}") from None

    def _checked(self, argument: Any, dtype: np.dtype[Any]) -> Any:
        if not isinstance(argument, (Operand, np.ndarray)) or argument.dtype != dtype:
            kind = getattr(argument, "dtype", type(argument).__name__)
            raise TypeError(f"an argument of {self.name} must be an array of {dtype}, not {kind}")
        return argument.pointer if isinstance(argument, Operand) else _pointer(argument)


def address(array: npt.NDArray[Any]) -> int:
    """Return where an array begins."""
    return int(array.__array_interface__["data"][0])


def _pointer(array: Any) -> Any:
    """Return what a call takes for an array, and what keeps it alive meanwhile."""
    try:
        return ctypes.byref(ctypes.c_char.from_buffer(array))
    except (TypeError, ValueError):  # read only or empty: a slower way
        if not array.flags.c_contiguous:
            raise TypeError("a kernel takes arrays whose numbers lie one after the other") from None
        return ctypes.c_void_p(address(array))
