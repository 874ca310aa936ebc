"""The benchmark of rough contact (benchmarks/suite): cases, the contract before a ratio, judges, adapters of users."""

import importlib
import json
import math
import re
import sys
import weakref
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import roughcontact as rc

HOME = Path(__file__).parents[1]
PAGE = HOME / "docs" / "evidence" / "benchmark-suite.md"


@pytest.fixture
def suite(monkeypatch):
    monkeypatch.syspath_prepend(HOME / "benchmarks")
    names = ("cases", "judges", "measure", "rows", "programs", "alone", "peer_roughcontact", "__main__")
    yield SimpleNamespace(**{name.strip("_"): importlib.import_module(f"suite.{name}") for name in names})
    for name in [name for name in sys.modules if name == "suite" or name.startswith("suite.")]:
        sys.modules.pop(name)


def row(**changed):
    made = {
        "case": "flat-free",
        "n": 64,
        "seed": 0,
        "program": "roughcontact",
        "version": "1",
        "demand": 1e-8,
    }
    made |= {
        "status": "converged",
        "setting": 1e-8,
        "effective": None,
        "products": 30,
        "preconditioners": None,
    }
    made |= {
        "seconds": [2.0, 3.0, 4.0],
        "median": 3.0,
        "disturbed": [],
        "memory": None,
        "trouble": "",
        "busy": False,
    }
    made |= {"difference": 0.0, "residual": 3e-9, "force_error": 1e-16, "cells": 300, "oracle": {}}
    return made | changed


def test_the_heights_of_the_cases_are_those_of_the_file(suite):
    made = [
        case
        for case in suite.cases.CASES.values()
        if case.surface["generator"] not in ("rfgen", "rough_paraboloid")
    ]
    checked = [
        case.checked(case.heights(64, seed), 64, seed) for case in made for seed in case.seeds if case.sizes
    ]
    assert len(checked) > 30
    assert set(checked) <= {"to the bit", "to rounding"}


def test_other_heights_are_refused(suite):
    case = suite.cases.CASES["flat-free"]
    heights = case.heights(64, 1)
    assert case.checked(heights * (1 + 1e-13), 64, 1) == "to rounding"
    assert case.checked(heights, 65, 1) == "not listed"
    changed = heights.copy()
    changed[5, 7] += 1e-5 * heights.std()
    for other in (changed, heights.T, -heights):
        with pytest.raises(suite.cases.HeightsError, match="not those of cases"):
            case.checked(other, 64, 1)


REASONS = [
    ({}, ""),
    ({"status": "stagnated"}, "status: stagnated"),
    ({"status": None}, "status: not stated"),
    ({"demand": 1e-6}, "tolerance: measured for 1e-06, the case demands 1e-08"),
    ({"effective": 1e-8}, ""),
    ({"effective": 2e-6}, "tolerance: the program loosened 1e-08 to 2e-06"),
    ({"residual": 2e-8}, "certificate: 2e-08, the case demands 1e-08"),
    ({"force_error": 1e-3}, "certificate: 1e-03, the case demands 1e-08"),
    ({"residual": None, "uncertified": "no memory"}, "certificate: missing (no memory)"),
    ({"oracle": {"depth": (1.0, 1.0 + 1e-7, 1e-6)}}, ""),
    ({"oracle": {"own_depth": (1.0, 2.0, 1e-6)}}, "own depth: 1 instead of 2"),
    ({"oracle": {"cells": (302, 300, 1e-3)}}, ""),
    ({"oracle": {"cells": (303, 300, 1e-3)}}, "cells: 303 instead of 300"),
    (
        {"trouble": "answers differ by 1e-3 of the largest pressure"},
        "answers differ by 1e-3 of the largest pressure",
    ),
    ({"seconds": []}, "on a busy machine"),
    ({"busy": True}, "on a busy machine"),
]


@pytest.mark.parametrize(("changed", "reason"), REASONS, ids=lambda each: str(each)[:40])
def test_a_ratio_is_shown_only_under_the_contract(suite, changed, reason):
    """Times 3 and 12 s, fastest 2 and 6 s: a ratio of 4, at the lowest 3."""
    other = row(program="other", seconds=[6.0, 12.0, 13.0], median=12.0)
    ours, theirs = suite.rows.table([row(), other | changed])
    assert suite.rows.refusal(other | changed, suite.cases.CASES["flat-free"]) == reason
    assert (theirs[4], theirs[-1]) == ("" if reason else "4 (3)", reason)
    assert (ours[4], ours[-1]) == ("", "")
    # The same of ours: no other program is compared with it.
    ours, theirs = suite.rows.table([row(**changed), other])
    assert ours[-1] == reason
    assert theirs[4] == ("" if reason else "4 (3)")
    assert theirs[-1] == ("nothing to compare with: see roughcontact" if reason else "")


def test_the_table_of_rows_is_written_as_csv(suite, tmp_path):
    seeds = [row(seed=seed, median=3.0 + seed) for seed in (0, 1)]
    other = [row(seed=seed, program="tamaas", residual=math.inf, memory=140.6) for seed in (0, 1)]
    (tmp_path / "rows").write_text("".join(json.dumps(each) + "\n" for each in [*other, *seeds, *seeds]))
    suite.rows.write_csv(suite.rows.table(suite.rows.read_rows([tmp_path / "rows"])), tmp_path / "table.csv")
    head, ours, theirs = (tmp_path / "table.csv").read_text().splitlines()
    assert head.startswith("case,cells,program,time [s],ratio")
    assert ours == "flat-free,64^2,roughcontact,3.5,,3e-09,1e-08,30,,,"
    assert theirs == 'flat-free,64^2,tamaas,3,,,1e-08,30,,141,"certificate: inf, the case demands 1e-08"'


def test_sizes_that_did_not_run_are_extrapolated_and_labelled(suite):
    runs = [row(n=1024, median=1.0, memory=100.0), row(n=2048, median=4.0, memory=300.0), row(program="once")]
    (made,) = suite.rows.extrapolated(runs, (1024, 2048, 8192))
    assert (made["n"], made["median"], made["memory"]) == (8192, pytest.approx(64), pytest.approx(2700))
    (line,) = suite.rows.table([made])
    assert line[3:6] == ["64", "", ""]
    assert line[-1] == "extrapolated from 1024 and 2048"


def certified(suite, name, answer, n=64):
    """Return certificate and reason of an answer to a case."""
    case = suite.cases.CASES[name]
    found = suite.judges.judge_of(case.kind, case(n, 0))(answer)
    made = row(cells=found.cells, depth=found.depth, residual=0.0, demand=case.tolerance)
    made |= {key: float(np.max(answer[key])) for key in ("own_depth", "transmissivity") if key in answer}
    made |= {"peak_pressure": np.max(answer["pressure"])} if "pressure" in answer else {}
    made["oracle"] = suite.measure.oracle_of(case, made, n, 0)
    assert made["oracle"]
    return found, suite.rows.refusal(made, case)


@pytest.mark.parametrize(
    "name",
    [
        "pitfall-boundary",
        "pitfall-modulus",
        "pitfall-one-cell",
        "sphere",
        "flat-half",
        "plastic",
        "adhesive",
        "flow",
    ],
)
def test_answers_of_each_kind_are_certified_and_agree_with_the_case(suite, name):
    """Ours are computed by other kernels, sums and solvers than those of the judge."""
    case = suite.cases.CASES[name]
    answer = getattr(suite.peer_roughcontact, case.kind)(case(64, 0), case.tolerance)
    found, reason = certified(suite, name, answer)
    assert found.error <= case.tolerance
    assert reason == ""
    field = suite.judges.FIELDS[case.kind]
    found, _ = certified(suite, name, {**answer, field: np.multiply(answer[field], 1.001)})
    assert found.error > case.tolerance


def test_the_pitfalls_are_told_by_the_numbers_of_their_cases(suite):
    case = suite.cases.CASES["pitfall-boundary"]
    problem = case(64, 0)
    body = rc.Surface(problem.heights, rc.Grid((64, 64), problem.spacing, periodic=True))
    pressure = rc.press(body, 1.0, force=problem.force).pressure  # as if the square repeated
    found, reason = certified(suite, "pitfall-boundary", {"pressure": pressure})
    assert found.error > 1e-2
    assert reason.startswith("contact fraction: ")
    wave = suite.cases.CASES["pitfall-modulus"](64, 0)
    body = rc.Surface(wave.heights, rc.Grid((64, 64), wave.spacing, periodic=True))
    softer = rc.press(body, 2.4, force=wave.force).pressure
    assert certified(suite, "pitfall-modulus", {"pressure": softer})[1].startswith("peak pressure: ")
    needle = suite.cases.CASES["pitfall-one-cell"](64, 0)
    pressure = np.where(needle.heights > 0, needle.force, 0.0)
    circle = 2 / math.sqrt(math.pi)  # of the area of the cell
    found, reason = certified(suite, "pitfall-one-cell", {"pressure": pressure, "own_depth": circle})
    assert found.error < 1e-8
    assert reason == f"own depth: {circle:.6g} instead of 1.1222"


def test_the_flow_through_layers_is_their_harmonic_mean(suite):
    """Along axis 0 two layers of four cells resist in series; axis 1 of the transposed gap carries them in parallel."""
    gap = np.repeat(np.where(np.arange(8) < 4, 1.0, 2.0)[:, None], 6, axis=1)
    assert suite.judges.transmissivity(gap.T) == pytest.approx((1 + 8) / 2)
    # Faces: three of 1, three of 8, two of 16/9 between the layers.
    assert suite.judges.transmissivity(gap) == pytest.approx(8 / (3 + 3 / 8 + 2 * 9 / 16))
    gap[2] = 0
    assert abs(suite.judges.transmissivity(gap)) < 1e-13


def test_the_adapter_of_the_page_takes_part(suite, tmp_path, monkeypatch, capsys):
    (code,) = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    sources = [code, *(path.read_text() for path in (HOME / "benchmarks" / "suite").glob("peer_*.py"))]
    assert max(len(each.splitlines()) for each in sources) <= 40
    (tmp_path / "peer_mine.py").write_text(code)
    monkeypatch.setattr(suite.main, "limit_threads", lambda count: None)
    given = [
        "run",
        "--adapters",
        str(tmp_path),
        "--programs",
        "mine",
        "--sizes",
        "64",
        "--repeats",
        "1",
        "--busy",
    ]
    given += ["--cases", "flat-half,fractal-0.8-0.001", "--seeds", "2", "--rows", str(tmp_path / "rows")]
    assert suite.main.main(given) == 0
    rows = [json.loads(line) for line in (tmp_path / "rows").read_text().splitlines()]
    assert [(each["case"], each["program"]) for each in rows] == [
        ("fractal-0.8-0.001", "roughcontact"),
        ("flat-half", "roughcontact"),
        ("flat-half", "mine"),
    ]
    mine = rows[-1]
    assert (mine["status"], mine["version"], mine["seed"], mine["trouble"]) == ("converged", "1", 2, "")
    assert mine["residual"] <= 1e-8
    assert mine["products"] > 20
    assert 0 < mine["difference"] < 1e-6
    assert {*mine["oracle"]} == {"cells", "depth"}
    assert mine["median"] > 0
    assert "mine 1: Polonsky and Keer, no preconditioner" in capsys.readouterr().out
    assert suite.main.main(["table", str(tmp_path / "rows"), "--csv", str(tmp_path / "table.csv")]) == 0
    assert (tmp_path / "table.csv").read_text().count("on a busy machine") == 3


def test_a_program_that_fails_or_differs_is_reported(suite):
    case, n = suite.cases.CASES["flat-half"], 64
    problem = case(n, 0)

    def program(name, solve):
        return suite.programs.Program(name, "1", SimpleNamespace(normal=solve))

    ours = program("roughcontact", suite.peer_roughcontact.normal)

    def fails(problem, tolerance):
        raise RuntimeError("no licence")

    def loose(problem, tolerance):
        answer = suite.peer_roughcontact.normal(problem, 1e-8)
        return answer | {"pressure": answer["pressure"] * 1.01}

    def stuck(problem, tolerance):
        return loose(problem, tolerance) | {"status": "step limit"}

    others = [
        program("fails", fails),
        program("loose", loose),
        program("none", None),
        program("stuck", stuck),
    ]
    rows = suite.measure.compare(case, problem, [ours, *others], {}, 1)
    assert [each["program"] for each in rows] == ["roughcontact", "fails", "loose", "stuck"]
    assert rows[0]["trouble"] == ""
    assert rows[0]["product_seconds"] > 0
    assert rows[1]["trouble"] == "failed: RuntimeError: no licence"
    assert rows[2]["force_error"] == pytest.approx(0.01)
    assert rows[2]["setting"] < 1e-11 < rows[3]["setting"] == 1e-8  # tightened in vain, and not at all


def test_times_are_taken_without_the_kernel_of_the_judge(suite, monkeypatch):
    """It is made after the first answer, and nothing holds it when the rounds begin."""
    case = suite.cases.CASES["sphere"]
    ours, made, there = suite.programs.load("roughcontact"), [], []
    judge_of, solve = suite.measure.judge_of, ours.solver("normal")

    def noted(kind, problem):
        judge = judge_of(kind, problem)
        made.append(weakref.ref(judge))
        return judge

    def watched(problem, tolerance):
        there.append([judge() is not None for judge in made])
        return solve(problem, tolerance)

    monkeypatch.setattr(suite.measure, "judge_of", noted)
    monkeypatch.setattr(type(ours), "solver", lambda program, kind: watched)
    [row] = suite.measure.compare(case, case(64, 0), [ours], {}, 1)
    assert row["residual"] <= case.tolerance
    assert there[0] == []
    assert there[-1] == [False]


def test_the_memory_is_that_of_a_process_of_its_own(suite):
    ours = suite.programs.load("roughcontact")
    problem = suite.cases.CASES["sphere"](64, 0)
    found = suite.alone.peak_alone(ours, "normal", problem, 1e-8)
    assert 20 < found < 2000  # MB: Python with NumPy, and nearly nothing beside
    broken = SimpleNamespace(name="missing", adapter=ours.adapter)
    assert suite.alone.peak_alone(broken, "normal", problem, 1e-8) is None


def test_a_program_that_is_not_installed_says_so(suite, tmp_path):
    (tmp_path / "peer_absent.py").write_text("import no_such_package\nPACKAGE = 'absent'\n")
    assert suite.programs.names(tmp_path)[0] == "roughcontact"
    assert {"absent", "tamaas", "adhesion"} <= {*suite.programs.names(tmp_path)}
    assert "no_such_package" in suite.programs.load("absent", tmp_path)
    assert suite.programs.load("roughcontact").version
