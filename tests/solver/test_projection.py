"""The projection of a pressure onto what a force prescribes."""

import numpy as np
import pytest

from roughcontact.solver.control import Force, Specification
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.projection import _nearest, project

RNG = np.random.default_rng(4)
AREAS = {"alike": 0.25, "rings": RNG.uniform(0.5, 2.0, 40)}


@pytest.mark.parametrize("areas", AREAS.values(), ids=AREAS)
@pytest.mark.parametrize("share", [0.1, 0.6])
def test_a_pressure_that_is_too_large_becomes_the_nearest_one_of_the_force(areas, share):
    """The conditions of the minimum: all loaded cells lose the same, others no more than that."""
    pressure = np.where(RNG.random(40) < 0.7, RNG.uniform(0.0, 1.0, 40), 0.0)
    measure = Measure(areas)
    force = share * measure.total(pressure)
    found = project(measure, pressure, np.zeros(40), Specification(Force(force)))
    assert measure.total(found) == pytest.approx(force, rel=1e-14)
    lost, loaded = pressure - found, found > 0
    assert 0 < loaded.sum() < (pressure > 0).sum()
    np.testing.assert_allclose(lost[loaded], lost[loaded][0], rtol=1e-13)
    assert (lost[~loaded] <= lost[loaded][0]).all()


def test_a_pressure_that_is_too_small_is_scaled():
    pressure = RNG.uniform(0.0, 1.0, 40)
    force = 2 * 0.25 * pressure.sum()
    found = project(Measure(0.25), pressure, np.zeros(40), Specification(Force(force)))
    np.testing.assert_allclose(found, 2 * pressure, rtol=1e-14)


def test_the_nearest_open_cells_bear_twice_what_is_missing():
    """On cells of 0.25 with a hardness of 2 each bears 0.5: for 1.5 six cells, not those that touch or are missing."""
    gap = RNG.permutation(np.arange(40.0))
    pressure = np.where(gap < 5, 1.0, 0.0)
    gap[gap == 7] = np.inf
    spec = Specification(Force(1.0), hardness=2.0)
    found = _nearest(Measure(0.25), gap, pressure, spec, 1.5)
    assert sorted(gap[found]) == [5, 6, 8, 9, 10, 11]
