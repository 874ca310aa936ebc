"""Machine code for convolutions of real fields with even kernels, by fast Fourier transforms.

A field is taken through in three steps: along the rows, along the columns and back, and back along the rows. A column's
spectrum is multiplied where it lies, in whatever order its waves are, so that nothing is ever sorted along columns; and
as many rows or columns as there are lanes go at once.

In between, spectra lie in blocks of columns: number ``((b * rows + y) * 2 + part) * lanes + l`` is the real or the
imaginary part of wave ``b * lanes + l`` of row y.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import HALF
from roughcontact.kernels.values import Index, Number, Reals

__all__ = ["KINDS", "write"]

RADICES = (4, 2, 3, 5, HALF)
ROWS = "reals index index index index reals index index indices index reals indices reals reals reals"
COLUMNS = "reals index index index index index indices index reals reals indices reals"
KINDS = {
    "convolve": "indices reals reals index index reals index index indices index reals indices reals "
    "index indices index reals reals indices index index reals index"
}


@dataclass(frozen=True, slots=True)
class Wave:
    """A complex number in each lane."""

    re: Number
    im: Number

    def __add__(self, other: Wave) -> Wave:
        return Wave(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Wave) -> Wave:
        return Wave(self.re - other.re, self.im - other.im)

    def __mul__(self, other: Wave | float) -> Wave:
        if isinstance(other, Wave):
            return Wave(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
        return Wave(self.re * other, self.im * other)

    @property
    def turned(self) -> Wave:
        """A quarter of a turn back: times -i."""
        return Wave(self.im, -self.re)

    @property
    def conjugate(self) -> Wave:
        """Its conjugate."""
        return Wave(self.re, -self.im)

    @property
    def swapped(self) -> Wave:
        """Both parts in each other's place: what turns a transform into its inverse, before and after."""
        return Wave(self.im, self.re)


def write(module: Any, precision: str) -> None:
    """Write ``convolve``: rows there, columns there and back with the multiplier in between, rows back.

    Parameters: counters for three phases, see `Code.shared`; the field, the answer, rows and columns of both; the
    spectrum and the rows that it has room for; half of the columns as padded, radices and factors of their transform,
    the place of each wave in it, factors of the pairs; the rows as padded, radices and factors of their transform, the
    multiplier and the row of it that each place takes; how many rows, and blocks of columns, are a part; and room for
    one thread, in which rows lie as they come, and from where they lie in order.
    """
    there, back = (_transform(module, precision, inverse) for inverse in (False, True))
    rows_there, columns = (
        _rows(module, precision, there, inverse=False),
        _columns(module, precision, there, back),
    )
    rows_back = _rows(module, precision, back, inverse=True)
    with Code(module, "convolve", precision, KINDS["convolve"]) as code:
        counters, field, answer, ny, nx, spectrum, room, half, *given = code.arguments
        along, across, (many, wide, raw, offset) = given[:5], given[5:11], given[11:]
        blocks, waves = half // code.count + 1, raw.at(offset)

        def some_rows(phase: int, transform: Code, lines: Reals) -> None:
            for part in code.shared(counters, phase, (ny + many - 1) // many):
                end = (part * many + many).smaller(ny)
                code.call(
                    transform, lines, ny, nx, part * many, end, spectrum, room, half, *along, raw, waves
                )

        some_rows(0, rows_there, field)
        for part in code.shared(counters, 1, (blocks + wide - 1) // wide):
            end = (part * wide + wide).smaller(blocks)
            code.call(columns, spectrum, room, ny, part * wide, end, *across, raw)
        some_rows(2, rows_back, answer)


def _transform(module: Any, precision: str, inverse: bool) -> Code:
    """Write the transform of columns of lanes, in place: there in order, out of order when done; or its inverse.

    Parameters: the numbers, how many, the radices and how many they are, and the factors ("twiddles") of each sweep.
    """
    name = "inverse" if inverse else "forward"
    with Code(module, name, precision, "reals index indices index reals") as code:
        x, n, radices, sweeps, factors = code.arguments
        length = code.variable(code.index(1) if inverse else n)
        for k in code.range(0, sweeps):
            radix = radices[sweeps - 1 - k] if inverse else radices[k]
            ways = code.choose(radix.equals(HALF), 4, radix)
            m = length.get() if inverse else length.get() // ways
            whole = m * ways
            for r in RADICES:
                with code.when(radix.equals(r)):
                    _sweep(code, x, n, m, r, factors, inverse)
            length.set(whole if inverse else m)
    return code


def _sweep(code: Code, x: Reals, n: Index, m: Index, radix: int, factors: Reals, inverse: bool) -> None:
    ways, step = radix or 4, m * (2 * code.count)
    full, whole = 2 if radix == HALF else ways, m * ways
    start = (n - whole) * 2  # before it lie the factors of the sweeps over longer parts
    for block in code.range(0, n, whole):
        for j in code.range(0, m):
            first, factor = (block + j) * (2 * code.count), start + j * (2 * (ways - 1))
            turns = [_factor(factors, factor + 2 * q) for q in range(ways - 1)]
            if inverse:
                waves = [_take(code, x, first + step * q) for q in range(ways)]
                waves = [waves[0], *(w * t.conjugate for w, t in zip(waves[1:], turns, strict=True))]
                waves = [w.swapped for w in _butterfly([w.swapped for w in waves])]
                waves = waves[:full]
            else:
                waves = [_take(code, x, first + step * q) for q in range(full)]
                waves = _half(waves) if radix == HALF else _butterfly(waves)
                waves = [waves[0], *(w * t for w, t in zip(waves[1:], turns, strict=True))]
            for q, wave in enumerate(waves):
                _put(code, x, first + step * q, wave)


def _butterfly(a: Sequence[Wave]) -> list[Wave]:
    """Return the Fourier transform of a few numbers."""
    if len(a) == 2:
        return [a[0] + a[1], a[0] - a[1]]
    if len(a) == 3:
        both, apart = a[1] + a[2], ((a[1] - a[2]) * (sqrt(3) / 2)).turned
        middle = a[0] - both * 0.5
        return [a[0] + both, middle + apart, middle - apart]
    if len(a) == 4:
        even, odd = a[0] + a[2], a[1] + a[3]
        apart, turned = a[0] - a[2], (a[1] - a[3]).turned
        return [even + odd, apart + turned, even - odd, apart - turned]
    # Five (Winograd's cosines and sines of a fifth and two fifths of a turn).
    c1, c2, s1, s2 = (
        (sqrt(5) - 1) / 4,
        -(sqrt(5) + 1) / 4,
        sqrt(10 + 2 * sqrt(5)) / 4,
        sqrt(10 - 2 * sqrt(5)) / 4,
    )
    near, far = a[1] + a[4], a[2] + a[3]
    near_apart, far_apart = (a[1] - a[4]).turned, (a[2] - a[3]).turned
    first, second = a[0] + near * c1 + far * c2, a[0] + near * c2 + far * c1
    one, two = near_apart * s1 + far_apart * s2, near_apart * s2 - far_apart * s1
    return [a[0] + near + far, first + one, second + two, second - two, first - one]


def _half(a: Sequence[Wave]) -> list[Wave]:
    """Return the Fourier transform of four numbers of which the last two are zero."""
    turned = a[1].turned
    return [a[0] + a[1], a[0] + turned, a[0] - a[1], a[0] - turned]


def _rows(module: Any, precision: str, transform: Code, inverse: bool) -> Code:
    """Write the transform of some rows, and where it goes; or the way back.

    Parameters: the field, its rows and columns, the first row and the one after the last; the spectrum and the rows
    that it has room for; half of the columns as padded, radices and factors of their transform, the place of each wave
    in it, factors of the pairs; and room for one transform as it comes and one in order.
    """
    with Code(module, "rows_back" if inverse else "rows_there", precision, ROWS) as code:
        field, ny, nx, begin, end, spectrum, room, half, *plan, places, turns, raw, waves = code.arguments
        lanes = code.count
        for y in code.range(begin, end, lanes):
            if inverse:
                _turn(code, spectrum, room, y, waves, half, inverse)
            else:
                _gather(code, field, ny, nx, y, raw, half)
                code.call(transform, raw, half, *plan)
            # Neighbours in a row were taken for one complex number: waves k and half - k tell the two apart.
            for k in code.range(0, half // 2 + 1):
                in_order = k * (2 * lanes), (half - k) * (2 * lanes)
                as_it_comes = places[k] * (2 * lanes), places[half - k] * (2 * lanes)
                source, target = (waves, raw) if inverse else (raw, waves)
                at, to = (in_order, as_it_comes) if inverse else (as_it_comes, in_order)
                a, b = _take(code, source, at[0]), _take(code, source, at[1]).conjugate
                turn = _factor(turns, k * 2)
                even, odd = a + b, (b - a).turned * turn.conjugate if inverse else (a - b).turned * turn
                _put(code, target, to[0], even + odd)
                _put(code, target, to[1], (even - odd).conjugate)
            if inverse:
                code.call(transform, raw, half, *plan)
                _scatter(code, raw, field, ny, nx, y)
            else:
                _turn(code, spectrum, room, y, waves, half, inverse)
    return code


def _turn(code: Code, spectrum: Reals, room: Index, y: Index, waves: Reals, half: Index, back: bool) -> None:
    """Bring waves, of as many rows as there are lanes, into the blocks of columns of the spectrum; or back."""
    lanes, step = code.count, code.index(2 * code.count)
    for block in code.range(0, (half + lanes) // lanes):
        for part in (0, lanes):
            here, there = block * (2 * lanes * lanes) + part, (block * room + y) * (2 * lanes) + part
            if back:
                code.transpose(spectrum, there, step, waves, here, step)
            else:
                code.transpose(waves, here, step, spectrum, there, step)


def _columns(module: Any, precision: str, there: Code, back: Code) -> Code:
    """Write the product with a multiplier along some blocks of columns, between transforms there and back.

    Parameters: the spectrum, its rows, how many of them count, the first block and the one after the last; the rows as
    padded, radices and factors of their transform; the multiplier, block by block, and the row of it that each place
    takes; and room for one block.
    """
    with Code(module, "columns", precision, COLUMNS) as code:
        spectrum, room, ny, begin, end, my, radices, sweeps, factors, multiplier, places, work = (
            code.arguments
        )
        lanes = code.count
        for b in code.range(begin, end):
            part, own = spectrum.at(b * room * (2 * lanes)), multiplier.at(b * (my // 2 + 1) * lanes)
            # What is not padded is worked on where it lies.
            whole = ny.equals(my)
            copied, block = code.choose(whole, 0, ny), code.choose(whole, part, work)
            for i in code.range(0, copied * 2):
                block.put(i * lanes, part.take(i * lanes))
            for i in code.range(ny * 2, my * 2):
                block.put(i * lanes, code.zero())
            code.call(there, block, my, radices, sweeps, factors)
            for i in code.range(0, my):
                factor = own.take(places[i] * lanes)
                for at in (i * (2 * lanes), i * (2 * lanes) + lanes):
                    block.put(at, block.take(at) * factor)
            code.call(back, block, my, radices, sweeps, factors)
            for i in code.range(0, copied * 2):
                part.put(i * lanes, block.take(i * lanes))
    return code


def _gather(code: Code, field: Reals, ny: Index, nx: Index, y: Index, raw: Reals, half: Index) -> None:
    """Bring as many rows as there are lanes side by side; neighbours in a row are a real and an imaginary part."""
    lanes = code.count
    rows = (ny - y).smaller(code.index(lanes))
    whole = _whole(code, rows, nx)
    for x in code.range(0, whole, lanes):
        code.transpose(field, y * nx + x, nx, raw, x * lanes, code.index(lanes))
    for x in code.range(whole, half * 2):
        raw.put(x * lanes, code.zero())
    for row in code.range(0, rows):
        for x in code.range(whole, nx):
            raw.put(x * lanes + row, field.take_one((y + row) * nx + x))


def _scatter(code: Code, raw: Reals, field: Reals, ny: Index, nx: Index, y: Index) -> None:
    """Bring them back."""
    lanes = code.count
    rows = (ny - y).smaller(code.index(lanes))
    whole = _whole(code, rows, nx)
    for x in code.range(0, whole, lanes):
        code.transpose(raw, x * lanes, code.index(lanes), field, y * nx + x, nx)
    for row in code.range(0, rows):
        for x in code.range(whole, nx):
            field.put((y + row) * nx + x, raw.take_one(x * lanes + row))


def _whole(code: Code, rows: Index, nx: Index) -> Index:
    """Return how many numbers of a row come in squares: none, where rows are fewer than lanes."""
    return nx // code.count * code.count * (rows // code.count)


def _factor(factors: Reals, at: Index) -> Wave:
    return Wave(factors.take_for_all(at), factors.take_for_all(at + 1))


def _take(code: Code, x: Reals, at: Index) -> Wave:
    return Wave(x.take(at), x.take(at + code.count))


def _put(code: Code, x: Reals, at: Index, wave: Wave) -> None:
    x.put(at, wave.re)
    x.put(at + code.count, wave.im)
