"""A curve says first what makes it doubtful: a contact that does not change, loads that follow no power law."""

import gc
import weakref
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.curve import collect
from roughcontact.contact.join_curves import joined, part_of
from roughcontact.solver.control import Status

GRID = rc.Grid((64, 64), 1e-6)
FORCES = np.geomspace(1e-3, 1e-2, 9)


@pytest.fixture(scope="module")
def hertz():
    return rc.loading_curve(rc.shapes.paraboloid(GRID, radius=1e-4), 1e9, forces=10 * FORCES)


def streaked(height):
    """Return a rough map of rms height 100 nm with four flat streaks of 80 cells."""
    grid = rc.Grid((128, 128), 1e-6)
    heights = rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(3)).heights.copy()
    heights[20::30, 10:90] = height
    return rc.Surface(heights, grid)


def with_area(curve, exponent, span):
    """Return the curve with an area that grows as a power of the force, from the smallest to `span` times as much."""
    force = np.geomspace(0.05, 0.05 * span, len(curve))
    return replace(curve, force=force, contact_area=1e-10 * (force / force[0]) ** exponent)


def test_loads_on_the_same_streaks_are_named_first():
    """Flat punches, whose stiffness is that of any load; without them it grows with the load."""
    surface = streaked(5e-6)
    curve, clean = (rc.loading_curve(each, 1e9, forces=FORCES) for each in (surface, surface.despiked()))
    assert np.ptp(curve.contact_area) == 0
    np.testing.assert_allclose(curve.stiffness, curve.stiffness[0], rtol=1e-6)
    note = curve.doubts[0]
    assert note in curve.notes
    assert note.startswith("The contact does not change from 1 mN to 10 mN: the same 4 spots carry all")
    assert "despiked() or masked()" in note
    assert repr(curve).endswith("; The contact does not change from 1 mN to 10 mN)")
    assert "The contact does not change" in curve._repr_html_()
    assert clean.resolved.all()
    assert clean.doubts == ()


def test_the_range_of_fixed_loads_is_named_where_others_reach_further():
    """The rest of the map is touched from a force of 0.03 N on."""
    curve = rc.loading_curve(streaked(6e-7), 1e9, forces=10 * FORCES)
    assert (curve.contact_area > 1.05 * curve.contact_area[0]).tolist() == [False] * 4 + [True] * 5
    assert curve.doubts[0].startswith("The contact does not change from 10 mN to 23.7 mN: the same 4 spots")


def test_bodies_whose_contact_grows_are_not_doubtful(hertz):
    """A Hertz sphere on its one spot, a blunt body z ~ r^8, whose area grows as F^(2/9), and a rough map."""
    assert hertz.doubts == ()
    assert repr(hertz).endswith(" N)")
    y, x = np.meshgrid(*GRID.coordinates, indexing="ij")
    radius = np.hypot(y - y.mean(), x - x.mean())
    blunt = rc.Surface(-1e-6 * (radius / 2e-5) ** 8, GRID)
    assert rc.loading_curve(blunt, 1e9, forces=10 * FORCES).doubts == ()
    rough = rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(3))
    assert rc.loading_curve(rough, 1e9).doubts == ()


@pytest.mark.parametrize(
    ("exponent", "span", "doubtful"),
    [(0.0, 10, True), (0.04, 10, True), (0.06, 10, False), (0.0, 2.1, True), (0.0, 1.9, False)],
)
def test_a_fixed_contact_is_one_that_grows_by_less_than_the_twentieth_power(hertz, exponent, span, doubtful):
    fixed = [note for note in with_area(hertz, exponent, span).doubts if "does not change" in note]
    assert bool(fixed) == doubtful


def test_nearly_all_in_contact_is_no_doubt(hertz):
    for share, doubtful in ((0.49, True), (0.51, False)):
        curve = replace(hertz, contact_area=np.full(len(hertz), share * hertz.nominal_area))
        assert any("does not change" in note for note in curve.doubts) == doubtful


@pytest.mark.parametrize(("size", "doubtful"), [(0.08, False), (0.13, True)])
def test_a_power_law_that_scatters_by_more_than_a_tenth_is_named(hertz, size, doubtful):
    """Of nine points above and below the law in turn the mean is a ninth of their size; Hertz scatters by 0.02."""
    ripple = size * (-1.0) ** np.arange(len(hertz))
    curve = replace(hertz, stiffness=hertz.stiffness * np.exp(ripple))
    assert curve.fit().scatter == pytest.approx(size, abs=0.02)
    assert [note.partition(" by ")[0] for note in curve.doubts] == ["The power law scatters"] * doubtful


def test_notes_on_the_states_are_those_on_the_largest_load(tmp_path):
    """Aluminium flows; the three notes of the largest load stand in the curve, ranked, and in its file."""
    surface = rc.self_affine(GRID, 0.8, 1e-6, np.random.default_rng(3))
    surface = surface.masked(below=float(surface.heights.min()) / 2)
    pressures = [1e6, 1e7, 1e8]
    curve = rc.loading_curve(surface, ("steel", "aluminium"), pressures=pressures)
    largest = rc.press(surface, ("steel", "aluminium"), pressure=pressures[-1])
    assert curve.notes == largest.notes
    flows, missing, edge = curve.notes
    assert "exceeds the hardness of aluminium" in flows
    assert "hold no height" in missing
    assert "at the edge of the map" in edge
    assert all(note in curve._repr_html_() for note in (missing, edge))
    assert curve.to_record()["notes"] == list(curve.notes)
    rc.write(curve, tmp_path / "curve.nc")
    assert rc.read_curve(tmp_path / "curve.nc").state_notes == curve.state_notes
    falling = rc.loading_curve(surface, 1e9, pressures=[2e6, 1e6], hardness=1e12)
    assert {force for force, _ in falling.state_notes} == {falling.force[0]}


def test_a_spike_is_named_at_the_lightest_resolved_load_where_it_carries_most(tmp_path):
    """Sixteen spikes of nine cells."""
    heights = rc.self_affine(rc.Grid((128, 128), 1e-6), 0.8, 1e-7, np.random.default_rng(3)).heights.copy()
    for row, column in np.ndindex(4, 4):
        heights[30 * row + 10 :, 30 * column + 10 :][:3, :3] = 1.2e-6
    heights[64, 64] = np.nan  # noted at the largest load of a curve only
    surface = rc.Surface(heights, rc.Grid((128, 128), 1e-6))
    curve = rc.loading_curve(surface, 1e9, forces=[0.003, 0.03, 0.1])
    assert curve.resolved.all()
    [note] = [note for note in curve.notes if "points stand" in note]
    light, heavy = (rc.press(surface, 1e9, force=force).notes for force in curve.force[[0, 2]])
    assert note == f"At 3 mN (183 kPa): {next(each for each in light if 'points stand' in each)}"
    assert any("points stand" in each for each in heavy)
    parts = [rc.loading_curve(surface, 1e9, forces=forces) for forces in ([0.1], [0.003, 0.03])]
    both = joined(*parts)
    assert note in both.notes
    assert {force for force, _ in both.state_notes} == set(both.force[[0, 2]])
    assert joined(*reversed(parts)).state_notes == both.state_notes
    assert not any(each.startswith("At ") for each in part_of(both, both.force > 0.05).notes)
    missed = replace(curve, status=(curve.status[0], Status.MAX_STEPS, curve.status[2]))
    assert missed.notes[0] == "1 of 3 loads missed the tolerance: see their status"


def test_a_curve_holds_no_state_of_a_load_while_the_next_is_solved():
    """Neither the notes nor a state's reference to itself keep the maps of a load: without the collector of cycles."""
    states, path = (
        [],
        rc.loading_path(rc.self_affine(GRID, 0.8, 1e-7, 1), 1e9, pressures=[1e5, 1e6, 1e7, 1e8]),
    )

    def watched():
        for solution in path:
            assert [state() for state in states] == [None] * len(states)
            states.append(weakref.ref(solution))
            yield solution
            del solution

    gc.disable()
    try:
        assert len(collect(watched())) == 4
    finally:
        gc.enable()
