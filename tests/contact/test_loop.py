"""A whole loop of loads: its branches, its balance of energy, and what it says of itself."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.contact.loop_dataset import unloaded
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import FLOW
from roughcontact.labels.engineering_units import written
from roughcontact.plot.facts import loop_facts

MODULUS, HARDNESS = 2.0, 0.1
FORCES = np.linspace(0.0, 0.02, 6)[1:]


def plane(periodic=True):
    grid = rc.Grid((24, 20), (0.05, 0.06), periodic)
    return rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(3))


def made(flow="removed", **given):
    given = {"forces": FORCES, "tolerance": 1e-10} | given
    return rc.loading_loop(plane(), MODULUS, hardness=HARDNESS, flow=flow, **given)


@pytest.fixture(scope="module", params=["removed", "raised"])
def loop(request):
    return made(request.param)


def test_its_branches_are_those_of_the_path(loop):
    flow = "raised" if loop.flow.rise else "removed"
    loads = [*FORCES, *FORCES[::-1], *FORCES]
    given = {"hardness": HARDNESS, "flow": flow, "tolerance": 1e-10}
    curve = rc.loading_curve(plane(), MODULUS, forces=loads, **given)
    for name in ("force", "depth", "stiffness", "mean_gap"):
        branches = np.concatenate([getattr(each, name) for each in loop.curves.values()])
        np.testing.assert_array_equal(branches, getattr(curve, name))
    assert loop.converged
    assert curve.hardness == loop.loading.hardness == HARDNESS
    assert loop.unloading.hardness == np.inf


def test_its_notes_are_those_of_first_loading():
    rough = rc.self_affine(rc.Grid((48, 48), 1e-6, periodic=True), 0.8, 3e-7, rng=np.random.default_rng(0))
    loop = rc.loading_loop(rough, 1e11, hardness=5e9)
    (note,) = loop.unloading.doubts  # of its power law, which unloading does not follow
    assert loop.loading.doubts == ()
    (plastic,) = loop.notes
    assert "are at the hardness" in plastic
    assert note not in loop._repr_html_()
    doubtful = replace(loop, loading=loop.unloading)
    assert doubtful.notes == (note,)
    assert note in doubtful._repr_html_()


def test_unloading_and_reloading_are_one_and_the_curve_closes(loop):
    for name in ("depth", "stiffness", "contact_area", "mean_gap", "elastic_energy"):
        down, up = getattr(loop.unloading, name)[::-1], getattr(loop.reloading, name)
        np.testing.assert_allclose(up, down, rtol=1e-8)
    assert loop.unloading.depth[0] == pytest.approx(loop.loading.depth[-1], rel=1e-9)
    assert loop.loading.depth[-1] > loop.unloading.depth[-1] > loop.residual_depth > 0
    flow = loop.loading.flow
    assert flow.unloading_stiffness[-1] == pytest.approx(loop.unloading.stiffness[0], rel=1e-9)
    assert (flow.unloading_stiffness >= loop.loading.stiffness).all()
    assert (loop.unloading.flow.plastic_area == 0).all()
    np.testing.assert_array_equal(loop.reloading.flow.flow_volume, loop.flow.volume)


def test_the_secant_of_unloading_is_that_of_reloading(loop):
    up, down = loop.reloading.secant_stiffness, loop.unloading.secant_stiffness[::-1]
    np.testing.assert_allclose(down, up, rtol=1e-6)
    # The force is convex in the depth: between the tangents at both ends.
    assert (loop.reloading.stiffness[:-1] <= up).all()
    assert (up <= loop.reloading.stiffness[1:]).all()


def test_the_residual_state_is_that_of_the_flattened_surface(loop):
    down = loop.surface.heights.max() - loop.flattened.heights.max()
    assert loop.residual_depth == pytest.approx(down, rel=1e-12)
    gap = loop.flattened.heights.max() - loop.flattened.heights.mean()
    assert loop.residual_gap == pytest.approx(gap, rel=1e-12)
    assert loop.flattened.provenance[-1].startswith("flattened by up to")
    elastic = rc.loading_curve(loop.flattened, MODULUS, forces=FORCES, tolerance=1e-10)
    np.testing.assert_allclose(elastic.depth + loop.residual_depth, loop.reloading.depth, rtol=1e-8)
    np.testing.assert_allclose(elastic.stiffness, loop.reloading.stiffness, rtol=1e-8)


def test_the_area_of_the_loop_is_what_is_dissipated(loop):
    """Chords of a convex branch lie above it, of second order in their length: twice as many make a quarter."""

    def missed(count):
        # Dense where the depth grows like a low power of the force.
        forces = FORCES[-1] * np.linspace(0.0, 1.0, count + 1)[1:] ** 3
        fine = made("raised" if loop.flow.rise else "removed", forces=forces)
        up, back = (
            np.trapezoid(np.append(0.0, curve.force), np.append(start, curve.depth))
            for curve, start in ((fine.loading, 0.0), (fine.reloading, fine.residual_depth))
        )
        assert fine.work - fine.dissipated_work == pytest.approx(fine.loading.elastic_energy[-1])
        return abs(up - back - fine.dissipated_work) / fine.dissipated_work

    coarse, fine = missed(10), missed(40)
    assert fine < coarse / 8  # a sixteenth, but for the changes of single cells
    assert fine < 2e-3


def test_a_rise_is_lifted_by_the_force():
    plain, raised = made("removed"), made("raised")
    assert plain.dissipated_work == plain.flow.energy
    assert raised.dissipated_work == raised.flow.energy == raised.loading.flow.flow_energy[-1]
    assert raised.dissipated_work < plain.dissipated_work
    assert raised.residual_depth == pytest.approx(plain.residual_depth - raised.flow.rise, rel=1e-7)


def test_it_has_converged_if_every_load_has(loop):
    assert loop.converged
    missed = made(solver=rc.PolonskyKeer(max_steps=3))
    assert not all(status.converged for status in missed.loading.status)
    assert not missed.converged


def test_a_rise_whose_work_the_loads_do_not_tell_leaves_the_energy_open():
    """Two loads far up: half of the force times the rise is more than a hundredth of the energy."""
    loop = made("raised", forces=0.5 * HARDNESS * plane().grid.area * np.array([0.5, 1.0]))
    assert np.isnan(
        [loop.flow.energy, loop.dissipated_work, loop.work, loop.unloading.flow.flow_energy[0]]
    ).all()
    assert loop.flow.volume > 0
    assert loop.to_record()["flow_energy"] is None
    json.dumps(loop.to_record(), allow_nan=False)
    state = next(rc.loading_path(plane(), MODULUS, forces=[0.02], hardness=HARDNESS, flow="raised"))
    assert [note for note in state.notes if "give more loads between zero and the largest" in note]
    *_, told = rc.loading_path(plane(), MODULUS, forces=FORCES, hardness=HARDNESS, flow="raised")
    assert not [note for note in told.notes if "give more loads" in note]
    assert told.flow.energy > 0


def test_it_is_data_with_units_and_text(loop, tmp_path):
    dataset = loop.to_dataset()
    assert dataset.sizes["load"] == 3 * len(FORCES)
    assert list(dataset.branch.values[:: len(FORCES)]) == ["loading", "unloading", "reloading"]
    for name in (*names_of(FLOW), "flow_depth", "residual_depth", "work", "force"):
        assert {"units", "long_name"} <= dataset[name].attrs.keys(), name
    np.testing.assert_array_equal(
        dataset.heights - dataset.flow_depth + dataset.flow_rise, loop.flattened.heights
    )
    rc.write(loop, tmp_path / "loop.nc")
    with xarray.open_dataset(tmp_path / "loop.nc") as back:
        np.testing.assert_array_equal(back.depth, dataset.depth)
    with pytest.warns(rc.SurfaceWarning, match="1.2 m x 1.2 m"):
        flat = rc.read(tmp_path / "loop.nc", channel="flattened_heights")
    np.testing.assert_array_equal(flat.heights, loop.flattened.heights)
    rc.write(loop, tmp_path / "loop.csv")
    lines = [line for line in (tmp_path / "loop.csv").read_text().splitlines() if not line.startswith("#")]
    assert len(lines) == 1 + 3 * len(FORCES)
    assert "branch" in lines[0]
    record = json.loads(json.dumps(loop.to_record(), allow_nan=False))
    assert record["residual_depth"] == loop.residual_depth
    assert record["units"]["flow_volume"] == "m3"
    assert record["loading"]["flow_energy"][-1] == loop.flow.energy
    assert "residual depth" in repr(loop)
    assert "residual depth" in loop._repr_html_()


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"forces": [2.0, 1.0]}, "must increase strictly"),
        ({"forces": [1e-3], "pressures": [1e-3]}, "exactly one of forces and pressures"),
        ({"hardness": None}, "needs a hardness"),
        ({"forces": []}, "at least one number"),
    ],
)
def test_what_makes_no_sense_is_refused(given, says):
    with pytest.raises(ValueError, match=says):
        rc.loading_loop(plane(), MODULUS, **{"hardness": HARDNESS, "forces": FORCES} | given)


@pytest.mark.slow
def test_without_loads_it_finds_some_that_suit_the_surface():
    grid = rc.Grid((40, 40), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=np.random.default_rng(1))
    for hardness in (5e9, np.full(grid.shape, 5e9), rc.NixGao(4e9, 1e-6)):
        loop = rc.loading_loop(surface, 1e11, hardness=hardness)
        assert loop.converged
        assert len(loop.loading) == 24
        assert 0 < loop.loading.flow.plastic_area[-1] < loop.loading.contact_area[-1]


def test_rings_and_lines_have_loops():
    rings = rc.RadialGrid.uniform(40, 1.0)
    ball = rc.RadialProfile(-(rings.radii**2) / 2, rings)
    grid = rc.Grid(80, 0.02)
    line = rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(5))
    for body, operator in ((ball, rc.ring(rings, MODULUS)), (line, rc.line(grid, MODULUS))):
        loop = rc.loading_loop(
            body, MODULUS, hardness=0.1, forces=[0.02, 0.05], operator=operator, flow="raised"
        )
        assert loop.flow.volume > 0
        assert loop.converged
        assert loop.to_dataset().flow_volume.attrs["units"] == ("m2" if body is line else "m3")


def test_the_points_of_unloading_stand_beside_those_of_loading(loop):
    table = unloaded(loop)
    for name in ("interfacial_stiffness_per_area", "stiffness", "mean_gap", "spots"):
        along, values, words = table[f"unloaded_{name}"]
        assert along == ("load",)
        np.testing.assert_array_equal(values[::-1], getattr(loop.unloading, name))
        assert words["long_name"].endswith(", on unloading")
    np.testing.assert_allclose(loop.unloading.force[::-1], loop.loading.force, rtol=1e-9)
    areal = table["unloaded_interfacial_stiffness_per_area"]
    assert areal[2]["units"] == "Pa m-1"
    assert (areal[1] > loop.loading.interfacial_stiffness_per_area).all()


def test_the_mean_gap_grows_at_the_turn_by_what_has_flowed(loop):
    """On first loading the gap of a cell that flows is minus the depth of its flow; then no gap is negative."""
    at_turn = loop.unloading.mean_gap[0] - loop.loading.mean_gap[-1]
    # Each gap is good to the tolerance, 1e-10 of the displacement, and the flow is a hundredth of that.
    assert at_turn == pytest.approx(loop.flow.volume / plane().grid.area, rel=1e-7)
    [words] = [text for name, text in loop_facts(loop) if name == "mean gap at the largest load"]
    gaps = [written(curve.mean_gap[k], "m", 4) for curve, k in ((loop.loading, -1), (loop.unloading, 0))]
    assert re.findall(r"([\d.]+ \S+) on", words) == gaps
