"""Find the fastest setting of every program that is certified, check that the answers agree, then take times."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from cases import Problem
from certificate import Certificate, Judge
from peer_roughcontact import product_seconds
from programs import CERTIFICATE, Program
from quiet import disturbed, others, waited

__all__ = ["AGREEMENT", "Entry", "Settings", "compare"]

Array = npt.NDArray[np.float64]

AGREEMENT = 1e-7  # of the largest pressure
TIGHT = 1e-10  # certificate at which answers are compared once more before they are said to differ
STEP = 10**-0.5  # from one tolerance that was missed to the next
TRIES = 8
ONCE = 5.0  # [s]; what takes longer is not repeated more than once
PATIENCE = 3  # times the rounds asked for, before a busy machine is given up on

Settings = dict[str, float]


@dataclass(eq=False)
class Entry:
    """What one program did with one problem."""

    program: str
    tolerance: float = np.nan  # in the program's own measure
    certificate: Certificate | None = None
    pressure: Array | None = field(default=None, repr=False)
    depth: float | None = None
    difference: float = np.nan  # of the pressure, from the reference, over the reference's largest
    compared_at: float = CERTIFICATE
    product: float = np.nan  # seconds of an exact product of ours
    seconds: list[float] = field(default_factory=list)  # of rounds with the cores to itself
    disturbed: list[float] = field(default_factory=list)  # of the others
    trouble: str = ""  # why there is no time to show

    @property
    def median(self) -> float:
        """Median time from heights to certified pressure [s]."""
        return float(np.median(self.seconds)) if self.seconds and not self.trouble else np.nan


def compare(problem: Problem, programs: list[Program], settings: Settings, repeats: int) -> list[Entry]:
    """Return an entry for every program; the first one is the reference.

    `settings` keeps the tolerance of each program from one seed to the next.
    """
    shape = problem.heights.shape
    judge = Judge((shape[0], shape[1]), problem.spacing, problem.periodic, problem.modulus)
    entries = []
    for program in programs:
        entry = Entry(program.name, settings.get(program.name, program.adapter.START))
        _certify(entry, program, problem, judge, program.goal)
        if not entry.trouble:
            settings[program.name] = entry.tolerance
        entries.append(entry)
    _check_agreement(entries, programs, problem, judge)
    _take_times(entries, programs, problem, repeats)
    ours = entries[0]
    if ours.pressure is not None:
        ours.product = product_seconds(ours.pressure, problem.spacing, periodic=problem.periodic)
    return entries


def _run(program: Program, problem: Problem, tolerance: float) -> tuple[Array, float | None, float, bool]:
    """Return pressure [Pa], depth [m], time [s] and whether it was falsified; kernels are made inside the time."""
    heights = problem.heights.copy()
    waiting, taken, start = waited(), others(), time.perf_counter()
    pressure, depth = program.adapter.solve(
        heights,
        problem.spacing,
        problem.modulus,
        force=problem.force,
        periodic=problem.periodic,
        tolerance=tolerance,
    )
    seconds = time.perf_counter() - start
    return pressure, depth, seconds, disturbed(seconds, waited() - waiting, others() - taken)


def _certify(entry: Entry, program: Program, problem: Problem, judge: Judge, goal: float) -> None:
    """Tighten the program's tolerance until the judge certifies its pressure to `goal`; these runs warm it up."""
    for _ in range(TRIES):
        try:
            entry.pressure, entry.depth, *_ = _run(program, problem, entry.tolerance)
        except Exception as error:  # a program that fails here is reported, and the others go on
            entry.trouble = f"failed: {type(error).__name__}: {error}"
            return
        entry.certificate = judge.certify(problem.heights, entry.pressure, problem.force)
        if entry.certificate.error <= goal:
            return
        entry.tolerance *= STEP
    entry.tolerance /= STEP
    entry.trouble = f"no certificate of {goal:.0e}: {entry.certificate.error:.1e} at best"


def _check_agreement(entries: list[Entry], programs: list[Program], problem: Problem, judge: Judge) -> None:
    """Set how far every answer is from the reference; times of answers that differ are never compared.

    Two answers may each be certified and still be further apart than AGREEMENT, where a small part of the
    largest displacement is a large pressure on one cell: then both are solved again, tighter.
    """
    reference = entries[0]
    if reference.trouble:
        for entry in entries[1:]:
            entry.trouble = (
                entry.trouble or f"nothing to compare with: {reference.program} {reference.trouble}"
            )
        return
    reference.difference = 0.0
    tight: Entry | None = None
    for entry, program in zip(entries[1:], programs[1:], strict=True):
        if entry.trouble:
            continue
        entry.difference = _difference(entry, reference)
        if entry.difference <= AGREEMENT or program.goal > CERTIFICATE:
            continue
        tight = tight or _tighter(reference, programs[0], problem, judge)
        again = _tighter(entry, program, problem, judge)
        if not (tight.trouble or again.trouble):
            entry.difference, entry.compared_at = _difference(again, tight), TIGHT
        if not entry.difference <= AGREEMENT:
            entry.trouble = f"answers differ by {entry.difference:.1e} of the largest pressure"


def _tighter(entry: Entry, program: Program, problem: Problem, judge: Judge) -> Entry:
    again = Entry(entry.program, entry.tolerance * TIGHT / CERTIFICATE)
    _certify(again, program, problem, judge, TIGHT)
    return again


def _difference(entry: Entry, reference: Entry) -> float:
    assert entry.pressure is not None
    assert reference.pressure is not None
    return float(np.abs(entry.pressure - reference.pressure).max() / reference.pressure.max())


def _take_times(entries: list[Entry], programs: list[Program], problem: Problem, repeats: int) -> None:
    """Let the programs run in turn, A B C A B C, until each has its rounds with the cores to itself.

    A round that something else on the machine disturbed is thrown away for the program it hit, since the
    programs suffer from that very differently; after too many of them there is no time to show.
    """
    for _ in range(PATIENCE * repeats):
        for entry, program in zip(entries, programs, strict=True):
            enough = min(2, repeats) if entry.seconds and entry.seconds[0] > ONCE else repeats
            if entry.trouble or len(entry.seconds) >= enough:
                continue
            _, _, seconds, noise = _run(program, problem, entry.tolerance)
            if noise:
                entry.disturbed.append(seconds)
            else:
                entry.seconds.append(seconds)
