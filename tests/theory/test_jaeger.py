"""Partial slip from a loading curve: the sphere, a power law, and the limits of every contact."""

import numpy as np
import pytest

from roughcontact.theory import jaeger, mindlin
from roughcontact.theory.cattaneo import SlippingSphere
from roughcontact.theory.law import LoadingLaw

RADIUS, MODULUS, FORCE = 0.02, 1.1e11, 50.0
SPHERE = SlippingSphere(FORCE, RADIUS, MODULUS, 0.3, 1.2)
HERTZ = LoadingLaw(
    "sphere",
    "closed form",
    {
        "depth": lambda f: (3 * f / (4 * MODULUS * RADIUS**0.5)) ** (2 / 3),
        "stiffness": lambda f: 2 * MODULUS * (3 * f * RADIUS / (4 * MODULUS)) ** (1 / 3),
    },
)
GIVEN = {"friction": 0.3, "ratio": 1.2}


def test_sphere_is_cattaneo():
    q = np.array([0.0, 1e-3, 0.3, 0.8, 1.0]) * 0.3 * FORCE
    assert jaeger.displacement(HERTZ, FORCE, q, **GIVEN) == pytest.approx(
        SPHERE.displacement(q), rel=1e-10, abs=1e-18
    )
    assert jaeger.stiffness(HERTZ, FORCE, q, **GIVEN) == pytest.approx(
        SPHERE.stiffness(q), rel=1e-10, abs=1e-3
    )


@pytest.mark.parametrize("part", [0.2, 0.7, 1.0])
def test_loss_of_a_sphere(part):
    loss = jaeger.cycle_loss(HERTZ, FORCE, part * 0.3 * FORCE, **GIVEN)
    # Quadrature to 1e-10, of a difference that keeps part^2/54 of its terms.
    assert loss == pytest.approx(float(SPHERE.cycle_loss(part * 0.3 * FORCE)), rel=1e-6)


def test_power_law():
    # k ~ F^alpha: displacement over that of gross slip is 1 - (1 - Q/mu F)^(1 - alpha).
    alpha = 0.55
    law = LoadingLaw("power", "test", {"depth": lambda f: 1e-6 * f ** (1 - alpha)})
    part = np.array([0.1, 0.6, 1.0])
    top = mindlin.gross_slip(1e-6 * FORCE ** (1 - alpha), 0.3, 1.2)
    assert jaeger.displacement(law, FORCE, part * 0.3 * FORCE, **GIVEN) == pytest.approx(
        top * (1 - (1 - part) ** (1 - alpha)), rel=1e-12
    )


def test_a_linear_spring_loses_nothing():
    # d ~ F: no part slips before all of it does.
    spring = LoadingLaw("spring", "test", {"depth": lambda f: 1e-6 * f})
    loss = jaeger.cycle_loss(spring, FORCE, 0.2 * FORCE, **GIVEN)
    assert loss == pytest.approx(0, abs=1e-9 * 0.2 * FORCE * 1e-6 * FORCE)


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="slides"):
        jaeger.displacement(HERTZ, FORCE, 0.31 * FORCE, **GIVEN)
    with pytest.raises(ValueError, match="says nothing"):
        jaeger.displacement(LoadingLaw("k", "test", {"stiffness": lambda f: f}), FORCE, 1.0, **GIVEN)
