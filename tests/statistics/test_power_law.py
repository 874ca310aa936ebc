"""A power law says whether it is one."""

import math

import numpy as np
import pytest

from roughcontact.statistics.power_law import fit_power_law

FORCE = np.geomspace(1e-3, 0.07, 20)


def law_of(values, force=FORCE):
    return fit_power_law(force, values, 1.0, 1.0)


def test_a_power_law_is_straight():
    law = law_of(2 * FORCE**0.55)
    assert law.bend == pytest.approx(0, abs=1e-12)
    assert law.straight


@pytest.mark.parametrize(("change", "straight"), [(0.09, True), (0.11, False), (-0.11, False), (-0.5, False)])
def test_a_bend_of_more_than_a_tenth_is_none(change, straight):
    """The slope of ln y = a x + c (x - middle)^2 changes by 2 c times the width of the window."""
    x = np.log(FORCE)
    middle, width = (x[0] + x[-1]) / 2, x[-1] - x[0]
    law = law_of(np.exp(0.55 * x + change / (2 * width) * (x - middle) ** 2))
    assert law.bend == pytest.approx(change, abs=1e-12)
    assert law.straight == straight
    assert law.ends == pytest.approx((0.55 - change / 2, 0.55 + change / 2), abs=1e-12)


def test_scatter_is_no_bend():
    """Of 300 noisy power laws one in 370 is taken for bent by chance alone; four or more happen once in 100."""
    rng = np.random.default_rng(3)
    for points in (4, 20):
        force = np.geomspace(1e-3, 0.07, points)
        laws = [law_of(force**0.5 * np.exp(rng.normal(0, 0.3, points)), force) for _ in range(300)]
        assert sum(not law.straight for law in laws) < 4


def test_three_points_cannot_tell():
    law = law_of(np.array([1.0, 5.0, 6.0]), np.array([1.0, 2.0, 4.0]))
    assert law.straight
    assert math.isinf(law.bend_error)
