"""The command ``leak``: rates in the units in use, bounds, missing cells, half the cells, a picture."""

import json

import numpy as np
import pytest
import xarray

import roughcontact as rc

BODIES = ("--modulus", "10GPa", "--pressure", "20MPa")
WATER = ("--viscosity", "1mPa*s", "--density", "1000kg/m^3", "--drop", "1bar")
AIR = ("--gas", "air,20degC", "--upstream", "2bar", "--downstream", "1bar")
SEAL = ("--seal-width", "1mm", "--circumference", "0.1m")


@pytest.fixture(scope="module")
def tile(tmp_path_factory):
    path = tmp_path_factory.mktemp("tile") / "tile.npz"
    grid = rc.Grid((32, 48), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=3, rolloff=2.4e-5, short_cutoff=6e-6)
    rc.write(surface, path)
    return path


@pytest.fixture(scope="module")
def torn(tmp_path_factory):
    """A free map with missing cells."""
    path = tmp_path_factory.mktemp("torn") / "torn.npz"
    surface = rc.self_affine(rc.Grid((32, 48), 1e-6), hurst=0.8, rms=2e-7, rng=3, rolloff=2.4e-5)
    heights = surface.heights.copy()
    heights[10:14, 20:24] = np.nan
    rc.write(rc.Surface(heights, surface.grid), path)
    return path


def facts(answer):
    assert answer.exit_code == 0, answer.stderr
    return dict(line.split("   ", 1) for line in answer.stdout.splitlines())


def number(words, unit):
    """Return the number before a unit."""
    [found] = [part for part in words.strip().split(", ") if part.partition(" ")[2] == unit]
    return float(found.split()[0])


@pytest.mark.usefixtures("drawn")
def test_a_periodic_map_is_a_sample_of_a_seal(invoke, tile, tmp_path):
    out = tmp_path / "out"
    answer = invoke("leak", tile, *BODIES, *WATER, *SEAL, "--axis", "1", "--out", out)
    told = {name: words.strip() for name, words in facts(answer).items()}
    surface = rc.read(tile).levelled("auto")
    found = rc.leak(
        rc.press(surface, 1e10, pressure=2e7),
        rc.Liquid(1e-3, density=1000),
        drop=1e5,
        axis=1,
        seal_width=1e-3,
        circumference=0.1,
    )
    # Printed with four digits.
    rate = number(told["leak rate"], "m³/s")
    assert rate == pytest.approx(found.volume, rel=1e-3)
    assert number(told["leak rate"], "ml/min") == pytest.approx(rate * 1e6 * 60, rel=1e-3)
    assert number(told["leak rate"], "mg/s") == pytest.approx(rate * 1000 * 1e6, rel=1e-3)
    assert told["an open path leads"] == "along [1, 0] and [0, 1] periods (y, x)"
    assert told["interval along the drop"].endswith("for a gap that is constant in each cell")
    assert told["transmissivity, theory"].endswith("(Bruggeman, without slip)")
    assert told["transmissivity, principal"].count("µm³") == 2
    assert told["constriction, open cells across"] == str(found.constriction.cells)
    with xarray.open_dataset(out / "leak.nc", engine="h5netcdf") as dataset:
        np.testing.assert_array_equal(dataset["gap"], found.flow.gap)
        assert float(dataset["leak_rate"]) == found.volume
    record = json.loads((out / "leak.json").read_text())
    low, high = (each[1][1] for each in record["interval"])
    assert found.flow.transmissivity[1, 1] <= low < high
    assert record["units"]["leak_rate"] == "m3 s-1"
    assert (out / "leak.png").stat().st_size > 10_000


def test_a_gas_leaks_in_the_units_of_vacuum_engineers_with_missing_cells_open_and_closed(invoke, torn):
    told = facts(invoke("leak", torn, *BODIES, *AIR))
    rate = told["leak rate"]
    assert number(rate, "mbar l/s") == pytest.approx(10 * number(rate, "Pa m³/s"), rel=1e-3)
    air = rc.Gas("air", temperature=293.15)
    density = 1.5e5 / (air.gas_constant * 293.15)
    assert "ml/min" not in rate  # the volume of a gas depends on the pressure
    volume = number(rate, "Pa m³/s") / 1.5e5
    assert number(rate, "mg/s") == pytest.approx(density * volume * 1e6, rel=1e-3)
    opened = told["leak rate, missing cells open"]
    assert number(opened, "Pa m³/s") > number(rate, "Pa m³/s")
    other = facts(invoke("leak", torn, *BODIES, *AIR, "--missing", "open"))
    assert other["leak rate"].strip() == opened.strip()
    assert other["leak rate, missing cells closed"].strip() == rate.strip()


def test_a_change_on_half_the_cells_is_noted_only_where_it_is_large(invoke, tile):
    smooth = ("--short-cutoff", "16um", "--pressure", "1MPa")
    for more, noted in ((smooth, False), (("--pressure", "50MPa"), True)):
        answer = invoke("leak", tile, *BODIES[:2], *more, *WATER[:4], "--drop", "1kPa", *SEAL, "--json")
        record = json.loads(answer.stdout)
        change = record["others"]["half the cells"]["leak_rate"] / record["leak_rate"] - 1
        assert (abs(change) > 0.1) is noted
        assert ("on half as many cells" in answer.stderr) is noted


def test_full_contact_leaks_nothing_and_says_so(invoke, tile, tmp_path):
    line = ("leak", tile, "--modulus", "1MPa", "--pressure", "1GPa", *WATER, *SEAL)
    answer = invoke(*line, "--out", tmp_path / "out")
    told = facts(answer)
    assert number(told["leak rate"].strip(), "m³/s") == 0
    assert told["an open path leads"].strip() == "nowhere"
    assert "No open path leads through the gap" in answer.stderr


@pytest.mark.parametrize(
    ("words", "message", "right"),
    [
        (
            ("--gas", "air", *AIR[2:], *SEAL),
            "--gas: 'air' lacks the temperature of the gas; write air,20degC, with your values",
            (*AIR, *SEAL),
        ),
        (
            (*AIR[:2], "--drop", "1bar", *SEAL),
            "only on their difference; give --upstream and --downstream in place of --drop",
            (*AIR, *SEAL),
        ),
        (
            (*WATER[:4], *SEAL),
            "--drop or --upstream is required: add one, such as --drop 1bar",
            (*WATER, *SEAL),
        ),
        (
            WATER,
            "a periodic map is a sample of a seal; give the width and the circumference",
            (*WATER, *SEAL),
        ),
        (
            (*WATER, *SEAL[:2]),
            "--seal-width needs --circumference, which is not given: give --circumference too",
            (*WATER, *SEAL),
        ),
        ((*WATER[:4], "--drop", "30MPa", *SEAL), "exceeds the nominal pressure", (*WATER, *SEAL)),
        (
            ("--viscosity", "0Pa*s", *WATER[2:], *SEAL),
            "--viscosity: the viscosity must be positive",
            (*WATER, *SEAL),
        ),
        (
            (*WATER, *SEAL, "--profile", "line"),
            "--profile: a leak needs a map of heights; leave --profile out",
            (*WATER, *SEAL),
        ),
    ],
)
def test_what_is_missing_is_named_and_the_remedy_works(invoke, tile, words, message, right):
    answer = invoke("leak", tile, *BODIES, *words)
    assert answer.exit_code == 2
    assert message in " ".join(answer.stderr.split())
    assert invoke("leak", tile, *BODIES, *right).exit_code == 0
