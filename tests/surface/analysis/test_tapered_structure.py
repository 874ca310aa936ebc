import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.correlation import structure_profile
from roughcontact.surface.analysis.tapered_structure import tapered_structure

STEPS = np.array([1, 2, 3, 5, 8, 12])


def noise(shape=(40, 96), periodic=False):
    heights = np.cumsum(np.random.default_rng(0).standard_normal(shape), axis=1)
    return rc.Surface(heights, rc.Grid(shape, (0.5, 0.25), periodic))


@pytest.mark.parametrize("axis", ["x", "y"])
def test_along_a_periodic_axis_all_pairs_count_alike(axis):
    surface = noise(periodic=True)
    values, share = tapered_structure(surface, axis, STEPS)
    np.testing.assert_allclose(values, structure_profile(surface, axis, lags=STEPS).value, rtol=1e-13)
    assert share == 1


def test_every_lag_sees_the_same_part_of_a_free_axis():
    """Jumps of x^4/4 are r x (x^2 + r^2/4) at their middle x: their mean square is an integral over the weight."""
    x = np.arange(96) + 100.0
    surface = rc.Surface(np.tile(x**4 / 4, (32, 1)), rc.Grid((32, 96), 1.0))
    fine = x.mean() + np.linspace(-48, 48, 200001)
    inside = 48 - np.abs(fine - x.mean()) - STEPS.max() / 2
    weight = np.sin(np.pi / 2 * np.clip(inside / 6, 0, 1)) ** 2
    exact = [np.average((r * fine * (fine**2 + r**2 / 4)) ** 2, weights=weight) for r in STEPS]
    values, _ = tapered_structure(surface, "x", STEPS)
    # A sum is its integral but for 1/720 of the jumps of the third derivative (Euler-Maclaurin, at the middles of
    # cells 7/8 of that): at the ends of a ramp 3 w'' (x^6)' = 3 (pi^2/72)(6/x) x^6, some 0.03 of 80 cells' mean x^6.
    np.testing.assert_allclose(values, exact, rtol=1e-5)
    plain = structure_profile(surface, "x", lags=STEPS).value
    assert np.abs(plain / exact - 1).min() > 0.03


def test_the_share_of_an_axis():
    """12 of 96 cells go to the longest lag, two ramps of 6 hold a mean of 1/2 and a mean square of 3/8."""
    flat = 96 - 12 - 2 * 6
    _, share = tapered_structure(noise(), "x", STEPS)
    assert share == pytest.approx((flat + 6) ** 2 / (flat + 2 * 6 * 3 / 8) / 96, rel=1e-3)


def test_pairs_with_a_missing_point_are_left_out():
    surface = noise()
    heights = surface.heights.copy()
    heights[5:20, 30:50] = np.nan
    holed, _ = tapered_structure(rc.Surface(heights, surface.grid), "x", STEPS)
    alone = np.isfinite(heights).all(axis=1)
    for value, step in zip(holed, STEPS, strict=True):
        middle = np.arange(96 - step) + (step + 1) / 2
        weight = np.sin(np.pi / 2 * np.clip((np.minimum(middle, 96 - middle) - 6) / 6, 0, 1)) ** 2
        total = number = 0.0
        for row, complete in zip(heights, alone, strict=True):
            for w, before, after in zip(weight, row[:-step], row[step:], strict=True):
                if complete or not np.isnan(after - before):
                    total, number = total + w * (after - before) ** 2, number + w
        assert value == pytest.approx(total / number, rel=1e-12)


def test_lags_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="from 1 to 48"):
        tapered_structure(noise(), "x", np.array([1, 49]))
    with pytest.raises(ValueError, match=r"along y .* from 1 to 20"):
        tapered_structure(noise(), "y", np.array([1, 30]))
    with pytest.raises(ValueError, match="from 1 to 95"):
        tapered_structure(noise(periodic=True), "x", np.array([96]))
    with pytest.raises(ValueError, match="whole numbers"):
        tapered_structure(noise(), "x", np.array([1.5]))
    striped = rc.Surface(np.where(np.arange(96) % 2, np.nan, noise().heights), noise().grid)
    with pytest.raises(ValueError, match="no two measured points"):
        tapered_structure(striped, "x", np.array([1]))
