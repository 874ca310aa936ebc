"""Grids, surfaces and loads that Hypothesis draws, and shrinks to small ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.surface.generation.fourier import self_affine
from roughcontact.surface.surface import Surface
from roughcontact.validation import require, whole

try:
    from hypothesis import strategies as st
except ImportError as error:  # the rest of the package does without
    raise InputError(
        "roughcontact.testing needs hypothesis", 'pip install "roughcontact[testing]"'
    ) from error

if TYPE_CHECKING:
    from collections.abc import Callable

    from hypothesis.strategies import DrawFn, SearchStrategy

__all__ = ["grids", "loads", "surfaces"]

T = TypeVar("T")
SPACING = (1e-9, 1e-3)  # m
SLOPE = (1e-4, 1.0)  # rms height over the smaller side
ROUNDED = 1e-9  # of the heights: a mean separation below is that of a flat surface
FRACTIONS = (1e-4, 0.3)  # of what presses a surface about flat


def grids(least: int = 2, most: int = 64, *, periodic: bool | None = None) -> SearchStrategy[Grid]:
    """Return a strategy of grids of two axes, square cells or not.

    Parameters
    ----------
    least, most : int
        Cells along a side.
    periodic : bool, optional
        Along both axes or none; by default either.

    Returns
    -------
    SearchStrategy of Grid

    Raises
    ------
    ValueError
        If there are no such numbers of cells.

    Examples
    --------
    >>> from hypothesis import find
    >>> from roughcontact.testing import grids
    >>> find(grids(4, 16, periodic=True), lambda grid: grid.size > 20).shape
    (4, 6)
    """
    low, high = whole(least, "least"), whole(most, "most")
    require(
        0 < low <= high,
        f"least and most must be increasing numbers from 1 on, not {low} and {high}",
        place="least",
    )
    sides = st.tuples(st.integers(low, high), st.integers(low, high))
    spacing = _scaled(*SPACING)
    stretched = st.one_of(st.just(1.0), _scaled(0.5, 2.0))
    kinds = st.booleans() if periodic is None else st.just(periodic)
    return st.builds(
        lambda shape, own, ratio, around: Grid(shape, (own, own * ratio), around),
        sides,
        spacing,
        stretched,
        kinds,
    )


def surfaces(on: SearchStrategy[Grid] | None = None, *, missing: bool = False) -> SearchStrategy[Surface]:
    """Return a strategy of rough surfaces: self-affine ones, patterns of two levels, and single peaks.

    Parameters
    ----------
    on : SearchStrategy of Grid, optional
        The grids; by default `grids`.
    missing : bool
        Whether cells may be missing, as in a measured map.

    Returns
    -------
    SearchStrategy of Surface

    Examples
    --------
    >>> from hypothesis import find
    >>> from roughcontact.testing import surfaces
    >>> find(surfaces(), lambda surface: surface.heights.max() > surface.heights.min()).heights.ndim
    2
    """

    def drawn(draw: DrawFn) -> Surface:
        grid = draw(grids() if on is None else on)
        rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
        height = draw(_scaled(*SLOPE)) * min(grid.lengths)
        kind = draw(st.sampled_from(("peak", "levels", "rough")))
        if kind == "rough" and min(grid.shape) > 3:
            hurst = draw(st.floats(0.05, 2.0))
            heights = self_affine(grid, hurst, height, rng).heights.copy()
        elif kind == "levels":
            heights = np.where(rng.random(grid.shape) < draw(st.floats(0.05, 0.95)), height, 0.0)
        else:
            heights = np.zeros(grid.shape)
            heights.flat[rng.integers(grid.size)] = height
        if missing and draw(st.booleans()):
            heights[rng.random(grid.shape) < draw(st.floats(0.0, 0.3))] = np.nan
        if not np.isfinite(heights).any():
            heights.flat[0] = 0.0
        return Surface(heights, grid)

    return _composed(drawn)


def loads(surface: Surface, modulus: float) -> SearchStrategy[dict[str, float]]:
    """Return a strategy of loads of a surface, as arguments of `press`: a force, pressure or depth.

    Parameters
    ----------
    surface : Surface
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    SearchStrategy of dict
        A name and its value: force [N], pressure [Pa] or depth [m], up to about a third of what presses the surface
        flat. A flat periodic surface has no depth.

    Examples
    --------
    >>> from hypothesis import given
    >>> import roughcontact as rc
    >>> from roughcontact.testing import loads, surfaces
    >>> @given(surfaces().flatmap(lambda surface: loads(surface, 1e9).map(lambda load: (surface, load))))
    ... def test_pressures_push(problem):
    ...     surface, load = problem
    ...     assert rc.press(surface, 1e9, **load).pressure.min() >= 0
    """
    heights = surface.heights[np.isfinite(surface.heights)]
    height = float(heights.max() - heights.min()) or 1e-3 * min(surface.grid.lengths)
    pressure = modulus * height / max(surface.grid.lengths)
    most = {"force": pressure * surface.grid.area, "pressure": pressure, "depth": height}
    if all(surface.grid.periodic):  # in full contact at the mean of the heights
        most["depth"] = float(heights.max() - heights.mean())
    if not most["depth"] > ROUNDED * height:
        del most["depth"]

    return st.sampled_from(sorted(most)).flatmap(
        lambda name: _scaled(*FRACTIONS).map(lambda share: {name: most[name] * share})
    )


def _scaled(low: float, high: float) -> SearchStrategy[float]:
    """Return a strategy of numbers that are uniform in their logarithm."""
    return st.floats(float(np.log(low)), float(np.log(high))).map(lambda number: float(np.exp(number)))


def _composed(drawn: Callable[[DrawFn], T]) -> SearchStrategy[T]:
    """Return the strategy of a function that draws."""
    made: Callable[[], SearchStrategy[T]] = st.composite(drawn)
    return made()
