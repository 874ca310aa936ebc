"""The distribution of the pressure."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import written
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
    pressure_distribution(solution, axes)
    [bars] = axes.patches
    values, edges, _ = bars.get_data()
    assert (values * np.diff(edges)).sum() == pytest.approx(solution.contact_fraction, rel=1e-12)
    assert axes.get_xlabel() == f"pressure [{unit}]"
    assert axes.get_title().endswith(unit.removeprefix("m"))


def test_without_contact_there_is_none(axes):
    surface, operator = body("line")
    with pytest.raises(ValueError, match="nothing is in contact"):
        pressure_distribution(rc.press(surface, MODULUS, depth=0.0, operator=operator), axes)


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
        pressure_distribution(solution, axes)
        assert bars(axes) == len(np.histogram_bin_edges(np.arange(cells), "rice")) - 1 < 60
    for part, expected in ((surface, 60), (rc.Surface(surface.heights[:5, :5], rc.Grid((5, 5), 1e-6)), 6)):
        axes = Figure().subplots()
        height_distribution(part, axes)
        assert bars(axes) == expected


def test_a_few_values_far_out_leave_no_half_of_the_axis_empty():
    """One height 300 rms away: the axis spans the others, and the legend says what lies beyond."""
    grid = rc.Grid((64, 64), 1e-6)
    heights = np.random.default_rng(5).normal(0.0, 1e-8, grid.shape)
    height_distribution(rc.Surface(heights, grid), whole := Figure().subplots())
    heights[3, 3] = 3e-6
    axes = height_distribution(rc.Surface(heights, grid), Figure().subplots())
    [drawn] = axes.patches
    values, edges, _ = drawn.get_data()
    assert axes.get_xlim() == (edges[0], edges[-1])
    # The mean moves by 3e-6/4096, less than a tenth of the rms; without the one, the whole is shown.
    assert abs(edges[0]) < 60 < 10 * edges[-1]
    assert (values * np.diff(edges)).sum() == pytest.approx(1, rel=1e-12)
    label = axes.get_legend().get_texts()[0].get_text()
    about = (heights - heights.mean()) * 1e9
    beyond, lowest = (about > edges[-1]) | (about < edges[0]), f"{about.min():.3g} nm"
    assert label == f"heights,\n{100 * beyond.mean():.2g} % of them beyond, {lowest} to 3 µm"
    assert whole.get_legend().get_texts()[0].get_text() == "heights"


def test_pressures_of_a_few_cells_do_not_take_a_quarter_of_the_axis():
    """An edge of a flat punch carries many times what its middle does."""
    solution = rc.press(rc.Surface(np.zeros((64, 64)), rc.Grid((64, 64), 1e-6)), 1e9, force=1.0)
    axes = pressure_distribution(solution, Figure().subplots())
    [drawn] = axes.patches
    values, edges, _ = drawn.get_data()
    pressure = solution.pressure * 1e-6  # MPa
    assert axes.get_xlabel() == "pressure [MPa]"
    assert edges[-1] < 0.75 * pressure.max()
    beyond = (pressure > edges[-1]).mean()
    assert 0 < beyond < (4 * 63 + 4 * 61) / 64**2, "the cells along the edges, and hardly more than these"
    assert (values * np.diff(edges)).sum() == pytest.approx(1 - beyond, rel=1e-12)
    largest = written(float(solution.pressure.max()), "Pa")
    label = f"computed, 100 % in contact,\n{100 * beyond:.2g} % of it beyond, up to {largest}"
    assert axes.get_legend().get_texts()[0].get_text() == label


def test_the_legend_covers_no_bar():
    surface, operator = body("line")
    axes = pressure_distribution(
        rc.press(surface, MODULUS, depth=0.1, operator=operator), Figure(dpi=80).subplots()
    )
    axes.figure.canvas.draw()
    [drawn] = axes.patches
    top = axes.transData.transform((0.0, drawn.get_data().values.max()))[1]
    assert axes.get_legend().get_window_extent().y0 > top


def test_theories_of_pressure_are_drawn_in_the_unit_of_the_axis():
    """Of a map that is not square: per MPa, at MPa, with the pressure over the whole map in the title."""
    grid = rc.Grid((40, 61), (2e-6, 1e-6))
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    solution = rc.press(rc.Surface(-(y[:, None] ** 2 + x**2) / 2e-3, grid), 1e11, force=0.1)
    peak, part = solution.pressure.max(), solution.contact_fraction
    figure = rc.plot.pressure_distribution_figure(
        solution, {"rising": lambda p: 2 * part * p / peak**2, "even": lambda p: part / peak + 0 * p}
    )
    [axes] = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("pressure [MPa]", "part of the nominal area [1/MPa]")
    [drawn] = axes.patches
    values, edges, _ = drawn.get_data()
    shares, places = np.histogram(solution.pressure[solution.contact] / 1e6, len(values), (0, peak / 1e6))
    np.testing.assert_allclose(edges, places, rtol=1e-12)
    np.testing.assert_allclose(values, shares / grid.size / np.diff(places), rtol=1e-12)
    rising, even = (each.get_xydata() for each in axes.lines)
    expected = 2 * part * rising[:, 0] / (peak / 1e6) ** 2
    np.testing.assert_allclose(rising[:, 1], expected, rtol=1e-12)
    np.testing.assert_allclose(even[:, 1], part / (peak / 1e6), rtol=1e-12)
    assert axes.get_xlim() == pytest.approx((0, peak / 1e6), rel=1e-12)
    assert rising[-1, 0] == even[-1, 0] == pytest.approx(peak / 1e6, rel=1e-12)
    assert [text.get_text() for text in axes.get_legend().get_texts()][1:] == ["rising", "even"]
    assert axes.get_title() == f"nominal pressure {written(0.1 / (80e-6 * 61e-6), 'Pa')}"


def test_of_rings_the_area_beyond_the_axis_is_told_and_not_their_number(axes):
    """Under a flat punch the outermost rings, of which the widest is wider than all others, carry many times more."""
    grid = rc.RadialGrid(np.r_[np.linspace(0, 0.9, 120), 1 - 0.1 * 0.5 ** np.arange(1, 9), 1.0])
    solution = rc.press(rc.RadialProfile(np.zeros(grid.shape), grid), 1e3, depth=0.1)
    pressure_distribution(solution, axes)
    end = axes.patches[0].get_data().edges[-1]
    areas, pressure = np.diff(np.pi * grid.edges**2), solution.pressure
    assert axes.get_xlabel() == "pressure [Pa]"
    share = areas[pressure > end].sum() / np.pi
    assert share > 2 * (pressure > end).mean() > 0
    assert f"{100 * share:.2g} % of it beyond" in axes.get_legend().get_texts()[0].get_text()


def test_heights_and_their_normal_distribution_are_drawn_in_the_unit_of_the_axis(axes):
    grid = rc.Grid((40, 61), (2e-6, 1e-6))
    heights = np.random.default_rng(5).normal(3e-8, 1e-8, grid.shape)
    height_distribution(rc.Surface(heights, grid), axes, bins=20)
    assert axes.get_xlabel() == "height above the mean [nm]"
    assert axes.get_ylabel() == "probability density [1/nm]"
    about = (heights - heights.mean()) * 1e9
    values, edges, _ = axes.patches[0].get_data()
    counts, places = np.histogram(about, 20)
    np.testing.assert_allclose(edges, places, rtol=1e-9)
    np.testing.assert_allclose(values, counts / about.size / np.diff(places), rtol=1e-9)
    [normal] = axes.lines
    z, density = normal.get_data()
    assert axes.get_xlim() == pytest.approx((about.min(), about.max()), rel=1e-9)
    assert (z[0], z[-1]) == pytest.approx((about.min(), about.max()), rel=1e-9)
    expected = np.exp(-(z**2) / about.var() / 2) / np.sqrt(2 * np.pi * about.var())
    np.testing.assert_allclose(density, expected, rtol=1e-9)
