"""Pastewka and Robbins' criterion: the gap beside a cylinder, one wave, its closed form, and what is refused."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import roughcontact as rc
from roughcontact.theory.adhesive import pastewka_robbins
from roughcontact.theory.random_surfaces.waves import Waves

SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(1e-7)


@pytest.mark.parametrize("s", [1e-3, 1e-2, 0.1])
def test_the_width_is_that_of_the_gap_beside_a_cylinder(s):
    """Of half-width 1 and radius 5 by Hertz, at the distance s beside the edge, where it meets the flat at 1/5."""
    t = 1 + s
    gap = (t * math.sqrt(t**2 - 1) - math.acosh(t)) / (2 * 5.0)
    # The gap is the leading term times 1 + 0.15 s + O(s^2), so the width that it tells is 1 + 0.1 s times s.
    told = pastewka_robbins.attracted_width(0.2, 2.0, gap)
    assert told / s - 1 == pytest.approx(0.1 * s, rel=s)


def test_of_one_wave_the_contact_is_four_over_its_wavenumber():
    wave = Waves.of_bands(np.array([1e6]), np.array([1e-14]))
    assert pastewka_robbins.contact_diameter(wave) == pytest.approx(4e-6, rel=1e-12)


def test_the_threshold_in_slopes_and_curvatures():
    """By the closed form in h' and h'', which are integrated over the spectrum here."""
    q = np.geomspace(2 * np.pi / 1e-4, 2 * np.pi / 1e-6, 100_001)
    moment = lambda k: 2 * np.pi * np.trapezoid(q ** (k + 2) * SPECTRUM(q), np.log(q))  # noqa: E731
    slope, laplacian = math.sqrt(moment(2)), math.sqrt(moment(4))
    gap, kappa = 2e-9, 1.8
    left = lambda w: 1e8 * slope * gap / (kappa * w) * (slope**2 / (laplacian * gap)) ** (2 / 3)  # noqa: E731
    threshold = brentq(lambda w: left(w) - math.pi * (3 / 16) ** (2 / 3), 1e-6, 1e3, xtol=1e-15, rtol=1e-12)
    # Of the rule: (step of ln q)^2/12 times the slope of the integrand at its ends, below 1e-8.
    told = pastewka_robbins.stickiness(SPECTRUM, 1e8, threshold, gap, kappa=kappa)
    assert told == pytest.approx(1.0, rel=1e-7)


@pytest.mark.parametrize("hurst", [0.4, 0.6, 0.8])
def test_short_waves_make_a_surface_stick_more_above_a_hurst_exponent_of_three_fifths(hurst):
    """At a given height h' grows as q^(1-H) and h'' as q^(2-H), so the stickiness as q^(5 H/3 - 1)."""
    ends = [
        rc.SelfAffineSpectrum(hurst, long_cutoff=1.0, short_cutoff=short).scaled(1e-3)
        for short in (1e-8, 1e-9)
    ]
    low, high = (pastewka_robbins.stickiness(each, 1e8, 0.05, 1e-12) for each in ends)
    # The longest waves leave 1 - x^(2-2H) of h'^2, which is there to the power 7/6, and the shortest 1 - x^(2H) of the
    # square of the rms height to which all is scaled, there to the power 5/6, x being 1e-8.
    left = (7 / 6 * 1e-8 ** (2 - 2 * hurst) + 5 / 6 * 1e-8 ** (2 * hurst)) / math.log(10)
    assert math.log10(high / low) == pytest.approx(5 / 3 * hurst - 1, abs=left)


def test_a_diameter_that_was_measured_takes_the_place_of_the_estimate():
    estimate = pastewka_robbins.contact_diameter(SPECTRUM)
    as_estimated = pastewka_robbins.stickiness(SPECTRUM, 1e8, 0.05, 2e-9)
    given = pastewka_robbins.stickiness(SPECTRUM, 1e8, 0.05, 2e-9, diameter=estimate / 8)
    assert given == pytest.approx(4 * as_estimated, rel=1e-12)


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="range"):
        pastewka_robbins.stickiness(SPECTRUM, 1e8, 0.05, 0.0)
    with pytest.raises(ValueError, match="kappa"):
        pastewka_robbins.stickiness(SPECTRUM, 1e8, 0.05, 1e-9, kappa=-1.0)
    with pytest.raises(ValueError, match="diameter"):
        pastewka_robbins.stickiness(SPECTRUM, 1e8, 0.05, 1e-9, diameter=-1.0)
