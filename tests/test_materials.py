"""Metals by name: their table is consistent, and says where it comes from."""

import math
from pathlib import Path

import pytest

import roughcontact as rc
from roughcontact.materials import MATERIALS


@pytest.mark.parametrize("name", MATERIALS)
def test_every_value_has_its_source(name):
    material = rc.handbook(name)
    assert material.name == name
    values = {
        field: getattr(material, field)
        for field in ("solid", "hardness", "conductivity", "resistivity", "density")
    }
    assert material.sources.keys() == values.keys()
    assert all(material.sources.values())


@pytest.mark.parametrize("name", MATERIALS)
def test_heat_and_electricity_go_by_wiedemann_and_franz(name):
    """k rho/T is within a quarter of 2.44e-8 W ohm/K^2 in good metals at 293 K; alloys with a large resistivity
    conduct heat by the lattice too, at most as much again. A misplaced power of ten would show."""
    material = rc.handbook(name)
    lorenz = material.conductivity * material.resistivity / 293.0
    assert 0.75 < lorenz / 2.44e-8 < 2


# Measured longitudinal speeds of sound [m/s] (CRC Handbook, section 14). Worked and cast metals differ by 5 %,
# and gold by 8 % for 0.02 of its Poisson's ratio: this finds misplaced digits.
SPEEDS = {
    **{"steel": 5940, "stainless-steel": 5790, "aluminium": 6420, "titanium": 6070, "copper": 4760},
    **{"silver": 3650, "gold": 3240, "nickel": 6040, "tungsten": 5220},
}


@pytest.mark.parametrize("name", MATERIALS)
def test_density_and_modulus_give_the_measured_speed_of_sound(name):
    material = rc.handbook(name)
    solid = material.solid
    speed = rc.theory.ultrasound.speed(solid.young_modulus, solid.poisson_ratio, material.density)
    assert speed == pytest.approx(SPEEDS[name], rel=0.12)


@pytest.mark.parametrize("name", MATERIALS)
def test_a_metal_is_softer_than_its_ideal_strength(name):
    """The shear strength of a perfect crystal, G/2 pi, times three (hardness over yield stress) and by von Mises
    sqrt 3; and no metal of the table is softer than a thousandth of its modulus, as lead is not either."""
    material = rc.handbook(name)
    ideal = 3 * math.sqrt(3) * material.solid.shear_modulus / (2 * math.pi)
    assert 1e-3 * material.solid.young_modulus < material.hardness < ideal


def test_the_number_of_a_data_sheet_becomes_pascals():
    """107 HV are 107 kgf/mm^2: 107 times 9.80665 N over 1e-6 m^2."""
    assert rc.handbook("aluminium").hardness == pytest.approx(107 * 9.80665 / 1e-6, rel=1e-12)


def test_american_spelling_is_understood():
    assert rc.handbook("aluminum") is rc.handbook("aluminium")


def test_what_is_not_in_the_table_is_refused_with_the_names_that_are():
    with pytest.raises(
        ValueError, match=r"no material named 'cheese'; there are steel, .*give the numbers of the material"
    ):
        rc.handbook("cheese")


def test_the_table_of_the_documentation_is_that_of_the_library():
    page = (Path(__file__).parents[1] / "docs" / "reference" / "materials.md").read_text(encoding="utf-8")
    for material in MATERIALS.values():
        solid = material.solid
        row = (
            f"| `{material.name}` | {material.grade} | {solid.young_modulus / 1e9:.4g} | {solid.poisson_ratio:g} "
            f"| {material.hardness / 1e9:.3g} | {material.conductivity:g} | {material.resistivity * 1e9:.4g} "
            f"| {material.density:.5g} |"
        )
        assert row in page
