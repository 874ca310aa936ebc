"""The border of a theory, by the annotations of its functions."""

from __future__ import annotations

import inspect
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest

from roughcontact.theory.tools.domain import Array
from roughcontact.theory.tools.numeric import numeric, require_numbers


@numeric
def theory(
    force: npt.ArrayLike, depth: float | Array, hurst: float, *, length: float | None = None, name: str = ""
) -> tuple[object, ...]:
    """Return what is given."""
    return force, depth, hurst, length, name


def test_values_pass_as_they_are():
    force = [1.0, 2.0]
    assert theory(force, 3, True, name="x") == (force, 3, True, None, "x")
    assert theory(force, 3, True, name="x")[0] is force
    theory(np.ones((2, 1)), np.ones(3), np.float64(0.8), length=2)
    theory(np.inf, -1.0, 0.0)  # ranges are the function's own


def test_the_function_stays_itself():
    assert theory.__name__ == "theory"
    assert theory.__doc__ == "Return what is given."
    assert list(inspect.signature(theory).parameters) == ["force", "depth", "hurst", "length", "name"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"force": "x"}, "force must be a number or an array of numbers in SI units, not 'x'"),
        ({"depth": None}, "depth must be a number or an array of numbers in SI units, not None"),
        ({"depth": [1.0, np.nan]}, "depth must be a number, not nan"),
        ({"hurst": [0.8]}, r"hurst must be one number, not an array of shape \(1,\)"),
        ({"length": "x"}, "length must be a number"),
        ({"force": np.ones(2), "depth": np.ones(3)}, r"do not fit: force \(2,\), depth \(3,\)$"),
    ],
    ids=str,
)
def test_what_is_wrong_is_named(given, message):
    with pytest.raises(ValueError, match=message):
        theory(**{"force": 1.0, "depth": 1.0, "hurst": 0.8} | given)


def test_missing_and_unknown_arguments_are_those_of_python():
    with pytest.raises(TypeError, match="missing"):
        theory(1.0, 2.0)
    with pytest.raises(TypeError, match="unexpected"):
        theory(1.0, 2.0, 3.0, other=1.0)
    with pytest.raises(TypeError, match="positional"):
        theory(1.0, 2.0, 3.0, 4.0)


def test_fields_of_a_body():
    @dataclass
    class Body:
        radius: float
        reference: float | None
        name: str

    require_numbers(Body(1.0, None, "x"))
    with pytest.raises(ValueError, match="radius must be one number"):
        require_numbers(Body(np.ones(2), None, "x"))
    with pytest.raises(ValueError, match="reference must be a number, not nan"):
        require_numbers(Body(1.0, np.nan, "x"))
