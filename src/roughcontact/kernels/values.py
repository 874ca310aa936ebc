"""What the small language speaks of: numbers, whole numbers, and where they lie in memory.

Operators on them do not compute: they write down what is to be computed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from llvmlite import ir

__all__ = ["FLAG", "INDEX", "Flags", "Index", "Indices", "Number", "Reals", "constant"]

INDEX = ir.IntType(64)
FLAG = ir.IntType(8)  # a truth value in memory, as NumPy has it
_FUSE = ("contract",)  # a product and a sum may be one instruction; nothing else may change


@dataclass(frozen=True, slots=True)
class Number:
    """A real number, or one in each lane."""

    value: Any
    builder: Any

    def _with(self, other: Number | float) -> Any:
        return other.value if isinstance(other, Number) else constant(self.value.type, other)

    def __add__(self, other: Number | float) -> Number:
        return Number(self.builder.fadd(self.value, self._with(other), flags=_FUSE), self.builder)

    def __sub__(self, other: Number | float) -> Number:
        return Number(self.builder.fsub(self.value, self._with(other), flags=_FUSE), self.builder)

    def __mul__(self, other: Number | float) -> Number:
        return Number(self.builder.fmul(self.value, self._with(other), flags=_FUSE), self.builder)

    def __neg__(self) -> Number:
        return Number(self.builder.fneg(self.value), self.builder)

    def larger(self, other: Number) -> Number:
        """Return the larger of two numbers."""
        larger = self.builder.fcmp_ordered(">", self.value, other.value)
        return Number(self.builder.select(larger, self.value, other.value), self.builder)

    def is_below(self, limit: Number | float) -> Any:
        """Return the condition that a number is below another, lane by lane."""
        return self.builder.fcmp_ordered("<", self.value, self._with(limit))

    def is_at_most(self, limit: Number) -> Any:
        """Return the condition that a number is no more than another, lane by lane."""
        return self.builder.fcmp_ordered("<=", self.value, limit.value)

    def is_not_zero(self) -> Any:
        """Return the condition that a single number is not zero."""
        return self.builder.fcmp_unordered("!=", self.value, constant(self.value.type, 0.0))

    def replaced(self, value: float) -> Number:
        """Return another number, in as many lanes."""
        return Number(self._with(value), self.builder)

    def where(self, condition: Any, other: float = 0.0) -> Number:
        """Return the number where a condition holds, else another."""
        return Number(self.builder.select(condition, self.value, self._with(other)), self.builder)

    def where_not(self, condition: Any) -> Number:
        """Return the number where a condition does not hold, else zero."""
        return Number(self.builder.select(condition, self._with(0.0), self.value), self.builder)

    def sign(self) -> Number:
        """Return one for what is more than nothing, else zero."""
        return self.replaced(1.0).where(self.is_more_than(0.0))

    def is_more_than(self, limit: Number | float) -> Any:
        """Return the condition that a number is more than another, lane by lane."""
        return self.builder.fcmp_ordered(">", self.value, self._with(limit))

    def in_double(self) -> Number:
        """Return the number in double precision."""
        return self._converted(ir.DoubleType(), self.builder.fpext)

    def rounded_to(self, real: Any) -> Number:
        """Return the number, of double precision, in that of a type."""
        return self._converted(real, self.builder.fptrunc)

    def _converted(self, real: Any, convert: Callable[[Any, Any], Any]) -> Number:
        kind = self.value.type
        lanes = isinstance(kind, ir.VectorType)
        if (kind.element if lanes else kind) == real:
            return self
        return Number(convert(self.value, ir.VectorType(real, kind.count) if lanes else real), self.builder)


@dataclass(frozen=True, slots=True)
class Index:
    """A whole number."""

    value: Any
    builder: Any

    def _with(self, other: Index | int) -> Any:
        return other.value if isinstance(other, Index) else ir.Constant(INDEX, other)

    def __add__(self, other: Index | int) -> Index:
        return Index(self.builder.add(self.value, self._with(other)), self.builder)

    def __sub__(self, other: Index | int) -> Index:
        return Index(self.builder.sub(self.value, self._with(other)), self.builder)

    def __mul__(self, other: Index | int) -> Index:
        return Index(self.builder.mul(self.value, self._with(other)), self.builder)

    def __floordiv__(self, other: Index | int) -> Index:
        return Index(self.builder.sdiv(self.value, self._with(other)), self.builder)

    def __le__(self, other: Index | int) -> Any:
        return self.builder.icmp_signed("<=", self.value, self._with(other))

    def equals(self, other: Index | int) -> Any:
        """Return the condition that two whole numbers are the same."""
        return self.builder.icmp_signed("==", self.value, self._with(other))

    def __neg__(self) -> Index:
        return Index(self.builder.neg(self.value), self.builder)

    def size(self) -> Index:
        """Return the number without its sign."""
        return Index(self.builder.select(self <= -1, (-self).value, self.value), self.builder)

    def smaller(self, other: Index) -> Index:
        """Return the smaller of two whole numbers."""
        return Index(self.builder.select(self <= other, self.value, other.value), self.builder)


@dataclass(frozen=True, slots=True)
class Indices:
    """Whole numbers in memory."""

    pointer: Any
    builder: Any

    def __getitem__(self, at: Index) -> Index:
        return Index(self.builder.load(self.place(at)), self.builder)

    def put(self, at: Index, number: Index) -> None:
        """Write a whole number."""
        self.builder.store(number.value, self.place(at))

    def place(self, at: Index) -> Any:
        """Return where a number lies."""
        return self.builder.gep(self.pointer, [at.value])


@dataclass(frozen=True, slots=True)
class Reals:
    """Real numbers in memory, that are taken one at a time, or as many as there are lanes."""

    pointer: Any
    builder: Any
    lanes: Any
    size: int  # bytes of one

    def at(self, start: Index) -> Reals:
        """Return those that begin at an index."""
        return Reals(self.builder.gep(self.pointer, [start.value]), self.builder, self.lanes, self.size)

    def take(self, at: Index) -> Number:
        """Return the numbers from an index on, one in each lane."""
        found = self.builder.load(self._place(at))
        found.align = self.size
        return Number(found, self.builder)

    def put(self, at: Index, number: Number) -> None:
        """Write a number, or those of all lanes, from an index on."""
        if isinstance(number.value.type, ir.VectorType):
            self.builder.store(number.value, self._place(at)).align = self.size
        else:
            self.builder.store(number.value, self.builder.gep(self.pointer, [at.value]))

    def take_one(self, at: Index) -> Number:
        """Return a single number."""
        return Number(self.builder.load(self.builder.gep(self.pointer, [at.value])), self.builder)

    def take_for_all(self, at: Index) -> Number:
        """Return a single number, in each lane."""
        return Number(spread_out(self.take_one(at).value, self.lanes, self.builder), self.builder)

    def _place(self, at: Index) -> Any:
        return self.builder.bitcast(self.builder.gep(self.pointer, [at.value]), self.lanes.as_pointer())


@dataclass(frozen=True, slots=True)
class Flags:
    """Truth values in memory, a byte each."""

    pointer: Any
    builder: Any
    count: int  # of lanes

    def take(self, at: Index) -> Any:
        """Return the conditions from an index on, one in each lane."""
        found = self.builder.load(self._place(at))
        found.align = 1
        return self.builder.icmp_unsigned("!=", found, ir.Constant(found.type, None))

    def take_one(self, at: Index) -> Any:
        """Return a single condition."""
        found = self.builder.load(self.builder.gep(self.pointer, [at.value]))
        return self.builder.icmp_unsigned("!=", found, ir.Constant(FLAG, 0))

    def put(self, at: Index, condition: Any) -> None:
        """Write a condition, or those of all lanes, from an index on."""
        if isinstance(condition.type, ir.VectorType):
            bytes_ = self.builder.zext(condition, ir.VectorType(FLAG, self.count))
            self.builder.store(bytes_, self._place(at)).align = 1
        else:
            self.builder.store(self.builder.zext(condition, FLAG), self.builder.gep(self.pointer, [at.value]))

    def _place(self, at: Index) -> Any:
        lanes = ir.VectorType(FLAG, self.count)
        return self.builder.bitcast(self.builder.gep(self.pointer, [at.value]), lanes.as_pointer())


def constant(kind: Any, value: float) -> Any:
    """Return a constant of a type, in each lane if it has some."""
    return ir.Constant(kind, [float(value)] * kind.count if isinstance(kind, ir.VectorType) else float(value))


def spread_out(value: Any, lanes: Any, builder: Any) -> Any:
    """Return lanes that all have the same value."""
    nothing = ir.Constant(lanes, ir.Undefined)
    first = builder.insert_element(nothing, value, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(
        first, nothing, ir.Constant(ir.VectorType(ir.IntType(32), lanes.count), None)
    )
