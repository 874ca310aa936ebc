"""Conductance from stiffness and back: round spots, unequal bodies, limits and domains."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.joints import conductance
from roughcontact.theory.law import LoadingLaw

MODULUS = 1.1e11
POWER = LoadingLaw("power", "test", {"stiffness": lambda f: 3e6 * f**0.6})


@pytest.mark.parametrize("radius", [1e-6, 3e-3])
def test_round_spot_electrical(radius):
    # Each side of a spot has rho/(4a); k = 2 E* a.
    pair = (1.7e-8, 9.8e-8)
    value = conductance.electrical(2 * MODULUS * radius, MODULUS, pair)
    assert conductance.resistance(value) == pytest.approx(sum(pair) / (4 * radius), rel=1e-14)


@pytest.mark.parametrize("radius", [1e-6, 3e-3])
def test_round_spot_thermal(radius):
    # Each side of a spot has 1/(4 lambda a).
    pair = (400.0, 16.0)
    value = conductance.thermal(2 * MODULUS * radius, MODULUS, pair)
    assert conductance.resistance(value) == pytest.approx((1 / 400 + 1 / 16) / (4 * radius), rel=1e-14)


def test_unequal_conductivities():
    # The page's numbers: lambda 1 and 1/9, harmonic mean 0.2.
    assert conductance.harmonic_mean((1.0, 1 / 9)) == pytest.approx(0.2, rel=1e-14)
    assert conductance.thermal(1.0, 1.0, (1.0, 1 / 9)) == pytest.approx(0.2, rel=1e-14)


def test_limits():
    assert conductance.thermal(1.0, 1.0, (5.0, 0.0)) == 0
    assert conductance.thermal(1.0, 1.0, (5.0, math.inf)) == 10
    assert conductance.electrical(1.0, 1.0, (0.5, math.inf)) == 0
    assert conductance.electrical(1.0, 1.0, (0.5, 0.0)) == 4
    assert conductance.electrical(math.inf, 1.0, (0.5, 0.5)) == math.inf
    assert conductance.resistance(0.0) == math.inf


def test_back():
    k = np.geomspace(1.0, 1e9, 7)
    electric = conductance.electrical(k, MODULUS, (2e-8, 5e-8))
    assert conductance.stiffness_from_electrical(electric, MODULUS, (2e-8, 5e-8)) == pytest.approx(
        k, rel=1e-14
    )
    heat = conductance.thermal(k, MODULUS, (50.0, 200.0))
    assert conductance.stiffness_from_thermal(heat, MODULUS, (50.0, 200.0)) == pytest.approx(k, rel=1e-14)


def test_electrical_and_thermal_agree_where_they_are_the_same_problem():
    k = 2e7
    assert conductance.thermal(k, MODULUS, (50.0, 200.0)) == pytest.approx(
        float(conductance.electrical(k, MODULUS, (1 / 50, 1 / 200))), rel=1e-14
    )


def test_a_computed_square_conducts_as_its_capacitance_says():
    # k/(E* L) = 1.1523 for a square; 32 x 32 cells have 1.140213 (uniform cells, section 9 of the theory pages).
    grid = rc.Grid((32, 32), 1 / 32)
    k = rc.contact_stiffness(np.ones((32, 32), dtype=bool), grid, MODULUS)
    assert conductance.electrical(k, MODULUS, (1.0, 1.0)) == pytest.approx(1.140213, rel=1e-6)


def test_law_of_another_law():
    law = conductance.law(POWER, MODULUS, resistivities=(2e-8, 5e-8), conductivities=(50.0, 200.0))
    force = np.geomspace(0.1, 10, 4)
    assert law.predict("electrical_conductance", force) == pytest.approx(
        conductance.electrical(3e6 * force**0.6, MODULUS, (2e-8, 5e-8)), rel=1e-14
    )
    assert law.predict("thermal_conductance", force) == pytest.approx(
        conductance.thermal(3e6 * force**0.6, MODULUS, (50.0, 200.0)), rel=1e-14
    )
    assert set(conductance.law(POWER, MODULUS, resistivities=(1.0, 1.0)).quantities) == {
        "electrical_conductance"
    }


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="no limit"):
        conductance.electrical(1.0, 1.0, (0.0, 0.0))
    with pytest.raises(ValueError, match="no limit"):
        conductance.thermal(1.0, 1.0, (math.inf, math.inf))
    with pytest.raises(ValueError, match="resistivity"):
        conductance.electrical(1.0, 1.0, (-1.0, 2.0))
    with pytest.raises(ValueError, match="stiffness"):
        conductance.thermal(math.nan, 1.0, (1.0, 2.0))
    with pytest.raises(ValueError, match="insulator"):
        conductance.stiffness_from_thermal(1.0, 1.0, (0.0, 2.0))
    with pytest.raises(ValueError, match="give the resistivities"):
        conductance.law(POWER, 1.0)
    with pytest.raises(ValueError, match="interfacial_stiffness"):
        conductance.law(POWER, 1.0, resistivities=(1.0, 1.0), quantity="interfacial_stiffness")


def test_a_contact_has_two_bodies():
    with pytest.raises(ValueError, match=r"of each body is needed, not 1\.0"):
        conductance.electrical(1e5, 1e11, 1.0)
    with pytest.raises(ValueError, match="stiffness must be a number"):
        conductance.thermal("a", 1e11, (1.0, 1.0))
