"""The option ``--leak`` of the command ``curve``: columns, the load that closes the gap, files, stored loads."""

import csv
import json

import numpy as np
import pytest
import xarray

import roughcontact as rc

BODIES = ("--modulus", "10GPa")
LOADS = ("--pressures", "10MPa,60MPa,400MPa")


@pytest.fixture(scope="module")
def tile(tmp_path_factory):
    path = tmp_path_factory.mktemp("tile") / "tile.npz"
    grid = rc.Grid((32, 48), 1e-6, periodic=True)
    rc.write(rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=3, rolloff=2.4e-5, short_cutoff=6e-6), path)
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


@pytest.mark.usefixtures("drawn")
def test_the_flow_stands_in_table_and_files(invoke, tile, tmp_path):
    out = tmp_path / "out"
    answer = invoke("curve", tile, *BODIES, *LOADS, "--leak", "1", "--table", "csv", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    curve = rc.loading_curve(
        rc.read(tile).levelled("auto"),
        1e10,
        pressures=[1e7, 6e7, 4e8],
        measures=[rc.Transmissivity(axis=1)],
    )
    lines = answer.stdout.splitlines()
    [at] = [k for k, line in enumerate(lines) if line.split()[:1] == ["nominal"]]
    header, *rows = lines[at : at + 4]
    assert header.partition("residual")[2].split() == [
        *("hydraulic", "gap", "[nm]", "transmissivity", "[µm³]", "flow", "factor", "open", "path"),
    ]
    shown = np.array([row.removesuffix("not resolved").split()[-4:] for row in rows], float)
    np.testing.assert_allclose(shown[:, 0], 1e9 * curve.measured["hydraulic_gap"], rtol=1e-3)  # four digits
    assert shown[:, 3].tolist() == curve.measured["percolates"].tolist()
    assert "closes between 60 MPa (A/A0 " in answer.stdout
    record = json.loads((out / "curve.json").read_text())
    assert record["transmissivity"] == curve.measured["transmissivity"].tolist()
    assert record["units"]["transmissivity"] == "m3"
    with (out / "curve.csv").open() as lines:
        column = [float(row["flow_factor"]) for row in csv.DictReader(lines)]
    assert column == curve.measured["flow_factor"].tolist()
    with xarray.open_dataset(out / "curve.nc", engine="h5netcdf") as data:
        assert data["hydraulic_gap"].attrs["units"] == "m"
    assert "hydraulic_gap [m]" in (out / "interface.csv").read_text()
    assert (out / "leak.png").stat().st_size > 5000
    assert "leak.png" in answer.stderr


def test_the_python_that_is_printed_measures_the_flow(invoke, torn):
    words = invoke("curve", torn, *BODIES, *LOADS, "--leak", "0", "--missing", "open", "--print", "python")
    assert 'measures=[rc.Transmissivity(axis=0, missing="open")]' in words.stdout
    space = {}
    exec(words.stdout, space)
    answer = invoke("curve", torn, *BODIES, *LOADS, "--leak", "0", "--missing", "open", "--json")
    record = json.loads(answer.stdout)
    assert record["hydraulic_gap"] == space["curve"].measured["hydraulic_gap"].tolist()


def test_stored_loads_are_those_of_the_same_flow(invoke, tile, tmp_path):
    """A further load is joined to them; a curve along the other axis, or without a flow, is computed anew."""
    asked = ("curve", tile, *BODIES, "--out", tmp_path / "out", "--pressures")
    first = invoke(*asked, "10MPa,60MPa", "--leak", "1")
    more = invoke(*asked, "10MPa,30MPa,60MPa", "--leak", "1")
    assert "kept" not in first.stderr
    assert "2 of 3 loads of the same recipe are in" in more.stderr
    stored = rc.read_curve(tmp_path / "out" / "curve.nc")
    whole = json.loads(
        invoke("curve", tile, *BODIES, *asked[-1:], "10MPa,30MPa,60MPa", "--leak", "1", "--json").stdout
    )
    # A load that starts from another one is solved to 1e-8; the cubed gap depends on it more strongly.
    np.testing.assert_allclose(stored.measured["transmissivity"], whole["transmissivity"], rtol=1e-5)
    for other in (("--leak", "0"), ()):
        again = invoke(*asked, "10MPa,60MPa", *other)
        assert again.exit_code == 0
        assert "kept" not in again.stderr


def test_a_plastic_curve_has_a_flow_and_its_doubts(invoke, torn):
    plastic = ("--materials", "steel,aluminium", "--hardness", "aluminium")
    answer = invoke("curve", torn, *plastic, "--pressures", "50MPa,600MPa,900MPa", "--leak", "0", "--json")
    record = json.loads(answer.stdout)
    assert record["percolates"] == [1.0, 1.0, 0.0]
    assert any("the last load with an open path" in note for note in record["notes"])


@pytest.mark.parametrize(
    ("words", "message", "right"),
    [
        (("--leak", "y"), "--leak: 'y' is not one of the choices; choose from 0, 1", ("--leak", "1")),
        (
            ("--leak", "0", "--loop", "--hardness", "1GPa"),
            "--leak does not go with --loop: the flow is computed for increasing loads only",
            ("--leak", "0", "--hardness", "1GPa"),
        ),
        (("--missing", "open"), "--missing needs --leak", ("--leak", "0", "--missing", "open")),
    ],
)
def test_what_is_refused_and_the_remedy(invoke, tile, words, message, right):
    refused = invoke("curve", tile, *BODIES, "--pressures", "10MPa,20MPa", *words)
    assert refused.exit_code == 2
    assert message in refused.stderr
    assert invoke("curve", tile, *BODIES, "--pressures", "10MPa,20MPa", *right).exit_code == 0


def test_a_profile_has_no_flow(invoke, tile):
    refused = invoke("curve", tile, *BODIES, "--leak", "0", "--profile", "line")
    assert (
        "--leak does not go with --profile: the flow needs a map of heights; leave out one of them"
        in refused.stderr
    )
