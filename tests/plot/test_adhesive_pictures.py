"""Pictures of surfaces that stick: what is drawn is what was computed."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import written
from roughcontact.plot.adhesive_facts import adhesive_curve_facts, jump_facts
from roughcontact.plot.jumps import pieces_of
from sticking import rough, sticky

RINGS = rc.RadialGrid.uniform(30, radius=6e-7)
BALL = rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS)
STRONG = rc.Adhesion(work=0.1, range=2.5e-9, allow_unresolved=True)
NM, UN = 1e9, 1e6  # depths are drawn in nanometres, forces in micronewtons


@pytest.fixture(scope="module")
def loop():
    return rc.adhesive_loop(BALL, 1e9, STRONG, depth=10e-9, points=8)


def test_a_loop_shows_its_points_and_breaks_at_its_jumps(loop):
    axes = loop.plot(Figure().subplots())
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("depth [nm]", "force [µN]")
    names = {line.get_label(): line for line in axes.lines}
    for name, way in (("approach", True), ("retreat", False)):
        drawn = names[name].get_xydata()
        np.testing.assert_allclose(drawn[:, 0], loop.depth[loop.approach == way] * NM)
        np.testing.assert_allclose(drawn[:, 1], loop.force[loop.approach == way] * UN)
    dashed = [line.get_xydata() for line in axes.lines if line.get_linestyle() == "--"]
    assert len(dashed) == len(loop.jumps) > 1
    for ends, jump in zip(dashed, loop.jumps, strict=True):
        np.testing.assert_allclose(ends[:, 0], np.array([jump.depth, jump.depth_after]) * NM)
        np.testing.assert_allclose(ends[:, 1], np.array([jump.force_before, jump.force_after]) * UN)
    # Words stand at the middle of each jump that spans a twentieth of either axis.
    spans = np.ptp(loop.depth), np.ptp(loop.force)
    ends = [
        np.array([(jump.depth, jump.force_before), (jump.depth_after, jump.force_after)])
        for jump in loop.jumps
    ]
    large = [(np.abs(np.diff(each, axis=0)[0]) > 0.05 * np.array(spans)).any() for each in ends]
    assert 0 < sum(large) < len(large)
    told = [(jump, each) for jump, each, some in zip(loop.jumps, ends, large, strict=True) if some]
    for text, (jump, each) in zip(axes.texts, told, strict=True):
        assert text.get_text() == written(jump.lost, "J")
        np.testing.assert_allclose(text.xy, each.mean(axis=0) * (NM, UN))
    # Between jumps lines are whole: no piece leads from before one to after it.
    depths = np.concatenate(
        [loop.depth, [each for jump in loop.jumps for each in (jump.depth, jump.depth_after)]]
    )
    forces = np.concatenate(
        [loop.force, [each for jump in loop.jumps for each in (jump.force_before, jump.force_after)]]
    )
    at = loop.pull_off_point
    pull_off = np.array([[loop.lowest_force_depth[at] * NM, -loop.pull_off_force * UN]])
    np.testing.assert_allclose(names["pull-off"].get_xydata(), pull_off)
    assert any(-loop.pull_off_force in force for _, force in pieces_of(loop, way=False))
    known = np.concatenate([np.stack([depths * NM, forces * UN], 1), pull_off])
    drawn = np.concatenate([line.get_xydata() for line in axes.lines if line.get_linestyle() == "-"][1:])
    np.testing.assert_allclose(np.abs(drawn[:, None] - known).sum(axis=2).min(axis=1), 0, atol=1e-12)
    pieces = [line.get_xydata()[:, 1] / UN for line in axes.lines if line.get_linestyle() == "-"][1:]
    for jump in (each for each in loop.jumps if abs(each.force_after - each.force_before) > 1e-7):
        assert not any(jump.force_before in piece and jump.force_after in piece for piece in pieces)
    lost = written(sum(jump.lost for jump in loop.jumps), "J")
    pull_off = written(loop.pull_off_force, "N")
    assert axes.get_title() == f"pull-off {pull_off}, {lost} lost in {len(loop.jumps)} jumps (unresolved)"


def test_the_contact_area_breaks_at_jumps(loop):
    axes = rc.plot.jump_area(loop, Figure().subplots())
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("depth [nm]", "relative real contact area A/A0 [%]")
    names = {line.get_label(): line.get_xydata() for line in axes.lines}
    for name, way in (("approach", True), ("retreat", False)):
        drawn = names[name]
        expected = np.stack([loop.depth * NM, 100 * loop.contact_area / loop.nominal_area], 1)
        turn = [] if way else [np.flatnonzero(loop.approach)[-1]]  # where the retreat begins
        points = np.concatenate([turn, np.flatnonzero(loop.approach == way)]).astype(int)
        np.testing.assert_allclose(drawn[np.isfinite(drawn).all(axis=1)], expected[points])
        breaks = sorted({at for at in loop.jumped if loop.approach[at] == way})
        [gaps] = np.isnan(drawn[:, 1]).nonzero()
        # Before each point that jumps led to, counted without the gaps before it.
        assert [*gaps - np.arange(len(gaps))] == [*np.searchsorted(points, breaks)] != []


def test_what_a_force_pulls_off_has_no_point(loop):
    path = rc.adhesive_curve(BALL, 1e9, STRONG, forces=[0.0, 4e-6, -1e-5])
    axes = path.plot(Figure().subplots())
    assert "then pulled off" in axes.get_title()
    assert "pulled off" in [text.get_text() for text in axes.texts]
    assert all(np.isfinite(line.get_xydata()).all() for line in axes.lines)
    [off] = [jump for jump in path.jumps if np.isinf(jump.lost)]
    *_, last = (line.get_xydata() for line in axes.lines if line.get_linestyle() == "--")
    np.testing.assert_allclose(last[0], (off.depth * NM, off.force_before * UN))
    assert last[1, 0] < last[0, 0]  # it leaves, under the force that pulls it
    assert last[1, 1] == last[0, 1]
    rc.plot.jump_figure(path).canvas.draw()


@pytest.fixture(scope="module")
def state():
    return rc.adhesive_state(rough(16, periodic=True, slope=0.2, seed=1), 1.0, sticky(2.0), depth=0.5)


def test_a_map_has_zero_in_the_middle_and_outlines_the_contact(state):
    axes = state.plot(Figure().subplots())
    image = axes.images[0]
    assert image.norm(0.0) == 0.5
    assert not axes.patch.get_hatch()
    assert image.norm(image.norm.vmin) == 0.0
    np.testing.assert_allclose(image.get_array(), state.pressure * 1e3, rtol=1e-12)
    assert image.colorbar.ax.get_ylabel().startswith("pressure, tension negative [mPa]")
    assert image.norm.vmin == pytest.approx(state.pressure.min() * 1e3, rel=1e-12)
    # The largest pressures, at the edges of spots, do not take the colours for themselves.
    pressed = state.pressure[state.pressure > 0]
    usual = np.quantile(pressed, 0.95)
    highest = usual if pressed.max() > 1.5 * usual else pressed.max()
    assert image.norm.vmax == pytest.approx(highest * 1e3, rel=1e-12)
    [outline] = [each for each in axes.collections if isinstance(each, LineCollection)]
    ringed = np.pad(state.contact, 1)
    edges = sum(int((np.diff(ringed, axis=axis) != 0).sum()) for axis in (0, 1))
    assert len(outline.get_segments()) == edges > 0


def test_a_contact_is_outlined_where_it_is():
    """On cells and a map that are not square, and a contact that is off the diagonal."""
    grid = rc.Grid((12, 20), (3e-8, 2e-8))
    y, x = (along - along[at] for along, at in zip(grid.coordinates, (3, 13), strict=True))
    ball = rc.Surface(-(y[:, None] ** 2 + (x / 2) ** 2) / 2e-5, grid)
    state = rc.adhesive_state(ball, 1e8, rc.Adhesion(0.01, 4e-9, allow_unresolved=True), depth=1e-9)
    axes = rc.plot.tension_map(state, Figure().subplots())
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [nm]", "y [nm]")
    [outline] = [each for each in axes.collections if isinstance(each, LineCollection)]
    drawn = {tuple(sorted((round(a), round(b)) for a, b in ends)) for ends in outline.get_segments()}
    edges = set()
    for row, column in np.argwhere(state.contact):
        top, left = 30 * int(row), 20 * int(column)
        bottom, right = top + 30, left + 20
        for end in (
            ((left, top), (right, top)),
            ((left, bottom), (right, bottom)),
            ((left, top), (left, bottom)),
            ((right, top), (right, bottom)),
        ):
            edges ^= {end}  # an edge between two cells in contact is none of the outline
    assert 4 < state.contact.sum() < grid.size
    assert drawn == edges


def test_a_profile_is_pressed_above_and_pulled_below_zero():
    state = rc.adhesive_state(BALL, 1e9, STRONG, depth=5e-9)
    axes = rc.plot.tension_profile(state, Figure().subplots())
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("r [nm]", "pressure, tension negative [MPa]")
    assert state.pressure.min() < 0 < state.pressure.max()
    pressed, pulled = (stairs.get_data() for stairs in axes.patches)
    np.testing.assert_allclose(pressed.values, np.maximum(state.pressure, 0) / 1e6)
    np.testing.assert_allclose(pulled.values, np.minimum(state.pressure, 0) / 1e6)
    np.testing.assert_allclose(pressed.edges, RINGS.edges * NM)
    [bars] = [each for each in axes.collections if isinstance(each, LineCollection)]
    touched = np.flatnonzero(state.contact)
    ends = np.array([segment[:, 0] for segment in bars.get_segments()])
    np.testing.assert_allclose(ends, np.stack([RINGS.edges[touched], RINGS.edges[touched + 1]], 1) * NM)


def test_of_cells_that_share_a_pixel_the_largest_is_shown_pressure_or_tension():
    """Blocks of two rows by one column, on a map of 1500 rows."""
    grid = rc.Grid((1500, 4), (1.0, 2.0), periodic=True)
    heights = np.zeros(grid.shape)
    heights[10, 1] = 1.0
    tower = rc.Surface(heights, grid)
    (state,) = rc.detachment_path(rc.press(tower, 1.0, depth=0.1), 1e-3, depths=[0.05])
    pressure = np.zeros(grid.shape)
    pressure[10, 1], pressure[11, 1] = 0.2, -0.3
    pressure[20, 2], pressure[21, 2] = 0.2, -0.1
    image = rc.plot.tension_map(replace(state, pressure=pressure), Figure().subplots()).images[0]
    drawn = np.asarray(image.get_array())
    assert drawn.shape == (750, 4)
    assert drawn[5, 1] == pytest.approx(-300)  # mPa
    assert drawn[10, 2] == pytest.approx(200)
    assert np.count_nonzero(drawn) == 2
    assert (image.norm.vmin, image.norm.vmax) == pytest.approx((-300, 200))


def test_missing_cells_are_left_out():
    surface = rough(16, periodic=False, slope=0.2, seed=1)
    heights = surface.heights.copy()
    heights[2:5, 3:9] = np.nan
    state = rc.adhesive_state(rc.Surface(heights, surface.grid), 1.0, sticky(2.0), depth=0.3)
    axes = rc.plot.tension_map(state, Figure().subplots())
    np.testing.assert_array_equal(np.ma.getmaskarray(axes.images[0].get_array()), np.isnan(heights))
    assert axes.patch.get_hatch()


def test_whole_figures_are_drawn(loop, state):
    on_rings = rc.adhesive_state(BALL, 1e9, STRONG, depth=0.0)
    for figure in (rc.plot.jump_figure(loop), rc.plot.state_figure(state), rc.plot.state_figure(on_rings)):
        figure.canvas.draw()
    force, area = rc.plot.jump_figure(loop).axes
    assert (force.get_ylabel(), area.get_ylabel()) == ("force [µN]", "relative real contact area A/A0 [%]")
    for each, unresolved in ((state, ""), (on_rings, " (unresolved)")):
        loads = f"force {written(each.force, 'N')},  depth {written(each.depth, 'm')}"
        answers = f"contact {100 * each.contact_fraction:.3g} %,  stability {each.stability:.2f}"
        assert rc.plot.state_figure(each).axes[0].get_title() == f"{loads},  {answers}{unresolved}"


def test_a_state_without_contact_is_drawn():
    apart = rc.adhesive_state(rough(16, periodic=True, slope=0.2, seed=1), 1.0, sticky(2.0), depth=-2.0)
    assert not apart.contact.any()
    rc.plot.state_figure(apart).canvas.draw()


def test_facts_name_the_jumps_that_lost_most(loop):
    many = loop.jumps * 5
    lines = jump_facts(many, loop.geometry)
    assert lines[0][0] == f"{len(many)} jumps"
    assert lines[-1][1] == f"{len(many) - 12} that lost less"
    assert jump_facts((), loop.geometry) == [("jumps", "none")]
    facts = dict(adhesive_curve_facts(loop))
    depth = written(loop.lowest_force_depth[loop.pull_off_point], "m", digits=4)
    force = written(loop.pull_off_force, "N", digits=4)
    assert facts["pull-off force"] == f"{force} in tension at a depth of {depth}"


def test_the_sign_of_a_tension_is_told_in_words(loop):
    assert loop.jump_in_force == -loop.jumps[0].force_before > 0
    facts = dict(adhesive_curve_facts(loop))
    assert facts["jump-in force"] == f"{written(loop.jump_in_force, 'N', digits=4)} in tension"
    pressed = replace(loop, jumps=(replace(loop.jumps[0], force_before=2e-9), *loop.jumps[1:]))
    assert dict(adhesive_curve_facts(pressed))["jump-in force"] == "2 nN in compression"
    none = replace(loop, jumps=tuple(jump for jump in loop.jumps if not jump.approach))
    assert "jump-in force" not in dict(adhesive_curve_facts(none))


def test_a_detachment_is_drawn_through_its_events():
    """Two units, and a line on which the force falls between events and rises at them."""
    pressed = rc.press(BALL, 1e9, depth=20e-9)
    curve = rc.detachment_curve(pressed, 0.1, depths=[20e-9, 5e-9, -80e-9])
    axes = curve.plot(Figure().subplots())
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("depth [nm]", "force [µN]")
    _, line, marks = (each.get_xydata() for each in axes.lines)
    np.testing.assert_allclose(marks, np.stack([curve.depth * NM, curve.force * UN], 1))
    events = curve.detachments
    assert len(line) == 2 * len(events) + len(curve)
    for event in events:
        before = (event.depth * NM, event.force_before * UN)
        at = int(np.argmin(np.abs(line - before).sum(axis=1)))
        np.testing.assert_allclose(line[at], before)
        np.testing.assert_allclose(line[at + 1], (event.depth_after * NM, event.force_after * UN))
    assert (
        axes.get_title() == f"pull-off force {written(curve.pull_off_force, 'N')}, {len(events)} detachments"
    )
    held = rc.detachment_curve(pressed, 0.1, depths=[5e-9])
    assert "largest tension" in held.plot(Figure().subplots()).get_title()
    small = rc.detachment_curve(rc.press(BALL, 1e9, depth=1e-9), 0.1)
    assert "(preload too small)" in small.plot(Figure().subplots()).get_title()


def test_a_body_that_a_force_pulls_off_leaves_the_line():
    curve = rc.detachment_curve(rc.press(BALL, 1e9, force=1e-6), 0.1, forces=[0.0, -1e-3])
    assert np.isneginf(curve.depth[-1])
    assert all(np.isfinite(line.get_xydata()).all() for line in curve.plot(Figure().subplots()).lines[:2])


def test_the_map_of_stuck_cells_is_theirs():
    surface = rc.Surface(rough(24, periodic=False, slope=0.2, seed=0).heights[:16], rc.Grid((16, 24), 1.0))
    (state,) = rc.detachment_path(rc.press(surface, 1.0, depth=0.5), 0.01, depths=[0.0])
    axes = state.plot(Figure().subplots())
    image = np.asarray(axes.images[0].get_array())
    np.testing.assert_allclose(image, state.pressure * 1e3)  # in mPa
    (edges,) = [each for each in axes.collections if isinstance(each, LineCollection)]
    ringed = np.pad(state.contact, 1)
    count = sum(int((np.diff(ringed.astype(int), axis=axis) != 0).sum()) for axis in (0, 1))
    assert len(edges.get_segments()) == count > 0
    figure = rc.plot.state_figure(state)
    assert tuple(figure.get_size_inches()) == pytest.approx(
        (6.2, 1.2 + 3.6 * 16 / 24)
    )  # as wide as any, lower
    title = figure.axes[0].get_title()
    assert "stability" not in title
    assert written(state.force, "N") in title
