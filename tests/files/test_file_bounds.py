"""Files that declare more than the memory holds are refused before it is allocated; endless reading is ended."""

import io
import struct
import tracemalloc
import warnings
import zipfile
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

import roughcontact as rc
from files.written import FILES
from instruments import sdf_binary, sdf_text, tiff
from roughcontact.files import file_bounds as bounds
from roughcontact.files.content import needed
from roughcontact.files.file_bounds import BoundedStream, require_memory
from roughcontact.files.file_errors import ContentError, SurfaceWarning
from roughcontact.files.read import channels

GIVEN = {"unit": "um", "size": 1e-3}
DATA = bytes(range(256)) * 4


@pytest.fixture
def free(monkeypatch):
    """Set the memory that is free [bytes]."""

    def have(size):
        monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=size))

    return have


@pytest.fixture
def small():
    """Fail where more than 100 MB are allocated at a time."""
    tracemalloc.start()
    yield
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1e8


def test_what_is_free_suffices(free):
    free(1000)
    require_memory(1000)
    with pytest.raises(ContentError, match=r"reading it needs 1e-06 GB of memory, and 1e-06 GB are"):
        require_memory(1001)


@pytest.mark.usefixtures("small")
@pytest.mark.parametrize("name", ["a.npy", "a.sur", "a.txt", "a.nc", "a.unknown"])
def test_a_file_beyond_the_memory_is_not_read(tmp_path, free, name):
    with open(tmp_path / name, "wb") as stream:  # it takes no room on the disk
        header = {"descr": "<f4", "fortran_order": False, "shape": (20000, 20000)}
        np.lib.format.write_array_header_1_0(stream, header)
        stream.truncate(1_600_000_000)
    free(8e9)
    for function in (rc.read, rc.read_line, rc.read_curve, channels):
        # Twenty-five times 1.6 GB; of the array the header tells: 128 bytes of it lack 32 points.
        with pytest.raises(
            rc.ReadError, match=r"needs (40|41\.6) GB of memory, and 8 GB are free; cut the map"
        ):
            function(tmp_path / name)


def empty_hdf5():
    """Return an HDF5 file that announces heights and holds none."""
    h5py = pytest.importorskip("h5py")
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        file.create_dataset("heights", (20_000, 20_000), "f4", chunks=(1000, 1000)).attrs["units"] = "um"
    return stream.getvalue()


@pytest.mark.usefixtures("small")
@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a.sdf", lambda: sdf_text(np.ones((3, 4)), 5, NumPoints=20_000, NumProfiles=20_000)),
        ("a.sdf", lambda: sdf_binary(np.broadcast_to(1.0, (3, 4)), 5).replace(b"\4\0\3\0", b"\x20\x4e" * 2)),
        ("a.tif", lambda: tiff(np.ones((3, 4), "u2"), t256=20_000, t257=20_000)),
        ("a.nc", empty_hdf5),
    ],
)
def test_points_beyond_the_memory_are_not_made(put, free, name, data):
    """The header of a small file announces 20000^2."""
    if name == "a.tif":
        pytest.importorskip("tifffile")
    path = put(name, data())
    free(8e9)
    need = bounds.BYTES_PER_POINT * 0.4
    with pytest.raises(
        rc.ReadError, match=rf"reading it needs {need:.3g} GB of memory, and 8 GB are free; cut"
    ):
        rc.read(path, unit="um", channel=0 if name == "a.nc" else None)


@pytest.mark.usefixtures("small")
def test_archives_count_unpacked(tmp_path, free):
    """Zeros, a thousandth of their size when they are packed: as an array, in X3P, and for a foreign reader."""
    zeros = io.BytesIO()
    np.save(zeros, np.zeros((2000, 2500), np.uint8))
    free(1e8)
    for name, member in (("a.npz", "heights.npy"), ("a.x3p", "main.xml"), ("a.plux", "index.xml")):
        with zipfile.ZipFile(tmp_path / name, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr(member, zeros.getvalue())
        assert (tmp_path / name).stat().st_size < 1e4
        with pytest.raises(rc.ReadError, match=r"reading it needs 0\.\d+ GB of memory"):
            rc.read(tmp_path / name, **GIVEN)


@pytest.mark.usefixtures("small")
def test_a_member_that_holds_more_than_it_declares_is_not_unpacked(put):
    packed = io.BytesIO()
    with (
        zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("main.xml", "w") as member,
    ):
        for _ in range(150):
            member.write(bytes(1_000_000))
    data = bytearray(packed.getvalue())
    directory = data.rindex(b"PK\1\2")
    for place in (22, directory + 24):  # the size unpacked, before the member and in the directory
        data[place : place + 4] = (1000).to_bytes(4, "little")
    with pytest.raises(rc.ReadError, match="archive is damaged"):
        rc.read(put("a.x3p", bytes(data)))


def test_other_methods_of_packing_are_refused(tmp_path):
    for method in (zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA):
        with zipfile.ZipFile(tmp_path / "a.x3p", "w", method) as archive:
            archive.writestr("main.xml", "<a/>")
        with pytest.raises(rc.ReadError, match=r"main\.xml is compressed by method"):
            rc.read(tmp_path / "a.x3p")


@pytest.mark.parametrize("kind", [".npy", ".npz", ".x3p", ".plux"])
def test_damage_is_left_to_the_reader(kind):
    for content in (b"PK\x03\x04 no such thing", b"PK\x05\x06" + bytes(17), b"\x93NUMPY\1\0\xff\xff", b"\0"):
        assert needed(io.BytesIO(content), len(content), kind) <= 100 * len(content)


@pytest.mark.parametrize("kind", ["f4", "f8", "u1"])
def test_reading_stays_within_what_was_asked_for(tmp_path, kind):
    path = tmp_path / "a.npy"
    np.save(path, np.random.default_rng(1).integers(0, 99, (700, 700)).astype(kind))
    with open(path, "rb") as stream:
        need = needed(stream, path.stat().st_size, ".npy")
    tracemalloc.start()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SurfaceWarning)  # white noise is no surface
        rc.read(path, **GIVEN)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert 0.5 * need < peak < need


def test_what_shows_only_in_the_file_counts_as_well(put, free, monkeypatch):
    """A text of short numbers holds more points than one of every four bytes."""
    path = put("a.txt", ("1 2 3 4 5 6 7 8\n" * 1000))
    free(25 * path.stat().st_size)
    with pytest.raises(rc.ReadError, match=r"reading it needs 0\.000672 GB"):  # 84 bytes for each of 8000
        rc.read(path, **GIVEN)


def test_it_is_read_like_any_binary_file():
    stream = BoundedStream(DATA, "surface.any")
    assert stream.read(3) == DATA[:3]
    assert stream.read1(2) == DATA[3:5]
    buffer = bytearray(4)
    assert stream.readinto(buffer) == 4
    assert bytes(buffer) == DATA[5:9]
    assert stream.readline() == DATA[9:11]  # to the line feed
    assert stream.read() == DATA[11:]
    stream.seek(0)
    # Latin-1, so that every byte is a letter.
    assert io.TextIOWrapper(stream, encoding="latin-1", newline="").read().encode("latin-1") == DATA


def test_it_knows_what_was_not_read():
    stream = BoundedStream(DATA, "surface.any")
    stream.seek(100)
    stream.read(24)
    stream.seek(0)
    stream.read(10)
    assert stream.unread == len(DATA) - 124
    stream.forget()
    stream.read(1)
    assert stream.unread == len(DATA) - 11


def read_again(stream):
    stream.seek(0)
    return stream.read(100)


@pytest.mark.parametrize(
    ("home", "limit", "value"), [(bounds, "_BYTES", 50_000), (BoundedStream, "calls", 500)]
)
def test_reading_for_ever_is_ended_for_good(monkeypatch, home, limit, value):
    monkeypatch.setattr(bounds, "_TIMES", 0)
    monkeypatch.setattr(home, limit, value)
    monkeypatch.setattr(bounds, "_BYTES_A_CALL", len(DATA) + 1)
    stream = BoundedStream(DATA, "surface.any")
    for _ in range(500):  # of 100 bytes
        read_again(stream)
    for _ in range(3):
        with pytest.raises(RuntimeError, match="round in circles"):
            read_again(stream)


@pytest.fixture
def whole():
    pytest.importorskip("SurfaceTopography")
    return lambda name: FILES[name].data


@pytest.mark.parametrize("name", ["scan.jpk", "park.tiff"])
def test_pages_without_an_end_are_refused_soon(whole, put, monkeypatch, name):
    """The last page of a TIFF names the first one as the next; the reader of Park's files follows it for ever."""
    data = bytearray(whole(name))
    (first,) = page = struct.unpack_from("<I", data, 4)
    while page != (0,):
        (start,) = page
        end = start + 2 + 12 * struct.unpack_from("<H", data, start)[0]
        page = struct.unpack_from("<I", data, end)
    struct.pack_into("<I", data, end, first)
    count, reads = BoundedStream._count, []
    monkeypatch.setattr(
        BoundedStream, "_count", lambda stream, size: (reads.append(size), count(stream, size))
    )
    with pytest.raises(rc.ReadError):
        rc.read(put("a.tiff", bytes(data)))
    assert len(reads) < 11_000


def test_a_wrong_number_of_rows_shows_at_the_end_of_the_file(whole, put):
    data = bytearray(whole("zygo.dat"))
    assert data[70:72] == (20).to_bytes(2, "big")
    data[70:72] = (16).to_bytes(2, "big")
    with pytest.warns(SurfaceWarning, match="448 bytes at its end belong to no channel"):
        rc.read(put("a.dat", bytes(data)))  # 4 rows of 28 points of 4 bytes


def test_a_wrong_number_of_columns_shows_in_the_last_channel(whole, put):
    second = b"bufferLabel   Deflection\nbufferUnit    V\nbufferRange   10\ndata          BINARY"
    data = whole("agilent.mi").replace(b"data          BINARY", second) + bytes(2 * 20 * 28)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rc.read(put("a.mi", data))
    with pytest.warns(SurfaceWarning, match="its last channel is not all there"):
        rc.read(put("a.mi", data.replace(b"xPixels       28", b"xPixels       30")))


def test_heights_upside_down_are_refused(whole, put):
    data = bytearray(whole("zygo.dat"))
    data[164] ^= 0x80  # the sign of the factor of the interferometer
    with pytest.raises(rc.ReadError, match=r"states a factor of -\d"):
        rc.read(put("a.dat", bytes(data)))
