"""What machine code may be called with: all else is a TypeError before the call."""

import gc
import weakref
from typing import NamedTuple

import numpy as np
import pytest

pytest.importorskip("llvmlite")

from roughcontact.kernels import loader
from roughcontact.kernels.calls import Operand
from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Double, Doubles, Flags, Indices, Scalar, Vector, kernel
from roughcontact.kernels.values import Index

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


class Pair(NamedTuple):
    """Two numbers of a kind each."""

    n: Index
    x: Vector


@kernel
def add(code: Code, pair: Pair, by: Scalar, to: Double, counts: Indices, flags: Flags, sums: Doubles):
    for i in code.range(0, pair.n):
        pair.x[i] = pair.x[i] + by
        sums[i] = pair.x[i].double() + to
        counts[i] = i
        flags[i] = pair.x[i] > 0.0


@pytest.fixture(scope="module")
def function():
    code = loader._translated({"add": add}, "float32")
    return loader._loaded(code, {"add": add}, "float32")["add"]


def given(**others):
    """Return arguments that are right, but for some."""
    right = {
        "n": 3,
        "x": np.zeros(3, np.float32),
        "by": 0.5,
        "to": 2.0,
        "counts": np.zeros(3, np.int64),
        "flags": np.zeros(3, bool),
        "sums": np.zeros(3),
    }
    return {**right, **others}


@pytest.mark.parametrize("wrapped", [lambda array: array, Operand])
def test_arrays_and_operands_are_taken(function, wrapped):
    arguments = given()
    function(*(wrapped(a) if isinstance(a, np.ndarray) else a for a in arguments.values()))
    assert arguments["x"].tolist() == [0.5] * 3
    assert arguments["sums"].tolist() == [2.5] * 3
    assert arguments["counts"].tolist() == [0, 1, 2]
    assert arguments["flags"].all()


@pytest.mark.parametrize("change", [lambda a: a[:-1], lambda a: [*a, 1], lambda a: []])
def test_the_number_of_arguments(function, change):
    with pytest.raises(TypeError, match="add takes 7 arguments, not"):
        function(*change(list(given().values())))


WRONG = {
    "x": [
        np.zeros(3),
        np.zeros(3, ">f4"),
        np.zeros(3, np.int32),
        [0.0, 0.0, 0.0],
        0,
        None,
        np.zeros((3, 2), "f4")[:, 0],
    ],
    "n": [3.0, None, "3", np.zeros(3)],
    "by": [None, "1", np.zeros(3, np.float32), 1j],
    "to": [None, b"1"],
    "counts": [np.zeros(3, np.int32), np.zeros(3)],
    "flags": [np.zeros(3, np.uint8), np.zeros(3)],
    "sums": [np.zeros(3, np.float32), Operand(np.zeros(3, np.float32))],
}


@pytest.mark.parametrize(("name", "wrong"), [(name, w) for name, many in WRONG.items() for w in many])
def test_the_type_of_each_argument(function, name, wrong):
    arguments = given(**{name: wrong})
    with pytest.raises(TypeError, match=r"add|one after the other"):
        function(*arguments.values())
    assert name == "x" or not arguments["x"].any()


def test_what_is_only_read_may_be_read_only_or_empty(function):
    """They are looked at another way."""
    x = np.zeros(3, np.float32)
    x.flags.writeable = False
    function(*given(n=0, x=x).values())
    function(*given(n=0, x=np.zeros(0, np.float32)).values())


def test_an_operand_holds_its_array():
    array = np.zeros(3)
    seen, operand = weakref.ref(array), Operand(array)
    del array
    gc.collect()
    assert operand.field is seen()
    del operand
    gc.collect()
    assert seen() is None


def test_an_annotation_that_is_no_type_of_a_parameter():
    @kernel
    def wrong(code: Code, n: int):
        """Take a number of Python's."""

    with pytest.raises(TypeError, match=r"int.* is no type of a kernel's parameter"):
        wrong.parameters("float64")
