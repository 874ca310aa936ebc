"""What the headers of MATLAB's files announce is compared with what is there."""

import struct
import tracemalloc
import zlib
from types import SimpleNamespace

import numpy as np
import psutil
import pytest
from scipy.io import savemat

import roughcontact as rc
from instruments import hills, mat
from roughcontact.files.file_errors import ContentError
from roughcontact.files.matlab import require_whole

Z = hills()
GIVEN = {"unit": "nm", "size": 18e-6}


def element(kind, body, order="<"):
    return struct.pack(order + "2I", kind, len(body)) + body + b"\0" * (-len(body) % 8)


def matrix(points, shape=None, *, kind=6, stored=9, order="<", flags=0, name=b"Z"):
    """Return an array of numbers as the elements of a file, uncompressed."""
    shape = shape or points.shape
    body = element(6, struct.pack(order + "2I", kind | flags, 0), order)
    body += element(5, struct.pack(f"{order}{len(shape)}i", *shape), order) + element(1, name, order)
    return element(14, body + element(stored, points.T.astype(order + "f8").tobytes(), order), order)


def file_of(*elements, order="<"):
    head = (
        b"MATLAB 5.0 MAT-file".ljust(124)
        + struct.pack(order + "H", 0x0100)
        + (b"IM" if order == "<" else b"MI")
    )
    return head + b"".join(elements)


def packed(inner):
    body = zlib.compress(inner)
    return struct.pack("<2I", 15, len(body)) + body


@pytest.mark.parametrize("order", ["<", ">"])
def test_whole_files_are_read(put, order):
    pytest.importorskip("SurfaceTopography")
    for data in (
        file_of(matrix(Z, order=order), order=order),
        mat(Z=Z),
        file_of(packed(matrix(Z)), packed(matrix(Z, name=b"Phase"))),
    ):
        surface = rc.read(put("a.mat", data), channel="Z", **GIVEN)
        np.testing.assert_allclose(surface.heights, Z * 1e-9, rtol=1e-15)


def test_arrays_of_every_kind_pass(tmp_path):
    for compressed in (False, True):
        for value in (
            *(
                np.ones((5, 7), kind)
                for kind in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8", "c8", "c16")
            ),
            *("a text", {"field": Z}, np.array([["a", Z]], dtype=object), 3.0, np.zeros((0, 3)), Z > 0),
            *(np.ones((2, 3, 4)), np.float64(2.5)),
        ):
            savemat(tmp_path / "a.mat", {"value": value, "Z": Z}, do_compression=compressed)
            require_whole((tmp_path / "a.mat").read_bytes())


@pytest.mark.parametrize(("kind", "numbers"), [(5, False), (6, True), (10, True), (15, True), (16, False)])
def test_arrays_of_numbers_are_checked(kind, numbers):
    """Classes 6 to 15; sparse arrays (5) and functions (16) have other elements."""
    data = file_of(matrix(Z, (36, 36), kind=kind))
    if numbers:
        with pytest.raises(ContentError, match="9216 bytes for an array of 36 x 36 points"):
            require_whole(data)
    else:
        require_whole(data)


@pytest.mark.parametrize("stored", [1, 2, 3, 4, 5, 6, 7, 9, 12, 13])
def test_each_stored_type_has_its_size(stored):
    """The 9216 bytes of 32 x 36 numbers of 8 bytes are 9216 of one byte, 4608 of two, or 2304 of four."""
    size = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4}.get(stored, 8)
    require_whole(file_of(matrix(Z, (32, 36 * 8 // size), stored=stored)))
    with pytest.raises(ContentError, match="9216 bytes for an array of"):
        require_whole(file_of(matrix(Z, (32, 36 * 8 // size + 1), stored=stored)))


@pytest.mark.parametrize(
    "data",
    [
        file_of(matrix(Z, (36, 36))),
        file_of(matrix(Z, (-32, -36))),
        file_of(packed(matrix(Z, (36, 36)))),
        file_of(packed(matrix(Z)))[:-1],
        file_of(packed(matrix(Z)))[:-4] + b"\0\0\0\0",  # its checksum
        file_of(packed(matrix(Z)[:-8])),
        file_of(packed(matrix(Z) + b"\0" * 8)),
        file_of(matrix(Z))[:-9],
        file_of(matrix(Z)) + b"\0" * 3,
        file_of(matrix(Z, stored=7)),
        file_of(matrix(Z, flags=0x0800)),  # it lacks an imaginary part
    ],
)
def test_arrays_that_hold_other_than_they_announce_are_refused(put, data):
    with pytest.raises(ContentError, match="its arrays are damaged"):
        require_whole(data)
    pytest.importorskip("SurfaceTopography")
    with pytest.raises(rc.ReadError, match=r"a\.mat: its arrays are damaged"):
        rc.read(put("a.mat", data), **GIVEN)


def test_a_flipped_bit_in_a_compressed_array_is_noticed():
    whole = file_of(packed(matrix(Z)))
    for place in range(136, len(whole), 97):
        spoilt = bytearray(whole)
        spoilt[place] ^= 4
        with pytest.raises(ContentError):
            require_whole(bytes(spoilt))


def test_an_array_beyond_the_memory_is_not_unpacked(monkeypatch):
    """A header of 40 000 x 50 000 points, and zeros that unpack to a thousand times their size."""
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=8e9))
    zeros = np.zeros((2000, 1000))
    tracemalloc.start()
    with pytest.raises(ContentError, match="needs 200 GB of memory"):
        require_whole(file_of(packed(matrix(zeros, (40_000, 50_000)))))
    data = file_of(packed(matrix(zeros, (3, 4))))
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    with pytest.raises(ContentError, match="bytes for an array of 3 x 4 points"):
        require_whole(data)
    peak = tracemalloc.get_traced_memory()[1] - before
    tracemalloc.stop()
    assert peak < 1e6  # unpacked it takes 16 MB
