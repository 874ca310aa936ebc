"""Contact that sticks under prescribed forces: the depth is free."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion import quasi_static
from roughcontact.contact.problem import separation_of
from sticking import eigenvalues_by_matrices, rough, sticky

BODIES = {
    "periodic": rough(24, periodic=True, slope=0.2, seed=1),
    "free": rough(24, periodic=False, slope=0.2, seed=1),
}


def path(surface, adhesion, **loads):
    return list(rc.adhesive_path(surface, 1.0, adhesion, **loads))


@pytest.mark.parametrize("kind", BODIES)
def test_the_depth_of_a_force_is_that_which_causes_it(kind):
    surface, adhesion = BODIES[kind], sticky(2.0)
    for fraction in (0.7, 0.85):
        given = rc.adhesive_state(surface, 1.0, adhesion, depth=fraction * separation_of(surface).mean())
        assert given.force > 0
        found = rc.adhesive_state(surface, 1.0, adhesion, force=given.force)
        assert found.status.converged
        # Certified to 1e-8 of the largest traction; what is softest here answers some hundred times as much.
        assert found.force == pytest.approx(given.force, rel=1e-8)
        assert found.depth == pytest.approx(given.depth, rel=1e-6)
        assert np.abs(found.pressure - given.pressure).max() <= 1e-6 * np.abs(given.pressure).max()


@pytest.mark.parametrize("kind", BODIES)
def test_forces_up_and_down_do_not_depend_on_the_step(kind):
    surface, adhesion = BODIES[kind], sticky(2.0)
    most = (
        0.5
        * rc.adhesive_state(surface, 1.0, adhesion, depth=0.4 * separation_of(surface).mean()).contact_area
    )
    up = np.linspace(0.0, 0.05 * most + 1.0, 5)
    fine = np.linspace(0.0, 0.05 * most + 1.0, 17)
    coarse = path(surface, adhesion, forces=np.r_[up, up[-2::-1]])
    other = path(surface, adhesion, forces=np.r_[fine, fine[-2::-1]])[::4]
    for one, two in zip(coarse, other, strict=True):
        assert one.status.converged
        assert one.stability > 0
        assert one.depth == pytest.approx(two.depth, abs=1e-6 * adhesion.range)


def test_a_sphere_is_pulled_off_by_the_largest_tension_of_its_curve():
    rings = rc.RadialGrid.uniform(60, radius=6e-7)
    # Its curve has no smaller extremum beside the largest, as rings let go, at which a given force might pull it off.
    ball, adhesion = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings), rc.Adhesion(work=10e-3, range=8e-9)
    loop = rc.adhesive_loop(ball, 1e8, adhesion, depth=10e-9, points=20)
    forces = np.r_[0.0, -np.linspace(0.5, 1.2, 15) * loop.pull_off_force, 0.0]
    states = list(rc.adhesive_path(ball, 1e8, adhesion, forces=forces))
    jumps = [jump for state in states for jump in state.jumps]
    pulled = [jump for jump in jumps if math.isinf(jump.lost)]
    assert len(pulled) == 1
    # Both are known to 1e-6.
    assert -pulled[0].force_before == pytest.approx(loop.pull_off_force, rel=2e-6)
    off = [state.depth == -math.inf for state in states]
    assert off == [state.force == 0 and not state.contact.any() and k > 0 for k, state in enumerate(states)]
    assert any(off)
    assert not all(off)
    assert states[-1].contact.any()  # without a force the bodies draw near again
    assert states[-1].depth == pytest.approx(states[0].depth, rel=1e-6)


def test_a_jump_after_which_one_integration_alone_pulls_the_body_off_is_ambiguous(monkeypatch):
    rings = rc.RadialGrid.uniform(60, radius=6e-7)
    ball, adhesion = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings), rc.Adhesion(work=10e-3, range=8e-9)

    def last_jump():
        curve = rc.adhesive_curve(ball, 1e8, adhesion, forces=[0.0, -1e-6])
        assert curve.ambiguous is curve.jumps[-1].ambiguous
        return curve.jumps[-1]

    assert math.isinf(last_jump().lost)
    assert not last_jump().ambiguous
    flow = quasi_static.flow

    def one_stays(energy, start, convex, counter, *, uniform=False):
        result = flow(energy, start, convex, counter)
        return (
            replace(result, equilibrium=replace(result.equilibrium, point=energy.at(start)))
            if uniform
            else result
        )

    monkeypatch.setattr(quasi_static, "flow", one_stays)
    assert math.isinf(last_jump().lost)
    assert last_jump().ambiguous


@pytest.mark.parametrize("kind", BODIES)
def test_stability_under_a_force_is_the_smallest_eigenvalue_with_the_depth_free(kind):
    surface, adhesion = rough(16, periodic=kind == "periodic", slope=0.3, seed=2), sticky(3.0)
    state = rc.adhesive_state(surface, 1.0, adhesion, force=1.0)
    free = np.ones(state.problem.form.shape, bool)
    free[state.problem.form.inside] = ~state.contact
    curvature = np.zeros(free.shape)
    curvature[state.problem.form.inside] = state.attraction.curvature(np.maximum(state.gap, 0.0))
    values = eigenvalues_by_matrices(state.problem.control.form, free, curvature)
    wanted = values[0]
    assert wanted - 1e-9 <= state.stability <= wanted + 1e-3
    assert np.abs(values - state.stability).min() <= state.stability_residual <= 1e-3
    at_depth = rc.adhesive_state(surface, 1.0, adhesion, depth=state.depth)
    assert at_depth.stability >= state.stability - 1e-3  # with the depth held, fewer ways are open


def test_a_path_cannot_begin_under_tension():
    with pytest.raises(ValueError, match="cannot begin under the tension -1"):
        rc.adhesive_state(BODIES["free"], 1.0, sticky(2.0), force=-1.0)
