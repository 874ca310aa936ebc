"""Pullen and Williamson: limits of the area, the rise by quadrature, volume conserved on heights, refusals."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from roughcontact.theory.plastic_asperities import pullen_williamson as pw

HARDNESS, RMS = 2e9, 3e-7
PRESSURES = [2e4, 1e8, 2e9, 3e10]


def test_the_hardness_at_small_loads_and_never_full_contact():
    assert pw.contact_fraction(2.0, HARDNESS) == pytest.approx(1e-9, rel=1e-8)
    part = pw.contact_fraction(np.geomspace(1e3, 1e15, 50), HARDNESS)
    assert (np.diff(part) > 0).all()
    assert part[-1] < 1
    assert pw.contact_fraction(0.0, HARDNESS) == 0


@pytest.mark.parametrize("pressure", PRESSURES)
def test_mean_pressure_of_the_spots_grows_as_they_leave_no_room(pressure):
    part = float(pw.contact_fraction(pressure, HARDNESS))
    assert pressure / part == pytest.approx(HARDNESS / (1 - part), rel=1e-12)


@pytest.mark.parametrize("pressure", PRESSURES)
def test_rise_and_gap_are_integrals_over_the_heights(pressure):
    cut = norm.isf(pressure / (pressure + HARDNESS))
    above = quad(lambda z: (z - cut) * norm.pdf(z), cut, cut + 40, epsabs=0, epsrel=1e-11)[0]
    below = quad(lambda z: (cut - z) * norm.pdf(z), cut - 40, cut, epsabs=0, epsrel=1e-11, points=[-3, 3])[0]
    rise, gap = pw.rise(pressure, HARDNESS, RMS), pw.mean_gap(pressure, HARDNESS, RMS)
    # isf of a probability near 1 loses digits of its complement, at most 1e-15 of 1/16.
    assert rise == pytest.approx(RMS * above, rel=1e-9)
    assert gap == pytest.approx(RMS * below, rel=1e-9)
    # The flat stands above the cut by the rise, and the mean plane where it was.
    assert gap == pytest.approx(RMS * cut + rise, rel=1e-9)


@pytest.mark.parametrize("pressure", PRESSURES)
def test_stiffness_is_the_slope_of_the_pressure_over_the_gap(pressure):
    # A central difference in ln p of a smooth function: the step squared.
    step = 1e-4
    near = pw.mean_gap(pressure * np.exp([-step, step]), HARDNESS, RMS)
    slope = 2 * math.sinh(step) * pressure / (near[0] - near[1])
    assert pw.stiffness(pressure, HARDNESS, RMS) == pytest.approx(slope, rel=1e-7)


def test_flattened_heights_keep_their_mean_and_bear_the_area():
    heights = np.random.default_rng(5).standard_normal((200, 500)) * RMS
    after = pw.flattened(heights, 5e8, HARDNESS)  # a fifth of the area
    assert after.shape == heights.shape
    assert after.mean() == pytest.approx(heights.mean(), abs=1e-14 * RMS)
    level = after == after.max()
    assert level.mean() == pytest.approx(0.2, abs=1e-5)  # one of the 100 000 heights
    # The highest fifth of all is in contact, and the rest has kept its shape.
    assert heights[level].min() >= heights[~level].max()
    np.testing.assert_allclose(np.ptp((after - heights)[~level]), 0.0, atol=1e-14 * RMS)
    # As of a Gaussian surface, but for the scatter of a mean of 100 000 heights.
    gap = after.max() - after.mean()
    assert gap == pytest.approx(float(pw.mean_gap(5e8, HARDNESS, RMS)), abs=4 * RMS / math.sqrt(heights.size))


def test_refusals():
    with pytest.raises(ValueError, match="without load"):
        pw.mean_gap(0.0, HARDNESS, RMS)
    with pytest.raises(ValueError, match="hardness"):
        pw.law(0.0, 1e-6)
    with pytest.raises(ValueError, match="heights"):
        pw.flattened([0.0, math.nan], 1e6, HARDNESS)
    with pytest.raises(ValueError, match="empty"):
        pw.flattened([], 1e6, HARDNESS)
