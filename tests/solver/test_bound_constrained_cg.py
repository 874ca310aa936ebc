"""Projected conjugate gradients: where they end meets the conditions of contact, and the force is kept."""

import math
from itertools import product

import numpy as np
import pytest

from descents import (
    ESTIMATES,
    KINDS,
    SHAPE,
    Start,
    Watched,
    both_controls,
    both_kinds,
    both_planes,
    matrix_of,
    pressed,
    touching,
    within_bounds,
)
from regions import close, generic, plane, region
from roughcontact.kernels import loader
from roughcontact.solver import tuning
from roughcontact.solver.bound_constrained_cg import CGResult, StepEstimate
from roughcontact.solver.inner_operator import FullGrid

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@both_kinds
@both_planes
@both_controls
@pytest.mark.parametrize("estimate", ESTIMATES, ids=str)
def test_conditions_hold_where_it_ends(make, periodic, force_given, estimate):
    """Some cells pull, and others have some pressure that is to go."""
    limit = 0.03
    for seed in (2, 5):
        start = Start.near(seed, periodic, force_given)
        fields = start.fields(make)
        found = start.bound_constrained_cg(fields, estimate, limit=limit)
        assert 0 < found.steps < 20
        assert found.residual <= limit
        p, free = within_bounds(start, fields, limit)
        assert start.base[~start.kept].max() > 10 * np.abs(p[~free]).max()
        assert 0 < free.sum() < start.kept.sum()
        left = start.left(fields)
        assert np.abs(left[free]).max() == pytest.approx(found.residual, rel=0, abs=1e-12)
        np.testing.assert_allclose(fields.r, left, rtol=0, atol=1e-12)  # elsewhere, too


@both_kinds
@both_controls
def test_it_goes_as_far_as_is_asked(make, force_given):
    for seed in range(8):
        start = Start.near(seed, False, force_given)
        fields = start.fields(make)
        found = start.bound_constrained_cg(fields, limit=1e-6)
        assert found.residual == np.abs(fields.r * fields.free).max() <= 1e-6
        _, free = within_bounds(start, fields, 1e-6)
        assert np.abs(start.left(fields) * free).max() <= 1.01e-6


@both_planes
def test_hardly_a_cell_is_let_go_of_that_should_stay(periodic):
    """From about the right pressure on the right cells: no more than a fifth of them, in thirty products."""
    for seed in range(8):
        for make, force_given in product(KINDS.values(), (False, True)):
            for estimate in ESTIMATES[:3]:
                start = Start.near(seed, periodic, force_given, noise=0.1, rim=0.0, strays=0.0)
                fields = start.fields(make)
                assert start.bound_constrained_cg(fields, estimate, limit=1e-6).steps < 30
                assert fields.free.sum() > 0.8 * start.kept.sum()


@both_kinds
@both_planes
@both_controls
@pytest.mark.parametrize("estimate", ESTIMATES[:3], ids=str)
def test_by_turns_with_taking_in_it_comes_to_the_contact(make, periodic, force_given, estimate):
    """From about the right pressure, to the only one that meets the conditions at the depth that there is then."""
    limit, matrix = 1e-6, matrix_of(periodic)
    for seed in range(1, 5):
        start = Start.near(seed, periodic, force_given, noise=0.1, rim=0.0, strays=0.0)
        fields, worst, found = start.fields(make), math.inf, CGResult(math.inf, 0, estimate)
        for _ in range(5):
            found = start.bound_constrained_cg(fields, found.estimate, limit=limit)
            worst = fields.free_violated(0.5 * limit)
            if not worst and found.residual <= limit:
                break
        assert not worst
        assert found.residual <= limit
        p, free = start.base + fields.correction, fields.free > 0
        level = start.gap + start.driver.apply(p)
        depth = (
            level[free].mean()
            if force_given
            else (start.lacking + start.gap + start.driver.apply(start.base))[0, 0]
        )
        left = depth - level
        assert np.abs(left[free]).max() <= 1.01 * limit
        assert left[~free].max() <= 0.51 * limit
        assert max(-p.min(), np.abs(p[~free]).max()) <= tuning.BOUND_VIOLATION * limit / start.own
        wanted = pressed(periodic, start.gap, depth)
        # The product of what two pressures are apart with its image is that with what each lacks, and no more than
        # the limit on each cell, and what is left of pressure times the gap there.
        some = ((p != 0) | (wanted > 0)).ravel()
        softest = np.linalg.eigvalsh(matrix[np.ix_(some, some)])[0]
        gaps = np.abs(depth - start.gap - start.driver.apply(wanted)) + np.abs(left)
        remains = (np.where(free, np.maximum(-p, 0), np.abs(p)) * gaps).sum()
        bound = math.sqrt(some.sum()) * limit / softest + math.sqrt(remains / softest)
        assert np.linalg.norm(p - wanted) < bound < 0.01 * np.linalg.norm(wanted)


@both_kinds
@both_planes
def test_the_force_is_kept(make, periodic):
    """What bounds add to it is shared out at once."""
    shared = 0
    for seed in range(10):
        for estimate in ESTIMATES:
            start = Start.near(seed, periodic, True, noise=0.1, rim=0.05, strays=0.02 * (seed % 2))
            fields = start.fields(make)
            books = Watched(fields, start.driver.weights)
            start.bound_constrained_cg(books, estimate, limit=1e-6, max_steps=50)
            close(fields.correction.sum(), 0.0, books.moved + start.base.sum(), "float64")
            shared += books.shared
    assert shared > 100


@both_kinds
@both_controls
@pytest.mark.parametrize("estimate", ESTIMATES[:3], ids=str)
def test_pressure_outside_goes_most_of_the_way_at_once(make, force_given, estimate):
    """Even where that is uphill, and no further than it should; where the force is kept others have it."""
    gap, depth, p = touching(3, False)
    kept, unit = p > 0, 0.2
    astray = ~kept & region(SHAPE, 6, 0.1)
    lacking = depth - gap - (matrix_of(False) @ (p + 0.1 * astray).ravel()).reshape(SHAPE)
    lacking -= lacking[kept].mean() * force_given
    start = Start(
        FullGrid(plane(SHAPE)), kept, (p + 0.1 * astray) / unit, lacking / unit, force_given, gap / unit
    )
    fields = start.fields(make)
    before = fields.bound_violation()
    assert before == 0.1 / unit
    assert start.bound_constrained_cg(fields, estimate, limit=1e-3, max_steps=1).steps == 1
    left = (start.base + fields.correction)[astray] / before
    assert 1 - tuning.LONGEST_STEP <= left[0] <= 1 - tuning.SHORTEST_STEP
    np.testing.assert_allclose(left, left[0], rtol=1e-12)
    others = ~kept & ~astray
    np.testing.assert_array_equal(fields.correction[others], 0.0)
    if force_given:
        close(fields.correction.sum(), 0.0, np.abs(fields.correction).sum(), "float64")
    else:
        assert fields.correction.sum() < 0


@pytest.mark.parametrize("seed", range(4))
@both_controls
def test_cells_reach_the_hardness_and_keep_it(seed, force_given):
    limit = 0.1
    start = Start.near(seed, False, force_given)
    ceiling = 0.6 * start.base.max()
    held = (touching(seed, False)[2] > 0) & (start.base > 0.9 * ceiling)
    base = np.where(held, ceiling, np.minimum(start.base, ceiling))
    start = Start(start.driver, start.kept & ~held, base, start.lacking, force_given, start.gap)
    fields = generic(start.driver, start.kept, start.lacking, base, held, ceiling)
    books = Watched(fields, start.driver.weights)
    found = start.bound_constrained_cg(books if force_given else fields, StepEstimate(0.3), limit=limit)
    assert 0 < found.steps < 20
    assert found.residual <= limit
    p, free, least = base + fields.correction, fields.free > 0, tuning.BOUND_VIOLATION * limit / start.own
    assert fields.upper[held].all()
    assert not (fields.upper & free).any()
    assert not (held & free).any()
    np.testing.assert_allclose(p[fields.upper], ceiling, rtol=0, atol=least)
    np.testing.assert_array_equal(p[held], ceiling)
    assert p.max() <= ceiling + least
    assert p.min() >= -least
    assert np.abs(p[~free & ~fields.upper]).max() <= least
    assert np.abs(start.left(fields)[free]).max() < 1.01 * limit
    if force_given:
        close(fields.correction.sum(), 0.0, books.moved + base.sum(), "float64")


def test_the_hardness_is_reached():
    """From below, by cells that are free, and by no others."""
    kept = region(SHAPE, 2, 0.3)
    start = Start(FullGrid(plane(SHAPE)), kept, 0.5 * kept, np.ones(SHAPE), False, np.ones(SHAPE))
    free, hard = (
        generic(start.driver, kept, start.lacking, start.base, ~kept & False, c) for c in (math.inf, 2.0)
    )
    start.bound_constrained_cg(free, StepEstimate(0.3), limit=0.05)
    start.bound_constrained_cg(hard, StepEstimate(0.3), limit=0.05)
    assert (start.base + free.correction).max() > 3.0
    assert hard.upper.sum() > 10
    np.testing.assert_allclose(
        (start.base + hard.correction)[hard.upper],
        2.0,
        rtol=0,
        atol=tuning.BOUND_VIOLATION * 0.05 / start.own,
    )
    assert (hard.upper <= kept).all()
    assert not hard.upper[(hard.free > 0) | (start.base + hard.correction < 1.9)].any()
