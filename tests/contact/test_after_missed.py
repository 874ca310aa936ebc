"""After a load that missed its tolerance: the loads that follow start afresh, and each says what is true of itself."""

from dataclasses import dataclass, field

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.notes.solution_notes import BEYOND

MODULUS, HARDNESS = 2.0, 0.1
FORCES = (0.002, 0.005, 0.01, 0.02)
MISSED = 0.01


@dataclass(frozen=True)
class OutOfSteps:
    """A solver that runs out of steps under one force, and keeps where each solve began."""

    missed: float = MISSED
    starts: dict = field(default_factory=dict)

    def run(self, operator, separation, spec, initial):
        load = round(spec.control.value, 12)
        self.starts.setdefault(load, []).append(np.array(initial).ravel())
        method = rc.PolonskyKeer(max_steps=3) if load == self.missed else rc.ActiveSet()
        return method.run(operator, separation, spec, initial)


def plane():
    grid = rc.Grid((24, 20), (0.05, 0.06))
    return rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(3))


def found(forces, missed=MISSED, **given):
    solver = OutOfSteps(missed)
    path = list(rc.loading_path(plane(), MODULUS, forces=forces, solver=solver, **given))
    return path, solver.starts


def statuses(path):
    return [solution.status for solution in path]


@pytest.mark.parametrize("given", [{}, {"hardness": HARDNESS}], ids=["elastic", "plastic"])
def test_the_load_after_a_missed_one_starts_as_a_load_of_its_own(given):
    after, starts = found(FORCES, **given)
    assert statuses(after) == [rc.Status.CONVERGED] * 2 + [rc.Status.MAX_STEPS, rc.Status.CONVERGED]
    assert after[2].residual > 1e-8 > after[3].residual
    alone, afresh = found(FORCES[-1:], **given)
    np.testing.assert_array_equal(starts[FORCES[-1]][0], afresh[FORCES[-1]][0])
    warm, predicted = found(FORCES, missed=None, **given)
    assert statuses(warm) == [rc.Status.CONVERGED] * 4
    assert not np.array_equal(predicted[FORCES[-1]][0], afresh[FORCES[-1]][0])  # from the load before
    for one in (after[3], warm[3]):
        assert one.depth == pytest.approx(alone[0].depth, rel=1e-8)
        assert one.stiffness == pytest.approx(alone[0].stiffness, rel=1e-8)
    curve = rc.loading_curve(plane(), MODULUS, forces=FORCES, solver=OutOfSteps(), **given)
    assert [status.converged for status in curve.status] == [True, True, False, True]


def test_loads_below_a_missed_one_say_that_their_surface_is_not_known():
    """What flowed under the missed load is kept until a larger load follows, which does not depend on it."""
    path, _ = found((0.005, MISSED, 0.006, 0.002, 0.02, 0.006), hardness=HARDNESS)
    assert statuses(path) == [
        rc.Status.CONVERGED,
        rc.Status.MAX_STEPS,
        rc.Status.AFTER_MISSED,
        rc.Status.AFTER_MISSED,
        rc.Status.CONVERGED,
        rc.Status.CONVERGED,
    ]
    assert max(one.residual for one in path[2:4]) < 1e-8  # on the surface that the missed load left
    assert path[3].flow is path[2].flow is not path[5].flow
    assert "larger load" in path[2].notes[0]
    clean, _ = found((0.02, 0.006), hardness=HARDNESS)
    assert path[5].depth == pytest.approx(clean[1].depth, rel=1e-7)


def test_a_missed_load_on_unloading_is_no_matter_of_those_after_it():
    path, _ = found((0.02, MISSED, 0.005, 0.006), hardness=HARDNESS)
    assert [status.converged for status in statuses(path)] == [True, False, True, True]
    clean, _ = found((0.02, 0.005), hardness=HARDNESS)
    assert path[2].depth == pytest.approx(clean[1].depth, rel=1e-7)
    assert path[2].pressure == pytest.approx(clean[1].pressure, abs=1e-7 * HARDNESS)


@pytest.mark.parametrize("flow", ["removed", "raised"])
def test_every_branch_of_a_loop_says_what_is_true_of_it(flow):
    given = {"hardness": HARDNESS, "flow": flow}
    whole = rc.loading_loop(plane(), MODULUS, forces=FORCES, solver=OutOfSteps(), **given)
    assert [status.converged for status in whole.loading.status] == [True, True, False, True]
    assert [status.converged for status in whole.unloading.status] == [True, False, True, True]
    assert [status.converged for status in whole.reloading.status] == [True, True, False, True]
    turn = rc.loading_loop(plane(), MODULUS, forces=FORCES[:3], solver=OutOfSteps(), **given)
    words = [status.value for status in turn.loading.status + turn.unloading.status]
    assert words == ["converged"] * 2 + ["step limit"] * 2 + ["after a missed load"] * 2
    assert not turn.converged
    assert not turn.unloading.resolved.any()
    assert rc.loading_loop(plane(), MODULUS, forces=FORCES, **given).converged


def test_a_pressure_beyond_the_hardness_on_unloading_is_said():
    """What flowed under a load that was missed is not known well enough for the surface to be elastic below it."""
    unloaded = (MISSED, 0.99 * MISSED)
    for missed, beyond in ((MISSED, True), (None, False)):
        (_, state), _ = found(unloaded, missed=missed, hardness=HARDNESS)
        assert bool(state.pressure.max() > (1 + BEYOND) * HARDNESS) is beyond
        notes = [note for note in state.notes if "of it: unloading is not quite elastic" in note]
        assert len(notes) == beyond
        if beyond:
            assert f"exceeds the hardness by {state.pressure.max() / HARDNESS - 1:.1e} of it" in notes[0]
