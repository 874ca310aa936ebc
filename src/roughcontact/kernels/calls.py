"""The one layer that calls machine code: kernels take NumPy's arrays as they are; addresses stay in this file."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from roughcontact.kernels.signature import Parameter

__all__ = ["Function", "Operand", "address"]


class Threads(Protocol):
    """What runs kernels, by several threads or one."""

    def gather(self, workers: int) -> None:
        """Call `workers` threads, this one among them."""

    def running(self, kernel: int) -> Callable[[bytes, int], None]:
        """Return what runs a kernel at an address."""


class Operand:
    """An array whose address is found once: a function takes it as it takes the array, in less time.

    Attributes
    ----------
    field : array
    """

    __slots__ = ("address", "dtype", "field")

    def __init__(self, field: npt.NDArray[Any]) -> None:
        self.field, self.dtype, self.address = field, field.dtype, _address(field, field.dtype)

    def __reduce__(self) -> tuple[type[Operand], tuple[Any]]:
        """Return what makes a copy, which lies elsewhere."""
        return Operand, (self.field,)


class Function:
    """A kernel in machine code.

    Parameters
    ----------
    name : str
    parameters : sequence of Parameter
    place : int
        Its address.
    team : Threads
        The threads that run it.

    Raises
    ------
    TypeError
        Before the call: if arguments are more or fewer than the parameters, an array has another type of numbers than
        the kernel's or they do not lie one after the other, or a single number is not a number.
    """

    __slots__ = ("_arrays", "_pack", "_run", "_team", "name")

    def __init__(self, name: str, parameters: Sequence[Parameter], place: int, team: Threads) -> None:
        self.name, self._team, self._run = name, team, team.running(place)
        self._arrays = [np.dtype(p.dtype) if p.array else None for p in parameters]
        self._pack = struct.Struct("=" + "".join(p.slot for p in parameters)).pack

    def __call__(self, *arguments: Any, workers: int = 1) -> None:
        """Run it, by `workers` threads if it shares work; that arrays are as large as it asks for is not checked."""
        if len(arguments) != len(self._arrays):
            raise TypeError(f"{self.name} takes {len(self._arrays)} arguments, not {len(arguments)}")
        slots = []
        try:
            # A solve makes some hundred calls: what is usual is found out first.
            for given, wanted in zip(arguments, self._arrays, strict=True):
                if wanted is None:
                    slots.append(given)
                elif given.__class__ is Operand and given.dtype is wanted:
                    slots.append(given.address)
                else:
                    slots.append(_address(given, wanted))
            packed = self._pack(*slots)
        except (TypeError, struct.error) as error:
            raise TypeError(f"{self.name}: {error}") from None
        if workers > 1:
            self._team.gather(workers)
        self._run(packed, workers)


def _address(given: Any, wanted: np.dtype[Any]) -> int:
    """Return where an array of a type begins."""
    if not isinstance(given, (Operand, np.ndarray)):
        raise TypeError(f"an array of {wanted} is needed, not {type(given).__name__}")
    if given.dtype != wanted:
        raise TypeError(f"an array of {wanted} is needed, not one of {given.dtype}")
    if isinstance(given, Operand):
        return given.address
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(given))  # type: ignore[arg-type]
    except (TypeError, ValueError):  # read only or empty: a slower way
        if not given.flags.c_contiguous:
            raise TypeError("a kernel takes arrays whose numbers lie one after the other") from None
        return address(given)


def address(array: npt.NDArray[Any]) -> int:
    """Return where an array begins."""
    return int(array.__array_interface__["data"][0])
