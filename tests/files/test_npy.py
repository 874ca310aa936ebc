"""The header of a NumPy array, read without running it."""

import io
import warnings

import numpy as np
import pytest

from roughcontact.files.npy import read_npy_header


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
