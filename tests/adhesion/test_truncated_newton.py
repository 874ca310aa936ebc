"""The line search of Newton's method: which of the shortened steps it takes."""

from types import SimpleNamespace

import pytest

from roughcontact.adhesion.truncated_newton import ARMIJO, HALVINGS, Counter, line_search


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
