import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.generation import shapes
from roughcontact.surface.preparation.combine import combined, resampled

GRID = rc.Grid((40, 48), (0.1, 0.2))


def rough(grid=GRID, seed=0):
    return rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(seed))


def test_arithmetic():
    one, two = rough(), shapes.paraboloid(GRID, 5.0)
    np.testing.assert_array_equal((one + two).heights, one.heights + two.heights)
    np.testing.assert_array_equal((one - two).heights, one.heights - two.heights)
    for product in (one * 2, 2 * one, np.float64(2) * one, one * np.int64(2)):
        np.testing.assert_array_equal(product.heights, 2 * one.heights)
        assert product.provenance == (*one.provenance, "heights times 2")
    assert (one + two).provenance == (*one.provenance, "plus: paraboloid, radius 5 m")
    assert (one - rc.Surface(np.zeros(GRID.shape), GRID)).provenance[-1] == "minus: a surface"


def test_what_is_missing_in_one_is_missing_in_the_sum():
    punch = shapes.flat_disc(GRID, 1.0)
    np.testing.assert_array_equal((rough() + punch).measured, punch.measured)


@pytest.mark.parametrize(
    "other",
    [
        rc.Grid((40, 48), (0.1, 0.2), True),
        rc.Grid((48, 40), (0.1, 0.2)),
        rc.Grid((40, 48), (0.1, 0.2001)),
    ],
)
def test_only_surfaces_on_one_grid_are_added(other):
    with pytest.raises(ValueError, match="on one grid"):
        _ = rough() + rough(other)
    close = rc.Grid((40, 48), (0.1, 0.1 + 0.1 + 1e-12))
    assert (rough() + rough(close)).grid == GRID


def test_only_numbers_multiply():
    with pytest.raises(TypeError):
        _ = rough() * rough()
    with pytest.raises(TypeError):
        _ = rough() + 1.0
    with pytest.raises(TypeError):
        _ = np.ones(GRID.shape) * rough()
    with pytest.raises(ValueError, match="finite number"):
        _ = rough() * np.inf


def test_two_bodies_on_one_grid():
    """The gap at any place is a constant less both heights there: turned about y, column j meets column -1-j."""
    lower, upper = rough(seed=1), rough(seed=2)
    pages = combined(lower, upper)
    np.testing.assert_array_equal(pages.heights, lower.heights + upper.heights[:, ::-1])
    np.testing.assert_array_equal(
        combined(lower, upper, turned_about="x").heights, lower.heights + upper.heights[::-1]
    )
    np.testing.assert_array_equal(combined(lower, upper, turned_about=None).heights, (lower + upper).heights)
    assert pages.provenance[-1].endswith("turned over about y")
    line = rc.Grid(9, 1.0)
    heights = np.arange(9.0)
    np.testing.assert_array_equal(combined(*[rc.Surface(heights, line)] * 2).heights, np.full(9, 8.0))


def test_two_cylinders_make_a_sphere():
    """Crossed cylinders of one radius are in contact like a ball on a flat: heights add to a paraboloid."""
    grid = rc.Grid((41, 41), 0.01)
    cross = combined(shapes.cylinder(grid, 40.0, "x"), shapes.cylinder(grid, 40.0, "y"))
    # r^4/(8 R^3) is left of the circle: 0.08^2/8/40^3 = 1e-8 of 1e-3
    np.testing.assert_allclose(cross.heights, shapes.paraboloid(grid, 40.0).heights, rtol=0, atol=2e-8)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize(("interpolation", "bound"), [("linear", 1 / 8), ("cubic", 3 / 128)])
@pytest.mark.parametrize("points", [8, 16, 64])
def test_cost_of_interpolation(points, interpolation, bound, periodic):
    """Between its points a wave is off by at most h (qD)^2/8 (linear), 3 h (qD)^4/128 (cubic), and nearly by that."""
    n = 4 * points
    coarse, fine = rc.Grid(n, 1 / n, periodic), rc.Grid(7 * n, 1 / (7 * n), periodic)
    q = 8 * np.pi

    def wave(grid):
        return rc.Surface(np.cos(q * (np.arange(grid.size) + 0.5) / grid.size + 0.3), grid)

    error = np.abs(resampled(wave(coarse), fine, interpolation=interpolation).heights - wave(fine).heights)
    if not periodic:  # the ends are continued, or read off the outer parts of the polynomials
        error = error[14:-14]
    limit = bound * (q / n) ** (2 if interpolation == "linear" else 4)
    assert 0.85 * limit < error.max() < 1.0 * limit


def test_points_for_one_percent():
    """As the docstring counts: (2 pi/23)^2/8 and 3 (2 pi/8)^4/128 lie below 0.01."""
    assert (2 * np.pi / 23) ** 2 / 8 < 0.01 < (2 * np.pi / 22) ** 2 / 8
    assert 3 * (2 * np.pi / 8) ** 4 / 128 < 0.01 < 3 * (2 * np.pi / 7) ** 4 / 128


def test_polynomials_are_met_exactly_up_to_the_edges():
    """Cubics on a free grid of any spacing, linear functions of both axes; cells beyond the surface are missing."""

    def cubic(grid):
        y, x = ((np.arange(n) - (n - 1) / 2) * d for n, d in zip(grid.shape, grid.spacing, strict=True))
        return rc.Surface(1 + 0.1 * y[:, None] ** 3 - x**2 * y[:, None] + 0.2 * x**3, grid)

    fine = rc.Grid((100, 130), (0.04, 9.6 / 130))
    np.testing.assert_allclose(resampled(cubic(GRID), fine).heights, cubic(fine).heights, rtol=0, atol=1e-11)
    wide = rc.Grid((60, 48), (0.1, 0.2))
    wider = resampled(cubic(GRID), wide)
    np.testing.assert_allclose(wider.heights[10:50], cubic(GRID).heights, rtol=0, atol=1e-12)
    assert np.isnan(wider.heights[:10]).all()
    assert np.isnan(wider.heights[50:]).all()


def test_equal_grids_and_coinciding_points_are_not_interpolated():
    surface = rough()
    assert resampled(surface, rc.Grid((40, 48), (0.1, 0.2))) is surface
    odd = rc.Surface(np.random.default_rng(0).standard_normal((9, 9)), rc.Grid((9, 9), 0.3))
    finer = resampled(odd, rc.Grid((27, 27), 0.1))
    np.testing.assert_allclose(finer.heights[1::3, 1::3], odd.heights, rtol=1e-13)


@pytest.mark.parametrize("interpolation", ["linear", "cubic"])
def test_missing_points_stay_missing(interpolation):
    """The hole spreads to the new cells within one old cell of it, and no further."""
    heights = np.ones((9, 9))
    heights[4, 4] = np.nan
    finer = resampled(
        rc.Surface(heights, rc.Grid((9, 9), 0.3)), rc.Grid((27, 27), 0.1), interpolation=interpolation
    )
    expected = np.ones((27, 27))
    expected[11:16, 11:16] = np.nan
    np.testing.assert_allclose(finer.heights, expected, rtol=1e-14)


def test_two_grids():
    """A rough flat of fine cells and a small coarse ball: on the finer grid, missing where there is no ball."""
    lower, upper = rough(rc.Grid((80, 80), 0.1)), shapes.paraboloid(rc.Grid((20, 20), 0.2), 3.0)
    with pytest.warns(UserWarning, match="4800 of 6400 cells"):
        both = combined(lower, upper)
    assert both.grid == lower.grid
    with pytest.warns(UserWarning, match="of the upper surface"):
        assert combined(upper, lower).grid == lower.grid
    inside = np.zeros((80, 80), dtype=bool)
    inside[20:60, 20:60] = True
    np.testing.assert_array_equal(both.measured, inside)
    bowl = shapes.paraboloid(rc.Grid((80, 80), 0.1), 3.0)  # of degree two: no cost
    np.testing.assert_allclose(both.heights[inside], (lower + bowl).heights[inside], rtol=0, atol=1e-13)
    named = rc.Grid((16, 16), 0.25)
    with pytest.warns(UserWarning, match="of the lower surface"):
        assert combined(lower, upper, grid=named).grid == named


@pytest.mark.filterwarnings("ignore:combined")
def test_what_is_lost_is_said():
    """Of bodies that cover unlike parts of the plane, each loses the cells beyond the other."""
    wide, high = rough(rc.Grid((30, 60), 0.1)), rough(rc.Grid((50, 40), 0.1))
    loss = combined(wide, high).provenance[-1]
    assert loss.startswith(
        "600 of 1800 cells (34 %) of the lower surface and 800 of 2000 cells (40 %) of the upper"
    )
    assert loss.endswith("crop the larger one to choose its part")
    assert np.count_nonzero(combined(wide, high).measured) == 1200
    small = rc.Grid((20, 20), 0.1)
    assert "1400 of 1800" in combined(wide, high, grid=small).provenance[-1]
    same = combined(wide, wide.flipped("x"))
    assert same.provenance[-1].startswith("combined with: ")


def test_the_cost_to_a_contact():
    """Hertz from a ball on coarse cells of D, brought onto cells of D/3 for a flat of that grid.

    By "cubic" it is the same paraboloid. By "linear" its facets lie up to (1/3)(2/3) D^2/(2R) an axis below it and
    touch it at the apex: the force at one depth is smaller, and the depth at one force larger by at most that.
    """
    n, a, radius = 65, 0.4, 1.0
    flat = rc.Surface(np.zeros((3 * n, 3 * n)), rc.Grid((3 * n, 3 * n), 1 / (3 * n)))
    ball = shapes.paraboloid(rc.Grid((n, n), 1 / n), radius)
    exact, cubic, linear = (
        rc.press(surface, 1.0, force=4 * a**3 / 3, tolerance=1e-10).depth
        for surface in (
            shapes.paraboloid(flat.grid, radius),
            combined(flat, ball),
            combined(flat, ball, interpolation="linear"),
        )
    )
    assert cubic == pytest.approx(exact, rel=1e-8)
    lowest = 2 * (2 / 9) / n**2 / (2 * radius)
    assert 0.1 * lowest < linear - exact < lowest


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: resampled(rough(), GRID, interpolation="quintic"), "interpolation must be"),
        (lambda: resampled(rough(), rc.Grid((40, 48), (0.1, 0.2), True)), "periodic where the other"),
        (lambda: resampled(rough(rc.Grid((9, 9), 1.0, True)), rc.Grid((9, 9), 1.1, True)), "periods must be"),
        (lambda: resampled(rough(), rc.Grid(9, 1.0)), "the number of axes"),
        (lambda: resampled(rc.Surface(np.ones((3, 9)), rc.Grid((3, 9), 1.0)), GRID), "at least 4 cells"),
        (lambda: combined(rough(), rough(), turned_about="z"), "turned_about must be"),
        (
            lambda: combined(*[rc.Surface(np.ones(3), rc.Grid(3, 1.0))] * 2, turned_about="x"),
            "a line is turned",
        ),
        (
            lambda: combined(shapes.flat_disc(GRID, 0.5, (1, 1)), shapes.flat_disc(GRID, 0.5, (1, 1))),
            "no measured point in common",
        ),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
