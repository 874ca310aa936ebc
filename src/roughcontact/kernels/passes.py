"""Machine code for what conjugate gradients do to fields between products.

Most of a plane is not in contact. So functions go through a list of groups of cells, as many as there are lanes, that
have some inside the region; what lies elsewhere is neither read nor written. Sums are added up in double precision.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from roughcontact.kernels.code import Code, Take, Variable
from roughcontact.kernels.constants import ROUNDINGS
from roughcontact.kernels.stencil import sum_near
from roughcontact.kernels.values import Index, Number, Reals

__all__ = ["KINDS", "write"]

# The list of groups, from where to where in it, the single cells after the last whole group, and up to where.
LIST = "indices index index index index "
KINDS = {
    "list_groups": "index reals reals reals indices indices",
    "near": LIST + "index reals reals reals",
    "weigh": LIST + "reals reals reals reals reals real doubles",
    "turn": LIST + "reals reals real",
    "measure": LIST + "reals reals reals reals doubles",
    "bound": LIST + "reals reals reals reals reals reals real real real doubles",
    "carried": LIST + "reals reals reals reals doubles",
    "share_out": LIST + "reals reals reals reals real real",
    "excess": LIST + "reals reals reals doubles",
    "forget": LIST + "reals reals",
    "advance": LIST + "reals reals reals reals reals real doubles",
    "take_in": "index reals reals real doubles",
    "lower": "index reals reals real real",
    "sum_blocks": "index index index reals reals reals",
    "add_blocks": "index index index reals reals reals",
    "sum_blocks_on": LIST + "index index index reals reals",
    "add_blocks_on": LIST + "index index index reals reals",
}


def write(module: Any, precision: str) -> None:
    """Write all of them."""
    _list_groups(module, precision)
    _near(module, precision)
    _conjugate(module, precision)
    _bound(module, precision)
    _lower(module, precision)
    _sum_blocks(module, precision)
    _add_blocks(module, precision)
    _blocks_on(module, precision)


def left_of(base: Number, change: Number, precision: str) -> Number:
    """Return a pressure after its change; nothing where that is but rounding."""
    p = base + change
    limit = base * (ROUNDINGS * float(np.finfo(precision).eps))
    return p.where_not(p.larger(-p).is_at_most(limit.larger(-limit)))


def _list_groups(module: Any, precision: str) -> None:
    """List the groups of cells of which some are inside or carry something: where they begin, and how many."""
    with Code(module, "list_groups", precision, KINDS["list_groups"]) as code:
        n, inside, base, change, groups, found = code.arguments
        count = code.variable(code.index(0))
        for at in code.range(0, n // code.count * code.count, code.count):
            groups.put(count.get(), at)
            p = left_of(base.take(at), change.take(at), precision)
            some = code.any_not_zero(inside.take(at).larger(p.larger(-p)))
            count.set(count.get() + code.choose(some, 1, 0))
        found.put(code.index(0), count.get())


def _near(module: Any, precision: str) -> None:
    """Sum over the cells near each: how long a row is, the field, the answer, and weights of cells to one side.

    Weights are the same on all sides. After the end of a row comes the next; before the first and after the last, the
    field has as much room, filled with zeros, as the sum looks at.
    """
    with Code(module, "near", precision, KINDS["near"]) as code:
        *cells, nx, field, answer, weights = code.arguments

        def near(at: Index, take: Take) -> Sequence[Number]:
            weight = weights.take_for_all if take.lanes else weights.take_one
            answer.put(
                at,
                sum_near(lambda y, x: take(field, at + nx * y + x), lambda k: weight(code.index(k))),
            )
            return ()

        _through(code, cells, 0, near, None)


def _conjugate(module: Any, precision: str) -> None:
    """Write what changes and measures directions, see `roughcontact.solver.vectors`."""
    with Code(module, "weigh", precision, KINDS["weigh"]) as code:
        *cells, z, inside, error, v, constant, relief, sums = code.arguments

        def weigh(at: Index, take: Take) -> Sequence[Number]:
            alike, free, answer = take(constant, at), take(inside, at), take(v, at)
            new = (take(z, at) - take(error, at) * alike * take.alike(relief)) * free
            z.put(at, new)
            return take(error, at) * new, new * answer, new, alike * answer * free

        _through(code, cells, 4, weigh, sums)
    with Code(module, "turn", precision, KINDS["turn"]) as code:
        *cells, t, z, beta = code.arguments

        def turn(at: Index, take: Take) -> Sequence[Number]:
            t.put(at, take(t, at) * take.alike(beta) + take(z, at))
            return ()

        _through(code, cells, 0, turn, None)
    with Code(module, "measure", precision, KINDS["measure"]) as code:
        *cells, t, v, inside, r, sums = code.arguments

        def measure(at: Index, take: Take) -> Sequence[Number]:
            direction, answer, free = take(t, at), take(v, at), take(inside, at)
            lack, inside_alone = take(r, at), free * direction
            found = direction * answer, free * answer, lack * direction, lack * inside_alone
            return *found, inside_alone, free * lack

        _through(code, cells, 6, measure, sums)
    with Code(module, "advance", precision, KINDS["advance"]) as code:
        *cells, change, r, error, t, inside, alpha, sums = code.arguments

        def advance(at: Index, take: Take) -> Sequence[Number]:
            change.put(at, take(change, at) + take(t, at) * take.alike(alpha))
            wrong = take(r, at) * take(inside, at)
            error.put(at, wrong)
            return (wrong.larger(-wrong),)

        _through(code, cells, 1, advance, sums, largest=True)


def _bound(module: Any, precision: str) -> None:
    """Write what keeps pressures above nothing and takes cells in, see `roughcontact.solver.vectors`."""
    with Code(module, "bound", precision, KINDS["bound"]) as code:
        *cells, base, change, inside, t, z, uniform, beta, shift, step, sums = code.arguments

        def bound(at: Index, take: Take) -> Rarely:
            was, p = take(inside, at), take(base, at) + take(change, at)
            going_on = take(t, at) * take.alike(beta) + take(z, at)
            new = (going_on - take(uniform, at) * take.alike(shift)) * (was * take.alike(step))
            t.put(at, new)
            pulls = (p + new).is_below(0.0)
            touched = (p - p * was).sign().larger(p.replaced(1.0).where(pulls))

            def lift() -> Sequence[Number]:
                stays = was.where_not(pulls)
                inside.put(at, stays)
                left = left_of(take(base, at), take(change, at), precision)
                lifted = left * stays - left
                less = new * stays + lifted
                t.put(at, less)
                gone = was - stays
                return gone, lifted.larger(-lifted), less - new, take(uniform, at) * gone

            return Rarely(code.any_not_zero(touched) if take.lanes else touched.is_not_zero(), lift)

        _through(code, cells, 4, bound, sums)
    with Code(module, "carried", precision, KINDS["carried"]) as code:
        *cells, base, change, inside, r, sums = code.arguments

        def carried(at: Index, take: Take) -> Sequence[Number]:
            free = take(inside, at)
            return take(base, at) + take(change, at), free, take(r, at) * free

        _through(code, cells, 3, carried, sums)
    with Code(module, "share_out", precision, KINDS["share_out"]) as code:
        *cells, base, change, inside, t, share, alike = code.arguments

        def share_out(at: Index, take: Take) -> Sequence[Number]:
            carried = take(base, at) + take(change, at) + take(t, at)
            less = take(inside, at) * (carried * take.alike(share) + take.alike(alike))
            t.put(at, take(t, at) - less)
            return ()

        _through(code, cells, 0, share_out, None)
    with Code(module, "excess", precision, KINDS["excess"]) as code:
        *cells, base, change, inside, sums = code.arguments

        def excess(at: Index, take: Take) -> Sequence[Number]:
            # Inside what is below nothing is too much, outside all that is left.
            p = left_of(take(base, at), take(change, at), precision)
            return ((p - p * take(inside, at)).larger(-p),)

        _through(code, cells, 1, excess, sums, largest=True)
    with Code(module, "forget", precision, KINDS["forget"]) as code:
        *cells, t, inside = code.arguments

        def forget(at: Index, take: Take) -> Sequence[Number]:
            t.put(at, take(t, at) * take(inside, at))
            return ()

        _through(code, cells, 0, forget, None)
    with Code(module, "take_in", precision, KINDS["take_in"]) as code:
        n, inside, lacking, least, sums = code.arguments
        worst = code.variable(code.zero()), code.variable(code.one(0.0))
        for at, take in code.each(n):
            some, limit = worst[0 if take.lanes else 1], take.alike(least)
            lack = take(lacking, at)
            free = take(inside, at)
            # Of a cell that is free already nothing is asked; of one that lacks too little neither.
            asked = (lack - lack * free).where_not(lack.is_at_most(limit))
            inside.put(at, free.larger(asked.sign()))
            some.set(some.get().larger(asked))
        both = code.across(worst[0].get(), Number.larger).larger(worst[1].get())
        sums.put(code.index(0), both.in_double())


def _lower(module: Any, precision: str) -> None:
    """Take ``alpha (v - mean)`` off a whole field."""
    with Code(module, "lower", precision, KINDS["lower"]) as code:
        n, r, v, alpha, mean = code.arguments
        for at, take in code.each(n):
            r.put(at, take(r, at) - (take(v, at) - take.alike(mean)) * take.alike(alpha))


def _sum_blocks(module: Any, precision: str) -> None:
    """Sum over square blocks: rows and columns of a plane, the side of a block, the plane, the sums, room for a row."""
    with Code(module, "sum_blocks", precision, KINDS["sum_blocks"]) as code:
        ny, nx, side, field, blocks, row = code.arguments
        across = (nx + side - 1) // side
        for block in code.range(0, (ny + side - 1) // side):
            for x in code.range(0, across * side):
                row.put(x, code.one(0.0))
            for y in code.range(block * side, (block * side + side).smaller(ny)):
                for x, take in code.each(nx):
                    row.put(x, take(row, x) + take(field, y * nx + x))
            for b in code.range(0, across):
                total = code.variable(code.one(0.0))
                for x in code.range(b * side, b * side + side):
                    total.set(total.get() + row.take_one(x))
                blocks.put(block * across + b, total.get())


def _add_blocks(module: Any, precision: str) -> None:
    """Add to each cell what its block has; parameters as there."""
    with Code(module, "add_blocks", precision, KINDS["add_blocks"]) as code:
        ny, nx, side, field, blocks, row = code.arguments
        across = (nx + side - 1) // side
        for block in code.range(0, (ny + side - 1) // side):
            for b in code.range(0, across):
                for x in code.range(b * side, b * side + side):
                    row.put(x, blocks.take_one(block * across + b))
            for y in code.range(block * side, (block * side + side).smaller(ny)):
                for x, take in code.each(nx):
                    field.put(y * nx + x, take(field, y * nx + x) + take(row, x))


def _blocks_on(module: Any, precision: str) -> None:
    """Write both for the groups of a LIST alone, of rows that are whole groups, which are whole blocks.

    Parameters: the columns of the plane, the side of a block, how many blocks a row has, the field, and the blocks.
    """
    with Code(module, "sum_blocks_on", precision, KINDS["sum_blocks_on"]) as code:
        *plan, field, blocks = code.arguments
        for block, begin, end in _blocks_of_groups(code, *plan):
            total = code.variable(blocks.take_one(block))
            for cell in code.range(begin, end):
                total.set(total.get() + field.take_one(cell))
            blocks.put(block, total.get())
    with Code(module, "add_blocks_on", precision, KINDS["add_blocks_on"]) as code:
        *plan, field, blocks = code.arguments
        for block, begin, end in _blocks_of_groups(code, *plan):
            share = blocks.take_one(block)
            for cell in code.range(begin, end):
                field.put(cell, field.take_one(cell) + share)


def _blocks_of_groups(code: Code, *plan: Any) -> Iterator[tuple[Index, Index, Index]]:
    """Loop over the pieces of blocks that groups are: which block, the first cell and the one after the last."""
    groups, first, last, _, _, nx, side, across = plan
    for k in code.range(first, last):
        y = groups[k] // nx
        block = y // side * across + (groups[k] - y * nx) // side
        for b in code.range(0, code.index(code.count) // side):
            begin = groups[k] + b * side
            yield block + b, begin, begin + side


class Rarely(NamedTuple):
    """What adds to sums only where a condition holds."""

    condition: Any
    then: Callable[[], Sequence[Number]]


def _through(
    code: Code,
    cells: Sequence[Any],
    count: int,
    body: Callable[[Index, Take], Sequence[Number] | Rarely],
    sums: Reals | None,
    largest: bool = False,
) -> None:
    """Go through a LIST, then through the single cells; leave sums of what the body returns, or the largest."""
    groups, begin, end, single, last = cells

    def both(one: Number, other: Number) -> Number:
        return one.larger(other) if largest else one + other

    def add(found: Sequence[Number] | Rarely, totals: Sequence[Variable[Number]]) -> None:
        if isinstance(found, Rarely):
            with code.when(found.condition):
                add(found.then(), totals)
            return
        for total, number in zip(totals, found, strict=True):
            total.set(both(total.get(), number.in_double()))

    lanes = [code.variable(code.zero().in_double()) for _ in range(count)]
    for k in code.range(begin, end):
        add(body(groups[k], Take(code, True)), lanes)
    totals = [code.variable(code.across(total.get(), both)) for total in lanes]
    for at in code.range(single, last):
        add(body(at, Take(code, False)), totals)
    for place, total in enumerate(totals):
        assert sums is not None
        sums.put(code.index(place), total.get())
