"""The way of one load through the package: from which file to which, and how often.

    python benchmarks/path.py [n]

A small rough surface with a few cells in contact (by default 64 x 64 cells, one of them in contact) is pressed twice;
the calls of the second press are traced. Printed are the number of files that it passes through, how often a call is
made in another file than the call before, and the way: each file in the order in which it is first entered, with the
files of the next calls.
"""

from __future__ import annotations

import sys
from collections import Counter
from itertools import pairwise
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

import roughcontact as rc

ROOT = Path(rc.__file__).parent


def traced(n: int) -> list[str]:
    """Return the file of each function of the package that a press calls, in the order of the calls."""
    surface = rc.self_affine(rc.Grid((n, n), 1 / n), 0.8, 0.01, np.random.default_rng(0))
    files: list[str] = []

    def note(frame: FrameType, event: str, _: Any) -> None:
        name = frame.f_code.co_filename
        if event == "call" and name.startswith(str(ROOT)):
            files.append(str(Path(name).relative_to(ROOT)))

    rc.press(surface, 1.0, force=1e-6)  # what is made once is made now
    sys.setprofile(note)
    try:
        solution = rc.press(surface, 1.0, force=1e-6)
    finally:
        sys.setprofile(None)
    print(f"{n} x {n} cells, {int(solution.contact.sum())} in contact")
    return files


def main(n: int) -> None:
    files = traced(n)
    changes = [(a, b) for a, b in pairwise(files) if a != b]
    print(f"{len(set(files))} files, {len(changes)} changes of file between {len(files)} calls")
    to = Counter(changes)
    for file in dict.fromkeys(files):
        others = ", ".join(f"{b} {count}" for (a, b), count in to.items() if a == file)
        print(f"{file:44s} {files.count(file):3d} calls; then {others or 'nothing'}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
