"""Newton's method: which of the shortened steps it takes, and its linear systems against matrices."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.elastic_form import elastic_form
from roughcontact.adhesion.exponential_law import ExponentialLaw
from roughcontact.adhesion.gap_energy import GapEnergy
from roughcontact.adhesion.truncated_newton import (
    ARMIJO,
    HALVINGS,
    Counter,
    conjugate_gradients,
    line_search,
    minimise,
)


def searched(value, slope):
    """Search from 0 along a step of 1 in an energy of one displacement; return where it ends, and the products."""

    def at(x):
        return SimpleNamespace(displacement=x, reaction=slope)

    energy = SimpleNamespace(
        feasible=lambda x: x,
        at=at,
        change=lambda old, new: value(new.displacement) - value(old.displacement),
        form=SimpleNamespace(dot=lambda a, b: a * b),
    )
    counter = Counter()
    found = line_search(energy, at(0.0), 1.0, counter)
    return None if found is None else (found[0].displacement, found[1]), counter.products


@pytest.mark.parametrize("unit", [1.0, 2.0**-50])
def test_it_halves_the_step_until_the_energy_falls(unit):
    # x^2/2 - x/8 falls along the step up to 1/4, where it is as low as at the start.
    found, products = searched(lambda x: unit * (x**2 / 2 - x / 8), -unit / 8)
    assert found == (0.125, -unit / 128)
    assert products == 4


def test_a_fall_that_is_small_beside_the_slope_is_not_enough():
    # At the full step the energy falls by half of what is asked for.
    found, products = searched(lambda x: -x + (1 - ARMIJO / 2) * x**2, -1.0)
    assert found == (0.5, -0.5 + (1 - ARMIJO / 2) / 4)
    assert products == 2


def test_uphill_it_goes_nowhere_though_the_energy_falls_beyond():
    def hill(x):
        return (x - (1 - ARMIJO / 2) * x**2) / 4

    assert searched(hill, 0.25) == (None, HALVINGS)
    assert hill(2.0) < 0 < hill(1.0) < ARMIJO / 4


def system(periodic, scale):
    """Return a form that counts its products, some free cells, curvatures up to `scale`, a load, and the count."""
    rng = np.random.default_rng(2)
    form = elastic_form(rc.half_space(rc.Grid((6, 8), (1.0, 0.5), periodic), 2.0))
    products = []

    def counted(function):
        return lambda field: (products.append(1), function(field))[1]

    form = replace(form, stiffness=counted(form.stiffness), compliance=counted(form.compliance))
    free = rng.random(form.shape) < 0.7
    return form, free, scale * rng.random(form.shape), 5.0 + rng.standard_normal(form.shape), products


@pytest.mark.parametrize("periodic", [False, True])
def test_a_linear_system_is_solved_on_the_free_cells(periodic):
    """With a prescribed mean displacement a constant part of the load is balanced, whatever its size."""
    form, free, diagonal, load, products = system(periodic, 0.1)
    counter = Counter()
    x, negative = conjugate_gradients(form, free, diagonal, load, 1e-12, counter)
    assert not negative
    assert counter.products == len(products)
    assert (x[~free] == 0).all()
    units = np.eye(free.size).reshape(-1, *free.shape)
    matrix = np.array([form.stiffness(unit).ravel() for unit in units]).T - np.diag(diagonal.ravel())
    kept = free.ravel()
    matrix, right = matrix[np.ix_(kept, kept)], load[free]
    if periodic:  # with the multiplier of the mean
        one = np.ones((len(right), 1))
        matrix, right = np.block([[matrix, one], [one.T, np.zeros((1, 1))]]), np.append(right, 0.0)
    exact = np.linalg.solve(matrix, right)[: kept.sum()]
    np.testing.assert_allclose(x[free], exact, rtol=0, atol=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("periodic", [False, True])
def test_negative_curvature_is_told(periodic):
    form, free, diagonal, load, _ = system(periodic, 100.0)
    assert conjugate_gradients(form, free, diagonal, load, 1e-12, Counter())[1]


def test_where_the_energy_is_not_convex_it_goes_on_unless_it_is_told_to_stop():
    """A flat body within reach of an attraction whose curvature, 11, exceeds the stiffness of its waves."""
    form = elastic_form(rc.half_space(rc.Grid((6, 8), 1.0), 1.0))
    separation = 0.5 + 0.1 * np.random.default_rng(1).random((6, 8))
    energy = GapEnergy(form, ExponentialLaw(1.0, 0.3), form.extended(-separation, -np.inf))
    start = np.zeros(form.shape)
    end = minimise(energy, start, Counter())
    assert end.converged
    assert end.lost > 0
    assert np.count_nonzero(end.point.gap <= 0) > 24
    assert not minimise(energy, start, Counter(), convex_only=True).converged
