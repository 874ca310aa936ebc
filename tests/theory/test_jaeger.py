"""Partial slip from a loading curve: the sphere, a power law, and the limits of every contact."""

from types import SimpleNamespace

import numpy as np
import pytest

from roughcontact.theory.joints import jaeger, mindlin
from roughcontact.theory.joints.cattaneo import SlippingSphere
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
    with pytest.raises(ValueError, match="has no 'depth'"):
        jaeger.displacement(LoadingLaw("k", "test", {"stiffness": lambda f: f}), FORCE, 1.0, **GIVEN)
    with pytest.raises(ValueError, match="must be one number"):
        jaeger.displacement(HERTZ, [FORCE, FORCE], 1.0, **GIVEN)
    with pytest.raises(ValueError, match="without force, depth, stiffness"):
        jaeger.displacement(5, FORCE, 1.0, **GIVEN)
    short = LoadingLaw("short", "test", HERTZ.quantities, (40.0, 60.0))
    with pytest.raises(ValueError, match=r"short has no depth at every force.*given: 35"):
        jaeger.displacement(short, FORCE, 0.3 * 15, **GIVEN)


class TestComputedCurves:
    force = np.geomspace(0.5, FORCE, 5)
    curve = SimpleNamespace(
        force=force, depth=HERTZ.predict("depth", force), stiffness=HERTZ.predict("stiffness", force)
    )
    inside = np.array([0.0, 0.2, 0.98, 0.99]) * 0.3 * FORCE

    def test_a_power_law_goes_through_its_points_and_the_origin(self):
        # Cubics in the logarithms are straight: only rounding is left.
        for function in (jaeger.displacement, jaeger.stiffness):
            truth = function(HERTZ, FORCE, self.inside, **GIVEN)
            assert function(self.curve, FORCE, self.inside, **GIVEN) == pytest.approx(truth, rel=1e-10)
        slid = jaeger.displacement(self.curve, FORCE, 0.3 * FORCE, **GIVEN)
        assert slid == pytest.approx(SPHERE.gross_slip, rel=1e-12)

    def test_a_cycle(self):
        loss = jaeger.cycle_loss(self.curve, FORCE, 0.2 * FORCE, **GIVEN)
        assert loss == pytest.approx(float(SPHERE.cycle_loss(0.2 * FORCE)), rel=1e-6)

    @pytest.mark.parametrize(("force", "part"), [(FORCE, 0.995), (1.01 * FORCE, 0.1)])
    def test_beyond_its_points_it_is_not_known(self, force, part):
        with pytest.raises(ValueError, match="a curve of more points"):
            jaeger.displacement(self.curve, force, part * 0.3 * force, **GIVEN)

    def test_points_that_do_not_increase(self):
        with pytest.raises(ValueError, match="strictly increasing force"):
            jaeger.displacement(
                SimpleNamespace(force=[2.0, 1.0], depth=[2.0, 1.0], stiffness=[1.0, 1.0]), 2.0, 0.1, **GIVEN
            )
