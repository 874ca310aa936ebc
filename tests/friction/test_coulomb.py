"""Coulomb's law on lists of cells."""

import numpy as np
import pytest

from roughcontact.friction.coulomb import at_limit, lengths, projected, projected_to_force, violations


def draw(seed):
    """Return a traction, its limits and a force that they can hold, of any sizes."""
    rng = np.random.default_rng(seed)
    k, n = rng.integers(1, 3), rng.choice([1, 2, 5, 300])
    limit = 10 ** rng.normal(0, rng.choice([0.1, 1, 3]), n)
    traction = rng.standard_normal((k, n)) * limit * rng.choice([0, 0.5, 1, 10])
    total = rng.standard_normal(k)
    part = rng.choice([0, 0.1, 0.9, 0.9999, 1 - 1e-9])
    return traction, limit, part * total / np.linalg.norm(total) * limit.sum()


def test_the_nearest_traction_that_holds():
    limit = np.array([1.0, 2.0, 0.0])
    np.testing.assert_allclose(
        projected(np.array([[3.0, 0.6, 1.0], [4.0, 0.8, 0.0]]), limit), [[0.6, 0.6, 0], [0.8, 0.8, 0]]
    )
    np.testing.assert_array_equal(projected(np.array([[-3.0, 0.6, 0.0]]), limit), [[-1.0, 0.6, 0.0]])


@pytest.mark.parametrize("seed", range(60))
def test_the_nearest_traction_under_a_force(seed):
    """It holds, has the force, and is that of a common shift: the condition of a projection."""
    traction, limit, total = draw(seed)
    found = projected_to_force(traction, limit, total)
    rounding = 1e-14 * (limit.sum() + np.abs(traction).sum())
    np.testing.assert_allclose(found.sum(axis=1), total, rtol=0, atol=2 * rounding)
    assert (lengths(found) <= limit * (1 + 1e-15)).all()
    free = ~at_limit(found, limit)
    if free.any():
        shift = (traction - found)[:, free].mean(axis=1, keepdims=True)
        np.testing.assert_allclose(found, projected(traction - shift, limit), rtol=0, atol=100 * rounding)


def test_a_traction_under_its_force_stays():
    traction, limit, _ = draw(3)
    traction = projected(traction, limit)
    np.testing.assert_array_equal(projected_to_force(traction, limit, traction.sum(axis=1)), traction)


@pytest.mark.parametrize("seed", range(10))
def test_large_tractions_meet_the_force_as_well(seed):
    """To what the sum of the limits allows, whatever the size of what is projected."""
    traction, limit, total = draw(seed)
    found = projected_to_force(1e6 * traction, limit, total)
    np.testing.assert_allclose(found.sum(axis=1), total, rtol=0, atol=3e-14 * limit.sum())


def test_what_breaks_the_law():
    """Below the limit all slip; at it, what is not opposed to the traction; beyond it, everything."""
    traction = np.array([[0.5, 1.0, 1.0, 1.0, 1.1], [0.0, 0.0, 0.0, 0.0, 0.0]])
    slip = np.array([[-3.0, -3.0, -3.0, 3.0, -3.0], [4.0, 0.0, 4.0, 4.0, 0.0]])
    np.testing.assert_allclose(violations(traction, np.ones(5), slip), [5, 0, 4, 5, np.inf])
    np.testing.assert_allclose(violations(traction[:1], np.ones(5), slip[:1]), [3, 0, 0, 3, np.inf])
