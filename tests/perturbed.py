"""Loads on all kinds of body, and their central differences with respect to heights."""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import roughcontact as rc

MODULUS, TOLERANCE, STEP = 1.0, 1e-13, 1e-6  # the step is relative to the rms height
EPS = np.finfo(float).eps
SIDE = 1 / 48


class Case(NamedTuple):
    """A body, the arguments of `rc.press` beside its load, and its force."""

    body: Any
    options: dict[str, Any]
    force: float


def _rough(grid, seed=3):
    whole = rc.Grid(grid.shape, grid.spacing, periodic=True)
    side = min(whole.lengths)
    return rc.self_affine(
        whole, hurst=0.8, rms=0.01, rng=seed, rolloff=side / 4, short_cutoff=side / 8
    ).heights


def _plane(shape=(48, 48), spacing=SIDE, periodic=False, *, holes=False, force, operator=None):
    grid = rc.Grid(shape, spacing, periodic=periodic)
    heights = _rough(grid).copy()
    if holes:
        heights[np.unravel_index(heights.argmax(), shape)] = np.nan  # the highest cell is another one then
        heights[10:14, 20:25] = np.nan
    return Case(rc.Surface(heights, grid), {} if operator is None else {"operator": operator(grid)}, force)


def _line(operator, force=0.002):
    grid = rc.Grid(256, 1 / 256)
    heights = 0.01 * np.sin(np.linspace(0, 40, 256)) + 0.003 * np.random.default_rng(0).normal(size=256)
    return Case(rc.Surface(heights, grid), {"operator": operator(grid)}, force)


def _rings():
    """Return rings of unequal widths, so that neither weights nor their differences are the same."""
    edges = np.concatenate([[0.0], np.random.default_rng(0).uniform(0.5, 1.5, 100).cumsum()])
    grid = rc.RadialGrid(edges / edges[-1])
    heights = -(grid.radii**2) / 2 + 0.01 * np.cos(30 * grid.radii)
    return Case(rc.RadialProfile(heights, grid), {}, 0.01)


def _soft(grid):
    return rc.layer(grid, rc.Solid(1.0, 0.45), 0.1, base="bonded")


CASES: dict[str, Callable[[], Case]] = {
    "free": lambda: _plane(force=0.002),
    "periodic": lambda: _plane(periodic=True, force=0.01),
    "free, cells missing": lambda: _plane(holes=True, force=0.002),
    "periodic, cells missing": lambda: _plane(periodic=True, holes=True, force=0.01),
    "unequal sides, not square": lambda: _plane((40, 30), (1 / 40, 1 / 60), force=0.001),
    "periodic, unequal sides, not square": lambda: _plane((30, 40), (1 / 60, 1 / 40), True, force=0.004),
    "singly periodic": lambda: _plane(periodic=(True, False), force=0.002),
    "bonded layer": lambda: _plane(force=0.004, operator=_soft),
    "periodic layer": lambda: _plane(periodic=True, force=0.01, operator=_soft),
    "line": lambda: _line(lambda grid: rc.line(grid, MODULUS)),
    "Winkler foundation": lambda: _line(lambda grid: rc.foundation(grid, MODULUS)),
    "unequal rings": _rings,
}


def pressed(case, body=None, **load):
    """Return the load of a case, or another one, on its body or another one."""
    load = load or {"force": case.force}
    return rc.press(body or case.body, MODULUS, tolerance=TOLERANCE, **load, **case.options)


def moved(body, change):
    """Return a body with heights changed."""
    return dataclasses.replace(body, heights=body.heights + change)


def step_of(body):
    """Return the change of a height, or of each height by a standard deviation."""
    return STEP * np.nanstd(body.heights)


def uncertainty(state):
    """Return the largest error of a depth by the residual of a state, and by the rounding of its lengths.

    If the conditions of contact are violated by r, the state is that of heights changed by r. The weighted sum of such
    changes over the contact is at most r times the sum of weights.
    """
    separation = state.problem.separation
    lengths = state.depth + separation[np.isfinite(separation)].max()
    return state.residual * np.abs(state.displacement).max() + 4 * EPS * lengths


def pair(case, direction, level=None, **load):
    """Return the loads of heights changed forth and back, and the step; None if their contact regions differ."""
    step = step_of(case.body)
    states = []
    for sign in (1, -1):
        body, at = moved(case.body, sign * step * direction), dict(load)
        if (
            level is not None
        ):  # the depth from a level, which is that since first touch less the rise of the highest
            at = {"depth": load["depth"] + np.nanmax(body.heights) - level}
        states.append(pressed(case, body, **at))
    same = np.array_equal(states[0].contact, states[1].contact) and np.array_equal(
        states[0].plastic, states[1].plastic
    )
    return (*states, step) if same else None


def single(case, cell):
    """Return the direction in which one height changes."""
    direction = np.zeros(case.body.grid.shape)
    direction[tuple(cell)] = 1.0
    return direction
