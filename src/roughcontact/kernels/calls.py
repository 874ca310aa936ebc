"""The one layer that calls machine code: kernels take NumPy's arrays as they are, and nobody else knows addresses."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.distributed import local

if TYPE_CHECKING:
    from roughcontact.kernels.signature import Parameter

__all__ = ["Function", "Operand", "address"]


class Operand:
    """An array whose address is found once: a function takes it as it takes the array, in less time.

    Attributes
    ----------
    field : array
        Of one in slabs the address is that of its rows on this process.
    """

    __slots__ = ("dtype", "field", "pointer")

    def __init__(self, field: Any) -> None:
        self.field, self.dtype, self.pointer = field, field.dtype, _pointer(local(field))


class Function:
    """A kernel in machine code. What it works on lives as long as it does.

    Raises
    ------
    TypeError
        Before the call: if arguments are more or fewer than the parameters, an array has another type of numbers than
        the kernel's or they do not lie one after the other, or a single number is none.
    """

    __slots__ = ("_count", "_run", "name")

    def __init__(self, name: str, parameters: Sequence[Parameter], place: int) -> None:
        self.name, self._count = name, len(parameters)
        types = [_ArrayOf(np.dtype(p.dtype)) if p.array else p.ctype for p in parameters]
        self._run = ctypes.CFUNCTYPE(None, *types)(place)  # type: ignore[arg-type]

    def __call__(self, *arguments: Any) -> None:
        """Run it; that arrays are as large as the kernel asks for is not checked."""
        if len(arguments) != self._count:
            raise TypeError(f"{self.name} takes {self._count} arguments, not {len(arguments)}")
        try:
            self._run(*arguments)
        except ctypes.ArgumentError as error:
            raise TypeError(f"{self.name}: {error}") from None


@dataclass(frozen=True, slots=True)
class _ArrayOf:
    """A parameter of a kernel: arrays of one type of numbers, of which the call takes the address."""

    dtype: np.dtype[Any]

    def from_param(self, argument: Any) -> Any:
        """Return what ctypes passes on; it asks so for each argument."""
        if not isinstance(argument, (Operand, np.ndarray)):
            raise TypeError(f"an array of {self.dtype} is needed, not {type(argument).__name__}")
        # A solve makes some hundred calls: types of numbers are compared by identity first.
        if argument.dtype is not self.dtype and argument.dtype != self.dtype:
            raise TypeError(f"an array of {self.dtype} is needed, not one of {argument.dtype}")
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
