"""The values of the kernel language: numbers, conditions, indices, and memory that holds them.

Operators on them do not compute: they write down what the code will compute. A number, or a condition, is a single
one or one in each lane; where both kinds meet, the single one is broadcast.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar, cast

from llvmlite import ir

__all__ = [
    "ELEMENTS",
    "INDEX",
    "Condition",
    "Index",
    "Memory",
    "Number",
    "broadcast",
    "constant",
    "maximum",
    "where",
]

INDEX = ir.IntType(64)
# By NumPy's name: the type in memory, and the bytes of one.
ELEMENTS = {
    "float32": (ir.FloatType(), 4),
    "float64": (ir.DoubleType(), 8),
    "int64": (INDEX, 8),
    "bool": (ir.IntType(8), 1),
}
_FUSE = ("contract",)  # a product and a sum may be one instruction; nothing else may change

T = TypeVar("T", bound="Number | Index | Condition")


@dataclass(frozen=True, slots=True)
class Condition:
    """A truth value, or one in each lane."""

    value: Any
    builder: Any

    def __and__(self, other: Condition) -> Condition:
        return Condition(self.builder.and_(self.value, other.value), self.builder)

    def __or__(self, other: Condition) -> Condition:
        return Condition(self.builder.or_(self.value, other.value), self.builder)

    def __invert__(self) -> Condition:
        return Condition(self.builder.not_(self.value), self.builder)


@dataclass(frozen=True, slots=True)
class Number:
    """A real number, or one in each lane."""

    value: Any
    builder: Any

    def __add__(self, other: Number | float) -> Number:
        return Number(self.builder.fadd(*_aligned(self, other), flags=_FUSE), self.builder)

    def __sub__(self, other: Number | float) -> Number:
        return Number(self.builder.fsub(*_aligned(self, other), flags=_FUSE), self.builder)

    def __mul__(self, other: Number | float) -> Number:
        return Number(self.builder.fmul(*_aligned(self, other), flags=_FUSE), self.builder)

    def __truediv__(self, other: Number | float) -> Number:
        return Number(self.builder.fdiv(*_aligned(self, other), flags=_FUSE), self.builder)

    def __neg__(self) -> Number:
        return Number(self.builder.fneg(self.value), self.builder)

    def __abs__(self) -> Number:
        return maximum(self, -self)

    def __lt__(self, other: Number | float) -> Condition:
        return self._compared("<", other)

    def __le__(self, other: Number | float) -> Condition:
        return self._compared("<=", other)

    def __gt__(self, other: Number | float) -> Condition:
        return self._compared(">", other)

    def is_nonzero(self) -> Condition:
        """Return the condition that a number is not zero; NaN is not."""
        return Condition(self.builder.fcmp_unordered("!=", *_aligned(self, 0.0)), self.builder)

    def heaviside(self) -> Number:
        """Return 1 where the number is positive, otherwise 0."""
        return where(self > 0.0, self.filled(1.0), 0.0)

    def filled(self, value: float) -> Number:
        """Return a constant of the same type."""
        return Number(constant(self.value.type, value), self.builder)

    def to(self, dtype: str) -> Number:
        """Return the number in a precision, rounded if need be."""
        kind, (wanted, size) = self.value.type, ELEMENTS[dtype]
        lanes = isinstance(kind, ir.VectorType)
        given = kind.element if lanes else kind
        if given == wanted:
            return self
        convert = self.builder.fpext if size == 8 else self.builder.fptrunc
        return Number(
            convert(self.value, ir.VectorType(wanted, kind.count) if lanes else wanted), self.builder
        )

    def double(self) -> Number:
        """Return the number in double precision."""
        return self.to("float64")

    def _compared(self, sign: str, other: Number | float) -> Condition:
        return Condition(self.builder.fcmp_ordered(sign, *_aligned(self, other)), self.builder)


@dataclass(frozen=True, slots=True, eq=False)
class Index:
    """A whole number; as a place in memory that of one number, or of the first of one in each lane."""

    value: Any
    builder: Any
    wide: bool = False

    @property
    def lanes(self) -> Index:
        """The same index, of a number for each lane."""
        return replace(self, wide=True)

    def __add__(self, other: Index | int) -> Index:
        return self._with(other, self.builder.add)

    def __sub__(self, other: Index | int) -> Index:
        return self._with(other, self.builder.sub)

    def __mul__(self, other: Index | int) -> Index:
        return self._with(other, self.builder.mul)

    def __floordiv__(self, other: Index | int) -> Index:
        return self._with(other, self.builder.sdiv)

    def __mod__(self, other: Index | int) -> Index:
        return self._with(other, self.builder.srem)

    def __neg__(self) -> Index:
        return Index(self.builder.neg(self.value), self.builder)

    def __abs__(self) -> Index:
        return where(self < 0, -self, self)

    def __lt__(self, other: Index | int) -> Condition:
        return self._compared("<", other)

    def __le__(self, other: Index | int) -> Condition:
        return self._compared("<=", other)

    def equals(self, other: Index | int) -> Condition:
        """Return the condition that two indices are the same."""
        return self._compared("==", other)

    def min(self, other: Index) -> Index:
        """Return the smaller of two indices."""
        return where(self <= other, self, other)

    def _with(self, other: Index | int, operation: Callable[[Any, Any], Any]) -> Index:
        wide = self.wide or (isinstance(other, Index) and other.wide)
        return Index(operation(*_aligned(self, other)), self.builder, wide)

    def _compared(self, sign: str, other: Index | int) -> Condition:
        return Condition(self.builder.icmp_signed(sign, *_aligned(self, other)), self.builder)


@dataclass(frozen=True, slots=True)
class Memory(Generic[T]):
    """Values of one type that lie one after the other; of lanes, they need not begin anywhere in particular."""

    pointer: Any
    builder: Any
    dtype: str
    count: int  # of lanes

    def __add__(self, start: Index) -> Memory[T]:
        return replace(self, pointer=self.place(start))

    def __getitem__(self, at: Index) -> T:
        found = self.builder.load(self._typed(at))
        if at.wide:
            found.align = ELEMENTS[self.dtype][1]
        if self.dtype == "int64":
            return cast("T", Index(found, self.builder))
        if self.dtype == "bool":
            set_ = self.builder.icmp_unsigned("!=", found, ir.Constant(found.type, None))
            return cast("T", Condition(set_, self.builder))
        return cast("T", Number(found, self.builder))

    def __setitem__(self, at: Index, value: T | float) -> None:
        element, size = ELEMENTS[self.dtype]
        kind = ir.VectorType(element, self.count) if at.wide else element
        stored: Any
        if isinstance(value, Number):
            stored = value.to(self.dtype).value
            stored = broadcast(stored, self.count, self.builder) if at.wide else stored
        elif isinstance(value, Condition):
            stored = self.builder.zext(value.value, kind)
        elif isinstance(value, Index):
            stored = value.value
        else:
            stored = constant(kind, value)
        instruction = self.builder.store(stored, self._typed(at))
        if at.wide:
            instruction.align = size

    def add(self: Memory[Index], at: Index, number: int) -> Index:
        """Add to an index that other threads look at as well, and return what it was."""
        return self._exchanged("add", at, number)

    def swap(self: Memory[Index], at: Index, number: int) -> Index:
        """Make it another, and return what it was."""
        return self._exchanged("xchg", at, number)

    def current(self: Memory[Index], at: Index) -> Index:
        """Return what it is now."""
        return Index(self.builder.load_atomic(self.place(at), "seq_cst", 8), self.builder)

    def _exchanged(self: Memory[Index], operation: str, at: Index, number: int) -> Index:
        value = ir.Constant(INDEX, number)
        return Index(self.builder.atomic_rmw(operation, self.place(at), value, "seq_cst"), self.builder)

    def place(self, at: Index) -> Any:
        """Return the address of a value."""
        return self.builder.gep(self.pointer, [at.value])

    def _typed(self, at: Index) -> Any:
        if not at.wide:
            return self.place(at)
        lanes = ir.VectorType(ELEMENTS[self.dtype][0], self.count)
        return self.builder.bitcast(self.place(at), lanes.as_pointer())


def maximum(a: Number, b: Number) -> Number:
    """Return the larger of two numbers; the second where one is NaN."""
    return where(a > b, a, b)


V = TypeVar("V", Number, Index, Memory[Number])


def where(condition: Condition, one: V, other: V | float) -> V:
    """Return one value, or memory, where a condition holds, otherwise the other."""
    found: Any
    if isinstance(one, Memory):
        memory = one.builder.select(condition.value, one.pointer, cast("Any", other).pointer)
        found = replace(one, pointer=memory)
    else:
        found = replace(one, value=one.builder.select(condition.value, *_aligned(one, other)))
    return cast("V", found)


def constant(kind: Any, value: float) -> Any:
    """Return a constant of a type, in each lane if it has some."""
    lanes = isinstance(kind, ir.VectorType)
    number = value if (kind.element if lanes else kind) == INDEX else float(value)
    return ir.Constant(kind, [number] * kind.count if lanes else number)


def broadcast(value: Any, count: int, builder: Any) -> Any:
    """Return a value in each of `count` lanes; as it is if it has lanes."""
    if isinstance(value.type, ir.VectorType):
        return value
    nothing = ir.Constant(ir.VectorType(value.type, count), ir.Undefined)
    first = builder.insert_element(nothing, value, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(first, nothing, ir.Constant(ir.VectorType(ir.IntType(32), count), None))


def _aligned(one: Any, other: Any) -> tuple[Any, Any]:
    """Return two values as ones of the same type."""
    if not isinstance(other, Number | Index):
        return one.value, constant(one.value.type, other)
    values = [one.value, other.value]
    counts = [v.type.count for v in values if isinstance(v.type, ir.VectorType)]
    if counts:
        values = [broadcast(v, counts[0], one.builder) for v in values]
    a, b = values
    if a.type != b.type:
        raise TypeError(f"{a.type} meets {b.type} in a kernel: convert one of them")
    return a, b
