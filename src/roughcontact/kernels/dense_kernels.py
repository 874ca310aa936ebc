"""Small dense systems whose unknowns are deactivated until no pressure is tensile: one call for all rounds."""

from __future__ import annotations

from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import CHUNK
from roughcontact.kernels.signature import Indices, Scalar, Vector, kernel
from roughcontact.kernels.values import Index, Number, maximum, where


class System(NamedTuple):
    """Symmetric matrix of n unknowns, the right side beside one that is 1, and the unknowns that are kept.

    After these comes how many they are.
    """

    n: Index
    matrix: Vector
    right: Vector
    kept: Indices


class Work(NamedTuple):
    """Parts of one piece of memory, n + 6 rows of `stride` numbers: a multiple of the lanes, and at least n + 2.

    The first n are those of the matrix and of both right sides; then come the reciprocal pivots, the factors of a row,
    both solutions, the pressure, and what is found: the depth, the largest deviation of ``A a`` from 1, and 1 if the
    matrix is definite, otherwise 0.
    """

    rows: Vector
    stride: Index
    pivots: Vector
    factors: Vector
    a: Vector
    b: Vector
    pressure: Vector
    found: Vector


@kernel
def influence_between(
    code: Code, n: Index, rows: Indices, columns: Indices, table: Vector, width: Index, matrix: Vector
) -> None:
    """Write the matrix between n cells, from a table at offsets from zero up whose rows are `width` numbers apart."""
    for i in code.range(0, n):
        for j in code.range(0, n):
            matrix[i * n + j] = table[abs(rows[i] - rows[j]) * width + abs(columns[i] - columns[j])]


@kernel
def press_cells(
    code: Code, system: System, memory: Vector, stride: Index, area: Scalar, prescribed: Scalar
) -> None:
    """Solve ``A a = 1`` and ``A b = right`` on the kept cells until ``p = depth a - b`` is positive on all of them.

    `area` is that of a cell where `prescribed` is the force, and zero where it is the depth.
    """
    n, kept = system.n, system.kept
    parts = (memory + (n + k) * stride for k in range(6))
    work = Work(memory, stride, *parts)
    zero, again, found, p = code.index(0), code.variable(code.index(1)), work.found, work.pressure
    kept[n], found[zero] = n, prescribed
    for _ in code.repeated(lambda: again.get().equals(1)):
        again.set(zero)
        m = kept[n]
        code.call(_eliminate, system, work)
        code.call(_substitute_back, work, m)
        sums = [code.variable(code.number(0.0)) for _ in range(2)]
        for i in code.range(0, m):
            for total, numbers in zip(sums, (work.a, work.b), strict=True):
                total.set(total.get() + numbers[i])
        with code.when(area > 0.0):
            found[zero] = (prescribed + sums[1].get() * area) / (sums[0].get() * area)
        stays = code.variable(zero)
        for i in code.range(0, m):
            p[i] = found[zero] * work.a[i] - work.b[i]
            stays.set(stays.get() + where(p[i] > 0.0, code.index(1), 0))
        some = (zero < stays.get()) & (stays.get() < m) & (found[code.index(2)] > 0.0)
        with code.when(some):
            again.set(code.index(1))
            kept[n] = zero
            for i in code.range(0, m):
                with code.when(p[i] > 0.0):
                    kept[kept[n]] = kept[i]
                    kept[n] = kept[n] + 1
    code.call(_deviate, system, work)


@kernel
def _eliminate(code: Code, system: System, work: Work) -> None:
    """Reduce the kept rows, and both right sides beside them, to a triangle."""
    rows, count, two, m = work.rows, code.count, code.index(2), system.kept[system.n]
    width = (m + 1 + count) // count * count
    work.found[two] = 1.0
    for i in code.range(0, m):
        first, row = i // count * count, i * work.stride
        for j in code.range(first, m):
            rows[row + j] = system.matrix[system.kept[i] * system.n + system.kept[j]]
        rows[row + m] = 1.0
        rows[row + m + 1] = system.right[system.kept[i]]
        for j in code.range(m + 2, width):
            rows[row + j] = 0.0
        for k in code.range(0, i):
            work.factors[k] = -(rows[k * work.stride + i] * work.pivots[k])
        many = first + (width - first) // (CHUNK * count) * (CHUNK * count)
        for start, stop, chunk in ((first, many, CHUNK), (many, width, 1)):
            for at in code.range(start, stop, chunk * count):
                places = [at + k * count for k in range(chunk)]
                totals = [code.variable(rows[(row + place).lanes]) for place in places]
                for k in code.range(0, i):
                    factor = work.factors[k]
                    for total, place in zip(totals, places, strict=True):
                        total.set(total.get() + rows[(k * work.stride + place).lanes] * factor)
                for total, place in zip(totals, places, strict=True):
                    rows[(row + place).lanes] = total.get()
        pivot = rows[row + i]
        with code.when(~(pivot > 0.0)):
            work.found[two] = 0.0
        work.pivots[i] = code.number(1.0) / pivot


@kernel
def _substitute_back(code: Code, work: Work, m: Index) -> None:
    """Solve the triangle for both right sides."""
    width = (m + 1 + code.count) // code.count * code.count
    for at in code.range(0, width, code.count):
        work.a[at.lanes] = 0.0
        work.b[at.lanes] = 0.0
    for done in code.range(0, m):
        i = m - done - 1
        row, solutions = i * work.stride, (work.a, work.b)
        totals = [code.variable(code.lanes(0.0)) for _ in solutions]
        for at in code.range(
            i // code.count * code.count, width, code.count
        ):  # unknowns up to i are zero yet
            for total, known in zip(totals, solutions, strict=True):
                total.set(total.get() + work.rows[(row + at).lanes] * known[at.lanes])
        for side, (total, known) in enumerate(zip(totals, solutions, strict=True)):
            known[i] = (work.rows[row + m + side] - code.across(total.get(), Number.__add__)) * work.pivots[i]


@kernel
def _deviate(code: Code, system: System, work: Work) -> None:
    """Leave the largest deviation of ``A a`` from 1 on the kept cells."""
    whole, m = work.b, system.kept[system.n]
    for i in code.range(0, system.n):
        whole[i] = 0.0
    for i in code.range(0, m):
        whole[system.kept[i]] = work.a[i]
    most = code.variable(code.number(0.0))
    for i in code.range(0, m):
        lanes, single = code.variable(code.lanes(0.0)), code.variable(code.number(0.0))
        for j in code.each(system.n):
            total = lanes if j.wide else single
            total.set(total.get() + system.matrix[system.kept[i] * system.n + j] * whole[j])
        deviation = code.across(lanes.get(), Number.__add__) + single.get() - 1.0
        most.set(maximum(abs(deviation), most.get()))
    work.found[code.index(1)] = most.get()
