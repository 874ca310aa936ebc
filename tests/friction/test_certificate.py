"""What a solution claims, checked with a full matrix and Coulomb's law written out, on contacts of any kind."""

import functools
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
import roughcontact.friction.slide as front
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.friction.coulomb import lengths
from roughcontact.friction.newton import SlipNewton
from roughcontact.friction.slide import slide, slide_path
from roughcontact.friction.slip_step import SlipStep
from roughcontact.halfspace.shear.shear_operator import shear_half_space
from roughcontact.halfspace.sums.multilevel import Multilevel
from roughcontact.solver.control import Status

MU = 0.4


shear_of = functools.lru_cache(2)(shear_half_space)


def certificate(answer, before, method="dense"):
    """Return the largest violation over the largest displacement, by loops over the cells in contact."""
    problem = answer.problem
    dense = shear_of(problem.pressed.problem.grid, problem.bodies, method=method)
    now = dense.apply(answer.traction) - answer.displacement[:, None, None]
    then = np.zeros_like(now) if before is None else before.slip
    largest = 0.0
    scale = np.hypot(*dense.apply(answer.traction))[problem.pressed.contact].max()
    if before is not None:
        scale = max(scale, np.hypot(*dense.apply(before.traction))[problem.pressed.contact].max())
    for j, i in np.argwhere(problem.pressed.contact):
        q, slip = answer.traction[:, j, i], (now - then)[:, j, i]
        limit, size = problem.friction * problem.pressed.pressure[j, i], np.hypot(*q)
        assert size <= limit * (1 + 1e-12)
        if size < limit * (1 - 1e-12):
            largest = max(largest, np.hypot(*slip))
        else:
            opposed = min(0.0, slip @ q / size) * q / size
            largest = max(largest, np.hypot(*(slip - opposed)))
    assert not answer.traction[:, ~problem.pressed.contact].any()
    return largest / scale


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("nu", [-0.5, 0.3, 0.5])
@pytest.mark.parametrize("load", ["forces", "displacements"])
def test_every_state_of_a_path_is_what_it_claims(periodic, nu, load):
    grid = rc.Grid((18, 24), (1.2e-6, 1e-6), periodic)
    surface = rc.self_affine(grid, hurst=0.7, rms=1e-7, rng=np.random.default_rng(5))
    bodies = (rc.Solid(1e11, nu), rc.Solid(3e11, 0.2))
    solution = rc.press(surface, bodies, pressure=0.02 * rc.reduced_modulus(*bodies))
    assert 0.1 < solution.contact_fraction < 0.9
    top = MU * (solution.force if load == "forces" else solution.depth)
    path = top * np.array(
        [[0.6, 0], [0.6, 0.5], [-0.7, 0.2], [-0.3, -0.1], [0, 0], [0.1, 0.9], [0.6, -0.8], [0.2, 0]]
    )
    before = None
    for answer in slide_path(solution, bodies, friction=MU, **{load: path}):
        assert answer.status is Status.CONVERGED
        assert answer.residual <= 1e-8
        found = certificate(answer, before)
        # The rounding of either product, in units of the largest displacement.
        assert found == pytest.approx(answer.step_residual, rel=1e-3, abs=1e-14)
        if load == "forces":
            np.testing.assert_allclose(
                answer.force, (answer.load.x, answer.load.y), rtol=0, atol=1e-12 * answer.problem.capacity
            )
        before = answer


@pytest.fixture(scope="module")
def wide():
    """A contact of so many cells that its operator makes no matrix of them, and the sum is put to work."""
    bodies = (rc.Solid(1e11, 0.4), rc.Solid(3e11, 0.2))
    grid = rc.Grid((40, 48), (1.2e-6, 1e-6))
    surface = rc.self_affine(grid, hurst=0.7, rms=1e-7, rng=np.random.default_rng(5))
    solution = rc.press(surface, bodies, pressure=0.006 * rc.reduced_modulus(*bodies))
    operator = ContactCells.of(SUMS["multilevel"](grid, bodies), solution.contact).operator
    assert all(hierarchy.levels for hierarchy in operator._sum.components)
    return solution, bodies


SUMS = {
    "moving-grid": lambda grid, bodies: shear_half_space(grid, bodies, method="moving-grid"),
    "multilevel": lambda grid, bodies: shear_half_space(grid, bodies, method="multilevel"),
    "a rough sum, wrong by a thousandth": lambda grid, bodies: replace(
        shear_half_space(grid, bodies), summation=Multilevel(order=4, near=4)
    ),
}


@pytest.fixture(scope="module")
def by_the_exact_sum(wide):
    solution, bodies = wide
    path = MU * solution.force * np.array([[0.7, 0], [-0.4, 0.5]])
    return path, list(slide_path(solution, bodies, friction=MU, forces=path))


@pytest.mark.parametrize("name", SUMS)
def test_any_sum_may_drive_and_the_exact_one_certifies(wide, by_the_exact_sum, name):
    (solution, bodies), (path, exact) = wide, by_the_exact_sum
    operator = SUMS[name](solution.problem.grid, bodies)
    found = slide_path(solution, bodies, friction=MU, forces=path, operator=operator)
    before = None
    for truth, answer in zip(exact, found, strict=True):
        assert answer.status is Status.CONVERGED
        assert answer.residual <= 1e-8
        assert certificate(answer, before, "moving-grid") == pytest.approx(answer.residual, rel=1e-3)
        before = answer
        largest = np.abs(truth.traction).max()
        np.testing.assert_allclose(answer.traction, truth.traction, rtol=0, atol=1e-6 * largest)
        np.testing.assert_allclose(answer.displacement, truth.displacement, rtol=1e-7)
        assert answer.slip_area == pytest.approx(truth.slip_area, rel=1e-3)
        np.testing.assert_allclose(
            answer.stiffness, truth.stiffness, rtol=1e-7, atol=1e-7 * abs(truth.stiffness).max()
        )


@pytest.mark.parametrize("name", SUMS)
def test_stiffness_by_any_sum(wide, name):
    """Good to the square of the tolerance, 1e-7, by the exact sum; that of a thousandth alone would be off by more."""
    solution, bodies = wide
    grid = solution.problem.grid
    truth = rc.tangential_stiffness(solution.contact, grid, bodies, tolerance=1e-10)
    found = rc.tangential_stiffness(
        solution.contact, grid, bodies, operator=SUMS[name](grid, bodies), tolerance=1e-7
    )
    assert found.residual <= 1e-7
    np.testing.assert_allclose(found.matrix, truth.matrix, rtol=0, atol=1e-12 * truth.matrix.max())


@pytest.mark.parametrize("seed", range(24))
@pytest.mark.parametrize("k", [1, 2])
def test_any_limits_any_loads(seed, k):
    """Limits over decades, cells anywhere, forces within a millionth of all: Newton's method always ends."""
    rng = np.random.default_rng(seed)
    body = rc.Solid(1.0, rng.choice([-0.9, 0.0, 0.3, 0.5]))
    grid = rc.Grid((14, 14), (1.0, rng.choice([1.0, 3.0])), bool(rng.random() < 0.3))
    contact = rng.random(grid.shape) < rng.choice([0.05, 0.5, 1.0])
    contact[3, 4] = True
    interface = ContactCells.of(shear_half_space(grid, body), contact, None if k == 2 else (0.6, 0.8))
    n = int(contact.sum())
    limit = 10 ** rng.normal(0, rng.choice([0.1, 1, 2]), n)
    traction, slip, scale = np.zeros((k, n)), np.zeros((k, n)), 0.0
    for _ in range(4):
        force = shift = None
        direction = rng.standard_normal(k)
        direction /= np.linalg.norm(direction)
        if interface.floating or rng.random() < 0.6:
            part = rng.choice([0.1, 0.5, 0.9, 0.9999, 0.999999])
            force = part * direction * limit.sum() * interface.area
        else:
            shift = direction * 10 ** rng.uniform(-2, 2) * limit.max() * interface.self_influence
        found = SlipNewton().run(SlipStep(interface, limit, traction, slip, force, shift, scale, 1e-8))
        assert found.status is Status.CONVERGED
        assert found.steps < 200
        if force is not None:
            carried = found.traction.sum(axis=1) * interface.area
            np.testing.assert_allclose(carried, force, rtol=0, atol=1e-12 * limit.sum() * interface.area)
        traction, slip = found.traction, found.displacement - found.shift[:, None]
        scale = lengths(found.displacement).max()


def test_a_missed_tolerance_is_said(monkeypatch):
    body = rc.Solid(1.0, 0.3)
    x = np.arange(24) - 11.5
    sphere = rc.Surface(-(x[:, None] ** 2 + x**2) / 1000, rc.Grid((24, 24), 1.0))
    solution = rc.press(sphere, body, force=1.0)
    monkeypatch.setattr(front, "SlipNewton", lambda: SlipNewton(max_steps=10))
    with pytest.raises(rc.ConvergenceError, match="more steps") as caught:
        slide(solution, body, friction=MU, force=0.5 * MU)
    best = caught.value.solution
    assert best.status is Status.MAX_STEPS
    assert best.residual == pytest.approx(certificate(best, None), rel=1e-6)
    assert best.residual > 1e-8
    assert best.notes[0].startswith("Residual")
    [state] = slide_path(solution, body, friction=MU, forces=[0.5 * MU])
    assert state.status is Status.MAX_STEPS


def test_too_few_steps_are_said():
    body = rc.Solid(1.0, 0.3)
    interface = ContactCells.of(shear_half_space(rc.Grid((12, 12), 1.0), body), np.ones((12, 12), bool))
    limit = np.linspace(1, 2, 144)
    step = SlipStep(
        interface, limit, np.zeros((2, 144)), np.zeros((2, 144)), np.array([0.0, 120.0]), None, 0.0, 1e-8
    )
    assert SlipNewton(max_steps=3).run(step).status is Status.MAX_STEPS
    assert SlipNewton().run(step).status is Status.CONVERGED
