"""Local exponents: each is that of its window, with the error that its scatter makes."""

import math

import numpy as np
import pytest

from roughcontact.statistics.local_exponent import exponent_within, local_exponents

FORCE = np.geomspace(1e-3, 1.0, 61)  # twenty a decade


def test_a_power_law_has_one_exponent_everywhere():
    """To rounding: logarithms of size 7 to 1e-16 over half a decade."""
    found = local_exponents(FORCE, 3.0 * FORCE**0.7)
    assert len(found) == 6  # three decades, by halves
    for each in found:
        assert each.exponent == pytest.approx(0.7, abs=1e-13)
        assert each.error < 1e-13
        assert math.log10(each.window[1] / each.window[0]) == pytest.approx(0.5)
        assert each.count == 11


def test_a_bend_shows_in_the_windows():
    """ln y = x^2/10 has the slope x/5, and the line through points even in x has that of their middle."""
    x = np.log(FORCE)
    for each in local_exponents(FORCE, np.exp(x**2 / 10)):
        middle = 0.5 * math.log(each.window[0] * each.window[1])
        assert each.exponent == pytest.approx(middle / 5, abs=1e-12)


def test_the_error_is_that_of_many_draws():
    """The scatter of the slope over 400 draws, itself known to 1/sqrt(800) = 3.5 %, is the error stated on the mean,
    which is that of the right variance: within four of its errors."""
    rng = np.random.default_rng(1)
    force = np.geomspace(1.0, 10**0.5, 20)
    draws = [exponent_within(force, np.exp(rng.normal(0, 0.1, 20)), (1.0, 10**0.5)) for _ in range(400)]
    scatter = np.std([each.exponent for each in draws], ddof=1)
    stated = math.sqrt(np.mean([each.error**2 for each in draws]))
    assert scatter / stated == pytest.approx(1, abs=4 * 0.035)


def test_too_few_points_have_none():
    assert local_exponents(FORCE[:3], FORCE[:3]) == ()
    assert local_exponents(np.geomspace(1e-3, 1, 4), np.ones(4)) == ()  # two in each half decade at most
    assert exponent_within(np.ones(5), np.ones(5), (0.5, 2.0)) is None  # one force
    assert exponent_within(FORCE, np.full(61, np.nan), (1e-3, 1.0)) is None
