"""The table: one line a program, over all seeds of a case and size."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Any

from measure import Entry
from programs import CERTIFICATE

__all__ = ["Row", "print_rows", "worst"]

HEAD = (
    f"{'program':18}{'time/s':>9}{'fastest':>9}{'slowest':>9}{'ratio':>8}{'lowest':>8}"
    f"{'cells':>18}{'residual':>10}{'pressure':>10}{'tolerance':>11}"
)


@dataclass(frozen=True, slots=True)
class Row:
    """One program on one problem."""

    case: str
    n: int
    seed: int
    entry: Entry

    def record(self) -> dict[str, Any]:
        """Return plain values for JSON."""
        entry, certificate = self.entry, self.entry.certificate
        values = {
            "case": self.case,
            "n": self.n,
            "seed": self.seed,
            "program": entry.program,
            "seconds": entry.seconds,
            "median": entry.median,
            "tolerance": entry.tolerance,
            "pressure_difference": entry.difference,
            "compared_at": entry.compared_at,
            "own_depth": entry.depth,
            "trouble": entry.trouble,
            "disturbed_seconds": entry.disturbed,
            "product_seconds": entry.product,
        }
        if certificate:
            values |= {
                name: getattr(certificate, name) for name in ("residual", "force_error", "cells", "depth")
            }
        return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in values.items()}


def print_rows(rows: list[Row]) -> None:
    """Print the table of one case and size.

    A ratio is the program's time over the reference's on the same problem: its median over the seeds, and
    the lowest over the seeds of medians and of fastest rounds. It is printed only where every seed was certified
    and its answers agree.
    """
    if not rows:
        return
    print(
        f"\n{rows[0].case}, n = {rows[0].n}, seeds {', '.join(str(s) for s in sorted({r.seed for r in rows}))}"
    )
    print(HEAD)
    ours = {row.seed: row.entry for row in rows if row.entry.program == rows[0].entry.program}
    for name in dict.fromkeys(row.entry.program for row in rows):
        mine = [row for row in rows if row.entry.program == name]
        print(_line(name, mine, ours))
        for row in mine:
            if row.entry.trouble:
                print(f"  seed {row.seed}: not compared, {row.entry.trouble}")
    products = [entry.median / entry.product for entry in ours.values()]
    print(f"{rows[0].entry.program} takes the time of {statistics.median(products):.0f} exact products")


def _line(name: str, rows: list[Row], ours: dict[int, Entry]) -> str:
    entries = [row.entry for row in rows]
    found = [entry.certificate for entry in entries if entry.certificate]
    cells = sorted({c.cells for c in found})
    span = "-" if not cells else f"{cells[0]}..{cells[-1]}" if len(cells) > 1 else str(cells[0])
    tail = (
        f"{span:>18}{max((c.residual for c in found), default=math.nan):>10.1e}"
        f"{max(entry.difference for entry in entries):>10.1e}{min(entry.tolerance for entry in entries):>11.1e}"
    )
    if any(entry.trouble or not entry.seconds for entry in entries):
        busy = "" if any(entry.trouble for entry in entries) else "  machine too busy to take a time"
        return f"{name:18}{'-':>9}{'-':>9}{'-':>9}{'-':>8}{'-':>8}{tail}{busy}"
    times = [entry.median for entry in entries]
    rounds = [seconds for entry in entries for seconds in entry.seconds]
    tail += (
        f"  {lost} disturbed rounds left out"
        if (lost := sum(len(entry.disturbed) for entry in entries))
        else ""
    )
    head = f"{name:18}{statistics.median(times):>9.3f}{min(rounds):>9.3f}{max(rounds):>9.3f}"
    if not all(ours[row.seed].seconds and not ours[row.seed].trouble for row in rows):
        return f"{head}{'-':>8}{'-':>8}{tail}"
    ratios = [entry.median / ours[row.seed].median for row, entry in zip(rows, entries, strict=True)]
    lowest = [
        min(entry.seconds) / min(ours[row.seed].seconds) for row, entry in zip(rows, entries, strict=True)
    ]
    return f"{head}{statistics.median(ratios):>8.2f}{min(*ratios, *lowest):>8.2f}{tail}"


def _error(entry: Entry) -> float:
    return entry.certificate.error if entry.certificate else 0.0


def worst(rows: list[Row]) -> int:
    """Return the exit status: 1 where our answer is not certified or a certified one differs from it."""
    troubles = [row for row in rows if row.entry.trouble]
    for row in troubles:
        print(f"{row.case}, n = {row.n}, seed {row.seed}: {row.entry.program}: {row.entry.trouble}")
    mine = any(row.entry.program == "roughcontact" for row in troubles)
    differ = any("differ" in row.entry.trouble for row in troubles)
    if not troubles:
        agree = (
            ", and all agree"
            if len({row.entry.program for row in rows}) > 1
            else "; there is nothing to compare with"
        )
        judged = {row.entry.program for row in rows if _error(row.entry) > CERTIFICATE}
        others = f", but those of {', '.join(sorted(judged))}" if judged else ""
        print(f"\nEvery answer shown is certified to {CERTIFICATE:.0e} by the same product{agree}{others}.")
    return 1 if mine or differ else 0
