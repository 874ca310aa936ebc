"""The projection of a pressure onto what a force prescribes."""

import numpy as np
import pytest

from roughcontact.solver.control import Force, Specification
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.projection import project

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
