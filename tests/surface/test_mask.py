"""Regions taken out of a surface."""

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((12, 18), (1e-6, 2e-6), (True, False))
HEIGHTS = np.random.default_rng(0).standard_normal(GRID.shape)
HEIGHTS[0, :3] = np.nan
SURFACE = rc.Surface(HEIGHTS, GRID, ("made",))
BOX = (slice(2, 6), slice(-4, None))
Y, X = np.mgrid[:12, :18]


def test_a_box_is_that_of_a_crop():
    masked = SURFACE.masked(box=BOX)
    expected = HEIGHTS.copy()
    expected[BOX] = np.nan
    assert np.array_equal(masked.heights, expected, equal_nan=True)
    assert masked.grid == GRID
    assert masked.provenance == ("made", "masked: box of cells 2:6, 14:18, 16 points set to missing")
    kept = SURFACE.masked(box=BOX, outside=True)
    assert np.array_equal(kept.cropped(*BOX).heights, HEIGHTS[BOX])
    assert kept.missing == 12 * 18 - 16
    assert kept.provenance[-1].startswith("masked: all but box of cells 2:6, 14:18, 197 points")
    line = rc.Surface(HEIGHTS[1], rc.Grid(18, 1e-6)).masked(box=[slice(4, 8)])
    assert np.flatnonzero(~line.measured).tolist() == [4, 5, 6, 7]


@pytest.mark.parametrize("stop", [9, 10])
def test_an_ellipse_fits_into_its_box(stop):
    """Of centres at half the sum of the ends less a half; it touches the outermost cells of an odd box."""
    masked = SURFACE.masked(ellipse=(slice(3, stop), slice(4, 15)))
    y, x = (Y + 0.5 - (3 + stop) / 2) / ((stop - 3) / 2), (X + 0.5 - 9.5) / 5.5
    assert np.array_equal(masked.measured, SURFACE.measured & (x**2 + y**2 > 1))
    outside = SURFACE.masked(ellipse=(slice(3, stop), slice(4, 15)), outside=True)
    assert np.array_equal(outside.measured, x**2 + y**2 <= 1)


def test_thresholds():
    measured = SURFACE.measured
    assert np.array_equal(SURFACE.masked(above=1.0).measured, measured & (HEIGHTS <= 1))
    both = SURFACE.masked(below=-1.0, above=0.5)
    assert np.array_equal(both.measured, measured & (HEIGHTS >= -1) & (HEIGHTS <= 0.5))
    assert both.provenance[-1].startswith("masked: heights below -1 m and above 0.5 m, ")
    tails = SURFACE.masked(below=-1.0, above=0.5, outside=True)
    assert np.array_equal(tails.measured, measured & ~both.measured)


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ({}, "one region"),
        ({"box": BOX, "above": 1.0}, "one region"),
        ({"box": BOX, "ellipse": BOX}, "one region"),
        ({"box": (slice(2, 6),)}, "a mask needs one slice an axis, 2 in all, not 1"),
        ({"box": (slice(5, 5), slice(None))}, "no cell is left"),
        ({"ellipse": (slice(0, 8, 2), slice(None))}, "a mask has no step"),
        ({"below": 1.0, "above": -1.0}, "below must be the lower"),
        ({"below": 100.0}, r"the mask \(heights below 100 m\) leaves no measured point"),
        ({"above": float("nan")}, "above"),
    ],
)
def test_what_is_no_mask_is_refused(region, message):
    with pytest.raises(ValueError, match=message):
        SURFACE.masked(**region)
