"""Loads: one value of one kind, checked once."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.solver.loads import Loads


@pytest.mark.parametrize("name", ["force", "forces", "depths", "pressure", "mean_gap", "mean_gaps"])
def test_the_name_of_an_argument_is_the_kind(name):
    loads = Loads.of(**{name: 2.0, "other": None})
    assert (loads.kind, loads.values.tolist()) == (name.replace("_", " ").removesuffix("s"), [2.0])


def test_loads_are_given_or_not():
    assert Loads.given(forces=None, depths=None) is None
    assert Loads.given(forces=None, depths=[1.0]).kind == "depth"
    with pytest.raises(ValueError, match="exactly one of forces and depths: none is given"):
        Loads.of(forces=None, depths=None)
    with pytest.raises(ValueError, match="exactly one of forces and depths, not forces and depths"):
        Loads.given(forces=[1.0], depths=[1.0])


def test_a_pressure_is_a_force_over_an_area():
    loads, grid = Loads("pressure", [2.0, 3.0]), rc.Grid((2, 2), 1.0)
    assert loads.controls(grid) == [rc.Force(8.0), rc.Force(12.0)]
    assert (loads.as_forces(grid).kind, loads.as_forces(grid).values.tolist()) == ("force", [8.0, 12.0])
    depths = Loads("depth", [2.0])
    assert depths.as_forces(grid) is depths
    assert depths.controls(grid) == [rc.Depth(2.0)]
    with pytest.raises(ValueError, match="pressure must be positive and finite"):
        Loads("pressure", [0.0]).controls(grid)


def test_bodies_approach_as_their_mean_gap_falls():
    assert Loads("mean gap", [3.0, 1.0]).approach.tolist() == [-3.0, -1.0]
    assert Loads("depth", [3.0, 1.0]).approach.tolist() == [3.0, 1.0]


def test_rising_loads_rise_strictly():
    rising = Loads("mean gap", [1.0, 2.0])
    assert rising.rising("begin anew") is rising
    with pytest.raises(ValueError, match=r"the mean gaps .*, but 2 follows 2 at place 2: begin anew"):
        Loads("mean gap", [1.0, 2.0, 2.0]).rising("begin anew")


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([], r"the list of forces must hold at least one number in one row, not shape \(0,\)"),
        (np.ones((2, 2)), r"not shape \(2, 2\)"),
        ([1.0, np.nan], r"the forces must be finite \(given: nan\)"),
        ([np.inf], r"the forces must be finite \(given: inf\)"),
        ("1,2", "the list of forces must be a number or an array of numbers"),
    ],
)
def test_what_is_no_row_of_numbers_is_refused(values, message):
    with pytest.raises(ValueError, match=message):
        Loads("force", values)


def test_equal_loads_are_one_key():
    """A zero has no sign."""
    one, same = Loads("depth", [0.0, 2.0]), Loads("depth", [-0.0, 2.0])
    others = [Loads("force", [0.0, 2.0]), Loads("depth", [2.0, 0.0]), Loads("depth", [0.0, 2.0, 2.0])]
    assert one == same
    assert not any(one == other for other in [*others, "depth"])
    assert len({one, same, *others}) == 4
