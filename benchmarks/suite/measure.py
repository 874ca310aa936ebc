"""Find the fastest setting of every program that is certified, check that the answers agree, then take times."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import Any

import numpy as np

import roughcontact as rc
from suite.alone import peak_alone
from suite.cases import Case, Problem
from suite.certificate import Certificate
from suite.judges import FIELDS, Judged, judge_of
from suite.programs import Program
from suite.quiet import disturbed, others, waited

__all__ = ["AGREEMENT", "TIGHT", "Entry", "compare", "oracle_of"]

AGREEMENT = 1e-7  # of the largest pressure, at a certificate of 1e-8
TIGHTER = 1e-2  # times the certificate: answers are compared once more there before they are stated to differ
TIGHT = 1e-10
STEP = 10**-0.5  # from one tolerance that was missed to the next
TRIES = 8
ONCE = 5.0  # [s]; what takes longer is not repeated more than once
PATIENCE = 3  # times the rounds asked for, before a busy machine is given up on

Settings = dict[str, float]
Judges = Callable[[], Judged | str]


@dataclass(eq=False)
class Entry:
    """What one program did with one problem."""

    program: Program
    solve: Callable[..., dict[str, Any]]
    tolerance: float  # in the program's own measure
    answer: dict[str, Any] = field(default_factory=dict)
    certificate: Certificate | None = None
    uncertified: str | None = None  # why none was made
    difference: float | None = None  # of the answer, from the reference, over the reference's largest
    compared_at: float | None = None
    seconds: list[float] = field(default_factory=list)  # of rounds with the cores to itself
    disturbed: list[float] = field(default_factory=list)  # of the others
    memory: float | None = None  # peak of a process that does nothing else [MB]
    trouble: str = ""  # why there is no answer, or no comparison

    def row(self) -> dict[str, Any]:
        """Return the plain values of this entry."""
        answer, found = self.answer, self.certificate
        values: dict[str, Any] = {"program": self.program.name, "version": self.program.version}
        values |= {
            "status": answer.get("status"),
            "setting": self.tolerance,
            "effective": answer.get("tolerance"),
        }
        values |= {key: answer.get(key) for key in ("products", "preconditioners")}
        values |= {
            "seconds": self.seconds,
            "median": statistics.median(self.seconds) if self.seconds else None,
        }
        values |= {"disturbed": self.disturbed, "memory": self.memory, "trouble": self.trouble}
        values["uncertified"] = self.uncertified
        values |= {"difference": self.difference, "compared_at": self.compared_at}
        if found is not None:
            values |= {"residual": found.residual, "force_error": found.force_error, "cells": found.cells}
            values["depth"] = None if np.isnan(found.depth) else found.depth
        if "pressure" in answer:
            values["peak_pressure"] = float(np.max(answer["pressure"]))
        return values | {key: float(answer[key]) for key in ("own_depth", "transmissivity") if key in answer}


def compare(
    case: Case,
    problem: Problem,
    programs: list[Program],
    settings: Settings,
    repeats: int,
    *,
    memory: bool = False,
) -> list[dict[str, Any]]:
    """Return a row for every program that solves problems of this kind; the first one is the reference.

    `settings` keeps the tolerance of each program from one seed to the next.
    """
    entries = []
    for program in programs:
        if (solve := program.solver(case.kind)) is not None:
            setting = settings.get(program.name, program.start(case.kind, case.tolerance))
            entries.append(Entry(program, solve, setting))
    if memory:  # first: the machine does not have to hold the kernel of the judge beside another process
        for entry in entries:
            entry.memory = peak_alone(entry.program, case.kind, problem, entry.tolerance)
    # Made beside the first answer, and dropped before times are taken: the programs have the memory to themselves.
    judge = cache(partial(judge_of, case.kind, problem))
    for entry in list(entries):
        try:
            _certify(entry, problem, judge, case.tolerance)
        except NotImplementedError:  # such problems are none of the program's
            entries.remove(entry)
            continue
        if entry.certificate and entry.certificate.error <= case.tolerance:
            settings[entry.program.name] = entry.tolerance
    _check_agreement(entries, problem, judge, case)
    judge.cache_clear()
    _take_times(entries, problem, repeats)
    rows = [entry.row() for entry in entries]
    if entries and "pressure" in entries[0].answer:
        rows[0]["product_seconds"] = product_seconds(problem, entries[0].answer["pressure"])
    return rows


def _run(entry: Entry, problem: Problem, tolerance: float) -> tuple[dict[str, Any], float, bool]:
    """Return the answer, the time [s] and whether it was falsified; kernels are made inside the time."""
    problem = replace(problem, heights=problem.heights.copy())
    waiting, taken, start = waited(), others(), time.perf_counter()
    answer = entry.solve(problem, tolerance)
    seconds = time.perf_counter() - start
    return answer, seconds, disturbed(seconds, waited() - waiting, others() - taken)


def _certify(entry: Entry, problem: Problem, judge: Judges, goal: float) -> None:
    """Tighten the program's tolerance until the judge certifies its answer to `goal`; these runs warm it up."""
    for _ in range(TRIES):
        try:
            entry.answer, *_ = _run(entry, problem, entry.tolerance)
            certify = judge()
            if isinstance(certify, str):
                entry.uncertified = certify
            else:
                entry.certificate = certify(entry.answer)
        except NotImplementedError:
            raise
        except Exception as error:  # a program that fails here is reported, and the others go on
            entry.trouble = f"failed: {type(error).__name__}: {error}"
            return
        if entry.certificate is None or entry.certificate.error <= goal:
            return
        if entry.answer.get("status") != "converged" or hasattr(entry.program.adapter, "ONCE"):
            return  # a tighter tolerance would not help
        entry.tolerance *= STEP
    entry.tolerance /= STEP


def _check_agreement(entries: list[Entry], problem: Problem, judge: Judges, case: Case) -> None:
    """Set how far every answer is from the reference, which is the first entry.

    Two answers may each be certified and still be further apart than the allowed difference, where a small part of the
    largest displacement is a large pressure on one cell: then both are solved again, tighter.
    """
    if not entries or entries[0].trouble:
        return
    reference, tight = entries[0], None
    reference.difference, reference.compared_at = 0.0, case.tolerance
    allowed, goal = AGREEMENT / 1e-8 * case.tolerance, TIGHTER * case.tolerance
    for entry in entries[1:]:
        if entry.trouble:
            continue
        entry.difference, entry.compared_at = _difference(entry, reference, case.kind), case.tolerance
        certified = entry.certificate is not None and entry.certificate.error <= case.tolerance
        if entry.difference <= allowed or not certified:
            continue
        tight = tight or _tighter(reference, problem, judge, goal)
        again = _tighter(entry, problem, judge, goal)
        if not (tight.trouble or again.trouble):
            entry.difference, entry.compared_at = _difference(again, tight, case.kind), goal
        if not entry.difference <= allowed:
            entry.trouble = f"answers differ by {entry.difference:.1e} of the largest {FIELDS[case.kind]}"


def _tighter(entry: Entry, problem: Problem, judge: Judges, goal: float) -> Entry:
    again = Entry(entry.program, entry.solve, entry.tolerance * TIGHTER)
    _certify(again, problem, judge, goal)
    if again.certificate is None or again.certificate.error > goal:
        again.trouble = again.trouble or "not certified"
    return again


def _difference(entry: Entry, reference: Entry, kind: str) -> float:
    found, expected = (np.asarray(each.answer[FIELDS[kind]]) for each in (entry, reference))
    return float(np.abs(found - expected).max() / np.abs(expected).max())


def _take_times(entries: list[Entry], problem: Problem, repeats: int) -> None:
    """Let the programs run in turn, A B C A B C, until each has its rounds with the cores to itself.

    A round that something else on the machine disturbed is thrown away for the program it hit, since the
    programs suffer from that very differently; after too many of them there is no time to show.
    """
    for _ in range(PATIENCE * repeats):
        for entry in entries:
            enough = min(2, repeats) if entry.seconds and entry.seconds[0] > ONCE else repeats
            if entry.trouble or len(entry.seconds) >= enough:
                continue
            _, seconds, noise = _run(entry, problem, entry.tolerance)
            (entry.disturbed if noise else entry.seconds).append(seconds)


def product_seconds(problem: Problem, pressure: Any) -> float:
    """Return the least time of an exact product with the whole grid [s]: what a load is counted in."""
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    operator, seconds = rc.half_space(grid, problem.modulus), []
    for _ in range(6):  # the first makes the kernel
        start = time.perf_counter()
        operator.apply(pressure)
        seconds.append(time.perf_counter() - start)
    return min(seconds)


def oracle_of(case: Case, row: Mapping[str, Any], n: int, seed: int) -> dict[str, tuple[float, float, float]]:
    """Return found, expected and relative tolerance of each number that the case states and the row holds."""
    stated = dict(case.oracle or {})
    for key, within in (("cells", 1e-3), ("depth", 1e-6), ("transmissivity", 1e-6)):
        if key in (listed := case.listed(n, seed) or {}):
            stated[key] = (listed[key], within)
    found = {**row, "contact_fraction": None if row.get("cells") is None else row["cells"] / n**2}
    return {key: (found[key], *stated[key]) for key in stated if found.get(key) is not None}
