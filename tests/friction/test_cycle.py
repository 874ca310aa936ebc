"""Forth and back: what a contact remembers, and what friction takes."""

from itertools import pairwise

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.friction.slide import load_cycle, slide, slide_path
from roughcontact.friction.slip_curve import slide_curve

MU = 0.3


def pressed(nu=0.0, n=48, periodic=False):
    """A rough sphere: some spots, and one slope of the curve."""
    grid = rc.Grid((n, n), 1e-6, periodic)
    surface = rc.self_affine(grid, hurst=0.8, rms=2e-8, short_cutoff=5e-6, rng=np.random.default_rng(2))
    heights = surface.heights + oracles.paraboloid(n, 5e-4, side=n * 1e-6)
    bodies = (rc.Solid(1e11, nu), rc.Solid(1e11, nu))
    solution = rc.press(rc.Surface(heights, grid), bodies, depth=4e-7)
    return solution, bodies


@pytest.fixture(scope="module")
def case():
    return pressed()


def test_masings_rule(case):
    """A branch is the first loading at twice the scale: exact for nu = 0, to the tolerance of the solves."""
    solution, bodies = case
    top = 0.8 * MU * solution.force
    first, *others = slide_path(
        solution, bodies, friction=MU, forces=[top, 0.5 * top, -0.3 * top, -top, top], tolerance=1e-10
    )
    for state, force in zip(others[:3], (0.5 * top, -0.3 * top, -top), strict=True):
        half = slide(solution, bodies, friction=MU, force=(top - force) / 2, tolerance=1e-10)
        expected = first.displacement - 2 * half.displacement
        np.testing.assert_allclose(state.displacement, expected, rtol=0, atol=1e-8 * first.displacement[0])
        traction = first.traction - 2 * half.traction
        np.testing.assert_allclose(state.traction, traction, rtol=0, atol=1e-6 * first.traction.max())
    np.testing.assert_allclose(others[-1].traction, first.traction, rtol=0, atol=1e-6 * first.traction.max())


def test_loss_of_a_cycle_on_a_sphere():
    """Cattaneo and Mindlin: what friction takes is good to 3e-3 on 64 cells, and needs no small steps."""
    n, bodies = 64, (rc.Solid(2.0, 0.0), rc.Solid(2.0, 0.0))
    surface = rc.Surface(oracles.paraboloid(n, 1.0, side=0.1), rc.Grid((n, n), 0.1 / n))
    solution = rc.press(surface, bodies, force=4 / 3 * 0.035**3)
    theory = rc.theory.cattaneo.SlippingSphere(solution.force, 1.0, 1.0, MU, 1.0)
    for part in (0.3, 0.8):
        top = part * MU * solution.force
        curve = slide_curve(solution, bodies, friction=MU, forces=load_cycle(top, steps=1))
        assert curve.dissipated[1:].sum() == pytest.approx(theory.cycle_loss(top), rel=3e-3)
        np.testing.assert_allclose(curve.displacement[0], curve.displacement[-1], rtol=1e-6)


def test_loss_of_a_cycle_on_a_rough_sphere(case):
    """Jaeger: by Masing's rule from the depths at all smaller normal forces, to the quadrature over 80 of them."""
    solution, bodies = case
    forces = solution.force * np.linspace(0.2, 1, 80)
    depth = rc.loading_curve(solution.problem.surface, bodies, forces=forces).depth
    pulls, rises = MU * (forces[-1] - forces), MU * (depth[-1] - depth)
    area = ((rises[1:] + rises[:-1]) / 2 * -np.diff(pulls)).sum()
    curve = slide_curve(solution, bodies, friction=MU, forces=[pulls[0], -pulls[0], pulls[0]])
    assert curve.dissipated[1:].sum() == pytest.approx(4 * pulls[0] * rises[0] - 8 * area, rel=1e-3)


@pytest.mark.parametrize("nu", [0.0, 0.4])
def test_energy_is_kept(nu):
    """Work is elastic energy and loss: the trapezoidal rule is off by the square of the step."""
    solution, bodies = pressed(nu, 16)
    top = 0.9 * MU * solution.force
    errors = []
    for steps in (2, 4, 8):
        curve = slide_curve(solution, bodies, friction=MU, forces=load_cycle(top, steps=steps))
        force, moved = (np.vstack([[0, 0], field]) for field in (curve.force, curve.displacement))
        work = ((force[1:] + force[:-1]) / 2 * np.diff(moved, axis=0)).sum()
        stored = curve.elastic_energy[-1] + curve.dissipated_energy[-1]
        errors.append(abs(work - stored) / stored)
    assert errors[2] < 0.02
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


def test_friction_never_gives(case):
    solution, bodies = case
    rng = np.random.default_rng(1)
    forces = rng.uniform(-0.6, 0.6, (12, 2)) * MU * solution.force
    curve = slide_curve(solution, bodies, friction=MU, forces=forces)
    assert (curve.dissipated > -1e-9 * curve.dissipated.max()).all()
    assert (np.diff(curve.dissipated_energy) >= -1e-9 * curve.dissipated.max()).all()


def test_a_straight_way_needs_no_steps(case):
    """For nu = 0 slip keeps its direction, and the state depends on the turns alone."""
    solution, bodies = case
    top = 0.7 * MU * solution.force
    for path in ([top], [top, -0.5 * top]):
        fine = np.interp(np.linspace(0, len(path), 6 * len(path) + 1)[1:], range(len(path) + 1), [0, *path])
        many = slide_curve(solution, bodies, friction=MU, forces=fine, tolerance=1e-10)
        once = slide_curve(solution, bodies, friction=MU, forces=path, tolerance=1e-10)
        np.testing.assert_allclose(many.displacement[-1], once.displacement[-1], rtol=1e-8)
        assert many.dissipated_energy[-1] == pytest.approx(once.dissipated_energy[-1], rel=1e-7)


def test_a_way_that_turns_needs_steps():
    """Slip that turns: the end of a quarter of a circle converges with the steps, at their first power."""
    solution, bodies = pressed(0.3, 24)
    radius = 0.8 * MU * solution.force
    ends = []
    for steps in (4, 8, 16):
        angle = np.linspace(0, np.pi / 2, steps + 1)
        forces = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        ends.append(slide_curve(solution, bodies, friction=MU, forces=forces).displacement[-1])
    coarse, fine = (np.linalg.norm(b - a) for a, b in pairwise(ends))
    assert fine < 0.65 * coarse < 0.1 * np.linalg.norm(ends[-1])


def test_displacements_and_forces_tell_one_story(case):
    solution, bodies = case
    top = 0.8 * MU * solution.force
    by_force = slide_curve(solution, bodies, friction=MU, forces=load_cycle(top, steps=2), tolerance=1e-10)
    back = slide_curve(solution, bodies, friction=MU, displacements=by_force.displacement, tolerance=1e-10)
    np.testing.assert_allclose(back.force, by_force.force, rtol=0, atol=1e-7 * top)
    np.testing.assert_allclose(
        back.dissipated, by_force.dissipated, rtol=0, atol=1e-7 * back.dissipated.max()
    )


def test_one_step_after_another_is_a_path(case):
    solution, bodies = case
    top = 0.8 * MU * solution.force
    *_, last = slide_path(solution, bodies, friction=MU, forces=[top, -top / 2])
    first = slide(solution, bodies, friction=MU, force=top)
    second = slide(solution, bodies, friction=MU, force=-top / 2, initial=first)
    np.testing.assert_array_equal(second.traction, last.traction)
    assert second.dissipated == last.dissipated


def test_a_cycle_of_loads():
    np.testing.assert_array_equal(load_cycle(2.0, steps=2), [1, 2, 1, 0, -1, -2, -1, 0, 1, 2])
    np.testing.assert_array_equal(load_cycle((3.0, 4.0), cycles=0, steps=1), [[3, 4]])
    assert len(load_cycle(1.0, cycles=3, steps=5)) == 65
    for wrong in ({"steps": 0}, {"cycles": -1}, {"steps": 1.5}):
        with pytest.raises(ValueError, match="whole number"):
            load_cycle(1.0, **wrong)
    with pytest.raises(ValueError, match="an amplitude is"):
        load_cycle([1.0, 2.0, 3.0])


def test_a_curve_says_what_it_spans(case):
    solution, bodies = case
    curve = slide_curve(solution, bodies, friction=MU, forces=[1e-3, -1e-3])
    assert len(curve) == 2
    assert repr(curve).startswith("SlipCurve(2 of 2 points converged, forces up to 0.001 of ")
    assert curve.capacity == pytest.approx(MU * solution.force)
