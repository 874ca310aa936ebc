"""Averages of ensembles in numbers and words."""

import numpy as np
import pytest
import xarray

from roughcontact_thesis.averaging import (
    converged,
    exponential,
    logarithm,
    means,
    slope,
    without_parameters,
)
from roughcontact_thesis.verdict import plus_minus


def test_a_mean_has_its_error():
    found = means(k=xarray.DataArray([[1.0, 2.0, 3.0]], dims=("load", "sample")))
    assert float(found["k"][0]) == 2.0
    assert float(found["k_error"][0]) == pytest.approx(1 / np.sqrt(3))
    assert plus_minus(found.isel(load=0), "k") == "2.00 ± 0.58"
    assert plus_minus(found.isel(load=0), "k", "+.1%") == "+200.0% ± 57.7%"
    alone = means(k=xarray.DataArray([2.0], dims="sample"))
    assert plus_minus(alone, "k", ".1f") == "2.0"


def test_loads_that_missed_their_tolerance_are_missing():
    given = xarray.Dataset(
        {
            "status": (("sample", "load"), [["converged", "stagnated"], ["no contact", ""]]),
            "k": (("sample", "load"), [[1.0, 2.0], [3.0, 4.0]]),
            "force": ("load", [5.0, 6.0]),
            "spots": (("sample", "load"), [[1, 2], [3, 4]]),
        },
        {"points": 5},
    )
    found = converged(given)
    np.testing.assert_array_equal(found["k"], [[1.0, np.nan], [3.0, np.nan]])
    xarray.testing.assert_identical(found[["force", "spots", "status"]], given[["force", "spots", "status"]])
    assert "points" not in without_parameters(found).coords


def test_a_slope_is_that_of_the_straight_line_and_leaves_out_what_is_missing():
    x = xarray.DataArray([1.0, 2.0, 4.0, 8.0], dims="load")
    y = xarray.DataArray([[3.0, 5.0, 9.0, 17.0], [1.0, np.nan, -2.0, np.nan]], dims=("sample", "load"))
    np.testing.assert_allclose(slope(y, x, "load"), [2.0, -1.0], rtol=1e-14)
    power = 3 * x**0.7
    assert float(slope(logarithm(power), logarithm(x), "load")) == pytest.approx(0.7)
    np.testing.assert_allclose(exponential(logarithm(power)), power, rtol=1e-14)
