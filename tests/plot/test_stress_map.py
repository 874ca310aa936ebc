"""The picture of the stress below a row of cells."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.evaluation.below import below, largest_von_mises
from roughcontact.labels.engineering_units import written
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
    assert image.get_clim() == pytest.approx((0.0, values.max()))
    exact = below(solution, (np.arange(40) + 0.5) * 0.2e-6, 0.3).von_mises[:, 20, first:last]
    np.testing.assert_allclose(values, exact * 1e-6, rtol=1e-9, atol=1e-9 * values.max())
    assert axes.get_xlabel() == "x [µm]"
    assert axes.get_ylabel() == "depth [µm]"


def test_columns_lie_where_they_are_on_cells_that_are_not_square():
    grid = rc.Grid((40, 31), (1e-6, 2e-6))
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    ball = rc.Surface(-(y[:, None] ** 2 + x**2) / 2e-3, grid)
    solution = rc.press(ball, 1e11, force=0.05)
    axes = von_mises_section(solution, 0.3, Figure().subplots())
    left, right, bottom, top = image_of(axes).get_extent()
    loaded = np.flatnonzero(solution.contact.any(axis=0))
    assert (left + right) / 2 == pytest.approx((loaded[0] + loaded[-1] + 1) / 2 * 2.0, abs=2.0)  # um
    assert right - left == pytest.approx(2.0 * image_of(axes).get_array().shape[1])
    # The picture ends at the depth that the contact extends over, along either axis.
    rows = np.flatnonzero(solution.contact.any(axis=1))
    assert bottom == pytest.approx(max(2.0 * (np.ptp(loaded) + 1), np.ptp(rows) + 1.0))
    assert top == 0
    values = np.asarray(image_of(axes).get_array())
    middle = int(np.argmax(solution.pressure.max(axis=1)))
    exact = below(solution, (np.arange(40) + 0.5) * bottom * 1e-6 / 40, 0.3).von_mises
    columns = slice(round(left / 2), round(right / 2))
    np.testing.assert_allclose(values, exact[:, middle, columns] * 1e-6, rtol=1e-9, atol=1e-9 * values.max())


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
    values = np.asarray(image_of(axes).get_array())
    deep = (int(values.max(axis=1).argmax()) + 0.5) * image_of(axes).get_extent()[2] / 40  # um
    largest, below_it = written(values.max() * 1e6, "Pa"), written(deep * 1e-6, "m")
    assert axes.get_title() == f"largest in this section {largest}, {below_it} deep"
    assert image_of(axes).colorbar.ax.get_ylabel() == "von Mises stress [MPa]"


def test_a_section_of_a_large_map_is_drawn_in_millimetres():
    grid = rc.Grid((40, 31), (1e-4, 2e-4))
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    ball = rc.Surface(-(y[:, None] ** 2 + x**2) / 2e-1, grid)
    solution = rc.press(ball, 1e11, force=500)
    axes = von_mises_section(solution, 0.3, Figure().subplots(), row=20)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "depth [mm]")
    left, _, bottom, _ = image_of(axes).get_extent()
    values = np.asarray(image_of(axes).get_array())
    deep, across = np.unravel_index(values.argmax(), values.shape)
    (mark,) = axes.lines
    assert mark.get_xdata()[0] == pytest.approx(left + (across + 0.5) * 0.2)
    assert mark.get_ydata()[0] == pytest.approx((deep + 0.5) * bottom / 40)
    segments = [segment[:, 0] for segment in axes.collections[0].get_segments()]
    cells = np.flatnonzero(solution.contact[20])
    assert len(cells) > 0
    np.testing.assert_allclose(segments, np.stack([cells, cells + 1], axis=1) * 0.2, rtol=1e-9)


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
