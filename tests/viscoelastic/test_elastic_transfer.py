"""Transfer of elastic curves to viscous and viscoelastic materials."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent, indentation_curve
from roughcontact.viscoelastic.elastic_transfer import transfer
from roughcontact.viscoelastic.models import kelvin_voigt, maxwell, prony, standard_solid, viscous

R, E = 0.5, 3.0
BODY = indenter.paraboloid(R)
CURVE = indentation_curve(BODY, E, forces=np.geomspace(1e-8, 1e3, 40))
MATERIALS = {
    "viscous": viscous(0.2),
    "Kelvin-Voigt": kelvin_voigt(3.0, 0.5),
    "Maxwell": maxwell(2.0, 0.7),
    "standard solid": standard_solid(1.0, 3.0, 0.4),
    "Prony": prony(0.5, [1.0, 2.0, 3.0], [0.1, 1.0, 5.0]),
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
        t = np.linspace(0, 2, 4001)
        history = transfer(CURVE, viscous(0.2), t, depths=0.1 * t)
        truth = 0.8 * 2 * np.sqrt(R * 0.1 * t) * 0.1
        # Second differences: the third derivative of t^1.5 times the square of the step over 6, 1e-7 at t = 0.5.
        np.testing.assert_allclose(history.force[1000:], truth[1000:], rtol=1e-6)

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
