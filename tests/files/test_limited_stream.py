"""A reader that goes round in circles comes to an end, and the unread rest of a file is known."""

import io
import time
import warnings

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files import limited_stream as bounded
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.limited_stream import BoundedStream

DATA = bytes(range(256)) * 4


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


@pytest.mark.parametrize(("limit", "value"), [("_BYTES", 50_000), ("_CALLS", 500)])
def test_reading_for_ever_is_ended_for_good(monkeypatch, limit, value):
    for name in ("_TIMES", limit):
        monkeypatch.setattr(bounded, name, 0 if name == "_TIMES" else value)
    monkeypatch.setattr(bounded, "_BYTES_A_CALL", len(DATA) + 1)
    stream = BoundedStream(DATA, "surface.any")
    for _ in range(500):  # of 100 bytes
        read_again(stream)
    for _ in range(3):
        with pytest.raises(RuntimeError, match="round in circles"):
            read_again(stream)


@pytest.fixture
def measured(surfaces):
    pytest.importorskip("SurfaceTopography")
    return lambda name: (surfaces / name).read_bytes()


def test_a_header_that_leads_to_itself_is_refused(measured, put):
    """Bytes of a TIFF whose list of pages, spoilt in one place, has no end."""
    data = bytearray(measured("Park_20210916_034.tiff"))
    for place in np.random.default_rng(44).integers(0, 2000, 20):
        data[place] ^= 1 << int(place) % 8
    started = time.monotonic()
    with pytest.raises(rc.ReadError):
        rc.read(put("a.tiff", bytes(data)))
    assert time.monotonic() - started < 30


def test_a_wrong_number_of_rows_shows_at_the_end_of_the_file(measured, put):
    data = bytearray(measured("valid_zygo_dat_file.dat"))
    assert data[70:72] == (432).to_bytes(2, "big")
    data[70:72] = (304).to_bytes(2, "big")
    with pytest.warns(SurfaceWarning, match="217600 bytes at its end belong to no channel"):
        rc.read(put("a.dat", bytes(data)))  # 128 rows of 425 points of 4 bytes


def test_a_wrong_number_of_columns_shows_in_the_last_channel(measured, put):
    data = measured("mi-1.mi").replace(b"xPixels       256", b"xPixels       276")
    with pytest.warns(SurfaceWarning, match="its last channel is not all there"):
        rc.read(put("a.mi", data))


def test_heights_upside_down_are_refused(measured, put):
    data = bytearray(measured("valid_zygo_dat_file.dat"))
    data[164] ^= 0x80  # the sign of the factor of the interferometer
    with pytest.raises(rc.ReadError, match=r"states a factor of -\d"):
        rc.read(put("a.dat", bytes(data)))


def test_whole_files_leave_nothing_over(measured, put):
    for name in ("mi-1.mi", "top-1.top", "tmd-1.tmd", "valid_zygo_dat_file.dat"):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            rc.read(put(name, measured(name)))
