"""A long table holds every number with all its digits, where readers of tables look for it."""

import csv

import numpy as np
import pandas
import pytest
import xarray

from roughcontact.files.aside import WriteError
from roughcontact.study.long_table import write_long_csv

FORCE = np.random.default_rng(2).lognormal(size=(2, 3, 4))


def dataset():
    dims = ("hurst", "sample", "load")
    status = np.full((2, 3), "done", dtype="<U7")
    status[1, 2] = "failed"
    force = FORCE.copy()
    force[1, 2] = force[0, 0, 3] = np.nan
    return xarray.Dataset(
        {
            "status": (dims, np.where(force > 1, "converged", "stagnated, alas")),
            "force": (dims, force, {"units": "N"}),
            "common": ("load", np.arange(4.0)),
            "resolved": (dims, force > 1),
            "rms": (("hurst", "sample"), FORCE[..., 0], {"units": "m"}),
            "lengths": (("hurst", "axis"), [[1.0, 2.0], [3.0, 4.0]], {"units": "m"}),
            "sides": ("axis", [1.0, 2.0], {"units": "m"}),
            "secant": (("hurst", "sample", "interval"), FORCE[..., :3]),
            "modulus": ((), 1.1e11, {"units": "Pa"}),
            "case_status": (("hurst", "sample"), status),
        },
        {"hurst": [0.1, 1 / 3], "axis": ["y", "x"], "periodic": False},
        {"title": "two\nlines"},
    )


@pytest.fixture
def path(tmp_path):
    write_long_csv(dataset(), tmp_path / "out.csv")
    return tmp_path / "out.csv"


def test_every_value_stands_in_its_line(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    names, *rows = csv.reader(lines)
    assert names == [
        *(
            "hurst",
            "sample",
            "load",
            "force [N]",
            "common",
            "resolved",
            "rms [m]",
            "lengths_y [m]",
            "lengths_x [m]",
        ),
        *("periodic", "sides_y [m]", "sides_x [m]", "modulus [Pa]", "status", "case_status"),
    ]
    table = {tuple(map(float, row[:3])): dict(zip(names, row, strict=True)) for row in rows}
    data = dataset()
    # The case that failed has no lines; a force that is missing in one that did not has one, since words are there.
    assert len(rows) == len(table) == 2 * 3 * 4 - 4
    for (hurst, sample, load), found in table.items():
        case = data.sel(hurst=hurst).isel(sample=int(sample))
        point = case.isel(load=int(load))
        np.testing.assert_array_equal(float(found["force [N]"]), point["force"])
        assert float(found["rms [m]"]) == case["rms"]
        assert float(found["lengths_x [m]"]) == case["lengths"][1]
        assert found["resolved"] == str(int(point["resolved"]))
        assert found["status"] == point["status"]
        assert float(found["common"]) == load
        assert (found["modulus [Pa]"], found["periodic"], found["sides_x [m]"]) == (
            "110000000000.0",
            "0",
            "2.0",
        )


def test_what_has_no_column_is_returned(tmp_path):
    assert write_long_csv(dataset(), tmp_path / "out.csv") == ["secant"]
    assert write_long_csv(dataset().drop_vars("secant"), tmp_path / "out.csv") == []


def test_pandas_reads_it_without_options(path):
    table = pandas.read_csv(path)
    np.testing.assert_allclose(table["force [N]"], dataset()["force"].to_numpy().reshape(-1)[:20], rtol=1e-15)
    assert table["status"].dtype.kind in "OUT"


def test_numpy_reads_it(path):
    table = np.genfromtxt(path, delimiter=",", names=True, usecols=range(9))
    assert table.dtype.names[:4] == ("hurst", "sample", "load", "force_N")
    data = dataset()["force"].to_numpy().reshape(-1)[:20]
    np.testing.assert_array_equal(table["force_N"], data)


def test_points_that_were_filled_up_are_no_lines(tmp_path):
    data = dataset()[["force", "resolved", "common", "case_status"]]
    write_long_csv(data, tmp_path / "out.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert len(lines) == 1 + 2 * 3 * 4 - 4 - 1


def test_points_belong_to_cases_where_there_are_cases(tmp_path):
    data = xarray.Dataset(
        {
            "force": ("load", np.arange(9.0)),
            "rms": ("sample", [1.0, 2.0]),
            "case_status": ("sample", ["done"] * 2),
        }
    )
    write_long_csv(data, tmp_path / "out.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert (lines[0], lines[-2:]) == ("sample,rms,case_status", ["0,1.0,done", "1,2.0,done"])


def test_more_lines_than_are_written_at_once(tmp_path):
    values = np.random.default_rng(1).random((150, 200))
    write_long_csv(xarray.Dataset({"a": (("sample", "load"), values)}), tmp_path / "out.csv")
    table = np.genfromtxt(tmp_path / "out.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["a"], values.reshape(-1))


def test_scalars_alone_are_one_line_and_nothing_is_none(tmp_path):
    write_long_csv(xarray.Dataset({"a": ((), 1.5)}), tmp_path / "out.csv")
    assert (tmp_path / "out.csv").read_text() == "a\n1.5\n"
    write_long_csv(xarray.Dataset(), tmp_path / "none.csv")
    assert (tmp_path / "none.csv").read_text() == "\n"


def test_where_it_cannot_be_written(tmp_path):
    with pytest.raises(WriteError, match="there is no folder"):
        write_long_csv(dataset(), tmp_path / "no" / "out.csv")
