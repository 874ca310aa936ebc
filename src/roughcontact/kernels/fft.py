"""Convolutions of real fields with even kernels, by fast Fourier transforms.

A field is taken through in three steps: along the rows, along the columns and back, and back along the rows. A column's
spectrum is multiplied where it lies, in digit-reversed order, so that nothing is ever sorted along columns; and as many
rows or columns as there are lanes go at once.

In between, spectra lie in blocks of columns: number ``((b * rows + y) * 2 + part) * lanes + l`` is the real or the
imaginary part of wave ``b * lanes + l`` of row y. Where the rows of a plane lie on several processes, each has such a
spectrum of its rows; every step is then a separate kernel, and whole columns consist of one piece from each process.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import HALF
from roughcontact.kernels.signature import Indices, Vector, kernel
from roughcontact.kernels.values import Index, Number, where

RADICES = (4, 2, 3, 5, HALF)


@dataclass(frozen=True, slots=True)
class Complex:
    """A complex number in each lane."""

    re: Number
    im: Number

    def __add__(self, other: Complex) -> Complex:
        return Complex(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        return Complex(self.re - other.re, self.im - other.im)

    def __mul__(self, other: Complex | float) -> Complex:
        if isinstance(other, Complex):
            return Complex(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
        return Complex(self.re * other, self.im * other)

    @property
    def times_minus_i(self) -> Complex:
        """The product with -i."""
        return Complex(self.im, -self.re)

    @property
    def conjugate(self) -> Complex:
        """The complex conjugate."""
        return Complex(self.re, -self.im)

    @property
    def swapped(self) -> Complex:
        """Both parts in each other's place: what makes a transform its inverse, before and after."""
        return Complex(self.im, self.re)


class Plan(NamedTuple):
    """A Fourier transform: radices and how many they are, twiddle factors of all sweeps, one after the other.

    Its waves come in digit-reversed order; at last, for each wave (of rows) or place (of columns), the index of the
    other.
    """

    length: Index
    radices: Indices
    sweeps: Index
    twiddles: Vector
    order: Indices


class RealField(NamedTuple):
    """A field, its rows and columns."""

    field: Vector
    ny: Index
    nx: Index


class IndexRange(NamedTuple):
    """The first, and the one after the last."""

    begin: Index
    end: Index


class BlockedSpectrum(NamedTuple):
    """The numbers, and the rows that there is memory for: the leading dimension."""

    numbers: Vector
    rows: Index


class ColumnPieces(NamedTuple):
    """Some blocks of whole columns, in pieces of some rows each, one spectrum after the other.

    The numbers, how many blocks and pieces; then, for each piece and after the last: its first row, and how many rows
    there is memory for before it.
    """

    numbers: Vector
    blocks: Index
    parts: Index
    edges: Indices
    places: Indices


class Scratch(NamedTuple):
    """Memory for each thread, `stride` numbers apart, and where that for what is in order begins in a thread's own."""

    memory: Vector
    stride: Index
    offset: Index

    def own(self, code: Code) -> Vector:
        """Return that of this thread."""
        return self.memory + code.thread * self.stride


class RowTransform(NamedTuple):
    """The spectrum; the transform of rows; how many of these are a part of the work.

    It covers half of the padded columns; neighbours are taken for complex numbers, and twiddle factors separate them.
    """

    spectrum: BlockedSpectrum
    plan: Plan
    pairs: Vector
    many: Index


class ColumnTransform(NamedTuple):
    """The columns; their transform; the multiplier, block by block; how many blocks are a part of the work."""

    pieces: ColumnPieces
    plan: Plan
    multiplier: Vector
    wide: Index


@kernel
def convolve(
    code: Code,
    field: Vector,
    answer: Vector,
    ny: Index,
    nx: Index,
    along: RowTransform,
    across: ColumnTransform,
    scratch: Scratch,
) -> None:
    """Transform rows, columns there and back with the multiplier in between, and rows back.

    Parameters: the field, the answer, rows and columns of both.
    """
    own = scratch.own(code)
    for some in _parts(code, 0, ny, along.many):
        code.call(_rows, RealField(field, ny, nx), some, along, own, scratch.offset, inverse=False)
    for some in _parts(code, 1, across.pieces.blocks, across.wide):
        code.call(_columns, some, across, own)
    for some in _parts(code, 2, ny, along.many):
        code.call(_rows, RealField(answer, ny, nx), some, along, own, scratch.offset, inverse=True)


@kernel
def transform_rows(code: Code, plane: RealField, along: RowTransform, scratch: Scratch) -> None:
    """Do only the first step of `convolve`."""
    for some in _parts(code, 0, plane.ny, along.many):
        code.call(_rows, plane, some, along, scratch.own(code), scratch.offset, inverse=False)


@kernel
def filter_columns(code: Code, across: ColumnTransform, scratch: Scratch) -> None:
    """Do only the second step."""
    for some in _parts(code, 0, across.pieces.blocks, across.wide):
        code.call(_columns, some, across, scratch.own(code))


@kernel
def transform_rows_back(code: Code, plane: RealField, along: RowTransform, scratch: Scratch) -> None:
    """Do only the third step."""
    for some in _parts(code, 0, plane.ny, along.many):
        code.call(_rows, plane, some, along, scratch.own(code), scratch.offset, inverse=True)


def _parts(code: Code, phase: int, count: Index, size: Index) -> Iterator[IndexRange]:
    """Loop over parts of `size` rows or blocks, which all threads share."""
    for part in code.shared(phase, (count + size - 1) // size):
        yield IndexRange(part * size, (part * size + size).min(count))


@kernel
def _transform(code: Code, x: Vector, plan: Plan, *, inverse: bool) -> None:
    """Transform columns of lanes, in place: from their order to the digit-reversed one; or back."""
    length = code.variable(code.index(1) if inverse else plan.length)
    for k in code.range(0, plan.sweeps):
        digit = plan.radices[plan.sweeps - 1 - k if inverse else k]
        radix = where(digit.equals(HALF), code.index(4), digit)
        m = length.get() if inverse else length.get() // radix
        whole = m * radix
        for r in RADICES:
            with code.when(digit.equals(r)):
                _sweep(code, x, plan, m, r, inverse=inverse)
        length.set(whole if inverse else m)


def _sweep(code: Code, x: Vector, plan: Plan, m: Index, digit: int, *, inverse: bool) -> None:
    radix, step = digit or 4, m * (2 * code.count)
    full, whole = 2 if digit == HALF else radix, m * radix
    start = (plan.length - whole) * 2  # before it lie the factors of the sweeps over longer parts
    for block in code.range(0, plan.length, whole):
        for j in code.range(0, m):
            first, factor = (block + j) * (2 * code.count), start + j * (2 * (radix - 1))
            twiddles = [_twiddle(code, plan.twiddles, factor + 2 * q) for q in range(radix - 1)]
            if inverse:
                a = [_load(code, x, first + step * q) for q in range(radix)]
                a = [a[0], *(w * t.conjugate for w, t in zip(a[1:], twiddles, strict=True))]
                a = [w.swapped for w in _butterfly([w.swapped for w in a])][:full]
            else:
                a = [_load(code, x, first + step * q) for q in range(full)]
                a = _half_butterfly(a) if digit == HALF else _butterfly(a)
                a = [a[0], *(w * t for w, t in zip(a[1:], twiddles, strict=True))]
            for q, number in enumerate(a):
                _store(code, x, first + step * q, number)


def _butterfly(a: Sequence[Complex]) -> list[Complex]:
    """Return the Fourier transform of a few numbers."""
    if len(a) == 2:
        return [a[0] + a[1], a[0] - a[1]]
    if len(a) == 3:
        both, apart = a[1] + a[2], ((a[1] - a[2]) * (sqrt(3) / 2)).times_minus_i
        middle = a[0] - both * 0.5
        return [a[0] + both, middle + apart, middle - apart]
    if len(a) == 4:
        even, odd = a[0] + a[2], a[1] + a[3]
        apart, other = a[0] - a[2], (a[1] - a[3]).times_minus_i
        return [even + odd, apart + other, even - odd, apart - other]
    # Five (Winograd's cosines and sines of a fifth and two fifths of a turn).
    c1, c2, s1, s2 = (
        (sqrt(5) - 1) / 4,
        -(sqrt(5) + 1) / 4,
        sqrt(10 + 2 * sqrt(5)) / 4,
        sqrt(10 - 2 * sqrt(5)) / 4,
    )
    near, far = a[1] + a[4], a[2] + a[3]
    near_apart, far_apart = (a[1] - a[4]).times_minus_i, (a[2] - a[3]).times_minus_i
    first, second = a[0] + near * c1 + far * c2, a[0] + near * c2 + far * c1
    one, two = near_apart * s1 + far_apart * s2, near_apart * s2 - far_apart * s1
    return [a[0] + near + far, first + one, second + two, second - two, first - one]


def _half_butterfly(a: Sequence[Complex]) -> list[Complex]:
    """Return the Fourier transform of four numbers of which the last two are zero."""
    other = a[1].times_minus_i
    return [a[0] + a[1], a[0] + other, a[0] - a[1], a[0] - other]


@kernel
def _rows(
    code: Code,
    plane: RealField,
    some: IndexRange,
    along: RowTransform,
    raw: Vector,
    offset: Index,
    *,
    inverse: bool,
) -> None:
    """Transform some rows of a plane into the spectrum, in memory for transforms as they come and in order; or back."""
    (spectrum, plan, pairs, _), ordered = along, raw + offset
    for y in code.range(some.begin, some.end, code.count):
        if inverse:
            _transpose_blocks(code, spectrum, y, ordered, plan.length, back=True)
            _split_pairs(code, ordered, raw, plan, pairs, inverse=True)
            code.call(_transform, raw, plan, inverse=True)
            _scatter(code, raw, plane, y)
        else:
            _gather(code, plane, y, raw, plan.length)
            code.call(_transform, raw, plan, inverse=False)
            _split_pairs(code, raw, ordered, plan, pairs, inverse=False)
            _transpose_blocks(code, spectrum, y, ordered, plan.length, back=False)


def _split_pairs(
    code: Code, source: Vector, target: Vector, plan: Plan, pairs: Vector, *, inverse: bool
) -> None:
    """Tell apart the transforms of even and odd columns, which were taken for one of complex numbers; or the inverse.

    Waves k and half - k do so; in order on one side, in digit-reversed order on the other.
    """
    half, size = plan.length, 2 * code.count
    for k in code.range(0, half // 2 + 1):
        in_order, reversed_ = (k, half - k), (plan.order[k], plan.order[half - k])
        at, to = (in_order, reversed_) if inverse else (reversed_, in_order)
        a, b = _load(code, source, at[0] * size), _load(code, source, at[1] * size).conjugate
        twiddle = _twiddle(code, pairs, k * 2)
        even = a + b
        odd = (b - a).times_minus_i * twiddle.conjugate if inverse else (a - b).times_minus_i * twiddle
        _store(code, target, to[0] * size, even + odd)
        _store(code, target, to[1] * size, (even - odd).conjugate)


def _transpose_blocks(
    code: Code, spectrum: BlockedSpectrum, y: Index, waves: Vector, half: Index, *, back: bool
) -> None:
    """Bring waves, of as many rows as there are lanes, into the blocks of columns of the spectrum; or back."""
    lanes, step = code.count, code.index(2 * code.count)
    for block in code.range(0, (half + lanes) // lanes):
        for part in (0, lanes):
            here = block * (2 * lanes * lanes) + part
            there = (block * spectrum.rows + y) * (2 * lanes) + part
            if back:
                code.transpose(spectrum.numbers, there, step, waves, here, step)
            else:
                code.transpose(waves, here, step, spectrum.numbers, there, step)


@kernel
def _columns(code: Code, some: IndexRange, across: ColumnTransform, work: Vector) -> None:
    """Multiply some blocks of columns, whose rows beyond the last piece are zero, between transforms there and back."""
    (pieces, plan, multiplier, _), size = across, 2 * code.count
    # What is whole, neither padded nor in pieces, is worked on where it lies.
    whole = pieces.edges[code.index(1)].equals(plan.length)
    count = where(whole, code.index(0), pieces.parts)
    for b in code.range(some.begin, some.end):
        block = where(whole, pieces.numbers + b * pieces.places[code.index(1)] * size, work)
        own = multiplier + b * (plan.length // 2 + 1) * code.count
        _copy_pieces(code, pieces, b, count, block, back=False)
        for i in code.range(pieces.edges[pieces.parts] * size, plan.length * size, code.count):
            block[i.lanes] = 0.0
        code.call(_transform, block, plan, inverse=False)
        for i in code.range(0, plan.length):
            factor = own[(plan.order[i] * code.count).lanes]
            for k in (i * size, i * size + code.count):
                block[k.lanes] = block[k.lanes] * factor
        code.call(_transform, block, plan, inverse=True)
        _copy_pieces(code, pieces, b, count, block, back=True)


def _copy_pieces(
    code: Code, pieces: ColumnPieces, b: Index, count: Index, block: Vector, *, back: bool
) -> None:
    """Bring the first pieces of a block of columns together; or back."""
    for k in code.range(0, count):
        rows, before = pieces.edges[k + 1] - pieces.edges[k], pieces.places[k]
        place = before * pieces.blocks + b * (pieces.places[k + 1] - before)
        part, own = (x * (2 * code.count) for x in (place, pieces.edges[k]))
        for i in code.range(0, rows * (2 * code.count), code.count):
            if back:
                pieces.numbers[(part + i).lanes] = block[(own + i).lanes]
            else:
                block[(own + i).lanes] = pieces.numbers[(part + i).lanes]


def _gather(code: Code, plane: RealField, y: Index, raw: Vector, half: Index) -> None:
    """Bring as many rows as there are lanes side by side; neighbours in a row are a real and an imaginary part."""
    lanes, (field, ny, nx) = code.count, plane
    rows = (ny - y).min(code.index(lanes))
    whole = _whole(code, rows, nx)
    for x in code.range(0, whole, lanes):
        code.transpose(field, y * nx + x, nx, raw, x * lanes, code.index(lanes))
    for x in code.range(whole, half * 2):
        raw[(x * lanes).lanes] = 0.0
    for row in code.range(0, rows):
        for x in code.range(whole, nx):
            raw[x * lanes + row] = field[(y + row) * nx + x]


def _scatter(code: Code, raw: Vector, plane: RealField, y: Index) -> None:
    """Bring them back."""
    lanes, (field, ny, nx) = code.count, plane
    rows = (ny - y).min(code.index(lanes))
    whole = _whole(code, rows, nx)
    for x in code.range(0, whole, lanes):
        code.transpose(raw, x * lanes, code.index(lanes), field, y * nx + x, nx)
    for row in code.range(0, rows):
        for x in code.range(whole, nx):
            field[(y + row) * nx + x] = raw[x * lanes + row]


def _whole(code: Code, rows: Index, nx: Index) -> Index:
    """Return how many numbers of a row come in squares: none, where rows are fewer than lanes."""
    return nx // code.count * code.count * (rows // code.count)


def _twiddle(code: Code, factors: Vector, at: Index) -> Complex:
    return Complex(code.lanes(factors[at]), code.lanes(factors[at + 1]))


def _load(code: Code, x: Vector, at: Index) -> Complex:
    return Complex(x[at.lanes], x[(at + code.count).lanes])


def _store(code: Code, x: Vector, at: Index, number: Complex) -> None:
    x[at.lanes] = number.re
    x[(at + code.count).lanes] = number.im
