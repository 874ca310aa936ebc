"""Events of long tasks: in order, monotone, whole, and none without a listener."""

import threading
from itertools import groupby, islice

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.adhesive_loop import adhesive_loop
from roughcontact.contact.loads.load_outlook import load_outlook
from roughcontact.progress import events
from roughcontact.progress.events import decades, listening, task, tracked
from roughcontact.solver.loads import Loads

MODULUS = 1e9
GRID = rc.Grid((48, 48), 1e-6)
BALL = rc.shapes.paraboloid(GRID, radius=1e-4)
PERIODIC = rc.Grid((32, 32), 1e-6, periodic=True)
RUBBER = rc.Solid(7.5e8, 0.5)  # against a rigid body: 1 GPa
ADHESION = rc.Adhesion(0.1, 100e-9)
CASE = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}


def heard(work, **given):
    found = []
    with listening(found.append, **given):
        work()
    return found


def rough(rng=1):
    return rc.self_affine(PERIODIC, hurst=0.8, rms=1e-6, rng=np.random.default_rng(rng))


def pressed(**given):
    return rc.press(BALL, MODULUS, force=1e-3, **given)


def stuck():
    ball = rc.shapes.paraboloid(rc.Grid((16, 16), 2e-6), radius=1e-4)
    return rc.press(ball, MODULUS, force=1e-3)


def few(tmp_path, executor=None):
    study = rc.study.Study(name="few", case="curve", samples=2, parameters=CASE)
    return rc.study.run(study, tmp_path / "few", executor)


TASKS = {  # what is done, and the tasks that count in it: how many, and of what
    "press": (pressed, [(8.0, "decades of the residual")]),
    "projected": (lambda: pressed(solver=rc.PolonskyKeer()), [(8.0, "decades of the residual")]),
    "path": (lambda: list(rc.loading_path(BALL, MODULUS, forces=[1e-3, 2e-3])), [(2, "loads")]),
    "curve": (lambda: rc.loading_curve(BALL, MODULUS, depths=[1e-7, 2e-7, 3e-7]), [(3, "loads")]),
    "loop": (lambda: rc.loading_loop(BALL, 1e11, hardness=2e9, forces=[0.1, 0.2]), [(6, "loads")]),
    "adhesive path": (
        lambda: list(rc.adhesive_path(BALL, MODULUS, ADHESION, depths=[0.0, 1e-7, 0.0])),
        [(3, "loads"), (100, "%")],
    ),
    "adhesive curve": (
        lambda: rc.adhesive_curve(BALL, MODULUS, ADHESION, depths=[0.0, 1e-7]),
        [(2, "loads")],
    ),
    "detachment": (lambda: list(rc.detachment_path(stuck(), 0.05)), [(16, "cells")]),
    "detachment by loads": (
        lambda: list(rc.detachment_path(stuck(), 0.05, depths=[0.0, -1e-6])),
        [(2, "loads"), (None, "cells")],
    ),
    "sliding": (
        lambda: list(rc.slide_path(pressed(), RUBBER, friction=0.5, forces=[1e-4, 2e-4])),
        [(2, "loads")],
    ),
    "errors": (
        lambda: rc.error_budget(rc.press(rough(), MODULUS, pressure=3e7)),  # 17 spots
        [(2, "maps"), (4, "quarters")],
    ),
    "stress": (lambda: rc.largest_von_mises(pressed(), 0.3), [(None, "depths")]),
    "waves": (rough, [(1, "blocks")]),
    "midpoint": (
        lambda: rc.midpoint_surface(rc.Grid((17, 17), 1e-6), hurst=0.8, rng=1, rms=1e-6),
        [(4, "levels")],
    ),
}


def by_task(found):
    return [
        list(each)
        for _, each in groupby(sorted(found, key=lambda event: event.number), key=lambda e: e.number)
    ]


@pytest.mark.parametrize("name", TASKS)
def test_each_task_begins_rises_and_ends_whole(name):
    work, counted = TASKS[name]
    tasks = by_task(heard(work))
    for each in tasks:
        first, *running, last = each
        assert (first.state, {event.state for event in running} - {"running"}, last.state) == (
            "started",
            set(),
            "finished",
        )
        done = [event.done for event in each]
        assert done == sorted(done)
        assert last.total is None or last.done == last.total
    ends = {(each[-1].total, each[-1].unit) for each in tasks}
    for total, unit in counted:
        assert (total, unit) in ends or (total is None and unit in {unit for _, unit in ends})


@pytest.mark.parametrize(
    ("work", "words"),
    [
        (lambda: rc.load_range(BALL, MODULUS), "Finding the loads that suit the surface"),
        (
            lambda: load_outlook(BALL, MODULUS, Loads("force", [1e-6, 1e-3])),
            "Finding which of these loads the grid resolves",
        ),
        (lambda: rc.contact_stiffness(BALL.heights > -1e-6, GRID, MODULUS), "Stiffness of 48 x 48 cells"),
        (lambda: rc.press(BALL, MODULUS, force=1e-3), "Pressing 48 x 48 cells"),
        (lambda: rc.adhesive_state(BALL, MODULUS, ADHESION, depth=0.0), "Pressing 48 x 48 cells"),
        (lambda: rc.detachment_path(pressed(), 0.1), "Inverting the influence matrix of 60 cells"),
    ],
)
def test_what_counts_nothing_is_named(work, words):
    found = heard(work)
    assert words in {event.task for event in found if event.level == 0}
    assert {each[-1].state for each in by_task(found)} == {"finished"}


def test_a_loop_of_adhesion_ends_whole_where_its_body_is_off():
    found = heard(lambda: adhesive_loop(BALL, MODULUS, ADHESION, depth=1e-7, points=4))
    loop = [event for event in found if event.unit == "states"]
    assert loop[-1].state == "finished"
    assert loop[-1].total is None
    assert loop[-1].done > 5  # the approach, and some of the retreat


def test_a_file_is_named(tmp_path):
    rc.write(BALL, tmp_path / "ball.npz")
    found = heard(lambda: rc.read(tmp_path / "ball.npz"))
    assert [(event.task, event.state) for event in found] == [
        ("Reading ball.npz", "started"),
        ("Reading ball.npz", "finished"),
    ]


@pytest.mark.parametrize("executor", [rc.study.Serial(), rc.study.Processes(1)])
def test_a_study_reports_its_cases_and_workers_report_nothing(tmp_path, executor):
    found = heard(lambda: few(tmp_path, executor))
    cases = [event for event in found if event.unit == "cases"]
    assert [(event.state, event.done, event.total) for event in cases] == [
        ("started", 0, 2),
        ("running", 1, 2),
        ("running", 2, 2),
        ("finished", 2, 2),
    ]
    inside = {event.level for event in found} - {0}
    assert bool(inside) is isinstance(executor, rc.study.Serial)
    assert [event.done for event in heard(lambda: few(tmp_path))] == [2, 2]


def test_a_tolerance_that_is_missed_is_seen():
    found = []
    with listening(found.append), pytest.raises(rc.ConvergenceError):
        rc.press(BALL, MODULUS, force=1e-3, solver=rc.PolonskyKeer(max_steps=3))
    solve = [event for event in found if event.unit][-1]
    assert solve.done < solve.total == 8
    assert solve.state == "finished"


@pytest.mark.parametrize("ended", [ValueError, KeyboardInterrupt])
def test_an_error_ends_every_task_that_is_open(ended):
    found = []

    def fail(event):
        found.append(event)
        if event.unit == "decades of the residual" and event.done > 1:
            raise ended

    with listening(fail), pytest.raises(ended):
        rc.loading_curve(BALL, MODULUS, forces=[1e-3])
    assert [each[-1].state for each in by_task(found) if each[0].level == 0] == ["stopped"]


def test_a_path_that_is_left_is_stopped_and_one_that_is_taken_whole_is_not():
    states = {}
    for count in (1, 2):
        found = heard(
            lambda count=count: list(islice(rc.loading_path(BALL, MODULUS, forces=[1e-3, 2e-3]), count))
        )
        states[count] = [event.state for event in found if event.unit == "loads"][-1]
    assert states == {1: "stopped", 2: "finished"}


def test_nothing_is_told_when_the_block_has_ended():
    found = []
    with listening(found.append):
        path = rc.loading_path(BALL, MODULUS, forces=[1e-3, 2e-3])
        next(path)
    before = len(found)
    next(path)
    path.close()
    pressed()
    assert len(found) == before > 0


def test_nobody_listens_in_other_threads_nor_outside():
    found = []
    assert events._listener.get() is None
    with listening(found.append):
        other = threading.Thread(target=pressed)
        other.start()
        other.join()
    assert found == []
    with task("Trying") as here:
        assert here is None


def test_the_inner_of_two_listeners_is_told():
    outer, inner = [], []
    with listening(outer.append):
        with listening(inner.append):
            list(tracked("ab", "Spelling", "letters"))
        list(tracked("c", "Spelling", "letters"))
    assert (inner[-1].total, outer[-1].total) == (2, 1)


def test_an_interval_thins_out_and_leaves_out_what_is_short(monkeypatch):
    now = 0.0
    monkeypatch.setattr(events.time, "monotonic", lambda: now)

    def work():
        nonlocal now
        for _ in tracked(range(4), "Outside", "rounds"):
            now += 0.6
            with task("Short", 1, "steps") as short:
                short.advance()
            with task("Long", 2, "steps") as long:
                now += 1.0
                long.reached(1)
                long.reached(2)
                now += 0.4

    found = [(event.task, event.state, event.done) for event in heard(work, interval=1.0)]
    assert found[:6] == [
        ("Outside", "started", 0),
        ("Long", "started", 0),
        ("Long", "running", 1),
        ("Long", "finished", 2),
        ("Outside", "running", 2),
        ("Long", "started", 0),
    ]
    assert found[-1] == ("Outside", "finished", 4)
    assert "Short" not in {name for name, *_ in found}


def test_done_stays_between_what_it_was_and_the_total():
    found = []
    with listening(found.append), task("Trying", 3, "trials") as trying:
        for done in (2, 1, 5):
            trying.reached(done)
    assert [event.done for event in found] == [0, 2, 2, 3, 3]


@pytest.mark.parametrize(
    ("residual", "expected"), [(1e-8, 8.0), (3e-8, 7.5), (1.0, 0.0), (7.0, 0.0), (0.0, np.inf), (np.nan, 0.0)]
)
def test_decades_of_a_residual(residual, expected):
    assert decades(residual) == expected
