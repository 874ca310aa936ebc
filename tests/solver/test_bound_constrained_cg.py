"""Projected conjugate gradients: where they end meets the conditions of contact, and the force is kept."""

import math
from itertools import product

import numpy as np
import pytest

from descents import (
    KINDS,
    SHAPE,
    STRIDES,
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
from roughcontact.solver.bound_constrained_cg import LEAST, LEFT, MOST, Descent, Stride
from roughcontact.solver.inner_operator import Plane

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@both_kinds
@both_planes
@both_controls
@pytest.mark.parametrize("stride", STRIDES, ids=str)
def test_conditions_hold_where_it_ends(make, periodic, conserve, stride):
    """Some cells pull, and others have some pressure that is to go."""
    limit = 0.03
    for seed in (2, 5):
        start = Start.near(seed, periodic, conserve)
        fields = start.fields(make)
        found = start.descend(fields, stride, limit=limit)
        assert 0 < found.steps < 20
        assert found.lack <= limit
        p, free = within_bounds(start, fields, limit)
        assert start.base[~start.kept].max() > 10 * np.abs(p[~free]).max()
        assert 0 < free.sum() < start.kept.sum()
        left = start.left(fields)
        assert np.abs(left[free]).max() == pytest.approx(found.lack, rel=0, abs=1e-12)
        np.testing.assert_allclose(fields.r, left, rtol=0, atol=1e-12)  # elsewhere, too


@both_kinds
@both_controls
def test_it_goes_as_far_as_is_asked(make, conserve):
    for seed in range(8):
        start = Start.near(seed, False, conserve)
        fields = start.fields(make)
        found = start.descend(fields, limit=1e-6)
        assert found.lack == np.abs(fields.r * fields.inside).max() <= 1e-6
        _, free = within_bounds(start, fields, 1e-6)
        assert np.abs(start.left(fields) * free).max() <= 1.01e-6


@both_planes
def test_hardly_a_cell_is_let_go_of_that_should_stay(periodic):
    """From about the right pressure on the right cells: no more than a fifth of them, in thirty products."""
    for seed in range(8):
        for make, conserve in product(KINDS.values(), (False, True)):
            for stride in STRIDES[:3]:
                start = Start.near(seed, periodic, conserve, noise=0.1, rim=0.0, strays=0.0)
                fields = start.fields(make)
                assert start.descend(fields, stride, limit=1e-6).steps < 30
                assert fields.inside.sum() > 0.8 * start.kept.sum()


@both_kinds
@both_planes
@both_controls
@pytest.mark.parametrize("stride", STRIDES[:3], ids=str)
def test_by_turns_with_taking_in_it_comes_to_the_contact(make, periodic, conserve, stride):
    """From about the right pressure, to the only one that meets the conditions at the depth that there is then."""
    limit, matrix = 1e-6, matrix_of(periodic)
    for seed in range(1, 5):
        start = Start.near(seed, periodic, conserve, noise=0.1, rim=0.0, strays=0.0)
        fields, worst, found = start.fields(make), math.inf, Descent(math.inf, 0, stride)
        for _ in range(5):
            found = start.descend(fields, found.stride, limit=limit)
            worst = fields.take_in(0.5 * limit)
            if not worst and found.lack <= limit:
                break
        assert not worst
        assert found.lack <= limit
        p, free = start.base + fields.change, fields.inside > 0
        level = start.gap + start.driver.apply(p)
        depth = (
            level[free].mean()
            if conserve
            else (start.lacking + start.gap + start.driver.apply(start.base))[0, 0]
        )
        left = depth - level
        assert np.abs(left[free]).max() <= 1.01 * limit
        assert left[~free].max() <= 0.51 * limit
        assert max(-p.min(), np.abs(p[~free]).max()) <= LEFT * limit / start.own
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
        for stride in STRIDES:
            start = Start.near(seed, periodic, True, noise=0.1, rim=0.05, strays=0.02 * (seed % 2))
            fields = start.fields(make)
            books = Watched(fields, start.driver.weights)
            start.descend(books, stride, limit=1e-6, max_steps=50)
            close(fields.change.sum(), 0.0, books.moved + start.base.sum(), "float64")
            shared += books.shared
    assert shared > 100


@both_kinds
@both_controls
@pytest.mark.parametrize("stride", STRIDES[:3], ids=str)
def test_pressure_outside_goes_most_of_the_way_at_once(make, conserve, stride):
    """Even where that is uphill, and no further than it should; where the force is kept others have it."""
    gap, depth, p = touching(3, False)
    kept, unit = p > 0, 0.2
    astray = ~kept & region(SHAPE, 6, 0.1)
    lacking = depth - gap - (matrix_of(False) @ (p + 0.1 * astray).ravel()).reshape(SHAPE)
    lacking -= lacking[kept].mean() * conserve
    start = Start(Plane(plane(SHAPE)), kept, (p + 0.1 * astray) / unit, lacking / unit, conserve, gap / unit)
    fields = start.fields(make)
    before = fields.excess()
    assert before == 0.1 / unit
    assert start.descend(fields, stride, limit=1e-3, max_steps=1).steps == 1
    left = (start.base + fields.change)[astray] / before
    assert 1 - MOST <= left[0] <= 1 - LEAST
    np.testing.assert_allclose(left, left[0], rtol=1e-12)
    others = ~kept & ~astray
    np.testing.assert_array_equal(fields.change[others], 0.0)
    if conserve:
        close(fields.change.sum(), 0.0, np.abs(fields.change).sum(), "float64")
    else:
        assert fields.change.sum() < 0


@pytest.mark.parametrize("seed", range(4))
@both_controls
def test_cells_reach_the_hardness_and_keep_it(seed, conserve):
    limit = 0.1
    start = Start.near(seed, False, conserve)
    ceiling = 0.6 * start.base.max()
    held = (touching(seed, False)[2] > 0) & (start.base > 0.9 * ceiling)
    base = np.where(held, ceiling, np.minimum(start.base, ceiling))
    start = Start(start.driver, start.kept & ~held, base, start.lacking, conserve, start.gap)
    fields = generic(start.driver, start.kept, start.lacking, base, held, ceiling)
    books = Watched(fields, start.driver.weights)
    found = start.descend(books if conserve else fields, Stride(0.3), limit=limit)
    assert 0 < found.steps < 20
    assert found.lack <= limit
    p, free, least = base + fields.change, fields.inside > 0, LEFT * limit / start.own
    assert fields.held[held].all()
    assert not (fields.held & free).any()
    assert not (held & free).any()
    np.testing.assert_allclose(p[fields.held], ceiling, rtol=0, atol=least)
    np.testing.assert_array_equal(p[held], ceiling)
    assert p.max() <= ceiling + least
    assert p.min() >= -least
    assert np.abs(p[~free & ~fields.held]).max() <= least
    assert np.abs(start.left(fields)[free]).max() < 1.01 * limit
    if conserve:
        close(fields.change.sum(), 0.0, books.moved + base.sum(), "float64")


def test_the_hardness_is_reached():
    """From below, by cells that are free, and by no others."""
    kept = region(SHAPE, 2, 0.3)
    start = Start(Plane(plane(SHAPE)), kept, 0.5 * kept, np.ones(SHAPE), False, np.ones(SHAPE))
    free, hard = (
        generic(start.driver, kept, start.lacking, start.base, ~kept & False, c) for c in (math.inf, 2.0)
    )
    start.descend(free, Stride(0.3), limit=0.05)
    start.descend(hard, Stride(0.3), limit=0.05)
    assert (start.base + free.change).max() > 3.0
    assert hard.held.sum() > 10
    np.testing.assert_allclose(
        (start.base + hard.change)[hard.held], 2.0, rtol=0, atol=LEFT * 0.05 / start.own
    )
    assert (hard.held <= kept).all()
    assert not hard.held[(hard.inside > 0) | (start.base + hard.change < 1.9)].any()
