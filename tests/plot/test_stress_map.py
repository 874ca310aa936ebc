"""The picture of the stress below a row of cells."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.evaluation.below import below, largest_von_mises
from roughcontact.plot.stress_map import von_mises_section


@pytest.fixture(scope="module")
def solution():
    grid = rc.Grid((40, 61), 1e-6)
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    return rc.press(rc.Surface(-(y[:, None] ** 2 + x**2) / 2e-3, grid), 1e11, force=0.05)


def image_of(axes):
    (image,) = axes.images
    return image


def test_it_shows_the_stress_in_its_place(solution):
    """Every depth of the picture is that of `below`, in megapascals, on axes in micrometres."""
    axes = Figure().subplots()
    von_mises_section(solution, 0.3, axes, row=20, deepest=8e-6)
    image = image_of(axes)
    left, right, bottom, top = image.get_extent()
    assert (bottom, top) == pytest.approx((8.0, 0.0))
    first, last = round(left), round(right)
    values = np.asarray(image.get_array())
    assert values.shape == (40, last - first)
    exact = below(solution, (np.arange(40) + 0.5) * 0.2e-6, 0.3).von_mises[:, 20, first:last]
    np.testing.assert_allclose(values, exact * 1e-6, rtol=1e-9, atol=1e-9 * values.max())
    assert axes.get_xlabel() == "x [µm]"
    assert axes.get_ylabel() == "depth [µm]"


def test_columns_lie_where_they_are_on_cells_that_are_not_square():
    grid = rc.Grid((40, 31), (1e-6, 2e-6))
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    ball = rc.Surface(-(y[:, None] ** 2 + x**2) / 2e-3, grid)
    solution = rc.press(ball, 1e11, force=0.05)
    left, right, *_ = image_of(von_mises_section(solution, 0.3, Figure().subplots())).get_extent()
    loaded = np.flatnonzero(solution.contact.any(axis=0))
    assert (left + right) / 2 == pytest.approx((loaded[0] + loaded[-1] + 1) / 2 * 2.0, abs=2.0)  # um


def test_it_marks_the_largest_and_the_cells_in_contact(solution):
    axes = Figure().subplots()
    von_mises_section(solution, 0.3, axes)
    peak = largest_von_mises(solution, 0.3)
    (mark,) = (line for line in axes.lines if line.get_marker() == "+")
    assert mark.get_xdata()[0] == pytest.approx(peak.position[1] * 1e6, abs=1e-6)
    assert mark.get_ydata()[0] == pytest.approx(peak.depth * 1e6, abs=0.5)
    row = int(np.argmax(solution.pressure.max(axis=1)))
    segments = axes.collections[0].get_segments()
    assert len(segments) == solution.contact[row].sum()
    cells = np.flatnonzero(solution.contact[row])  # of 1 um
    np.testing.assert_allclose([s[:, 0] for s in segments], np.stack([cells, cells + 1], axis=1), atol=1e-6)
    assert "largest in this section" in axes.get_title()


def test_a_solid_serves_as_its_ratio(solution):
    axes = von_mises_section(solution, rc.Solid(7e10, 0.3), Figure().subplots())
    other = von_mises_section(solution, 0.3, Figure().subplots())
    np.testing.assert_array_equal(image_of(axes).get_array(), image_of(other).get_array())
    axes.figure.canvas.draw()


def test_nonsense_is_refused(solution):
    axes = Figure().subplots()
    with pytest.raises(ValueError, match="row 40 lies beside the contact"):
        von_mises_section(solution, 0.3, axes, row=40)
    with pytest.raises(ValueError, match="positive, finite depth"):
        von_mises_section(solution, 0.3, axes, deepest=0.0)
