"""Write what cases.toml states of its surfaces: hashes, sketches, and numbers of the answers."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from suite.cases import CASES, FILE, Case, chosen, sha256, sketch
from suite.judges import judge_of, transmissivity
from suite.programs import Program, load

TOLERANCE = 1e-10
LARGEST = 1024  # cells a side of a surface whose answer is computed


def freeze(prefixes: str) -> None:
    """Rewrite the entries `surfaces` of the cases that begin with one of the prefixes."""
    names = chosen(prefixes)
    text, alone = FILE.read_text(encoding="utf-8"), {re.sub(r"-[\d.e-]+$", "", name) for name in names}
    for name in sorted({*names, *alone}):
        head = f"[{json.dumps(name)}]" if f"[{json.dumps(name)}]\n" in text else f"[{name}]"
        if f"{head}\n" not in text:
            continue
        several = name not in CASES  # loads of one entry: their answers differ
        case = next(
            CASES[each] for each in names if each == name or (several and each.startswith(f"{name}-"))
        )
        lines = [_line(_entry(case, n, seed, not several)) for n in case.sizes for seed in case.seeds]
        begin = text.index("surfaces = [\n", text.index(f"{head}\n"))
        end = text.index("\n]\n", begin) + 3
        text = text[:begin] + "\n".join(["surfaces = [", *lines, "]", ""]) + text[end:]
        FILE.write_text(text, encoding="utf-8")
        print(f"{name}: {len(lines)} surfaces")


def _entry(case: Case, n: int, seed: int, answers: bool) -> dict[str, Any]:
    heights = case.heights(n, seed)
    entry: dict[str, Any] = {"n": n, "seed": seed, "sha256": sha256(heights), "sketch": sketch(heights)}
    if case.kind == "adhesion":
        other = load("adhesion")
        assert isinstance(other, Program), other
        found = other.adapter.adhesion(case.problem(heights, case.cell or 1 / n, {}), 1e-8)
        entry["mean_gap"] = float(np.mean(found["gap"]))
    problem = case.problem(heights, case.cell or 1 / n, entry)
    if case.kind == "flow":
        assert problem.gap is not None
        return entry | {"transmissivity": transmissivity(problem.gap)}
    if not answers or n > LARGEST or case.oracle:
        return entry
    ours, judge = load("roughcontact"), judge_of(case.kind, problem)
    assert isinstance(ours, Program), ours
    assert not isinstance(judge, str), judge
    found = judge(getattr(ours.adapter, case.kind)(problem, TOLERANCE))
    assert found.error <= 10 * TOLERANCE, (case.name, n, seed, found)
    return entry | {"cells": found.cells} | ({} if np.isnan(found.depth) else {"depth": found.depth})


def _line(entry: Mapping[str, Any]) -> str:
    """Return an inline table of TOML."""
    return "  { " + ", ".join(f"{key} = {json.dumps(value)}" for key, value in entry.items()) + " },"
