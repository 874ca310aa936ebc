import json

import numpy as np
import pytest
import xarray
from hypothesis import given, settings, strategies as st
from hypothesis.extra import numpy as hnp

from roughcontact.study.record import decode, encode, require_record, residual_of

DTYPES = ["f8", "f4", "f2", ">f8", "i8", "i1", "u8", "?", "U3"]


@settings(deadline=None)  # the first dataset brings other libraries with it
@given(
    st.sampled_from(DTYPES).flatmap(
        lambda dtype: hnp.arrays(dtype, hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=3))
    )
)
def test_every_value_comes_back_to_the_last_bit(array):
    dims = [f"d{i}" for i in range(array.ndim)]
    record = xarray.Dataset({"a": (dims, array)})
    require_record(record)
    back = decode(encode(record))["a"]
    assert back.dims == tuple(dims)
    assert back.dtype == array.dtype
    if array.dtype.kind == "f":  # of NaN there are many, and one is enough
        np.testing.assert_array_equal(np.isnan(back.values), np.isnan(array))
        back, array = np.nan_to_num(back.values, nan=1), np.nan_to_num(array, nan=1)
        assert back.tobytes() == array.tobytes()
    else:
        assert back.values.tobytes() == array.tobytes()


def test_all_of_a_record_comes_back():
    record = xarray.Dataset(
        {
            "force": ("load", [1.0, np.inf], {"units": "N", "digits": np.int64(3)}),
            "resolved": ("load", [True, False]),
            "count": 3,
            "word": "Öl",
        },
        {"load": [10, 20], "hurst": 0.8},
        {"title": "one", "tolerance": 1e-8, "periodic": np.bool_(True)},
    )
    require_record(record)
    back = decode(encode(record))
    xarray.testing.assert_identical(back, record)
    assert list(back.variables) == ["force", "resolved", "count", "word", "load", "hurst"]
    assert set(back.coords) == {"load", "hurst"}
    json.loads(encode(record))  # JSON but for NaN and Infinity


@pytest.mark.parametrize(
    ("record", "complaint"),
    [
        ({"a": 1}, "returns an xarray.Dataset, not dict"),
        (None, "not NoneType"),
        (xarray.Dataset({"a": 1j}), "'a' has the type complex128"),
        (xarray.Dataset({"a": ("x", np.array([None]))}), "'a' has the type object"),
        (xarray.Dataset({"a": np.datetime64("2020-01-01", "ns")}), "datetime64"),
        (xarray.Dataset({"a": np.longdouble(1)}), "numbers of up to 64 bits"),
        (xarray.Dataset({"a": ((), 1.0, {"range": [0, 1]})}), r"attribute 'range' of 'a' is \[0, 1\]"),
        (xarray.Dataset(attrs={"surface": None}), "attribute 'surface' of the record is None"),
    ],
)
def test_what_cannot_be_kept_is_refused(record, complaint):
    with pytest.raises(TypeError, match=complaint):
        require_record(record)


def test_a_field_that_was_promised_must_be_there():
    with pytest.raises(ValueError, match="lacks 'pressure'"):
        require_record(xarray.Dataset({"force": 1.0}), ("pressure",))


def test_the_certificate_is_the_largest_residual():
    assert residual_of(xarray.Dataset({"residual": ("load", [1e-9, 3e-9, 2e-9])})) == 3e-9
    assert residual_of(xarray.Dataset({"residual": 1e-9})) == 1e-9
    assert residual_of(xarray.Dataset({"residual": ("load", [])})) is None
    assert residual_of(xarray.Dataset({"residual": ("load", [np.nan, 3e-9])})) == 3e-9
    assert residual_of(xarray.Dataset({"residual": ("load", [np.nan])})) is None
    assert residual_of(xarray.Dataset({"force": 1.0})) is None


def test_variables_of_earlier_builds_have_the_names_of_today():
    """Records hold `max_pressure`; a store of before, whose keys are still valid, holds it by another name."""
    record = xarray.Dataset({"largest_pressure": ((), 2.0, {"units": "Pa"}), "force": ((), 1.0)})
    found = decode(encode(record))
    assert set(found.data_vars) == {"max_pressure", "force"}
    assert found["max_pressure"].identical(record["largest_pressure"].rename("max_pressure"))
