"""Blocks of stated lengths, in the three formats that consist of them."""

import struct

import pytest

from roughcontact.files.block_ends import left_behind_blocks

FRT = (
    b"FRTM_GLIDERV1.00"
    + struct.pack("<H", 2)
    + struct.pack("<HI", 101, 3)
    + b"abc"
    + struct.pack("<HI", 11, 8)
    + bytes(8)
)


def opd():
    entry = struct.Struct("<16shIH")
    lengths = {b"Directory": 4 * entry.size, b"RAW_DATA": 40, b"Title": 6}
    table = b"".join(entry.pack(name, 3, length, 1) for name, length in lengths.items())
    return b"\x01\0" + table.ljust(4 * entry.size, b"\0") + bytes(46)


NID = (
    b"[DataSet]\r\nVersion=2\r\n[DataSet-0:1]\r\nPoints=4\r\nLines=3\r\nSaveBits=16\r\n"
    b"[DataSet-0:2]\r\nPoints=4\r\nLines=3\r\nSaveBits=32\r\n[DataSet-Info]\r\nPoints=4\r\n\r\n#!"
    + bytes(24 + 48)
)
WHOLE = {"frt": FRT, "opd": opd(), "ezd": NID}


@pytest.mark.parametrize("name", WHOLE)
def test_they_end_where_the_file_ends(name):
    data = WHOLE[name]
    assert left_behind_blocks(name, data) == 0
    assert left_behind_blocks(name, data + b"x") == 1
    assert left_behind_blocks(name, data[:-1]) == -1
    assert left_behind_blocks(name, data[:17]) < 0


def test_a_byte_that_came_in_moves_the_blocks():
    assert left_behind_blocks("frt", FRT[:24] + b"\x55" + FRT[24:]) != 0
    assert left_behind_blocks("ezd", NID.replace(b"Points=4", b"Points=41", 1)) < 0


def test_other_formats_have_none():
    assert left_behind_blocks("di", b"anything") == 0
