"""Projected conjugate gradients: what steps they take, how many, and where there is nothing to do."""

import math
from itertools import pairwise

import numpy as np
import pytest

import roughcontact as rc
from descents import ESTIMATES, SHAPE, Counted, Start, both_controls, both_kinds, both_planes, within_bounds
from regions import both_of, close, plane, region
from roughcontact.kernels import loader
from roughcontact.solver import tuning
from roughcontact.solver.bound_constrained_cg import CGResult, StepEstimate, bound_constrained_cg
from roughcontact.solver.conjugate_gradients import conjugate_gradients
from roughcontact.solver.inner_operator import FullGrid

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@both_kinds
@both_controls
def test_where_no_bound_is_met_they_are_conjugate_gradients(make, force_given):
    """However far the first step is expected to go; at given displacement those on a region of any sign."""
    operator, kept = plane(SHAPE), region(SHAPE, 4, 0.5)
    lacking, driver = np.random.default_rng(4).standard_normal(SHAPE), FullGrid(operator)
    lacking -= lacking[kept].mean() * force_given
    plain = make(driver, kept, lacking, 1e3 * kept)
    found = []
    for estimate in ESTIMATES:
        fields, counted = make(driver, kept, lacking, 1e3 * kept), Counted(driver)
        found.append(
            bound_constrained_cg(
                counted, fields, estimate, force_given=force_given, self_influence=1.0, limit=0.0, max_steps=6
            )
        )
        assert found[-1].steps == counted.count == 6
        np.testing.assert_array_equal(fields.free > 0, kept)
        if not force_given and estimate is ESTIMATES[0]:
            assert conjugate_gradients(driver, plain, limit=0.0, max_steps=6)[1] == 6
        elif estimate is ESTIMATES[0]:
            plain = fields
        # Sums of 240 terms, in six steps.
        close(fields.correction, plain.correction, np.abs(plain.correction).max(), "float64", 6 * 240)
        assert found[-1].estimate.known
        assert found[-1].estimate.expected == pytest.approx(found[0].estimate.expected, rel=1e-9)
        assert found[-1].residual == pytest.approx(found[0].residual, rel=1e-9)
        assert not force_given or abs(fields.correction.sum()) < 1e-13 * np.abs(fields.correction).sum()


@both_kinds
@both_controls
def test_directions_are_conjugate(make, force_given):
    """Each to the one before, where they have no resultant, too."""
    taken = []

    class Noting(FullGrid):
        def apply(self, pressure):
            taken.append((pressure.copy(), super().apply(pressure)))
            return taken[-1][1]

    kept, lacking = region(SHAPE, 4, 0.5), np.random.default_rng(4).standard_normal(SHAPE)
    start = Start(
        Noting(plane(SHAPE)), kept, 1e3 * kept, lacking - lacking[kept].mean(), force_given, lacking
    )
    start.bound_constrained_cg(start.fields(make), limit=0.0, max_steps=6)
    for (s, u), (t, v) in pairwise(taken):
        assert abs((t * u).sum()) < 1e-12 * math.sqrt((s * u).sum() * (t * v).sum())


@both_planes
@both_controls
def test_both_solve_the_same_system_to_the_same_limit(periodic, force_given):
    operator, kept, limit = plane(SHAPE, periodic), region(SHAPE, 1, 0.5), 1e-9
    lacking = np.random.default_rng(1).standard_normal(SHAPE)
    level = lacking[kept].mean() if force_given else 0.0
    matrix = operator.as_matrix(np.flatnonzero(kept))
    if force_given:  # on pressures without resultant
        apart = np.eye(len(matrix)) - 1 / len(matrix)
        matrix = apart @ matrix @ apart + 1 / len(matrix)
    wanted = np.zeros(SHAPE)
    wanted[kept] = np.linalg.solve(matrix, lacking[kept] - level)
    # The answer is off by no more than the inverse makes of what is lacking.
    bound = np.sqrt(kept.sum()) * limit / np.linalg.eigvalsh(matrix)[0]
    start = Start(FullGrid(operator), kept, 1e3 * kept, lacking, force_given, lacking)
    for fields in both_of(start.driver, kept, lacking, start.base):
        found = start.bound_constrained_cg(fields, limit=limit)
        assert found.residual <= limit
        assert found.steps < 60
        left = start.left(fields)
        assert np.abs(left[kept]).max() < 1.01 * limit
        np.testing.assert_allclose(fields.r - fields.r[kept].mean() * force_given, left, rtol=0, atol=1e-12)
        assert np.linalg.norm(fields.correction - wanted) < bound
        assert (fields.correction[~kept] == 0).all()


@both_kinds
@both_controls
def test_a_descent_goes_on_where_another_left_off(make, force_given):
    """The next direction is conjugate to the last: begun anew, the change after so few steps would be far off."""
    kept, lacking = region(SHAPE, 4, 0.5), np.random.default_rng(4).standard_normal(SHAPE)
    lacking -= lacking[kept].mean() * force_given
    start = Start(FullGrid(plane(SHAPE)), kept, 1e3 * kept, lacking, force_given, lacking)
    one, two, anew = (start.fields(make) for _ in range(3))
    whole = start.bound_constrained_cg(one, limit=0.0, max_steps=6)
    found = CGResult(math.inf, 0, StepEstimate())
    for steps in (2, 3, 1):
        found = start.bound_constrained_cg(two, found.estimate, limit=0.0, max_steps=steps)
    assert found.estimate.expected == pytest.approx(whole.estimate.expected, rel=1e-9)
    close(two.correction, one.correction, np.abs(one.correction).max(), "float64", 6 * 240)
    start.bound_constrained_cg(anew, limit=0.0, max_steps=5)
    anew.s[...] = 0.0
    start.bound_constrained_cg(anew, limit=0.0, max_steps=1)
    assert np.abs(anew.correction - one.correction).max() > 1e-6 * np.abs(one.correction).max()


@both_controls
def test_both_go_as_far_in_single_precision(force_given):
    """Products are in single precision, too: what is left of a lack is known to some units of the first."""
    driver, limit = FullGrid(plane((40, 50)), single=True), 0.1
    kept, rng = region((40, 50), 3, 0.5), np.random.default_rng(3)
    base = (rng.random((40, 50)) * (kept | (rng.random((40, 50)) < 0.02))).astype(np.float32)
    own = driver.operator.as_matrix(np.zeros(1, np.intp))[0, 0]
    lacking = (own * rng.standard_normal((40, 50))).astype(np.float32)
    lacking /= np.abs(lacking[kept]).max()
    base /= own
    for fields in both_of(driver, kept, lacking, base):
        start = Start(driver, kept, base, lacking, force_given, lacking)
        found = start.bound_constrained_cg(fields, StepEstimate(0.4), limit=limit)
        assert found.residual <= limit
        assert fields.correction.dtype == fields.r.dtype == fields.free.dtype == np.float32
        _, free = within_bounds(start, fields, limit)
        assert free.sum() < kept.sum()
        assert np.abs(start.left(fields)[free]).max() < 1.01 * limit


@both_kinds
def test_all_cells_would_pull(make):
    """None is left to take the force: it ends, with what they lack, and nothing has changed."""
    kept, lacking = region(SHAPE, 0, 0.5), np.random.default_rng(0).standard_normal(SHAPE)
    for pull, force_given in ((1e3, True), (1e3, False)):
        start = Start(FullGrid(plane(SHAPE)), kept, -pull * kept, lacking, force_given, lacking)
        fields = start.fields(make)
        if force_given:
            found = start.bound_constrained_cg(fields, limit=1e-3)
            level = lacking[kept].mean()
            assert found == CGResult(pytest.approx(np.abs(lacking[kept] - level).max()), 0, StepEstimate())
            assert not fields.correction.any()
        else:
            # Nobody has to: all go to nothing.
            assert start.bound_constrained_cg(fields, limit=1e-3).residual == 0
            assert np.abs(start.base + fields.correction).max() <= tuning.BOUND_VIOLATION * 1e-3 / start.own
        assert not fields.free.any()
        # Nor is there anything to begin with.
        assert start.bound_constrained_cg(fields, limit=1e-3) == CGResult(0.0, 0, StepEstimate())


@both_kinds
@both_controls
def test_no_more_products_than_are_allowed(make, force_given):
    start = Start.near(5, False, force_given)
    for most in (0, 1, 2):
        fields = start.fields(make)
        found = start.bound_constrained_cg(fields, limit=1e-9, max_steps=most)
        assert found.steps == most
        assert found.estimate.known == (most > 0)
        assert fields.correction.any() == (most > 0)
        assert found.residual < 1 if most else found.residual == pytest.approx(1.0)
    fields = start.fields(make)
    assert start.bound_constrained_cg(fields, limit=math.inf) == CGResult(
        pytest.approx(1.0), 0, StepEstimate()
    )
    assert not fields.correction.any()


@both_kinds
@both_controls
def test_what_is_solved_but_presses_elsewhere_goes_on(make, force_given):
    """Little is lacking where cells are free, and yet there is something to do."""
    kept, zeros = region(SHAPE, 0, 0.5), np.zeros(SHAPE)
    base = np.where(kept, 5.0, 0.0)
    for much in (1.0, 1e-6):
        astray = (~kept).astype(float) * much
        start = Start(FullGrid(plane(SHAPE)), kept, base + astray, zeros, force_given, zeros)
        fields = start.fields(make)
        found = start.bound_constrained_cg(fields, limit=1e-3)
        assert (found.steps > 0) == (much == 1.0)
        within_bounds(start, fields, 1e-3)


@both_kinds
def test_what_is_lacking_alike_is_none(make):
    kept, ones = region(SHAPE, 0, 0.5), np.ones(SHAPE)
    for level in (0.7, -0.1):
        start = Start(FullGrid(plane(SHAPE)), kept, 1.0 * kept, level * ones, True, ones)
        fields = start.fields(make)
        found = start.bound_constrained_cg(fields, limit=1e-9)
        assert found.residual <= 1e-9
        assert np.abs(fields.correction).max() < 1e-9


@both_kinds
@both_controls
@both_planes
def test_a_step_that_is_expected_to_be_far_too_short_is_found_out(make, force_given, periodic):
    """Pressure that is left outside must not pass for what a step does: each product lengthens the next by a tenth."""
    start, short = Start.near(1, periodic, force_given), 1e-5
    expected = start.bound_constrained_cg(start.fields(make), limit=1e-6)
    found = start.bound_constrained_cg(start.fields(make), StepEstimate(short, known=True), limit=1e-6)
    assert found.steps <= 2 * expected.steps - math.log(short) / math.log(tuning.ESTIMATE_AT_BOUNDS[1])
    assert found.residual <= 1e-6
    assert 0.1 < found.estimate.expected < 10


@pytest.mark.parametrize("factor", [-1.0, np.nan])
def test_products_that_come_to_nothing_count(factor):
    start = Start.near(5, False, False)

    class Wrong(FullGrid):
        def apply(self, pressure):
            return factor * super().apply(pressure)

    driver = Counted(Wrong(start.driver.operator))
    found = bound_constrained_cg(
        driver, start.fields(), StepEstimate(), force_given=False, self_influence=1.0, limit=1e-3, max_steps=9
    )
    assert 0 < found.steps == driver.count <= 9


def test_what_is_expected_of_the_next_step():
    """What was best for the last; where that took cells to their bounds, no more than so much from what was known."""
    assert StepEstimate().trial == tuning.TRIAL_STEP
    assert StepEstimate(2.0, known=True).trial == 2 * tuning.TRIAL_STEP
    for best in (0.01, 0.8, 1.05, 30.0):
        for estimate in (StepEstimate(), StepEstimate(7.0)):
            for lifts in (False, True):
                assert estimate.after(best, bounds_matter=lifts) == StepEstimate(best, known=True)
        known = StepEstimate(2.0, known=True)
        for lifts, (least, most) in ((True, tuning.ESTIMATE_AT_BOUNDS), (False, tuning.ESTIMATE_FREE)):
            clipped = min(max(best, least), most)
            assert known.after(2 * best, bounds_matter=lifts) == StepEstimate(2 * clipped, known=True)
    assert (
        tuning.ESTIMATE_FREE[0]
        < tuning.ESTIMATE_AT_BOUNDS[0]
        < 1
        < tuning.ESTIMATE_AT_BOUNDS[1]
        < tuning.ESTIMATE_FREE[1]
    )


@pytest.mark.parametrize("rings", [60, 300])
@pytest.mark.parametrize("force", [0.01, 0.1])
def test_steps_do_not_shrink_where_pressure_is_left_outside(rings, force):
    """Without an inverse many cells go to their bounds for long; thousands of products end in another method."""
    grid = rc.RadialGrid.uniform(rings, 1e3)
    ball = rc.RadialProfile(-(grid.radii**2) / 2e3, grid)
    found = rc.press(ball, 1e-3, force=force * 1e3, solver=rc.ActiveSet(dense_limit=0))
    assert found.steps < 200


def test_short_steps_are_short_though_a_little_is_left_outside():
    """Taken for such as let go of cells, and so made longer than is best, they would go to and fro."""
    rough = rc.self_affine(rc.Grid(352, 1 / 352, True), 0.8, 0.01, np.random.default_rng(11))
    line = rc.line(rough.grid, 1.0)
    assert rc.press(rough, 1.0, force=3e-4, operator=line, solver=rc.ActiveSet(dense_limit=0)).steps < 200
