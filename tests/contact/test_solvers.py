"""The contract of every solver, on every operator: at 1e-10 they agree to 1e-7 of the largest pressure."""

from dataclasses import dataclass

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.contact.press import make_problem
from roughcontact.contact.solve import solve

SOLVERS = {
    "active set": rc.ActiveSet(),
    "active set, conjugate gradients only": rc.ActiveSet(dense_limit=0),
    "Polonsky-Keer": rc.PolonskyKeer(),
}


@dataclass(frozen=True)
class WholeGrid:
    """An operator that does not promise positivity, so that no window may be cut."""

    inner: object
    positive: bool = False

    def __getattr__(self, name):
        return getattr(self.inner, name)


def surface(shape=(64, 64), periodic=False, hurst=0.8, seed=0, missing=0.0):
    rng = np.random.default_rng(seed)
    made = rc.self_affine(rc.Grid(shape, 1 / shape[1], periodic), hurst, 0.01, rng)
    heights = made.heights.copy()
    heights[rng.random(shape) < missing] = np.nan
    return rc.Surface(heights, made.grid)


def agree(a, b):
    largest = a.pressure.max()
    np.testing.assert_allclose(a.pressure, b.pressure, rtol=0, atol=1e-7 * largest)
    assert a.force == pytest.approx(b.force, rel=1e-7)
    assert a.depth == pytest.approx(b.depth, rel=1e-7)


CASES = [
    {"periodic": False},
    {"periodic": True},
    {"periodic": False, "shape": (48, 90), "hurst": 0.2, "missing": 0.2},
    {"periodic": True, "shape": (50, 33), "hurst": 1.5},
]


@pytest.mark.parametrize("case", CASES, ids=str)
@pytest.mark.parametrize("force", [1e-6, 1e-4, 3e-3, 3e-2])
@pytest.mark.parametrize("solver", SOLVERS)
def test_certified(case, force, solver):
    rough = surface(**case)
    solution = rc.press(rough, 1.0, force=force, solver=SOLVERS[solver], tolerance=1e-10)
    assert oracles.certificate(rough, 1.0, solution.pressure, solution.depth) <= 1e-10
    assert solution.force == pytest.approx(force, rel=1e-10)
    agree(solution, rc.press(rough, 1.0, force=force, tolerance=1e-10))


@pytest.mark.parametrize("case", CASES, ids=str)
@pytest.mark.parametrize("solver", SOLVERS)
def test_force_against_depth(case, solver):
    """The depth that a force leads to, prescribed, gives the force back."""
    rough = surface(**case)
    by_force = rc.press(rough, 1.0, force=1e-3, solver=SOLVERS[solver], tolerance=1e-10)
    by_depth = rc.press(rough, 1.0, depth=by_force.depth, solver=SOLVERS[solver], tolerance=1e-10)
    assert by_depth.depth == by_force.depth
    agree(by_force, by_depth)


def test_pressure_is_force_over_nominal_area():
    rough = surface((40, 60))
    agree(rc.press(rough, 1.0, pressure=1e-3), rc.press(rough, 1.0, force=1e-3 * rough.grid.area))


@pytest.mark.parametrize("force", [1e-5, 1e-3])
@pytest.mark.parametrize("solver", SOLVERS)
def test_window_against_whole_grid(force, solver):
    rough = surface(hurst=1.2)
    whole = WholeGrid(rc.half_space(rough.grid, 1.0))
    settings = {"force": force, "solver": SOLVERS[solver], "tolerance": 1e-10}
    agree(rc.press(rough, 1.0, **settings), rc.press(rough, 1.0, operator=whole, **settings))


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("solver", SOLVERS)
def test_fft_against_dense(periodic, solver):
    rough = surface(periodic=periodic)
    dense = rc.half_space(rough.grid, 1.0, "dense")
    settings = {"force": 2e-3, "solver": SOLVERS[solver], "tolerance": 1e-10}
    agree(rc.press(rough, 1.0, **settings), rc.press(rough, 1.0, operator=dense, **settings))


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_bad_start_does_not_matter(solver):
    """Negative, misplaced, enormous: a start is a guess, and never comes back as an answer."""
    rough = surface()
    truth = rc.press(rough, 1.0, force=1e-3, tolerance=1e-10)
    problem = make_problem(rough, 1.0, rc.Force(1e-3), None, 1e-10)
    rng = np.random.default_rng(0)
    for start in (np.zeros((64, 64)), rng.standard_normal((64, 64)) * 1e6, np.eye(64)):
        agree(truth, solve(problem, solver=SOLVERS[solver], initial=(start, 0.0)))


def test_the_residual_belongs_to_the_returned_pressure():
    """What a solution claims is what its own pressure earns on a whole grid."""
    rough = surface(hurst=0.3)
    for solver in SOLVERS.values():
        solution = rc.press(rough, 1.0, force=5e-3, solver=solver)
        earned = oracles.certificate(rough, 1.0, solution.pressure, solution.depth)
        assert solution.residual == pytest.approx(earned, rel=1e-3, abs=1e-14)


def test_the_method_falls_back_when_flipping_does_not_end(monkeypatch):
    """A run without progress is handed over, and the answer still certified."""
    import roughcontact.contact.active_set as module

    def stuck(operator, region, separation, pressure, displacement, **settings):
        return module_relaxed(pressure, displacement)

    def module_relaxed(pressure, displacement):
        from roughcontact.contact.conjugate_gradient import Relaxed

        return Relaxed(pressure, displacement, 0.0, 1.0, 1)

    monkeypatch.setattr(module, "relax", stuck)
    rough = surface((32, 32))
    solution = rc.press(rough, 1.0, force=1e-3, solver=rc.ActiveSet(dense_limit=0))
    assert oracles.certificate(rough, 1.0, solution.pressure, solution.depth) <= 1e-8
