"""The numbers of stuck surfaces that are drawn back: states, curves, datasets and records, and the certificate."""

import json

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.detachment import StuckContact, mean_compliance
from roughcontact.adhesion.detachment_path import _residual
from roughcontact.contact.press import solve
from sticking import rough

WORK = 0.01
# Cells of area one that are not square, on a map that is not square.
GRID = rc.Grid((12, 16), (2.0, 0.5), True)
SURFACE = rc.Surface(rough(16, periodic=True, slope=0.2, seed=0).heights[:12], GRID)
PRESSED = rc.press(SURFACE, 1.0, depth=0.4)


@pytest.fixture(scope="module")
def states():
    return list(rc.detachment_path(PRESSED, WORK, depths=[0.3, 0.0, -5.0]))


@pytest.fixture(scope="module")
def curve():
    return rc.detachment_curve(PRESSED, WORK, depths=[0.3, 0.0, -5.0])


def test_the_numbers_of_a_state_are_sums_over_its_cells(states):
    assert min(state.pressure.min() for state in states) < 0
    for state in states:
        p, u, contact = state.pressure, state.displacement, state.contact
        np.testing.assert_allclose(u, rc.half_space(GRID, 1.0).apply(p), atol=1e-12)
        np.testing.assert_allclose(state.gap, u + PRESSED.problem.separation - state.depth, atol=1e-12)
        assert np.abs(state.gap[contact]).max(initial=0.0) <= 1e-9
        assert state.force == pytest.approx(p.sum(), abs=1e-12)
        assert state.nominal_pressure == pytest.approx(p.sum() / GRID.area, abs=1e-14)
        assert (state.max_pressure, state.max_tension) == (p.max(), max(0.0, -p.min()))
        assert state.contact_fraction == contact.mean()
        assert state.contact_area == contact.sum()
        assert state.mean_gap == pytest.approx(state.gap.mean(), rel=1e-12)
        assert state.elastic_energy == pytest.approx(0.5 * (p * u).sum(), abs=1e-12)
        assert state.adhesive_energy == pytest.approx(-WORK * contact.sum(), abs=1e-15)
        assert state.energy == pytest.approx(state.elastic_energy + state.adhesive_energy, abs=1e-15)


def test_a_curve_becomes_a_dataset_and_a_record(curve, states):
    dataset, record = curve.to_dataset(), json.loads(json.dumps(curve.to_record()))
    for name in (
        "depth",
        "force",
        "contact_area",
        "nominal_pressure",
        "mean_gap",
        "elastic_energy",
        "energy",
    ):
        np.testing.assert_array_equal(dataset[name], getattr(curve, name))
        assert dataset[name].dims == ("load",)
        assert record[name] == getattr(curve, name).tolist()
    np.testing.assert_allclose(curve.nominal_pressure, [state.nominal_pressure for state in states])
    for data in (dataset, record):
        assert float(data["lost_energy"]) == curve.lost
        assert float(data["work_of_adhesion"]) == WORK
        found = [float(depth) for depth in data["detachment_depth"]]
        assert found == [event.depth for event in curve.detachments]
    assert (dataset.attrs["control"], dataset.attrs["tolerance"]) == ("depth", curve.tolerance)
    assert (record["control"], record["notes"]) == ("depth", list(curve.notes))
    assert len(curve) == 3
    assert repr(curve).startswith(f"DetachmentCurve(3 points, {len(curve.detachments)} detachments")


def test_a_state_becomes_a_dataset_and_a_record_with_the_heights_if_it_has_any(states):
    state = states[1]
    dataset, record = state.to_dataset(), json.loads(json.dumps(state.to_record()))
    np.testing.assert_array_equal(dataset["heights"], SURFACE.heights)
    for name in ("pressure", "gap", "displacement", "contact"):
        np.testing.assert_array_equal(dataset[name], getattr(state, name))
        assert dataset[name].dims == ("y", "x")
    for name in ("force", "depth", "mean_gap", "contact_area", "energy", "max_tension", "pull_off_force"):
        assert float(dataset[name]) == record[name] == getattr(state, name)
    for data in (dataset, record):
        assert float(data["lost_energy"]) == state.lost
        assert len(data["detachment_depth"]) == len(state.detachments) > 0
    assert record["rms"] == float(dataset["rms"]) == SURFACE.rms
    gap = SURFACE.heights.max() - SURFACE.heights
    problem = rc.ContactProblem(gap, rc.half_space(GRID, 1.0), rc.Depth(0.4))
    (bare,) = rc.detachment_path(solve(problem), WORK, depths=[0.3])
    assert "heights" not in bare.to_dataset()
    assert "rms" not in bare.to_record()


def test_each_cell_may_have_its_own_work_of_adhesion():
    surface = rough(16, periodic=False, slope=0.2, seed=0)
    pressed = rc.press(surface, 1.0, depth=0.4)
    even, same = (rc.detachment_curve(pressed, work) for work in (0.01, np.full((16, 16), 0.01)))
    np.testing.assert_array_equal(same.depth, even.depth)
    np.testing.assert_array_equal(same.energy, even.energy)
    weak = np.where(np.arange(16) < 8, 1e-6, 0.01) * np.ones((16, 1))
    problem = pressed.problem
    few = (problem.operator, problem.separation, pressed.contact, np.full((16, 16), 1e-6))
    most = StuckContact(*few, mean_compliance(surface.grid, 1.0)).strength
    tensions = [-state.pressure for state in rc.detachment_path(pressed, weak, depths=[0.3, 0.1, 0.0])]
    assert all(tension[:, :8].max() <= most * (1 + 1e-9) for tension in tensions)
    assert max(tension[:, 8:].max() for tension in tensions) > 10 * most


@pytest.mark.parametrize("side", [1e-3, 30.0])
def test_the_certificate_holds_an_error_of_the_force(side):
    """Relative to the forces on the cells, whatever their area."""
    surface = rc.Surface(rough(16, periodic=False, slope=0.2, seed=0).heights * side, rc.Grid((16, 16), side))
    pressed = rc.press(surface, 1.0, depth=0.4 * side)
    problem, work = pressed.problem, np.full((16, 16), 0.01 * side)
    stuck = StuckContact(problem.operator, problem.separation, pressed.contact, work, None)
    depth = stuck.depth(0.0)
    pressure, _ = stuck.pressure(depth)
    forces = np.abs(pressure).sum() * side**2
    for wrong in (0.1 * forces, -0.2 * forces):
        found = _residual(problem, stuck, pressure, depth, wrong)
        assert found == pytest.approx(abs(wrong) / forces, rel=1e-6)
    assert _residual(problem, stuck, pressure, depth, 0.0) <= 1e-9
