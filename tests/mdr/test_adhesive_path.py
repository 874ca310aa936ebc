"""Approach and retreat of sticking bodies: stable branches, snaps, and the energy they cost."""

import math

import numpy as np
import pytest

from roughcontact.mdr.adhesive_bodies.adhesion import jkr
from roughcontact.mdr.adhesive_bodies.adhesive_path import adhesive_path
from roughcontact.mdr.bodies import indenter

R, E, W = 0.5, 3.0, 0.2
PULL = 1.5 * math.pi * W * R
SPHERE = jkr(indenter.paraboloid(R), E, W)


def cycle(low, high, count):
    return np.concatenate([np.linspace(low, high, count), np.linspace(high, low, count)])


class TestSphere:
    def test_a_given_force_stays_on_the_stable_branch(self):
        path = adhesive_path(SPHERE, forces=[0.0, 1.0, 0.0, -0.5 * PULL, -0.999999 * PULL])
        F = path.force
        truth = (3 * R / (4 * E) * (F + 2 * PULL + np.sqrt(4 * PULL * F + 4 * PULL**2))) ** (1 / 3)
        np.testing.assert_allclose(path.contact_radius, truth, rtol=1e-12)
        np.testing.assert_allclose(path.depth, SPHERE.depth(path.contact_radius), rtol=1e-12)

    def test_it_tears_beyond_the_pull_off_force(self):
        path = adhesive_path(SPHERE, forces=[0.0, -0.999999 * PULL, -1.000001 * PULL])
        assert path.contact_radius[1] > 0
        assert (path.contact_radius[2], path.force[2]) == (0, 0)
        assert math.isnan(path.depth[2])
        assert path.dissipated[2] == math.inf

    def test_it_tells_where_it_let_go(self):
        path = adhesive_path(SPHERE, forces=[1.0, -0.5 * PULL, -2 * PULL, -3 * PULL, 1.0])
        assert path.detached.tolist() == [False, False, True, True, False]
        assert path.force[2:4].tolist() == [0, 0]
        # Before first touch it has not let go.
        assert not adhesive_path(SPHERE, depths=[-1.0, -0.5]).detached.any()

    def test_it_sticks_at_first_touch_and_holds_on_below(self):
        lowest = SPHERE.pull_off(math.inf).depth
        path = adhesive_path(
            SPHERE, depths=[-1e-9, 0.0, -1e-9, 0.999999 * lowest, 1.000001 * lowest, 0.5 * lowest]
        )
        assert (path.contact_radius > 0).tolist() == [False, True, True, True, False, False]
        assert path.force[0] == 0
        # At depth zero a^(3/2) = R sqrt(2 pi w/E*).
        assert path.contact_radius[1] == pytest.approx((R**2 * 2 * math.pi * W / E) ** (1 / 3), rel=1e-12)
        assert path.depth[5] == 0.5 * lowest

    def test_the_loss_is_the_area_of_the_loop(self):
        depths = cycle(-0.4, 0.5, 20001)
        path = adhesive_path(SPHERE, depths=depths[::20])
        area = np.trapezoid(path.force, path.depth)
        # The trapezoid misses up to half a step at the two snaps: step times force.
        assert path.dissipated[-1] == pytest.approx(area, abs=1e-3 * PULL)
        # Closed form: energies at the snaps, with U = E* integral (d - g)^2 by hand.
        a, b = (2 * math.pi * R**2 * W / E) ** (1 / 3), SPHERE.pull_off(math.inf).contact_radius

        def energy(a, d):
            return E * (d**2 * a - 2 * d * a**3 / (3 * R) + a**5 / (5 * R**2)) - math.pi * W * a**2

        truth = -energy(a, 0.0) + energy(b, float(SPHERE.depth(b)))
        assert path.dissipated[-1] == pytest.approx(truth, rel=1e-10)

    def test_loops_above_the_snaps_cost_nothing(self):
        path = adhesive_path(SPHERE, depths=[0.3, 0.1, -0.1, 0.4, 0.0])
        assert np.ptp(path.dissipated) == 0

    def test_a_soft_machine_is_a_force_and_a_stiff_one_a_depth(self):
        soft = adhesive_path(SPHERE, depths=np.array([1e9, 2e9, -0.4e9]), machine_stiffness=1e-9)
        forces = adhesive_path(SPHERE, forces=[1.0, 2.0, -0.4])
        np.testing.assert_allclose(soft.contact_radius, forces.contact_radius, rtol=1e-8)
        stiff = adhesive_path(SPHERE, depths=[0.1, -0.1], machine_stiffness=1e12)
        depths = adhesive_path(SPHERE, depths=[0.1, -0.1])
        np.testing.assert_allclose(stiff.force, depths.force, rtol=1e-9)

    def test_the_machine_takes_its_share(self):
        k = 2.0
        path = adhesive_path(SPHERE, depths=np.array([0.3, 0.1]), machine_stiffness=k)
        np.testing.assert_allclose(path.depth + path.force / k, [0.3, 0.1], rtol=1e-13)


class TestPunch:
    punch = jkr(indenter.flat_punch(0.3), E, W)

    def test_it_holds_all_of_its_face_until_it_tears(self):
        tear = -math.sqrt(2 * math.pi * 0.3 * W / E)
        path = adhesive_path(self.punch, depths=[-0.1, 0.0, 0.1, 0.999 * tear, 1.001 * tear])
        assert path.contact_radius.tolist() == [0, 0.3, 0.3, 0.3, 0]
        np.testing.assert_allclose(path.force[1:4], 2 * E * 0.3 * path.depth[1:4], rtol=1e-14)
        # Gained at touch: w times the area. Lost at the tear: the elastic energy less that.
        face = math.pi * W * 0.09
        np.testing.assert_allclose(path.dissipated, [0, face, face, face, E * 0.3 * tear**2], rtol=1e-12)

    def test_under_a_force_it_bears_kendalls_load(self):
        load = -math.sqrt(8 * math.pi * E * W * 0.3**3)
        path = adhesive_path(self.punch, forces=[0.0, 0.9999 * load, 1.0001 * load])
        assert path.contact_radius.tolist() == [0.3, 0.3, 0.0]


class TestRipples:
    """Every wave is a snap (Guduru, 2007)."""

    body = indenter.paraboloid(R) + indenter.ripples(0.004, 0.1, 1.0)
    adhesion = jkr(body, E, 0.01)

    def test_the_loop_is_wider_than_that_of_the_smooth_body(self):
        depths = cycle(-0.1, 0.1, 400)
        rough = adhesive_path(self.adhesion, depths=depths)
        smooth = adhesive_path(jkr(indenter.paraboloid(R), E, 0.01), depths=depths)
        assert rough.dissipated[-1] > 1.5 * smooth.dissipated[-1]
        area = np.trapezoid(rough.force, rough.depth)
        # Half a step of depth, 2.5e-4, at each of some ten snaps of about 0.02 N.
        assert rough.dissipated[-1] == pytest.approx(area, abs=10 * 2.5e-4 * 0.02)

    @pytest.mark.parametrize("machine", [0.0, 0.3, 3.0])
    def test_the_loss_is_the_work_of_the_machine(self, machine):
        """A closed loop above the pull-off with snaps on its way: F over d, or over the far end of the spring."""
        if machine == 0:
            path = adhesive_path(self.adhesion, forces=np.append(0.0, cycle(0.0, 0.1, 120)))
            place, force = path.depth, path.force
        else:
            place = np.append(0.0, cycle(0.02, 0.1 + 0.1 / machine, 120))
            path = adhesive_path(self.adhesion, depths=place, machine_stiffness=machine)
            force = path.force
        lost = path.dissipated[-1] - path.dissipated[1]
        work = (np.diff(place) * (force[1:] + force[:-1]) / 2)[1:].sum()
        # Where in its step a snap came the sum cannot know: half of the product of both steps, and as much again
        # where a rise hides a part of a drop.
        snapped = np.diff(path.dissipated) > 0
        error = np.abs(np.diff(place) * np.diff(force))[snapped][1:].sum()
        assert lost > 5 * error
        assert lost == pytest.approx(work, abs=error)

    def test_losses_only_grow_and_states_are_stable(self):
        path = adhesive_path(self.adhesion, depths=cycle(-0.1, 0.1, 200))
        assert (np.diff(path.dissipated) >= -1e-15).all()
        on = path.contact_radius > 0
        assert (self.adhesion.depth_slope(path.contact_radius[on]) > 0).all()
        np.testing.assert_allclose(self.adhesion.depth(path.contact_radius[on]), path.depth[on], atol=1e-12)

    def test_on_the_way_out_and_in_it_may_be_elsewhere(self):
        path = adhesive_path(self.adhesion, depths=cycle(-0.01, 0.1, 56))
        there, back = path.contact_radius[:56], path.contact_radius[:55:-1]
        assert (back >= there - 1e-12).all()
        assert (back > there + 1e-3).any()


class TestRefusals:
    def test_histories(self):
        with pytest.raises(ValueError, match="exactly one history"):
            adhesive_path(SPHERE)
        with pytest.raises(ValueError, match="exactly one history"):
            adhesive_path(SPHERE, depths=[0.0], forces=[0.0])
        with pytest.raises(ValueError, match="finite"):
            adhesive_path(SPHERE, depths=[math.nan])
        with pytest.raises(ValueError, match="must be positive"):
            adhesive_path(SPHERE, depths=[0.0], machine_stiffness=0.0)

    def test_a_body_alone_does_not_stick(self):
        with pytest.raises(ValueError, match="a JKRContact is needed"):
            adhesive_path(indenter.paraboloid(R), forces=[1.0])

    def test_the_end_of_what_is_known(self):
        with pytest.raises(ValueError, match="not known"):
            adhesive_path(jkr(indenter.of(lambda r: r**2, 0.6), E, W), depths=[10.0])
