"""Pictures of loops: what is drawn is what was computed."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import written
from roughcontact.plot.loops import bearing_of


def plane():
    grid = rc.Grid((24, 20), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=np.random.default_rng(3))
    return rc.loading_loop(surface, 1e11, hardness=4e9, pressures=[1e7, 4e7, 1e8])


def rings():
    edges = rc.RadialGrid.uniform(40, 1e-4)
    ball = rc.RadialProfile(-(edges.radii**2) / 2e-2, edges)
    return rc.loading_loop(ball, 1e11, hardness=8e7, forces=[0.05, 0.2])


def line():
    grid = rc.Grid(80, 1e-6)
    scan = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=np.random.default_rng(5))
    return rc.loading_loop(
        scan, 1e11, hardness=1.5e9, forces=[1e3, 4e3], operator=rc.line(grid, 1e11), flow="raised"
    )


def per_unit(label):
    """Return how many of the units of an axis are in one of SI."""
    unit = label[label.index("[") + 1 : label.index("]")]
    factors = {"n": 1e9, "µ": 1e6, "m": 1e3, "k": 1e-3, "M": 1e-6, "G": 1e-9}
    return 1.0 if unit in ("m", "N", "Pa", "N/m") else factors[unit[0]]


@pytest.fixture(params=[plane, rings, line], scope="module")
def loop(request):
    return request.param()


def test_force_against_depth_begins_and_ends_where_nothing_bears(loop):
    axes = loop.plot(Figure().subplots())
    first, back, again = (drawn.get_xydata() for drawn in axes.lines)
    np.testing.assert_array_equal(first[0], (0, 0))
    assert back[-1, 1] == again[0, 1] == 0
    assert back[-1, 0] == again[0, 0] > 0
    assert first[-1, 0] / back[-1, 0] == pytest.approx(loop.loading.depth[-1] / loop.residual_depth)
    scales = per_unit(axes.get_xlabel()), per_unit(axes.get_ylabel())
    assert scales[0] != scales[1]  # so that one cannot stand for the other
    np.testing.assert_allclose(first[1:], np.stack([loop.loading.depth, loop.loading.force], 1) * scales)
    np.testing.assert_allclose(back[:-1], np.stack([loop.unloading.depth, loop.unloading.force], 1) * scales)
    np.testing.assert_allclose(again[1:], np.stack([loop.reloading.depth, loop.reloading.force], 1) * scales)
    np.testing.assert_allclose(back[-1], (loop.residual_depth * scales[0], 0))
    assert axes.get_title() == f"residual depth {written(loop.residual_depth, 'm')}"
    assert len(first) == len(back) == len(again) == len(loop.loading) + 1


def test_the_stiffness_per_area_of_every_branch(loop):
    axes = loop.plot(Figure().subplots(), quantity="stiffness")
    area = loop.loading.nominal_area
    assert axes.get_ylabel() == "interfacial stiffness per area K/A0 [N/µm/mm²]"
    scales = per_unit(axes.get_xlabel()), 1e-12
    line, *branches = (drawn.get_xydata() for drawn in axes.lines)
    turns = loop.loading.flow.unloading_interfacial_stiffness / area
    np.testing.assert_allclose(line, np.stack([loop.loading.force / area, turns], 1) * scales)
    for drawn, curve in zip(branches, (loop.loading, loop.unloading, loop.reloading), strict=True):
        expected = np.stack([curve.force, curve.interfacial_stiffness], 1) / area * scales
        np.testing.assert_allclose(drawn, expected[np.isfinite(expected).all(axis=1)])
    turned, first, back, _ = (drawn.get_ydata() for drawn in axes.lines)
    assert (turned >= first * (1 - 1e-12)).all()
    assert turned[-1] == pytest.approx(back[0], rel=1e-6)
    expected = loop.loading.interfacial_stiffness[-1] / loop.unloading.interfacial_stiffness[0]
    assert first[-1] / back[0] == pytest.approx(expected)


def test_an_infinite_stiffness_has_no_place_in_a_loop():
    """Full contact at the largest load, on a periodic map that is not square."""
    grid = rc.Grid((12, 16), (1e-6, 2e-6), periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-9, rng=np.random.default_rng(3))
    loop = rc.loading_loop(surface, 1e11, hardness=2e9, pressures=[1e6, 1e7, 1e9])
    assert np.isinf(loop.loading.interfacial_stiffness[-1])
    axes = loop.plot(Figure().subplots(), quantity="stiffness")
    assert all(np.isfinite(drawn.get_xydata()).all() for drawn in axes.lines)
    assert len(axes.lines[1].get_xdata()) == np.isfinite(loop.loading.interfacial_stiffness).sum() > 0


def test_the_bearing_curve_is_cut_off(loop):
    axes = loop.plot(Figure().subplots(), quantity="bearing")
    assert [drawn.get_label() for drawn in axes.lines] == ["before", "after"]
    before, after = (drawn.get_xydata() for drawn in axes.lines)
    assert before[-1, 0] == after[-1, 0] == 100
    assert after[0, 1] < before[0, 1]
    share, heights = bearing_of(loop.surface)
    mean = np.average(heights, weights=np.diff(share, prepend=0.0))
    for drawn, body in ((before, loop.surface), (after, loop.flow.flatten(loop.surface))):
        share, heights = bearing_of(body)  # both above the mean of the first
        expected = np.stack([100 * share, (heights - mean) * per_unit(axes.get_ylabel())], 1)
        np.testing.assert_allclose(drawn, expected, atol=1e-9)
    assert axes.get_xlabel() == "area above the height [%]"
    assert (np.diff(after[:, 1]) <= 0).all()


def test_the_bearing_curve_of_rings_counts_their_areas():
    """Heights that fall outwards: the share above each is that of the disc within."""
    grid = rc.RadialGrid(np.array([0.0, 1.0, 3.0, 4.0]))
    share, heights = bearing_of(rc.RadialProfile(np.array([3.0, 2.0, 1.0]), grid))
    np.testing.assert_allclose(share, np.array([1.0, 9.0, 16.0]) / 16, rtol=1e-14)
    np.testing.assert_array_equal(heights, [3.0, 2.0, 1.0])


def test_the_bearing_curve_is_the_material_ratio():
    surface = plane().surface
    share, heights = bearing_of(surface)
    known = rc.material_ratio(surface)
    # Of n points the i-th highest stands at (i - 1/2)/n there, and all of its cell is counted here.
    np.testing.assert_allclose(known.ratio_at(heights), share, atol=0.51 / surface.grid.size)


def test_whole_figures_are_drawn(loop):
    for figure in (rc.plot.loop_figure(loop), rc.plot.flattened_figure(loop.surface, loop.flow)):
        figure.canvas.draw()
    depth, stiffness = rc.plot.loop_figure(loop).axes
    assert depth.get_xlabel().startswith("depth [")
    assert stiffness.get_xlabel().startswith("nominal pressure [")
    first, bearing = rc.plot.flattened_figure(loop.surface, loop.flow).axes[:2]
    assert first.get_title() == f"flattened by up to {written(float(loop.flow.depth.max()), 'm')}"
    assert bearing.get_xlabel() == "area above the height [%]"


def test_the_map_of_a_flattened_surface_is_that_of_after():
    """On cells that are not square; micrometres along the sides, nanometres up."""
    grid = rc.Grid((24, 20), (1e-6, 1.5e-6), periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=np.random.default_rng(3))
    flow = rc.press(surface, 1e11, pressure=2e8, hardness=4e9).flow
    [image] = rc.plot.flattened_figure(surface, flow).axes[0].images
    assert image.get_extent() == pytest.approx((0, 30, 24, 0))
    assert np.count_nonzero(flow.depth) > 2
    np.testing.assert_allclose(image.get_array(), (surface.heights - flow.depth) * 1e9, rtol=1e-9)


@pytest.mark.parametrize("make", [rings, line])
def test_lines_and_rings_are_drawn_before_and_after(make):
    loop = make()
    axes, bearing = rc.plot.flattened_figure(loop.surface, loop.flow).axes
    assert [drawn.get_color() for drawn in axes.lines] == [drawn.get_color() for drawn in bearing.lines]
    assert axes.lines[0].get_color() != axes.lines[1].get_color()
    scales = per_unit(axes.get_xlabel()), per_unit(axes.get_ylabel())
    assert scales[0] != scales[1]
    assert [drawn.get_label() for drawn in axes.lines] == ["before", "after"]
    for drawn, body in zip(axes.lines, (loop.surface, loop.flow.flatten(loop.surface)), strict=True):
        expected = np.stack([body.grid.coordinates[0], body.heights], 1) * scales
        np.testing.assert_allclose(drawn.get_xydata(), expected)


def test_another_quantity_is_refused(loop):
    with pytest.raises(ValueError, match="depth, stiffness, bearing, not 'area'"):
        loop.plot(quantity="area")
