"""The small table of units of length."""

import pytest

from roughcontact.files.length_units import is_length, length_factor, parse_length


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("10 um", 1e-5),
        ("10um", 1e-5),
        ("1.5e2 nm", 1.5e-7),
        ("2 \N{ANGSTROM SIGN}", 2e-10),
        ("2 \N{LATIN CAPITAL LETTER A WITH RING ABOVE}", 2e-10),
        (".5 mm", 5e-4),
        ("3 m", 3.0),
        ("1 \N{MICRO SIGN}m", 1e-6),
        ("1 \N{GREEK SMALL LETTER MU}m", 1e-6),
        (0.25, 0.25),
    ],
)
def test_lengths(text, metres):
    assert parse_length(text) == pytest.approx(metres, rel=1e-15)


@pytest.mark.parametrize(
    "text", ["", "10", "um", "1,5 um", "-1 um", "0 m", "nan m", "1 Mm", "1 furlong", float("inf"), 0]
)
def test_what_is_no_length(text):
    with pytest.raises(ValueError, match=r"length|unit"):
        parse_length(text)


def test_units():
    assert length_factor("nm") == 1e-9
    assert length_factor(2.54e-2) == 2.54e-2
    assert is_length("pm")
    assert not any(map(is_length, (None, "", "A", "V", "deg", "MM", -1.0)))
