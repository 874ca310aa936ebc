"""User seconds of a bare ``roughcontact press`` from the shell, beside another build.

    python benchmarks/shell.py [SRC]

A rough surface of 64 x 64 cells is pressed ten times by this build and, in alternation, by the one in the folder SRC
(the ``src`` of another checkout). Printed are the minimum and the median of each.
"""

import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import roughcontact as rc

REPEATS = 10
OWN = str(Path(rc.__file__).parents[1])


def user_seconds(source: str, file: Path) -> float:
    words = ["press", str(file), "--force", "1N", "--modulus", "110GPa"]
    before = os.times().children_user
    subprocess.run(
        [sys.executable, "-m", "roughcontact", *words],
        env=os.environ | {"PYTHONPATH": source},
        check=True,
        capture_output=True,
    )
    return os.times().children_user - before


def main() -> None:
    sources = [OWN, *sys.argv[1:2]]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "part.npz"
        rc.write(rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, np.random.default_rng(0)), file)
        for source in sources:
            user_seconds(source, file)  # fills the caches
        seconds: dict[str, list[float]] = {source: [] for source in sources}
        for _ in range(REPEATS):
            for source in sources:
                seconds[source].append(user_seconds(source, file))
    for source, values in seconds.items():
        print(f"{source}: {min(values):.3f} s at least, {statistics.median(values):.3f} s in the median")


if __name__ == "__main__":
    main()
