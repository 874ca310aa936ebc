"""Engineering units: the prefix that leaves a readable number."""

from __future__ import annotations

import math

import pytest

from roughcontact.labels.engineering_units import Scale, pretty, scale, written
from roughcontact.labels.variables import VARIABLES


@pytest.mark.parametrize(
    ("largest", "unit", "factor", "name"),
    [
        (5.12e-5, "m", 1e6, "µm"),
        (1e-6, "m", 1e6, "µm"),
        (9.99e-7, "m", 1e9, "nm"),
        (0.02, "m", 1e3, "mm"),
        (3e7, "m", 1e-3, "km"),
        (2.3e9, "Pa", 1e-9, "GPa"),
        (2e5, "N m-1", 1e-3, "kN/m"),
        (2e-11, "m2", 1e12, "µm²"),
        (9e-13, "m2", 1e12, "µm²"),
        (5e-7, "m2", 1e6, "mm²"),
        (9e-9, "m2", 1e12, "µm²"),
        (1e-8, "m2", 1e6, "mm²"),
        (2e12, "m-2", 1e-12, "1/µm²"),
        (3e7, "m-2", 1e-6, "1/mm²"),
        (2e6, "m-1", 1e-6, "1/µm"),
        (0.5, "m-1", 1e3, "1/km"),
        (1e-16, "m4", 1e12, "mm⁴"),
        (3e-9, "J", 1e9, "nJ"),
        (0.3, "1", 1.0, ""),
        (0.0, "N", 1.0, "N"),
        (math.inf, "N", 1.0, "N"),
    ],
)
def test_the_prefix_leaves_a_readable_number(largest, unit, factor, name):
    chosen = scale(largest, unit)
    assert (chosen.factor, chosen.unit) == (factor, name)


@pytest.mark.parametrize("exponent", range(-14, 14))
def test_exact_powers_of_ten_are_not_rounded_down(exponent):
    chosen = scale(float(f"1e{exponent}"), "Pa")
    shown = float(f"1e{exponent}") * chosen.factor
    if -12 <= exponent < 15:
        assert 1 - 1e-12 < shown < 1000


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (1.2345e-5, "m", "12.3 µm"),
        (9.9999e-7, "m", "1 µm"),
        (3.65e9, "N m-1", "3.65 GN/m"),
        (5e-7, "m2", "0.5 mm²"),
        (4e12, "m-2", "4 1/µm²"),
        (-2e-9, "m", "-2 nm"),
        (0.0, "N", "0 N"),
        (123456.0, "1", "123000"),
        (2e30, "N", "2e+18 TN"),
        (-1.5e-16, "m", "-0.00015 pm"),
        (math.inf, "N m-1", "infinite"),
        (math.nan, "N m-1", "unknown"),
    ],
)
def test_values_are_written_for_people(value, unit, text):
    assert written(value, unit) == text


@pytest.mark.parametrize(
    ("unit", "text"),
    [
        ("m-1", "1/m"),
        ("m-2", "1/m²"),
        ("s-1 m-2", "1/s/m²"),
        ("N m-2", "N/m²"),
        ("1", ""),
        ("m2 K W-1", "m²·K/W"),
        ("N/um/mm^2", "N/µm/mm²"),
        ("MPa/um", "MPa/µm"),
        ("uN/mm**3", "µN/mm³"),
        ("N/µm/mm²", "N/µm/mm²"),
        ("GPa", "GPa"),
    ],
)
def test_units_are_written_as_in_print(unit, text):
    assert pretty(unit) == text


@pytest.mark.parametrize("power", [-3, -2, -1, 1, 2, 3, 4])
def test_numbers_of_a_power_keep_to_a_range_between_prefixes(power):
    """A prefix of the power p is 1000^p times the next: the range is as wide, and begins at 10^-2(p - 1)."""
    unit, size = "K" if power == 1 else f"K{power}", abs(power)
    low = 10.0 ** (-2 * (size - 1))
    for exponent in range(-8 * size, 8 * size):
        value = 3.0 * 10.0**exponent
        assert low * 0.999 < value * scale(value, unit).factor < low * 1000**size * 1.001


def test_every_unit_of_the_table_can_be_printed():
    mechanics, conductance = (
        {"", "N", "m", "N/m", "N·m/rad", "m²", "m³", "J", "Pa"},
        {"S", "ohm", "W/K", "K/W", "A", "V", "W", "K"},
    )
    flows = {"m³/s", "kg/s", "Pa·m³/s"}
    times = {"s", "m/s", "Hz"}
    per_area = {"J/m²", "Pa/m", "S/m²", "m²·ohm", "W/m²/K", "m²·K/W", "A/m²", "W/m²"}
    assert {
        pretty(known.unit) for known in VARIABLES.values()
    } == mechanics | conductance | flows | times | per_area


def test_a_stiffness_per_area_is_in_the_unit_of_machine_design():
    for value in (1e3, 3e13, 1e20):
        assert scale(value, "Pa m-1") == Scale(1e-12, "N/µm/mm²")
    assert written(2.96e13, "Pa m-1") == "29.6 N/µm/mm²"
