"""Adhesive contact: Johnson-Kendall-Roberts, its like for other bodies, and energy."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from roughcontact.mdr.adhesive_bodies.adhesion import jkr
from roughcontact.mdr.bodies import indenter
from roughcontact.theory.spheres_and_punches.power_law_indenter import kappa

R, E, W = 0.5, 3.0, 0.2
SPHERE = jkr(indenter.paraboloid(R), E, W)


class TestSphere:
    def test_pull_off_under_a_given_force(self):
        pull = SPHERE.pull_off()
        assert pull.force == pytest.approx(-1.5 * math.pi * W * R, rel=1e-12)
        assert pull.contact_radius == pytest.approx((9 * math.pi * R**2 * W / (8 * E)) ** (1 / 3), rel=1e-12)

    def test_pull_off_under_a_given_depth(self):
        pull = SPHERE.pull_off(math.inf)
        assert pull.force == pytest.approx(-5 / 6 * math.pi * W * R, rel=1e-12)
        assert pull.depth == pytest.approx(
            -((27 * math.pi**2 * W**2 * R / (64 * E**2)) ** (1 / 3)), rel=1e-12
        )

    def test_both_branches_of_the_load(self):
        """a^3 = (3R/4E*)(F + 3 pi w R +- sqrt(6 pi w R F + (3 pi w R)^2)); the lower sign is unstable."""
        pull = 1.5 * math.pi * W * R
        for F in (-0.99 * pull, -0.3 * pull, 0.0, 2.0):
            root = math.sqrt(4 * pull * F + 4 * pull**2)
            for sign in (1, -1):
                cube = 3 * R / (4 * E) * (F + 2 * pull + sign * root)
                if sign < 0 and F >= 0:
                    continue  # the lower branch ends at F = 0
                a = cube ** (1 / 3)
                assert SPHERE.force(a) == pytest.approx(F, abs=1e-13)
                assert SPHERE.depth(a) == pytest.approx(
                    a**2 / R - math.sqrt(2 * math.pi * a * W / E), rel=1e-13
                )
                assert (SPHERE.force_slope(a) > 0) == (sign > 0)

    def test_the_pressure(self):
        """Johnson: (2 E* a/(pi R)) sqrt(1 - s^2) - sqrt(2 E* w/(pi a))/sqrt(1 - s^2)."""
        a, s = 0.4, np.array([0.0, 0.3, 0.9, 0.9999])
        root = np.sqrt(1 - s**2)
        truth = 2 * E * a / (math.pi * R) * root - math.sqrt(2 * E * W / (math.pi * a)) / root
        np.testing.assert_allclose(SPHERE.at(a).pressure(a * s), truth, rtol=1e-12)
        assert SPHERE.at(a).pressure(a) == -np.inf

    @pytest.mark.parametrize("machine", [0.01, 1.0, 100.0])
    def test_a_machine_lies_between(self, machine):
        soft, between, stiff = (SPHERE.pull_off(k) for k in (0.0, machine, math.inf))
        assert soft.force < between.force < stiff.force
        # The slope of the load-depth curve is that of the machine, downwards.
        a = between.contact_radius
        assert SPHERE.force_slope(a) / SPHERE.depth_slope(a) == pytest.approx(-machine, rel=1e-9)

    def test_soft_and_stiff_machines_tend_to_the_limits(self):
        assert SPHERE.pull_off(1e-9).force == pytest.approx(SPHERE.pull_off().force, rel=1e-9)
        assert SPHERE.pull_off(1e9).force == pytest.approx(SPHERE.pull_off(math.inf).force, rel=1e-6)


@pytest.mark.parametrize("n", [0.7, 1.0, 1.5, 3.0, 4.0])
@pytest.mark.parametrize(("machine", "share"), [(0.0, 1.5), (math.inf, 0.5)])
def test_power_laws(n, machine, share):
    """Where n g(a) = share * l(a): a^(n - 1/2) = share sqrt(2 pi w/E*)/(n kappa Q)."""
    Q = 0.8
    a = (share * math.sqrt(2 * math.pi * W / E) / (n * kappa(n) * Q)) ** (1 / (n - 0.5))
    g, elongation = kappa(n) * Q * a**n, math.sqrt(2 * math.pi * a * W / E)
    pull = jkr(indenter.power_law(n, Q), E, W).pull_off(machine)
    assert pull.contact_radius == pytest.approx(a, rel=1e-11)
    assert pull.depth == pytest.approx(g - elongation, rel=1e-11)
    assert pull.force == pytest.approx(2 * E * a * (g * n / (n + 1) - elongation), rel=1e-11)


BODIES = [
    indenter.cone(0.3),
    indenter.sphere(1.0),
    indenter.paraboloid(R) + indenter.equivalent_roughness(0.8, rms=1e-3, length=1.0),
    indenter.paraboloid(R, flat=0.2),
    indenter.of(lambda r: r**2 + r**4, 3.0),
]


@pytest.mark.parametrize("body", BODIES, ids=repr)
class TestAnyBody:
    radii = np.array([0.25, 0.4, 0.7])

    def test_equilibria_hold_by_energy(self, body):
        """At a given depth dE/da = 0, and dE/dd = F: finite differences of the energy, which knows no rule of Hess."""
        adhesion = jkr(body, E, W)
        for a in self.radii.tolist():
            d, step = float(adhesion.depth(a)), 1e-5
            along = (adhesion.energy(a + step, d) - adhesion.energy(a - step, d)) / (2 * step)
            assert along == pytest.approx(0, abs=1e-7)
            across = (adhesion.energy(a, d + step) - adhesion.energy(a, d - step)) / (2 * step)
            assert across == pytest.approx(float(adhesion.force(a)), rel=1e-7)

    def test_slopes_are_derivatives(self, body):
        adhesion, step = jkr(body, E, W), 1e-6
        for value, slope in ((adhesion.depth, adhesion.depth_slope), (adhesion.force, adhesion.force_slope)):
            truth = (value(self.radii + step) - value(self.radii - step)) / (2 * step)
            np.testing.assert_allclose(slope(self.radii), truth, rtol=1e-6)

    def test_the_edge_is_a_crack_of_the_work(self, body):
        """Irwin: p -> -K/sqrt(2 pi s) with K^2 = 2 E* w at the distance s inside the edge."""
        a, s = 0.4, 1e-8
        K = -jkr(body, E, W).at(a).pressure(a - s) * math.sqrt(2 * math.pi * s)
        assert pytest.approx(2 * E * W, rel=1e-6) == K**2

    def test_weak_adhesion_is_none(self, body):
        weak = jkr(body, E, 1e-16)
        np.testing.assert_allclose(weak.depth(self.radii), body.transform(self.radii), atol=1e-7)

    def test_pull_off_is_the_lowest_point(self, body):
        adhesion = jkr(body, E, W)
        a = np.append(np.geomspace(1e-3, 0.99 * min(body.radius, 50.0), 4000), max(body.flat, 1e-3))
        assert adhesion.pull_off().force <= adhesion.force(a).min()
        assert adhesion.pull_off().force == pytest.approx(adhesion.force(a).min(), rel=1e-5)
        assert adhesion.pull_off(math.inf).depth == pytest.approx(adhesion.depth(a).min(), rel=1e-4)


class TestFlatFaces:
    def test_kendall(self):
        pull = jkr(indenter.flat_punch(0.3), E, W).pull_off()
        assert pull.force == pytest.approx(-math.sqrt(8 * math.pi * E * W * 0.3**3), rel=1e-14)
        assert pull.contact_radius == 0.3

    def test_a_flat_ended_body_snaps_off_its_face_or_before(self):
        flat = jkr(indenter.paraboloid(R, flat=0.3), E, W).pull_off()
        assert flat.contact_radius == pytest.approx(0.3, rel=1e-12)
        assert flat.force == pytest.approx(-math.sqrt(8 * math.pi * E * W * 0.3**3), rel=1e-12)
        round_one = jkr(indenter.paraboloid(R, flat=1e-4), E, W).pull_off()
        assert round_one.force == pytest.approx(-1.5 * math.pi * W * R, rel=1e-6)


class TestRefusals:
    def test_bodies_blunter_than_a_root_stick_without_end(self):
        with pytest.raises(ValueError, match="faster than the square root"):
            jkr(indenter.power_law(0.3, 1.0), E, W).pull_off()

    def test_the_end_of_what_is_known(self):
        with pytest.raises(ValueError, match="define the body to a larger radius"):
            jkr(indenter.of(lambda r: r**2, 0.05), E, W).pull_off()

    def test_nonsense(self):
        with pytest.raises(ValueError, match="work of adhesion"):
            jkr(indenter.paraboloid(R), E, 0.0)
        with pytest.raises(ValueError, match="stiffness of the machine"):
            SPHERE.pull_off(-1.0)
        with pytest.raises(ValueError, match="between 0"):
            SPHERE.at(0.0)


def test_ripples_toughen():
    """Guduru (2007): concentric waviness raises the pull-off force; the wave's pull-off is a turn of F(a)."""
    body = indenter.paraboloid(R) + indenter.ripples(0.004, 0.1, 1.0)
    adhesion = jkr(body, E, 0.01)
    pull = adhesion.pull_off()
    assert pull.force < 1.3 * jkr(indenter.paraboloid(R), E, 0.01).pull_off().force
    turn = brentq(
        lambda a: float(adhesion.force_slope(a)), pull.contact_radius - 1e-3, pull.contact_radius + 1e-3
    )
    assert pull.contact_radius == pytest.approx(turn, rel=1e-9)


def test_what_is_no_body_and_no_work():
    with pytest.raises(ValueError, match=r"body of revolution is needed.*not 0.01"):
        jkr(0.01, E, W)
    with pytest.raises(ValueError, match="work of adhesion must be one number"):
        jkr(indenter.paraboloid(R), E, "a")
