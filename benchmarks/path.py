"""The way of one load through the package: from which file to which, and how often.

    python benchmarks/path.py [n]

A small rough surface with a few cells in contact (by default 64 x 64 cells, one of them in contact) is pressed twice;
then a curve of six loads, from this one to a thousand times as much, is computed twice. The calls of the second time
are traced. Printed are the number of files that they pass through, how often a call is made in another file than the
call before, and the way of the press: each file in the order in which it is first entered, with the files of the next
calls.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

import roughcontact as rc

ROOT = Path(rc.__file__).parent
FORCE = 1e-6


def traced(task: Callable[[], object]) -> list[str]:
    """Return the file of each function of the package that a task calls the second time, in the order of the calls."""
    files: list[str] = []

    def note(frame: FrameType, event: str, _: Any) -> None:
        name = frame.f_code.co_filename
        if event == "call" and name.startswith(str(ROOT)):
            files.append(str(Path(name).relative_to(ROOT)))

    task()  # what is made once is made now
    sys.setprofile(note)
    try:
        task()
    finally:
        sys.setprofile(None)
    return files


def changes_of_file(files: list[str]) -> list[tuple[str, str]]:
    """Return the files before and after each call that is made in another file than the one before."""
    return [(a, b) for a, b in pairwise(files) if a != b]


def tasks(n: int) -> dict[str, Callable[[], object]]:
    """Return what is traced, by name."""
    surface = rc.self_affine(rc.Grid((n, n), 1 / n), 0.8, 0.01, np.random.default_rng(0))
    forces = FORCE * np.geomspace(1, 1e3, 6)
    return {
        "a press": lambda: rc.press(surface, 1.0, force=FORCE),
        "a curve of six loads": lambda: rc.loading_curve(surface, 1.0, forces=forces),
    }


def main(n: int) -> None:
    ways = {name: traced(task) for name, task in tasks(n).items()}
    for name, files in ways.items():
        changes = len(changes_of_file(files))
        print(
            f"{n} x {n} cells, {name}: {len(set(files))} files, {changes} changes of file, {len(files)} calls"
        )
    way = ways["a press"]
    to = Counter(changes_of_file(way))
    for file in dict.fromkeys(way):
        others = ", ".join(f"{b} {count}" for (a, b), count in to.items() if a == file)
        print(f"{file:44s} {way.count(file):3d} calls; then {others or 'nothing'}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
