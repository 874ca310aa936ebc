"""The small table of units of length."""

import pytest

from roughcontact.files.length_units import is_length, length_factor, parse_length, stated_length
from roughcontact.units import registry


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
        # Words of files, and any length that only the library of units knows.
        ("2 microns", 2e-6),
        ("2 Micrometers", 2e-6),
        ("2 micrometre", 2e-6),
        ("2 metres", 2.0),
        ("2 inches", 0.0508),
        ("2 mils", 5.08e-5),
        ("2 thou", 5.08e-5),
        ("2 Angstrom", 2e-10),
        ("2 ft", 0.6096),
        ("1 furlong", 201.168402336805),
    ],
)
def test_lengths(text, metres):
    assert parse_length(text) == pytest.approx(metres, rel=1e-15)


@pytest.mark.parametrize(
    "text", ["", "10", "um", "1,5 um", "-1 um", "0 m", "nan m", "1 MM", "1 A", "1 a.u.", float("inf"), 0]
)
def test_what_is_no_length(text):
    with pytest.raises(ValueError, match=r"length|unit"):
        parse_length(text)


@pytest.mark.parametrize("name", ["km", "m", "dm", "cm", "mm", "um", "µm", "nm", "Å", "pm", "in"])
def test_symbols_are_those_of_the_library_of_units(name):
    assert is_length(name)
    assert length_factor(name) == pytest.approx(registry().Quantity(1.0, name).to("m").magnitude, rel=1e-14)


@pytest.mark.parametrize("prefix", ["", "kilo", "centi", "milli", "micro", "nano", "pico"])
@pytest.mark.parametrize("word", ["meter", "metre"])
@pytest.mark.parametrize("end", ["", "s"])
def test_words_are_those_of_the_library_of_units(prefix, word, end):
    wanted = registry().Quantity(1.0, prefix + word).to("m").magnitude
    assert stated_length(f"1 {prefix}{word}{end}") == pytest.approx(wanted, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "word"),
    [
        *(("micron", "micron"), ("mikrometer", "um"), ("angstroem", "angstrom"), ("Ångström", "angstrom")),
        *(
            ("inch", "inch"),
            ("mil", "thou"),
            ("thou", "thou"),
            ("microin", "microinch"),
            ("microinches", "microinch"),
        ),
    ],
)
def test_other_words(name, word):
    wanted = registry().Quantity(1.0, word).to("m").magnitude
    assert stated_length(f"1 {name}") == pytest.approx(wanted, rel=1e-14)


def test_units():
    assert length_factor("nm") == 1e-9
    assert length_factor(2.54e-2) == 2.54e-2
    assert is_length("pm")
    # Of a file a word counts only if it is surely meant as a length: to pint "au" and "points" are lengths.
    assert not any(map(is_length, (None, "", "A", "V", "deg", "MM", -1.0, "au", "points", "furlong")))
    assert length_factor("ft") == pytest.approx(0.3048, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "metres"),
    [("18 microns", 1.8e-5), ("18 points", None), ("0 um", None), ("-1 um", None), ("um", None)],
)
def test_a_stated_length_is_understood_or_open(text, metres):
    assert stated_length(text) == (None if metres is None else pytest.approx(metres, rel=1e-15))
