"""The distribution of the pressure."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.distributions import height_distribution, pressure_distribution

MODULUS = 2.0


@pytest.fixture
def axes():
    return Figure().subplots()


def body(kind):
    if kind == "ring":
        grid = rc.RadialGrid(np.r_[0, np.cumsum(np.linspace(0.005, 0.05, 40))])
        return rc.RadialProfile(-(grid.radii**2) / 2, grid), rc.ring(grid, MODULUS)
    grid = rc.Grid(200, 0.01)
    surface = rc.Surface(-((grid.coordinates[0] - 1) ** 2) / 2, grid)
    return surface, rc.line(grid, MODULUS) if kind == "line" else rc.foundation(grid, MODULUS)


@pytest.mark.parametrize(("kind", "unit"), [("ring", "mPa"), ("line", "mPa"), ("foundation", "mN/m")])
def test_bars_fill_the_share_in_contact(axes, kind, unit):
    """All but the cells of the largest pressure, a thousandth of them: here none, or one."""
    surface, operator = body(kind)
    solution = rc.press(surface, MODULUS, depth=0.1, operator=operator)
    pressure_distribution(axes, solution)
    [bars] = axes.patches
    values, edges, _ = bars.get_data()
    assert (values * np.diff(edges)).sum() == pytest.approx(solution.contact_fraction, rel=1e-12)
    assert axes.get_xlabel() == f"pressure [{unit}]"
    assert axes.get_title().endswith(unit.removeprefix("m"))


def test_without_contact_there_is_none(axes):
    surface, operator = body("line")
    with pytest.raises(ValueError, match="nothing is in contact"):
        pressure_distribution(axes, rc.press(surface, MODULUS, depth=0.0, operator=operator))


def bars(axes):
    [drawn] = axes.patches
    return len(drawn.get_data().values)


def test_few_values_make_few_bars_and_many_as_many_as_asked_for():
    """Few: as NumPy counts them by the rule of Rice."""
    grid = rc.Grid((200, 200), 1e-6)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    for depth in (3e-7, 1e-6):
        solution = rc.press(surface, 1e9, depth=depth)
        cells = np.count_nonzero(solution.contact)
        assert 5 < cells < 2000
        axes = Figure().subplots()
        pressure_distribution(axes, solution)
        assert bars(axes) == len(np.histogram_bin_edges(np.arange(cells), "rice")) - 1 < 60
    for part, expected in ((surface, 60), (rc.Surface(surface.heights[:5, :5], rc.Grid((5, 5), 1e-6)), 6)):
        axes = Figure().subplots()
        height_distribution(axes, part)
        assert bars(axes) == expected
