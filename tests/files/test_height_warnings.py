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
