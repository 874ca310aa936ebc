"""Kernels and their signatures: the annotations of a function say what it is called with.

The types of LLVM's function and those of the call from Python are both made of these annotations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Annotated, Any, NamedTuple, get_type_hints

from roughcontact.kernels.values import ELEMENTS, Condition, Index, Memory, Number

__all__ = [
    "Double",
    "Doubles",
    "Flags",
    "Indices",
    "KernelDefinition",
    "Parameter",
    "Scalar",
    "Vector",
    "kernel",
]

Scalar = Annotated[Number, "precision"]  # of the precision that the kernel is written for
Vector = Annotated[Memory[Number], "precision"]
Double = Annotated[Number, "float64"]
Doubles = Annotated[Memory[Number], "float64"]
Indices = Annotated[Memory[Index], "int64"]
Flags = Annotated[Memory[Condition], "bool"]  # a byte each, as NumPy has them


class Parameter(NamedTuple):
    """What a kernel takes: an array or a single number, and of which type."""

    array: bool
    dtype: str  # NumPy's name, or "precision"

    def of(self, precision: str) -> Parameter:
        """Return the parameter of a kernel that is written for a precision."""
        return self._replace(dtype=precision) if self.dtype == "precision" else self

    @property
    def llvm(self) -> Any:
        """The type in LLVM."""
        element = ELEMENTS[self.dtype][0]
        return element.as_pointer() if self.array else element

    @property
    def slot(self) -> str:
        """How eight bytes hold it in a call from Python, for `struct`: an address and an index alike, or a number."""
        return "q" if self.array or self.dtype == "int64" else "d"


_PARAMETERS: dict[Any, Parameter] = {
    Index: Parameter(False, "int64"),
    Scalar: Parameter(False, "precision"),
    Double: Parameter(False, "float64"),
    Vector: Parameter(True, "precision"),
    Doubles: Parameter(True, "float64"),
    Indices: Parameter(True, "int64"),
    Flags: Parameter(True, "bool"),
}


@dataclass(frozen=True, slots=True)
class KernelDefinition:
    """A function that writes machine code.

    Attributes
    ----------
    body : function
        Takes the `Code` to write to, then its parameters. Each is annotated by `Index` or one of the types above, or by
        a NamedTuple of such, which stands for its fields one after the other. What it takes only by keyword is fixed
        when it is written, by another kernel that calls it. One whose name begins with an underscore is for others, and
        takes its arguments as machine code does.
    """

    body: Callable[..., None]

    @property
    def name(self) -> str:
        """The function's own."""
        return self.body.__name__

    @property
    def packed(self) -> bool:
        """Whether it takes its arguments as a call from Python packs them."""
        return not self.name.startswith("_")

    def parameters(self, precision: str) -> tuple[Parameter, ...]:
        """Return the parameters one after the other.

        Raises
        ------
        TypeError
            If an annotation is none of those above.
        """
        return tuple(p.of(precision) for a in self._annotations() for p in _flattened(a))

    def arguments(self, values: Iterator[Any]) -> list[Any]:
        """Return the arguments of the body, of one value for each of the parameters."""
        return [_built(annotation, values) for annotation in self._annotations()]

    def _annotations(self) -> list[Any]:
        code = self.body.__code__
        hints = get_type_hints(self.body, include_extras=True)
        return [hints[name] for name in code.co_varnames[1 : code.co_argcount]]


def kernel(body: Callable[..., None]) -> KernelDefinition:
    """Make a function a kernel; used as a decorator."""
    return KernelDefinition(body)


def _flattened(annotation: Any) -> Iterator[Parameter]:
    if annotation in _PARAMETERS:
        yield _PARAMETERS[annotation]
    elif isinstance(annotation, type) and issubclass(annotation, tuple):
        for field in _fields(annotation):
            yield from _flattened(field)
    else:
        raise TypeError(f"{annotation} is no type of a kernel's parameter")


def _fields(annotation: Any) -> list[Any]:
    return list(get_type_hints(annotation, include_extras=True).values())


def _built(annotation: Any, values: Iterator[Any]) -> Any:
    if annotation in _PARAMETERS:
        return next(values)
    return annotation(*(_built(field, values) for field in _fields(annotation)))
