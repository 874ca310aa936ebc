"""The ends of a range of loads, found by solving: the search goes up in steps, and the ends lie between two of them."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

from roughcontact.contact.continuation import follow
from roughcontact.contact.loads.load_search import LoadSearch, SearchedLoad
from roughcontact.contact.solution import Solution
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Force

__all__ = ["NEAR", "with_ends"]

NEAR = 0.01  # of a limit, or of the force: precision of an end
GUESSED = 4  # loads for an end by interpolation, then by bisection, which a jump of a level requires
MOST = 12  # loads for an end

Level = Literal["stiff", "resolved", "ended"]


def with_ends(search: LoadSearch) -> LoadSearch:
    """Return a search whose range begins and ends at its limits, to a hundredth of them.

    The precision is a hundredth of the force if a level jumps across its limit, as contact at the border does.
    """
    search = _nearer(_nearer(search, "ended"), "resolved")
    return _nearer(search, "stiff") if search.lowest < search.spots_from else search


def _nearer(search: LoadSearch, level: Level) -> LoadSearch:
    """Return a search with more loads near the force at which a level first reaches its limit."""
    loads = search.loads
    at = next((place for place, load in enumerate(loads) if getattr(load, level) >= 1), 0)
    if not at:  # nowhere, or from the first load on
        return search
    light, heavy = loads[at - 1 : at + 1]
    found: list[SearchedLoad] = []
    state: Solution | None = None
    for turn in range(MOST):
        if _is_near(light, heavy, level):
            break
        force = light.force * (heavy.force / light.force) ** (
            _part(light, heavy, level) if turn < GUESSED else 0.5
        )
        (state,) = follow(search.problem, [Force(force)], ActiveSet(), start=state)
        lighter = [load for load in (*loads, *found) if load.force < force]
        found.append(load := SearchedLoad.of(state, search.kind, lighter))
        light, heavy = (light, load) if getattr(load, level) >= 1 else (load, heavy)
    rising = sorted((*loads, *found), key=lambda load: load.force)
    last = next((place for place, load in enumerate(rising) if load.reason), len(rising) - 1)
    return replace(search, loads=tuple(rising[: last + 1]))


def _is_near(light: SearchedLoad, heavy: SearchedLoad, level: Level) -> bool:
    """Return whether the load inside the range is near its end: the lighter load at the upper end, or the heavier."""
    off = 1 - light.ended if level == "ended" else getattr(heavy, level) - 1
    return bool(off <= NEAR or heavy.force <= (1 + NEAR) * light.force)


def _part(light: SearchedLoad, heavy: SearchedLoad, level: Level) -> float:
    """Return the part of the way, in the logarithm of the force, to a level half of `NEAR` inside the range."""
    low, high = getattr(light, level), getattr(heavy, level)
    if not 0 < low < high < math.inf:
        return 0.5
    aim = 1 + (-NEAR if level == "ended" else NEAR) / 2
    return min(0.95, max(0.05, math.log(aim / low) / math.log(high / low)))
