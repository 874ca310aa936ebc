"""A pressure that no cell exceeds: conditions of contact, limits, stiffness."""

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.solver import plastic as hard
from roughcontact.solver.control import Depth, Force, Specification, State, Status
from roughcontact.solver.nested_iteration import nested_start
from roughcontact.solver.polonsky_keer import PolonskyKeer

MODULUS = 2.0
SOLVERS = {"active set": rc.ActiveSet(), "Polonsky-Keer": rc.PolonskyKeer()}


@pytest.fixture(params=[False, True], ids=["free", "periodic"])
def rough(request):
    grid = rc.Grid((48, 64), (1 / 64, 1 / 64), request.param)
    return rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(4))


@pytest.fixture(params=SOLVERS, ids=str)
def solver(request):
    return SOLVERS[request.param]


def unit(shape):
    """One on the first cell."""
    return (np.arange(np.prod(shape)) == 0).reshape(shape) * 1.0


def violation(solution, hardness):
    """Largest violation of the conditions, by a product of our own, relative to the largest displacement."""
    surface, p = solution.problem.surface, solution.pressure
    u = oracles.displacement(surface.grid, MODULUS, p)
    gap = u + surface.heights.max() - surface.heights - solution.depth
    assert p.min() >= 0
    assert p.max() <= hardness
    wrong = np.where(p > 0, np.abs(gap), -gap)
    wrong = np.where(p == hardness, gap, wrong)
    return wrong.max() / np.abs(u).max()


@pytest.mark.parametrize("hardness", [0.15, 0.05, 0.01])
@pytest.mark.parametrize("load", [{"force": 2e-3}, {"depth": 0.006}], ids=str)
def test_conditions(rough, solver, hardness, load):
    solution = rc.press(rough, MODULUS, **load, hardness=hardness, solver=solver)
    assert solution.status.converged
    assert violation(solution, hardness) < 1.5e-8  # the certificate, and the rounding of another product
    if "force" in load:
        assert solution.force == pytest.approx(load["force"], rel=1e-12)
    assert (solution.pressure == hardness).any()
    assert "they are plastic" in " ".join(solution.notes)


def test_a_hardness_out_of_reach_changes_nothing(rough, solver):
    plain, hard = (rc.press(rough, MODULUS, force=1e-3, solver=solver, hardness=h) for h in (None, 1e6))
    np.testing.assert_allclose(plain.pressure, hard.pressure, rtol=0, atol=1e-6 * plain.pressure.max())
    assert plain.elastic_energy == pytest.approx(hard.elastic_energy, rel=1e-6)


@pytest.mark.parametrize("share", [0.1, 0.7])
def test_a_soft_body_is_cut_off(rough, share):
    """Next to no elasticity: area = F/hardness, where the surface stands highest (bearing area)."""
    hardness = 1e-8
    count = share * rough.grid.size
    solution = rc.press(rough, MODULUS, force=hardness * count * rough.grid.cell_area, hardness=hardness)
    lowest = np.sort((rough.heights.max() - rough.heights).ravel())
    assert solution.contact.sum() == np.ceil(count)
    # The displacement, of order hardness times length over modulus, is all that tells the depth from the cut.
    assert solution.depth == pytest.approx(lowest[int(count)], abs=hardness)


def test_stiffness_is_that_of_the_cells_that_do_not_give_way(rough):
    """dF/dd at fixed sets, by a difference so small that no cell changes sides."""
    hardness, depth, step = 0.2, 0.008, 1e-9
    at, deeper = (
        rc.press(rough, MODULUS, depth=d, hardness=hardness, tolerance=1e-13) for d in (depth, depth + step)
    )
    for state in (lambda s: s.contact, lambda s: s.pressure == hardness):
        np.testing.assert_array_equal(state(at), state(deeper))
    # Both forces are good to the certificate, 1e-13 of the largest displacement, over a step of 1e-9 / 0.008.
    assert (deeper.force - at.force) / step == pytest.approx(at.stiffness, rel=1e-5)


def test_softer_is_deeper(rough):
    depths = [rc.press(rough, MODULUS, force=2e-3, hardness=h).depth for h in (1.0, 0.3, 0.1, 0.03)]
    assert (np.diff(depths) > 0).all()


def test_a_curve(rough):
    curve = rc.loading_curve(rough, MODULUS, forces=np.geomspace(1e-4, 1e-2, 8), hardness=0.1)
    assert all(status.converged for status in curve.status)
    assert (np.diff(curve.depth) > 0).all()
    assert (curve.contact_area >= curve.force / 0.1 * (1 - 1e-12)).all()
    one = rc.press(rough, MODULUS, force=curve.force[5], hardness=0.1)
    assert curve.depth[5] == pytest.approx(one.depth, rel=1e-6)
    assert curve.stiffness[5] == pytest.approx(one.stiffness, rel=1e-6)


def test_a_curve_goes_on_beyond_full_contact():
    """Full contact of a period is infinitely stiff; where cells then are plastic, the stiffness begins anew."""
    grid = rc.Grid((16, 16), 1 / 16, True)
    wavy = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    full = rc.press(wavy, MODULUS, pressure=10.0).pressure - 10.0  # about its mean
    hardness = np.ptp(full) * 1.5
    pressures = np.array([1.1 * -full.min(), hardness - 0.5 * full.max()])
    curve = rc.loading_curve(wavy, MODULUS, pressures=pressures, hardness=hardness)
    one = rc.press(wavy, MODULUS, pressure=pressures[1], hardness=hardness)
    assert all(status.converged for status in curve.status)
    assert curve.stiffness[0] == np.inf
    assert 0 < curve.stiffness[1] < np.inf
    assert curve.stiffness[1] == pytest.approx(one.stiffness, rel=1e-6)


@pytest.mark.parametrize("kind", ["ring", "line", "foundation"])
def test_on_other_operators(kind, solver):
    if kind == "ring":
        grid = rc.RadialGrid.uniform(80, 1.0)
        body, operator = rc.RadialProfile(-(grid.radii**2) / 2, grid), rc.ring(grid, MODULUS)
    else:
        grid = rc.Grid(80, 1 / 80)
        body = rc.Surface(-((grid.coordinates[0] - 0.5) ** 2) / 2, grid)
        operator = rc.line(grid, MODULUS) if kind == "line" else rc.foundation(grid, MODULUS)
    plain = rc.press(body, MODULUS, depth=0.05, operator=operator, solver=solver)
    hardness = plain.pressure.max() / 2
    solution = rc.press(body, MODULUS, depth=0.05, operator=operator, solver=solver, hardness=hardness)
    assert solution.pressure.max() == hardness
    assert 0 < solution.force < plain.force


def grooved(shape, wave):
    """Half of every `wave` columns stand by 1 above the others."""
    heights = np.where(np.indices(shape)[1] % wave < wave // 2, 1.0, 0.0)
    return rc.Surface(heights, rc.Grid(shape, 1.0, True))


@pytest.mark.parametrize(
    ("depth", "hardness"),
    [
        (0.54, 0.364 * MODULUS),  # crests flow: with too long a step crests and grooves took turns
        (0.6, 0.25 * MODULUS),
        (0.5001, 4 * MODULUS),  # all but some cells are elastic: a constant pressure moves next to nothing
        (0.500001, 4 * MODULUS),
    ],
)
@pytest.mark.parametrize(("shape", "wave"), [((16, 16), 16), ((8, 32), 32)], ids=str)
def test_deeper_than_full_contact(shape, wave, depth, hardness, solver):
    """Beyond the mean separation, 0.5, only plastic cells let an elastic period go deeper."""
    grooves = grooved(shape, wave)
    solution = rc.press(grooves, MODULUS, depth=depth, hardness=hardness, solver=solver)
    assert violation(solution, hardness) < 1.5e-8
    assert (solution.pressure == hardness).any()
    assert solution.steps < 500  # where those took more than 1000 they did not converge


def test_nested_grids_are_asked_for_no_more_than_an_elastic_answer_has():
    grid = rc.Grid((80, 80), 1 / 80, True)
    wavy = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(4))
    body, separation = rc.half_space(grid, MODULUS), wavy.heights.max() - wavy.heights
    depths = separation.mean(), 1.2 * separation.mean()
    full, deeper = (nested_start(body, separation, Depth(depth), rc.ActiveSet()) for depth in depths)
    np.testing.assert_array_equal(full[0], deeper[0])
    assert full[1] == deeper[1]


@pytest.mark.parametrize("missing", [1e-6, 1e-9])
@pytest.mark.parametrize(("shape", "wave"), [((16, 16), 16), ((8, 32), 32)], ids=str)
def test_displacements_far_below_the_heights(shape, wave, missing, solver):
    """Crests and grooves bear nearly the same: what is left to solve lies below the rounding of the heights."""
    grooves, hardness = grooved(shape, wave), 1e-3 * MODULUS
    solution = rc.press(grooves, MODULUS, pressure=hardness * (1 - missing), hardness=hardness, solver=solver)
    crests = grooves.heights == 1
    np.testing.assert_array_equal(solution.pressure[crests], hardness)
    # All grooves lie equally deep: their displacement is one number, to the certificate and its rounding.
    u, alone = (oracles.displacement(grooves.grid, MODULUS, p) for p in (solution.pressure, unit(shape)))
    rounding = 16 * np.finfo(float).eps * hardness * alone.max()
    assert np.ptp(u[~crests]) <= 2 * (1e-8 * np.abs(u).max() + rounding)
    assert solution.depth == pytest.approx(
        1 + u[~crests].mean(), abs=1e-15
    )  # to some units in its last place
    assert solution.steps < 500


def test_a_periodic_body_that_gives_way_has_no_deepest_depth():
    grid = rc.Grid((8, 8), 0.1, True)
    wavy = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    solution = rc.press(wavy, MODULUS, depth=0.1, hardness=0.01)
    assert (solution.pressure == 0.01).all()
    assert solution.stiffness == 0.0


@pytest.mark.parametrize(
    ("hardness", "message"),
    [(0.0, "positive"), (-1.0, "positive"), (np.nan, "positive"), (1e-3, "all measured cells can carry")],
)
def test_nonsense_is_refused(rough, hardness, message):
    with pytest.raises(ValueError, match=message):
        rc.press(rough, MODULUS, force=1e-2, hardness=hardness)


@pytest.mark.parametrize("seed", range(30))
def test_random_problems(seed):
    """Free and periodic, missing cells, soft to nearly elastic, both controls: all certified."""
    rng = np.random.default_rng(seed)
    grid = rc.Grid(tuple(rng.integers(2, 24, 2)), tuple(rng.uniform(0.02, 0.1, 2)), bool(rng.integers(2)))
    heights = 0.02 * rng.standard_normal(grid.shape)
    heights[rng.random(grid.shape) < 0.1] = np.nan
    heights.flat[0] = 0.05
    surface = rc.Surface(heights, grid)
    measured = np.isfinite(heights).sum() * grid.cell_area
    hardness = 10 ** rng.uniform(-4, 0)
    load = (
        {"force": rng.uniform(0, 0.99) * hardness * measured}
        if rng.integers(2)
        else {"depth": rng.uniform(0, 0.06)}
    )
    solution = rc.press(surface, MODULUS, **load, hardness=hardness)
    u = oracles.displacement(grid, MODULUS, solution.pressure)
    gap = u + np.nanmax(heights) - heights - solution.depth
    p = solution.pressure
    wrong = np.where(p == hardness, gap, np.where(p > 0, np.abs(gap), -gap))
    assert np.nanmax(wrong) <= 2e-8 * np.abs(u).max()


def test_a_flat_body_by_the_depth_that_carries_the_force(monkeypatch):
    """At depth 0 a flat surface bears everywhere and carries nothing: the search must begin below it."""
    grid = rc.Grid((8, 8), 1.0)
    flat, force, hardness = rc.Surface(np.zeros((8, 8)), grid), 0.9 * 64 * 1e-3, 1e-3
    plain = rc.press(flat, MODULUS, force=force, hardness=hardness)
    spec = Specification(Force(force), hardness=hardness)
    elastic = rc.press(flat, MODULUS, force=force).pressure
    circling = State(elastic, 0.0, 1.0, 0, Status.STAGNATED)
    run = PolonskyKeer.run

    def at_depth_only(self, operator, separation, spec, initial):
        return circling if spec.depth is None else run(self, operator, separation, spec, initial)

    monkeypatch.setattr(PolonskyKeer, "run", at_depth_only)
    half = rc.half_space(grid, MODULUS)
    pressure, _ = hard._by_depth(half, np.zeros((8, 8)), spec, PolonskyKeer())
    assert pressure.sum() == pytest.approx(force, rel=1e-8)
    np.testing.assert_allclose(pressure, plain.pressure, rtol=1e-6)
    monkeypatch.undo()
    with pytest.raises(rc.ConvergenceError):
        rc.press(flat, MODULUS, force=force, hardness=hardness, solver=rc.ActiveSet(max_steps=1))


@pytest.mark.parametrize("steps", [1, 2, 3])
def test_too_few_steps_to_find_a_depth(steps):
    rough = rc.self_affine(rc.Grid((16, 16), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    with pytest.raises(rc.ConvergenceError):
        rc.press(rough, 1e9, force=1e-4, hardness=1e7, solver=rc.ActiveSet(max_steps=steps))


def test_the_depth_is_sought_soon_where_the_projection_comes_no_nearer(rough, monkeypatch):
    """No residual is zero: the first run ends by its patience, long before the last."""
    ends = []
    run = PolonskyKeer.run

    def spied(self, operator, separation, spec, initial):
        state = run(self, operator, separation, spec, initial)
        if spec.depth is None:
            ends.append(state)
        return state

    monkeypatch.setattr(PolonskyKeer, "run", spied)
    monkeypatch.setattr(hard.tuning, "DEPTH_TRIALS", 1)
    operator = rc.half_space(rough.grid, MODULUS)
    separation = rough.heights.max() - rough.heights
    spec = Specification(Force(2e-3), tolerance=0.0, hardness=0.05)
    hard.press_plastic(operator, separation, spec, np.zeros(rough.grid.shape), 20000)
    first, last = ends
    assert first.status is last.status is Status.STAGNATED
    assert first.steps < 500 < last.steps
    with pytest.raises(ValueError, match="patience"):
        PolonskyKeer(patience=0)


@pytest.mark.parametrize("share", [0.5, 0.2, 0.05])
@pytest.mark.parametrize("load", [{"force": 3e-3}, {"depth": 0.02}], ids=str)
def test_soft_bodies_take_few_products(share, load):
    """The plastic cells are found as those in contact are; the projected method takes thousands."""
    grid = rc.Grid((128, 128), 1 / 128)
    rough = rc.self_affine(grid, hurst=0.7, rms=0.01, rng=np.random.default_rng(0))
    slope = np.sqrt(sum(np.mean(d**2) for d in np.gradient(rough.heights, 1 / 128)))
    iterative = rc.ActiveSet(dense_limit=0)
    soft = rc.press(rough, 1.0, **load, hardness=share * slope, solver=iterative)
    assert soft.steps < 300  # the search for a depth that carries the force took up to 20 000
    assert (soft.pressure == share * slope).sum() > 100
