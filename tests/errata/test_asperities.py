"""Thesis, section 3.1: the force on asperities of exponential height, where it holds, and the sign of its stiffness."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.asperity_models import greenwood_williamson as gw

COUNT, COEFFICIENT, RATE = 1e4, 3.0, 1.7  # N0, c, lambda: any, but lambda not 1


def printed_3_6(height, exponent, coefficient=COEFFICIENT, rate=RATE):
    """N0 c lambda^(-beta-1) Gamma(1 + beta) exp(-lambda h), without the stray dz."""
    return COUNT * coefficient * rate ** (-exponent - 1) * math.gamma(1 + exponent) * math.exp(-rate * height)


def right_3_6(height, exponent, coefficient=COEFFICIENT, rate=RATE):
    """N0 c lambda^(-beta) Gamma(1 + beta) exp(-lambda h)."""
    return COUNT * coefficient * rate**-exponent * math.gamma(1 + exponent) * math.exp(-rate * height)


def summed_3_4(height, exponent):
    """N0 c int phi(z) (z - h)^beta dz over the heights there are, z > 0."""
    low = max(height, 0.0)

    def share(v):
        # z = low + v^4 takes the singularity of a negative exponent away.
        return 4 * v**3 * RATE * math.exp(-RATE * (low + v**4)) * (low - height + v**4) ** exponent

    # At v = 2.5 exp(-lambda v^4) is below rounding.
    value, _ = quad(share, 0, 2.5, epsabs=0, epsrel=1e-12)
    return COUNT * COEFFICIENT * value


@pytest.mark.parametrize("exponent", [-0.5, 1.0, 1.5, 2.25])
@pytest.mark.parametrize("height", [0.0, 0.4, 2.0])
def test_3_6_force_on_exponential_heights(exponent, height):
    expected = summed_3_4(height, exponent)
    assert right_3_6(height, exponent) == pytest.approx(expected, rel=1e-10)
    # Too small by the factor lambda, whatever the height.
    assert printed_3_6(height, exponent) == pytest.approx(expected / RATE, rel=1e-10)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.25])
def test_3_6_in_the_theory(exponent):
    # Exponential heights from 0 on, one asperity per nominal area of 1/N0; the modulus does not matter.
    asperity = gw.Asperity(COEFFICIENT, exponent, modulus=1.0)
    population = gw.Population(asperity, COUNT, 1 / RATE, 1 / RATE, "exponential")
    assert population.pressure(0.4) == pytest.approx(summed_3_4(0.4, exponent), rel=1e-10)


def test_3_6_is_a_force_in_any_unit_of_length():
    changed = {"coefficient": COEFFICIENT / 1e3**1.5, "rate": RATE / 1e3}
    assert right_3_6(400.0, 1.5, **changed) == pytest.approx(right_3_6(0.4, 1.5), rel=1e-12)
    assert printed_3_6(400.0, 1.5, **changed) == pytest.approx(1e3 * printed_3_6(0.4, 1.5), rel=1e-12)


@pytest.mark.parametrize("exponent", [-0.5, 1.0, 1.5])
def test_3_7_and_3_9_hold_above_the_lowest_asperity_only(exponent):
    def stiffness_over_force(height, step=1e-4):
        below, above = summed_3_4(height - step, exponent), summed_3_4(height + step, exponent)
        return (below - above) / (2 * step) / summed_3_4(height, exponent)

    # A central difference of exp(-lambda h) errs by (lambda step)^2/6.
    assert stiffness_over_force(0.4) == pytest.approx(RATE, rel=1e-8)
    # Below, all springs touch already: of linear ones (beta = 1) K/F = 1/(1/lambda - h) = 0.54 lambda at h = -0.5.
    assert stiffness_over_force(-0.5) < 0.75 * RATE
    assert summed_3_4(-0.5, exponent) < 0.9 * right_3_6(-0.5, exponent)


@pytest.mark.parametrize("distribution", ["gaussian", "exponential"])
def test_3_16_interfacial_stiffness_is_minus_the_derivative_over_the_gap(distribution):
    # Below eq. 3.16 K = A0 dp/du is printed, with the mean gap u; here in Greenwood and Williamson's theory.
    area = 1e-6
    law = gw.law(rc.Moments(1e-12, 0.01, 1e9), 2e11, area, distribution=distribution)
    force = np.array([1 - 1e-5, 1, 1 + 1e-5])
    gap = law.predict("mean_gap", force)
    printed = (force[2] - force[0]) / (gap[2] - gap[0])
    assert printed < 0
    # A central difference with a step of 1e-5, of gaps rounded in the 16th digit.
    assert -printed == pytest.approx(law.predict("interfacial_stiffness", 1.0), rel=1e-9)
