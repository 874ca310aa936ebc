"""NetCDF: the layout of contact.engineering, our own, and other maps with coordinates."""

import contextlib
import sys

import numpy as np
import pytest
import xarray
from scipy.io import netcdf_file

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_line

HEIGHTS = np.arange(12.0).reshape(3, 4)


def contact_engineering(path, *, unit="um", periodic=0, line=False, length=4.0, fill=None, mask=None):
    """Write heights (x, y), the transposed picture."""
    with netcdf_file(path, "w") as file:
        for name, size, full in (("x", 4, length), ("y", 3, 3.0)):
            file.createDimension(name, size)
            variable = file.createVariable(name, "f8", (name,))
            variable[:] = np.arange(size) + 0.5
            variable.length = full
            variable.periodic = periodic
            if unit:
                variable.unit = unit
        heights = file.createVariable("heights", "f8", ("x",) if line else ("x", "y"))
        heights[:] = HEIGHTS[0] if line else HEIGHTS.T
        if fill is not None:
            heights._FillValue = fill
        if mask is not None:
            file.createVariable("mask", "i4", ("x", "y"))[:] = mask.T
        if unit:
            heights.unit = unit
    return path


def test_the_picture_is_upright_and_in_metres(tmp_path):
    surface = rc.read(contact_engineering(tmp_path / "a.nc"))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.lengths, (3e-6, 4e-6), rtol=1e-15)
    assert surface.provenance[0].startswith("read from a.nc (NetCDF, channel 'heights', sha256 ")


def test_a_periodic_file_is_read_as_free_only_by_choice(tmp_path):
    path = contact_engineering(tmp_path / "a.nc", periodic=1)
    assert rc.read(path).grid.periodic == (True, True)
    free = rc.read(path, periodic=False)
    assert free.grid.periodic == (False, False)
    assert "read as free, though the file states that it is periodic" in free.provenance
    assert rc.read(contact_engineering(tmp_path / "b.nc"), periodic=True).grid.periodic == (True, True)


def test_no_unit_or_an_arbitrary_one_is_refused(tmp_path):
    with pytest.raises(
        rc.ReadError, match=r"a\.nc: it states no unit of its heights and no size; pass unit="
    ):
        rc.read(contact_engineering(tmp_path / "a.nc", unit=None))
    path = contact_engineering(tmp_path / "b.nc", unit="a.u.")
    with pytest.raises(rc.ReadError, match=r"b\.nc: it states heights in 'a\.u\.', which is no length"):
        rc.read(path)
    surface = rc.read(path, unit="nm", size=4e-6)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-12)


def test_marked_points_are_missing(tmp_path):
    surface = rc.read(contact_engineering(tmp_path / "a.nc", fill=5.0))
    assert np.array_equal(np.isnan(surface.heights), HEIGHTS == 5)
    masked = rc.read(contact_engineering(tmp_path / "b.nc", mask=HEIGHTS > 9))
    assert np.array_equal(np.isnan(masked.heights), HEIGHTS > 9)


def test_a_length_that_contradicts_the_coordinates_is_refused(tmp_path):
    with pytest.raises(rc.ReadError, match=r"a\.nc: its length 5 along x contradicts 4 steps of 1"):
        rc.read(contact_engineering(tmp_path / "a.nc", length=5.0))


def test_a_line_scan_is_read_as_one_and_not_as_a_map(tmp_path):
    path = contact_engineering(tmp_path / "line.nc", line=True)
    with pytest.raises(rc.ReadError, match=r"line\.nc: it is a profile of 4 heights.*read_line"):
        rc.read(path)
    line = read_line(path)
    np.testing.assert_allclose(line.heights, HEIGHTS[0] * 1e-6, rtol=1e-15)
    assert line.grid.shape == (4,)
    with pytest.raises(rc.ReadError, match="a map of 3 x 4 heights"):
        read_line(contact_engineering(tmp_path / "map.nc"))


def dataset(**changes):
    coordinates = {
        "lat": ("lat", [10.0, 12.0, 14.0], {"units": "mm"}),
        "lon": ("lon", [1.0, 1.5, 2.0, 2.5], {"units": "mm"}),
    }
    data = {
        "elevation_height": (("lat", "lon"), HEIGHTS, {"units": "um"}),
        "slope": (("lat", "lon"), HEIGHTS),
    }
    return xarray.Dataset(data | changes, coordinates)


@pytest.mark.parametrize("how", ["NETCDF4", "NETCDF3_CLASSIC", "NETCDF3_64BIT"])
def test_a_map_with_even_coordinates(tmp_path, how):
    engine = "h5netcdf" if how == "NETCDF4" else "scipy"
    dataset().to_netcdf(tmp_path / "a.nc", engine=engine, format=how)
    surface = rc.read(tmp_path / "a.nc")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2e-3, 0.5e-3), rtol=1e-12)
    assert [(c.name, c.is_height) for c in channels(tmp_path / "a.nc")] == [
        ("elevation_height", True),
        ("slope", False),
    ]
    with pytest.raises(rc.ReadError, match="no channel 'depth', only 'elevation_height'"):
        rc.read(tmp_path / "a.nc", channel="depth")


@pytest.mark.parametrize(
    ("rows", "columns", "spacing"),
    [
        ([0, 2], slice(None), (4e-3, 0.5e-3)),
        ([2, 1, 0], [3, 1], (2e-3, 1e-3)),
        ([1, 0], [0, 3], (2e-3, 1.5e-3)),
    ],
)
def test_coordinates_that_fall_and_only_two_of_them(tmp_path, rows, columns, spacing):
    dataset().isel(lat=rows, lon=columns).to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    surface = rc.read(tmp_path / "a.nc")
    np.testing.assert_allclose(surface.heights, HEIGHTS[rows][:, columns] * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, spacing, rtol=1e-12)


@pytest.mark.parametrize(("error", "even"), [(2.4e-5, True), (2.6e-5, False)])
def test_coordinates_are_even_within_those_of_single_precision(tmp_path, error, even):
    """A hundred-thousandth of the largest, 2.5 mm: the steps around one that is moved by an error differ by it."""
    path = tmp_path / "a.nc"
    moved = dataset().assign_coords(lon=("lon", [1.0, 1.5 + error, 2.0, 2.5], {"units": "mm"}))
    moved.to_netcdf(path, engine="h5netcdf")
    if even:
        assert rc.read(path).grid.spacing == pytest.approx((2e-3, 0.5e-3), rel=1e-12)
    else:
        with pytest.raises(rc.ReadError, match="coordinates along lon are not even"):
            rc.read(path)


def test_packed_numbers_are_unpacked(tmp_path):
    packing = {"elevation_height": {"dtype": "i2", "scale_factor": 0.5, "add_offset": 3.0, "_FillValue": -9}}
    dataset().where(HEIGHTS != 4).to_netcdf(tmp_path / "a.nc", engine="h5netcdf", encoding=packing)
    surface = rc.read(tmp_path / "a.nc")
    expected = np.where(HEIGHTS == 4, np.nan, HEIGHTS * 1e-6)
    np.testing.assert_allclose(surface.heights, expected, rtol=1e-12, atol=1e-18)


def test_uneven_coordinates_are_refused(tmp_path):
    uneven = dataset().assign_coords(lon=("lon", [1.0, 1.5, 2.0, 2.6], {"units": "mm"}))
    uneven.to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    with pytest.raises(rc.ReadError, match="coordinates along lon are not even"):
        rc.read(tmp_path / "a.nc")


@pytest.mark.parametrize(
    "axis",
    [("lon", [1.0, 1.5, 2.0, 2.5], {"units": "degrees_east"}), (("lat", "lon"), HEIGHTS, {"units": "mm"})],
)
def test_coordinates_that_are_no_places_along_an_axis_state_no_size(tmp_path, axis):
    lat = ("lat", [10.0, 12.0, 14.0], {"units": "mm"})
    height = {"height": (("lat", "lon"), HEIGHTS, {"units": "um"})}
    xarray.Dataset(height, {"lat": lat}).to_netcdf(tmp_path / "a.nc", engine="scipy")
    with netcdf_file(tmp_path / "a.nc", "a") as file:
        of, values, attributes = axis
        lon = file.createVariable("lon", "f8", (of,) if isinstance(of, str) else of)
        lon[:] = values
        lon.units = attributes["units"]
    with pytest.raises(rc.ReadError, match="it states no size; pass size="):
        rc.read(tmp_path / "a.nc", channel="height")


def test_infinite_coordinates_are_refused_without_noise(tmp_path):
    places = np.array([0.5, np.inf, np.inf])
    data = xarray.Dataset(
        {"height": (("y", "x"), HEIGHTS, {"units": "um"})},
        {"y": ("y", places, {"units": "um"}), "x": ("x", np.arange(4.0), {"units": "um"})},
    )
    data.to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    with pytest.raises(rc.ReadError, match="states cells of inf m"):
        rc.read(tmp_path / "a.nc")


def test_what_is_no_map_is_refused(tmp_path, put):
    xarray.Dataset({"force": ("load", [1.0, 2.0])}).to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    with pytest.raises(rc.ReadError, match=r"a\.nc: no channel is a map of heights"):
        rc.read(tmp_path / "a.nc")
    with pytest.raises(rc.ReadError, match=r"b\.nc: it is not a NetCDF file"):
        rc.read(put("b.nc", b"neither"))


@pytest.mark.filterwarnings("ignore::roughcontact.files.file_errors.SurfaceWarning")
@pytest.mark.parametrize("modern", [False, True])
def test_any_flipped_byte_of_a_small_file_is_survived(tmp_path, put, modern):
    """Numbers carry no checksum; whatever happens, nothing but a ReadError or a surface comes out."""
    path = tmp_path / "a.nc"
    if modern:
        dataset().to_netcdf(path, engine="h5netcdf")
    else:
        contact_engineering(path)
    whole = path.read_bytes()
    read = 0
    for place in np.random.default_rng(5).integers(0, len(whole), 150).tolist():
        spoilt = bytearray(whole)
        spoilt[place] ^= 0x81
        with contextlib.suppress(rc.ReadError):
            surface = rc.read(put("c.nc", bytes(spoilt)), unit="um", size=1e-3)
            assert min(surface.grid.shape) >= 2
            read += 1
    assert 0 < read < 150


@pytest.mark.parametrize(
    ("beginning", "module", "error", "message"),
    [
        (b"CDF\x01", "scipy.io", ImportError, "scipy.io"),
        (b"\x89HDF\r\n\x1a\n", "h5py", rc.ReadError, "needs the package h5py.* pip install"),
    ],
)
def test_a_broken_library_is_no_damage_of_the_file(tmp_path, monkeypatch, beginning, module, error, message):
    (tmp_path / "a.nc").write_bytes(beginning)
    monkeypatch.setitem(sys.modules, module, None)  # as if it were not installed
    with pytest.raises(error, match=message):
        rc.read(tmp_path / "a.nc")


def marked(path, stored, *, units="um", **attributes):
    """Write heights (y, x) of 3 x 4 points as stored, with coordinates in the unit, and what is stated about them."""
    with netcdf_file(path, "w") as file:
        for name, size in (("y", 3), ("x", 4)):
            file.createDimension(name, size)
            variable = file.createVariable(name, "f8", (name,))
            variable[:] = np.arange(size) + 0.5
            if units:
                variable.units = units
        heights = file.createVariable("heights", stored.dtype.newbyteorder(">"), ("y", "x"))
        heights[:] = stored
        heights.units = "um"
        for name, value in attributes.items():
            setattr(heights, name, value)
    return path


GAP = np.where((HEIGHTS == 5) | (HEIGHTS == 6), np.nan, HEIGHTS)
TWO = np.where(HEIGHTS == 5, -1e3, np.where(HEIGHTS == 6, 2e3, HEIGHTS))
SHORT = np.where(np.isnan(GAP), -999, 10 * HEIGHTS).astype("i2")


@pytest.mark.parametrize(
    ("stored", "attributes"),
    [
        (np.where(np.isnan(GAP), -99.9, GAP).astype("f4"), {"missing_value": np.float64(-99.9)}),
        (np.where(np.isnan(GAP), -99.9, GAP), {"missing_value": np.float32(-99.9)}),
        (np.where(np.isnan(GAP), 1e20, GAP).astype("f4"), {"missing_value": np.float64(1e20)}),
        (np.where(np.isnan(GAP), -99.9, GAP), {"missing_value": "-99.9"}),
        (
            np.where(HEIGHTS == 5, -1e3, np.where(HEIGHTS == 6, -2e3, HEIGHTS)),
            {"missing_value": np.array([-1e3, -2e3])},
        ),
        (
            np.where(HEIGHTS == 5, -1e3, np.where(HEIGHTS == 6, 2e3, HEIGHTS)),
            {"valid_range": np.array([0.0, 50.0])},
        ),
        (np.where(np.isnan(GAP), -1e3, GAP), {"valid_min": 0.0}),
        (np.where(np.isnan(GAP), 1e3, GAP).astype("f4"), {"valid_max": np.float64(11.0)}),
        (SHORT, {"scale_factor": 0.1, "valid_min": np.int16(0)}),
        (SHORT, {"scale_factor": 0.1, "valid_range": np.array([0.0, 50.0])}),
        (np.where(np.isnan(GAP), -1, HEIGHTS).astype("i2"), {"_Unsigned": "true", "missing_value": 65535.0}),
    ],
)
def test_marks_in_other_types_and_limits_of_what_is_valid(tmp_path, stored, attributes):
    surface = rc.read(marked(tmp_path / "a.nc", stored, **attributes))
    # Heights of single precision are the nearest to whole micrometres.
    np.testing.assert_allclose(surface.heights, GAP * 1e-6, rtol=1e-6)


def test_limits_leave_what_lies_on_them(tmp_path):
    surface = rc.read(marked(tmp_path / "a.nc", (HEIGHTS / 10).astype("f4"), valid_min=0.0, valid_max=1.1))
    assert surface.missing == 0


def test_what_was_never_written_is_missing_and_told(tmp_path):
    stored = np.where(np.isnan(GAP), 9.969209968386869e36, GAP).astype("f4")
    with pytest.warns(SurfaceWarning, match=r"2 points hold 9\.96921e\+36, a mark of missing points"):
        surface = rc.read(marked(tmp_path / "a.nc", stored))
    assert np.array_equal(np.isnan(surface.heights), np.isnan(GAP))


def test_coordinates_without_a_unit_are_told_or_asked_about(tmp_path):
    with pytest.warns(
        SurfaceWarning, match="its y and x state no unit, and um is assumed; pass size= if that is wrong"
    ):
        assert rc.read(marked(tmp_path / "a.nc", HEIGHTS, units="")).grid.spacing == (1e-6, 1e-6)
    xarray.Dataset(
        {"heights": (("y", "x"), HEIGHTS, {"units": "um"})}, {"y": np.arange(3.0), "x": np.arange(4.0)}
    ).to_netcdf(tmp_path / "b.nc", engine="scipy")
    with pytest.raises(rc.ReadError, match="it states no size; pass size="):
        rc.read(tmp_path / "b.nc")


def test_a_map_at_one_time(tmp_path):
    path = marked(tmp_path / "a.nc", HEIGHTS)
    with xarray.open_dataset(path, engine="scipy") as whole:
        whole.rename(heights="topography").expand_dims("time").to_netcdf(tmp_path / "b.nc", engine="scipy")
        whole.expand_dims(time=2).to_netcdf(tmp_path / "c.nc", engine="scipy")
    np.testing.assert_allclose(rc.read(tmp_path / "b.nc").heights, HEIGHTS * 1e-6, rtol=1e-12)
    with pytest.raises(rc.ReadError, match="2 x 3 x 4"):
        rc.read(tmp_path / "c.nc")


def test_depths_are_turned_and_told(tmp_path):
    with pytest.warns(SurfaceWarning, match="its values count downwards: they are read with the other sign"):
        surface = rc.read(marked(tmp_path / "a.nc", HEIGHTS, positive="down"))
    np.testing.assert_allclose(surface.heights, -HEIGHTS * 1e-6, rtol=1e-12)
    assert rc.read(marked(tmp_path / "b.nc", HEIGHTS, positive="up")).heights.max() > 0
