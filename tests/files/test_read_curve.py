"""Loading curves written, and read back to the last bit."""

import dataclasses
import functools

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.files.read_curve import read_curve
from roughcontact.files.write import write_netcdf

MODULUS = 1e11


def surface(periodic=False):
    grid = rc.Grid((16, 24), (2e-7, 1e-7), periodic)
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))


def on_a_line(body):
    grid = rc.Grid(64, 1e-7 / 3)
    line = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    return rc.loading_curve(line, MODULUS, forces=[1.0, 2.0], operator=body(grid, MODULUS))


def on_rings():
    rings = rc.RadialGrid(np.linspace(1e-5, 3e-5, 17))
    return rc.loading_curve(rc.RadialProfile(-(rings.radii**2), rings), MODULUS, depths=[1e-10, 2e-10])


CURVES = {
    "surface": lambda: rc.loading_curve(surface(), MODULUS, forces=[1e-4, 1e-3]),
    # In full contact the stiffness is infinite, and before the first touch there is none.
    "periodic": lambda: rc.loading_curve(surface(True), MODULUS, forces=[1e-4, 1e5]),
    "apart": lambda: rc.loading_curve(surface(), MODULUS, depths=[0.0, 1e-8]),
    "hard": lambda: rc.loading_curve(surface(), MODULUS, forces=[1e-4, 1e-3], hardness=5e9),
    "line": lambda: on_a_line(rc.line),
    "foundation": lambda: on_a_line(rc.foundation),
    "rings": on_rings,
}
CURVES = {name: functools.cache(curve) for name, curve in CURVES.items()}


@pytest.mark.parametrize("name", CURVES)
def test_every_curve_comes_back_to_the_last_bit(tmp_path, name):
    curve = CURVES[name]()
    rc.write(curve, tmp_path / "a.nc")
    back = read_curve(tmp_path / "a.nc")
    for field in dataclasses.fields(curve):
        went, came = getattr(curve, field.name), getattr(back, field.name)
        assert type(came) is type(went), field.name
        if isinstance(went, np.ndarray):
            assert came.dtype == went.dtype, field.name
            assert came.tobytes() == went.tobytes(), field.name
        elif dataclasses.is_dataclass(went):
            pairs = zip(dataclasses.astuple(went), dataclasses.astuple(came), strict=True)
            assert all(a.tobytes() == b.tobytes() for a, b in pairs)
        else:
            assert came == went, field.name
    assert back.to_record() == curve.to_record()


def test_added_columns_are_passed_over(tmp_path):
    curve = CURVES["surface"]()
    dataset = curve.to_dataset().assign(persson_contact_area=("load", [1.0, 2.0]))
    write_netcdf(dataset, tmp_path / "a.nc", {"source": "here"})
    assert read_curve(tmp_path / "a.nc").to_record() == curve.to_record()


def test_what_holds_no_curve_is_refused(tmp_path):
    rc.write(surface(), tmp_path / "surface.nc")
    with pytest.raises(rc.ReadError, match="holds no loading curve: no force, max_pressure, depth"):
        read_curve(tmp_path / "surface.nc")
    rc.write(rc.press(surface(), MODULUS, force=1e-3), tmp_path / "solution.nc")
    with pytest.raises(rc.ReadError, match="holds no loading curve"):
        read_curve(tmp_path / "solution.nc")
    rc.write(CURVES["surface"](), tmp_path / "a.csv")
    with pytest.raises(rc.ReadError, match=r"NetCDF files \(\.nc\) only; give a \.nc file"):
        read_curve(tmp_path / "a.csv")
    with pytest.raises(rc.ReadError, match="cannot be opened"):
        read_curve(tmp_path / "b.nc")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.drop_vars("stiffness"), "no stiffness"),
        (lambda d: d.assign(depth=("interval", [1.0])), "its depth of shape"),
        (lambda d: d.assign(rms=((), "high")), "its rms of shape"),
        (lambda d: d.assign(status=("load", ["converged", "bored"])), "its status is .*bored"),
        (lambda d: d.assign_attrs(geometry="sphere"), "its geometry is 'sphere'"),
    ],
    ids=["lost", "short", "text", "status", "geometry"],
)
def test_what_is_wrong_is_named(tmp_path, change, message):
    write_netcdf(change(CURVES["surface"]().to_dataset()), tmp_path / "a.nc")
    with pytest.raises(rc.ReadError, match=message):
        read_curve(tmp_path / "a.nc")


def test_damage_is_a_read_error(tmp_path):
    path = tmp_path / "a.nc"
    rc.write(CURVES["surface"](), path)
    whole = path.read_bytes()
    noise = np.random.default_rng(0).bytes(len(whole))
    for spoilt in (b"", whole[:100], whole[: len(whole) // 2], noise, whole[:512] + noise, bytes(len(whole))):
        path.write_bytes(spoilt)
        with pytest.raises(rc.ReadError):
            read_curve(path)


def test_a_curve_of_another_program_is_none(tmp_path):
    xarray.Dataset({"force": ("time", [1.0, 2.0])}).to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    with pytest.raises(rc.ReadError, match="holds no loading curve"):
        read_curve(tmp_path / "a.nc")
