"""Partial slip of a sphere: sums of its traction, its stiffness, and the work of a cycle by quadrature."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.joints import mindlin
from roughcontact.theory.joints.cattaneo import SlippingSphere

SPHERE = SlippingSphere(50.0, 0.02, 1.1e11, 0.3, 1.2)
LIMIT = 0.3 * 50.0
PARTS = [1e-6, 0.1, 0.5, 0.9, 1.0]


def test_normal_contact_is_hertz():
    a, d = SPHERE.contact_radius, SPHERE.depth
    assert 4 / 3 * 1.1e11 * math.sqrt(0.02) * d**1.5 == pytest.approx(50, rel=1e-13)
    assert SPHERE.peak_pressure == pytest.approx(3 * 50 / (2 * math.pi * a**2), rel=1e-13)


@pytest.mark.parametrize("part", PARTS)
def test_traction_carries_the_force(part):
    a, q = SPHERE.contact_radius, part * LIMIT
    c = float(SPHERE.stick_radius(q))

    # r = a sin t, and within the stick disc r = c sin t, smooths the roots.
    def ring(t, edge):
        r = edge * math.sin(t)
        return float(SPHERE.traction(r, q)) * 2 * math.pi * r * edge * math.cos(t)

    inner = quad(ring, 0, math.pi / 2, args=(c,), epsabs=0, epsrel=1e-11)[0]
    outer = quad(ring, math.asin(min(c / a, 1)), math.pi / 2, args=(a,), epsabs=0, epsrel=1e-11)[0]
    assert inner + outer == pytest.approx(q, rel=1e-8)


def test_traction_is_bounded_by_friction():
    r = np.linspace(0, 1.2, 200) * SPHERE.contact_radius
    pressure = SPHERE.peak_pressure * np.sqrt(np.maximum(1 - (r / SPHERE.contact_radius) ** 2, 0))
    for part in PARTS:
        traction = SPHERE.traction(r, part * LIMIT)
        assert (traction <= 0.3 * pressure * (1 + 1e-12)).all()
        assert traction[r > SPHERE.contact_radius].max() == 0


def test_displacement_and_stiffness():
    q, h = np.array([0.1, 0.5, 0.9]) * LIMIT, 1e-5 * LIMIT
    slope = (SPHERE.displacement(q + h) - SPHERE.displacement(q - h)) / (2 * h)
    # h^2 times a third derivative of up to 1e3 at 0.9.
    assert 1 / slope == pytest.approx(SPHERE.stiffness(q), rel=1e-7)
    # 2 G* a to begin with, and full slip at mu (E*/G*) d = 3 mu P/(4 a G*).
    shear = 1.1e11 / 1.2
    assert SPHERE.stiffness(0.0) == pytest.approx(2 * shear * SPHERE.contact_radius, rel=1e-14)
    assert SPHERE.displacement(LIMIT) == pytest.approx(SPHERE.gross_slip, rel=1e-14)
    assert SPHERE.gross_slip == pytest.approx(3 * LIMIT / (4 * SPHERE.contact_radius * shear), rel=1e-13)
    # Small forces keep their digits.
    tiny = 1e-12 * LIMIT
    assert SPHERE.displacement(tiny) == pytest.approx(tiny / float(SPHERE.stiffness(0.0)), rel=1e-11)


@pytest.mark.parametrize("part", [0.1, 0.5, 1.0])
def test_loss_is_the_area_of_the_loop(part):
    top = part * LIMIT

    def width(q):  # unloading branch minus the loading one, its mirror image
        return float(SPHERE.reversed_displacement(q, top) + SPHERE.reversed_displacement(-q, top))

    area = quad(width, -top, top, epsabs=0, epsrel=1e-11, limit=200)[0]
    assert SPHERE.cycle_loss(top) == pytest.approx(area, rel=1e-9)


def test_loss_of_small_cycles():
    f, shear = 1e-6, 1.1e11 / 1.2
    exact = f**3 / 9 * LIMIT**2 / (SPHERE.contact_radius * shear)
    # The next term is 2 f/3 of it.
    assert SPHERE.cycle_loss(f * LIMIT) == pytest.approx(exact, rel=1e-6)


def test_a_cycle_closes():
    top = 0.7 * LIMIT
    assert SPHERE.reversed_displacement(top, top) == pytest.approx(float(SPHERE.displacement(top)), rel=1e-14)
    assert SPHERE.reversed_displacement(-top, top) == pytest.approx(
        -float(SPHERE.displacement(top)), rel=1e-13
    )


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="slides"):
        SPHERE.displacement(1.01 * LIMIT)
    with pytest.raises(ValueError, match="tangential force"):
        SPHERE.stick_radius(-1.0)
    with pytest.raises(ValueError, match="friction"):
        SlippingSphere(1.0, 1.0, 1.0, 0.0, 1.2)
    with pytest.raises(ValueError, match="friction must be one number"):
        SlippingSphere(1.0, 1.0, 1.0, "a", 1.2)


@pytest.mark.parametrize("ratio", [5.0, 1.51, 0.74])
def test_no_solids_have_such_a_ratio(ratio):
    with pytest.raises(ValueError, match=r"E\*/G\* of a round contact lies from 1 to 1.5"):
        SlippingSphere(1.0, 1.0, 1.0, 0.3, ratio)


@pytest.mark.parametrize("poisson_ratio", [-0.999, 0.0, 0.3, 0.5])
def test_all_solids_have_one(poisson_ratio):
    ratio = mindlin.ratio(poisson_ratio)
    assert SlippingSphere(1.0, 1.0, 1.0, 0.3, ratio).ratio == ratio
