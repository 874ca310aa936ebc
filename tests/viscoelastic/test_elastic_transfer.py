"""Transfer of elastic curves to viscous and viscoelastic materials."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent, indentation_curve
from roughcontact.mdr.viscoelasticity.viscoelastic_history import depth_history
from roughcontact.viscoelastic.elastic_transfer import transfer
from roughcontact.viscoelastic.fitted import power_law
from roughcontact.viscoelastic.models import kelvin_voigt, maxwell, standard_solid, viscous
from roughcontact.viscoelastic.prony_series import Viscoelastic

R, E = 0.5, 3.0
BODY = indenter.paraboloid(R)
CURVE = indentation_curve(BODY, E, forces=np.geomspace(1e-8, 1e3, 40))
MATERIALS = {
    "viscous": viscous(0.2),
    "Kelvin-Voigt": kelvin_voigt(3.0, 0.5),
    "Maxwell": maxwell(2.0, 0.7),
    "standard solid": standard_solid(1.0, 3.0, 0.4),
    "Prony": Viscoelastic(0.5, [1.0, 2.0, 3.0], [0.1, 1.0, 5.0]),
}
T = np.array([0.0, 0.01, 0.3, 1.0, 4.0])


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
class TestSphere:
    def test_a_sudden_force(self, material):
        """a^3 = (3R/4) F J(t) (theory, section 7); the curve of a power law is met between its points."""
        history = transfer(CURVE, material, T, forces=0.05)
        a = (0.75 * R * 0.05 * material.creep()(T)) ** (1 / 3)
        np.testing.assert_allclose(history.depth, a**2 / R, rtol=1e-12)
        np.testing.assert_allclose(history.contact_area, math.pi * a**2, rtol=1e-12)

    def test_a_ramp_of_the_force(self, material):
        """Phi = integral of J, by adaptive quadrature."""
        creep = material.creep()
        history = transfer(CURVE, material, T, forces=0.1 * T)
        phi = [0.1 * quad(lambda s: float(creep(s)), 0, t, epsabs=0, epsrel=1e-12)[0] for t in T[1:]]
        np.testing.assert_allclose(history.elastic_force[1:], E * np.array(phi), rtol=1e-11)
        assert history.depth[0] == 0

    def test_times_in_between_change_nothing(self, material):
        few = transfer(CURVE, material, [0.0, 1.0], forces=[0.0, 0.1])
        many = transfer(CURVE, material, np.linspace(0, 1, 33), forces=np.linspace(0, 0.1, 33))
        assert many.depth[-1] == pytest.approx(few.depth[-1], rel=1e-12)

    def test_depth_and_force_are_inverse(self, material):
        """Second order in the step; where a ramp begins Phi ~ t^1.5 is not smooth, so the end is compared."""
        errors = []
        for count in (51, 101):
            t = np.linspace(0, 1, count)
            there = transfer(CURVE, material, t, depths=0.1 * t**2)
            back = transfer(CURVE, material, t, forces=there.force)
            errors.append(abs(back.depth[-1] / (0.1) - 1))
        assert errors[0] < 2e-3
        assert errors[1] < 0.35 * errors[0] + 1e-12

    def test_the_moduli_of_the_curve_do_not_matter(self, material):
        other = indentation_curve(BODY, 7.0, forces=CURVE.force)
        one, two = (transfer(c, material, T, forces=0.05 * (T + 1)) for c in (CURVE, other))
        np.testing.assert_allclose(two.depth, one.depth, rtol=1e-12)


class TestDepthControl:
    def test_relaxation(self):
        """F = E(t) Phi(d) after a sudden depth."""
        solid = MATERIALS["standard solid"]
        history = transfer(CURVE, solid, T, depths=0.1)
        phi = indent(BODY, 1.0, depth=0.1).force
        np.testing.assert_allclose(history.force, solid.relaxation(T) * phi, rtol=1e-11)

    def test_a_viscous_body_resists_speed(self):
        """F = 4 eta dPhi/dt = 4 eta 2 a d'."""
        t = np.linspace(0, 2, 2001)
        history = transfer(CURVE, viscous(0.2), t, depths=0.1 * t)
        truth = 0.8 * 2 * np.sqrt(R * 0.1 * t) * 0.1
        # Second differences: the third derivative of t^1.5 times the square of the step over 6, 4e-7 at t = 0.5.
        np.testing.assert_allclose(history.force[500:], truth[500:], rtol=1e-6)

    def test_a_dashpot_admits_no_jump(self):
        with pytest.raises(ValueError, match="no jump"):
            transfer(CURVE, kelvin_voigt(1.0, 1.0), T, depths=0.1)


class TestRoughSurface:
    """The thesis, chapter 4: what is computed for an elastic rough contact serves a viscous one."""

    grid = rc.Grid((32, 32), (1 / 32, 1 / 32))
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(3))
    curve = rc.loading_curve(surface, 1.0, forces=np.geomspace(1e-5, 3e-2, 40))

    def test_a_constant_force_creeps_along_the_elastic_curve(self):
        """d(t) = d_el(E* F0 J(t)), solved once more at these loads."""
        solid, F0 = standard_solid(1.0, 3.0, 0.4), 5e-3
        t = np.array([0.0, 0.2, 1.0, 10.0])
        history = transfer(self.curve, solid, t, forces=F0)
        truth = [rc.press(self.surface, 1.0, force=F0 * float(J)).depth for J in solid.creep()(t)]
        # Interpolation between forty points of a curve whose slope jumps.
        np.testing.assert_allclose(history.depth, truth, rtol=2e-3)

    def test_it_needs_the_curve_where_it_goes(self):
        with pytest.raises(ValueError, match="compute the curve for more loads"):
            transfer(self.curve, viscous(1.0), [0.0, 1.0, 1000.0], forces=1.0)


class Hertz:
    """A sphere of R = 1 as a dense elastic curve."""

    modulus = 1.0

    def __init__(self, points=500, lowest=1e-7):
        self.depth = np.geomspace(lowest, 0.2, points)
        self.force = 4 / 3 * self.depth**1.5
        self.contact_area = math.pi * self.depth


class TestRiseAndFall:
    """Digits of independent quadratures: R = 1, E_inf = 1, E_0 = 3, tau = 1; small steps keep 1e-7."""

    solid = standard_solid(1.0, 3.0, 1.0)

    def test_depth_up_and_down(self):
        t = [0.5, 1.0, 1.2, 1.4, 1.6]
        found = transfer(Hertz(), self.solid, [0.0, *t], depths=[0.0, 0.005, 0.01, 0.008, 0.006, 0.004])
        wanted = [0.5, 1.0, 0.771696184013, 0.482359372269, 0.133693824277]
        np.testing.assert_allclose(found.growth_time[1:], wanted, rtol=0, atol=2e-12)
        radius = [0.070710678119, 0.1, 0.087846239761, 0.069452096604, 0.036564166103]
        np.testing.assert_allclose(np.sqrt(found.contact_area[1:] / math.pi), radius, rtol=5e-8)
        force = [
            1.249848592650e-3,
            3.181015305682e-3,
            1.786363157339e-3,
            7.432398878284e-4,
            9.371300393370e-5,
        ]
        np.testing.assert_allclose(found.force[1:], force, rtol=1e-7)

    def test_contact_is_lost_before_the_depth_is_zero(self):
        lost = 1.670127397036
        t = [0.0, 1.0, lost - 1e-4, lost + 1e-6, 2.0]
        found = transfer(
            Hertz(lowest=1e-12), self.solid, t, depths=[0.0, 0.01, *(0.01 * (2 - s) for s in t[2:])]
        )
        assert found.depth[3] == pytest.approx(0.003298726030, abs=2e-8)
        assert found.force[2] > 0
        assert (found.force[3:] == 0).all()
        assert (found.contact_area[3:] == 0).all()

    def test_force_up_and_down(self):
        t = [1.0, 1.25, 1.5, 1.75]
        found = transfer(Hertz(), self.solid, [0.0, *t], forces=[0.0, 0.1, 0.075, 0.05, 0.025])
        np.testing.assert_allclose(
            found.growth_time[2:], [0.902521984908, 0.732138148548, 0.454034542457], rtol=2e-8
        )
        radius = [0.319058746419, 0.306234376258, 0.282009751525, 0.235044661520]
        np.testing.assert_allclose(np.sqrt(found.contact_area[1:] / math.pi), radius, rtol=1e-10)
        depth = [0.319058746419**2, 0.0946466787, 0.0842749644, 0.0696751423]
        np.testing.assert_allclose(found.depth[1:], depth, rtol=3e-7)

    def test_loads_that_are_held(self):
        found = transfer(Hertz(), self.solid, [0.0, 1.0, 3.0, 10.0], forces=0.1)
        depth = [0.085498797334, 0.115343847208, 0.147426352575, 0.175013622171]
        np.testing.assert_allclose(found.depth, depth, rtol=1e-11)
        held = transfer(Hertz(), self.solid, [0.0, 1.0], depths=0.01)
        assert held.force[1] == pytest.approx(2.314345176457e-3, rel=1e-12)

    def test_a_term_without_weight_changes_nothing(self):
        more = Viscoelastic(1.0, [2.0, 0.0], [1.0, 30.0])
        given = {"times": [0.0, 1.0, 1.4], "depths": [0.0, 0.01, 0.006]}
        plain, other = (transfer(Hertz(), each, **given) for each in (self.solid, more))
        np.testing.assert_allclose(other.force, plain.force, rtol=1e-12)

    def test_a_punch(self):
        """A flat punch of radius 1: F = 2 E* d, and the area does not change."""
        punch = Hertz()
        punch.force, punch.contact_area = 2 * punch.depth, np.full(500, math.pi)
        found = transfer(punch, self.solid, [0.0, 1.0], forces=[0.2, 0.2])
        assert found.depth[1] == pytest.approx(0.2 * 0.261156229809, rel=1e-11)
        assert found.contact_area[1] == pytest.approx(math.pi)

    @pytest.mark.parametrize("material", [Viscoelastic(0.5, [1.0, 2.0], [0.1, 1.0]), kelvin_voigt(1.0, 0.3)])
    def test_springs_agree(self, material):
        """A second program: 1000 springs under the transformed body, second order in their width."""
        t = np.array([0.0, 0.5, 1.0, 1.3, 1.5])
        d = np.array([0.0, 0.01, 0.02, 0.014, 0.01])
        found = transfer(Hertz(), material, t, depths=d)
        springs = depth_history(indenter.paraboloid(1.0), material, t, d, springs=1000)
        inside = [1, 2, 3, 4] if not material.dashpot else [3, 4]  # at a kink a dashpot has two forces
        np.testing.assert_allclose(found.force[inside], springs.force[inside], rtol=1e-4)

    def test_the_body_stays_after_a_sudden_depth(self):
        """A jump, a hold and a fall: the contact is that of d_0 + int E dd/E(t), here at one time in closed form."""
        t = np.array([0.0, 1.0, 1.5])
        found = transfer(Hertz(), self.solid, t, depths=[0.01, 0.01, 0.008])
        pull = 0.004 * (0.5 + 2 * (1 - math.exp(-0.5)))  # the integral of E over the fall, at its rate
        size = 0.01 - pull / float(self.solid.relaxation(1.5))
        assert found.contact_area[2] == pytest.approx(math.pi * size, rel=1e-8)
        assert found.force[2] == pytest.approx(
            4 / 3 * size**1.5 * float(self.solid.relaxation(1.5)), rel=1e-8
        )
        assert found.growth_time[2] == 0

    def test_the_interpolation_error_is_stated(self):
        """Of points on a curve that is no power law; the true error is below the stated one."""
        curve, few = Hertz(2001, 1e-5), Hertz(21, 1e-5)
        for each in (curve, few):
            each.force = each.force * (1 + 0.3 * np.sin(3 * np.log(each.depth)))
        arguments = {"times": [0.0, 1.0, 1.4], "depths": [0.0, 0.1, 0.06]}
        true, found = (transfer(each, self.solid, **arguments) for each in (curve, few))
        off = float(np.abs(found.force - true.force).max() / true.force.max())
        assert 1e-4 < off < found.interpolation_error < 0.2
        assert true.interpolation_error < 1e-4

    def test_a_rough_surface_recedes_along_its_elastic_curve(self):
        """The contact at t is the elastic one at the depth at which the contact had this size."""
        curve = TestRoughSurface.curve
        top = float(curve.depth[-2])
        found = transfer(curve, self.solid, [0.0, 1.0, 1.3], depths=[0.0, top, 0.8 * top])
        depth = top * found.growth_time[2]
        pressed = rc.press(TestRoughSurface.surface, 1.0, depth=depth)
        assert found.contact_area[2] == pytest.approx(pressed.contact_area, rel=0.02)  # few cells
        assert found.elastic_force[2] == pytest.approx(pressed.force, rel=2e-3)
        assert found.interpolation_error < 0.05

    def test_a_history_longer_than_the_data(self):
        gel = power_law(1.0, 1.0, 0.3, band=(1e-2, 10.0))
        transfer(Hertz(), gel, [0.0, 1.0, 1.5], depths=[0.0, 0.01, 0.008])
        with pytest.raises(ValueError, match=r"lasts 11 s.*end at 10 s"):
            transfer(Hertz(), gel, [0.0, 1.0, 11.0], depths=[0.0, 0.01, 0.01])

    def test_loads_below_the_curve_are_refused(self):
        with pytest.raises(
            ValueError, match=r"curve begins at a force of .*compute the curve for more loads"
        ):
            transfer(Hertz(lowest=1e-3), self.solid, [0.0, 0.05, 1.0], depths=[0.0, 0.0005, 0.01])


class TestRefusals:
    solid = MATERIALS["standard solid"]

    def test_a_shrinking_contact(self):
        with pytest.raises(ValueError, match=r"load rises from t = 2 s on.*one rise and then one fall"):
            transfer(CURVE, self.solid, [0.0, 1.0, 2.0, 3.0], forces=[0.0, 0.1, 0.05, 0.06])
        with pytest.raises(ValueError, match=r"the contact grows again at t = .*after it has receded"):
            transfer(CURVE, self.solid, [0.0, 1.0, 1.5, 3.0], depths=[0.0, 0.1, 0.05, 0.05])
        with pytest.raises(ValueError, match=r"the contact grows again at t = .*after it has receded"):
            transfer(CURVE, self.solid, [0.0, 1.0, 1.5, 3.0], forces=[0.0, 0.1, 0.05, 0.05])

    def test_a_force_may_fall_while_the_contact_still_grows(self):
        history = transfer(CURVE, maxwell(1.0, 1.0), [0.0, 1.0, 2.0], forces=[0.1, 0.1, 0.09])
        assert (np.diff(history.depth) > 0).all()
        assert len(history) == 3

    def test_nonsense(self):
        with pytest.raises(ValueError, match="exactly one"):
            transfer(CURVE, self.solid, T)
        with pytest.raises(ValueError, match="one time for each load"):
            transfer(CURVE, self.solid, T, forces=[0.1])
        with pytest.raises(ValueError, match="times must not decrease"):
            transfer(CURVE, self.solid, [1.0, 0.0], forces=0.1)
        with pytest.raises(ValueError, match="not be negative"):
            transfer(CURVE, self.solid, T, forces=-0.1)
        with pytest.raises(ValueError, match="times must be finite, not nan"):
            transfer(CURVE, self.solid, [0.0, math.nan], forces=0.1)
        with pytest.raises(ValueError, match="a viscoelastic material is needed"):
            transfer(CURVE, 1e9, T, forces=0.1)
        with pytest.raises(ValueError, match="not 5 without force, depth"):
            transfer(5, self.solid, T, forces=0.1)
        flat = indentation_curve(BODY, E, forces=[1.0])
        with pytest.raises(ValueError, match="at least three points"):
            transfer(flat, self.solid, T, forces=0.1)
