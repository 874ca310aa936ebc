"""Answers under a tangential load as labelled data, and on disk."""

import json

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.labels.variables import VARIABLES
from tables import read_table

MU = 0.3


@pytest.fixture(scope="module")
def pressed():
    grid = rc.Grid((20, 24), (2e-6, 1e-6))
    x, y = grid.coordinates[1] - 12e-6, grid.coordinates[0] - 20e-6
    surface = rc.Surface(-(x**2 + y[:, None] ** 2) / 2e-3, grid, ("a sphere",))
    return rc.press(surface, BODIES, depth=2e-8)


BODIES = (rc.Solid(1e11, 0.3), rc.Solid(1e11, 0.3))


@pytest.fixture(scope="module")
def state(pressed):
    return rc.slide(pressed, BODIES, friction=MU, force=(0.4 * MU * pressed.force, 0.3 * MU * pressed.force))


@pytest.fixture(scope="module")
def sliding(pressed):
    return rc.slide(pressed, BODIES, friction=MU, force=(MU * pressed.force, 0.0))


@pytest.fixture(scope="module")
def curve(pressed):
    forces = rc.load_cycle(0.6 * MU * pressed.force, steps=1)
    return rc.slide_curve(pressed, BODIES, friction=MU, forces=forces)


def test_every_variable_says_what_the_table_says(state, curve):
    for dataset in (state.to_dataset(), curve.to_dataset()):
        for name in set(dataset.variables) - {"axis", "component", "direction"}:
            assert dataset[name].attrs["long_name"] == VARIABLES[name].long_name, name
            assert dataset[name].attrs.get("units", "") == VARIABLES[name].unit, name


def test_a_dataset_holds_the_state(state, pressed):
    dataset = state.to_dataset()
    assert dataset.traction.dims == dataset.slip.dims == ("component", "y", "x")
    for name in ("traction", "slip", "slipping"):
        np.testing.assert_array_equal(dataset[name], getattr(state, name))
    assert dataset.slipping.dtype == dataset.contact.dtype == bool
    np.testing.assert_array_equal(dataset.pressure, pressed.pressure)
    np.testing.assert_array_equal(dataset.tangential_force.sel(component=["x", "y"]), state.force)
    np.testing.assert_array_equal(dataset.tangential_displacement, state.displacement)
    np.testing.assert_array_equal(dataset.tangential_stiffness, state.stiffness)
    np.testing.assert_array_equal(dataset.y[:2], [1e-6, 3e-6])
    for name in ("stick_area", "slip_area", "dissipated", "residual", "steps"):
        assert dataset[name] == getattr(state, name), name
    assert dataset.force == pressed.force
    assert dataset.friction == MU
    assert dataset.status == "converged"
    # What a reader adds up again: force, and the cone of friction.
    area = float(dataset.spacing.prod())
    np.testing.assert_allclose((dataset.traction.sum(("y", "x")) * area), state.force, rtol=1e-12)
    size = np.hypot(*dataset.traction.to_numpy())
    assert (size <= MU * dataset.pressure.to_numpy() * (1 + 1e-12)).all()


def test_a_dataset_holds_the_curve(curve):
    dataset = curve.to_dataset()
    assert dataset.sizes == {"load": 5, "component": 2, "axis": 2}
    np.testing.assert_array_equal(dataset.tangential_force, curve.force)
    np.testing.assert_array_equal(
        dataset.tangential_displacement.sel(component="x"), curve.displacement[:, 0]
    )
    np.testing.assert_array_equal(dataset.dissipated_energy, np.cumsum(curve.dissipated))
    assert dataset.capacity == curve.capacity
    assert list(dataset.status.to_numpy()) == ["converged"] * 5


def test_records_are_strict_json_and_lose_nothing(state, sliding, curve):
    for answer in (state, sliding, curve):
        record = answer.to_record()
        assert json.loads(json.dumps(record, allow_nan=False)) == record
        assert record["units"]["tangential_displacement"] == "m"
    assert state.to_record()["tangential_force"] == state.force.tolist()
    assert sliding.to_record()["sliding"] is True
    assert "slide" in sliding.to_record()["notes"][-1]
    assert curve.to_record()["slip_area"] == curve.slip_area.tolist()


@pytest.mark.parametrize("which", ["state", "sliding", "curve"])
def test_netcdf_comes_back_as_it_went(which, request, tmp_path):
    answer = request.getfixturevalue(which)
    rc.write(answer, tmp_path / "a.nc")
    with xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as back:
        went = answer.to_dataset()
        assert back.drop_attrs().identical(went.drop_attrs())
        for name in went.variables:
            assert back[name].dtype.kind == went[name].dtype.kind, name
            assert back[name].attrs.get("units") == went[name].attrs.get("units"), name
        assert went.attrs.items() <= back.attrs.items()
    if which != "curve":
        surface = rc.read(tmp_path / "a.nc")
        assert surface.grid == answer.problem.pressed.problem.grid
        np.testing.assert_array_equal(surface.heights, answer.problem.pressed.problem.surface.heights)


def test_a_table_has_a_column_for_each_component(curve, tmp_path):
    rc.write(curve, tmp_path / "a.csv")
    table = read_table(tmp_path / "a.csv")
    for at, axis in enumerate("xy"):
        np.testing.assert_array_equal(table[f"tangential_force_{axis}"], curve.force[:, at])
        np.testing.assert_array_equal(table[f"tangential_displacement_{axis}"], curve.displacement[:, at])
    np.testing.assert_array_equal(table["slip_area"], curve.slip_area)
    assert table.attrs["units"]["tangential_force_x"] == "N"
    assert set(table["capacity"]) == {curve.capacity}


def test_paraview_gets_components_that_point_up(state, tmp_path):
    rc.write(state, tmp_path / "a.vti")
    data = (tmp_path / "a.vti").read_bytes()
    for name, values in (
        ("traction_x", state.traction[0]),
        ("traction_y", -state.traction[1]),
        ("slip_y", -state.slip[1]),
        ("pressure", state.problem.pressed.pressure),
    ):
        assert f'Name="{name}"'.encode() in data
        assert values[::-1].tobytes() in data


def test_other_formats_are_refused(state, curve, tmp_path):
    with pytest.raises(rc.WriteError, match=r"a TangentialSolution is written as one of \.nc, \.vti$"):
        rc.write(state, tmp_path / "a.csv")
    with pytest.raises(rc.WriteError, match=r"a SlipCurve is written as one of \.nc, \.csv"):
        rc.write(curve, tmp_path / "a.vti")
    assert list(tmp_path.iterdir()) == []
