"""Curves of stuck surfaces that are drawn back, written and read back to the last bit."""

import dataclasses
import functools

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.files.write import write_netcdf
from sticking import rough

RINGS = rc.RadialGrid.uniform(30, radius=6e-7)
BALL = rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS)


def patchy():
    surface, work = rough(16, periodic=True, slope=0.2, seed=1), np.full((16, 16), 0.01)
    work[3:7] = 0.0
    return rc.detachment_curve(rc.press(surface, 1.0, depth=0.4), work, depths=[0.2, 0.0, -5.0])


def on_a_line():
    grid = rc.Grid(32, 1.0, periodic=True)
    line = rc.Surface(np.cos(2 * np.pi * np.arange(32) / 32), grid)
    pressed = rc.press(line, 1.0, depth=0.5, operator=rc.line(grid, 1.0))
    return rc.detachment_curve(pressed, 0.01, depths=[0.3])


CURVES = {
    "rings": lambda: rc.detachment_curve(rc.press(BALL, 1e8, depth=2e-8), 10e-3, depths=[1e-8, 0.0, -2e-8]),
    # Pulled off: a depth of minus infinity, an event to no depth, infinite loss; and a note.
    "forces": lambda: rc.detachment_curve(rc.press(BALL, 1e8, force=1e-7), 10e-3, forces=[0.0, -1e-6]),
    "patchy": patchy,
    "line": on_a_line,
}
CURVES = {name: functools.cache(curve) for name, curve in CURVES.items()}


@pytest.mark.parametrize("name", CURVES)
def test_every_curve_comes_back_to_the_last_bit(tmp_path, name):
    curve = CURVES[name]()
    rc.write(curve, tmp_path / "a.nc")
    back = rc.read_detachment_curve(tmp_path / "a.nc")
    for field in dataclasses.fields(curve):
        went, came = getattr(curve, field.name), getattr(back, field.name)
        assert type(came) is type(went), field.name
        if isinstance(went, np.ndarray):
            assert came.dtype == went.dtype, field.name
            assert came.tobytes() == went.tobytes(), field.name
        elif field.name == "detachments":  # some hold a NaN, which equals nothing
            assert [str(event) for event in came] == [str(event) for event in went]
        else:
            assert came == went, field.name
    assert back.to_record() == curve.to_record()


def test_these_curves_hold_what_is_hard_to_write():
    """Else the test above would say nothing of it."""
    forces = CURVES["forces"]()
    assert forces.control == "force"
    assert np.isneginf(forces.depth).any()
    assert np.isinf(forces.detachments[-1].lost)
    assert np.isnan(forces.detachments[-1].depth_after)
    assert forces.preload_too_small
    assert forces.notes
    assert not CURVES["rings"]().notes
    assert not CURVES["line"]().detachments
    assert np.ndim(CURVES["patchy"]().work) == 2


def test_a_table_has_a_line_a_load(tmp_path):
    curve = CURVES["rings"]()
    rc.write(curve, tmp_path / "a.csv")
    lines = [line for line in (tmp_path / "a.csv").read_text().splitlines() if line[0] not in "#"]
    assert len(lines) == 1 + len(curve)
    assert "lowest_force" in lines[0]


@pytest.mark.parametrize("ending", [".nc", ".vti"])
def test_a_state_is_written(tmp_path, ending):
    pressed = rc.press(rough(16, periodic=True, slope=0.2, seed=1), 1.0, depth=0.4)
    (state,) = rc.detachment_path(pressed, 0.01, depths=[-0.1])
    rc.write(state, tmp_path / f"a{ending}")
    if ending == ".nc":
        with xarray.open_dataset(tmp_path / "a.nc") as dataset:
            np.testing.assert_array_equal(dataset["pressure"], state.pressure)
            assert dataset["detachment_cells"].values.tolist() == [each.cells for each in state.detachments]
            assert float(dataset["pull_off_force"]) == state.pull_off_force


def test_what_holds_no_such_curve_is_refused(tmp_path):
    rc.write(CURVES["rings"](), tmp_path / "a.csv")
    with pytest.raises(rc.ReadError, match=r"NetCDF files \(\.nc\) only"):
        rc.read_detachment_curve(tmp_path / "a.csv")
    ball = rc.shapes.paraboloid(rc.Grid((16, 16), 1e-6), radius=1e-4)
    rc.write(rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]), tmp_path / "curve.nc")
    with pytest.raises(rc.ReadError, match="holds no loading curve: no adhesive_energy"):
        rc.read_detachment_curve(tmp_path / "curve.nc")
    write_netcdf(CURVES["rings"]().to_dataset().drop_vars("detachment_lost"), tmp_path / "a.nc")
    with pytest.raises(rc.ReadError, match="no detachment_lost"):
        rc.read_detachment_curve(tmp_path / "a.nc")
