"""A profile under load: the drawn lines are the heights over the flat, the drawn area the pressure."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import written

MODULUS = 1e11


@pytest.fixture(scope="module", params=[rc.line, rc.foundation])
def solution(request):
    line = rc.self_affine(rc.Grid(256, 1e-6), 0.8, 1e-7, np.random.default_rng(4))
    return rc.press(line, MODULUS, depth=1e-7, operator=request.param(line.grid, MODULUS))


def test_heights_are_those_over_the_flat(solution):
    axes = rc.plot.contact_profile(solution, Figure().subplots())
    before, under = axes.lines
    assert [each.get_label() for each in axes.lines] == ["before", "under the load"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [µm]", "height over the flat [nm]")
    highest = int(np.argmin(solution.problem.separation))
    x, z = (each[highest] for each in before.get_data())
    assert x == pytest.approx(highest + 0.5)  # um
    assert z == pytest.approx(solution.depth * 1e9)  # nm: so far has the flat come
    np.testing.assert_allclose(under.get_ydata(), -solution.gap * 1e9, atol=1e-9)
    np.testing.assert_allclose(under.get_ydata()[solution.contact], 0.0, atol=1e-6)


def test_points_that_were_not_measured_are_left_out():
    """Of a line in millimetres under a load that brings it micrometres nearer."""
    heights = rc.self_affine(rc.Grid(256, 1e-5), 0.8, 1e-5, np.random.default_rng(4)).heights.copy()
    heights[40:50] = np.nan
    line = rc.Surface(heights, rc.Grid(256, 1e-5))
    solution = rc.press(line, MODULUS, depth=1e-5, operator=rc.foundation(line.grid, MODULUS))
    axes = rc.plot.contact_profile(solution, Figure().subplots())
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "height over the flat [µm]")
    x, z = axes.lines[0].get_data()
    np.testing.assert_allclose(x, (np.arange(256) + 0.5) * 0.01, rtol=1e-12)
    np.testing.assert_allclose(z, (heights - np.nanmax(heights) + 1e-5) * 1e6, rtol=1e-9, atol=1e-9)
    bars = [segment[:, 0] for segment in axes.collections[0].get_segments()]
    cells = np.flatnonzero(solution.contact)
    np.testing.assert_allclose(bars, np.stack([cells, cells + 1], 1) * 0.01, rtol=1e-12)
    axes = rc.plot.pressure_profile(solution, Figure().subplots())
    assert axes.get_title() == f"at most {written(float(solution.pressure.max()), 'N m-1')}"


def test_the_spikes_of_a_row_of_a_map_are_those_of_the_row():
    """The middle row without another, of a map of 40 rows that are 3 um apart; heights in nm."""
    grid = rc.Grid((40, 61), (3e-6, 1e-6))
    heights = np.random.default_rng(2).normal(0.0, 1e-9, grid.shape)
    heights[20, 7] += 5e-7
    heights[0, 30] += 5e-7
    surface = rc.Surface(heights, grid)
    axes = rc.plot.profile_curve(surface, Figure().subplots(), spikes=rc.find_spikes(surface))
    drawn, marks = axes.lines
    np.testing.assert_allclose(drawn.get_xdata(), np.arange(61) + 0.5, rtol=1e-12)
    np.testing.assert_allclose(drawn.get_ydata(), heights[20] * 1e9, rtol=1e-12)
    np.testing.assert_allclose(marks.get_xydata(), [(7.5, heights[20, 7] * 1e9)], rtol=1e-12)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [µm]", "height [nm]")


def test_the_figure_of_a_solution_is_that_of_its_kind(solution):
    figure = rc.plot.solution_figure(solution)
    assert len(figure.axes) == 2
    unit = {"line": "N/m,", "foundation": "N,"}[solution.problem.geometry.value]
    assert unit in figure.get_suptitle()


def test_the_outer_axes_of_a_line_know_no_length():
    line = rc.self_affine(rc.Grid(256, 1e-6), 0.8, 1e-7, np.random.default_rng(4))
    figure = rc.plot.curve_figure(rc.loading_curve(line, MODULUS, operator=rc.line(line.grid, MODULUS)))
    labels = [
        axis.get_label_text()
        for axes in figure.axes
        for child in axes.child_axes
        for axis in (child.xaxis, child.yaxis)
    ]
    assert r"$\bar{k}$ = stiffness / E*" in labels
    assert r"$\bar{F}$ = force / (E* h)" in labels
