"""What a user asks of surfaces that stick: curves up and down, mean gaps, refusals, datasets."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.adhesive_curve import collect_states
from roughcontact.contact.problem import separation_of
from roughcontact.solver.loads import Loads
from sticking import rough, sticky

RINGS = rc.RadialGrid.uniform(30, radius=6e-7)
BALL = rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS)
STRONG = rc.Adhesion(work=10e-3, range=4e-9, allow_unresolved=True)
PLANE = rough(16, periodic=True, slope=0.2, seed=1)
NAMES = (
    *("force", "depth", "stiffness", "contact_stiffness", "contact_area", "mean_gap"),
    *("elastic_energy", "adhesive_energy", "energy", "residual"),
)


def test_a_curve_holds_the_numbers_of_its_path():
    depths = [-1.0, 0.2, 0.2, 0.4, 0.1, -1.0, 0.0]
    curve = rc.adhesive_curve(PLANE, 1.0, sticky(2.0), depths=depths)
    states = list(rc.adhesive_path(PLANE, 1.0, sticky(2.0), depths=depths))
    for name in NAMES:
        np.testing.assert_allclose(
            getattr(curve, name), [getattr(state, name) for state in states], rtol=1e-12
        )
    assert curve.approach.tolist() == [True, True, True, True, False, False, True]
    assert curve.status == tuple(state.status for state in states)
    assert len(curve) == len(depths)
    assert curve.converged
    assert curve.control == "depth"


def test_jumps_know_the_point_that_they_led_to():
    depths = [-20e-9, 0.0, 10e-9, 0.0, -9e-9]
    curve = rc.adhesive_curve(BALL, 1e8, STRONG, depths=depths)
    states = list(rc.adhesive_path(BALL, 1e8, STRONG, depths=depths))
    assert [at for at, state in enumerate(states) for _ in state.jumps] == list(curve.jumped)
    assert {1, 4} <= set(curve.jumped)
    for jump, at in zip(curve.jumps, curve.jumped, strict=True):
        assert min(depths[at - 1], depths[at]) <= jump.depth <= max(depths[at - 1], depths[at])
        assert jump.approach == curve.approach[at]


def test_a_curve_under_forces_ends_where_they_pull_the_bodies_off():
    curve = rc.adhesive_curve(BALL, 1e8, STRONG, forces=[0.0, 4e-7, -1e-6, 0.0])
    assert curve.control == "force"
    assert curve.approach.tolist() == [True, True, False, True]
    assert np.isneginf(curve.depth).tolist() == [False, False, True, False]
    assert math.isinf(curve.lost)
    assert curve.to_record()["depth"][2] is None
    assert curve.to_record()["lost_energy"] is None


def test_a_mean_gap_is_the_mean_separation_less_the_depth():
    mean = separation_of(PLANE).mean()
    gaps = [0.9 * mean, 0.7 * mean, 0.8 * mean]
    curve = rc.adhesive_curve(PLANE, 1.0, sticky(2.0), mean_gaps=gaps)
    np.testing.assert_allclose(curve.mean_gap, gaps, rtol=1e-12)
    assert curve.approach.tolist() == [True, True, False]
    by_depth = rc.adhesive_curve(PLANE, 1.0, sticky(2.0), depths=mean - np.array(gaps))
    np.testing.assert_array_equal(curve.force, by_depth.force)
    one = rc.adhesive_state(PLANE, 1.0, sticky(2.0), mean_gap=gaps[1])
    assert one.force == pytest.approx(curve.force[1], rel=1e-8)
    assert one.mean_gap == pytest.approx(gaps[1], rel=1e-12)


def test_a_nominal_pressure_is_a_force_over_the_area_of_the_grid():
    forces = np.array([1.0, 2.0, -0.5])
    curve = rc.adhesive_curve(PLANE, 1.0, sticky(2.0), pressures=forces / PLANE.grid.area)
    by_force = rc.adhesive_curve(PLANE, 1.0, sticky(2.0), forces=forces)
    assert (curve.control, curve.approach.tolist()) == ("force", [True, True, False])
    np.testing.assert_array_equal(curve.depth, by_force.depth)  # the area is a power of two
    one = rc.adhesive_state(PLANE, 1.0, sticky(2.0), pressure=1.0 / PLANE.grid.area)
    assert one.depth == curve.depth[0]


def test_a_mean_gap_is_refused_where_it_is_no_depth():
    law = sticky(2.0)
    with pytest.raises(ValueError, match="the body is not periodic: give depths or forces"):
        rc.adhesive_state(rough(16, periodic=False, slope=0.2, seed=1), 1.0, law, mean_gap=1.0)
    heights = PLANE.heights.copy()
    heights[3, 3] = np.nan
    with pytest.raises(ValueError, match="some cells are missing: give depths or forces"):
        rc.adhesive_state(rc.Surface(heights, PLANE.grid), 1.0, law, mean_gap=1.0)
    with pytest.raises(ValueError, match="full contact or beyond it: give mean gaps above 0"):
        rc.adhesive_path(PLANE, 1.0, law, mean_gaps=[0.5, 0.0])
    with pytest.raises(ValueError, match=r"exactly one of .*, not depth and mean_gap"):
        rc.adhesive_state(PLANE, 1.0, law, depth=0.1, mean_gap=1.0)


def test_what_a_curve_that_sticks_does_not_take_is_refused():
    law = sticky(2.0)
    with pytest.raises(ValueError, match="cannot begin under the tension -1"):
        rc.adhesive_curve(PLANE, 1.0, law, forces=[-1.0])
    with pytest.raises(ValueError, match=f"cannot begin under the tension {-PLANE.grid.area:g}"):
        rc.adhesive_path(PLANE, 1.0, law, pressures=[-1.0])
    line = rc.Surface(PLANE.heights[0], rc.Grid(16, 1.0))
    with pytest.raises(ValueError, match=r"springs .*mdr\.adhesion"):
        rc.adhesive_state(line, 1.0, law, depth=0.1, operator=rc.foundation(line.grid, 1.0))


def test_loads_go_down_only_where_something_makes_a_difference():
    with pytest.raises(ValueError, match="only under a hardness and in adhesive_path"):
        rc.loading_curve(PLANE, 1.0, depths=[0.2, 0.1])


def test_a_missed_tolerance_is_an_error_that_carries_the_state():
    with pytest.raises(rc.ConvergenceError, match=r"tolerance 1\.1e-14: The residual stopped") as caught:
        rc.adhesive_state(BALL, 1e8, STRONG, depth=0.0, tolerance=1.1e-14)
    state = caught.value.solution
    assert isinstance(state, rc.AdhesiveState)
    assert not state.status.converged
    assert state.residual < 1e-8
    curve = rc.adhesive_curve(BALL, 1e8, STRONG, depths=[0.0], tolerance=1.1e-14)
    assert not curve.converged  # a curve marks it, and goes on


def test_a_state_becomes_a_dataset_and_a_record():
    state = rc.adhesive_state(PLANE, 1.0, sticky(2.0), depth=0.3)
    dataset, record = state.to_dataset(), state.to_record()
    for name in ("pressure", "gap", "displacement", "contact", "attracted"):
        np.testing.assert_array_equal(dataset[name], getattr(state, name))
        assert dataset[name].dims == ("y", "x")
    np.testing.assert_array_equal(dataset["heights"], PLANE.heights)
    for name in (*NAMES, "stability", "stability_residual"):
        assert float(dataset[name]) == record[name] == getattr(state, name)
    assert dataset.attrs["law"] == record["law"] == "exponential"
    assert float(dataset["work_of_adhesion"]) == record["work_of_adhesion"] == sticky(2.0).work
    assert record["modulus"] == 1.0
    assert dataset.sizes["jump"] == len(state.jumps) == len(record["jump_depth"])
    assert "tension" in dataset["pressure"].attrs["long_name"]
    assert all(values.attrs["long_name"] for values in dataset.values())


def test_the_numbers_of_a_state_are_sums_over_its_cells():
    """Of cells that are not square, some of which pull and some press; the last state has no tension."""
    grid = rc.Grid((12, 16), (2.0, 0.5), True)
    surface = rc.Surface(rough(16, periodic=True, slope=0.2, seed=1).heights[:12], grid)
    state = rc.adhesive_state(surface, 1.0, sticky(6.0), depth=0.3)
    p, u = state.pressure, state.displacement
    assert p.min() < 0 < p.max()
    assert (state.max_pressure, state.max_tension) == (p.max(), -p.min())
    assert state.force == pytest.approx(p.sum(), rel=1e-12)  # the area of a cell is one
    assert state.nominal_pressure == pytest.approx(p.mean(), rel=1e-12)
    assert state.contact_fraction == pytest.approx(state.contact.mean(), rel=1e-12)
    assert state.elastic_energy == pytest.approx(0.5 * (p * u).sum(), rel=1e-12)
    assert state.mean_gap == pytest.approx(state.gap.mean(), rel=1e-12)
    pressed = np.where(p == p.max(), 1e-9, 0.0)  # work of adhesion where nothing pulls
    free = rc.adhesive_state(surface, 1.0, rc.Adhesion(pressed, 1.0, allow_unresolved=True), depth=0.3)
    assert free.max_pressure > 0
    assert free.max_tension == 0


def test_the_jump_in_force_is_the_tension_before_the_first_jump_of_the_approach():
    curve = rc.adhesive_curve(BALL, 1e8, STRONG, depths=[-20e-9, 0.0])
    jump = curve.jumps[0]
    before = rc.adhesive_curve(BALL, 1e8, STRONG, depths=[-20e-9, jump.depth - 1e-14])[-1]
    assert before.force < 0
    # Next to the end of a branch the force changes with the root of the distance from it.
    assert curve.jump_in_force == pytest.approx(-before.force, rel=1e-2)
    assert math.isnan(rc.adhesive_curve(BALL, 1e8, STRONG, depths=[-20e-9, -19e-9]).jump_in_force)


def test_cells_apart_by_no_more_than_the_range_are_attracted():
    state = rc.adhesive_state(PLANE, 1.0, sticky(2.0), depth=0.3)
    reach = sticky(2.0).range
    within = ~state.contact & (state.gap <= reach)
    # There are cells of each kind, among them some between one range and two.
    assert state.contact.any()
    assert within.any()
    assert ((state.gap > reach) & (state.gap <= 2 * reach)).any()
    np.testing.assert_array_equal(state.attracted, within)


def test_cells_in_contact_without_a_reaction_are_weakly_active():
    state = rc.adhesive_state(PLANE, 1.0, sticky(2.0), depth=0.3)
    assert not state.weakly_active.any()
    held = tuple(np.argwhere(state.contact)[0])
    pressure = state.pressure.copy()
    pressure[held] = -sticky(2.0).strength  # all that the attraction has: the wall adds nothing
    weak = replace(state, pressure=pressure).weakly_active
    assert np.argwhere(weak).tolist() == [list(held)]


def test_the_surface_of_a_state_is_read_back(tmp_path):
    small = rc.Surface(PLANE.heights * 1e-8, rc.Grid((16, 16), 1e-8, periodic=True))
    law = rc.Adhesion(work=10e-3, range=4e-9)
    state = rc.adhesive_state(small, 1e8, law, depth=2e-9)
    rc.write(state, tmp_path / "state.nc")
    back = rc.read(tmp_path / "state.nc")
    np.testing.assert_array_equal(back.heights, small.heights)
    assert back.grid == small.grid
    rc.write(state, tmp_path / "state.vti")
    assert b'Name="pressure"' in (tmp_path / "state.vti").read_bytes()


def test_a_state_on_rings_has_the_mean_gap_over_their_areas():
    state = rc.adhesive_state(BALL, 1e8, STRONG, depth=0.0)
    areas = RINGS.cell_area
    assert state.mean_gap == pytest.approx(float((state.gap * areas).sum() / areas.sum()), rel=1e-12)
    assert state.to_dataset()["pressure"].dims == ("r",)


def test_a_path_that_ends_early_keeps_what_is_done():
    path = rc.adhesive_path(PLANE, 1.0, sticky(2.0), depths=[0.1, 0.2, 0.1])
    some = collect_states((next(path) for _ in range(2)), Loads("depth", np.array([0.1, 0.2, 0.1])))
    assert some.depth.tolist() == [0.1, 0.2]
    assert some.approach.tolist() == [True, True]


@pytest.mark.parametrize("cells", [0.013, 0.71, 1.0, 1.4999])
def test_the_cell_and_the_range_that_a_refusal_names_are_not_refused_again(cells):
    surface, law = rough(16, periodic=True, slope=0.2, seed=1), sticky(cells)
    with pytest.raises(ValueError, match="would trap every state") as caught:
        rc.adhesive_path(surface, 1.0, law, depths=[0.0])
    found = re.search(r"at most (\S+) m or a range of at least (\S+) m", str(caught.value))
    cell, reach = map(float, found.groups())
    rc.adhesive_path(surface, 1.0, rc.Adhesion(law.work, reach), depths=[0.0])
    fine = rc.Surface(surface.heights, rc.Grid((16, 16), cell, periodic=True))
    rc.adhesive_path(fine, 1.0, law, depths=[0.0])
