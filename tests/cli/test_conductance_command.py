import json
import shutil

import numpy as np
import pytest
import xarray

from tables import read_table

MODULUS = ("--modulus", "110GPa")
COPPER = ("--resistivity", "17nohm*m")


@pytest.fixture
def curve(invoke, rough, tmp_path, kept):
    """Return the file of a curve in a folder of the test; it is computed once."""
    folder = tmp_path / "result"
    if not (kept / "curve").exists():
        words = ("curve", rough, "--forces", "1mN:1N:5", *MODULUS, "--out", kept / "curve")
        assert invoke(*words).exit_code == 0
    shutil.copytree(kept / "curve", folder)
    return folder / "curve.nc"


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    return tmp_path_factory.mktemp("kept")


def test_resistance_of_a_curve(invoke, curve):
    """R = E* rho / k for equal bodies (thesis, eq. 4.2)."""
    both = (*COPPER, "--conductivity", "400W/m/K,50W/m/K", "--of", "total")
    answer = invoke("conductance", curve, *both, "--json")
    assert answer.exit_code == 0
    record = json.loads(answer.stdout)
    with xarray.open_dataset(curve, engine="h5netcdf") as dataset:
        stiffness = dataset.stiffness.to_numpy()
    np.testing.assert_allclose(record["electrical_resistance"], 110e9 * 17e-9 / stiffness, rtol=1e-14)
    np.testing.assert_allclose(
        record["thermal_resistance"], 110e9 * (1 / 400 + 1 / 50) / 2 / stiffness, rtol=1e-14
    )
    assert record["units"]["electrical_resistance"] == "ohm"
    assert record["units"]["thermal_resistance"] == "K W-1"


def test_loads_that_are_not_resolved_are_marked(invoke, curve):
    """As in the table of the curve itself."""
    with xarray.open_dataset(curve, engine="h5netcdf") as dataset:
        resolved = dataset.resolved.to_numpy().astype(bool).tolist()
    assert set(resolved) == {True, False}
    lines = invoke("conductance", curve, *COPPER).stdout.splitlines()[1:-2]
    assert [not line.endswith("not resolved") for line in lines] == resolved
    assert json.loads(invoke("conductance", curve, *COPPER, "--json").stdout)["resolved"] == resolved


def test_by_default_it_is_that_of_the_interface_per_area(invoke, curve):
    """h_c = (harmonic mean of the conductivities) K/(E* A0), against pressure."""
    words = ("conductance", curve, "--conductivity", "16W/m/K,160W/m/K")
    record = json.loads(invoke(*words, "--json").stdout)
    with xarray.open_dataset(curve, engine="h5netcdf") as dataset:
        areal, force = dataset.interfacial_stiffness_per_area.to_numpy(), dataset.force.to_numpy()
    expected = 2 * 16 * 160 / 176 * areal / 110e9
    np.testing.assert_allclose(record["thermal_conductance_per_area"], expected, rtol=1e-14)
    np.testing.assert_allclose(record["thermal_resistance_per_area"], 1 / expected, rtol=1e-14)
    assert record["units"]["thermal_conductance_per_area"] == "W m-2 K-1"
    assert record["units"]["thermal_resistance_per_area"] == "m2 K W-1"
    assert record["force"] == force.tolist()
    assert record["of"] == "interface"
    shown = invoke(*words).stdout
    assert shown.startswith("nominal pressure [")
    assert "thermal conductivities   16 and 160 W/(m K)" in shown
    assert "conductance of           the interface only" in shown
    whole = invoke(*words, "--of", "total").stdout
    assert whole.startswith("force [")
    assert "spreading resistance included" in whole


def test_of_the_interface(invoke, curve):
    total, interface = (
        json.loads(invoke("conductance", curve, *COPPER, "--of", of, "--json").stdout)[
            "electrical_resistance"
        ]
        for of in ("total", "interface")
    )
    assert (np.array(interface) < np.array(total)).all()


@pytest.mark.usefixtures("drawn")
def test_a_folder_serves_and_gets_files(invoke, curve):
    answer = invoke("conductance", curve.parent, *COPPER, "--out", curve.parent)
    assert answer.exit_code == 0
    assert "electrical resistance per area [" in answer.stdout
    assert {"conductance.csv", "conductance.nc", "conductance.png"} <= {
        p.name for p in curve.parent.iterdir()
    }
    table = read_table(curve.parent / "conductance.csv")
    assert (table["electrical_resistance"] > 0).all()


def test_a_curve_has_the_columns_at_once(invoke, rough):
    words = ("curve", rough, "--forces", "1mN:1N:3", *MODULUS, *COPPER)
    record = json.loads(invoke(*words, "--json").stdout)
    np.testing.assert_allclose(
        np.array(record["electrical_resistance"]) * record["interfacial_stiffness"], 110e9 * 17e-9, rtol=1e-14
    )
    whole = json.loads(invoke(*words, "--of", "total", "--json").stdout)
    np.testing.assert_allclose(
        np.array(whole["electrical_resistance"]) * whole["stiffness"], 110e9 * 17e-9, rtol=1e-14
    )
    assert record["units"]["electrical_conductance"] == "S"
    assert "resistance per area [" in invoke(*words).stdout


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "give --resistivity, --conductivity, or both"),
        (("--resistivity", "5N"), "'5N' is not a resistivity"),
        (("--resistivity=-1"), "must not be negative"),
        (("--resistivity", "1,2,3"), "give one for both or two"),
        (("--conductivity", "400W/m"), "is not a thermal conductivity"),
        (("--resistivity", "0"), "both bodies have the resistivity 0"),
    ],
)
def test_nonsense_is_one_line(invoke, curve, words, message):
    answer = invoke("conductance", curve, *([words] if isinstance(words, str) else words))
    assert answer.exit_code == 2
    assert message in answer.stderr
    assert len(answer.stderr.strip().splitlines()) == 1


def test_what_is_no_curve_is_refused(invoke, rough, tmp_path):
    for path, message in ((rough, "is not a curve.nc"), (tmp_path / "none.nc", "no such file")):
        answer = invoke("conductance", path, *COPPER)
        assert answer.exit_code == 2
        assert message in answer.stderr
    xarray.Dataset({"heights": ("x", [1.0])}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    answer = invoke("conductance", tmp_path / "other.nc", *COPPER)
    assert answer.exit_code == 2
    assert "not a stiffness curve" in answer.stderr
