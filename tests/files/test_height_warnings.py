"""What asks for a second look, and what does not."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.height_warnings import height_warnings

CELL = (1e-6, 1e-6)
GRID = rc.Grid((64, 80), CELL)


@pytest.fixture
def heights():
    return rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(4)).heights.copy()


def test_a_rough_surface_raises_no_warning(heights):
    assert height_warnings(heights, CELL) == ()
    heights[:10] = np.nan  # nor does one that was not measured everywhere
    assert height_warnings(heights, CELL) == ()


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (slice(50, None), "its last 14 of 64 rows all hold 0 m, as after an interrupted scan"),
        (slice(None, 5), "its first 5 of 64 rows all hold 0 m"),
        (slice(None, 2), "its first 2 of 64 rows all hold 0 m"),
    ],
)
def test_a_scan_that_was_broken_off(heights, rows, words):
    heights[rows] = 0.0
    assert any(warning.startswith(words) for warning in height_warnings(heights, CELL))


def test_a_map_without_heights():
    assert height_warnings(np.full((64, 80), 3e-6), CELL) == (
        "all its heights are equal, unlike any measured surface",
    )
    assert height_warnings(np.zeros((3, 4)), CELL) == ()  # too few to tell


def test_a_single_level_row_is_no_broken_scan(heights):
    heights[-1] = heights[0] = 0.0
    assert height_warnings(heights, CELL) == ()


def test_a_lone_point(heights):
    heights[30, 30] += 40 * np.quantile(np.abs(np.diff(heights)), 0.99)
    (warning,) = height_warnings(heights, CELL)
    assert warning.startswith(
        "1 spike of 1 cell, far outside their neighbours; remove faulty points by despiked()"
    )


def test_points_beyond_all_heights(heights):
    """A patch too large for a spike, where an instrument wrote a number for what it had not seen."""
    heights[20:30, 20:30] = -3e-5
    (warning,) = height_warnings(heights, CELL)
    assert warning.startswith("100 points lie more than 100 interquartile ranges from the median height")
    assert "masked()" in warning


def test_heights_that_no_instrument_sees(heights):
    (warning,) = height_warnings(heights * 1e-9, CELL)
    assert warning.startswith("an rms height of 1e-16 m is less than any instrument resolves")


def told(heights, cell=CELL):
    """Return the warnings in one text."""
    return "\n".join(height_warnings(heights, cell))


def few(points, levels=7):
    """Return a row of whole numbers, too few for statistics."""
    return np.arange(float(points)) % levels


@pytest.mark.parametrize(
    ("words", "within", "beyond"),
    [
        ("check size=", (few(8), (1.5e-9 / 8,)), (few(8), (0.9e-9 / 8,))),
        ("check size=", (few(8), (0.9 / 8,)), (few(8), (1.5 / 8,))),
        ("m x 2 m is unusual; check size=", (np.ones((4, 8)), (0.2, 0.1)), (np.ones((4, 8)), (0.2, 0.25))),
        ("heights up to 1.5 m are unusual", (0.15 * few(8), (0.1,)), (0.25 * few(8), (0.1,))),
        ("heights up to 1.5 m are unusual", (-0.15 * few(8), (0.1,)), (-0.25 * few(8), (0.1,))),
        # A map of two levels: the rms height is half of their difference.
        ("less than any instrument", (3e-14 * few(8, 2), (0.1,)), (1.8e-14 * few(8, 2), (0.1,))),
        ("on 0.001 m is unusual", (0.018 * few(8, 2), (1e-3 / 8,)), (0.022 * few(8, 2), (1e-3 / 8,))),
        ("on 0.001 m is unusual", (np.zeros(8), (1e-3 / 8,)), (0.022 * few(8, 2), (1e-3 / 8,))),
        (
            "% of its points are missing",
            (np.where(few(20) < 1, 1.0, np.nan)[:14:7], (0.1,)),
            (np.where(few(20) < 3, 1.0, np.nan), (0.1,)),
        ),
    ],
)
def test_limits_of_sizes_and_heights(words, within, beyond):
    assert words not in told(*within)
    assert words in told(*beyond)


def test_statistics_need_a_thousand_points():
    assert "all its heights are equal" in told(np.ones((25, 40)))
    assert told(np.ones((27, 37))) == ""  # 999


def test_a_typical_slope_of_ten_is_steep():
    """Rows rise and fall by one step; half of the steps from row to row are zero."""
    rows = np.repeat(np.arange(64.0) % 8, 80).reshape(64, 80) + np.arange(80) % 8
    for slope, steep in ((9, False), (11, True)):
        assert ("a typical slope of" in told(slope * 1e-6 * rows)) == steep
        # The other direction has half of the slope: the larger one is told.
        assert (f"a typical slope of {slope} is" in told(slope * 1e-6 * rows, (1e-6, 2e-6))) == steep


@pytest.mark.parametrize(("points", "away", "repeated", "found"), [
    (64, 1.1, 4, True), (63, 1.1, 4, False), (64, 0.9, 4, False), (64, 1.1, 3, False),
])  # fmt: skip
@pytest.mark.parametrize("side", [-1, 1])
def test_a_number_far_from_all_others(points, away, repeated, found, side):
    """It marks missing points if four hold it, and if it is further away than the others are apart."""
    heights = np.linspace(0, 1e-6, points)
    heights[5 : 5 + repeated] = side * away * 1e-6 + (side > 0) * 1e-6
    words = (
        f"{repeated} points hold {heights[5]:g} m, like a mark of missing points, and the others 0 to 1e-06"
    )
    assert (words in told(heights, (1e-6,))) == found


@pytest.mark.parametrize(
    ("longest", "second", "found"),
    [(12, 1, True), (11, 1, False), (12, 3, True), (15, 4, False), (16, 4, True)],
)
@pytest.mark.parametrize(
    ("order", "cell"), [(lambda h: h, "20, 10"), (lambda h: h.T, "10, 20"), (lambda h: h[::-1], "43, 10")]
)
def test_a_number_that_is_repeated(heights, longest, second, found, order, cell):
    """Twelve times in a row, and four times as often as any other number; along rows or columns."""
    heights[20, 10 : 10 + longest] = heights[20, 10]
    heights[40, 10 : 10 + second] = heights[40, 10]
    words = f"{longest} neighbouring points from cell {cell} hold {heights[20, 10]:g} m"
    assert (words in told(order(heights))) == found


def test_a_number_that_is_repeated_from_the_first_cell_on(heights):
    heights[0, :12] = heights[0, 0]
    assert "12 neighbouring points from cell 0, 0 hold" in told(heights)


def test_rows_stored_from_the_bottom_up_hold_one_run(heights):
    """The end of a row, and the beginning of the row above it in the picture."""
    heights[20, :7] = heights[21, -7:] = 0.0
    assert "14 neighbouring points from cell 21, 73 hold 0 m" in told(heights)


def test_points_far_from_the_median():
    """The heights between 0 and 1 have an interquartile range of one half; four points change it by a thousandth."""
    heights = np.linspace(0, 1e-6, 64 * 80).reshape(64, 80)
    for times, far in ((98, False), (102, True)):
        heights[20:22, 20:22] = (0.5 + times * 0.5) * 1e-6
        assert ("4 points lie more than 100 interquartile ranges" in told(heights)) == far


@pytest.mark.parametrize(("rows", "words"), [
    (14, "in 22% of the rows neighbouring heights are unrelated,"),
    (11, "in 11 rows or columns neighbouring heights are unrelated and far apart"),
])  # fmt: skip
def test_rows_of_random_numbers(heights, rows, words):
    """More than a fifth of 64 rows."""
    heights[20 : 20 + rows] = np.random.default_rng(5).uniform(-1e-6, 1e-6, (rows, 80))
    assert words in told(heights)


def test_heights_larger_than_any_body_are_refused(put, npy):
    heights = np.arange(12.0).reshape(3, 4) / 11
    with pytest.warns(rc.SurfaceWarning) as caught:
        rc.read(put("a.npy", npy(0.9e9 * heights)), unit="m", size=0.1)
    assert "heights up to 9e+08 m are unusual" in str(caught[0].message)
    with pytest.raises(rc.ReadError, match=r"it holds heights up to 1.1e\+09 m; pass unit="):
        rc.read(put("a.npy", npy(-1.1e9 * heights)), unit="m", size=0.1)


@pytest.mark.parametrize(("columns", "noisy"), [(35, True), (34, False), (33, False)])
def test_noise_needs_32_pairs_of_neighbours_in_a_row(columns, noisy):
    """A missing column takes two pairs; of an odd number of points one is the median, and has no side."""
    heights = np.random.default_rng(2).standard_normal((40, columns)) * 1e-7
    heights[:, 17] = np.nan
    assert ("of the rows neighbouring heights are unrelated, as random numbers are" in told(heights)) == noisy


def test_a_single_point_beyond_all_heights(heights):
    heights[30, 30] = 1e-4
    assert "1 points lie more than 100 interquartile ranges" in told(heights)
