"""A small language for loops over numbers, many at a time, which LLVM translates to machine code.

A function is written by running Python: its loops run once, and what their bodies say is written down. Numbers come in
lanes, as many as a processor takes in one instruction.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, Generic, TypeVar, overload

from llvmlite import ir

from roughcontact.kernels.constants import APART, WIDTH
from roughcontact.kernels.values import (
    FLAG,
    INDEX,
    Flags,
    Index,
    Indices,
    Number,
    Reals,
    constant,
    spread_out,
)

__all__ = ["PRECISIONS", "Code", "Take", "Variable"]

PRECISIONS = {"float32": (ir.FloatType(), 4), "float64": (ir.DoubleType(), 8)}


T = TypeVar("T", Number, Index)


@dataclass(frozen=True, slots=True)
class Variable(Generic[T]):
    """A number, or a whole number, that changes."""

    place: Any
    first: T

    def get(self) -> T:
        """Return what it is."""
        return replace(self.first, value=self.first.builder.load(self.place))

    def set(self, value: T) -> None:
        """Make it another."""
        value.builder.store(value.value, self.place)


@dataclass(frozen=True, slots=True)
class Take:
    """What takes numbers from memory: one for each lane, or a single one."""

    code: Code
    lanes: bool

    def __call__(self, field: Reals | Flags, at: Index) -> Any:
        """Return the numbers, or conditions, from an index on."""
        return field.take(at) if self.lanes else field.take_one(at)

    def alike(self, number: Number) -> Number:
        """Return a number beside what is taken: in each lane, or as it is."""
        return self.code.for_all(number) if self.lanes else number


class Code:
    """A function that is being written; used as a context, which ends it.

    Parameters
    ----------
    module : llvmlite.ir.Module
        Where it goes.
    name : str
        Without the precision, which is added.
    precision : {"float32", "float64"}
        Of its real numbers.
    parameters : str
        Their kinds, separated by spaces: "index", "indices", "real", "reals", "double" and "doubles" of double
        precision whatever the others are, and "flags". The arguments are in `arguments`.
    """

    def __init__(self, module: Any, name: str, precision: str, parameters: str) -> None:
        real, size = PRECISIONS[precision]
        kinds = {
            "index": INDEX,
            "indices": INDEX.as_pointer(),
            "real": real,
            "reals": real.as_pointer(),
            "double": ir.DoubleType(),
            "doubles": ir.DoubleType().as_pointer(),
            "flags": FLAG.as_pointer(),
        }
        names = parameters.split()
        kind = ir.FunctionType(ir.VoidType(), [kinds[n] for n in names])
        self.count = WIDTH // size
        self.lanes = ir.VectorType(real, self.count)
        self.function = ir.Function(module, kind, f"{name}_{precision}")
        self._variables = ir.IRBuilder(self.function.append_basic_block("variables"))
        self._start = self.function.append_basic_block("start")
        self.builder = builder = ir.IRBuilder(self._start)

        def argument(name: str, value: Any) -> Any:
            if name == "index":
                return Index(value, builder)
            if name == "indices":
                return Indices(value, builder)
            if name in ("real", "double"):
                return Number(value, builder)
            if name == "flags":
                return Flags(value, builder, self.count)
            if name == "doubles":
                return Reals(value, builder, ir.VectorType(ir.DoubleType(), self.count), 8)
            return Reals(value, builder, self.lanes, size)

        self.arguments = [argument(n, v) for n, v in zip(names, self.function.args, strict=True)]

    def __enter__(self) -> Code:
        return self

    def __exit__(self, *_: object) -> None:
        self._variables.branch(self._start)
        self.builder.ret_void()

    def index(self, value: int) -> Index:
        """Return a whole number."""
        return Index(ir.Constant(INDEX, value), self.builder)

    def zero(self) -> Number:
        """Return zero in each lane."""
        return Number(constant(self.lanes, 0.0), self.builder)

    def one(self, value: float) -> Number:
        """Return a single number."""
        return Number(constant(self.lanes.element, value), self.builder)

    def any_not_zero(self, number: Number) -> Any:
        """Return the condition that one of the lanes is not zero."""
        found = self.builder.fcmp_unordered("!=", number.value, constant(self.lanes, 0.0))
        bits = ir.IntType(self.count)
        return self.builder.icmp_unsigned("!=", self.builder.bitcast(found, bits), ir.Constant(bits, 0))

    def either(self, one: Any, other: Any) -> Any:
        """Return the condition that one of two holds."""
        return self.builder.or_(one, other)

    def both(self, one: Any, other: Any) -> Any:
        """Return the condition that both of two hold."""
        return self.builder.and_(one, other)

    def opposite(self, one: Any) -> Any:
        """Return the condition that another does not hold."""
        return self.builder.not_(one)

    def for_all(self, number: Number) -> Number:
        """Return a number in each lane."""
        lanes = ir.VectorType(number.value.type, self.count)
        return Number(spread_out(number.value, lanes, self.builder), self.builder)

    def each(self, n: Index) -> Iterator[tuple[Index, Take]]:
        """Loop over numbers, as many at once as there are lanes, the rest one by one; the body is written twice."""
        whole = n // self.count * self.count
        for at in self.range(0, whole, self.count):
            yield at, Take(self, True)
        for at in self.range(whole, n):
            yield at, Take(self, False)

    def variable(self, first: T) -> Variable[T]:
        """Return what changes, and what it is at first."""
        found = Variable(self._variables.alloca(first.value.type), first)
        found.set(first)
        return found

    def range(self, start: Index | int, stop: Index | int, step: Index | int = 1) -> Iterator[Index]:
        """Loop over whole numbers; what the body says is written once."""
        builder, first = self.builder, self._index(start)
        last, by = self._index(stop), self._index(step)
        before = builder.block
        head, body, after = (builder.append_basic_block(name) for name in ("head", "body", "after"))
        builder.branch(head)
        builder.position_at_end(head)
        at = builder.phi(INDEX)
        at.add_incoming(first.value, before)
        builder.cbranch(builder.icmp_signed("<", at, last.value), body, after)
        builder.position_at_end(body)
        yield Index(at, builder)
        at.add_incoming(builder.add(at, by.value), builder.block)
        builder.branch(head)
        builder.position_at_end(after)

    def shared(self, counters: Indices, phase: int, parts: Index) -> Iterator[Index]:
        """Loop over parts of some work that other threads do with the same counters; go on when all parts are done.

        Each takes the next part that is left: whoever comes late finds less to do, or nothing. Counters are zero at
        first, and for each phase in turn there are two, in lines of the cache of their own.
        """
        builder = self.builder
        taken, done = (counters.place(self.index((2 * phase + k) * APART)) for k in range(2))
        one = ir.Constant(INDEX, 1)
        head, body, wait, after = (
            builder.append_basic_block(name) for name in ("head", "body", "wait", "after")
        )
        builder.branch(head)
        builder.position_at_end(head)
        part = builder.atomic_rmw("add", taken, one, "seq_cst")
        builder.cbranch(builder.icmp_signed("<", part, parts.value), body, wait)
        builder.position_at_end(body)
        yield Index(part, builder)
        builder.atomic_rmw("add", done, one, "seq_cst")
        builder.branch(head)
        builder.position_at_end(wait)
        all_done = builder.icmp_signed("==", builder.load_atomic(done, "seq_cst", 8), parts.value)
        builder.cbranch(all_done, after, wait)
        builder.position_at_end(after)

    @overload
    def choose(self, condition: Any, one: Reals, other: Reals) -> Reals: ...
    @overload
    def choose(self, condition: Any, one: Index | int, other: Index | int) -> Index: ...
    def choose(self, condition: Any, one: Any, other: Any) -> Reals | Index:
        """Return one whole number, or place in memory, where a condition holds, else the other."""
        if isinstance(one, Reals):
            return replace(one, pointer=self.builder.select(condition, one.pointer, other.pointer))
        a, b = self._index(one).value, self._index(other).value
        return Index(self.builder.select(condition, a, b), self.builder)

    @contextmanager
    def when(self, condition: Any) -> Iterator[None]:
        """Do what is in the context only where a condition holds."""
        with self.builder.if_then(condition):
            yield

    def call(self, other: Code, *arguments: Any) -> None:
        """Call another function."""
        self.builder.call(
            other.function,
            [a.pointer if isinstance(a, Reals | Indices | Flags) else a.value for a in arguments],
        )

    def across(self, number: Number, both: Callable[[Number, Number], Number]) -> Number:
        """Return what all lanes make together."""
        values = [
            Number(self.builder.extract_element(number.value, ir.Constant(ir.IntType(32), k)), self.builder)
            for k in range(self.count)
        ]
        return reduce(both, values)

    def transpose(
        self, source: Reals, at: Index, down: Index, target: Reals, to: Index, across: Index
    ) -> None:
        """Copy a square of as many rows as there are lanes, turned: rows become columns.

        Its rows begin at `at` and each `down` further, those of the copy at `to` and each `across` further.
        """
        n, builder = self.count, self.builder
        rows = []
        for _ in range(n):
            rows.append(source.take(at).value)
            at = at + down
        # Shuffle the rows like cards, number by number: the bits of the places go round by one, log2(n) times.
        positions = ir.VectorType(ir.IntType(32), n)
        low, high = (
            ir.Constant(positions, [x for k in half for x in (k, n + k)])
            for half in (range(n // 2), range(n // 2, n))
        )
        for _ in range(n.bit_length() - 1):
            pairs = zip(rows[: n // 2], rows[n // 2 :], strict=True)
            rows = [builder.shuffle_vector(a, b, mask) for a, b in pairs for mask in (low, high)]
        for row in rows:
            target.put(to, Number(row, builder))
            to = to + across

    def _index(self, value: Index | int) -> Index:
        return value if isinstance(value, Index) else self.index(value)
