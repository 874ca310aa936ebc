"""NumPy's own files."""

import io
import warnings

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.numpy_files import read_npy_header
from roughcontact.files.read import channels

HEIGHTS = np.arange(12.0).reshape(3, 4)
GIVEN = {"unit": "um", "size": "40 um"}


@pytest.mark.parametrize("dtype", ["f2", "<f4", ">f8", "i2", ">u2", "i8"])
def test_npy_of_any_real_type(put, npy, dtype):
    surface = rc.read(put("a.npy", npy(HEIGHTS.astype(dtype))), **GIVEN)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (1e-5, 1e-5), rtol=1e-15)


def test_fortran_order_and_nan(put, npy):
    heights = np.asfortranarray(np.where(HEIGHTS == 5, np.nan, HEIGHTS))
    surface = rc.read(put("a.npy", npy(heights)), unit=0.0625, size=0.1, periodic=True)
    assert np.array_equal(surface.heights, heights / 16, equal_nan=True)
    assert surface.grid.periodic == (True, True)
    assert surface.missing == 1


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (HEIGHTS.astype(complex), "complex128"),
        (HEIGHTS > 3, "bool"),
        (np.array([["1", "2"]]), "<U1"),
        (np.arange(5.0), "a profile"),
        (np.zeros((2, 2, 2)), "3-dimensional"),
        (np.zeros((1, 7)), "1 x 7 heights, which is not a map"),
        (np.zeros((0, 0)), "2 x 2"),
        (np.float64(3), "one number"),
        (np.full((2, 2), np.nan), "all heights are NaN"),
        (np.array([[1.0, np.inf], [0, 0]]), "1 height is infinite"),
        (np.array([[1.0, {}], [0, 0]], dtype=object), "not a whole NumPy array"),
        (np.zeros((2, 2), dtype=[("x", "f8")]), "type"),
    ],
)
def test_an_array_that_is_no_map_is_refused(tmp_path, array, message):
    path = tmp_path / "bad.npy"
    np.save(path, array)
    with pytest.raises(rc.ReadError, match=r"bad\.npy: .*" + message):
        rc.read(path, **GIVEN)


def test_bytes_missing_or_left_over(put, npy):
    data = npy(HEIGHTS)
    for damaged in (data[:-1], data + b"\0", data[:100]):
        with pytest.raises(rc.ReadError, match=r"cut\.npy"):
            rc.read(put("cut.npy", damaged), **GIVEN)


def test_a_header_that_promises_the_moon_is_refused(put, npy):
    data = npy(HEIGHTS).replace(b"(3, 4), }      ", b"(10000000, 4),}")
    with pytest.raises(rc.ReadError, match="not a whole NumPy array"):
        rc.read(put("a.npy", data), **GIVEN)


def test_npz_with_its_meaning(put, npz):
    path = put("a.npz", npz(heights=HEIGHTS, unit="nm", spacing=[2e-6, 1e-6], other=np.ones((5, 5))))
    surface = rc.read(path)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)
    assert surface.grid.spacing == (2e-6, 1e-6)
    assert "channel 'heights'" in surface.provenance[0]


@pytest.mark.parametrize(
    ("size", "spacing"), [([6e-6, 4e-6], (2e-6, 1e-6)), (4e-6, (1e-6, 1e-6)), ([4e-6], (1e-6, 1e-6))]
)
def test_npz_with_a_size(put, npz, size, spacing):
    surface = rc.read(put("a.npz", npz(heights=HEIGHTS, unit=1e-9, size=size)))
    np.testing.assert_allclose(surface.grid.spacing, spacing, rtol=1e-15)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)


def test_npz_by_channel(put, npz):
    path = put(
        "dem.npz",
        npz(elevation=np.arange(6, dtype="i2").reshape(2, 3), dx=0.5, dy=0.5, slope=np.ones((2, 3))),
    )
    with pytest.raises(rc.ReadError, match=r"several channels.*elevation.*slope.*channel="):
        rc.read(path, unit="mm", size=(0.02, 0.03))
    surface = rc.read(path, channel="elevation", unit="mm", size=(0.02, 0.03))
    np.testing.assert_allclose(surface.heights[1], [3e-3, 4e-3, 5e-3], rtol=1e-15)
    with pytest.raises(rc.ReadError, match=r"no unit of its heights and no size; pass unit=.*size="):
        rc.read(path, channel="elevation")
    with pytest.raises(rc.ReadError, match="no channel 'z'"):
        rc.read(path, channel="z")


def test_npz_with_one_map_needs_no_channel(put, npz):
    surface = rc.read(put("a.npz", npz(z=HEIGHTS, dx=1.0, x=np.arange(4))), **GIVEN)
    assert surface.grid.shape == (3, 4)


@pytest.mark.parametrize(
    "keys",
    [
        {"unit": np.array([1, 2])},
        {"unit": "stone"},
        {"spacing": "wide"},
        {"spacing": [1e-6, 1e-6, 1e-6]},
        {"spacing": [1e-6, 0.0]},
        {"size": -1e-6},
        {"size": np.nan},
    ],
)
def test_npz_with_a_wrong_meaning(put, npz, keys):
    path = put("a.npz", npz(**({"heights": HEIGHTS, "unit": "nm", "spacing": 1e-6} | keys)))
    if "size" in keys:
        path = put("a.npz", npz(heights=HEIGHTS, unit="nm", **keys))
    with pytest.raises(rc.ReadError, match=r"a\.npz"):
        rc.read(path)


def test_a_damaged_npz(put, npz):
    data = bytearray(npz(heights=HEIGHTS, unit="nm", spacing=1e-6))
    for place in range(100, 120):  # inside the compressed heights
        data[place] ^= 0xFF
    with pytest.raises(rc.ReadError, match="damaged or cut short"):
        rc.read(put("a.npz", bytes(data)))
    with pytest.raises(rc.ReadError, match="holds no array"):
        rc.read(put("b.npz", b"PK\x05\x06" + bytes(18)))  # an empty archive


def test_channels_of_an_npz(put, npz):
    path = put("a.npz", npz(heights=HEIGHTS, unit="nm", size=[6e-6, 4e-6], line=np.ones(3)))
    heights, line = channels(path)
    assert (heights.name, heights.shape, heights.unit, heights.is_height) == ("heights", (3, 4), "nm", True)
    np.testing.assert_allclose(heights.size, (6e-6, 4e-6), rtol=1e-15)
    assert (line.name, line.shape, line.unit, line.size, line.is_height) == ("line", (3,), None, None, False)


@pytest.mark.parametrize(("stated", "meant"), [(True, True), (False, False), (np.array([1]), True)])
def test_npz_may_say_that_the_surface_repeats_itself(tmp_path, stated, meant):
    path = tmp_path / "a.npz"
    np.savez(path, heights=np.eye(4), spacing=0.1, unit="m", periodic=stated)
    assert rc.read(path).grid.periodic == (meant, meant)
    assert rc.read(path, periodic=not meant).grid.periodic == (not meant, not meant)


def test_npz_with_a_strange_periodic_is_refused(tmp_path):
    path = tmp_path / "a.npz"
    np.savez(path, heights=np.eye(4), spacing=0.1, unit="m", periodic="yes")
    with pytest.raises(rc.ReadError, match="one truth value"):
        rc.read(path)


@pytest.mark.parametrize("version", [(1, 0), (2, 0), (3, 0)])
@pytest.mark.parametrize("dtype", ["f8", ">f4", "i2", "?", "c16", "U3", "S5", "M8[ns]", "f2"])
@pytest.mark.parametrize("shape", [(3, 4), (5,), (), (0, 2)])
def test_it_reads_what_numpy_writes(version, dtype, shape):
    array = np.zeros(shape, dtype)
    stream = io.BytesIO()
    np.lib.format.write_array(stream, array, version)
    data = stream.getvalue()
    header = read_npy_header(io.BytesIO(data))
    assert (header.shape, header.dtype, header.size) == (array.shape, array.dtype, len(data))
    assert np.array_equal(header.array(data), array)


def test_columns_first_and_the_writers_of_other_languages():
    array = np.arange(6.0).reshape(2, 3)
    for text, order in (
        ('{"descr": "<f8", "fortran_order": true, "shape": [2, 3]}', None),
        ('{"shape": (2, 3), "fortran_order": True, "descr": "<f8"}\n', "F"),
        ("{'descr': '<f8', 'fortran_order': False, 'shape': (2L, 3L), }\n", "C"),
    ):
        data = (
            b"\x93NUMPY\1\0" + len(text).to_bytes(2, "little") + text.encode() + array.tobytes(order or "C")
        )
        if order is None:
            with pytest.raises(ValueError, match="its header is damaged"):
                read_npy_header(io.BytesIO(data))
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert np.array_equal(read_npy_header(io.BytesIO(data)).array(data), array)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x93NUMPY",
        b"\x93NUMPY\7\0\x10\0",
        b"\x93NUMPY\1\0\xff\xff",
        b"\x93NUMPY\2\0\xff\xff\xff\xff",
        b"\x93NUMPY\1\0\x10\0{'descr': '<f8'}",
    ],
)
def test_what_is_none_is_refused(data):
    with pytest.raises(ValueError, match=r"begin|header"):
        read_npy_header(io.BytesIO(data))


@pytest.mark.parametrize("dtype", [[("x", "f8")], object])
def test_objects_and_named_fields_are_refused(dtype):
    stream = io.BytesIO()
    np.lib.format.write_array(stream, np.zeros(2, dtype))
    stream.seek(0)
    with pytest.raises(ValueError, match="of no plain type"):
        read_npy_header(stream)


def test_samples_without_number_take_no_memory():
    text = "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000, 1000000), }\n"
    data = b"\x93NUMPY\1\0" + len(text).to_bytes(2, "little") + text.encode()
    assert read_npy_header(io.BytesIO(data)).points == 10**18


def test_a_mask_beside_numbers_is_told(tmp_path):
    heights = np.random.default_rng(2).random((6, 8))
    mask = np.zeros(heights.shape, dtype=bool)
    mask[2, 3:5] = True
    np.savez(tmp_path / "a.npz", data=np.where(mask, 9.0, heights), mask=mask)
    with pytest.warns(SurfaceWarning, match="its key 'mask' marks 2 points, which are read as missing"):
        surface = rc.read(tmp_path / "a.npz", unit="um", size="8 um")
    np.testing.assert_array_equal(np.isnan(surface.heights), mask)


def test_a_profile_in_two_arrays_leads_to_its_channel(tmp_path):
    np.savez(tmp_path / "a.npz", x=np.arange(20.0), z=np.sin(np.arange(20.0)))
    with pytest.raises(rc.ReadError, match="pass channel= with the name of the heights"):
        rc.read_line(tmp_path / "a.npz", unit="um", size="10 um")
    line = rc.read_line(tmp_path / "a.npz", unit="um", size="10 um", channel="z")
    assert line.grid.spacing == pytest.approx((5e-7,), rel=1e-12)
