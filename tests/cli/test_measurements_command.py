"""The command ``surface measurements``: bands of many maps, their combined spectrum, and its files."""

import json

import numpy as np
import pytest
import xarray

import roughcontact as rc
from tables import read_table

GRID = rc.Grid((96, 128), (2e-6, 1e-6))
PLACES = ("place0.npz", "place1.npz", "place2.npz")


@pytest.fixture
def scans(tmp_path, monkeypatch):
    """Return the measurements of three maps in a folder ``scans`` that are not square, and the folder around it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scans").mkdir()
    for seed, name in enumerate(PLACES):
        rough = rc.self_affine(GRID, 0.8, 1e-7, seed, amplitudes="gaussian")
        rc.write(rough, tmp_path / "scans" / name)
    (tmp_path / "scans" / "notes.md").write_text("of these maps")
    return rc.read_measurements(tmp_path / "scans")


def record(answer):
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)


def test_the_numbers_are_those_of_the_library(invoke, scans):
    found = record(invoke("surface", "measurements", "scans", "--json"))
    spectrum = scans.combined_spectrum()
    for name, values in zip(("mean_low", "mean_high"), spectrum.interval(0.95), strict=True):
        assert found[name] == pytest.approx(values, rel=1e-12)
    assert found["density"] == pytest.approx(spectrum.density, rel=1e-12)
    assert found["notes"] == list(spectrum.notes)
    assert "notes.md" in found["notes"][-2] + found["notes"][-1]
    assert found["units"]["density"] == "m4"
    for row, one in zip(found["measurements"], scans, strict=True):
        assert (row["name"], row["limited_by"], row["outlying"]) == (one.name, "cells", False)
        assert (row["shape"], row["spacing"]) == ([96, 128], [2e-6, 1e-6])
        assert row["band"] == pytest.approx(one.band, rel=1e-12)
        assert row["weight"] == pytest.approx(one.weight, rel=1e-12)
        assert row["rms"] == pytest.approx(one.surface.levelled().rms, rel=1e-12)


def test_a_table_and_notes_are_printed(invoke, scans):
    answer = invoke("surface", "measurements", *(f"scans/{name}" for name in PLACES))
    assert answer.exit_code == 0, answer.stderr
    header, *rows = answer.stdout.splitlines()
    assert header.split()[:4] == ["name", "cells", "size", "pixel"]
    for name, row in zip(PLACES, rows, strict=False):
        assert f"{name}  96 x 128  192 µm x 128 µm  2 µm x 1 µm" in row
        assert "8 µm to 42.7 µm" in row
    assert "blur is not corrected" in answer.stderr


def test_the_instrument_of_the_options_holds_for_all_maps(invoke, scans):
    words = ("surface", "measurements", "scans", "--json")
    for option, limit in (
        ("--resolution=12um", "resolution"),
        ("--tip-radius=0.1mm", "tip"),
        ("--noise=30nm", "noise"),
    ):
        rows = record(invoke(*words, option))["measurements"]
        assert [row["limited_by"] for row in rows] == [limit] * 3
        assert all(row["band"][0] > 8e-6 for row in rows)
    assert {row["noise_found"] for row in rows} == {"stated"}
    assert [row["noise"] for row in rows] == pytest.approx([30e-9] * 3)


def test_files_hold_the_spectrum(invoke, scans):
    answer = invoke("surface", "measurements", "scans", "--out", "out", "--format", "svg")
    assert "measurements.csv, measurements.nc and measurements.svg are in" in answer.stderr
    spectrum, table = scans.combined_spectrum(), read_table("out/measurements.csv")
    np.testing.assert_array_equal(table["wavenumber"], spectrum.wavenumber)
    np.testing.assert_array_equal(table["place_high"], spectrum.interval(of="place")[1])
    with xarray.open_dataset("out/measurements.nc", engine="h5netcdf") as stored:
        np.testing.assert_array_equal(stored["map_density"], spectrum.map_density)
        assert list(stored["measurement"].values) == list(PLACES)


def test_a_map_that_differs_is_named(invoke, scans):
    for seed in (3, 4):
        rc.write(rc.self_affine(GRID, 0.8, 1e-7, seed, amplitudes="gaussian"), f"scans/place{seed}.npz")
    short = rc.self_affine(GRID, 0.0, 6e-8, 9, rolloff=12e-6)
    bad = scans.measurements[0].surface.heights + short.heights
    rc.write(rc.Surface(bad, GRID), "scans/bad.npz")
    answer = invoke("surface", "measurements", "scans")
    lines = {line.split()[0]: line for line in answer.stdout.splitlines()}
    assert lines["bad.npz"].endswith("differs, not in the spectrum")
    assert not lines["place0.npz"].endswith("spectrum")
    assert "'bad.npz' differs from the other measurements" in answer.stderr
    assert record(invoke("surface", "measurements", "scans", "--json"))["measurements"][0]["outlying"]
