"""Vector updates and dot products on a list of groups of cells, as conjugate gradients on a part of a plane need them.

Kernels go through a list of groups of cells, as many as there are lanes, that have some inside the region; what lies
elsewhere is neither read nor written. Sums are added up in double precision. The mask ``m`` is 1 inside, else 0.
"""

from __future__ import annotations

import numpy as np

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import ROUNDINGS
from roughcontact.kernels.groups import Cells, Groups
from roughcontact.kernels.signature import Doubles, Indices, Scalar, Vector, kernel
from roughcontact.kernels.stencil import sum_near
from roughcontact.kernels.totals import Totals
from roughcontact.kernels.values import Index, Number, maximum, where


def rounded_sum(code: Code, base: Number, change: Number) -> Number:
    """Return ``base + change``; zero where that is but rounding of the base."""
    p = base + change
    limit = base * (ROUNDINGS * float(np.finfo(code.precision).eps))
    return where(~(abs(p) <= abs(limit)), p, 0.0)


@kernel
def list_groups(
    code: Code, n: Index, m: Vector, base: Vector, change: Vector, starts: Indices, found: Indices
) -> None:
    """List the groups with a cell where m or ``base + change`` is not zero, and write how many there are."""
    count = code.variable(code.index(0))
    for at in code.range(0, n // code.count * code.count, code.count):
        starts[count.get()] = at
        i = at.lanes
        p = rounded_sum(code, base[i], change[i])
        some = code.any(maximum(m[i], abs(p)).is_nonzero())
        count.set(count.get() + where(some, code.index(1), 0))
    found[code.index(0)] = count.get()


@kernel
def sum_stencil(code: Code, groups: Groups, nx: Index, x: Vector, y: Vector, weights: Vector) -> None:
    """Write to y the weighted sums over the cells of x near each, on rows of nx cells.

    After the end of a row comes the next; before the first and after the last, x has as many zeros as the sum looks at.
    """
    for i in groups.cells(code):
        y[i] = sum_near(lambda down, across, i=i: x[i + nx * down + across], weights, code.index(0))  # type: ignore[misc]


@kernel
def correct_and_dot(
    code: Code,
    groups: Groups,
    z: Vector,
    m: Vector,
    e: Vector,
    v: Vector,
    c: Vector,
    s: Scalar,
    sums: Doubles,
) -> None:
    """``z := m (z - s e c)``; leave e.z, z.v, the sum of z, and c.(m v)."""
    totals = Totals(code, sums, 4)
    for i in groups.cells(code, totals):
        new = (z[i] - e[i] * c[i] * s) * m[i]
        z[i] = new
        totals.add(e[i] * new, new * v[i], new, c[i] * v[i] * m[i])


@kernel
def xpay(code: Code, groups: Groups, y: Vector, x: Vector, a: Scalar) -> None:
    """``y := a y + x``."""
    for i in groups.cells(code):
        y[i] = y[i] * a + x[i]


@kernel
def multiply(code: Code, groups: Groups, x: Vector, m: Vector) -> None:
    """``x := m x``."""
    for i in groups.cells(code):
        x[i] = x[i] * m[i]


@kernel
def dot_products(
    code: Code, groups: Groups, t: Vector, v: Vector, m: Vector, r: Vector, sums: Doubles
) -> None:
    """Leave t.v, m.v, r.t, r.(m t), m.t and m.r."""
    totals = Totals(code, sums, 6)
    for i in groups.cells(code, totals):
        inside = m[i] * t[i]
        totals.add(t[i] * v[i], m[i] * v[i], r[i] * t[i], r[i] * inside, inside, m[i] * r[i])


@kernel
def axpy_and_max(
    code: Code,
    groups: Groups,
    x: Vector,
    r: Vector,
    e: Vector,
    t: Vector,
    m: Vector,
    a: Scalar,
    most: Doubles,
) -> None:
    """``x := x + a t`` and ``e := m r``; leave the largest entry of abs(e)."""
    totals = Totals(code, most, 0, 1, least=0.0)
    for i in groups.cells(code, totals):
        x[i] = x[i] + t[i] * a
        masked = r[i] * m[i]
        e[i] = masked
        totals.add(abs(masked))


@kernel
def masked_sums(
    code: Code, groups: Groups, base: Vector, change: Vector, m: Vector, r: Vector, sums: Doubles
) -> None:
    """Leave the sums of ``base + change`` and of m, and m.r."""
    totals = Totals(code, sums, 3)
    for i in groups.cells(code, totals):
        totals.add(base[i] + change[i], m[i], r[i] * m[i])


@kernel
def subtract_affine(
    code: Code, groups: Groups, base: Vector, change: Vector, m: Vector, t: Vector, a: Scalar, b: Scalar
) -> None:
    """``t := t - m (a (base + change + t) + b)``."""
    for i in groups.cells(code):
        t[i] = t[i] - m[i] * ((base[i] + change[i] + t[i]) * a + b)


@kernel
def max_violation(code: Code, groups: Groups, base: Vector, change: Vector, m: Vector, most: Doubles) -> None:
    """Leave the largest violation of ``p >= 0`` inside and of ``p = 0`` elsewhere by ``p = base + change``."""
    totals = Totals(code, most, 0, 1, least=0.0)
    for i in groups.cells(code, totals):
        p = rounded_sum(code, base[i], change[i])
        totals.add(maximum(p - p * m[i], -p))


@kernel
def project_step(
    code: Code,
    groups: Groups,
    base: Vector,
    change: Vector,
    m: Vector,
    t: Vector,
    z: Vector,
    c: Vector,
    beta: Scalar,
    shift: Scalar,
    step: Scalar,
    sums: Doubles,
) -> None:
    """``t := step m (beta t + z - shift c)``, projected so that ``p = base + change + t >= 0`` inside, p = 0 elsewhere.

    Cells that it would take below zero go to zero, and leave the mask. Leave how many these are, the sum of what all
    cells were taken to zero by, the sum of what the projection added to t, and the sum of c over cells that left.
    """
    totals = Totals(code, sums, 4)
    for i in groups.cells(code, totals):
        was, p = m[i], base[i] + change[i]
        new = (t[i] * beta + z[i] - c[i] * shift) * (was * step)
        t[i] = new
        below = p + new < 0.0
        touched = maximum((p - p * was).heaviside(), where(below, p.filled(1.0), 0.0))
        with code.when(code.any(touched.is_nonzero())):
            stays = where(~below, was, 0.0)
            m[i] = stays
            left = rounded_sum(code, base[i], change[i])
            lifted = left * stays - left
            projected = new * stays + lifted
            t[i] = projected
            gone = was - stays
            totals.add(gone, abs(lifted), projected - new, c[i] * gone)


@kernel
def mask_above(code: Code, cells: Cells, m: Vector, r: Vector, least: Scalar, most: Doubles) -> None:
    """``m := 1`` where r is above `least`, and above zero; leave the largest r of those that were 0 before, or 0."""
    totals = Totals(code, most, 0, 1, least=0.0)
    for i in cells.each(code, totals):
        outside = r[i] - r[i] * m[i]
        above = where(~(r[i] <= least), outside, 0.0)
        m[i] = maximum(m[i], above.heaviside())
        totals.add(above)


@kernel
def subtract_shifted(code: Code, cells: Cells, r: Vector, v: Vector, a: Scalar, mean: Scalar) -> None:
    """``r := r - a (v - mean)`` on a whole field."""
    for i in cells.each(code):
        r[i] = r[i] - (v[i] - mean) * a
