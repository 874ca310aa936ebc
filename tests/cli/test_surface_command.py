import json
import re

import numpy as np
import pytest

import roughcontact as rc

MAKE = ("--hurst", "0.8", "--rms", "1um", "--size", "1mm")


def test_a_surface_is_made_as_the_library_makes_it(invoke, tmp_path):
    path = tmp_path / "new.npz"
    answer = invoke(
        *(
            "surface",
            "make",
            path,
            "--hurst",
            "0.7",
            "--rms",
            "2um",
            "--size",
            "1mm x 3mm",
            "--points",
            "16x24",
        ),
        *("--seed", "9", "--rolloff", "0.8mm", "--periodic"),
        *("--long-cutoff", "2mm", "--short-cutoff", "0.2mm"),
    )
    assert answer.exit_code == 0
    grid = rc.Grid((16, 24), (1e-3 / 16, 3e-3 / 24), periodic=True)
    expected = rc.self_affine(
        grid,
        0.7,
        2e-6,
        np.random.default_rng(9),
        rolloff=0.8e-3,
        long_cutoff=2e-3,
        short_cutoff=0.2e-3,
    )
    surface = rc.read(path)
    np.testing.assert_allclose(surface.heights, expected.heights, rtol=0, atol=1e-14 * expected.rms)
    assert surface.grid == grid


def test_a_band_of_waves_has_the_rms_height(invoke, tmp_path):
    path = tmp_path / "new.npz"
    assert invoke("surface", "make", path, *MAKE, "--points", "32", "--rms-band", "1mm:0.1mm").exit_code == 0
    grid = rc.Grid((32, 32), 1e-3 / 32)
    expected = rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(1), rms_band=(1e-3, 1e-4))
    surface = rc.read(path)
    np.testing.assert_allclose(surface.heights, expected.heights, rtol=0, atol=1e-14 * expected.rms)
    assert surface.rms > 1e-6
    assert any("of the waves from 0.001 m to 0.0001 m" in line for line in surface.provenance)


def test_one_length_is_the_width_of_square_cells(invoke, tmp_path):
    path = tmp_path / "new.npz"
    assert invoke("surface", "make", path, *MAKE, "--points", "16x32").exit_code == 0
    assert rc.read(path).grid.lengths == pytest.approx((0.5e-3, 1e-3), rel=1e-15)


def test_a_nodal_surface_repeats_its_first_row_and_column(invoke, tmp_path):
    path = tmp_path / "new.npz"
    assert invoke("surface", "make", path, *MAKE, "--points", "17", "--nodal").exit_code == 0
    heights = rc.read(path).heights
    np.testing.assert_array_equal(heights[0], heights[-1])
    np.testing.assert_array_equal(heights[:, 0], heights[:, -1])


def test_the_seed_makes_the_surface(invoke, tmp_path):
    names = {name: tmp_path / f"{name}.npz" for name in ("first", "again", "other")}
    for name, path in names.items():
        seed = "2" if name == "other" else "1"
        assert invoke("surface", "make", path, *MAKE, "--points", "16", "--seed", seed).exit_code == 0
    first, again, other = (rc.read(path).heights for path in names.values())
    assert (first == again).all()
    assert (first != other).any()


def test_the_recipe_is_kept_and_shown(invoke, tmp_path):
    path = tmp_path / "new.npz"
    words = ("surface", "make", path, *MAKE, "--points", "16", "--seed", "7", "--short-cutoff", "0.2mm")
    made = invoke(*words)
    history = json.loads(invoke("surface", "info", path, "--json").stdout)["provenance"]
    assert history[0].startswith("self-affine, H = 0.8, rms = 1e-06 m")
    assert history[1] == f"made by roughcontact {rc.__version__}: seed 7, short_cutoff 0.0002 m"
    assert history[2].startswith("read from new.npz")
    assert "Note" not in made.stderr
    table = invoke("surface", "info", path)
    for line in history[:2]:
        assert line in made.stdout
        assert line in table.stdout
    # The extremes are told in the units of the roughness.
    assert re.search(r"heights +-\d\S* (nm|µm) to \d\S* (nm|µm)\n", table.stdout)
    assert f"Note: {path} exists and is replaced" in invoke(*words).stderr


@pytest.mark.parametrize(
    ("changed", "complaint"),
    [
        (("--hurst", "0,8"), "--hurst: '0,8' holds a comma"),
        (("--seed", "-1"), "--seed: the seed must be a whole number from 0 up, not '-1'"),
        (("--seed", "1.5"), "--seed: the seed must be a whole number from 0 up, not '1.5'"),
        (("--hurst", "4"), "--hurst: the Hurst exponent must lie between -1 and 3"),
        (("--rms", "0um"), "--rms: the rms height must be positive"),
        (("--rms", "1N"), "--rms: '1N' is not a length"),
        (("--size", "0mm"), "--size: a side length must be positive"),
        (("--points", "0"), "--points: '0' is not a number of points"),
        (("--long-cutoff", "1um"), "no wave"),
        (("--rms-band", "1mm"), "--rms-band: '1mm' is not a band"),
        (("--rms-band", "1mm:0um"), "--rms-band: a wavelength must be positive"),
        (("--rms-band", "1mm:1um"), "only waves longer"),
        (("--nodal", "--periodic"), "nodal repeats the first row"),
    ],
)
def test_a_surface_that_cannot_be_made_leaves_no_file(invoke, tmp_path, changed, complaint):
    answer = invoke("surface", "make", tmp_path / "new.npz", *MAKE, "--points", "16", *changed)
    assert answer.exit_code == 2
    assert answer.stderr.startswith("Error: ")
    assert complaint in answer.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_cannot_be_written_is_refused(invoke, tmp_path):
    for path, complaint in (
        (tmp_path / "new.csv", "written as one of .npz, .nc, .x3p, .txt, .npy, .vti"),
        (tmp_path / "new", "written as one of .npz"),
        (tmp_path / "no" / "new.npz", "no folder"),
    ):
        answer = invoke("surface", "make", path, *MAKE, "--points", "16")
        assert (answer.exit_code, list(tmp_path.iterdir())) == (2, [])
        assert complaint in answer.stderr


@pytest.mark.parametrize("ending", ["npz", "nc", "x3p", "txt", "npy", "vti", "NPZ"])
def test_a_surface_is_written_as_its_ending_says(invoke, tmp_path, ending):
    path = tmp_path / f"new.{ending}"
    answer = invoke("surface", "make", path, *MAKE, "--points", "16x12", "--periodic", "--json")
    assert answer.exit_code == 0, answer.stderr
    assert ("Note: a file" in answer.stderr) is (ending not in ("npz", "nc", "NPZ"))
    grid = rc.Grid((16, 12), (1e-3 / 12, 1e-3 / 12), periodic=True)
    made = rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(1))
    if ending == "vti":
        assert made.heights[::-1].tobytes() in path.read_bytes()
        return
    given = {"unit": "m", "size": grid.lengths} if ending == "npy" else {}
    surface = rc.read(path, **given)
    np.testing.assert_array_equal(surface.heights, made.heights)
    np.testing.assert_allclose(surface.grid.spacing, grid.spacing, rtol=4e-16)
    assert any(surface.grid.periodic) is (ending in ("npz", "nc", "NPZ"))


def test_info_looks_at_a_line_scan(invoke, tmp_path):
    line = rc.Surface(1e-6 * np.sin(np.arange(50.0)), rc.Grid(50, 2e-6))
    for ending in ("txt", "x3p", "npz", "nc"):
        path = tmp_path / f"line.{ending}"
        rc.write(line, path)
        answer = invoke("surface", "info", path, "--json")
        assert answer.exit_code == 0, answer.stderr
        assert f"Note: {path} holds a profile of 50 heights" in answer.stderr
        record = json.loads(answer.stdout)
        assert (record["shape"], record["rms"]) == ([50], pytest.approx(line.rms, rel=1e-12))
    table = invoke("surface", "info", tmp_path / "line.txt").stdout
    assert "heights: 50, in m, a profile" in table
    assert "about its slope" in table
    np.save(tmp_path / "bare.npy", line.heights)
    given = invoke("surface", "info", tmp_path / "bare.npy", "--unit", "m", "--size", "100um", "--json")
    assert json.loads(given.stdout)["spacing"] == pytest.approx([2e-6], rel=1e-15)
    wrong = invoke("surface", "info", tmp_path / "bare.npy", "--unit", "m", "--size", "1um x 2um")
    assert (wrong.exit_code, "one length" in wrong.stderr) == (2, True)


def test_a_profile_is_not_pressed_like_a_map(invoke, tmp_path):
    rc.write(rc.Surface(1e-6 * np.arange(9.0), rc.Grid(9, 2e-6)), tmp_path / "line.txt")
    answer = invoke("press", tmp_path / "line.txt", "--force", "1N", "--modulus", "1GPa")
    assert answer.exit_code == 2
    assert "it is a profile of 9 heights" in answer.stderr
    assert "say how it is pressed: --profile line" in answer.stderr


def test_info_says_what_a_file_holds(invoke, tmp_path, surface):
    heights = surface.heights.copy()
    heights[2, 3] = np.nan
    path = tmp_path / "part.npz"
    np.savez(path, heights=heights * 1e9, other=heights, spacing=np.array((2e-6, 1e-6)), unit="nm")
    answer = invoke("surface", "info", path, "--json")
    assert answer.exit_code == 0
    record = json.loads(answer.stdout)
    read = rc.read(path)
    assert record["shape"] == [24, 32]
    assert record["spacing"] == [2e-6, 1e-6]
    assert record["missing"] == 1
    assert record["rms"] == read.rms
    assert record["rms_levelled"] == read.levelled("plane").rms
    assert {channel["name"] for channel in record["channels"]} == {"heights", "other"}

    table = invoke("surface", "info", path).stdout
    assert "heights: 24 x 32, in nm" in table
    assert "1 (0.13%)" in table
    assert "24 x 32 cells, 48 µm x 32 µm, free" in table


def test_info_shows_the_channels_of_a_file_that_leaves_its_size_open(invoke, tmp_path, surface):
    path = tmp_path / "part.npy"
    np.save(path, surface.heights)
    answer = invoke("surface", "info", path)
    assert answer.exit_code == 2
    assert "24 x 32, without a unit" in answer.stdout
    assert answer.stderr.startswith(
        f"Error: {path}: it states no unit of its heights and no size; pass --unit"
    )
    failed = invoke("surface", "info", path, "--json")
    assert json.loads(failed.stdout)["channels"][0]["shape"] == [24, 32]
    assert json.loads(failed.stdout)["error"]["remedy"].startswith("pass --unit")

    given = invoke("surface", "info", path, "--unit", "m", "--size", "48um x 32um", "--json")
    assert given.exit_code == 0
    assert json.loads(given.stdout)["spacing"] == pytest.approx([2e-6, 1e-6], rel=1e-15)
    metres = invoke("surface", "info", path, "--unit", "1e-3", "--size", "32um", "--json")
    assert json.loads(metres.stdout)["rms"] == pytest.approx(1e-3 * surface.rms, rel=1e-12)


def test_the_user_names_a_channel(invoke, tmp_path, surface):
    path = tmp_path / "part.npz"
    np.savez(path, heights=surface.heights, other=2 * surface.heights, spacing=1e-6, unit="m")
    record = json.loads(invoke("surface", "info", path, "--channel", "other", "--json").stdout)
    assert record["rms"] == pytest.approx(2 * surface.rms, rel=1e-14)
    assert invoke("surface", "info", path, "--channel", "none").exit_code == 2


@pytest.mark.parametrize("unit", ["thou", "microns", "furlong", "microinch"])
def test_any_length_is_a_unit(invoke, tmp_path, surface, unit):
    path = tmp_path / "part.npy"
    np.save(path, surface.heights)
    record = json.loads(invoke("surface", "info", path, "--unit", unit, "--size", "1 mile", "--json").stdout)
    metres = {"thou": 2.54e-5, "microns": 1e-6, "furlong": 201.168402336805, "microinch": 2.54e-8}[unit]
    assert record["rms"] == pytest.approx(metres * surface.rms, rel=1e-12)


def test_numbers_that_are_no_heights_are_told_before_they_are_pressed(invoke, tmp_path, surface):
    path = tmp_path / "part.csv"
    rows = [range(32), *(surface.heights * 1e6)]
    path.write_text("".join(",".join(map(str, row)) + "\n" for row in rows))
    answer = invoke(
        *("press", path, "--unit", "um", "--size", "32um", "--depth", "0.1um", "--modulus", "1GPa", "--json")
    )
    assert answer.exit_code == 0
    assert (
        "Note: part.csv: its first row (0, 1, 2, ..., 31) holds places, not heights, and is left out"
        in answer.stderr
    )
    assert json.loads(answer.stdout)["shape"] == [24, 32]
