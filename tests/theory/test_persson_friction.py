"""Persson's theory of hysteretic friction, against quadrature by other rules."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory import persson, persson_friction
from roughcontact.theory.random_surfaces.waves import Waves

RUBBER = rc.viscoelastic.standard_solid(1.0, 3.0, 1.0)


class PowerLaw:
    """C2D = C0 q^-3.6 from 1 to 100, rms height 0.1."""

    q_min, q_max = 1.0, 100.0
    factor = 0.01 * 1.6 / (2 * np.pi * (1 - 100**-1.6))

    def __call__(self, q):
        return self.factor * q**-3.6


# Speed, coefficient with gamma = 1 and 1/2, contact fraction: two independent quadratures agree to these digits.
TABLE = [
    (0.001, 0.0144194762, 0.0085458822, 0.3343618642),
    (0.01, 0.1079169736, 0.0637718380, 0.2699089933),
    (0.1, 0.1494665198, 0.0955261338, 0.1498479204),
    (1.0, 0.0705055985, 0.0489902300, 0.1208398607),
]


@pytest.mark.parametrize(("speed", "first", "later", "fraction"), TABLE)
def test_the_coefficient_and_the_area_are_those_of_independent_quadratures(speed, first, later, fraction):
    given = 0.1, RUBBER, PowerLaw(), speed
    # The spread of pressure is integrated by a spline through 464 nodes: its error is 1e-7.
    assert persson_friction.friction_coefficient(*given) == pytest.approx(first, rel=2e-7)
    assert persson_friction.friction_coefficient(*given, gamma=0.5) == pytest.approx(later, rel=2e-7)
    assert persson_friction.contact_fraction(*given) == pytest.approx(fraction, rel=2e-7)


def test_in_full_contact_the_sum_over_the_waves_is_exact():
    waves = Waves.of_bands(np.array([2.0, 5.0]), np.array([1e-4, 1e-5]))
    angle = (np.arange(4096) + 0.5) * np.pi / 2048
    # Half the sum of power q^2 Im E cos(angle), averaged over angles; q, not q^2, times q.v/v = q cos(angle).
    modulus = RUBBER.complex_modulus(0.3 * np.abs(np.outer([2.0, 5.0], np.cos(angle))))
    lost = (modulus.imag * np.abs(np.cos(angle))).mean(1)
    expected = 0.5 * np.array([1e-4, 1e-5]) * np.array([2.0, 5.0]) ** 2 @ lost
    found = persson_friction.friction_coefficient(10.0, RUBBER, waves, 0.3)
    assert found * 10.0 == pytest.approx(expected, rel=1e-6)  # midpoint rule across the kink at a right angle


@pytest.mark.parametrize(("speed", "modulus"), [(1e-12, 1.0), (1e12, 3.0)])
def test_slow_and_fast_sliding_have_the_elastic_area(speed, modulus):
    found = persson_friction.contact_fraction(0.1, RUBBER, PowerLaw(), speed)
    assert found == pytest.approx(float(persson.contact_fraction(0.1, modulus, PowerLaw())), rel=1e-9)


def test_bad_input_is_refused():
    with pytest.raises(rc.InputError, match="gamma must lie between 0 and 1, not 2"):
        persson_friction.friction_coefficient(0.1, RUBBER, PowerLaw(), 1.0, gamma=2.0)
    with pytest.raises(rc.InputError, match="speed"):
        persson_friction.contact_fraction(0.1, RUBBER, PowerLaw(), 0.0)
