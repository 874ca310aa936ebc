"""Numbers of each state beside those of a curve."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.join_curves import joined, part_of

SURFACE = rc.self_affine(
    rc.Grid((32, 16), (1e-6, 2e-6), periodic=True), hurst=0.8, rms=1e-7, rng=1, rolloff=16e-6
)


def largest(solution):
    return {"largest_spot": solution.spots.areas.max()}


def curve_of(pressures, measures=(largest, lambda solution: {"hydraulic_gap": 2 * solution.mean_gap})):
    return rc.loading_curve(SURFACE, 1e9, pressures=pressures, measures=measures)


def test_measures_are_columns_of_the_curve_and_of_its_files(tmp_path):
    curve = curve_of([1e6, 4e6])
    states = list(rc.loading_path(SURFACE, 1e9, pressures=[1e6, 4e6]))
    assert curve.measured["largest_spot"].tolist() == [each.spots.areas.max() for each in states]
    assert curve.measured["hydraulic_gap"].tolist() == (2 * curve.mean_gap).tolist()
    data = curve.to_dataset()
    assert data["hydraulic_gap"].attrs["units"] == "m"  # a name of the tables has its unit
    assert "units" not in data["largest_spot"].attrs  # of another name the unit is unknown
    assert curve.to_record()["largest_spot"] == curve.measured["largest_spot"].tolist()
    rc.write(curve, tmp_path / "curve.nc")
    read = rc.read_curve(tmp_path / "curve.nc")
    assert {name: values.tolist() for name, values in read.measured.items()} == {
        name: values.tolist() for name, values in curve.measured.items()
    }


def test_one_measure_is_read_back(tmp_path):
    rc.write(curve_of([1e6], [largest]), tmp_path / "curve.nc")
    assert list(rc.read_curve(tmp_path / "curve.nc").measured) == ["largest_spot"]


def test_measured_curves_are_joined_and_cut():
    whole = curve_of([1e6, 2e6, 4e6])
    ends = part_of(whole, np.array([True, False, True]))
    both = joined(ends, part_of(whole, np.array([False, True, False])))
    for name, values in whole.measured.items():
        assert both.measured[name].tolist() == values.tolist()
    with pytest.raises(ValueError, match="measured in different ways"):
        joined(ends, curve_of([2e6], [largest]))


@pytest.mark.parametrize("name", ["force", "largest_spot", "secant_stiffness"])
def test_two_columns_of_one_name_are_refused(name):
    with pytest.raises(ValueError, match=f"two columns of the curve have the name '{name}'"):
        curve_of([1e6], [largest, lambda solution: {name: 1.0}])
