"""The one layer that calls machine code: kernels take NumPy's arrays as they are, and nobody else knows addresses."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from roughcontact.kernels.signature import Parameter
    from roughcontact.kernels.team import Team

__all__ = ["Function", "Operand", "address"]


class Operand:
    """An array whose address is found once: a function takes it as it takes the array, in less time.

    Attributes
    ----------
    field : array
    """

    __slots__ = ("address", "dtype", "field")

    def __init__(self, field: npt.NDArray[Any]) -> None:
        self.field, self.dtype, self.address = field, field.dtype, _begin(field)

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
    team : Team
        The threads that run it.

    Raises
    ------
    TypeError
        Before the call: if arguments are more or fewer than the parameters, an array has another type of numbers than
        the kernel's or they do not lie one after the other, or a single number is none.
    """

    __slots__ = ("_arrays", "_pack", "_place", "_team", "name")

    def __init__(self, name: str, parameters: Sequence[Parameter], place: int, team: Team) -> None:
        self.name, self._place, self._team = name, place, team
        self._arrays = [np.dtype(p.dtype) if p.array else None for p in parameters]
        self._pack = struct.Struct("=" + "".join(p.slot for p in parameters)).pack

    def __call__(self, *arguments: Any, workers: int = 1) -> None:
        """Run it, by so many threads if it shares work; that arrays are as large as it asks for is not checked."""
        if len(arguments) != len(self._arrays):
            raise TypeError(f"{self.name} takes {len(self._arrays)} arguments, not {len(arguments)}")
        try:
            # A solve makes some hundred calls: what is usual is found out first.
            packed = self._pack(
                *[
                    given
                    if wanted is None
                    else given.address
                    if given.__class__ is Operand and given.dtype is wanted
                    else _address(given, wanted)
                    for given, wanted in zip(arguments, self._arrays, strict=True)
                ]
            )
        except (TypeError, struct.error) as error:
            raise TypeError(f"{self.name}: {error}") from None
        self._team.run(self._place, packed, workers)


def _address(given: Any, wanted: np.dtype[Any]) -> int:
    """Return where an array of a type begins."""
    if not isinstance(given, (Operand, np.ndarray)):
        raise TypeError(f"an array of {wanted} is needed, not {type(given).__name__}")
    if given.dtype != wanted:
        raise TypeError(f"an array of {wanted} is needed, not one of {given.dtype}")
    return given.address if isinstance(given, Operand) else _begin(given)


def address(array: npt.NDArray[Any]) -> int:
    """Return where an array begins."""
    return int(array.__array_interface__["data"][0])


def _begin(array: Any) -> int:
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(array))
    except (TypeError, ValueError):  # read only or empty: a slower way
        if not array.flags.c_contiguous:
            raise TypeError("a kernel takes arrays whose numbers lie one after the other") from None
        return address(array)
