"""Bodies of revolution: what the thesis leaves open in 5.3 and 5.4, and the reduction A.60-A.66, which is right."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent, indentation_curve
from roughcontact.theory.spheres_and_punches.power_law_indenter import kappa


def sneddon(slope, a, modulus):
    """Sneddon (1965): depth and force of a contact of radius a from the slope f'(r), by quadrature."""
    depth = a * quad(lambda t: slope(a * math.sin(t)), 0, math.pi / 2, epsrel=1e-12)[0]
    force = (
        2
        * modulus
        * a**2
        * quad(lambda t: math.sin(t) ** 2 * slope(a * math.sin(t)), 0, math.pi / 2, epsrel=1e-12)[0]
    )
    return depth, force


def stiffness_5_3(force, modulus, coefficient, exponent, kappa):
    n = exponent
    return 2 * modulus * ((n + 1) * force / (2 * coefficient * modulus * n * kappa)) ** (1 / (n + 1))


def kappa_with_a_half(n):
    """The factor that another usual form, sqrt(pi)/2 n Gamma(n/2)/Gamma((n+1)/2), seems to ask for."""
    return math.sqrt(math.pi) / 2 * math.gamma(n / 2 + 1) / math.gamma((n + 1) / 2)


@pytest.mark.parametrize("n", [0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 4.0])
def test_5_3_kappa_which_the_thesis_does_not_define(n):
    """kappa(n) = sqrt(pi) Gamma(n/2 + 1)/Gamma((n + 1)/2); with a half it would miss by more than a tenth."""
    Q, E, a = 0.7, 3.0, 0.4
    _, force = sneddon(lambda r: n * Q * r ** (n - 1), a, E)
    assert stiffness_5_3(force, E, Q, n, kappa(n)) == pytest.approx(2 * E * a, rel=1e-8)
    assert indent(indenter.power_law(n, Q), E, force=force).stiffness == pytest.approx(2 * E * a, rel=1e-8)
    assert abs(stiffness_5_3(force, E, Q, n, kappa_with_a_half(n)) / (2 * E * a) - 1) > 0.1


def test_5_4_the_coefficient_is_one_over_twice_the_radius():
    """Q = 1/2R reads 1/(2R); as (1/2) R the special case of 5.3 is not 5.4."""
    R, E, force = 0.3, 3.0, 0.2
    hertz = E * (6 * R * force / E) ** (1 / 3)
    assert stiffness_5_3(force, E, 1 / (2 * R), 2, kappa(2)) == pytest.approx(hertz, rel=1e-14)
    assert abs(stiffness_5_3(force, E, R / 2, 2, kappa(2)) / hertz - 1) > 0.1


def test_a_60_to_a_66_springs_under_half_the_radius_are_hertz():
    """The sum over springs of A.63 under z = x^2/(2 R1), R1 = R/2, by brute force."""
    R, E = 0.3, 3.0
    depths = np.array([0.01, 0.05])
    curve = indentation_curve(indenter.paraboloid(R), E, depths=depths)
    x, step = np.linspace(-0.2, 0.2, 400001, retstep=True)
    for d, force, k in zip(depths, curve.force, curve.stiffness, strict=True):
        pressed = np.maximum(d - x**2 / R, 0)
        # A sum with a kink at each end: the square of the step.
        assert force == pytest.approx(E * step * pressed.sum(), rel=1e-9)
        assert k == pytest.approx(E * step * (pressed > 0).sum(), rel=1e-4)
        assert force == pytest.approx(4 / 3 * E * math.sqrt(R) * d**1.5, rel=1e-13)
        assert k == pytest.approx(2 * E * math.sqrt(R * d), rel=1e-13)
