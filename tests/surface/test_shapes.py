import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.generation import shapes

GRID = rc.Grid((21, 31), (0.1, 0.2))  # the middle is the centre of cell (10, 15)
Y, X = np.mgrid[-10:11, -15:16] * np.array([0.1, 0.2])[:, None, None]
R = np.hypot(Y, X)


@pytest.mark.parametrize(
    ("surface", "expected"),
    [
        (shapes.paraboloid(GRID, 2.0), -(R**2) / 4),
        (shapes.cone(GRID, 0.3), -0.3 * R),
        (shapes.power_law(GRID, 0.7, 2.0), -2 * R**0.7),
        (shapes.sphere(GRID, 4.0), np.sqrt(16 - R**2) - 4),
        (shapes.cylinder(GRID, 4.0), np.sqrt(16 - Y**2) - 4),
        (shapes.cylinder(GRID, 4.0, axis="y"), np.sqrt(16 - X**2) - 4),
        (shapes.wave(GRID, 0.1, 1.3), 0.1 * (np.cos(2 * np.pi * X / 1.3) - 1)),
        (shapes.wave(GRID, 0.1, 1.3, "y"), 0.1 * (np.cos(2 * np.pi * Y / 1.3) - 1)),
        (
            shapes.wave(GRID, 0.1, 1.3, "both"),
            0.1 * (np.cos(2 * np.pi * X / 1.3) + np.cos(2 * np.pi * Y / 1.3) - 2),
        ),
    ],
)
def test_heights_in_closed_form(surface, expected):
    np.testing.assert_allclose(surface.heights, expected, rtol=0, atol=2e-15)
    # The middle is a rounded number: the height of the apex is 0 to its square (cone: to itself, power law: to ^0.7).
    assert surface.heights[10, 15] == surface.heights.max()
    assert surface.heights[10, 15] == pytest.approx(0, abs=1e-10)


def test_heights_near_an_apex_do_not_cancel():
    """A ball of 1 m seen over nanometres is its osculating paraboloid to r^2/(4 R^2)."""
    grid = rc.Grid((5, 5), 1e-9)
    ball, bowl = shapes.sphere(grid, 1.0).heights, shapes.paraboloid(grid, 1.0).heights
    np.testing.assert_allclose(ball, bowl, rtol=1e-15)


def test_the_centre_is_given_in_the_grid_s_coordinates():
    """Cell i has its centre at (i + 1/2) spacing, y first."""
    moved = shapes.cone(GRID, 1.0, centre=(0.25, 0.5))
    assert moved.heights[2, 2] == pytest.approx(0, abs=1e-15)
    assert moved.heights[3, 4] == pytest.approx(-np.hypot(0.1, 0.4), rel=1e-12)


def test_on_a_periodic_grid_the_nearest_image_counts():
    periodic = shapes.paraboloid(rc.Grid((20, 20), 0.1, True), 1.0, centre=(0.05, 0.05)).heights
    np.testing.assert_allclose(periodic[0], periodic[:, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(periodic[0, 1:], periodic[0, :0:-1], rtol=0, atol=1e-15)
    assert periodic[0, 10] == pytest.approx(-1 / 2, rel=1e-12)  # half a period of 2 m away
    assert periodic[0, 19] == pytest.approx(-(0.1**2) / 2, rel=1e-12)


def test_profiles():
    line = rc.Grid(31, 0.2)
    np.testing.assert_allclose(shapes.paraboloid(line, 2.0).heights, -(X[0] ** 2) / 4, atol=1e-15)
    np.testing.assert_allclose(shapes.cone(line, 0.5, 3.1).heights, -0.5 * np.abs(X[0]), atol=1e-15)
    np.testing.assert_allclose(shapes.wave(line, 1.0, 2.0).heights, np.cos(np.pi * X[0]) - 1, atol=1e-14)


def test_bodies_end_where_they_end():
    ball = shapes.sphere(GRID, 0.9)
    np.testing.assert_array_equal(ball.measured, R <= 0.9 * (1 + 1e-12))
    assert shapes.cylinder(GRID, 0.55).measured.sum() == 11 * 31


@pytest.mark.parametrize("n", [100, 101])
def test_areas_of_flat_punches(n):
    """To the cells whose centres lie within half a diagonal of the rim."""
    grid = rc.Grid((n, n), 1 / n)
    rim = np.sqrt(2) / 2 / n
    for punch, area, perimeter in (
        (shapes.flat_square(grid, 0.3), 0.09, 1.2),
        (shapes.flat_disc(grid, 0.3), 0.09 * np.pi, 0.6 * np.pi),
        (shapes.flat_ring(grid, 0.2, 0.4), 0.12 * np.pi, 1.2 * np.pi),
        (shapes.flat_triangle(grid, 0.5), 0.25 * np.sqrt(3) / 4, 1.5),
    ):
        assert np.nanmax(punch.heights) == np.nanmin(punch.heights) == 0
        assert punch.measured.sum() / n**2 == pytest.approx(area, abs=perimeter * rim)


def test_squares_of_whole_cells():
    """Odd or even, on an odd or even grid, whose middle may lie on a cell's centre or on a corner."""
    for n in (10, 11):
        for cells in (1, 2, 5, 6):
            assert shapes.flat_square(rc.Grid((n, n), 0.1), 0.1 * cells).measured.sum() == cells**2


def test_a_triangle_points_to_the_first_row():
    punch = shapes.flat_triangle(rc.Grid((99, 99), 1 / 99), 0.6).measured
    widths = punch.sum(axis=1)[punch.any(axis=1)]
    assert (np.diff(widths) >= 0).all()
    assert widths[0] < 3
    assert abs(widths[-1] - 0.6 * 99) < 2
    rows, columns = np.nonzero(punch)
    # The centroid, within the half cell by which the rims are off.
    assert rows.mean() == pytest.approx(49, abs=0.5)
    assert columns.mean() == pytest.approx(49, abs=1e-12)


def test_hertz():
    """d = a^2/R, p0 = 2 a E*/(pi R): at 78 cells in the radius to 2e-5, as with heights made by hand."""
    n, a, radius, modulus = 195, 0.4e-3, 0.02, 110e9
    surface = shapes.paraboloid(rc.Grid((n, n), 1e-3 / n), radius)
    solution = rc.press(surface, modulus, force=4 * modulus * a**3 / (3 * radius), tolerance=1e-10)
    assert solution.depth == pytest.approx(a**2 / radius, rel=2e-5)
    assert solution.pressure.max() == pytest.approx(2 * a * modulus / (np.pi * radius), rel=2e-5)


def test_a_cone():
    """Sneddon: F = (2/pi) E* d^2/tan, a = 2 d/(pi tan); the pressure is infinite at the tip: 1 % at 50 cells."""
    n, slope, d = 201, 0.1, 0.04
    solution = rc.press(shapes.cone(rc.Grid((n, n), 1 / n), slope), 1.0, depth=d)
    assert solution.force == pytest.approx(2 / np.pi * d**2 / slope, rel=0.01)
    assert np.sqrt(solution.contact_area / np.pi) == pytest.approx(2 * d / (np.pi * slope), abs=1 / n)


def stiffness(punch):
    return rc.press(punch, 2.0, depth=1e-3).stiffness


def test_flat_punches():
    """k = 2 E* a, to O(1/cells); a ring of half the inner radius 0.981 of it (equation page, 4.22)."""
    coarse, fine = (
        stiffness(shapes.flat_disc(rc.Grid((n, n), 1 / n), 0.4)) / (2 * 2.0 * 0.4) - 1 for n in (65, 129)
    )
    assert abs(coarse) < 1 / 26  # cells in the radius
    assert abs(fine) < 1 / 52
    grid = rc.Grid((129, 129), 1 / 129)
    disc, ring = (stiffness(p) for p in (shapes.flat_disc(grid, 0.4), shapes.flat_ring(grid, 0.2, 0.4)))
    assert ring / disc == pytest.approx(0.981, abs=0.003)
    # Of punches of one area the disc is the softest; the square has 1.02120 and the triangle some 1.06 of it.
    square, triangle = shapes.flat_square(grid, 0.6), shapes.flat_triangle(grid, 0.8)
    betas = [stiffness(p) / (4.0 * np.sqrt(p.measured.sum() / np.pi) / 129) for p in (square, triangle)]
    assert betas[0] == pytest.approx(1.0212, abs=0.01)
    assert betas[0] + 0.02 < betas[1] < 1.08
    outside = rc.press(square, 2.0, depth=1e-3)
    assert outside.missing == grid.size - square.measured.sum()
    assert (outside.pressure[~square.measured] == 0).all()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: shapes.paraboloid(GRID, 0.0), "radius must be"),
        (lambda: shapes.paraboloid(GRID, 1.0, 3.0), "centre needs 2"),
        (lambda: shapes.sphere(GRID, 1.0, (np.nan, 0.0)), "centre needs 2"),
        (lambda: shapes.sphere(GRID, 1.0, (9.0, 9.0)), "no cell centre"),
        (lambda: shapes.cylinder(GRID, 1.0, "z"), "axis must be"),
        (lambda: shapes.cylinder(rc.Grid(9, 1.0), 1.0), "two axes"),
        (lambda: shapes.cone(GRID, -1.0), "slope must be"),
        (lambda: shapes.power_law(GRID, np.inf, 1.0), "exponent must be"),
        (lambda: shapes.power_law(GRID, 1.0, 0.0), "coefficient must be"),
        (lambda: shapes.flat_ring(GRID, 2.0, 1.0), "inner radius"),
        (lambda: shapes.flat_disc(rc.Grid((4, 4), 1.0), 0.1), "refine the grid"),
        (lambda: shapes.flat_square(rc.Grid(9, 1.0), 1.0), "two axes"),
        (lambda: shapes.wave(GRID, 1.0, 1.0, "z"), "axis must be"),
        (lambda: shapes.wave(rc.Grid(9, 1.0), 1.0, 1.0, "both"), "on a line 'x'"),
        (lambda: shapes.wave(rc.Grid(10, 0.1, True), 1.0, 0.7), "take a whole number"),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
