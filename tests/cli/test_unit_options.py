import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from roughcontact.cli.messages import UsageError
from roughcontact.cli.unit_options import (
    CONDUCTIVITY,
    FORCE,
    LENGTH,
    PRESSURE,
    parse,
    parse_loads,
    parse_points,
    parse_size,
)


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
    assert parse(text, kind, "--it") == pytest.approx(value, rel=4 * np.finfo(float).eps)


BOUNDED = st.just(0.0) | st.floats(1e-30, 1e30) | st.floats(-1e30, -1e-30)


@given(BOUNDED, st.sampled_from(["", " N", "N"]))
def test_a_number_in_si_keeps_every_bit(number, unit):
    assert parse(f"{number!r}{unit}", FORCE, "--it") == number


@settings(deadline=None)  # the first unit imports the library of units
@given(st.text(max_size=12) | st.text(max_size=8).map("1 {}".format))
def test_any_text_is_a_finite_number_or_a_clear_refusal(text):
    try:
        value = parse(text, FORCE, "--it")
    except UsageError as error:
        value, message = 0.0, str(error)
    else:
        message = "--it: write a force such as 10N"
    assert math.isfinite(value)
    assert message.startswith("--it: ")
    assert "write a force such as 10N" in message


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
def test_the_message_says_what_is_wrong_and_what_was_expected(text, complaint):
    with pytest.raises(UsageError, match=r"--force: .*write a force such as 10N") as caught:
        parse(text, FORCE, "--force")
    assert complaint in str(caught.value)


def test_a_range_is_spaced_evenly_in_the_logarithm():
    loads = parse_loads("1mN:1N:4", FORCE, "--forces")
    np.testing.assert_allclose(loads, [1e-3, 1e-2, 1e-1, 1.0], rtol=1e-14)


def test_a_comma_list_keeps_its_loads():
    np.testing.assert_array_equal(parse_loads("1mN, 0.5N,2", FORCE, "--forces"), [1e-3, 0.5, 2.0])
    np.testing.assert_array_equal(parse_loads("3N", FORCE, "--forces"), [3.0])


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "no load given"),
        (" , ", "no load given"),
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
        ("2N:1N:5", "must rise"),
        ("0:1N:5", "must rise"),
        ("1N:2Pa:5", "is not a force"),
    ],
)
def test_bad_loads_are_refused(text, complaint):
    with pytest.raises(UsageError, match=r"^--forces: ") as caught:
        parse_loads(text, FORCE, "--forces")
    assert complaint in str(caught.value)


def test_sizes_are_one_length_or_two():
    assert parse_size("2 m", "--size") == (2.0,)
    assert parse_size("1m x 0.5m", "--size") == (1.0, 0.5)


@pytest.mark.parametrize("text", ["1x2mm", "1 x 2 mm", "1×2mm", "1mm x 2mm", "1e-3x2e-3"])  # noqa: RUF001
def test_a_unit_behind_two_lengths_is_that_of_both(text):
    assert parse_size(text, "--size") == (1e-3, 2e-3)


def test_a_unit_of_the_first_length_alone_is_asked_about(invoke, rough):
    answer = invoke("surface", "info", rough, "--size", "1mm x 2")
    assert answer.exit_code == 2
    assert "--size: the second length of '1mm x 2' has no unit; write '1 x 2mm'" in answer.stderr


@pytest.mark.parametrize("text", ["0mm", "-1mm", "1mm x 0mm", "1mm x 2mm x 3mm", "1mm x", "wide", "1N"])
def test_bad_sizes_are_refused(text):
    with pytest.raises(UsageError, match=r"^--size: "):
        parse_size(text, "--size")


def test_points_are_rows_by_columns():
    assert parse_points("512", "--points") == (512, 512)
    assert parse_points("512x256", "--points") == (512, 256)


@pytest.mark.parametrize("text", ["0", "-3", "3x0", "3x4x5", "3.5", "", "many"])
def test_bad_points_are_refused(text):
    with pytest.raises(UsageError, match=r"^--points: "):
        parse_points(text, "--points")


@pytest.mark.parametrize("text", ["400W/m/K", "400 W/(m*K)", "400 W/( m · K )", "0.4 kW/(m*K)", "400"])
def test_conductivities_as_people_write_them(text):
    assert parse(text, CONDUCTIVITY, "--conductivity") == pytest.approx(400.0)
