"""Partial slip: Cattaneo and Mindlin, the superposition for any body, and springs that slip one by one."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent
from roughcontact.mdr.tangential_loading.slip_history import slip_history
from roughcontact.mdr.tangential_loading.tangential import partial_slip

R, E, G, MU, F = 0.5, 3.0, 2.2, 0.3, 0.4
BODY = indenter.paraboloid(R)
HERTZ = indent(BODY, E, force=F)
SHARES = [0.1, 0.5, 0.9]


@pytest.mark.parametrize("share", SHARES)
class TestMindlin:
    def test_radius_displacement_and_stiffness(self, share):
        slip = partial_slip(HERTZ, G, MU, force=share * MU * F)
        a, rest = HERTZ.contact_radius, 1 - share
        assert slip.stick_radius == pytest.approx(a * rest ** (1 / 3), rel=1e-12)
        assert slip.displacement == pytest.approx(MU * E / G * HERTZ.depth * (1 - rest ** (2 / 3)), rel=1e-12)
        # The same in the words of the force: 3 mu F/(4 a G*).
        assert slip.displacement == pytest.approx(3 * MU * F / (4 * a * G) * (1 - rest ** (2 / 3)), rel=1e-12)
        assert slip.stiffness == pytest.approx(2 * G * slip.stick_radius, rel=1e-14)

    def test_the_traction(self, share):
        slip = partial_slip(HERTZ, G, MU, force=share * MU * F)
        a, c = HERTZ.contact_radius, slip.stick_radius
        p0 = 2 * a * E / (math.pi * R)
        r = a * np.linspace(0, 0.999, 30)
        inner = np.sqrt(np.maximum(1 - (r / c) ** 2, 0))
        truth = MU * p0 * (np.sqrt(1 - (r / a) ** 2) - c / a * inner)
        np.testing.assert_allclose(slip.traction(r), truth, atol=1e-13)

    def test_the_loss_of_a_cycle(self, share):
        slip = partial_slip(HERTZ, G, MU, force=share * MU * F)
        rest = 1 - share
        bracket = 1 - rest ** (5 / 3) - 5 * share / 6 * (1 + rest ** (2 / 3))
        truth = 18 / 5 * (MU * F) ** 2 / (HERTZ.contact_radius * G) * bracket
        assert slip.loss_per_cycle == pytest.approx(truth, rel=1e-10)

    def test_force_and_displacement_agree(self, share):
        by_force = partial_slip(HERTZ, G, MU, force=share * MU * F)
        by_displacement = partial_slip(HERTZ, G, MU, displacement=by_force.displacement)
        assert by_displacement.force == pytest.approx(by_force.force, rel=1e-12)


def test_a_small_force_loses_the_cube():
    f = 1e-2
    truth = f**3 / 9 * (MU * F) ** 2 / (HERTZ.contact_radius * G)
    # Next term of the expansion: 5/6 f... one per cent of it.
    assert partial_slip(HERTZ, G, MU, force=f * MU * F).loss_per_cycle == pytest.approx(truth, rel=0.01)


BODIES = [
    indenter.cone(0.3),
    indenter.sphere(0.8),
    indenter.paraboloid(R, flat=0.2),
    indenter.paraboloid(R) + indenter.equivalent_roughness(0.6, rms=3e-3, length=1.0),
    indenter.flat_punch(0.3),
]


@pytest.mark.parametrize("body", BODIES, ids=repr)
class TestAnyBody:
    def test_the_traction_carries_the_force(self, body):
        contact = indent(body, E, force=F)
        slip = partial_slip(contact, G, MU, force=0.6 * MU * F)
        ends = sorted(
            {
                0.0,
                *(b for b in body.breaks if b < contact.contact_radius),
                slip.stick_radius,
                contact.contact_radius,
            }
        )
        nodes, weights = np.polynomial.legendre.leggauss(48)
        total, angle = 0.0, np.pi / 4 * (nodes + 1)
        for low, high in pairwise(ends):
            r = low + (high - low) * np.sin(angle) ** 2
            step = np.pi / 4 * weights * (high - low) * np.sin(2 * angle)
            total += float((step * 2 * np.pi * r * slip.traction(r)).sum())
        # This quadrature beside logarithms and the root at the rim of a face.
        assert total == pytest.approx(slip.force, rel=1e-5)

    def test_no_point_exceeds_friction(self, body):
        contact = indent(body, E, force=F)
        slip = partial_slip(contact, G, MU, force=0.6 * MU * F)
        r = contact.contact_radius * np.linspace(0.01, 0.99, 50)
        traction, limit = slip.traction(r), MU * contact.pressure(r)
        assert (traction <= limit * (1 + 1e-12)).all()
        slipping = r > slip.stick_radius
        np.testing.assert_allclose(traction[slipping], limit[slipping], rtol=1e-12)

    def test_the_loss_is_the_area_between_the_branches(self, body):
        """Loading curve D(Q) and its doubled copy: W = 4 Q D - 8 integral of D, by adaptive quadrature."""
        contact, Q = indent(body, E, force=F), 0.7 * MU * F
        area = quad(lambda q: partial_slip(contact, G, MU, force=q).displacement, 0, Q, epsrel=1e-11)[0]
        slip = partial_slip(contact, G, MU, force=Q)
        truth = 4 * Q * slip.displacement - 8 * area
        assert slip.loss_per_cycle == pytest.approx(truth, abs=1e-9 * Q * slip.displacement)

    def test_the_stiffness_is_the_slope(self, body):
        contact, Q, step = indent(body, E, force=F), 0.5 * MU * F, 1e-6 * F
        low, high = (partial_slip(contact, G, MU, force=Q + s) for s in (-step, step))
        slope = 2 * step / (high.displacement - low.displacement)
        assert partial_slip(contact, G, MU, force=Q).stiffness == pytest.approx(slope, rel=1e-6)


class TestFullSlip:
    def test_nothing_sticks(self):
        slip = partial_slip(HERTZ, G, MU, force=MU * F)
        assert slip.displacement == pytest.approx(MU * E / G * HERTZ.depth, rel=1e-9)
        assert slip.stick_radius < 1e-4 * HERTZ.contact_radius
        beyond = partial_slip(HERTZ, G, MU, displacement=1.0)
        assert (beyond.stick_radius, beyond.stiffness) == (0, 0)
        assert beyond.force == pytest.approx(MU * F, rel=1e-14)

    def test_a_punch_lets_go_all_at_once(self):
        """Both pressures have the punch's shape: until mu F all sticks."""
        contact = indent(indenter.flat_punch(0.3), E, force=F)
        slip = partial_slip(contact, G, MU, force=0.999 * MU * F)
        assert slip.stick_radius == 0.3
        assert slip.loss_per_cycle == pytest.approx(0, abs=1e-15)
        assert slip.displacement == pytest.approx(0.999 * MU * F / (2 * G * 0.3), rel=1e-12)


class TestRefusals:
    @pytest.mark.parametrize(
        ("arguments", "message"),
        [
            ({}, "exactly one"),
            ({"force": 0.1, "displacement": 0.1}, "exactly one"),
            ({"force": -0.1}, "not negative"),
            ({"force": 1.01 * MU * F}, "slides away"),
        ],
    )
    def test_loads(self, arguments, message):
        with pytest.raises(ValueError, match=message):
            partial_slip(HERTZ, G, MU, **arguments)

    def test_materials(self):
        with pytest.raises(ValueError, match="friction"):
            partial_slip(HERTZ, G, 0.0, force=0.0)
        with pytest.raises(ValueError, match="shear_modulus"):
            partial_slip(HERTZ, -1.0, MU, force=0.0)

    def test_it_says_what_it_is(self):
        assert "stick radius" in repr(partial_slip(HERTZ, G, MU, force=0.05))


class TestSprings:
    @pytest.mark.parametrize("share", [0.5, 0.9])
    @pytest.mark.parametrize("body", BODIES, ids=repr)
    def test_loading_and_a_cycle(self, share, body):
        """At constant normal force the springs are the superposition; the error is that of the midpoint rule."""
        contact, Q = indent(body, E, force=F), share * MU * F
        slip = partial_slip(contact, G, MU, force=Q)
        history = slip_history(body, E, G, MU, normal_force=F, force=[0.0, Q, -Q, Q])
        # The rim of the disc that sticks, and that of a flat face, lie somewhere in a cell of 1/2000.
        np.testing.assert_allclose(
            history.displacement[1:], slip.displacement * np.array([1, -1, 1]), rtol=2e-6
        )
        loss = history.dissipated[3] - history.dissipated[1]
        assert loss == pytest.approx(slip.loss_per_cycle, abs=1e-5 * Q * slip.displacement)

    def test_masing(self):
        """Unloading from Q1: s = s1 - 2 D((Q1 - Q)/2)."""
        Q1, Q = 0.8 * MU * F, 0.1 * MU * F
        history = slip_history(BODY, E, G, MU, normal_force=F, force=[Q1, Q])
        down = partial_slip(HERTZ, G, MU, force=(Q1 - Q) / 2).displacement
        assert history.displacement[1] == pytest.approx(history.displacement[0] - 2 * down, rel=1e-6)

    def test_memory(self):
        """A closed inner loop leaves no trace (return point memory)."""
        Q = MU * F
        one = slip_history(BODY, E, G, MU, normal_force=F, force=[0.6 * Q, 0.8 * Q])
        two = slip_history(BODY, E, G, MU, normal_force=F, force=[0.6 * Q, 0.1 * Q, 0.6 * Q, 0.8 * Q])
        assert two.displacement[-1] == pytest.approx(one.displacement[-1], rel=1e-12)

    def test_an_oblique_load_within_friction_never_slips(self):
        """Mindlin & Deresiewicz: normal and tangential displacement in one proportion, G* ds < mu E* dd."""
        depth = np.linspace(0, 0.3, 7)
        ratio = 0.9 * MU * E / G
        history = slip_history(BODY, E, G, MU, depth=depth, displacement=ratio * depth)
        assert history.dissipated[-1] == 0
        # Every spring has the same proportion, and so have the sums.
        np.testing.assert_allclose(history.force, 0.9 * MU * history.normal_force, rtol=1e-6)

    def test_steps_of_proportional_load_do_not_matter(self):
        few = slip_history(BODY, E, G, MU, depth=[0.1, 0.3], displacement=[0.0, 0.13])
        many = slip_history(
            BODY, E, G, MU, depth=np.linspace(0.1, 0.3, 40), displacement=np.linspace(0, 0.13, 40)
        )
        assert many.force[-1] == pytest.approx(few.force[-1], rel=1e-12)
        assert many.dissipated[-1] == pytest.approx(few.dissipated[-1], rel=1e-9)
        assert few.dissipated[-1] > 0

    def test_energy_is_conserved(self):
        """Work of the tangential force = stored + lost, along a path of lift, slide and return."""
        s = np.linspace(0, 1, 2001)
        depth, place = 0.2 + 0.15 * np.sin(9 * s), 0.1 * np.sin(14 * s)
        history = slip_history(BODY, E, G, MU, depth=depth, displacement=place, springs=400)
        work = np.trapezoid(history.force, place)
        # What is stored: at most half the force times the force over the stiffness. Return to Q = 0 by a last pull.
        end = slip_history(
            BODY,
            E,
            G,
            MU,
            depth=np.append(depth, -0.1),
            displacement=np.append(place, place[-1]),
            springs=400,
        )
        stored = end.dissipated[-1] - history.dissipated[-1]
        assert stored > 0
        # The trapezoid of 2000 steps: 1e-6 of the work.
        assert work == pytest.approx(history.dissipated[-1] + stored, rel=1e-4)

    def test_lifted_springs_forget(self):
        history = slip_history(
            BODY, E, G, MU, depth=[0.3, 0.3, -0.1, 0.3], displacement=[0.0, 0.03, 0.03, 0.03]
        )
        assert history.force[1] > 0
        assert history.force[2:].tolist() == [0, 0]
        assert history.normal_force[2] == 0
        assert len(history) == 4

    def test_refusals(self):
        with pytest.raises(ValueError, match="normal_force and depth"):
            slip_history(BODY, E, G, MU, force=0.1)
        with pytest.raises(ValueError, match="force and displacement"):
            slip_history(BODY, E, G, MU, depth=0.1)
        with pytest.raises(ValueError, match="slides away"):
            slip_history(BODY, E, G, MU, normal_force=F, force=[0.0, 1.1 * MU * F])
        with pytest.raises(ValueError, match="finite"):
            slip_history(BODY, E, G, MU, normal_force=F, force=[0.0, math.nan])
        with pytest.raises(ValueError, match="positive"):
            slip_history(BODY, E, G, 0.0, normal_force=F, force=[0.0])
        with pytest.raises(ValueError, match=r"one length, not of shapes \(2,\) and \(3,\)"):
            slip_history(BODY, E, G, MU, normal_force=[1.0, 2.0], force=[0.0, 0.1, 0.2])
        with pytest.raises(ValueError, match="springs must be a whole number"):
            slip_history(BODY, E, G, MU, normal_force=F, force=[0.0], springs=2.5)
        with pytest.raises(ValueError, match=r"body of revolution is needed.*not 0.01"):
            slip_history(0.01, E, G, MU, normal_force=F, force=[0.0])
        with pytest.raises(ValueError, match="pressed body is needed"):
            partial_slip(BODY, G, MU, force=0.1)
        with pytest.raises(ValueError, match="shear_modulus must be one number"):
            partial_slip(indent(BODY, E, force=F), "a", MU, force=0.1)
