"""Time from heights to a certified answer, here and in other programs, on surfaces of fixed seeds.

    python benchmarks/suite run --cases fractal-0.8,sphere --sizes 256,512 --seeds 0,1 --programs tamaas,aspher
    python benchmarks/suite run --heights FILE --cases challenge    # a file of yours: .npy, or numbers in text
    python benchmarks/suite run --growth --rows growth.jsonl        # seconds and memory from 1024 to 16384 cells a side
    python benchmarks/suite table rows.jsonl --csv FILE             # of what --rows wrote

benchmarks/README.md states what is measured, docs/evidence/benchmark-suite.md how to add a program.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))  # run as a folder, this is no package

from suite.programs import Program, limit_threads, load, names

GROWTH = (1024, 2048, 4096, 8192, 16384)
DEFAULT = "fractal-0.8-0.046,flat-free,flat-periodic,sphere"


def main(given: list[str] | None = None) -> int:
    args = _arguments(given)
    if args.command == "run":
        limit_threads(args.threads)
    # Only now: what these import reads the number of threads once.
    from suite.rows import read_rows

    if args.command == "run":
        return _run(args)
    if args.command == "freeze":
        from suite.freeze import freeze

        freeze(args.cases)
        return 0
    rows = read_rows(args.rows)
    _print(rows)
    if args.csv:
        from suite.rows import table, write_csv

        write_csv(table(rows), args.csv)
    if args.pictures:
        from suite.pictures import draw

        print(*draw(rows, args.pictures), sep="\n")
    return 0


def _run(args: argparse.Namespace) -> int:
    from suite.cases import CASES, HeightsError, chosen
    from suite.rows import extrapolated

    programs, hidden = _programs(args.programs, args.adapters)
    machine = _machine(args.threads)
    print(machine)
    for program in programs:
        print(f"{program.name} {program.version}: {program.adapter.SETTINGS}")
    for name, reason in hidden.items():
        print(f"{name}: not shown ({reason})")
    if not programs:
        return 1
    rows: list[dict[str, Any]] = []
    for name in chosen(args.cases):
        case, settings, before = CASES[name], dict[str, float](), len(rows)
        seeds = args.seeds if args.seeds and len(case.seeds) > 1 else case.seeds[: 1 if args.growth else None]
        for n in args.sizes:
            fits = [p for p in programs if not _too_slow(rows, name, n, p.name, args.limit)]
            for seed in seeds:
                print(f"{name}, n = {n}, seed {seed} ...", file=sys.stderr)
                try:
                    made = _rows(args, name, n, seed, fits, settings)
                except (HeightsError, MemoryError) as error:
                    print(f"{name}: refused: {error or 'too little memory'}", file=sys.stderr)
                    continue
                made = [{**row, "machine": machine} for row in made]
                rows += made
                _write(args.rows, made)
            for absent in sorted({p.name for p in programs} - {p.name for p in fits}):
                print(f"  {absent}, n = {n}: not shown (would take longer than {args.limit:g} s)")
        if args.growth:
            made = extrapolated(rows[before:], args.sizes)
            rows += made
            _write(args.rows, made)
        _print(rows[before:])
    return _status(rows)


def _rows(
    args: argparse.Namespace,
    name: str,
    n: int,
    seed: int,
    programs: list[Program],
    settings: dict[str, float],
) -> list[dict[str, Any]]:
    """Return the rows of one size and seed of a case; heights that are not those of the case are refused."""
    from suite.cases import CASES
    from suite.measure import compare, oracle_of

    case = CASES[name]
    problem = case(n, seed, args.heights)
    n = len(problem.heights)
    place = {"case": name, "n": n, "seed": seed, "demand": case.tolerance, "busy": args.busy}
    place["heights"] = case.checked(problem.heights, n, seed)
    made = compare(case, problem, programs, settings, args.repeats, memory=args.memory or args.growth)
    for row in made:
        row["oracle"] = oracle_of(case, row, n, seed)
        if args.busy and not row["seconds"] and row["disturbed"]:
            row["median"] = sorted(row["disturbed"])[len(row["disturbed"]) // 2]
    return [{**place, **row} for row in made]


def _write(file: Path | None, rows: list[dict[str, Any]]) -> None:
    if file is not None:
        with file.open("a", encoding="utf-8") as stream:
            stream.writelines(json.dumps(row) + "\n" for row in rows)


def _print(rows: list[dict[str, Any]]) -> None:
    from suite.rows import HEAD, table

    lines = [list(HEAD), *table(rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(HEAD) - 1)]
    for line in lines:
        print(
            "  ".join(
                [*(cell.ljust(width) for cell, width in zip(line, widths, strict=False)), line[-1]]
            ).rstrip()
        )


def _status(rows: list[dict[str, Any]]) -> int:
    """Return 1 where our answer keeps no contract or a certified one differs from it."""
    from suite.cases import CASES
    from suite.rows import REFERENCE, refusal

    reasons = [(row, refusal(row, CASES.get(row["case"]))) for row in rows if not row.get("extrapolated")]
    bad = [
        f"{row['case']}, n = {row['n']}, seed {row['seed']}: {row['program']}: {reason}"
        for row, reason in reasons
        if "differ" in reason or (row["program"] == REFERENCE and reason not in ("", "on a busy machine"))
    ]
    print(*bad, sep="\n")
    return 1 if bad else 0


def _programs(wanted: list[str] | None, folder: Path | None) -> tuple[list[Program], dict[str, str]]:
    """Return those that can be imported, roughcontact first, and why the others cannot."""
    there = names(folder)
    if unknown := set(wanted or ()) - set(there):
        raise SystemExit(f"unknown programs {', '.join(sorted(unknown))}; there are {', '.join(there)}")
    loaded = {
        name: load(name, folder) for name in there if wanted is None or name in wanted or name == there[0]
    }
    programs = [found for found in loaded.values() if isinstance(found, Program)]
    return programs, {name: found for name, found in loaded.items() if isinstance(found, str)}


def _too_slow(rows: list[dict[str, Any]], case: str, n: int, program: str, limit: float) -> bool:
    """Whether what `program` took for smaller grids of `case`, growing like n^3, promises more than `limit` seconds."""
    smaller = [
        (row["n"], row["median"])
        for row in rows
        if (row["case"], row["program"]) == (case, program) and row["median"]
    ]
    return any(seconds * (n / size) ** 3 > limit for size, seconds in smaller if size < n)


def _machine(threads: int) -> str:
    load_average = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"
    return (
        f"{platform.machine()}, {platform.system()}, {os.cpu_count()} cores of which {threads} are used, "
        f"Python {platform.python_version()}, load average before the start {load_average}"
    )


def _arguments(given: list[str] | None) -> argparse.Namespace:
    def numbers(text: str) -> list[int]:
        return [int(part) for part in text.split(",")]

    def words(text: str) -> list[str]:
        return [part for part in text.split(",") if part]

    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="run the cases")
    run.add_argument("--cases", default=None, help=f"names or first letters (default: {DEFAULT})")
    run.add_argument("--sizes", type=numbers, default=None, help="cells a side (default: 512)")
    run.add_argument(
        "--seeds", type=numbers, default=None, help="of cases with several (default: those of the case)"
    )
    run.add_argument(
        "--programs", type=words, default=None, help="beside ours (default: all that are installed)"
    )
    run.add_argument("--adapters", type=Path, help="a folder of yours with files peer_NAME.py")
    run.add_argument("--repeats", type=int, default=3, help="rounds of A B C (default: 3)")
    run.add_argument("--threads", type=int, default=min(2, os.cpu_count() or 1), help="for every program")
    run.add_argument("--limit", type=float, default=120.0, help="leave out what would take longer [s]")
    run.add_argument("--memory", action="store_true", help="also run each once alone, for its peak memory")
    run.add_argument(
        "--growth", action="store_true", help="1024 to 16384 cells a side, with memory; extrapolate the rest"
    )
    run.add_argument("--heights", type=Path, help="heights [m] of a case that takes a file")
    run.add_argument(
        "--busy", action="store_true", help="keep disturbed times; rows are marked and have no ratio"
    )
    run.add_argument("--rows", type=Path, help="also append each row to this file of JSON lines")
    show = commands.add_parser("table", help="print the table of rows")
    show.add_argument("rows", type=Path, nargs="+")
    show.add_argument("--csv", type=Path, help="also write it here")
    show.add_argument("--pictures", type=Path, help="also draw time against n and load into this folder")
    commands.add_parser("freeze", help="write what cases.toml states of surfaces").add_argument("cases")
    args = parser.parse_args(given)
    if args.command == "run":
        growth = args.growth
        args.cases = args.cases or (
            "aspher,flat-periodic" if growth else "challenge" if args.heights else DEFAULT
        )
        args.sizes = args.sizes or (list(GROWTH) if growth else [512])
        args.programs = args.programs or (["aspher"] if growth else None)
    return args


if __name__ == "__main__":
    sys.exit(main())
