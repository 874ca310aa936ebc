"""Ciavarella's bearing area model: heights that are drawn, limits of the pull-off, and what is refused."""

import math

import numpy as np
import pytest

from roughcontact.theory.adhesive.bearing_area_model import BearingAreaModel


def pad(rms, *, gap=1e-12, gamma=0.5):
    return BearingAreaModel(rms, 2 * math.pi / 1e-6, 1e8, 0.05, gap, gamma)


def test_the_attracted_area_is_that_of_drawn_heights():
    model = pad(1.0, gap=0.4)
    heights = np.random.default_rng(0).standard_normal(1_000_000)
    for u in (0.0, 0.7, 2.0):
        share = np.mean((u - heights > 0) & (u - heights < 0.4))
        # Five standard deviations of a share.
        assert float(model.attracted_fraction(u)) == pytest.approx(share, abs=5 * math.sqrt(share / 1e6))


@pytest.mark.parametrize("gamma", [0.4, 0.5, 0.6])
def test_surfaces_stick_below_the_limit_of_a_short_range(gamma):
    limit = pad(1e-8, gamma=gamma).sticking_rms
    # The range is 1e-4 of the rms, and the attracted area good to its half times u/h^2 = 1/(gamma h).
    assert pad(0.999 * limit, gamma=gamma).pull_off_pressure > 0
    assert pad(1.001 * limit, gamma=gamma).pull_off_pressure == 0


def test_the_limit_in_adhesion_length_and_longest_wave():
    # exp(2)/(2 pi 0.75 sqrt(2 pi)) of work over modulus times wave
    assert pad(1e-8).sticking_rms == pytest.approx(math.sqrt(0.62560 * 0.05 / 1e8 * 1e-6), rel=1e-5)


def test_a_smooth_surface_is_pulled_off_by_the_whole_attraction():
    # At 10 rms heights the reaction has fallen to exp(-20), and all of the area lies within the range.
    smooth = pad(1e-12, gap=1e-9)
    assert smooth.pull_off_pressure == pytest.approx(0.05 / 1e-9, rel=1e-8)


def test_the_pull_off_is_the_largest_tension():
    model = pad(5e-9, gap=2e-9)
    u = np.linspace(0.0, 5e-8, 100_001)
    # The pressure is parabolic there: half a step of the sampling, squared, over the width of the peak.
    assert model.pull_off_pressure == pytest.approx(-float(model.pressure(u).min()), rel=1e-8)
    assert -float(model.pressure(u).min()) <= model.pull_off_pressure * (1 + 1e-12)


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="the rms"):
        pad(0.0)
    with pytest.raises(ValueError, match="the range"):
        pad(1.0, gap=-1.0)
