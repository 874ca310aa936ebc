import math

import numpy as np
import pytest
from scipy.special import ndtri
from scipy.stats import norm

import roughcontact as rc
from roughcontact.surface.parameters.material_ratio import material_ratio, stratified_parameters


def line(heights):
    return rc.Surface(np.asarray(heights, dtype=float), rc.Grid(len(heights), 1.0))


def test_the_curve_goes_from_the_highest_to_the_lowest():
    curve = material_ratio(line([0.0, 3.0, 1.0, np.nan, 4.0]))
    np.testing.assert_allclose(curve.ratio, [1 / 8, 3 / 8, 5 / 8, 7 / 8])
    np.testing.assert_allclose(curve.height, [2, 1, -1, -2])
    assert curve.height_at(0.5) == pytest.approx(0)
    assert curve.ratio_at([3.0, 1.5, -1.0, -3.0]) == pytest.approx([0, 0.25, 0.625, 1])
    assert curve.integral(0, 1) == pytest.approx(0, abs=1e-15)


def test_normal_heights_have_the_parameters_of_the_normal_quantile():
    """The core is 30 to 70 %, where the quantile is steepest least; the rest follows by quadrature."""
    n = 200_001
    heights = ndtri((np.arange(n) + 0.5) / n)
    p = np.linspace(0.3, 0.7, 200_001)
    centred = p - 0.5
    sk = -(centred @ ndtri(1 - p)) / (centred @ centred)
    top = sk / 2
    smr1 = norm.sf(top)
    # The area between the quantile and the top of the core: phi(t) - t Q(t).
    hill = norm.pdf(top) - top * smr1
    found = stratified_parameters(line(np.random.default_rng(0).permutation(heights)))
    # Both curves are sampled at 1/n: the region may lie a few points off the middle, where the fall is stationary.
    assert found.Sk == pytest.approx(sk, rel=1e-4)
    assert (found.Smr1, 1 - found.Smr2) == pytest.approx((smr1, smr1), rel=1e-3)
    assert (found.Spk, found.Svk) == pytest.approx((2 * hill / smr1,) * 2, rel=1e-3)
    low, high = ndtri(0.2), ndtri(0.9)
    tail = norm.pdf(high) - high * 0.1
    assert found.Vmp == pytest.approx(tail, rel=1e-3)
    # Above the level at 80 %: the mean excess over it.
    assert found.Vmc == pytest.approx(norm.pdf(low) - low * 0.8 - tail, rel=1e-3)
    assert found.Vvv == pytest.approx(norm.pdf(low) + low * 0.2, rel=1e-3)
    assert found.Vvc == pytest.approx(norm.pdf(high) + high * 0.9 - found.Vvv, rel=1e-3)


def test_even_heights_are_all_core():
    """A straight curve: the line spans it, but for the half point at each end where the curve is level."""
    n = 1000
    found = stratified_parameters(line(np.arange(n)))
    assert found.Sk == pytest.approx(n, rel=1e-12)
    assert found.Spk <= 0.5
    assert found.Svk <= 0.5
    assert (found.Smr1, found.Smr2) == pytest.approx((0, 1), abs=1 / n)


def test_volumes_add_up():
    """The material below a level and the voids above it fill the space: Vmp + Vmc + (void below) and so on."""
    rng = np.random.default_rng(1)
    surface = rc.Surface(rng.gamma(2.0, size=(50, 60)), rc.Grid((50, 60), 1.0))
    found, curve = stratified_parameters(surface), material_ratio(surface)
    height = float(curve.height_at(0.1) - curve.height_at(0.8))
    # Between the levels at 10 % and 80 % lies the core: material, voids, and nothing else.
    assert found.Vmc + found.Vvc == pytest.approx(height, rel=1e-12)


def test_it_is_the_first_of_the_flattest_forty_percent():
    """Slowly, by shifting a window of 40 % over the sorted heights."""
    rng = np.random.default_rng(2)
    z = np.sort(np.concatenate([rng.standard_normal(700), 5 + 3 * rng.standard_normal(301)]))[::-1]
    found = stratified_parameters(line(rng.permutation(z)))
    n = z.size
    ratio = (np.arange(n) + 0.5) / n
    start = min(range(math.ceil(0.6 * n)), key=lambda i: z[i] - np.interp(ratio[i] + 0.4, ratio, z))
    inside = (ratio >= ratio[start]) & (ratio <= ratio[start] + 0.4)
    slope, offset = np.polyfit(ratio[inside], z[inside] - z.mean(), 1)
    assert found.Sk == pytest.approx(-slope, rel=1e-9)
    assert found.Smr1 == pytest.approx(np.mean(z - z.mean() > offset), abs=1 / n)
    assert found.Smr2 == pytest.approx(np.mean(z - z.mean() > offset + slope), abs=1 / n)


def test_what_has_no_core_is_refused():
    with pytest.raises(ValueError, match="ten heights"):
        stratified_parameters(line([1, 2, 3]))
    with pytest.raises(ValueError, match="all heights are equal"):
        stratified_parameters(line([1.0] * 20))
    with pytest.raises(ValueError, match="ratios must increase"):
        stratified_parameters(line(range(20)), peak_ratio=0.9)
