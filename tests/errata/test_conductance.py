"""Thesis, eqs 4.4 and 7.3: heat between unequal bodies flows through both of them, one after the other."""

import math

import numpy as np
import pytest

from roughcontact.halfspace.influence.love import love
from roughcontact.theory.joints import conductance
from roughcontact.theory.stiffness_laws import pohrt_popov

PAIR = (1.0, 1 / 9)
EQUAL = (0.3, 0.3)


def printed_4_4(stiffness, modulus, conductivities):
    """k/E* = Lambda_t 2/(lambda1 + lambda2)."""
    return stiffness / modulus * sum(conductivities) / 2


def printed_7_3(force, hurst, theta, modulus, conductivities):
    """1.7/(H+1) (F/(E* Theta))^(1/(H+1)) = Lambda_t 2/(lambda1 + lambda2)."""
    return 1.7 / (hurst + 1) * (force / (modulus * theta)) ** (1 / (hurst + 1)) * sum(conductivities) / 2


def spot(cells=10):
    """An irregular contact region of unit cells: their centres."""
    y, x = np.mgrid[:cells, :cells].astype(float)
    inside = ((y - 4) ** 2 + (x - 4) ** 2 < 12) | ((y > 6) & (x > 5) & (x < 8))
    return y[inside], x[inside]


def potential():
    """Matrix of the integrals of 1/r over the cells of the spot."""
    y, x = spot()
    return love(x[:, None] - x, y[:, None] - y, 1.0, 1.0)


def heat_flow(conductivities):
    """Heat [W] through the spot between two half-spaces whose depths differ by 1 K, body by body.

    In a half-space a flux q [W/m^2] out of cells of its surface raises it by int q/(2 pi lambda r). What leaves one
    body enters the other, and on the spot the temperatures meet.
    """
    matrix, n = potential(), len(spot()[0])
    above, below = (matrix / (2 * math.pi * k) for k in conductivities)
    # T_above = 1 - above q, T_below = below q, equal on the spot.
    return float(np.linalg.solve(above + below, np.ones(n)).sum())


def stiffness(modulus):
    """Force [N] for unit displacement of the spot: u = int p/(pi E* r)."""
    return float(np.linalg.solve(potential() / (math.pi * modulus), np.ones(len(spot()[0]))).sum())


def test_4_4_heat_through_unequal_bodies():
    k = stiffness(7.0)
    # Both sides are solutions of one linear system: rounding.
    assert conductance.thermal(k, 7.0, PAIR) == pytest.approx(heat_flow(PAIR), rel=1e-12)
    assert conductance.thermal(k, 7.0, EQUAL) == pytest.approx(heat_flow(EQUAL), rel=1e-12)
    # The printed form is right for equal bodies and 2.8 times too high for these.
    assert printed_4_4(k, 7.0, EQUAL) == pytest.approx(heat_flow(EQUAL), rel=1e-12)
    assert printed_4_4(k, 7.0, PAIR) > 2.7 * heat_flow(PAIR)


def test_4_4_nothing_flows_into_an_insulator():
    k = stiffness(7.0)
    assert heat_flow((1.0, 1e-9)) < 1e-7
    assert conductance.thermal(k, 7.0, (1.0, 0.0)) == 0
    assert printed_4_4(k, 7.0, (1.0, 0.0)) > 1


@pytest.mark.parametrize("hurst", [0.5, 1.0])
def test_7_3_thermal_conductance_of_a_fractal(hurst):
    rms, length, modulus = 1e-6, 1e-3, 1e11
    theta, force = rms * length**-hurst, 0.01 * modulus * rms * length
    law = conductance.law(pohrt_popov.law(hurst, rms, length, modulus), modulus, conductivities=PAIR)
    value = law.predict("thermal_conductance", force)
    # Half of one body's conductance, lambda 2 k/E*, in series with half of the other's.
    k = 1.7 / (hurst + 1) * 0.01 ** (1 / (hurst + 1)) * modulus * length
    series = 1 / sum(1 / (2 * conductivity * k / modulus) for conductivity in PAIR)
    assert value == pytest.approx(series, rel=1e-12)
    assert printed_7_3(force, hurst, theta, modulus, PAIR) > 2.7 * series
    assert printed_7_3(force, hurst, theta, modulus, EQUAL) == pytest.approx(k / modulus * 0.3, rel=1e-12)
