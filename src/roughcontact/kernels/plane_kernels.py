"""One pass over whole fields of double precision: what they amount to, and copies of them in a unit.

Fields are a pressure p, the displacement u that it causes, and the separation s of the bodies; ``u + s`` is the level.
"""

from __future__ import annotations

import math

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import NEVER
from roughcontact.kernels.signature import Double, Doubles, Flags, Vector, kernel
from roughcontact.kernels.totals import Totals
from roughcontact.kernels.values import Index, maximum, where


@kernel
def extremes(code: Code, n: Index, p: Doubles, u: Doubles, s: Doubles, totals: Doubles) -> None:
    """Leave the largest level where p > 0, -level, abs(u), p, -p, -p where p > 0, and -level elsewhere.

    Then the sum of the levels where p > 0, how many these are, and zero: or NaN where some p or u is no finite number.
    """
    found = Totals(code, 3, 7, compensated=True)
    for i in code.each(n):
        pressure, displacement = p[i], u[i]
        level, positive = displacement + s[i], pressure > 0.0
        found.add(
            where(positive, level, -math.inf),
            -level,
            abs(displacement),
            pressure,
            -pressure,
            where(positive, -pressure, -math.inf),
            where(~positive, -level, -math.inf),
            where(positive, level, 0.0),
            where(positive, pressure.filled(1.0), 0.0),
            (pressure - pressure) + (displacement - displacement),
        )
    found.store(totals)


@kernel
def predict_active(
    code: Code,
    n: Index,
    p: Doubles,
    u: Doubles,
    s: Doubles,
    depth: Double,
    least: Double,
    own: Double,
    active: Flags,
    totals: Doubles,
) -> None:
    """Mark where p > 0 or the gap ``u + s - depth < least``, but not where ``own max(p, 0) < gap``.

    Leave how many are marked, and how many are not for the last reason: there one cell by itself would pull.
    """
    found = Totals(code, 2, compensated=True)
    for i in code.each(n):
        pressure = p[i]
        gap = u[i] + s[i] - depth
        # Nothing times infinity is NaN, and not below.
        pulls = maximum(pressure, pressure.filled(0.0)) * own < gap
        candidate = (pressure > 0.0) | (gap < least)
        stays = candidate & ~pulls
        active[i] = stays
        one = pressure.filled(1.0)
        found.add(where(stays, one, 0.0), where(candidate & pulls, one, 0.0))
    found.store(totals)


@kernel
def level_range(code: Code, n: Index, s: Doubles, u: Doubles, m: Flags, totals: Doubles) -> None:
    """Leave the largest level and -level where m, their sum, and how many they are."""
    found = Totals(code, 2, 2, compensated=True)
    for i in code.each(n):
        level, inside = s[i] + u[i], m[i]
        found.add(
            where(inside, level, -math.inf),
            where(inside, -level, -math.inf),
            where(inside, level, 0.0),
            where(inside, level.filled(1.0), 0.0),
        )
    found.store(totals)


@kernel
def scale_down(
    code: Code,
    n: Index,
    s: Doubles,
    u: Doubles,
    p: Doubles,
    active: Flags,
    depth: Double,
    scale: Double,
    m: Vector,
    r: Vector,
    base: Vector,
) -> None:
    """``m := 1`` where active, else 0; ``r := scale (depth - s - u)``, at least NEVER; ``base := scale p``."""
    for i in code.each(n):
        residual = (depth - (s[i] + u[i])) * scale
        r[i] = maximum(residual, residual.filled(NEVER))
        base[i] = p[i] * scale
        m[i] = where(active[i], residual.filled(1.0), 0.0)


@kernel
def add_scaled(
    code: Code, n: Index, p: Doubles, change: Vector, m: Vector, unit: Double, answer: Doubles
) -> None:
    """``answer := m max(p + unit change, 0)``."""
    for i in code.each(n):
        new = p[i] + change[i].double() * unit
        answer[i] = where(new > 0.0, new, 0.0) * m[i].double()
