import sys
from types import ModuleType

import pytest

from roughcontact import units
from roughcontact.files.quantity import (
    AREA,
    ENERGY_PER_AREA,
    FORCE,
    LENGTH,
    PRESSURE,
    has_unit,
    parse,
    parse_number,
    unit_in,
)


def test_a_quantity_becomes_its_number_in_si():
    assert parse("5 um", LENGTH) == pytest.approx(5e-6, rel=1e-15)
    assert parse("5e-6", LENGTH) == 5e-6
    assert parse_number(" 0.3 ", "0.5") == 0.3


def test_zero_and_what_is_far_beyond_any_body():
    assert parse("0 mN", FORCE) == 0.0
    assert parse("-5 nN", FORCE) == -5e-9
    for text in ("9e29", "-9e29", "1.1e-30", "-1.1e-30"):
        assert parse(f"{text} N", FORCE) == float(text)
    for text in ("1.1e30", "-1.1e30", "9e-31", "-9e-31"):
        with pytest.raises(ValueError, match="is out of range: check its exponent and unit"):
            parse(f"{text} N", FORCE)


def test_the_unit_is_what_follows_the_number():
    assert [unit_in(text) for text in (" 5 um ", "5", "-.5e-3mm^2", "um")] == ["um", "", "mm^2", "um"]
    assert [has_unit(text) for text in ("5 um", "5", "um")] == [True, False, True]


@pytest.mark.parametrize("kind", [FORCE, LENGTH, PRESSURE], ids=lambda kind: kind.unit)
@pytest.mark.parametrize("prefix", ["p", "n", "u", "µ", "μ", "m", "c", "k", "M", "G", "T"])
def test_prefixes_are_those_of_the_library_of_units_without_it(monkeypatch, kind, prefix):
    unit = f"{prefix}{kind.unit}"
    wanted = units.registry().Quantity(1.0, unit).to(kind.unit).magnitude
    monkeypatch.setattr(units, "registry", None)
    assert parse(f"3{unit}", kind) == pytest.approx(3 * wanted, rel=1e-15)


def test_a_prefix_belongs_to_the_unit_that_is_raised():
    assert parse("3 mm^2", AREA) == pytest.approx(3e-6, rel=1e-15)


def test_a_digit_behind_a_unit_is_its_power():
    assert parse("3 mm2", AREA) == pytest.approx(3e-6, rel=1e-15)
    assert parse("50mJ/m2", ENERGY_PER_AREA) == parse("50mJ/m^2", ENERGY_PER_AREA)
    assert parse("5N/mm2", PRESSURE) == pytest.approx(5e6, rel=1e-15)
    with pytest.raises(ValueError, match="is not a force"):
        parse("5N2", FORCE)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("5 kg", "'5 kg' is not a force: write a force such as 10N"),
        ("5 newtn", "unknown unit 'newtn' in '5 newtn': write a force such as 10N"),
        ("N", "'N' does not start with a number: write a force such as 10N"),
    ],
)
def test_what_is_none_is_refused_with_a_value_error(text, message):
    with pytest.raises(ValueError) as caught:
        parse(text, FORCE)
    assert str(caught.value) == message


def test_what_is_no_number_is_refused():
    with pytest.raises(ValueError, match=r"^'0.3 m' is not a number: write a number such as 0.5$"):
        parse_number("0.3 m", "0.5")


def test_a_broken_library_of_units_is_not_the_fault_of_the_unit(monkeypatch):
    monkeypatch.setattr(units, "registry", units.registry.__wrapped__)
    monkeypatch.setitem(sys.modules, "pint", None)  # as if it were not installed
    with pytest.raises(ImportError):
        parse("5 lbf", FORCE)
    empty = ModuleType("pint")
    empty.UnitRegistry = lambda preprocessors: object()
    monkeypatch.setitem(sys.modules, "pint", empty)
    with pytest.raises(AttributeError, match="parse_units"):
        parse("5 lbf", FORCE)
