"""Many surfaces pressed one by one: as `press` does, in their order, whoever computes them."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.study import press_many as module
from roughcontact.study.executors.worker import WorkersError

GRID, LINE = rc.Grid((12, 16), 1e-6), rc.Grid((24,), 1e-6)
ROUGH = [rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(k)) for k in range(5)]
FORCE = 1e-3
LOADS = ({"depth": 1e-7}, {"force": FORCE}, {"pressure": 1e6})


class Backwards:
    """An executor that is done with the last part first."""

    workers = 1

    def __str__(self):
        return "backwards"

    def results(self, run_task, tasks):
        yield from map(run_task, reversed(list(tasks)))


@pytest.fixture(autouse=True)
def two_a_part(monkeypatch):
    monkeypatch.setattr(module, "CELLS", 2 * GRID.size)


def assert_same(found, expected):
    np.testing.assert_array_equal(found.pressure, expected.pressure)
    assert not found.pressure.flags.writeable
    for name in ("depth", "residual", "steps", "status", "force", "stiffness"):
        assert getattr(found, name) == getattr(expected, name)
    assert found.problem.surface is expected.problem.surface


@pytest.mark.parametrize(
    ("executor", "load"),
    [
        *((executor, load) for executor in (None, Backwards()) for load in LOADS),
        # Workers take a load as it is, and are slow to start.
        (rc.study.Processes(2), LOADS[0]),
    ],
    ids=str,
)
def test_each_is_as_if_pressed_alone(executor, load):
    given = {"modulus": 110e9, "tolerance": 1e-9, "hardness": 3e9, **load}
    solutions = list(rc.press_many(ROUGH, executor=executor, **given))
    assert len(solutions) == len(ROUGH)
    for surface, solution in zip(ROUGH, solutions, strict=True):
        assert_same(solution, rc.press(surface, **given))


def test_a_hardness_that_follows_from_spots_is_kept():
    law = rc.NixGao(2e9, 1e-6)
    for surface, solution in zip(ROUGH, rc.press_many(ROUGH, 110e9, force=FORCE, hardness=law), strict=True):
        expected = rc.press(surface, 110e9, force=FORCE, hardness=law)
        np.testing.assert_array_equal(solution.problem.hardness, expected.problem.hardness)
        np.testing.assert_array_equal(solution.pressure, expected.pressure)


def test_a_body_of_ones_own_takes_lines():
    lines = [rc.Surface(1e-7 * np.random.default_rng(k).random(24), LINE) for k in range(3)]
    body = rc.line(LINE, 1e9)
    for line, solution in zip(lines, rc.press_many(lines, 1e9, force=1.0, operator=body), strict=True):
        np.testing.assert_array_equal(
            solution.pressure, rc.press(line, 1e9, force=1.0, operator=body).pressure
        )


def test_surfaces_are_taken_when_their_turn_comes():
    taken = []

    def surfaces():
        for number, surface in enumerate(ROUGH):
            taken.append(number)
            yield surface

    solutions = rc.press_many(surfaces(), 110e9, force=FORCE, executor=rc.study.Serial())
    assert taken == []
    next(solutions)
    assert taken == [0, 1]
    solutions.close()
    assert taken == [0, 1]


def test_an_error_names_the_surface_and_those_before_are_there():
    solutions = rc.press_many([*ROUGH[:3], "rough", ROUGH[4]], 110e9, force=FORCE, executor=rc.study.Serial())
    assert len([next(solutions) for _ in range(3)]) == 3
    with pytest.raises(ValueError, match="not 'rough'") as caught:
        next(solutions)
    assert caught.value.__notes__ == ["This is surface number 3, counted from 0."]


def test_a_missed_tolerance_carries_its_solution():
    """From a worker, too."""
    solver, workers = rc.PolonskyKeer(max_steps=2), rc.study.Processes(1)
    solutions = rc.press_many(ROUGH, 110e9, depth=1e-7, solver=solver, tolerance=1e-12, executor=workers)
    with pytest.raises(rc.ConvergenceError) as caught:
        next(solutions)
    assert not caught.value.solution.status.converged
    np.testing.assert_array_equal(caught.value.solution.problem.surface.heights, ROUGH[0].heights)


def test_two_loads_are_refused_at_the_call():
    with pytest.raises(ValueError, match="exactly one of force, depth and pressure"):
        rc.press_many(ROUGH, 110e9, force=FORCE, depth=1e-7)


def test_workers_that_die_are_an_error():
    class Dead:
        workers = 1

        def results(self, run_task, tasks):
            first, second, *_ = tasks
            yield run_task(first)
            yield rc.study.Result(second.key, None, "its worker died", 0.0)

    solutions = rc.press_many(ROUGH, 110e9, force=FORCE, executor=Dead())
    assert len([next(solutions) for _ in range(2)]) == 2
    with pytest.raises(WorkersError, match=r"surfaces from number 2 on were not pressed: its worker died"):
        next(solutions)


@pytest.mark.parametrize(("few", "expected"), [(5 * GRID.size, "Serial"), (5 * GRID.size - 1, "Processes")])
def test_few_cells_are_pressed_in_this_process(monkeypatch, few, expected):
    chosen = []
    monkeypatch.setattr(module, "FEW", few)
    for name in ("Serial", "Processes"):
        monkeypatch.setattr(module, name, lambda name=name: chosen.append(name) or Backwards())
    list(rc.press_many(ROUGH, 110e9, force=FORCE))
    list(rc.press_many(iter(ROUGH), 110e9, force=FORCE))  # of a generator nobody has counted the cells
    assert chosen == [expected, "Processes"]
