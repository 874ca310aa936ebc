"""States along a path: certified, independent of the step, and their energy accounted for."""

import functools

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.elastic_form import elastic_form
from roughcontact.adhesion.path_states import _law_on
from roughcontact.contact.problem import separation_of
from sticking import rough, slow_path, sticky

RANGE = 0.3
BRACKET = 1e-6  # of the range of depths, in which the end of a branch is found


def path(surface, adhesion, depths, modulus=1.0, **settings):
    return list(rc.adhesive_path(surface, modulus, adhesion, depths=depths, **settings))


def loop_depths(surface, steps):
    deepest = 0.4 * separation_of(surface).mean()
    approach = np.linspace(-10 * RANGE, deepest, steps + 1)
    return np.r_[approach, approach[-2::-1]]


@functools.cache
def stepped(periodic, slope, length, steps):
    surface = rough(32, periodic=periodic, slope=slope, seed=0)
    return path(surface, sticky(length), loop_depths(surface, steps))


CASES = [(False, 0.1, 1.5), (False, 0.2, 1.5), (True, 0.1, 1.5), (True, 0.1, 3.0)]


@pytest.mark.parametrize(("periodic", "slope", "length"), CASES)
def test_states_and_jumps_do_not_depend_on_the_step(periodic, slope, length):
    surface = rough(32, periodic=periodic, slope=slope, seed=0)
    coarse, fine = (stepped(periodic, slope, length, steps) for steps in (8, 24))
    largest = max(abs(state.force) for state in coarse)
    for one, other in zip(coarse, fine[::3], strict=True):
        assert one.residual <= 1e-8
        assert abs(one.force - other.force) <= 1e-6 * largest
    first, second = ([jump for state in states for jump in state.jumps] for states in (coarse, fine))
    span = loop_depths(surface, 1).max() + 40 * RANGE
    assert [jump.approach for jump in first] == [jump.approach for jump in second]
    for one, other in zip(first, second, strict=True):
        assert abs(one.depth - other.depth) <= 2 * BRACKET * span
        assert one.bracket <= BRACKET * span * (1 + 1e-9)
        assert not one.ambiguous
        assert one.lost > 0


def test_some_of_these_surfaces_jump():
    """Else the test above would say nothing of jumps."""
    jumps = [jump for state in stepped(*CASES[0], 8) for jump in state.jumps]
    assert any(jump.approach for jump in jumps)
    assert any(not jump.approach for jump in jumps)


def test_a_jump_by_less_than_the_range_is_recorded_with_what_it_loses():
    rings = rc.RadialGrid.uniform(30, radius=6e-7)
    ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    adhesion = rc.Adhesion(work=10e-3, range=2.5e-9, allow_unresolved=True)
    loop = rc.adhesive_loop(ball, 1e8, adhesion, depth=10e-9, points=4)
    edge = next(jump for jump in loop.jumps if not jump.approach)
    beside = edge.depth + 4 * edge.bracket * np.array([1, -1])
    _, before, after = path(ball, adhesion, [10e-9, *beside], modulus=1e8)
    moved = np.abs(after.displacement - before.displacement).max()
    assert 0.02 * adhesion.range < moved < 0.5 * adhesion.range
    # A branch that went on would have changed the force by its slope times the step.
    step, drop = beside[0] - beside[1], abs(after.force - before.force)
    assert drop > 100 * before.stiffness * step
    assert before.jumps == ()
    [jump] = after.jumps
    assert not jump.approach
    # The force on the way is between that before and that after.
    balance = before.energy - after.energy - before.force * step
    assert jump.lost == pytest.approx(balance, abs=drop * step)
    assert drop * step < 0.1 * jump.lost


@pytest.mark.parametrize("seed", range(3))
def test_a_slow_solver_that_cannot_leave_a_basin_finds_the_same_states(seed):
    surface, adhesion = rough(12, periodic=False, slope=0.3, seed=seed), sticky(1.5)
    body, separation = rc.half_space(surface.grid, 1.0), separation_of(surface)
    depths = loop_depths(surface, 8)
    slow = slow_path(body, separation, adhesion, depths)
    for state, gap in zip(path(surface, adhesion, depths), slow, strict=True):
        # The slow solver stops at steps of 1e-13, a factor of 1/stability before its limit.
        assert np.abs(state.gap.ravel() - gap).max() <= 1e-6 * RANGE


@pytest.mark.parametrize("periodic", [False, True])
def test_the_force_is_the_slope_of_the_energy_and_the_stiffness_that_of_the_force(periodic):
    surface, adhesion = rough(24, periodic=periodic, slope=0.2, seed=1), sticky(2.0)
    depth, step = 0.3 * separation_of(surface).mean(), 1e-5
    below, here, above = path(surface, adhesion, [depth - step, depth, depth + step])
    assert here.contact.any()
    assert (here.pressure < 0).any()
    if (below.contact == above.contact).all():
        # Of a difference of second order: step^2 over the square of the range, and the rounding of the energies.
        assert np.isclose((above.energy - below.energy) / (2 * step), here.force, rtol=1e-6)
        assert np.isclose((above.force - below.force) / (2 * step), here.stiffness, rtol=1e-5)
    else:
        pytest.fail("the contact changed: choose another depth")
    assert here.stiffness < here.contact_stiffness


@pytest.mark.parametrize("periodic", [False, True])
def test_without_jumps_the_work_of_a_path_is_the_change_of_energy(periodic):
    surface, adhesion = rough(16, periodic=periodic, slope=0.3, seed=2), sticky(6.0)
    states = path(surface, adhesion, np.linspace(-3 * RANGE, 0.3, 201))
    assert not any(state.jumps for state in states)
    force, depth = (np.array([getattr(s, name) for s in states]) for name in ("force", "depth"))
    work = np.trapezoid(force, depth)
    # Trapezoids are off by h^2/12 times the change of the slope.
    slopes = np.array([states[0].stiffness, states[-1].stiffness])
    error = (depth[1] - depth[0]) ** 2 * np.abs(np.diff(slopes))[0]
    assert abs(work - (states[-1].energy - states[0].energy)) <= error


def test_the_area_of_a_closed_loop_is_what_its_jumps_lose():
    rings = rc.RadialGrid.uniform(60, radius=6e-7)
    ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    loop = rc.adhesive_loop(ball, 1e8, adhesion, depth=10e-9, points=25)
    assert len(loop.jumps) >= 2
    # Between the jumps, where the branches differ, and toward them, where the force bends as a square root.
    ends = np.array([jump.depth for jump in loop.jumps])
    between = np.linspace(ends.min() - 1e-9, ends.max() + 1e-9, 200)
    halves = []
    for way in (True, False):
        sign = 1 if way else -1
        crowds = [
            jump.depth - sign * np.r_[-jump.bracket, 0.0, 1e-9 * 0.6 ** np.arange(20)]
            for jump in loop.jumps
            if jump.approach == way
        ]
        points = np.unique(np.concatenate([loop.depth[loop.approach == way], between, *crowds]))
        halves.append(points[::sign])
    states = path(ball, adhesion, np.concatenate(halves), modulus=1e8)
    force, depth = (np.array([getattr(s, name) for s in states]) for name in ("force", "depth"))
    assert abs(force[-1] - force[0]) <= 1e-3 * loop.pull_off_force  # closed
    lost = sum(jump.lost for state in states for jump in state.jumps)
    assert abs(np.trapezoid(force, depth) - lost) <= 1e-3 * lost
    assert abs(loop.lost - lost) <= 1e-3 * lost


@pytest.mark.parametrize("periodic", [False, True])
def test_a_vanishing_work_is_contact_without_adhesion(periodic):
    surface = rough(24, periodic=periodic, slope=0.2, seed=3)
    depth = 0.5 * separation_of(surface).mean()
    bare = rc.press(surface, 1.0, depth=depth, tolerance=1e-12)
    state = path(surface, rc.Adhesion(1e-12, 0.1, allow_unresolved=True), [depth])[0]
    largest = bare.pressure.max()
    assert np.abs(state.pressure - bare.pressure).max() <= 1e-8 * largest
    assert abs(state.force - bare.force) <= 1e-8 * bare.force


def test_missing_cells_and_cells_that_do_not_stick():
    surface = rough(24, periodic=False, slope=0.2, seed=4)
    heights, work = surface.heights.copy(), np.full((24, 24), 0.01)
    heights[3:6, 4:9] = np.nan
    work[12:] = 0.0
    patchy = rc.Surface(heights, surface.grid)
    state = path(patchy, rc.Adhesion(work, RANGE), [0.0])[0]
    assert state.status.converged
    assert (state.pressure[np.isnan(heights)] == 0).all()
    assert (state.pressure[12:] >= 0).all()
    assert (state.pressure[:12] < 0).any()


def test_nothing_is_attracted_beyond_the_grid_and_where_nothing_was_measured():
    surface = rough(12, periodic=False, slope=0.2, seed=4)
    separation = separation_of(surface).copy()
    separation[3:6, 4:9] = np.inf
    for law in ("exponential", "dugdale"):
        adhesion = rc.Adhesion(0.01, RANGE, law)
        form = elastic_form(rc.half_space(surface.grid, 1.0))
        found = _law_on(adhesion, form, separation, 1.0)
        assert found.strength == pytest.approx(adhesion.strength, rel=1e-12)
        traction = found.traction(np.zeros(form.shape))
        np.testing.assert_array_equal(traction > 0, form.extended(np.isfinite(separation), 0.0))


def test_states_of_random_problems_are_certified_and_stable():
    rng = np.random.default_rng(5)
    for seed in range(30):
        surface = rough(16, periodic=bool(seed % 2), slope=10 ** rng.uniform(-1.5, 0.0), seed=seed)
        adhesion = sticky(rng.uniform(1.5, 4.0), reach=10 ** rng.uniform(-1.0, 0.3))
        depths = rng.uniform(-3 * adhesion.range, 0.8 * separation_of(surface).mean(), 3)
        for state in path(surface, adhesion, depths):
            assert state.residual <= 1e-8
            assert state.status.converged
            assert state.stability > 0


def test_what_cannot_be_is_refused_at_once():
    surface, adhesion = rough(16, periodic=True, slope=0.2, seed=0), sticky(2.0)
    mean = separation_of(surface).mean()
    with pytest.raises(ValueError, match="full contact"):
        rc.adhesive_path(surface, 1.0, adhesion, depths=[mean])
    with pytest.raises(ValueError, match="varies over 1 cells"):
        rc.adhesive_path(surface, 1.0, sticky(1.0), depths=[0.0])
    with pytest.raises(ValueError, match="shape"):
        rc.adhesive_path(surface, 1.0, rc.Adhesion(np.full(3, 0.01), RANGE), depths=[0.0])
    with pytest.raises(ValueError, match="must be an Adhesion, such as"):
        rc.adhesive_path(surface, 1.0, 0.05, depths=[0.0])
    with pytest.raises(ValueError, match="exactly one of depths, forces, pressures and mean_gaps"):
        rc.adhesive_path(surface, 1.0, adhesion)
    with pytest.raises(ValueError, match="at least one number in one row"):
        rc.adhesive_path(surface, 1.0, adhesion, depths=[])
    with pytest.raises(ValueError, match="ten ranges"):
        rc.adhesive_loop(surface, 1.0, adhesion, depth=-9.0)


def test_an_unresolved_attraction_is_marked_in_every_answer():
    surface = rough(16, periodic=True, slope=0.2, seed=0)
    weak = sticky(1.0)
    trapped = rc.Adhesion(weak.work, weak.range, allow_unresolved=True)
    assert path(surface, trapped, [0.0])[0].unresolved
    assert rc.adhesive_state(surface, 1.0, trapped, depth=0.0).unresolved
    assert not path(surface, sticky(2.0), [0.0])[0].unresolved


def test_states_are_the_same_in_other_units():
    surface, adhesion = rough(16, periodic=False, slope=0.2, seed=6), sticky(2.0)
    small = rc.Surface(surface.heights * 1e-9, rc.Grid((16, 16), 1e-9))
    one = path(surface, adhesion, [0.1])[0]
    other = path(
        small, rc.Adhesion(adhesion.work * 1e-9 * 1e11, adhesion.range * 1e-9), [1e-10], modulus=1e11
    )[0]
    assert np.isclose(other.force, one.force * 1e-18 * 1e11, rtol=1e-8)


@pytest.mark.parametrize("unit", [1.0, 1e-6])
def test_the_residual_is_that_of_the_conditions_of_equilibrium_in_any_unit(unit):
    """A gap counts by the stiffness of a cell, beside tractions, over the largest traction."""
    raised, modulus = rough(16, periodic=False, slope=0.1, seed=1), 1e9
    surface = rc.Surface(unit * raised.heights, rc.Grid((16, 16), unit))
    adhesion = rc.Adhesion(work=0.015 * modulus * unit, range=0.3 * unit)
    state = rc.adhesive_state(surface, modulus, adhesion, depth=0.2 * unit)
    operator = rc.half_space(surface.grid, modulus)
    separation = surface.heights.max() - surface.heights
    gap = operator.apply(state.pressure) + separation - state.depth
    attraction = 0.05 * modulus * np.exp(-np.maximum(gap, 0) / adhesion.range)
    worst = np.minimum(gap / operator.as_matrix(np.zeros(1, int))[0, 0], state.pressure + attraction)
    assert state.contact.any()
    expected = np.abs(worst).max() / max(0.05 * modulus, np.abs(state.pressure).max())
    assert state.residual == pytest.approx(expected, rel=0.2)
