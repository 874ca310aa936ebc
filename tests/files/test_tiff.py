"""TIFF as heights: grey values in every way to store them, and what is no map of heights."""

import importlib.util
import io
import logging
import sys

import numpy as np
import pytest

import roughcontact as rc
from instruments import TEXT, hills, tiff
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_line

tifffile = pytest.importorskip("tifffile")

Z = hills()
GIVEN = {"unit": "nm", "size": ("16 um", "18 um")}
KINDS = ["u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8"]


def numbers(kind):
    if kind[0] == "f":
        return (Z * 100).astype(kind)
    low, high = (-120, 120) if kind == "i1" else (0, 250) if kind == "u1" else (0, 20000)
    low = -high if kind[0] == "i" else low
    return np.rint(low + (Z - Z.min()) / np.ptp(Z) * (high - low)).astype(kind)


def written(values, **options):
    stream = io.BytesIO()
    tifffile.imwrite(stream, values, **options)
    return stream.getvalue()


def assert_read(path, values, **given):
    surface = rc.read(path, **(GIVEN | given))
    np.testing.assert_allclose(surface.heights, values.astype(float) * 1e-9, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 5e-7), rtol=1e-14)
    return surface


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("rows", [None, 5])
@pytest.mark.parametrize("deflate", [False, True])
def test_grey_values(put, kind, order, rows, deflate):
    values = numbers(kind)
    assert_read(put("a.tif", tiff(values, order=order, rows=rows, deflate=deflate)), values)


@pytest.mark.parametrize(
    "options",
    [
        {"tile": (16, 16)},
        {"tile": (16, 32), "compression": "zlib"},
        {"byteorder": ">", "tile": (16, 16)},
        {"bigtiff": True},
        {"rowsperstrip": 7, "compression": "zlib", "predictor": True},
        {"resolution": (300, 300), "resolutionunit": "inch"},
        {"imagej": True},
        {"software": "none", "description": "a map"},
    ],
)
@pytest.mark.parametrize("kind", ["u2", "f4"])
def test_as_another_writer_stores_them(put, options, kind):
    if "predictor" in options:
        pytest.importorskip("imagecodecs")
    values = numbers(kind)
    assert_read(put("a.tiff", written(values, **options)), values)


@pytest.mark.parametrize("compression", ["raw", "packbits", "tiff_adobe_deflate"])
def test_as_pillow_stores_them(put, compression):
    image = pytest.importorskip("PIL.Image")
    values = numbers("u2")
    stream = io.BytesIO()
    image.fromarray(values).save(stream, "TIFF", compression=compression)
    assert_read(put("a.tif", stream.getvalue()), values)


@pytest.mark.parametrize("orientation", range(1, 9))
def test_they_are_turned_upright_as_other_programs_turn_them(put, orientation):
    image, operations = pytest.importorskip("PIL.Image"), pytest.importorskip("PIL.ImageOps")
    data = tiff(numbers("u1"), tags=[(274, 3, [orientation])])
    upright = np.asarray(operations.exif_transpose(image.open(io.BytesIO(data))))
    ny, nx = upright.shape
    surface = rc.read(put("a.tif", data), unit="nm", size=(ny * 5e-7, nx * 5e-7))
    np.testing.assert_allclose(surface.heights, upright * 1e-9, rtol=1e-15)


def test_unit_and_size_are_asked_for(put):
    values = numbers("u2")
    for options in (
        {},
        {"resolution": (300, 300)},
        {"imagej": True, "resolution": (2, 2), "metadata": {"unit": "um"}},
    ):
        path = put("a.tif", written(values, **options))
        with pytest.raises(
            rc.ReadError, match=r"no unit of its heights and no size.*pass unit= .* and size="
        ):
            rc.read(path)
        with pytest.raises(rc.ReadError, match=r"states no size.*; pass size="):
            rc.read(path, unit="nm")
        assert_read(path, values)


@pytest.mark.parametrize("tags", [(), ((282, 3, [300]),)])
def test_the_resolution_of_a_print_is_no_size(put, tags):
    with pytest.raises(rc.ReadError) as refused:
        rc.read(put("a.tif", tiff(numbers("u2"), tags=tags)), unit="nm")
    assert ("(a resolution, which is that of a print)" in str(refused.value)) == bool(tags)


def test_missing_points(put):
    values = numbers("f4")
    values[3, 4:7] = np.nan
    assert rc.read(put("a.tif", tiff(values)), **GIVEN).missing == 3
    values = numbers("f4")
    values[3, 4:7] = -99.9  # which no number in single precision equals
    surface = rc.read(put("a.tif", tiff(values, tags=[(42113, TEXT, b"-99.9\0")])), **GIVEN)
    assert np.array_equal(np.isnan(surface.heights), values == np.float32(-99.9))
    counts = numbers("i2")
    counts[3, 4:7] = -32768
    surface = rc.read(put("a.tif", tiff(counts, tags=[(42113, TEXT, b"-32768\0")])), **GIVEN)
    assert surface.missing == 3
    with pytest.raises(rc.ReadError, match="marks missing points by 'none'"):
        rc.read(put("a.tif", tiff(counts, tags=[(42113, TEXT, b"none\0")])), **GIVEN)


def test_of_several_pages_one_is_chosen(put):
    stream = io.BytesIO()
    with tifffile.TiffWriter(stream) as writer:
        for values in (numbers("u2"), numbers("i2")):
            writer.write(values, contiguous=False)
        writer.write(np.zeros((32, 36, 3), "u1"), photometric="rgb")
        writer.write(numbers("u2")[::2, ::2], subfiletype=1)  # a copy for a quick look
    path = put("a.tif", stream.getvalue())
    assert [(c.name, c.shape, c.is_height) for c in channels(path)] == [
        ("page 1", (32, 36), False),
        ("page 2", (32, 36), False),
    ]
    with pytest.raises(rc.ReadError, match=r"'page 1' \(32 x 36, no unit\), 'page 2'.*pass channel="):
        rc.read(path, **GIVEN)
    assert_read(path, numbers("i2"), channel="page 2")
    assert_read(path, numbers("u2"), channel=0)


def test_one_line_is_a_profile(put):
    line = read_line(put("a.tif", tiff(numbers("u2")[:1])), unit="nm", size="18 um")
    np.testing.assert_allclose(line.heights, numbers("u2")[0] * 1e-9, rtol=1e-15)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (tiff(numbers("u2"), t262=0), "white is zero"),
        (
            tiff(numbers("u2"), tags=[(270, TEXT, b"ImageJ=1.53\ncf=0\nc0=-32768\nc1=2\n\0")]),
            "a scale or an offset",
        ),
        (
            tiff(numbers("u2"), tags=[(42112, TEXT, b'<Item role="scale">0.1</Item>\0')]),
            "a scale or an offset",
        ),
    ],
)
def test_what_changes_the_meaning_of_its_numbers_is_warned_of(put, data, said):
    with pytest.warns(SurfaceWarning, match=said):
        assert_read(put("a.tif", data), numbers("u2"))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (written(np.zeros((32, 36, 3), "u1"), photometric="rgb"), r"a picture in colours \(RGB\)"),
        (
            written(numbers("u1"), photometric="palette", colormap=np.zeros((3, 256), "u2")),
            r"colours \(PALETTE\)",
        ),
        (
            written(np.zeros((32, 36, 2), "u1"), photometric="minisblack", planarconfig="contig"),
            "2 numbers a point",
        ),
        (written(np.zeros((32, 36), "c8")), "its numbers are of 64 bits, format"),
        (written(np.zeros((32, 40), bool)), "its numbers are of 1 bits"),
        (tiff(numbers("u1"), t259=7), "compressed by JPEG"),
        (tiff(numbers("u1"), tags=[(274, 3, [9])]), "turned in the unknown way 9"),
    ],
)
def test_what_is_no_map_of_heights_is_refused_by_its_kind(put, data, message):
    path = put("a.tif", data)
    with pytest.raises(rc.ReadError, match=rf"a\.tif: .*{message}") as refused:
        rc.read(path, **GIVEN)
    assert "whole" not in str(refused.value)
    with pytest.raises(rc.ReadError, match=message):
        channels(path)


def test_a_package_that_is_lacking_is_named(put, monkeypatch):
    path = put("a.tif", tiff(numbers("u2")))
    monkeypatch.setitem(sys.modules, "tifffile", None)
    with pytest.raises(
        rc.ReadError, match=r"needs the package tifffile.*pip install 'roughcontact\[formats\]'"
    ):
        rc.read(path, **GIVEN)


def test_lzw_needs_another_package_or_no_compression(put):
    """The remedy followed: the same picture saved without compression."""
    image = pytest.importorskip("PIL.Image")
    values = numbers("u2")
    stream = io.BytesIO()
    image.fromarray(values).save(stream, "TIFF", compression="tiff_lzw")
    path = put("a.tif", stream.getvalue())
    if importlib.util.find_spec("imagecodecs"):
        assert_read(path, values)
    else:
        with pytest.raises(
            rc.ReadError, match=r"save it without compression, or run: .* pip install imagecodecs"
        ):
            rc.read(path, **GIVEN)
    stream = io.BytesIO()
    image.open(path).save(stream, "TIFF", compression="raw")
    assert_read(put("b.tif", stream.getvalue()), values)


WHOLE = tiff(numbers("u2"), rows=8)
PACKED = tiff(numbers("u2"), rows=8, deflate=True)


@pytest.mark.parametrize(
    "data",
    [
        *(WHOLE[:n] for n in (4, 8, 100, 2000, len(WHOLE) - 60, len(WHOLE) - 1)),
        *(PACKED[:n] for n in (100, len(PACKED) - 60)),
        PACKED[:40] + b"\x55" + PACKED[41:],
        WHOLE[:4] + b"\0\0\0\0" + WHOLE[8:],
        tiff(numbers("u2"), t256=35),
        tiff(numbers("u2"), t256=2**31),
        tiff(numbers("u2"), t257=33),
        tiff(numbers("u2"), rows=8, t273=600),  # the first strip is where the second is
        tiff(numbers("u2"), rows=8, t279=575),
        tiff(numbers("u2"), rows=8, t279=0),
        tiff(numbers("u2"), rows=8, deflate=True, t279=0),
        tiff(numbers("u2"), rows=8, deflate=True, t257=40),
        tiff(numbers("u2"), t258=32),
        tiff(numbers("u2"), rows=8, t278=4),
        bytes(10_000_000),
        b"II*\0" + bytes(10_000_000),
        b"II*\0\x08\0\0\0" + b"\x01\0" + b"\xff" * 12 + b"\x08\0\0\0",  # a page that follows itself
    ],
)
def test_damage_is_refused(put, data, caplog, capfd):
    path = put("a.tiff", data)
    for reader in (lambda: rc.read(path, **GIVEN), lambda: rc.read(path, channel=0, **GIVEN)):
        with pytest.raises(rc.ReadError, match=r"a\.tiff: "):
            reader()
    assert not [record for record in caplog.records if record.levelno >= logging.WARNING]
    assert capfd.readouterr() == ("", "")
