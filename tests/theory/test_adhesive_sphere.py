"""Both limits of a sphere that sticks: energy release, and Maugis' equations between them."""

import math

import numpy as np
import pytest

from roughcontact.theory.adhesive.adhesive_sphere import DMTSphere, JKRSphere
from roughcontact.theory.adhesive.maugis import DugdaleSphere

JKR = JKRSphere(2e-5, 3e7, 0.02)


def test_the_elastic_energy_that_the_edge_releases_is_the_work_of_adhesion():
    """At given depth dU/da of Hertz's contact loaded to a and drawn back as a punch is -2 pi a w."""
    e, r = JKR.modulus, JKR.radius
    for a in np.array([0.5, 1.0, 2.0]) * JKR.unloaded_radius:
        depth = float(JKR.depth(a))

        def elastic(a, depth=depth):
            # 8 E* a^5/(15 R^2) of Hertz's contact, then by the punch's stiffness 2 E* a from its force.
            moved, pressed = depth - a**2 / r, 4 * e * a**3 / (3 * r)
            return 8 * e * a**5 / (15 * r**2) + pressed * moved + e * a * moved**2

        step = 1e-4 * a
        release = (elastic(a + step) - elastic(a - step)) / (2 * step)
        # Of a polynomial of the fifth degree in a: step^2 of its third derivative over six.
        assert release == pytest.approx(2 * math.pi * a * JKR.work, rel=1e-6)
        # And the force is its slope with the depth.
        moved = depth - a**2 / r
        assert float(JKR.force(a)) == pytest.approx(4 * e * a**3 / (3 * r) + 2 * e * a * moved, rel=1e-12)


def test_its_ends():
    a = np.linspace(0.01, 2, 20001) * JKR.unloaded_radius
    assert -JKR.force(a).min() == pytest.approx(JKR.pull_off_force, rel=1e-7)
    assert JKR.depth(a).min() == pytest.approx(JKR.least_depth, rel=1e-7)
    assert abs(float(JKR.force(JKR.unloaded_radius))) <= 1e-14 * JKR.pull_off_force


def test_the_contact_radius_is_that_of_the_depth():
    depths = JKR.least_depth * np.array([1.0, 1 - 1e-9, 0.9, 0.1, 0.0, -1.0, -1e3, -1e6])
    radii = JKR.contact_radius(depths)
    np.testing.assert_allclose(JKR.depth(radii), depths, rtol=1e-12, atol=1e-14 * abs(JKR.least_depth))
    assert (np.diff(radii) >= 0).all()
    # At the end of the branch the depth is stationary: the root of rounding.
    fold = 6 ** (-1 / 3) * math.cbrt(0.75 * math.pi * JKR.work * JKR.radius**2 / JKR.modulus)
    assert radii[0] == pytest.approx(fold, rel=1e-6)
    with pytest.raises(ValueError, match="at least"):
        JKR.contact_radius(1.01 * JKR.least_depth)


def test_they_are_the_limits_of_maugis_equations():
    a = np.array([0.8, 1.5])
    strong, weak = DugdaleSphere(1.0, 1.0, 1.0, 300.0), DugdaleSphere(1.0, 1.0, 1.0, 1e-4)
    # The zone over the radius is pi/(4 s^2 a), and the radius of the zone of weak attraction sqrt(2 w R/s).
    np.testing.assert_allclose(JKRSphere(1.0, 1.0, 1.0).force(a), strong.force(a), rtol=20 / 300**2)
    np.testing.assert_allclose(DMTSphere(1.0, 1.0, 1.0).force(a), weak.force(a), atol=5e-2)
    assert DMTSphere(1.0, 1.0, 1.0).pull_off_force == pytest.approx(weak.pull_off_force, rel=1e-3)


@pytest.mark.parametrize("sphere", [JKRSphere, DMTSphere])
def test_what_is_no_sphere_is_refused(sphere):
    with pytest.raises(ValueError, match="the work"):
        sphere(1.0, 1.0, 0.0)
    with pytest.raises(ValueError, match="contact radius"):
        sphere(1.0, 1.0, 1.0).force(-1.0)
