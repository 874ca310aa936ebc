"""Rows of runs, the contract that a row keeps before its time is compared, and the table."""

from __future__ import annotations

import csv
import json
import math
import statistics
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from suite.cases import CASES, Case

__all__ = ["HEAD", "extrapolated", "read_rows", "refusal", "table", "write_csv"]

Row = Mapping[str, Any]

REFERENCE = "roughcontact"
HEAD = (
    "case", "cells", "program", "time [s]", "ratio", "residual", "setting",
    "products", "preconditioners", "memory [MB]", "remark",
)  # fmt: skip


def refusal(row: Row, case: Case | None) -> str:
    """Return why a row takes no part in a ratio; empty if it does.

    The program has to end as converged, with the tolerance of the case and no looser one than it was given, with an
    answer that the suite certifies, and that agrees with the numbers of the case and with the reference.
    """
    demand = row["demand"] if case is None else case.tolerance
    if row.get("extrapolated"):
        return "extrapolated from " + " and ".join(str(n) for n in row["extrapolated"])
    if row["trouble"]:
        return str(row["trouble"])
    if row["status"] != "converged":
        return f"status: {row['status'] or 'not stated'}"
    if row["demand"] != demand:
        return f"tolerance: measured for {row['demand']:g}, the case demands {demand:g}"
    if row["effective"] is not None and row["effective"] > row["setting"] * (1 + 1e-9):
        return f"tolerance: the program loosened {row['setting']:.0e} to {row['effective']:.0e}"
    if row.get("residual") is None:
        return f"certificate: missing ({row.get('uncertified') or 'none was made'})"
    if not max(row["residual"], row["force_error"]) <= demand:
        return f"certificate: {max(row['residual'], row['force_error']):.0e}, the case demands {demand:g}"
    for name, (found, expected, within) in row["oracle"].items():
        least = 2 if name == "cells" else 0  # two cells may open or close within the tolerance
        if not abs(found - expected) <= max(within * abs(expected), least):
            return f"{name.replace('_', ' ')}: {found:.6g} instead of {expected:.6g}"
    return "" if row["seconds"] and not row.get("busy") else "on a busy machine"


def table(rows: Iterable[Row], cases: Mapping[str, Case] = CASES) -> list[list[str]]:
    """Return a line for each case, size and program, over all seeds.

    The ratio is the program's time over the reference's on the same problem: its median over the seeds, and in
    brackets the lowest over the seeds of medians and of fastest rounds.
    """
    lines = []
    rows = sorted(rows, key=_place)
    for (name, n), group in groupby(rows, key=lambda row: (row["case"], row["n"])):
        together = list(group)
        refused = {_key(row): refusal(row, cases.get(name)) for row in together}
        ours = {
            row["seed"]: row for row in together if row["program"] == REFERENCE and not refused[_key(row)]
        }
        for program in dict.fromkeys(row["program"] for row in together):
            mine = [row for row in together if row["program"] == program]
            lines.append(
                [name, f"{n}^2", program, *_numbers(mine, ours, [refused[_key(row)] for row in mine])]
            )
    return lines


def _key(row: Row) -> tuple[str, int]:
    return row["program"], row["seed"]


def _place(row: Row) -> tuple[Any, ...]:
    names = list(CASES)
    where = names.index(row["case"]) if row["case"] in CASES else len(names)
    return where, row["case"], row["n"], row["program"] != REFERENCE, row["program"], row["seed"]


def _numbers(rows: Sequence[Row], ours: Mapping[int, Row], reasons: Sequence[str]) -> list[str]:
    times = [row["median"] for row in rows if row["median"] is not None]
    remark = "; ".join(dict.fromkeys(filter(None, reasons)))
    ratio = ""
    if not remark and all(row["seed"] in ours for row in rows) and rows[0]["program"] != REFERENCE:
        own = [ours[row["seed"]] for row in rows]
        medians = [row["median"] / mine["median"] for row, mine in zip(rows, own, strict=True)]
        lowest = [min(row["seconds"]) / min(mine["seconds"]) for row, mine in zip(rows, own, strict=True)]
        ratio = f"{statistics.median(medians):.3g} ({min(*medians, *lowest):.3g})"
    elif not remark and rows[0]["program"] != REFERENCE:
        remark = f"nothing to compare with: see {REFERENCE}"
    return [
        f"{statistics.median(times):.3g}" if times else "",
        ratio,
        _worst(rows, "residual", ".0e"),
        _worst(rows, "setting", ".0e", min),
        _worst(rows, "products", "d"),
        _worst(rows, "preconditioners", "d"),
        _worst(rows, "memory", ".0f"),
        remark,
    ]


def _worst(rows: Sequence[Row], key: str, form: str, pick: Any = max) -> str:
    values = [row[key] for row in rows if row.get(key) is not None and math.isfinite(row[key])]
    return f"{pick(values):{form}}" if values else ""


def extrapolated(rows: Sequence[Row], sizes: Sequence[int]) -> list[dict[str, Any]]:
    """Return rows for the sizes that no run reached, by the power law of time and memory of the two largest runs."""
    made = []
    measured = [row for row in rows if row["median"] is not None]
    for case, program in dict.fromkeys((row["case"], row["program"]) for row in measured):
        mine = {row["n"]: row for row in measured if (row["case"], row["program"]) == (case, program)}
        if len(mine) < 2:
            continue
        a, b = sorted(mine)[-2:]
        for n in (n for n in sizes if n > b):
            row = {**mine[b], "n": n, "extrapolated": [a, b], "residual": None, "products": None}
            row |= {"preconditioners": None, "seconds": [], "setting": None}
            for key in ("median", "memory"):
                low, high = mine[a][key], mine[b][key]
                row[key] = (
                    None
                    if None in (low, high)
                    else high * (n / b) ** (math.log(high / low) / math.log(b / a))
                )
            made.append(row)
    return made


def read_rows(files: Iterable[Path]) -> list[dict[str, Any]]:
    """Return the rows of files of JSON lines; of two rows of one run the later one stays."""
    found: dict[tuple[Any, ...], dict[str, Any]] = {}
    for file in files:
        for line in file.read_text(encoding="utf-8").splitlines():
            row = json.loads(line)
            found[row["case"], row["n"], row["seed"], row["program"]] = row
    return list(found.values())


def write_csv(lines: Iterable[Sequence[str]], file: Path) -> None:
    """Write the table as the documentation shows it."""
    with file.open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows([HEAD, *lines])
