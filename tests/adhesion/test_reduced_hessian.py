"""Stability against dense eigenvalues."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.elastic_form import elastic_form
from roughcontact.adhesion.reduced_hessian import _ritz, smallest_ratio
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
def test_the_smallest_eigenvalue_and_its_bound_on_a_hundred_small_problems(kind):
    rng = np.random.default_rng({"periodic": 1, "free": 2, "ring": 3}[kind])
    for _ in range(34):
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


def test_ritz_pairs_of_independent_fields_are_all_found():
    """With as many fields as unknowns these are the eigenpairs of attraction and elastic body."""
    form = elastic_form(rc.half_space(rc.Grid((2, 3), 1.0), 1.0))
    rng = np.random.default_rng(4)
    unknowns = int(np.prod(form.shape))
    fields, weight = rng.standard_normal((unknowns, *form.shape)), rng.random(form.shape)
    images = np.array([form.stiffness(field) for field in fields])
    coefficients, values = _ritz(form, fields, images, weight * fields)
    assert coefficients.shape == (unknowns, unknowns)
    assert (np.diff(values) >= 0).all()
    for numbers, value in zip(coefficients.T, values, strict=True):
        field = np.tensordot(numbers, fields, 1)
        image = np.tensordot(numbers, images, 1)
        np.testing.assert_allclose(weight * field, (1 - value) * image, atol=1e-9 * np.abs(image).max())


def test_without_attraction_it_is_one():
    form = elastic_form(rc.half_space(rc.Grid((4, 4), 1.0), 1.0))
    found = smallest_ratio(form, np.ones(form.shape, bool), np.zeros(form.shape), Counter())
    assert (found.value, found.bound) == (1.0, 0.0)


@pytest.mark.parametrize("times", [0.5, 1.5], ids=["stable", "unstable"])
def test_a_sign_takes_fewer_products_than_a_value(times):
    """On either side of the curvature at which the smallest eigenvalue is zero."""
    form = elastic_form(rc.half_space(rc.Grid((8, 12), (1.0, 0.5)), 1.0))
    free, curvature = np.ones(form.shape, bool), np.zeros(form.shape)
    curvature[form.inside] = np.random.default_rng(0).random((8, 12)) ** 4
    # The eigenvalues are one less those of the attraction, which are proportional to the curvature.
    curvature *= times / (1 - eigenvalues_by_matrices(form, free, curvature)[0])
    sign, value = Counter(), Counter()
    found = smallest_ratio(form, free, curvature, sign, sign_only=True)
    exact = smallest_ratio(form, free, curvature, value, accuracy=1e-6)
    assert exact.value == pytest.approx(1 - times, abs=1e-6)
    assert (found.value > 0) == (exact.value > 0)
    assert sign.products < value.products / 2
