"""Time and peak memory of a curve of 100 loads: here with its stiffness, in ASPHER without (it has none).

    python benchmarks/curve.py --sizes 256,512 --seeds 0

Each curve runs in a process of its own, in turn. See README.md beside this file.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from suite.alone import peak
from suite.programs import limit_threads
from suite.quiet import disturbed, others, waited

POINTS, LOWEST, HIGHEST = 100, 1e-4, 0.07  # loads, evenly spaced in the logarithm, as dimensionless forces
CHECKED = (0, 33, 66, 99)  # loads at which answers are certified and compared
CERTIFICATE, AGREEMENT = 1e-8, 1e-7
PATIENCE = 3  # times the rounds asked for, before a busy machine is given up on
ASPHER_START = 1e-8  # its own tolerance, tightened until every checked load is certified
# The command-line names of the curves: ours, then ASPHER from the last load's pressure, then from nested grids.
PROGRAMS = {"roughcontact": "roughcontact", "aspher-warm": "aspher", "aspher-nested": "aspher"}


Point = tuple[int, float, float, int]  # number, residual, depth [m] and cells in contact of one load
Curve = tuple[Callable[[], Any], Callable[[Any], list[Point]]]


def ours(problem: Any, forces: Any, tolerance: float, most: float) -> Curve:
    """Return what is timed, and how to take residual, depth and cells of the checked loads from its result.

    Ours keeps its default tolerance, and goes on to its end.
    """
    from suite.certificate import Judge

    import roughcontact as rc

    surface = rc.Surface(problem.heights, rc.Grid(problem.heights.shape, problem.spacing))

    def run() -> Any:
        return rc.loading_curve(surface, problem.modulus, forces=forces)

    def points(curve: Any) -> list[Point]:
        judge = Judge(surface.grid.shape, problem.spacing, False, problem.modulus)
        found = []
        # The curve keeps no pressures: the same path once more, off the clock, shows them to the judge.
        for i, solution in enumerate(rc.loading_path(surface, problem.modulus, forces=forces)):
            if i in CHECKED:
                certificate = judge.certify(problem.heights, solution.pressure, forces[i])
                cells = round(curve.contact_area[i] / surface.grid.cell_area)
                error = max(certificate.error, float(curve.residual[i]))
                found.append((i, error, float(curve.depth[i]), cells))
        return found

    return run, points


def aspher(problem: Any, forces: Any, tolerance: float, most: float, *, warm: bool) -> Curve:
    """Return the same for ASPHER, cut after so many seconds; the judge takes depth and cells from its pressure."""
    import aspher
    import numpy as np
    from suite import peer_aspher
    from suite.certificate import Judge

    n, kept = len(problem.heights), {}

    def run() -> dict[int, Any]:
        gap = np.negative(problem.heights).ravel()
        solver = aspher.ContactSolver(grid_size=n, backend="fft") if warm else None
        pressure, start = None, time.perf_counter()
        for i, force in enumerate(forces):
            if solver is None:
                pressure = peer_aspher.normal(replace(problem, force=force), tolerance)["pressure"]
            else:
                before = None if pressure is None else pressure * (force / forces[i - 1])
                result = solver.solve(
                    gap, p_nominal=force, tol=tolerance, precond="fourier-fft", p_init=before
                )
                pressure = np.asarray(result.pressure).reshape(n, n)
            late = time.perf_counter() - start > most
            if (i in CHECKED or late) and len(forces) == POINTS:
                kept[i] = pressure
            if late:
                break
        return kept

    def points(pressures: dict[int, Any]) -> list[Point]:
        judge = Judge((n, n), problem.spacing, False, problem.modulus)
        certificates = {i: judge.certify(problem.heights, p, forces[i]) for i, p in pressures.items()}
        return [(i, found.error, found.depth, found.cells) for i, found in certificates.items()]

    return run, points


def work(name: str, n: int, seed: int, tolerance: float, most: float) -> dict[str, Any]:
    """Solve one curve in this process."""
    import numpy as np
    from suite.cases import CASES

    make = ours if name == "roughcontact" else lambda *a: aspher(*a, warm=name == "aspher-warm")
    case = CASES["fractal-0.8-0.046"]  # its surface
    forces = case.surface["rms"] * np.geomspace(LOWEST, HIGHEST, POINTS)
    warm_up, _ = make(case(64, 0), forces[-2:], tolerance, most)
    warm_up()  # imports and first calls
    run, points = make(case(n, seed), forces, tolerance, most)
    before = peak()
    waiting, taken, start = waited(), others(), time.perf_counter()
    result = run()
    seconds = time.perf_counter() - start
    noise = disturbed(seconds, waited() - waiting, others() - taken)
    memory = peak()
    return {
        "seconds": seconds,
        "peak": memory,
        "before": before,
        "points": points(result),
        "disturbed": noise,
        "tolerance": tolerance,
    }


def measure(name: str, n: int, seed: int, tolerance: float, most: float) -> dict[str, Any]:
    """Run `work` in a process of its own."""
    command = [sys.executable, __file__, "--worker", name, str(n), str(seed), repr(tolerance), repr(most)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{name}: {(done.stderr.strip().splitlines() or ['stopped'])[-1]}")
    return json.loads(done.stdout.splitlines()[-1])


def certified(name: str, n: int, seed: int, tolerance: float, most: float) -> dict[str, Any]:
    """Run a curve, tighter and tighter, until its checked loads are certified; ours has to be at once."""
    for _ in range(6):
        found = measure(name, n, seed, tolerance, most)
        error = max(residual for _, residual, _, _ in found["points"])
        if error <= CERTIFICATE:
            return found
        if name == "roughcontact":
            break
        tolerance *= 10**-0.5
    raise RuntimeError(f"{name}: no certificate of {CERTIFICATE:.0e}, {error:.1e} at best")


def differ(reference: dict[str, Any], other: dict[str, Any]) -> str:
    """Return what does not agree between two curves."""
    found = {i: (depth, cells) for i, _, depth, cells in reference["points"]}
    for i, _, depth2, cells2 in other["points"]:
        if i not in found:  # where it was cut
            continue
        depth, cells = found[i]
        if abs(depth2 / depth - 1) > AGREEMENT or abs(cells2 - cells) > 1:
            return f"load {i + 1}: depth {depth:.9g} and {depth2:.9g} m, cells {cells} and {cells2}"
    return ""


def quiet(runs: list[dict[str, Any]]) -> list[float]:
    """Return the times of the rounds that had the cores to themselves [s]."""
    return [run["seconds"] for run in runs if not run["disturbed"]]


def compare(
    names: list[str], n: int, seed: int, repeats: int, tolerance: float, most: float
) -> list[dict[str, Any]]:
    """Print the lines of one surface and return the measurements; the first name is the reference."""
    rounds = {}
    for name in names:
        try:
            rounds[name] = [certified(name, n, seed, tolerance, most)]
        except RuntimeError as error:
            print(f"{name}: not shown ({error})")
    for _ in range(PATIENCE * repeats - 1):
        for name, runs in rounds.items():
            if len(quiet(runs)) < repeats:
                runs.append(measure(name, n, seed, runs[0]["tolerance"], most))
    records, reference = [], rounds.get(names[0])
    for name, runs in rounds.items():
        times = quiet(runs)
        memory, before = max(run["peak"] for run in runs), runs[0]["before"]
        error = max(residual for _, residual, _, _ in runs[0]["points"])
        loads = min(run["points"][-1][0] for run in runs) + 1
        more, cut = (">", f"  after {loads} of {POINTS} loads") if loads < POINTS else ("", "")
        trouble = differ(reference[0], runs[0]) if reference else "nothing to compare with"
        left_out = f"{len(runs) - len(times)} disturbed rounds left out" if len(times) < len(runs) else ""
        ratio = None
        whole = reference and reference[0]["points"][-1][0] + 1 == POINTS  # beside a cut one nothing is known
        if whole and quiet(reference) and times and not trouble:
            ratio = statistics.median(times) / statistics.median(quiet(reference))
        shown = [statistics.median(times), min(times), max(times)] if times and not trouble else [None] * 3
        columns = "".join(f"{'-' if value is None else f'{more}{value:.2f}':>9}" for value in (*shown, ratio))
        print(
            f"{name:16}{n:>6}{seed:>6}{columns}{memory:>9.0f}{memory - before:>9.0f}{error:>10.1e}"
            f"{'-' if name == 'roughcontact' else format(runs[0]['tolerance'], '.1e'):>11}  {trouble}{left_out}{cut}"
        )
        records.append(
            {"program": name, "n": n, "seed": seed, "loads": loads, "ratio": ratio, "trouble": trouble}
            | {"rounds": runs}
        )
    return records


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", type=lambda text: [int(p) for p in text.split(",")], default=[512])
    parser.add_argument("--seeds", type=lambda text: [int(p) for p in text.split(",")], default=[0])
    parser.add_argument("--programs", type=lambda text: text.split(","), default=list(PROGRAMS))
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--threads", type=int, default=min(2, os.cpu_count() or 1))
    parser.add_argument(
        "--tolerance", type=float, default=ASPHER_START, help="of ASPHER, at which its search begins"
    )
    parser.add_argument(
        "--most",
        type=float,
        default=float("inf"),
        help="seconds after which ASPHER's curve is cut: it takes more",
    )
    parser.add_argument("--json", type=Path)
    parser.add_argument("--worker", nargs=5, help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.worker:
        name, n, seed, tolerance, most = args.worker
        print(json.dumps(work(name, int(n), int(seed), float(tolerance), float(most))))
        return 0
    if unknown := set(args.programs) - set(PROGRAMS):
        parser.error(f"unknown programs {', '.join(sorted(unknown))}; there are {', '.join(PROGRAMS)}")
    limit_threads(args.threads)
    names = []
    for name in args.programs:
        try:
            importlib.metadata.version(PROGRAMS[name])
            names.append(name)
        except importlib.metadata.PackageNotFoundError:
            print(f"{name}: not shown (not installed)")
    print(f"{POINTS} loads, dimensionless force {LOWEST:g} to {HIGHEST:g}, free fractal square, H = 0.8")
    print(f"threads for every program: {args.threads}; roughcontact with stiffness, ASPHER without")
    print(
        f"{'program':16}{'n':>6}{'seed':>6}{'time/s':>9}{'fastest':>9}{'slowest':>9}{'ratio':>9}"
        f"{'peak/MB':>9}{'grown/MB':>9}{'residual':>10}{'tolerance':>11}"
    )
    records = [
        record
        for n in args.sizes
        for seed in args.seeds
        for record in compare(names, n, seed, args.repeats, args.tolerance, args.most)
    ]
    if args.json:
        args.json.write_text(json.dumps(records, indent=1) + "\n")
    return int(any(record["trouble"] for record in records))


if __name__ == "__main__":
    sys.exit(main())
