"""The contract of every solver, on every operator: at 1e-10 they agree to 1e-7 of the largest pressure."""

from dataclasses import dataclass, replace

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.contact.press import make_problem, solve

SOLVERS = {
    "active set": rc.ActiveSet(),
    "active set, conjugate gradients only": rc.ActiveSet(dense_limit=0),
    "Polonsky-Keer": rc.PolonskyKeer(),
}


@dataclass(frozen=True)
class WholeGrid:
    """An operator that does not promise positivity, so that no window may be cut."""

    inner: object

    @property
    def capabilities(self):
        return replace(self.inner.capabilities, positive=False)

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
    rough = surface((40, 44), periodic)
    dense = rc.half_space(rough.grid, 1.0, method="dense")
    settings = {"force": 2e-3, "solver": SOLVERS[solver], "tolerance": 1e-10}
    agree(rc.press(rough, 1.0, **settings), rc.press(rough, 1.0, operator=dense, **settings))


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_bad_start_does_not_matter(solver):
    """Negative, misplaced, enormous: a start is a guess, and never comes back as an answer."""
    rough = surface()
    truth = rc.press(rough, 1.0, force=1e-3, tolerance=1e-10)
    problem = make_problem(rough, 1.0, rc.Force(1e-3), None, tolerance=1e-10)
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
    import roughcontact.solver.active_set as module
    from roughcontact.solver.bound_constrained_cg import InnerSolution

    def stuck(system, conditions, **settings):
        return InnerSolution(system.inner.scatter(system.start), 1)

    monkeypatch.setattr(module, "inner_solve", stuck)
    rough = surface((32, 32))
    solution = rc.press(rough, 1.0, force=1e-3, solver=rc.ActiveSet(dense_limit=0))
    assert oracles.certificate(rough, 1.0, solution.pressure, solution.depth) <= 1e-8


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("solver", SOLVERS)
def test_a_spike_does_not_run_in_circles(periodic, solver):
    """One cell first, all the others at once after it: a common factor on the pressure would alternate."""
    heights = np.zeros((16, 16))
    heights[5, 4] = 1.0
    spike = rc.Surface(heights, rc.Grid((16, 16), 1 / 16, periodic))
    for force in (0.01, 0.05, 0.1, 0.2, 1.0):
        solution = rc.press(spike, 1.0, force=force, solver=SOLVERS[solver])
        assert oracles.certificate(spike, 1.0, solution.pressure, solution.depth) <= 1e-8


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_slender_periodic_grid_at_given_depth(solver):
    heights = 1e-6 * np.random.default_rng(0).standard_normal((1, 12))
    line = rc.Surface(heights, rc.Grid((1, 12), 1.0, True))
    solution = rc.press(line, 1.0, depth=0.8 * (heights.max() - heights.mean()), solver=SOLVERS[solver])
    assert oracles.certificate(line, 1.0, solution.pressure, solution.depth) <= 1e-8
    assert solution.pressure.max() < 1e-4


@dataclass(frozen=True)
class Weighted:
    """A dense operator whose cells have different sizes: symmetric under its weights, and only under them."""

    grid: rc.Grid
    weights: np.ndarray
    kernel: np.ndarray

    def apply(self, pressure):
        return self.kernel @ (self.weights * pressure)

    def as_matrix(self, cells=None):
        matrix = self.kernel * self.weights
        return matrix if cells is None else matrix[np.ix_(cells, cells)]

    def restrict(self, window):
        [part] = window
        return Weighted(self.grid.window(window), self.weights[part], self.kernel[part, part])


def weighted(n=60):
    x = np.linspace(0, 1, n)
    kernel = np.exp(-8 * np.abs(x[:, None] - x))  # positive definite
    return Weighted(rc.Grid(n, 1 / n), (1 + x) / n, kernel), rc.Surface(-((x - 0.4) ** 2), rc.Grid(n, 1 / n))


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_operator_of_the_users_with_varying_weights(solver):
    """Only what the protocol asks for: grid, weights, apply, as_matrix, restrict."""
    operator, profile = weighted()
    solution = rc.press(profile, 1.0, force=0.02, operator=operator, solver=SOLVERS[solver], tolerance=1e-10)
    assert solution.force == pytest.approx(0.02, rel=1e-12)
    assert solution.force == pytest.approx((operator.weights * solution.pressure).sum(), rel=1e-14)
    gap = operator.apply(solution.pressure) - profile.heights + profile.heights.max() - solution.depth
    largest = operator.apply(solution.pressure).max()
    assert np.abs(gap[solution.contact]).max() <= 1e-10 * largest
    assert gap.min() >= -1e-10 * largest
    mean = np.average(gap, weights=operator.weights)
    assert solution.mean_gap == pytest.approx(mean, rel=1e-9)
    assert solution.spots.loads.sum() == pytest.approx(0.02, rel=1e-12)
    assert solution.contact_area == pytest.approx(operator.weights[solution.contact].sum(), rel=1e-14)
    cells = np.flatnonzero(solution.contact)
    tangent = np.linalg.solve(operator.as_matrix(cells), np.ones(len(cells)))
    assert solution.stiffness == pytest.approx(operator.weights[cells] @ tangent, rel=1e-7)


def test_an_indefinite_matrix_is_not_a_crash():
    """Cholesky's method refuses it; the iteration still answers, or says that it has not."""
    operator, profile = weighted()
    bent = Weighted(operator.grid, operator.weights, operator.kernel - 0.05 * np.eye(60))
    solution = solve(make_problem(profile, 1.0, rc.Force(0.02), bent, tolerance=1e-8))
    assert solution.status.converged == (solution.residual <= 1e-8)
