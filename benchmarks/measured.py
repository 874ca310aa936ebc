"""What a curve makes of measured files, as a user calls it: python benchmarks/measured.py FOLDER --out DIR.

For every file of a folder `roughcontact curve` is run without loads; the table says what the map is, how many loads are
resolved over which factor of force, how long it took and what was noted. Pictures are left in DIR.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

# What users add when a file is refused for what it leaves open.
ADDED = {"--unit": "nm", "--size": "10um", "--profile": "line"}
KIND = re.compile(r"the (?:map|profile) is ([^;:]+)[;:]")
DULL = ("the tilt is removed", "are in ", "no loads are named", "for pictures")


def run(file: Path, folder: Path, words: list[str]) -> tuple[subprocess.CompletedProcess[str], float]:
    """Run a curve on a file; return what it said, and the seconds it took."""
    begin = time.perf_counter()
    command = [
        sys.executable,
        "-m",
        "roughcontact",
        "curve",
        str(file),
        "--json",
        "--out",
        str(folder),
        *words,
    ]
    answer = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    return answer, time.perf_counter() - begin


def row(file: Path, out: Path, words: list[str]) -> str:
    """Return a line of the table."""
    folder = out / file.name
    more: list[str] = []
    while True:
        answer, seconds = run(file, folder, [*words, *more])
        asked = [name for name in ADDED if name in answer.stderr and name not in more]
        if answer.returncode != 2 or not asked:
            break
        more += [word for name in asked for word in (name, ADDED[name])]
    added = f" (with {' '.join(more)})" if more else ""
    said = [line.removeprefix("Note: ") for line in answer.stderr.splitlines() if line.startswith("Note: ")]
    kind = next((found[1] for line in said if (found := KIND.search(line))), "-")
    if answer.returncode not in (0, 1):
        return f"| {file.name}{added} | refused | | | {seconds:.1f} | {answer.stderr.splitlines()[-1]} |"
    curve = json.loads(answer.stdout)
    force, resolved = np.array(curve["force"]), np.array(curve["resolved"], dtype=bool)
    span = f"{force[resolved].max() / force[resolved].min():.2g}" if resolved.any() else "-"
    notes = " / ".join(line for line in said if not any(word in line for word in DULL))
    return f"| {file.name}{added} | {kind} | {resolved.sum()} of {force.size} | {span} | {seconds:.1f} | {notes} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--modulus", default="100GPa")
    given, words = parser.parse_known_args()
    print("| file | the map is | resolved | over a factor of force | s | noted |")
    print("|---|---|---|---|---|---|")
    for file in sorted(given.folder.iterdir()):
        if file.name != "MANIFEST.csv":
            print(row(file, given.out, ["--modulus", given.modulus, *words]), flush=True)


if __name__ == "__main__":
    main()
