"""The largest tension of a retreat: the extremum along the path, whatever its points."""

import functools
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.lowest_force import FORCE_TOLERANCE
from roughcontact.theory.adhesive.maugis import DugdaleSphere
from sticking import rough, sticky

RINGS = rc.RadialGrid.uniform(45, radius=6e-7)
BALL = rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS)
SOFT = rc.Adhesion(work=10e-3, range=4e-9)
# Both are within the tolerance of the extremum.
SAME = 2 * FORCE_TOLERANCE

BODIES = {
    "ball": (BALL, 1e8, SOFT, 10e-9),
    "ball that jumps from ring to ring": (BALL, 1e8, rc.Adhesion(work=10e-3, range=2.8e-9), 10e-9),
    "ball, dugdale": (BALL, 1e8, rc.Adhesion(10e-3, 6e-9, "dugdale"), 10e-9),
    "free": (rough(24, periodic=False, slope=0.2, seed=0), 1.0, sticky(1.5), 0.8),
    "periodic": (rough(24, periodic=True, slope=0.2, seed=1), 1.0, sticky(2.0), 0.5),
}


@functools.cache
def loop(kind, points):
    surface, modulus, adhesion, depth = BODIES[kind]
    return rc.adhesive_loop(surface, modulus, adhesion, depth=depth, points=points)


@pytest.mark.parametrize("kind", BODIES)
def test_it_is_the_same_whatever_the_points(kind):
    found = [loop(kind, points) for points in (2, 24)]
    forces = [each.pull_off_force for each in found]
    assert max(forces) - min(forces) <= SAME * max(forces)
    # The points alone miss it: few ones by much.
    samples = [-each.force[~each.approach].min() / each.pull_off_force for each in found]
    assert samples[0] < 0.9
    assert max(samples) <= 1 + FORCE_TOLERANCE


def test_a_loop_ends_ten_ranges_apart():
    """There nothing of the attraction bulges the bodies: the gap at the summit is the depth."""
    found, reach = loop("ball", 2), SOFT.range
    assert found.contact_area[-1] == 0
    assert found.depth[-1] < -10 * reach <= found.depth[-2] * (1 - 1e-9)


@pytest.mark.parametrize("kind", BODIES)
def test_no_point_of_a_dense_path_has_a_lower_force(kind):
    surface, modulus, adhesion, turn = BODIES[kind]
    coarse = loop(kind, 24)
    back = np.flatnonzero(~coarse.approach)
    lowest = back[np.argmin(coarse.force[back])]
    step = coarse.depth[0] - coarse.depth[1]
    near = np.linspace(coarse.depth[lowest] - step, coarse.depth[lowest] + step, 40)
    near = np.minimum(near, turn) if step < 0 else near
    depths = [coarse.depth[0], turn, *np.sort(near)[::-1]]
    _, _, *states = rc.adhesive_path(surface, modulus, adhesion, depths=depths)
    dense = -min(state.force for state in states)
    assert dense <= coarse.pull_off_force * (1 + FORCE_TOLERANCE)
    # Next to the extremum a point is at most half a step off, along a slope no steeper than beside it.
    least = int(np.argmin([state.force for state in states]))
    beside = max(abs(states[k].force - states[least].force) for k in (least - 1, least + 1))
    assert dense >= coarse.pull_off_force - beside


@pytest.mark.parametrize("number", [0.1, 1.0])
def test_two_points_give_the_pull_off_of_maugis(number):
    theory = DugdaleSphere.of_number(number)
    adhesion = rc.Adhesion(1.0, 1 / theory.strength, law="dugdale")
    rings = rc.RadialGrid.uniform(120, 1.1 * float(theory.zone_radius(1.7)))
    ball = rc.RadialProfile(-(rings.radii**2) / 2, rings)
    curve = rc.adhesive_curve(ball, 1.0, adhesion, depths=[1.5, -3 - 2 / theory.strength])
    assert -curve.force.min() < 0.9 * theory.pull_off_force
    # The edge of the attraction is known to a part of a ring; of second order in its width.
    assert curve.pull_off_force == pytest.approx(theory.pull_off_force, rel=2e-3)


def test_under_forces_it_is_the_tension_that_pulls_the_body_off():
    forces = [1e-7, -1e-7, -1e-6, 0.0]
    curve = rc.adhesive_curve(BALL, 1e8, SOFT, forces=forces)
    [off] = [jump for jump in curve.jumps if jump.lost == math.inf]
    assert curve.pull_off_force == pytest.approx(-off.force_before, rel=1e-6)
    # A ball is pulled off by the largest tension of its curve under depths; 1e-8 of the largest force is the bracket.
    assert curve.pull_off_force == pytest.approx(
        loop("ball", 5).pull_off_force, rel=SAME + 1e-8 * 1e-6 / 5e-7
    )
    held = rc.adhesive_curve(BALL, 1e8, SOFT, forces=[1e-7, -1e-7, -3e-7])
    assert held.pull_off_force == pytest.approx(3e-7, rel=1e-8)  # the residual of a state


def test_each_retreat_has_its_own_and_an_approach_has_none():
    depths = [10e-9, -3e-9, 10e-9, 9e-9, 10e-9]
    states = list(rc.adhesive_path(BALL, 1e8, SOFT, depths=depths))
    for at in (0, 2, 4):
        assert states[at].lowest_force == states[at].force
    # The force falls all the way down to the depth of -3 nm, where its slope is still positive.
    assert states[1].stiffness > 0
    assert states[1].lowest_force == pytest.approx(states[1].force, rel=1e-8)
    assert states[3].lowest_force == pytest.approx(states[3].force, rel=1e-8)
    assert states[3].lowest_force > states[1].lowest_force
    curve = rc.adhesive_curve(BALL, 1e8, SOFT, depths=depths)
    assert curve.pull_off_force == -states[1].lowest_force


def test_where_nothing_pulls_back_it_is_zero():
    assert rc.adhesive_curve(BALL, 1e8, SOFT, depths=[10e-9, 9e-9]).pull_off_force == 0
    assert rc.adhesive_curve(BALL, 1e8, SOFT, depths=[-5e-9, 0.0]).pull_off_force == 0


def test_a_body_that_is_drawn_back_from_a_tension_begins_with_it():
    # At -6 nm the extremum of the ball has been passed: the tension only falls from there.
    curve = rc.adhesive_curve(BALL, 1e8, SOFT, depths=[5e-9, -6e-9, -6e-9, -12e-9])
    last = rc.adhesive_curve(BALL, 1e8, SOFT, depths=[-6e-9, -12e-9])
    assert curve.lowest_force[-1] == curve.lowest_force[1] < curve.force[1]
    assert last.pull_off_force == pytest.approx(-last.force[0], rel=1e-9)


def test_the_depth_of_the_pull_off_is_that_of_its_force():
    """A loop that is pressed to this depth and no further has this force there."""
    curve = rc.adhesive_loop(BALL, 1e8, SOFT, depth=10e-9, points=4)
    at = curve.pull_off_point
    assert curve.lowest_force[at] == curve.lowest_force[-1] == -curve.pull_off_force
    depth = curve.lowest_force_depth[at]
    assert depth not in curve.depth
    state = rc.adhesive_curve(BALL, 1e8, SOFT, depths=[10e-9, depth])[-1]
    assert state.force == pytest.approx(-curve.pull_off_force, rel=FORCE_TOLERANCE)
    assert rc.adhesive_curve(BALL, 1e8, SOFT, depths=[10e-9, 9e-9]).pull_off_point is None
