"""Results on disk: whole or not there, and read back by the tools people use."""

from __future__ import annotations

import csv
import hashlib
import json
import os
import struct
import sys
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pandas
import pytest
import xarray

import roughcontact as rc
from roughcontact.files.aside import WriteError, output_folder, written_aside
from roughcontact.files.provenance import provenance, surface_hash
from roughcontact.files.standard_streams import write_standard_output
from roughcontact.files.write import netcdf_bytes, write_csv, write_json, write_netcdf

MODULUS = 1e11
GRID = rc.Grid((32, 32), (1e-7, 1e-7))


@pytest.fixture(scope="module")
def surface() -> rc.Surface:
    made = rc.self_affine(GRID, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    heights = made.heights.copy()
    heights[3, 4] = np.nan
    return rc.Surface(heights, GRID, ("made, for a test", "levelled"))


@pytest.fixture(scope="module")
def solution(surface):
    return rc.press(surface, MODULUS, force=1e-3).to_dataset()


@pytest.fixture(scope="module")
def curve(surface):
    return rc.loading_curve(surface, MODULUS, forces=np.geomspace(1e-5, 1e-2, 4)).to_dataset()


@pytest.fixture(scope="module")
def source(surface):
    return provenance(
        surface,
        modulus=MODULUS,
        control="force = 1 mN",
        tolerance=1e-8,
        command=["roughcontact", "press", "a b.x3p"],
    )


# NetCDF


@pytest.mark.parametrize("which", ["solution", "curve"])
def test_netcdf_comes_back_as_it_went(which, request, tmp_path, source):
    dataset = request.getfixturevalue(which)
    write_netcdf(dataset, tmp_path / "a.nc", source)
    with xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as back:
        assert back.identical(dataset.assign_attrs(source).assign_attrs(back.attrs))
        assert back.attrs == dataset.attrs | source
        for name in dataset.variables:
            assert back[name].dtype.kind == dataset[name].dtype.kind, name
    assert [file.name for file in tmp_path.iterdir()] == ["a.nc"]


def test_maps_are_compressed_and_any_hdf5_reader_opens_them(solution, tmp_path):
    import h5py

    write_netcdf(solution, tmp_path / "a.nc")
    with h5py.File(tmp_path / "a.nc") as file:
        assert file["pressure"].compression == "gzip"
        assert file["pressure"].attrs["units"] == "Pa"
        np.testing.assert_array_equal(file["pressure"][()], solution.pressure)


def test_the_dataset_itself_is_not_touched(curve, tmp_path, source):
    before = dict(curve.attrs)
    write_netcdf(curve, tmp_path / "a.nc", source)
    write_csv(curve, tmp_path / "a.csv")
    assert curve.attrs == before


# CSV


def test_numpy_reads_the_table_with_every_digit(curve, tmp_path, source):
    write_csv(curve, tmp_path / "a.csv")
    table = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    points = [name for name in curve.data_vars if curve[name].dims == ("load",) and name != "status"]
    for column, name in zip(table.dtype.names, points, strict=False):
        assert column.startswith(name)  # NumPy writes "force_N" for "force [N]"
        np.testing.assert_array_equal(table[column], curve[name].astype(float))
    assert {"force", "depth", "stiffness", "contact_area", "resolved"} <= set(points)


def _title(dataset, name):
    """Return the header of a column as the page on files states it."""
    unit = dataset[name].attrs.get("units", "1")
    return name if unit == "1" else f"{name} [{unit}]"


def test_pandas_reads_the_table_with_every_digit(curve, tmp_path, source):
    write_csv(curve, tmp_path / "a.csv")
    # By Python's float, since older pandas drops the last digits of its own accord.
    reals = {name: float for name in curve.data_vars if curve[name].dtype.kind == "f"}
    table = pandas.read_csv(tmp_path / "a.csv", converters={_title(curve, name): float for name in reals})
    assert {"force [N]", "depth [m]", "stiffness [N m-1]", "status"} <= set(table.columns)
    for name in curve.data_vars:
        if curve[name].dims in (("load",), ()):
            np.testing.assert_array_equal(table[_title(curve, name)].to_numpy(), curve[name].to_numpy())


def test_the_header_states_units_and_scales_are_columns(curve, tmp_path):
    write_csv(curve, tmp_path / "a.csv")
    lines = (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()
    header = lines[0].split(",")
    assert header[0] == "force [N]"
    assert {"stiffness [N m-1]", "lengths_y [m]", "lengths_x [m]", "resolved"} <= set(header)
    rows = list(csv.DictReader(lines))
    assert len(rows) == len(lines) - 1 == curve.sizes["load"]
    assert {row["modulus [Pa]"] for row in rows} == {repr(MODULUS)}
    assert {row["full_contact_stiffness [N m-1]"] for row in rows} == {
        repr(float(curve.full_contact_stiffness))
    }


def test_a_single_state_is_a_table_of_one_row(solution, tmp_path):
    write_csv(solution, tmp_path / "a.csv")
    with open(tmp_path / "a.csv", encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 1
    assert float(rows[0]["force [N]"]) == float(solution.force)
    assert rows[0]["status"] == "converged"


def test_infinity_and_nan_survive_the_table(curve, tmp_path):
    changed = curve.assign(stiffness=("load", [np.inf, np.nan, 1.0, 2.0]))
    write_csv(changed, tmp_path / "a.csv")
    table = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["stiffness"], [np.inf, np.nan, 1.0, 2.0])


def test_points_may_lie_along_any_dimension(tmp_path):
    dataset = xarray.Dataset(
        {
            "density": ("bin", [1e-20, 2e-20 / 3], {"units": "m4"}),
            "reliable": ("bin", [True, False]),
            "other": ("load", [1.0, 2.0, 3.0]),
            "hurst": ((), 0.8, {"units": "1"}),
        },
        attrs={"kind": "C2D"},
    )
    write_csv(dataset, tmp_path / "a.csv", dimension="bin")
    assert (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines() == [
        "density [m4],reliable,hurst",
        "1e-20,1,0.8",
        f"{2e-20 / 3!r},0,0.8",
    ]
    with pytest.raises(ValueError, match="nothing lies along 'x': choose one of bin, load"):
        write_csv(dataset, tmp_path / "b.csv", dimension="x")


# JSON


def test_json_holds_record_and_provenance(tmp_path, source):
    write_json({"force": 1.5, "name": "µ"}, tmp_path / "a.json", source)
    assert json.loads((tmp_path / "a.json").read_text(encoding="utf-8")) == {
        "force": 1.5,
        "name": "µ",
        "provenance": source,
    }


def test_json_refuses_what_json_does_not_know(tmp_path):
    with pytest.raises(ValueError, match="JSON"):
        write_json({"force": float("nan")}, tmp_path / "a.json")
    assert list(tmp_path.iterdir()) == []


# whole or not there


@pytest.mark.parametrize("failure", [KeyboardInterrupt, RuntimeError, OSError(28, "No space left on device")])
def test_a_failure_leaves_what_was_there(failure, tmp_path):
    target = tmp_path / "a.txt"
    target.write_text("old")

    def fail() -> None:
        with written_aside(target) as aside:
            aside.write_text("half")
            raise failure

    with pytest.raises((KeyboardInterrupt, RuntimeError, WriteError)):
        fail()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_full_disk_is_named_with_the_file(tmp_path):
    with pytest.raises(WriteError, match=r"a\.txt: No space left"), written_aside(tmp_path / "a.txt"):
        raise OSError(28, "No space left on device")


def test_an_interrupted_netcdf_leaves_nothing(curve, tmp_path, monkeypatch):
    write = Path.write_bytes

    def interrupted(path, data):
        write(path, data[: len(data) // 2])
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "write_bytes", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_netcdf(curve, tmp_path / "a.nc")
    assert list(tmp_path.iterdir()) == []


def test_places_that_cannot_be_written_are_named(tmp_path, monkeypatch):
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("x")
    for path, remedy in (
        (tmp_path / "nowhere" / "a.json", "create it first"),
        (tmp_path / "folder", "add a file name"),
        (tmp_path / "file" / "a.json", "create it first"),
    ):
        with pytest.raises(WriteError, match=remedy) as caught:
            write_json({}, path)
        assert str(path) in str(caught.value)
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(WriteError, match="write-protected"):
        write_json({}, tmp_path / "file")
    assert (tmp_path / "file").read_text() == "x"
    assert {file.name for file in tmp_path.iterdir()} == {"folder", "file"}


@pytest.mark.skipif(os.name != "posix", reason="devices are files on POSIX systems only")
def test_a_device_is_not_replaced():
    with pytest.raises(WriteError, match="device"):
        write_json({}, os.devnull)


@pytest.mark.skipif(os.name != "posix", reason="links need rights on other systems")
def test_a_link_stays_and_its_file_is_replaced(tmp_path):
    (tmp_path / "real.json").write_text("old")
    (tmp_path / "link.json").symlink_to("real.json")
    write_json({"a": 1}, tmp_path / "link.json")
    assert (tmp_path / "link.json").is_symlink()
    assert json.loads((tmp_path / "real.json").read_text()) == {"a": 1}


# folders


def test_a_folder_is_made_with_its_parents_and_stays(tmp_path):
    with output_folder(tmp_path / "a" / "b") as folder:
        assert folder.is_dir()
        assert list(folder.iterdir()) == []
    assert (tmp_path / "a" / "b").is_dir()


def test_a_failed_run_takes_its_empty_folders_with_it(tmp_path):
    (tmp_path / "a").mkdir()
    with pytest.raises(KeyboardInterrupt), output_folder(tmp_path / "a" / "b" / "c"):
        raise KeyboardInterrupt
    assert (tmp_path / "a").is_dir()
    assert list((tmp_path / "a").iterdir()) == []


def test_a_failed_run_leaves_folders_that_hold_something(tmp_path):
    def fail() -> None:
        with output_folder(tmp_path / "a" / "b") as folder:
            (folder / "notes.txt").write_text("mine")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert (tmp_path / "a" / "b" / "notes.txt").read_text() == "mine"


def test_a_file_in_the_way_of_a_folder_is_named(tmp_path):
    (tmp_path / "file").write_text("x")
    for path in (tmp_path / "file", tmp_path / "file" / "b"):
        with pytest.raises(WriteError, match="choose another name"), output_folder(path):
            pytest.fail("nothing may be computed for a folder that cannot be used")


def test_a_folder_that_cannot_be_written_is_found_before_the_work(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.touch", refuse)
    with pytest.raises(WriteError, match="Permission denied"), output_folder(tmp_path / "a"):
        pytest.fail("nothing may be computed for a folder that cannot be used")
    assert list(tmp_path.iterdir()) == []


# provenance


def test_provenance_says_where_a_result_comes_from(surface, source):
    assert source["source"] == f"roughcontact {rc.__version__}"
    assert source["input_reduced_modulus_in_Pa"] == MODULUS
    assert source["input_control"] == "force = 1 mN"
    assert source["tolerance"] == 1e-8
    assert source["input_surface"] == "made, for a test\nlevelled"
    assert source["input_sha256"] == surface_hash(surface)
    assert source["numpy_version"] == np.__version__
    assert "roughcontact press a b.x3p" in source["history"]
    written = datetime.fromisoformat(source["date_created"])
    assert written.tzinfo is not None
    assert timedelta(0) <= datetime.now(UTC) - written < timedelta(hours=1)


def test_what_is_not_known_is_left_out():
    assert set(provenance()) == {"source", "date_created", "python_version", "numpy_version", "scipy_version"}


def test_the_hash_is_that_of_grid_and_little_endian_rows():
    grid = rc.Grid((1, 3), (0.5, 0.25), periodic=(False, True))
    digest = hashlib.sha256(b"((1, 3), (0.5, 0.25), (False, True))" + struct.pack("<3d", 1.0, -2.0, 0.0))
    assert surface_hash(rc.Surface(np.array([[1.0, -2.0, -0.0]]), grid)) == digest.hexdigest()


def test_the_hash_tells_surfaces_apart_and_knows_equal_ones(surface):
    heights = surface.heights.copy()
    assert surface_hash(rc.Surface(heights, GRID, ("other words",))) == surface_hash(surface)
    assert surface_hash(rc.Surface(np.asfortranarray(heights), GRID)) == surface_hash(surface)
    negative = np.where(np.isnan(heights), -np.nan, heights)
    assert surface_hash(rc.Surface(negative, GRID)) == surface_hash(surface)
    heights[0, 0] = np.nextafter(heights[0, 0], 1)
    others = (
        rc.Surface(heights, GRID),
        rc.Surface(surface.heights, rc.Grid(GRID.shape, 2e-7)),
        rc.Surface(surface.heights, rc.Grid(GRID.shape, GRID.spacing, periodic=True)),
    )
    assert len({surface_hash(each) for each in (surface, *others)}) == 4


def test_the_bytes_are_those_of_a_file_that_holds_the_dataset(tmp_path):
    rng = np.random.default_rng(1)
    dataset = xarray.Dataset(
        {"pressure": (("y", "x"), rng.normal(size=(40, 30)), {"units": "Pa"}), "force": 1.5, "name": "a"},
        {"x": np.arange(30.0)},
        {"title": "pressures"},
    )
    dataset["pressure"][3, 4] = np.nan
    (tmp_path / "a.nc").write_bytes(netcdf_bytes(dataset))
    back = xarray.load_dataset(tmp_path / "a.nc", engine="h5netcdf")
    xarray.testing.assert_identical(back, dataset)


def test_maps_are_compressed():
    dataset = xarray.Dataset({"gap": (("y", "x"), np.zeros((500, 500)))})
    assert len(netcdf_bytes(dataset)) < 0.05 * dataset["gap"].nbytes


def test_a_file_goes_to_standard_output_after_what_was_printed(capsysbinary):
    sys.stdout.write("before")
    write_standard_output(b"\x89\x00bytes")
    assert capsysbinary.readouterr().out == b"before\x89\x00bytes"
