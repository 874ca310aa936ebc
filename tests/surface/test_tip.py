"""What a tip of finite radius records."""

import numpy as np
import pytest

import roughcontact as rc

STEP = (1e-8, 1.5e-8)
RADIUS = 2e-7


def shape_of(tip, square):
    return (
        square / (2 * RADIUS) if tip == "paraboloid" else RADIUS - np.sqrt(np.maximum(RADIUS**2 - square, 0))
    )


def dumb_scan(heights, spacing, periodic, tip):
    """The height at which the tip, lowered above each point, first touches any point."""
    record = np.full(heights.shape, np.nan)
    known = np.argwhere(~np.isnan(heights))
    for i, j in known:
        away = np.abs(known - [i, j])
        away = np.where(periodic, np.minimum(away, np.array(heights.shape) - away), away)
        square = ((away * spacing) ** 2).sum(axis=1)
        reached = square <= RADIUS**2 if tip == "sphere" else square >= 0
        record[i, j] = (heights[known[:, 0], known[:, 1]] - shape_of(tip, square))[reached].max()
    return record


@pytest.mark.parametrize("tip", ["sphere", "paraboloid"])
def test_a_spike_shows_the_tip(tip):
    heights = np.zeros((41, 37))
    heights[20, 18] = 5e-8
    record = rc.Surface(heights, rc.Grid(heights.shape, STEP)).scanned(RADIUS, tip).heights
    y, x = np.meshgrid((np.arange(41) - 20) * STEP[0], (np.arange(37) - 18) * STEP[1], indexing="ij")
    expected = np.maximum(5e-8 - shape_of(tip, x**2 + y**2), 0)
    np.testing.assert_allclose(record, expected, rtol=0, atol=1e-21)


@pytest.mark.parametrize("tip", ["sphere", "paraboloid"])
@pytest.mark.parametrize("periodic", [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize("height", [2e-8, 6e-7])  # less and more than the radius
def test_it_is_the_first_touch_of_every_point(tip, periodic, height):
    heights = height * np.random.default_rng(0).random((14, 17))
    heights[3:6, 8:12] = np.nan
    surface = rc.Surface(heights, rc.Grid(heights.shape, STEP, periodic), ("made",))
    scanned = surface.scanned(RADIUS, tip)
    np.testing.assert_allclose(
        scanned.heights, dumb_scan(heights, STEP, periodic, tip), rtol=0, atol=1e-15 * height
    )
    assert scanned.missing == 12
    assert scanned.provenance == ("made", f"scanned by a {tip} of radius 2e-07 m")


@pytest.mark.parametrize(("share", "reached"), [(0.9, True), (2.0, False)])
def test_a_wave_bent_less_than_the_tip_keeps_its_peaks_and_valleys(share, reached):
    count = 400
    q = 2 * np.pi / (count * 2e-9)
    amplitude = share / (RADIUS * q**2)  # curvature at the valley: share of 1/R
    heights = amplitude * np.cos(q * 2e-9 * np.arange(count))
    line = rc.Surface(heights, rc.Grid(count, 2e-9, periodic=True)).scanned(RADIUS, "paraboloid")
    assert line.heights.max() == heights.max()
    valley = line.heights[count // 2]
    if reached:
        assert valley == heights.min()
    else:
        # The tip rests on both flanks: max over u of -a cos(qu) - u^2/2R, where sin(z) = z / share, z = qu.
        z = 1.895494267033981  # root of sin z = z / 2
        exact = amplitude * (-np.cos(z) - z**2 / (2 * share))
        # Touching points lie on the grid: the maximum is missed by half its curvature times half a cell squared.
        error = amplitude * q**2 * (1e-9) ** 2
        assert exact - error <= valley <= exact + 1e-20


def test_scanning_back_from_below_restores_what_was_reached():
    """Closing a surface of small curvature by the tip changes nothing: erosion is dilation upside down."""
    count = 300
    q = 2 * np.pi / (count * 2e-9)
    heights = 0.5 / (RADIUS * q**2) * np.sin(q * 2e-9 * np.arange(count))
    grid = rc.Grid(count, 2e-9, periodic=True)
    record = rc.Surface(heights, grid).scanned(RADIUS, "paraboloid")
    back = -rc.Surface(-record.heights, grid).scanned(RADIUS, "paraboloid").heights
    assert (back >= heights - 1e-22).all()
    # A tip that stands on the grid stands up to half a cell, d/2, beside where it would touch a point: there it is
    # (d/2)^2 / 2R (1 - kappa R) above it, and kappa R is at most one half.
    np.testing.assert_allclose(back, heights, rtol=0, atol=1.0001 * (2e-9) ** 2 / (4 * RADIUS))


@pytest.mark.parametrize(
    ("radius", "tip"), [(0.0, "sphere"), (-1.0, "sphere"), (np.nan, "sphere"), (1e-7, "cone")]
)
def test_a_tip_that_is_none_is_refused(radius, tip):
    with pytest.raises(ValueError, match="tip"):
        rc.Surface(np.eye(3), rc.Grid((3, 3), 1e-6)).scanned(radius, tip)
