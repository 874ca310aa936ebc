import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from roughcontact.errors import InputError
from roughcontact.files.quantity import CONDUCTIVITY, FORCE, LENGTH, PRESSURE, parse
from roughcontact.recipe.texts import points, rising_loads, size


def loads(text):
    """Return rising forces, of a range as the call that makes it."""
    found = rising_loads(text, FORCE)
    return found if isinstance(found, list) else found.value({"np": np})


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("10 N", FORCE, 10.0),
        ("10N", FORCE, 10.0),
        (" 1e3 mN ", FORCE, 1.0),
        ("-2.5kN", FORCE, -2500.0),
        ("7", FORCE, 7.0),
        ("110GPa", PRESSURE, 110e9),
        (".5 N/mm**2", PRESSURE, 0.5e6),
        ("2 N / mm²", PRESSURE, 2e6),
        ("2 kN*mm/m^3", PRESSURE, 2.0),
        ("1e-6 m", LENGTH, 1e-6),
        ("5um", LENGTH, 5e-6),
        ("5µm", LENGTH, 5e-6),
        ("1.e1nm", LENGTH, 1e-8),
    ],
)
def test_a_quantity_becomes_its_number_in_si(text, kind, value):
    assert parse(text, kind) == pytest.approx(value, rel=4 * np.finfo(float).eps)


BOUNDED = st.just(0.0) | st.floats(1e-30, 1e30) | st.floats(-1e30, -1e-30)


@given(BOUNDED, st.sampled_from(["", " N", "N"]))
def test_a_number_in_si_keeps_every_bit(number, unit):
    assert parse(f"{number!r}{unit}", FORCE) == number


@settings(deadline=None)  # the first unit imports the library of units
@given(st.text(max_size=12) | st.text(max_size=8).map("1 {}".format))
def test_any_text_is_a_finite_number_or_a_clear_refusal(text):
    try:
        value, said = parse(text, FORCE), "write a force such as 10N"
    except InputError as error:
        value, said = 0.0, str(error)
    assert math.isfinite(value)
    assert "write a force such as 10N" in said


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("10kg", "'10kg' is not a force"),
        ("10um", "is not a force"),
        ("10 newtn", "unknown unit 'newtn'"),
        ("10 N)", "unknown unit"),
        ("10 * 3", "unknown unit"),
        ("1N**9**9**9**9", "unknown unit"),
        ("N", "does not start with a number"),
        ("", "does not start with a number"),
        ("inf", "does not start with a number"),
        ("nan N", "does not start with a number"),
        ("1,5N", "write the decimal point as '.'"),
        ("1e999N", "not a finite number"),
    ],
)
def test_the_message_says_what_is_wrong_and_what_to_write(text, complaint):
    with pytest.raises(InputError, match=r"write a force such as 10N") as caught:
        parse(text, FORCE)
    assert complaint in str(caught.value)


def test_a_range_is_spaced_evenly_in_the_logarithm():
    np.testing.assert_allclose(loads("1mN:1N:4"), [1e-3, 1e-2, 1e-1, 1.0], rtol=1e-14)


def test_a_comma_list_keeps_its_loads():
    np.testing.assert_array_equal(loads("1mN, 0.5N,2"), [1e-3, 0.5, 2.0])
    np.testing.assert_array_equal(loads("3N"), [3.0])


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "holds no load"),
        (" , ", "holds no load"),
        ("2N,1N", "must increase"),
        ("1N,1N", "must increase"),
        ("0N,1N", "must be positive"),
        ("-1N,1N", "must be positive"),
        ("1N:2N", "from:to:count"),
        ("1N:2N:3:4", "from:to:count"),
        ("1N:2N:many", "from:to:count"),
        ("1N:2N:2.5", "from:to:count"),
        ("1N:2N:1", "from 2 to"),
        ("1N:2N:1000000000", "from 2 to"),
        ("2N:1N:5", "must increase from a positive load"),
        ("0:1N:5", "must increase from a positive load"),
        ("1N:2Pa:5", "is not a force"),
    ],
)
def test_bad_loads_are_refused(text, complaint):
    with pytest.raises(InputError) as caught:
        loads(text)
    assert complaint in str(caught.value)


def test_sizes_are_one_length_or_two():
    assert size("2 m") == (2.0,)
    assert size("1m x 0.5m") == (1.0, 0.5)


@pytest.mark.parametrize("text", ["1x2mm", "1 x 2 mm", "1×2mm", "1mm x 2mm", "1e-3x2e-3"])  # noqa: RUF001
def test_a_unit_behind_two_lengths_is_that_of_both(text):
    assert size(text) == (1e-3, 2e-3)


def test_a_unit_of_the_first_length_alone_is_asked_about():
    with pytest.raises(InputError, match=r"the second length of '1mm x 2' has no unit: write '1 x 2mm'"):
        size("1mm x 2")


@pytest.mark.parametrize("text", ["0mm", "-1mm", "1mm x 0mm", "1mm x 2mm x 3mm", "1mm x", "wide", "1N"])
def test_bad_sizes_are_refused(text):
    with pytest.raises(InputError):
        size(text)


def test_points_are_rows_by_columns():
    assert points("512") == (512, 512)
    assert points("512x256") == (512, 256)


@pytest.mark.parametrize("text", ["0", "-3", "3x0", "3x4x5", "3.5", "", "many"])
def test_bad_points_are_refused(text):
    with pytest.raises(InputError):
        points(text)


@pytest.mark.parametrize("text", ["400W/m/K", "400 W/(m*K)", "400 W/( m · K )", "0.4 kW/(m*K)", "400"])
def test_conductivities_as_people_write_them(text):
    assert parse(text, CONDUCTIVITY) == pytest.approx(400.0)


def test_a_force_per_length_without_a_profile_is_met_with_the_remedy():
    with pytest.raises(InputError) as refused:
        rising_loads("1N/mm:10N/mm:3", FORCE)
    assert refused.value.remedy == "give `profile` for a profile, or write a force such as 10N"
    with pytest.raises(InputError) as refused:
        rising_loads("1K", FORCE)
    assert refused.value.remedy == "write a force such as 10N"
