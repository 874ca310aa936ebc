"""What the engines of a study cost: two processes against one, and Dask with cases of half a second.

    python benchmarks/studies.py

Engines take turns, each with a store of its own in a temporary folder; see README.md beside this file.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import psutil
import xarray

from roughcontact.study import Case, Dask, Executor, Parameters, Processes, Result, Study, run

WAIT = 0.5  # [s], what a case of the second table takes
PATIENCE = 3  # times the rounds asked for, before a busy machine is given up on
SHARE = 0.05  # of the cores, that other programs may have taken
CURVE = {"points": 256, "size": "1 mm", "hurst": 0.8, "rms": "1 um", "modulus": "100 GPa"}


class Nothing(Parameters):
    """A case that only takes time has no parameters."""


def wait(parameters: Nothing, rng: np.random.Generator) -> xarray.Dataset:
    time.sleep(WAIT)
    return xarray.Dataset({"number": rng.normal()})


WAITING = Case("waiting", 1, Nothing, wait)


@dataclass(frozen=True, slots=True)
class Run:
    """What one run of a study took [s]."""

    start: float  # until the first case began
    stop: float  # from the last result until the workers had gone
    each: float  # time over cases, once all workers are at work
    alone: float  # mean of what the cases say they took
    others: float  # share of the cores that other programs took


def measured(study: Study, engine: Executor) -> Run:
    """Run a study in a new store, and take times."""
    times: list[tuple[float, float]] = []

    def note(result: Result) -> None:
        if result.record is None:
            raise SystemExit(f"a case failed: {result.message}")
        times.append((time.perf_counter(), result.seconds))

    with tempfile.TemporaryDirectory() as folder:
        busy, begin = _busy(), time.perf_counter()
        run(study, folder, engine, on_result=note)
        end = time.perf_counter()
        busy = _busy() - busy
    # All workers have been at work for a while after a quarter of the cases; then comes a multiple of their number.
    late = times[len(times) // 4 :]
    late = late[(len(late) - 1) % engine.workers :]
    return Run(
        start=times[0][0] - times[0][1] - begin,
        stop=end - times[-1][0],
        each=(late[-1][0] - late[0][0]) / (len(late) - 1),
        alone=statistics.mean(seconds for _, seconds in late[1:]),
        others=busy / ((end - begin) * (os.cpu_count() or 1)),
    )


def _busy() -> float:
    """Return the time that the cores have spent on other programs than this one and its workers [s]."""
    system, mine = psutil.cpu_times(), os.times()
    own = mine.user + mine.system + mine.children_user + mine.children_system
    return sum(system) - system.idle - getattr(system, "iowait", 0.0) - own


def rounds(study: Study, engines: Sequence[Executor], count: int) -> Iterator[tuple[Run, ...]]:
    """Yield that many undisturbed rounds, in each of which every engine has its turn; fewer on a busy machine."""
    for _ in range(PATIENCE * count):
        found = tuple(measured(study, engine) for engine in engines)
        if max(each.others for each in found) < SHARE:
            yield found
            count -= 1
        if not count:
            return


def spread(values: Sequence[float], form: str) -> str:
    """Return the median and the range."""
    if not values:
        return "the machine was busy"
    return f"{statistics.median(values):{form}} ({min(values):{form}} to {max(values):{form}})"


def speed(cases: int, workers: int, count: int) -> None:
    """Print the throughput of one process and of several."""
    study = Study(name="speed", case="curve", samples=cases, parameters={**CURVE, "loads": 20})
    found = list(rounds(study, (Processes(1), Processes(workers)), count))
    print(f"## Processes\n\n{cases} curves of 20 loads at 256 x 256, one thread each, {len(found)} rounds.\n")
    print("| processes | cases a second | start [s] | stop [s] |\n|---|---|---|---|")
    for k, number in enumerate((1, workers)):
        runs = [each[k] for each in found]
        print(
            f"| {number} | {spread([1 / r.each for r in runs], '.2f')} "
            f"| {spread([r.start for r in runs], '.1f')} | {spread([r.stop for r in runs], '.1f')} |"
        )
    gains = [one.each / more.each for one, more in found]
    slower = [more.alone / one.alone for one, more in found]
    print(f"\n- {workers} processes over one: {spread(gains, '.2f')}")
    print(f"- what a case takes beside others, over what it takes alone: {spread(slower, '.2f')}\n")


def overhead(cases: int, workers: int, count: int) -> None:
    """Print what engines add to cases of half a second."""
    engines = {"processes": Processes(workers), "Dask": Dask(workers=workers)}
    study = Study(name="overhead", case="studies:WAITING", samples=cases)
    found = list(rounds(study, tuple(engines.values()), count))
    print(f"## Overhead\n\n{cases} cases that wait for {WAIT} s, {workers} workers, {len(found)} rounds.\n")
    print("| engine | overhead | start [s] | stop [s] |\n|---|---|---|---|")
    for k, name in enumerate(engines):
        runs = [each[k] for each in found]
        beyond = [r.each * workers / WAIT - 1 for r in runs]
        print(
            f"| {name} | {spread(beyond, '.1%')} | {spread([r.start for r in runs], '.1f')} "
            f"| {spread([r.stop for r in runs], '.1f')} |"
        )
    study = Study(name="curves", case="curve", samples=cases, parameters={**CURVE, "loads": 50})
    found = list(rounds(study, tuple(engines.values()), count))
    more = [theirs.each / ours.each - 1 for ours, theirs in found]
    mean = [ours.alone for ours, _ in found]
    print(f"\n- curves of 50 loads, {spread(mean, '.2f')} s each: Dask over processes {spread(more, '+.1%')}")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=80, help="of a study")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=3)
    chosen = parser.parse_args()
    cases = chosen.cases - chosen.cases % chosen.workers
    speed(cases, chosen.workers, chosen.rounds)
    overhead(cases, chosen.workers, chosen.rounds)


if __name__ == "__main__":
    main()
