"""A sphere by the model of Dugdale: against quadrature, and its limits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.adhesive.maugis import DugdaleSphere

# Maugis' equations as he prints them, in his units, solved by another program to six digits.
PULL_OFF = {0.01: 1.998288, 0.1: 1.950595, 0.5: 1.718245, 1.0: 1.600735, 2.0: 1.534603, 5.0: 1.506350}
SPHERE = DugdaleSphere(2e-5, 3e8, 0.02, 4e6)


@pytest.mark.parametrize("radius", [0.0, 2e-7, 1e-6])
def test_the_equations_by_quadrature_of_the_stresses(radius):
    """Collins' function of the half-space: its Abel transforms are the traction and the displacement."""
    a, c = radius, float(SPHERE.zone_radius(radius))
    d, s = float(SPHERE.depth(a)), SPHERE.strength
    curved = lambda x: SPHERE.modulus * (d - x**2 / SPHERE.radius)  # noqa: E731
    # The traction s between a and c, summed along a chord.
    pulled = lambda x: -2 * s * math.sqrt((c - x) * (c + x))  # noqa: E731
    assert curved(a) == pytest.approx(pulled(a), rel=1e-12)  # no singular stress at the contact's edge
    parts = ((curved, (0, a)), (pulled, (a, c)))
    force = 2 * sum(quad(f, *ends, epsabs=0, epsrel=1e-11)[0] for f, ends in parts)
    assert float(SPHERE.force(a)) == pytest.approx(force, rel=1e-9)
    # Displacement at the end of the zone; r = c sin t smooths the root.
    inner, outer = (
        quad(lambda t, f=f: f(c * math.sin(t)), *ends, epsabs=0, epsrel=1e-11)[0]
        for f, ends in ((curved, (0, math.asin(a / c))), (pulled, (math.asin(a / c), math.pi / 2)))
    )
    lifted = 2 / (math.pi * SPHERE.modulus) * (inner + outer)
    gap = c**2 / (2 * SPHERE.radius) - d + lifted
    assert gap * s == pytest.approx(SPHERE.work, rel=1e-8)


@pytest.mark.parametrize(("number", "wanted"), PULL_OFF.items())
def test_pull_off(number, wanted):
    sphere = DugdaleSphere.of_number(number)
    assert sphere.number == pytest.approx(number, rel=1e-14)
    assert sphere.pull_off_force / math.pi == pytest.approx(wanted, abs=1e-6)


def test_limits():
    assert DugdaleSphere.of_number(1e-4).pull_off_force / math.pi == pytest.approx(2, abs=1e-4)
    assert DugdaleSphere.of_number(50).pull_off_force / math.pi == pytest.approx(1.5, abs=1e-3)
    a = np.array([0.8, 1.5])
    jkr = 4 / 3 * a**3 - np.sqrt(8 * math.pi * a**3)
    # The zone is of the length pi E* w/(4 s^2) = pi/(4 s^2); corrections are of its share of the radius.
    strong = DugdaleSphere(1.0, 1.0, 1.0, 100.0)
    np.testing.assert_allclose(strong.force(a), jkr, rtol=math.pi / (4 * 100**2) / 0.8 * 10)


def test_what_is_no_sphere_is_refused():
    with pytest.raises(ValueError, match="the strength"):
        DugdaleSphere(1.0, 1.0, 1.0, 0.0)
    with pytest.raises(ValueError, match="contact radius"):
        SPHERE.force(-1.0)
