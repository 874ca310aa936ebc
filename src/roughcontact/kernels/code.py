"""The kernel language: loops over numbers, many at a time, which LLVM translates to machine code.

A function is written by running Python: its loops run once, and their bodies are written down. Numbers come in
lanes: those that a processor takes in one instruction. README.md beside this file shows how.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, Generic, TypeVar

from llvmlite import binding, ir

from roughcontact.kernels.constants import APART, PHASES, WIDTH
from roughcontact.kernels.signature import KernelDefinition, Parameter, Vector
from roughcontact.kernels.values import (
    ELEMENTS,
    INDEX,
    Condition,
    Index,
    Memory,
    Number,
    broadcast,
    constant,
)

__all__ = ["Code", "Local"]

T = TypeVar("T", Number, Index)

# What a kernel is given that is called from Python: its arguments in eight bytes each, counters, and the thread.
PACKED = (INDEX.as_pointer(), INDEX.as_pointer(), INDEX)
# The instruction for a thread that waits for memory to change: LLVM's names, and their arguments.
ISB = "llvm.aarch64.isb", (ir.Constant(ir.IntType(32), 15),)
PAUSES = {"x86_64": ("llvm.x86.sse2.pause", ()), "aarch64": ISB, "arm64": ISB}


@dataclass(frozen=True, slots=True)
class Local(Generic[T]):
    """A number, or an index, that changes."""

    place: Any
    first: T

    def get(self) -> T:
        """Return what it is."""
        return replace(self.first, value=self.first.builder.load(self.place))

    def set(self, value: T) -> None:
        """Make it another."""
        value.builder.store(value.value, self.place)


class Code:
    """A function that is being written.

    Attributes
    ----------
    precision : {"float32", "float64"}
        Of its real numbers.
    count : int
        Lanes: numbers of that precision in a register.
    thread : Index
        Number of the thread that runs it, from 0, in a kernel that is called from Python.
    """

    def __init__(self, module: Any, kernel: KernelDefinition, precision: str, **known: Any) -> None:
        parameters = kernel.parameters(precision)
        kind = ir.FunctionType(ir.VoidType(), PACKED if kernel.packed else [p.llvm for p in parameters])
        self.precision, (self._real, size) = precision, ELEMENTS[precision]
        self.count = WIDTH // size
        self.function = ir.Function(module, kind, _name(kernel, precision, known))
        self._variables = ir.IRBuilder(self.function.append_basic_block("variables"))
        start = self.function.append_basic_block("start")
        self.builder = builder = ir.IRBuilder(start)
        given: Any = self.function.args
        if kernel.packed:
            packed, self._counters, thread = given
            self.thread = Index(thread, builder)
            given = [_unpacked(packed, place, p, builder) for place, p in enumerate(parameters)]
        values: list[Any] = []
        for parameter, value in zip(parameters, given, strict=True):
            if parameter.array:
                values.append(Memory(value, builder, parameter.dtype, self.count))
            else:
                values.append((Index if parameter.dtype == "int64" else Number)(value, builder))
        kernel.body(self, *kernel.arguments(iter(values)), **known)
        self._variables.branch(start)
        builder.ret_void()

    def index(self, value: int) -> Index:
        """Return an index."""
        return Index(ir.Constant(INDEX, value), self.builder)

    def number(self, value: float) -> Number:
        """Return a single number."""
        return Number(constant(self._real, value), self.builder)

    def lanes(self, value: float | Number) -> Number:
        """Return a number in each lane."""
        number = value if isinstance(value, Number) else self.number(value)
        return Number(broadcast(number.value, self.count, self.builder), self.builder)

    def any(self, condition: Condition) -> Condition:
        """Return the condition that one holds in some lane, or by itself."""
        if not isinstance(condition.value.type, ir.VectorType):
            return condition
        bits = ir.IntType(self.count)
        found = self.builder.icmp_unsigned(
            "!=", self.builder.bitcast(condition.value, bits), ir.Constant(bits, 0)
        )
        return Condition(found, self.builder)

    def each(self, n: Index) -> Iterator[Index]:
        """Loop over numbers, as many at once as there are lanes, the rest one by one; the body is written twice."""
        whole = n // self.count * self.count
        for at in self.range(0, whole, self.count):
            yield at.lanes
        yield from self.range(whole, n)

    def variable(self, first: T) -> Local[T]:
        """Return what changes, and what it is at first."""
        found = Local(self._variables.alloca(first.value.type), first)
        found.set(first)
        return found

    def range(self, start: Index | int, stop: Index | int, step: Index | int = 1) -> Iterator[Index]:
        """Loop over indices; the body is written once."""
        builder, (first, last, by) = self.builder, (self._index(k) for k in (start, stop, step))
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

    def shared(self, phase: int, parts: Index) -> Iterator[Index]:
        """Loop over parts of the work of a phase, which all threads share that run the kernel; go on when all are done.

        Each takes the next part that is left: a thread that comes late finds less to do, or nothing. Phases are
        numbered in turn; for each there are two counters, in separate lines of the cache.
        """
        counters: Memory[Index] = Memory(self._counters, self.builder, "int64", self.count)
        taken, done = (self.index((2 * phase + k) * APART) for k in range(2))
        part = self.variable(counters.add(taken, 1))
        for _ in self.repeated(lambda: part.get() < parts):
            yield part.get()
            counters.add(done, 1)
            part.set(counters.add(taken, 1))
        for _ in self.repeated(lambda: counters.current(done) < parts):
            self.pause()

    def repeated(self, condition: Callable[[], Condition]) -> Iterator[None]:
        """Loop as long as a condition holds; it and the body are written once."""
        builder = self.builder
        head, body, after = (builder.append_basic_block(name) for name in ("head", "body", "after"))
        builder.branch(head)
        builder.position_at_end(head)
        builder.cbranch(condition().value, body, after)
        builder.position_at_end(body)
        yield
        builder.branch(head)
        builder.position_at_end(after)

    def pause(self) -> None:
        """Wait a moment, where another thread is waited for."""
        name, given = PAUSES.get(binding.get_default_triple().partition("-")[0], ("", ()))
        if name:
            kind, module = ir.FunctionType(ir.VoidType(), [x.type for x in given]), self.function.module
            self.builder.call(module.globals.get(name) or ir.Function(module, kind, name), given)

    def call_system(self, function: Index, number: Index) -> None:
        """Call a function of the system, of which the address is known, on a number of 32 bits."""
        word = ir.IntType(32)
        kind = ir.FunctionType(ir.VoidType(), [word]).as_pointer()
        place = self.builder.inttoptr(function.value, kind)
        self.builder.call(place, [self.builder.trunc(number.value, word)])

    def new_counters(self) -> Index:
        """Return the address of counters for all phases of a kernel, in this function's own memory."""
        counters = self._variables.alloca(ir.ArrayType(INDEX, 2 * PHASES * APART))
        self.builder.store(ir.Constant(counters.type.pointee, None), counters)
        return Index(self.builder.ptrtoint(counters, INDEX), self.builder)

    def run(self, kernel: Index, packed: Index, counters: Index, thread: Index) -> None:
        """Run the kernel at an address on packed arguments: those of all threads that share its work."""
        kind = ir.FunctionType(ir.VoidType(), PACKED).as_pointer()
        given = (self.builder.inttoptr(x.value, PACKED[0]) for x in (packed, counters))
        self.builder.call(self.builder.inttoptr(kernel.value, kind), [*given, thread.value])

    @contextmanager
    def when(self, condition: Condition) -> Iterator[None]:
        """Do what is in the context only where a single condition holds."""
        with self.builder.if_then(condition.value):
            yield

    def call(self, other: KernelDefinition, *arguments: Any, **known: Any) -> None:
        """Call another kernel of this module and precision, which is written if it is not yet."""
        module, name = self.function.module, _name(other, self.precision, known)
        function = module.globals.get(name) or Code(module, other, self.precision, **known).function
        self.builder.call(function, [*_operands(arguments)])

    def across(self, number: Number, combine: Callable[[Number, Number], Number]) -> Number:
        """Return what all lanes make together."""
        values = [
            Number(self.builder.extract_element(number.value, ir.Constant(ir.IntType(32), k)), self.builder)
            for k in range(self.count)
        ]
        return reduce(combine, values)

    def transpose(
        self, source: Vector, at: Index, down: Index, target: Vector, to: Index, across: Index
    ) -> None:
        """Copy a square of as many rows as there are lanes, transposed.

        Its rows begin at `at` and each `down` further, those of the copy at `to` and each `across` further.
        """
        n, builder = self.count, self.builder
        rows = []
        for _ in range(n):
            rows.append(source[at.lanes].value)
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
            target[to.lanes] = Number(row, builder)
            to = to + across

    def _index(self, value: Index | int) -> Index:
        return value if isinstance(value, Index) else self.index(value)


def _unpacked(packed: Any, place: int, parameter: Parameter, builder: Any) -> Any:
    """Return an argument that a call from Python has packed."""
    value = builder.load(builder.gep(packed, [ir.Constant(INDEX, place)]))
    if parameter.array:
        return builder.inttoptr(value, parameter.llvm)
    if parameter.dtype == "int64":
        return value
    number = builder.bitcast(value, ir.DoubleType())
    return number if parameter.dtype == "float64" else builder.fptrunc(number, parameter.llvm)


def _name(kernel: KernelDefinition, precision: str, known: dict[str, Any]) -> str:
    return "_".join(map(str, (kernel.name, *known.values(), precision)))


def _operands(arguments: tuple[Any, ...]) -> Iterator[Any]:
    for argument in arguments:
        if isinstance(argument, tuple):
            yield from _operands(argument)
        else:
            yield argument.pointer if isinstance(argument, Memory) else argument.value
