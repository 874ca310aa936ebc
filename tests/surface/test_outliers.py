"""Where heights begin that are far from nearly all: by the moments of the rest, whatever a few do."""

import numpy as np
import pytest

from roughcontact.surface.preparation.outliers import height_limits, without_far

GAUSSIAN = np.random.default_rng(1).normal(0, 1e-7, (128, 128))


def far_above(heights):
    return int(np.count_nonzero(heights > height_limits(heights)[1]))


@pytest.mark.parametrize("share", [0.0, 0.001, 0.015])
def test_limits_are_those_of_the_rest(share):
    """Eight rms heights of 16 384 normal numbers, whose rms has a standard error of 0.6 %; rounded to a hundredth."""
    heights = GAUSSIAN.copy()
    count = int(share * heights.size)
    heights.reshape(-1)[:count] = 5e-5
    low, high = height_limits(heights)
    assert (-low, high) == pytest.approx((8e-7, 8e-7), rel=0.04)
    assert far_above(heights) == count  # by the rms of all, 6e-6 of 1.5 %, none of these would be


def test_what_belongs_to_the_surface_is_not_far():
    """Plateaus of a twentieth of the map, a paraboloid, a tilt, and heights all equal."""
    y, x = np.mgrid[:128, :128] - 64.0
    plateaus = GAUSSIAN + 1e-5 * (x % 40 < 2)
    assert np.count_nonzero(x % 40 < 2) > 0.04 * x.size
    assert (
        far_above(plateaus) == far_above(-(x**2) - y**2) == far_above(x) == far_above(np.ones((32, 32))) == 0
    )


def test_one_cell_on_a_flat_map_is_far():
    """Its rms height is 1/32 of the cell's, of 1024 cells."""
    heights = np.eye(1, 1024, 333).reshape(32, 32)
    assert height_limits(heights)[1] == pytest.approx(8 / 32, rel=0.01)
    assert far_above(heights) == 1


def test_missing_points_do_not_count_and_a_sample_serves_large_maps():
    heights = np.tile(GAUSSIAN, (3, 3))
    heights[::3] = np.nan
    assert height_limits(heights) == pytest.approx(height_limits(GAUSSIAN), rel=0.04)
    heights = np.full((400, 400), np.nan)
    heights[1, 7] = 2.0  # not among the cells that are chosen
    assert height_limits(heights) == (2.0, 2.0)


@pytest.mark.parametrize(("count", "left"), [(1, 100), (2, 100), (4, 104)])
def test_more_than_a_few_are_not_far(count, left):
    values = np.append(np.linspace(-1, 1, 100), np.full(count, 50.0))
    assert without_far(values).size == left
