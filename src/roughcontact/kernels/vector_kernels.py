"""Vector updates and dot products on a list of groups of cells, as conjugate gradients on a part of a plane need them.

Kernels go through a list of groups of cells, one for each lane, that have some inside the region; what lies
elsewhere is neither read nor written. Sums are added up in double precision. Letters are those of
docs/concepts/method.md; the mask ``m`` is 1 on the free set F, otherwise 0.
"""

from __future__ import annotations

import numpy as np

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import ROUNDINGS
from roughcontact.kernels.groups import Cells, Groups
from roughcontact.kernels.signature import Doubles, Indices, Scalar, Vector, kernel
from roughcontact.kernels.totals import Totals, sum_near
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
    r: Vector,
    q: Vector,
    w: Vector,
    theta: Scalar,
    sums: Doubles,
) -> None:
    """``z := m (z - theta r w)``; leave r.z, z.q, the sum of z, and w.(m q)."""
    totals = Totals(code, sums, 4)
    for i in groups.cells(code, totals):
        new = (z[i] - r[i] * w[i] * theta) * m[i]
        z[i] = new
        totals.add(r[i] * new, new * q[i], new, w[i] * q[i] * m[i])


@kernel
def xpay(code: Code, groups: Groups, s: Vector, z: Vector, beta: Scalar) -> None:
    """``s := beta s + z``."""
    for i in groups.cells(code):
        s[i] = s[i] * beta + z[i]


@kernel
def multiply(code: Code, groups: Groups, x: Vector, m: Vector) -> None:
    """``x := m x``."""
    for i in groups.cells(code):
        x[i] = x[i] * m[i]


@kernel
def dot_products(
    code: Code, groups: Groups, s: Vector, q: Vector, m: Vector, r: Vector, sums: Doubles
) -> None:
    """Leave s.q, m.q, r.s, r.(m s), m.s and m.r."""
    totals = Totals(code, sums, 6)
    for i in groups.cells(code, totals):
        inside = m[i] * s[i]
        totals.add(s[i] * q[i], m[i] * q[i], r[i] * s[i], r[i] * inside, inside, m[i] * r[i])


@kernel
def axpy_and_max(
    code: Code,
    groups: Groups,
    change: Vector,
    r: Vector,
    r_free: Vector,
    s: Vector,
    m: Vector,
    alpha: Scalar,
    most: Doubles,
) -> None:
    """``change := change + alpha s`` and ``r_free := m r``; leave the largest entry of abs(r_free)."""
    totals = Totals(code, most, 0, 1, least=0.0)
    for i in groups.cells(code, totals):
        change[i] = change[i] + s[i] * alpha
        masked = r[i] * m[i]
        r_free[i] = masked
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
    code: Code, groups: Groups, base: Vector, change: Vector, m: Vector, s: Vector, a: Scalar, b: Scalar
) -> None:
    """``s := s - m (a (base + change + s) + b)``."""
    for i in groups.cells(code):
        s[i] = s[i] - m[i] * ((base[i] + change[i] + s[i]) * a + b)


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
    s: Vector,
    z: Vector,
    w: Vector,
    beta: Scalar,
    mu: Scalar,
    gamma: Scalar,
    sums: Doubles,
) -> None:
    """``s := gamma m (beta s + z - mu w)``, projected so that ``p = base + change + s >= 0`` inside, p = 0 elsewhere.

    Cells that it would take below zero go to zero, and leave the mask. Leave how many these are, the sum of what all
    cells were taken to zero by, the sum of what the projection added to s, and the sum of w over cells that left.
    """
    totals = Totals(code, sums, 4)
    for i in groups.cells(code, totals):
        was, p = m[i], base[i] + change[i]
        new = (s[i] * beta + z[i] - w[i] * mu) * (was * gamma)
        s[i] = new
        below = p + new < 0.0
        touched = maximum((p - p * was).heaviside(), where(below, p.filled(1.0), 0.0))
        with code.when(code.any(touched.is_nonzero())):
            stays = where(~below, was, 0.0)
            m[i] = stays
            left = rounded_sum(code, base[i], change[i])
            correction = left * stays - left
            projected = new * stays + correction
            s[i] = projected
            gone = was - stays
            totals.add(gone, abs(correction), projected - new, w[i] * gone)


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
def subtract_shifted(code: Code, cells: Cells, r: Vector, q: Vector, alpha: Scalar, mean: Scalar) -> None:
    """``r := r - alpha (q - mean)`` on a whole field."""
    for i in cells.each(code):
        r[i] = r[i] - (q[i] - mean) * alpha
