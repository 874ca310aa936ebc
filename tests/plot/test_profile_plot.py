"""A profile under load: the drawn lines are the heights over the flat, the drawn area the pressure."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc

MODULUS = 1e11


@pytest.fixture(scope="module", params=[rc.line, rc.foundation])
def solution(request):
    line = rc.self_affine(rc.Grid(256, 1e-6), 0.8, 1e-7, np.random.default_rng(4))
    return rc.press(line, MODULUS, depth=1e-7, operator=request.param(line.grid, MODULUS))


def test_heights_are_those_over_the_flat(solution):
    axes = rc.plot.contact_profile(solution, Figure().subplots())
    before, under = axes.lines
    highest = int(np.argmin(solution.problem.separation))
    x, z = (each[highest] for each in before.get_data())
    assert x == pytest.approx(highest + 0.5)  # um
    assert z == pytest.approx(solution.depth * 1e9)  # nm: so far has the flat come
    np.testing.assert_allclose(under.get_ydata(), -solution.gap * 1e9, atol=1e-9)
    np.testing.assert_allclose(under.get_ydata()[solution.contact], 0.0, atol=1e-6)


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
