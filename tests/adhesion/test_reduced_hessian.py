"""Stability against dense eigenvalues."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.elastic_form import elastic_form
from roughcontact.adhesion.reduced_hessian import smallest_ratio
from roughcontact.adhesion.truncated_newton import Counter
from sticking import eigenvalues_by_matrices


def problem(kind, rng):
    if kind == "ring":
        body = rc.ring(rc.RadialGrid.uniform(30, radius=30.0), 1.0)
    else:
        shape = tuple(rng.integers(4, 8, 2).tolist())
        body = rc.half_space(rc.Grid(shape, 1.0, kind == "periodic"), 1.0)
    form = elastic_form(body)
    free = rng.random(form.shape) < rng.uniform(0.3, 1.0)
    curvature = np.zeros(form.shape)
    curvature[form.inside] = 10 ** rng.uniform(-2, 0.3) * rng.random(body.grid.shape) ** 4
    if not free.all():
        return form, free, curvature
    free.flat[0] = False
    return form, free, curvature


@pytest.mark.parametrize("kind", ["periodic", "free", "ring"])
def test_the_smallest_eigenvalue_and_its_bound_on_two_hundred_small_problems(kind):
    rng = np.random.default_rng({"periodic": 1, "free": 2, "ring": 3}[kind])
    for _ in range(67):
        form, free, curvature = problem(kind, rng)
        values = eigenvalues_by_matrices(form, free, curvature)
        wanted = values[0]
        found = [smallest_ratio(form, free, curvature, Counter(), seed=seed) for seed in (0, 1)]
        best = min(found, key=lambda ritz: ritz.value)
        assert best.value >= wanted - 1e-9  # a Ritz value is never below the smallest eigenvalue
        assert best.value <= wanted + 1e-3  # the accuracy that is asked for
        assert best.bound <= 1e-3
        for ritz in found:  # what its bound says, of some eigenvalue
            assert np.abs(values - ritz.value).min() <= ritz.bound + 1e-9


def test_without_attraction_it_is_one():
    form = elastic_form(rc.half_space(rc.Grid((4, 4), 1.0), 1.0))
    found = smallest_ratio(form, np.ones(form.shape, bool), np.zeros(form.shape), Counter())
    assert (found.value, found.bound) == (1.0, 0.0)
