"""Time from heights to a certified pressure, here and in other programs, on surfaces of fixed seeds.

    python benchmarks/peers.py --cases fractal-0.8,sphere --sizes 256,512 --seeds 0,1 --peers tamaas,aspher

See README.md beside this file for what is measured and how the other programs are installed.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
from pathlib import Path

from programs import PEERS, Program, limit_threads, load


def main() -> int:
    args = _arguments()
    limit_threads(args.threads)
    # Only now: what these import reads the number of threads once.
    from cases import CASES, chosen
    from measure import compare
    from report import Row, print_rows, worst

    programs, hidden = _programs(args.peers)
    print(_machine(args.threads))
    for program in programs:
        print(f"{program.name} {program.version}: {program.adapter.SETTINGS}")
    for name, reason in hidden.items():
        print(f"{name}: not shown ({reason})")
    if not programs:
        return 1

    rows: list[Row] = []
    for case in chosen(args.cases):
        for n in args.sizes:
            settings: dict[str, float] = {}
            fits = [p for p in programs if not _too_slow(rows, case, n, p.name, args.limit)]
            for seed in args.seeds[:1] if case == "sphere" else args.seeds:
                print(f"{case}, n = {n}, seed {seed} ...", file=sys.stderr)
                entries = compare(CASES[case](n, seed), fits, settings, args.repeats)
                rows += [Row(case, n, seed, entry) for entry in entries]
            print_rows([row for row in rows if (row.case, row.n) == (case, n)])
            for name in sorted({p.name for p in programs} - {p.name for p in fits}):
                print(f"  {name}: not shown (would take longer than {args.limit:g} s)")
    if args.json or args.pictures:
        record = {"machine": _machine(args.threads), "programs": {p.name: p.version for p in programs}}
        record |= {"not_shown": hidden, "rows": [row.record() for row in rows]}
        if args.json:
            args.json.write_text(json.dumps(record, indent=1) + "\n")
        if args.pictures:
            from pictures import draw

            for path in draw(record, args.pictures):
                print(path)
    return worst(rows)


def _programs(names: list[str]) -> tuple[list[Program], dict[str, str]]:
    """Return those that can be imported, roughcontact first, and why the others cannot."""
    loaded = {name: load(name) for name in ["roughcontact", *names]}
    programs = [found for found in loaded.values() if isinstance(found, Program)]
    return programs, {name: found for name, found in loaded.items() if isinstance(found, str)}


def _too_slow(rows: list, case: str, n: int, program: str, limit: float) -> bool:
    """Whether what `program` took for smaller grids of `case`, growing like n^3, promises more than `limit` seconds."""
    smaller = [(row.n, row.entry.median) for row in rows if (row.case, row.entry.program) == (case, program)]
    return any(seconds * (n / size) ** 3 > limit for size, seconds in smaller if size < n)


def _machine(threads: int) -> str:
    load_average = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"
    return (
        f"{platform.machine()}, {platform.system()}, {os.cpu_count()} cores of which {threads} are used, "
        f"Python {platform.python_version()}, load average before the start {load_average}"
    )


def _arguments() -> argparse.Namespace:
    def numbers(text: str) -> list[int]:
        return [int(part) for part in text.split(",")]

    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--cases", default="fractal-0.8-0.046,flat-free,flat-periodic,sphere", help="first letters"
    )
    parser.add_argument("--sizes", type=numbers, default=[512], help="cells a side")
    parser.add_argument("--seeds", type=numbers, default=[0, 1, 2, 3, 4])
    parser.add_argument("--peers", type=lambda text: [p for p in text.split(",") if p], default=list(PEERS))
    parser.add_argument("--repeats", type=int, default=3, help="rounds of A B C (default: 3)")
    parser.add_argument("--threads", type=int, default=min(2, os.cpu_count() or 1), help="for every program")
    parser.add_argument("--limit", type=float, default=120.0, help="leave out what would take longer [s]")
    parser.add_argument("--json", type=Path, help="also write every measurement to this file")
    parser.add_argument("--pictures", type=Path, help="also draw time against n and load into this folder")
    args = parser.parse_args()
    if unknown := set(args.peers) - set(PEERS):
        parser.error(f"unknown peers {', '.join(sorted(unknown))}; there are {', '.join(PEERS)}")
    return args


if __name__ == "__main__":
    sys.exit(main())
