import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.correlation import (
    autocorrelation,
    structure_function,
    structure_profile,
    tapered_structure,
)

STEPS = np.array([1, 2, 3, 5, 8, 12])


def noise(shape, periodic, holes=0):
    rng = np.random.default_rng(0)
    heights = rng.standard_normal(shape)
    heights.flat[rng.choice(heights.size, holes, replace=False)] = np.nan
    return rc.Surface(heights, rc.Grid(shape, (0.5, 0.25)[-len(shape) :], periodic))


def slow(surface, lag, combine):
    """Mean of `combine` over all pairs `lag` cells apart, one by one, and their number."""
    z = surface.heights - np.nanmean(surface.heights)
    values = []
    for place in np.ndindex(z.shape):
        other = [p + s for p, s in zip(place, lag, strict=True)]
        for axis, (n, periodic) in enumerate(zip(z.shape, surface.grid.periodic, strict=True)):
            if periodic:
                other[axis] %= n
            elif not 0 <= other[axis] < n:
                break
        else:
            values.append(combine(z[place], z[tuple(other)]))
    values = [value for value in values if not np.isnan(value)]
    return np.mean(values), len(values)


@pytest.mark.parametrize("shape", [(6, 7), (7, 6), (9,)])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("holes", [0, 3])
def test_both_are_means_over_pairs(shape, periodic, holes):
    surface = noise(shape, periodic, holes)
    acf, jumps = autocorrelation(surface), structure_function(surface)
    middle = [n // 2 for n in shape]
    for place in np.ndindex(acf.value.shape):
        lag = [p - m for p, m in zip(place, middle, strict=True)]
        expected, pairs = slow(surface, lag, lambda a, b: a * b)
        assert acf.value[place] == pytest.approx(expected, abs=1e-13)
        assert acf.pairs[place] == jumps.pairs[place] == pairs
        expected, _ = slow(surface, lag, lambda a, b: (a - b) ** 2)
        assert jumps.value[place] == pytest.approx(expected, abs=1e-13)
    assert [axis[-1] for axis in acf.lags] == pytest.approx(
        [n // 2 * d for n, d in zip(shape, surface.grid.spacing, strict=True)]
    )


def test_only_one_axis_goes_round():
    surface = noise((6, 7), (True, False))
    value = structure_function(surface).value
    assert value[3 + 2, 3 - 3] == pytest.approx(
        slow(surface, (2, -3), lambda a, b: (a - b) ** 2)[0], abs=1e-13
    )


def test_a_wave_has_its_closed_forms():
    """acf = A^2/2 cos(qr), S = A^2 (1 - cos qr)."""
    n, amplitude = 64, 2.0
    x = np.arange(n)
    heights = amplitude * np.cos(2 * np.pi * 3 * x / n) * np.ones((8, 1))
    surface = rc.Surface(heights, rc.Grid((8, n), 1.0, True))
    r = autocorrelation(surface).lags[1]
    wave = np.cos(2 * np.pi * 3 * r / n)
    np.testing.assert_allclose(autocorrelation(surface).value[4], amplitude**2 / 2 * wave, atol=1e-13)
    np.testing.assert_allclose(structure_function(surface).value[4], amplitude**2 * (1 - wave), atol=1e-12)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("axis", ["x", "y"])
def test_profiles_are_rows_of_the_map(periodic, axis):
    surface = noise((12, 11), periodic, holes=5)
    jumps = structure_function(surface)
    lags = np.array([1, 2, 5])
    profile = structure_profile(surface, axis, lags=lags)
    row = jumps.value[6, 5 + lags] if axis == "x" else jumps.value[6 + lags, 5]
    np.testing.assert_allclose(profile.value, row, rtol=1e-12)
    np.testing.assert_allclose(profile.lag, lags * (0.25 if axis == "x" else 0.5))


def test_a_tilt_shows_in_full():
    """S = (slope r)^2, exactly, though the heights are far from zero."""
    line = rc.Surface(1e3 + 0.5 * np.arange(40.0), rc.Grid(40, 2.0))
    profile = structure_profile(line)
    np.testing.assert_allclose(profile.value, (0.25 * profile.lag) ** 2, rtol=1e-12)
    assert profile.lag.tolist() == sorted(set(profile.lag))


def test_rings_average_all_directions():
    surface = noise((8, 8), True)
    surface = rc.Surface(surface.heights, rc.Grid((8, 8), 1.0, True))
    full = autocorrelation(surface)
    curve = full.radial()
    assert curve.lag[0] == 0
    assert curve.value[0] == pytest.approx(surface.rms**2, rel=1e-12)
    # Lags 1 (4 of them) and sqrt(2) (4 of them) share the ring about 1.
    ring = [full.value[4 + i, 4 + j] for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    assert curve.value[1] == pytest.approx(np.mean(ring), abs=1e-13)
    assert curve.lag[1] == pytest.approx((1 + np.sqrt(2)) / 2)


def test_lags_that_do_not_fit_are_refused():
    surface = noise((6, 7), False)
    for bad in ([0], [7], [1.5]):
        with pytest.raises(ValueError, match="lags must be"):
            structure_profile(surface, "x", lags=np.array(bad))
    with pytest.raises(ValueError, match="direction must be"):
        structure_profile(noise((9,), False), "y")
    lonely = np.full((1, 9), np.nan)
    lonely[0, 0] = lonely[0, 8] = 1.0
    with pytest.raises(ValueError, match="no two measured"):
        structure_profile(rc.Surface(lonely, rc.Grid((1, 9), 1.0)), "x", lags=[2])


def walk(shape=(40, 96), periodic=False):
    heights = np.cumsum(np.random.default_rng(0).standard_normal(shape), axis=1)
    return rc.Surface(heights, rc.Grid(shape, (0.5, 0.25), periodic))


@pytest.mark.parametrize("axis", ["x", "y"])
def test_along_a_periodic_axis_all_pairs_count_alike(axis):
    surface = walk(periodic=True)
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
    _, share = tapered_structure(walk(), "x", STEPS)
    assert share == pytest.approx((flat + 6) ** 2 / (flat + 2 * 6 * 3 / 8) / 96, rel=1e-3)


def test_pairs_with_a_missing_point_are_left_out():
    surface = walk()
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


def test_lags_of_tapered_pairs_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="from 1 to 48"):
        tapered_structure(walk(), "x", np.array([1, 49]))
    with pytest.raises(ValueError, match=r"along y .* from 1 to 20"):
        tapered_structure(walk(), "y", np.array([1, 30]))
    with pytest.raises(ValueError, match="from 1 to 95"):
        tapered_structure(walk(periodic=True), "x", np.array([96]))
    with pytest.raises(ValueError, match="whole numbers"):
        tapered_structure(walk(), "x", np.array([1.5]))
    striped = rc.Surface(np.where(np.arange(96) % 2, np.nan, walk().heights), walk().grid)
    with pytest.raises(ValueError, match="no two measured points"):
        tapered_structure(striped, "x", np.array([1]))
