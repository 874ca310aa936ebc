"""One pass over whole fields of double precision: what they amount to, and copies of them in a unit.

Fields are a pressure p, the displacement u that it causes, and the separation s of the bodies; ``u + s`` is the level.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import NEVER
from roughcontact.kernels.groups import Cells
from roughcontact.kernels.signature import Double, Doubles, Flags, Vector, kernel
from roughcontact.kernels.totals import Totals
from roughcontact.kernels.values import maximum, where


class Fields(NamedTuple):
    """A pressure, the displacement that it causes, and the separation."""

    p: Doubles
    u: Doubles
    s: Doubles


@kernel
def extremes(code: Code, cells: Cells, fields: Fields, totals: Doubles) -> None:
    """Leave the largest level where p > 0, -level, abs(u), p, -p, -p where p > 0, and -level elsewhere.

    Then the sum of the levels where p > 0, how many these are, and zero: or NaN where some p or u is no finite number.
    """
    found = Totals(code, totals, 3, 7, compensated=True)
    for i in cells.each(code, found):
        p, u = fields.p[i], fields.u[i]
        level, positive = u + fields.s[i], p > 0.0
        found.add(
            where(positive, level, -math.inf),
            -level,
            abs(u),
            p,
            -p,
            where(positive, -p, -math.inf),
            where(~positive, -level, -math.inf),
            where(positive, level, 0.0),
            where(positive, p.filled(1.0), 0.0),
            (p - p) + (u - u),
        )


@kernel
def predict_active(
    code: Code,
    cells: Cells,
    f: Fields,
    depth: Double,
    least: Double,
    a_ii: Double,
    active: Flags,
    totals: Doubles,
) -> None:
    """Mark where p > 0 or the gap ``u + s - depth < least``, but not where ``a_ii max(p, 0) < gap``.

    Leave how many are marked, and how many are not for the last reason: there one cell by itself would pull.
    """
    found = Totals(code, totals, 2, compensated=True)
    for i in cells.each(code, found):
        p = f.p[i]
        gap, one = f.u[i] + f.s[i] - depth, p.filled(1.0)
        pulls = maximum(p, p.filled(0.0)) * a_ii < gap  # nothing times infinity is NaN, and not below
        candidate = (p > 0.0) | (gap < least)
        stays = candidate & ~pulls
        active[i] = stays
        found.add(where(stays, one, 0.0), where(candidate & pulls, one, 0.0))


@kernel
def level_range(code: Code, cells: Cells, s: Doubles, u: Doubles, m: Flags, totals: Doubles) -> None:
    """Leave the largest level and -level where m, their sum, and how many they are."""
    found = Totals(code, totals, 2, 2, compensated=True)
    for i in cells.each(code, found):
        level, inside = s[i] + u[i], m[i]
        found.add(
            where(inside, level, -math.inf),
            where(inside, -level, -math.inf),
            where(inside, level, 0.0),
            where(inside, level.filled(1.0), 0.0),
        )


@kernel
def scale_down(
    code: Code,
    cells: Cells,
    f: Fields,
    depth: Double,
    a: Double,
    active: Flags,
    m: Vector,
    r: Vector,
    base: Vector,
) -> None:
    """``m := 1`` where active, otherwise 0; ``r := a (depth - s - u)``, at least NEVER; ``base := a p``."""
    for i in cells.each(code):
        residual = (depth - (f.s[i] + f.u[i])) * a
        r[i] = maximum(residual, residual.filled(NEVER))
        base[i] = f.p[i] * a
        m[i] = where(active[i], residual.filled(1.0), 0.0)


@kernel
def add_scaled(
    code: Code, cells: Cells, p: Doubles, change: Vector, m: Vector, unit: Double, answer: Doubles
) -> None:
    """``answer := m max(p + unit change, 0)``."""
    for i in cells.each(code):
        new = p[i] + change[i].double() * unit
        answer[i] = where(new > 0.0, new, 0.0) * m[i].double()


@kernel
def positive_total(code: Code, cells: Cells, p: Doubles, s: Doubles, totals: Doubles) -> None:
    """Leave the sum of p where it is positive and s is finite."""
    found = Totals(code, totals, 1, compensated=True)
    for i in cells.each(code, found):
        found.add(where((p[i] > 0.0) & (s[i] < math.inf), p[i], 0.0))


@kernel
def positive_part(code: Code, cells: Cells, p: Doubles, s: Doubles, a: Double, answer: Doubles) -> None:
    """``answer := a max(p, 0)`` where s is finite, otherwise 0."""
    for i in cells.each(code):
        answer[i] = where((p[i] > 0.0) & (s[i] < math.inf), p[i] * a, 0.0)
