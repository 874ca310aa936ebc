"""Viscoelastic springs under any history, against Lee & Radok while contact grows and Ting when it recedes."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent, indentation_curve, indented
from roughcontact.mdr.viscoelasticity.viscoelastic_history import depth_history, force_history
from roughcontact.viscoelastic.elastic_transfer import transfer
from roughcontact.viscoelastic.models import kelvin_voigt, maxwell, standard_solid, viscous
from roughcontact.viscoelastic.prony_series import Viscoelastic

R = 0.5
BODY = indenter.paraboloid(R)
SOLID = standard_solid(1.0, 3.0, 0.4)
MATERIALS = {
    "viscous": viscous(0.2),
    "Kelvin-Voigt": kelvin_voigt(3.0, 0.5),
    "Maxwell": maxwell(2.0, 0.7),
    "standard solid": SOLID,
    "Prony": Viscoelastic(0.5, [1.0, 2.0, 3.0], [0.1, 1.0, 5.0]),
    "all": Viscoelastic(0.5, (1.0,), (0.3,), 0.2),
}
# Midpoint sums of 1000 springs, and the rim within a spring: measured 5e-5 where the contact is a tenth of its last
# radius, 1e-6 at the end.
SPRINGS = 1e-4


def phi_slope(d):
    """Slope of (4/3) sqrt(R) d^1.5."""
    return 2 * math.sqrt(R * d)


def ramp_force(material, speed, t):
    """Lee & Radok's force under d = speed t, by adaptive quadrature."""
    inner, _ = quad(
        lambda u: 2 * u * float(material.relaxation(t - u**2)) * phi_slope(speed * u**2) * speed,
        0,
        math.sqrt(t),
        epsrel=1e-11,
    )
    return inner + material.dashpot * phi_slope(speed * t) * speed


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
class TestGrowth:
    t = np.linspace(0, 2, 41)

    def test_a_ramp_of_the_depth(self, material):
        history = depth_history(BODY, material, self.t, 0.1 * self.t)
        truth = [ramp_force(material, 0.1, t) for t in self.t[4:]]
        np.testing.assert_allclose(history.force[4:], truth, rtol=SPRINGS)
        np.testing.assert_allclose(history.contact_radius[1:], np.sqrt(R * 0.1 * self.t[1:]), rtol=1e-4)

    def test_steps_in_between_change_nothing(self, material):
        coarse = depth_history(BODY, material, [0.0, 2.0], [0.0, 0.2], springs=200)
        fine = depth_history(BODY, material, self.t, 0.1 * self.t, springs=200)
        assert coarse.force[-1] == pytest.approx(fine.force[-1], rel=1e-11)

    def test_a_ramp_of_the_force(self, material):
        curve = indentation_curve(BODY, 1.0, forces=np.geomspace(1e-6, 10, 40))
        errors = []
        for count in (11, 21):
            t = np.linspace(0, 2, count)
            history = force_history(BODY, material, t, 0.1 * t, springs=300)
            exact = transfer(curve, material, t, forces=0.1 * t)
            errors.append(abs(history.depth[-1] / exact.depth[-1] - 1))
        # Second order in the step, a little less by the first touch, where d ~ t^(2/3); a fluid does not forget it.
        assert errors[0] < 4e-3
        assert errors[1] < 0.37 * errors[0]


class TestSuddenForce:
    def test_creep_at_a_given_force(self):
        """a^3 = (3R/4) F J(t) on a standard solid."""
        errors = []
        for count in (31, 61):
            t = np.linspace(0, 3, count)
            history = force_history(BODY, SOLID, t, np.full(count, 0.05), springs=300)
            a = (0.75 * R * 0.05 * SOLID.creep()(t)) ** (1 / 3)
            assert history.depth[0] == pytest.approx(a[0] ** 2 / R, rel=1e-5)
            errors.append(np.abs(history.depth * R / a**2 - 1).max())
        np.testing.assert_allclose(history.contact_radius, a, rtol=1e-3)
        # Steps of 0.1 s against retardation in 1.2 s: (1/12)^2/12, and second order.
        assert errors[0] < 6e-4
        assert errors[1] < 0.3 * errors[0]

    def test_a_dashpot_moves_only_with_time(self):
        t = np.linspace(0, 1, 100) ** 3
        history = force_history(BODY, viscous(0.2), t, np.full(100, 0.05), springs=300)
        assert history.depth[0] <= 1e-9
        a = (0.75 * R * 0.05 * t[-1] / 0.8) ** (1 / 3)
        assert history.depth[-1] == pytest.approx(a**2 / R, rel=1e-3)


class TestSuddenDepth:
    def test_relaxation(self):
        """F = E(t) Phi(d)."""
        t = np.array([0.0, 0.1, 1.0, 5.0])
        history = depth_history(BODY, SOLID, t, np.full(4, 0.1))
        phi = indent(BODY, 1.0, depth=0.1).force
        np.testing.assert_allclose(history.force, SOLID.relaxation(t) * phi, rtol=1e-5)

    def test_an_elastic_material_forgets_all(self):
        elastic = Viscoelastic(2.0)
        d = np.array([0.1, 0.2, -0.1, 0.05, 0.15])
        history = depth_history(BODY, elastic, np.array([0.0, 1.0, 2.0, 2.0, 3.0]), d)
        truth = indented(BODY, 2.0, "depth", np.maximum(d, 0)).force
        # With 1000 springs up to d = 0.2, some 500 to d = 0.05.
        np.testing.assert_allclose(history.force, truth, rtol=1e-5)

    def test_a_jump_back_leaves_the_surface_at_once(self):
        """On a standard solid at rest a small retreat is elastic with the instantaneous modulus."""
        deep, less = 0.1, 0.1 - 1e-4
        history = depth_history(BODY, SOLID, [0.0, 60.0, 60.0], [deep, deep, less])
        slope = (history.force[1] - history.force[2]) / 1e-4
        assert slope == pytest.approx(2 * 3.0 * math.sqrt(R * deep), rel=1e-2)

    def test_into_a_dashpot_it_is_refused(self):
        with pytest.raises(ValueError, match="no jump"):
            depth_history(BODY, kelvin_voigt(1.0, 1.0), [0.0, 1.0], [0.1, 0.1])

    def test_a_dashpot_holds_what_jumps_away(self):
        history = depth_history(BODY, kelvin_voigt(1.0, 1.0), [0.0, 1.0, 1.0, 1.1], [0.0, 0.1, -0.1, -0.1])
        assert history.force[2:].tolist() == [0, 0]


def ting(material, t, speed, peak):
    """Ting's force and radius on the way back of a triangular depth d = speed t up to the time `peak`."""

    def kept(t1):
        inner = quad(lambda s: float(material.relaxation(t - s)), t1, peak, epsrel=1e-12)[0]
        return inner - quad(lambda s: float(material.relaxation(t - s)), peak, t, epsrel=1e-12)[0]

    if kept(0.0) < 0:
        return 0.0, 0.0
    t1 = brentq(kept, 0, peak, xtol=1e-14)
    force = quad(
        lambda u: 2 * u * float(material.relaxation(t - u**2)) * phi_slope(speed * u**2) * speed,
        0,
        math.sqrt(t1),
        epsrel=1e-11,
    )[0]
    return force, math.sqrt(R * speed * t1)


class TestRebound:
    times = np.linspace(0, 2, 101)

    @pytest.mark.parametrize("name", ["Maxwell", "standard solid", "Prony"])
    def test_ting(self, name):
        material = MATERIALS[name]
        depth = np.where(self.times < 1, 0.1 * self.times, 0.1 * (2 - self.times))
        history = depth_history(BODY, material, self.times, depth)
        for index in (52, 55, 60, 65, 90):
            force, radius = ting(material, float(self.times[index]), 0.1, 1.0)
            assert history.force[index] == pytest.approx(force, abs=2e-6 * history.force.max())
            # Receding, the rim is drawn on from springs that have let go: to a spring's width.
            assert history.contact_radius[index] == pytest.approx(
                radius, abs=1e-3 * history.contact_radius.max()
            )

    def test_a_fluid_lets_go_at_once(self):
        depth = np.where(self.times < 1, 0.1 * self.times, 0.1 * (2 - self.times))
        history = depth_history(BODY, viscous(0.2), self.times, depth)
        assert (history.force[self.times > 1] == 0).all()

    def test_kelvin_voigt_lets_go_where_the_surface_is_slower(self):
        """u = -tau u' while free: the rim on the way back is where g = d + tau d'."""
        tau, speed = 0.5, 0.1
        depth = np.where(self.times < 1, speed * self.times, speed * (2 - self.times))
        history = depth_history(BODY, kelvin_voigt(3.0, tau), self.times, depth)
        late = self.times > 1
        a2 = R * (depth[late] - tau * speed)
        truth = 2 * 3.0 * (np.maximum(a2, 0) ** 1.5) * (1 - 1 / 3) / R
        np.testing.assert_allclose(history.force[late], truth, atol=2e-6 * history.force.max())

    @pytest.mark.parametrize("name", MATERIALS)
    def test_steps_in_between_change_nothing(self, name):
        """Press, lift and press again: release, creep and touch are exact within a step."""
        t, depth = np.array([0.0, 1.0, 1.6, 2.6]), np.array([0.0, 0.1, -0.02, 0.12])
        fine = np.linspace(0, 2.6, 53)
        few = depth_history(BODY, MATERIALS[name], t, depth, springs=200)
        many = depth_history(BODY, MATERIALS[name], fine, np.interp(fine, t, depth), springs=200)
        assert many.force[-1] == pytest.approx(few.force[-1], rel=1e-10)
        assert few.force[-1] > 0

    def test_what_was_pressed_comes_back(self):
        """Soon after a first stroke a second one meets a dent; long after, the surface has recovered."""
        first = depth_history(BODY, SOLID, [0.0, 1.0], [0.0, 0.1]).force[-1]
        depth = [0.0, 0.1, -0.1, -0.1, 0.0, 0.1]
        soon = depth_history(BODY, SOLID, [0.0, 1.0, 1.0, 1.2, 1.2, 2.2], depth).force[-1]
        late = depth_history(BODY, SOLID, [0.0, 1.0, 1.0, 61.0, 61.0, 62.0], depth).force[-1]
        assert soon < 0.98 * first
        assert late == pytest.approx(first, rel=1e-9)


class TestForceAndDepth:
    @pytest.mark.parametrize("name", ["Maxwell", "standard solid", "Prony"])
    def test_they_are_inverse(self, name):
        t = np.linspace(0, 2, 41)
        depth = 0.1 * np.sin(np.pi * t / 2) ** 1.5
        by_depth = depth_history(BODY, MATERIALS[name], t, depth, springs=200)
        loaded = by_depth.force > 0
        last = int(np.nonzero(~loaded[1:])[0][0]) if not loaded[1:].all() else len(t) - 1
        by_force = force_history(BODY, MATERIALS[name], t[:last], by_depth.force[:last], springs=200)
        np.testing.assert_allclose(by_force.depth[2:], by_depth.depth[2:last], rtol=2e-4)

    def test_the_released_body_lies_on_what_is_left(self):
        t = np.concatenate([[0.0, 0.5, 1.0, 1.0], np.linspace(1, 30, 60)[1:]])
        history = force_history(BODY, SOLID, t, np.where(np.arange(63) < 3, 0.1, 0.0), springs=300)
        assert history.depth[2] > history.depth[1] > 0
        assert (np.diff(history.depth[2:]) < 0).all()
        assert (history.contact_radius[4:] == 0).all()
        # The dent is gone after thirty seconds; the first spring stands half a width off the axis.
        assert history.depth[-1] == pytest.approx(0, abs=1e-6)


class TestRefusals:
    @pytest.mark.parametrize(
        ("run", "loads", "message"),
        [
            (depth_history, [0.0, -1.0], "never touches"),
            (depth_history, [0.0], "one time for each load"),
            (depth_history, [0.0, math.nan], "finite"),
            (force_history, [0.0, -1.0], "not be negative"),
            (force_history, [0.0, 0.0], "positive"),
        ],
    )
    def test_loads(self, run, loads, message):
        with pytest.raises(ValueError, match=message):
            run(BODY, SOLID, [0.0, 1.0], loads)

    def test_times_and_bodies(self):
        with pytest.raises(ValueError, match="times must not decrease"):
            depth_history(BODY, SOLID, [1.0, 0.0], [0.0, 0.1])
        with pytest.raises(ValueError, match="springs must be a whole number"):
            depth_history(BODY, SOLID, [0.0, 1.0], [0.0, 0.1], springs=0)
        with pytest.raises(ValueError, match=r"whole number.*not 2.5"):
            force_history(BODY, SOLID, [0.0, 1.0], [0.0, 0.1], springs=2.5)
        with pytest.raises(ValueError, match="viscoelastic material is needed"):
            force_history(BODY, 1e9, [0.0, 1.0], [0.0, 0.1])
        with pytest.raises(ValueError, match="body of revolution is needed"):
            depth_history(1.0, SOLID, [0.0, 1.0], [0.0, 0.1])
        rippled = BODY + indenter.ripples(5e-3, 0.1, 0.5)
        with pytest.raises(ValueError, match="one disc"):
            depth_history(rippled, SOLID, [0.0, 1.0], [0.0, 0.1])

    def test_they_count(self):
        assert len(depth_history(BODY, SOLID, [0.0, 1.0], [0.0, 0.1])) == 2
