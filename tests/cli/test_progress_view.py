"""How far a command is: bars on a terminal, JSON lines, a line a minute in a log, or nothing."""

import io
import json
import os
import re
import subprocess
import sys
import time
from contextlib import redirect_stderr

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.cli import progress_view
from roughcontact.cli.progress_view import duration, progress_shown
from roughcontact.progress.events import Event, task, tracked

KEYS = {"type", *Event.__dataclass_fields__, "seconds"}


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def now(monkeypatch):
    """A clock that is moved by hand, for events and for what shows them."""
    clock = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: clock[0])
    return clock


@pytest.fixture
def terminal(monkeypatch):
    for name, value in {"TERM": "xterm", "COLUMNS": "120"}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.delenv("NO_COLOR", raising=False)
    return Terminal()


def plain(text):
    return re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", text)


def work():
    with task("Reading part.x3p"):
        pass
    for _ in tracked(range(3), "Pressing", "loads"):
        with task("Solving", 8.0, "decades of the residual") as solve:
            if solve is not None:
                solve.reached(3.2)


@pytest.mark.parametrize(("form", "shown"), [("auto", True), ("none", False), ("json", False)])
def test_a_terminal_shows_tasks_and_bars(terminal, form, shown):
    with redirect_stderr(terminal), progress_shown(form):
        work()
    text = plain(terminal.getvalue())
    assert ("Reading part.x3p ━" in text) is shown
    assert ("3 of 3 loads" in text) is shown
    assert ("\x1b" in terminal.getvalue()) is shown


def test_a_bar_shows_the_rate_the_time_left_and_tasks_inside(terminal, monkeypatch):
    bars = progress_view._Bars()
    clock = [0.0]
    monkeypatch.setattr(progress_view.time, "monotonic", lambda: clock[0])
    with redirect_stderr(terminal):
        try:
            bars(Event("tried", "started", 0, 4, "cases"))
            bars(Event("Solving", "started", 0, 8.0, "decades of the residual", number=2, level=1))
            clock[0] = 10.0
            bars(Event("Solving", "running", 3.2, 8.0, "decades of the residual", number=2, level=1))
            bars(Event("tried", "running", 1, 4, "cases", "1 failed"))
            bars.shown.refresh()
        finally:
            bars.stop()
    text = plain(terminal.getvalue())
    assert "1 of 4 cases, 1 failed, 6 a min, 30 s left" in text
    assert "  Solving" in text
    assert "3.2 of 8 decades of the residual, 19.2 a min, 15 s left" in text


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_an_error_inside_takes_the_bars_down(terminal, error):
    def fail():
        for _ in tracked(range(3), "Pressing", "loads"):
            raise error

    with redirect_stderr(terminal), pytest.raises(error), progress_shown("auto"):
        fail()
    assert terminal.getvalue().endswith("\x1b[?25h")  # the cursor is shown again
    before = terminal.getvalue()
    time.sleep(0.3)  # three times as long as from one picture to the next
    assert terminal.getvalue() == before


def test_json_lines_are_events(capsys):
    with progress_shown("json"):
        work()
    captured = capsys.readouterr()
    found = [json.loads(line) for line in captured.err.splitlines()]
    assert {frozenset(each) for each in found} == {frozenset(KEYS)}
    assert {each["type"] for each in found} == {"progress"}
    assert [(each["task"], each["state"], each["done"], each["total"]) for each in found] == [
        ("Reading part.x3p", "started", 0, None),
        ("Reading part.x3p", "finished", 0, None),
        ("Pressing", "started", 0, 3),
        ("Pressing", "finished", 3, 3),
    ]
    assert captured.out == ""


def test_a_log_has_a_line_a_minute_about_the_outermost_task(now, capsys):
    with progress_shown("auto"), task("tried", 4, "cases") as cases:
        for done in range(1, 5):
            with task("Pressing", 2, "loads") as loads:
                now[0] += 30.0
                loads.advance()
            cases.reached(done, "1 failed" if done > 1 else "")
    assert capsys.readouterr().err.splitlines() == [
        "tried: 1 of 4 cases, 1 a min, 3 min 0 s left",
        "tried: 3 of 4 cases, 1 failed, 1.5 a min, 40 s left",
    ]


def test_a_log_of_what_is_short_is_empty(capsys):
    with progress_shown("auto"):
        work()
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("first", "event", "seconds", "words"),
    [
        (100, (102, 200, "cases", "2 failed"), 1.0, "102 of 200 cases, 2 failed, 2 a s, 49 s left"),
        (100, (100, 200, "cases", ""), 1.0, "100 of 200 cases"),
        (0, (1, 78, "cases", ""), 3600.0, "1 of 78 cases, 1 an h, 3 d 5 h left"),
        (0, (5, None, "states", ""), 10.0, "5 states, 30 a min"),
        (0, (0, None, "", ""), 10.0, ""),
    ],
)
def test_pace_counts_what_this_run_has_done(now, first, event, seconds, words):
    done, total, unit, note = event
    pace = progress_view._Pace(Event("tried", "started", first, total, unit))
    now[0] = seconds
    pace.last = Event("tried", "running", done, total, unit, note)
    assert pace.words() == words


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0, "0 s"),
        (59.4, "59 s"),
        (59.6, "1 min 0 s"),
        (3600, "1 h 0 min"),
        (86399, "23 h 59 min"),
        (90000, "1 d 1 h"),
    ],
)
def test_durations_are_told_in_two_units(seconds, words):
    assert duration(seconds) == words


@pytest.fixture(scope="module")
def part(tmp_path_factory):
    path = tmp_path_factory.mktemp("progress") / "part.npz"
    rc.write(rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, np.random.default_rng(1)), path)
    return path


def test_a_command_reports_beside_its_answer(part, invoke):
    command = ["curve", part, "--modulus", "110GPa", "--pressures", "1MPa:100MPa:5", "--json", "--progress"]
    done = [invoke(*command, form) for form in ("json", "none")]
    assert [each.exit_code for each in done] == [0, 0]
    answers = [json.loads(each.stdout) for each in done]
    assert answers[0] == answers[1]
    loads = [json.loads(line) for line in done[0].stderr.splitlines() if line.startswith("{")]
    loads = [each for each in loads if each["unit"] == "loads" and not each["level"]]
    assert (loads[0]["state"], loads[-1]["state"]) == ("started", "finished")
    assert loads[-1]["done"] == loads[-1]["total"] == 5
    assert "{" not in done[1].stderr


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such terminals")
def test_a_command_shows_a_bar_on_a_terminal(part):
    import pty

    main, side = pty.openpty()
    command = ["curve", str(part), "--modulus", "110GPa", "--pressures", "1MPa:100MPa:5", "--json"]
    done = subprocess.Popen(
        [sys.executable, "-m", "roughcontact", *command],
        stdout=subprocess.PIPE,
        stderr=side,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "120"},
    )
    os.close(side)
    shown = b""
    while True:
        try:
            part_shown = os.read(main, 65536)
        except OSError:  # how Linux ends it
            break
        if not part_shown:
            break
        shown += part_shown
    out = done.communicate()[0]
    os.close(main)
    assert done.returncode == 0
    assert len(json.loads(out)["force"]) == 5
    assert "5 of 5 loads" in plain(shown.decode())
