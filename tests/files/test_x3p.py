"""X3P in every variant, from a writer of a few lines."""

import hashlib
import io
import zipfile

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import ContentError, SurfaceWarning
from roughcontact.files.x3p import parse_xml

HEIGHTS = np.array([[0.0, 1e-6, 2e-6], [-1e-6, 5e-7, 3e-6]])
COUNTS = np.array([[0, 1000, -2000], [300, -32768, 32767]])


@pytest.mark.parametrize("folder", ["", "part/", "a/b/c/"])
@pytest.mark.parametrize("listed", [False, True])
@pytest.mark.parametrize("kind", ["F", "D"])
def test_real_numbers(put, make_x3p, kind, listed, folder):
    surface = rc.read(put("a.x3p", make_x3p(HEIGHTS, kind, listed=listed, folder=folder)))
    expected = HEIGHTS if listed else HEIGHTS.astype({"F": "f4", "D": "f8"}[kind])
    assert np.array_equal(surface.heights, expected)
    np.testing.assert_allclose(surface.grid.spacing, (2e-6, 3e-6), rtol=1e-15)


@pytest.mark.parametrize("listed", [False, True])
@pytest.mark.parametrize("kind", ["I", "L"])
def test_whole_numbers_with_increment_and_offset(put, make_x3p, kind, listed):
    data = make_x3p(COUNTS, kind, increment=1e-9, offset=2e-6, listed=listed)
    surface = rc.read(put("a.x3p", data))
    np.testing.assert_allclose(surface.heights, COUNTS * 1e-9 + 2e-6, rtol=1e-12, atol=1e-20)


def test_missing_points(put, make_x3p):
    holed = HEIGHTS.copy()
    holed[0, 1] = np.nan
    for listed in (False, True):
        surface = rc.read(put("a.x3p", make_x3p(holed, listed=listed)))
        assert np.array_equal(surface.heights, holed, equal_nan=True)
    valid = np.array([[True, True, False], [False, True, True]])
    surface = rc.read(put("b.x3p", make_x3p(COUNTS, "I", increment=1e-9, valid=valid)))
    assert np.array_equal(surface.measured, valid)


def test_infinite_heights_count_as_missing(put, make_x3p):
    surface = rc.read(put("a.x3p", make_x3p(np.where(HEIGHTS > 2e-6, np.inf, HEIGHTS))))
    assert surface.missing == 1
    assert "1 infinite heights count as missing" in surface.provenance


def test_checksums(put, make_x3p):
    assert len(rc.read(put("a.x3p", make_x3p(HEIGHTS, checksum_of=None))).provenance) == 1
    quirk = rc.read(put("a.x3p", make_x3p(HEIGHTS, checksum_of="points")))
    assert any("states the heights instead of main.xml" in line for line in quirk.provenance)
    # Programs that change main.xml leave its checksum stale; the heights have one of their own, unless listed.
    with pytest.warns(SurfaceWarning, match=r"checksum of main\.xml is wrong, that of its heights is right"):
        changed = rc.read(put("a.x3p", make_x3p(HEIGHTS, checksum_of="nothing")))
    assert np.array_equal(changed.heights, HEIGHTS, equal_nan=True)
    assert any("main.xml was changed" in line for line in changed.provenance)
    for unguarded in ({"listed": True}, {"points_md5": " "}):
        with pytest.raises(rc.ReadError, match=r"a\.x3p: the checksum of main\.xml is wrong.*copy it again"):
            rc.read(put("a.x3p", make_x3p(HEIGHTS, checksum_of="nothing", **unguarded)))
    with pytest.raises(rc.ReadError, match="the checksum of the heights is wrong"):
        rc.read(put("a.x3p", make_x3p(HEIGHTS, points_md5=hashlib.md5(b"").hexdigest())))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"feature": "PRF"}, "type PRF, not a surface"),
        ({"size_z": 2}, "2 layers"),
        ({"size_z": "1e9"}, "SizeZ"),
        ({"spacing": (0.0, 1e-6)}, "cells of 0 m"),
        ({"spacing": (np.nan, 1e-6)}, "CY/Increment"),
        ({"spacing": ("wide", 1e-6)}, "CY/Increment"),
        ({"extra": '<!DOCTYPE a [<!ENTITY b "c">]>'}, "document type"),
        ({"extra": "<open>"}, r"main\.xml is damaged"),
    ],
)
def test_what_is_no_surface_is_refused(put, make_x3p, changes, message):
    with pytest.raises(rc.ReadError, match=r"a\.x3p: .*" + message):
        rc.read(put("a.x3p", make_x3p(HEIGHTS, **changes)))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_a_document_type_is_seen_in_every_encoding(encoding):
    """Names that stand for names that stand for ...: a few lines that unpack to as much as one wants."""
    first = f'<?xml version="1.0" encoding="{encoding}"?>'
    names = "".join(f'<!ENTITY e{k + 1} "{f"&e{k};" * 10}">' for k in range(3))
    growing = f'{first}<!DOCTYPE a [<!ENTITY e0 "{"x" * 100}">{names}]><a>&e3;</a>'
    with pytest.raises(ContentError, match="declares a document type"):
        parse_xml(growing.encode(encoding))
    assert parse_xml(f"{first}<a>1</a>".encode(encoding)).element.text == "1"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b"<SizeX>3<", b"<SizeX>4<", "need 64"),
        (b"<SizeX>3<", b"<SizeX>99999999999<", "points need"),
        (b"<SizeX>3<", b"<SizeX>0<", "SizeX"),
        (b"<DataType>D</DataType></CZ>", b"<DataType>Q</DataType></CZ>", "type 'Q'"),
        (b"data.bin", b"lost.bin", r"lacks bindata/lost\.bin"),
        (b"<AxisType>I<", b"<AxisType>A<", "not incremental"),
        (b"Record3", b"Record9", "no Record3"),
        (b'encoding="UTF-8"', b'encoding="UTF-9"', "damaged"),
    ],
)
def test_a_main_xml_that_contradicts_its_data(put, make_x3p, old, new, message):
    with zipfile.ZipFile(io.BytesIO(make_x3p(HEIGHTS, checksum_of=None))) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    assert old in members["main.xml"]
    members["main.xml"] = members["main.xml"].replace(old, new)
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    with pytest.raises(rc.ReadError, match=r"a\.x3p: .*" + message):
        rc.read(put("a.x3p", stream.getvalue()))


def test_a_data_list_that_is_too_short_or_no_number(put, make_x3p):
    with zipfile.ZipFile(io.BytesIO(make_x3p(HEIGHTS, listed=True, checksum_of=None))) as archive:
        main = archive.read("main.xml")
    for old, new, message in (
        (b"<Datum>0.0</Datum>", b"", "5 entries for 2 x 3"),
        (b"<Datum>0.0</Datum>", b"<Datum>1;2;3</Datum>", "entry 1 .* not one height"),
    ):
        stream = io.BytesIO()
        with zipfile.ZipFile(stream, "w") as archive:
            archive.writestr("main.xml", main.replace(old, new))
        with pytest.raises(rc.ReadError, match=message):
            rc.read(put("a.x3p", stream.getvalue()))


def test_an_archive_without_a_surface(put):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("readme.txt", "hello")
    with pytest.raises(rc.ReadError, match=r"holds no main\.xml"):
        rc.read(put("a.x3p", stream.getvalue()))


def test_what_the_other_library_writes(tmp_path):
    topography = pytest.importorskip("SurfaceTopography")
    heights = np.arange(12.0).reshape(4, 3) * 1e-3
    path = tmp_path / "other.x3p"
    for kind, tolerance in (("D", 0), ("F", 1e-7), ("L", 1e-9), ("I", 1e-4)):
        topography.Topography(heights, (8.0, 6.0), unit="mm").to_x3p(str(path), dtype=kind)
        surface = rc.read(path)
        # Whole numbers resolve the range of heights to one part in their own range.
        np.testing.assert_allclose(surface.heights, heights.T * 1e-3, rtol=1e-7, atol=tolerance * 11e-6)
        np.testing.assert_allclose(surface.grid.lengths, (6e-3, 8e-3), rtol=1e-12)
