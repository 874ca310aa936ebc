"""What the first call waits for: python benchmarks/first.py.

Seconds of a load on 256 x 256 cells in a new process, on a machine that has never seen the library (no machine code is
kept yet), in the next process, and beside both the same load again in the same process.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

PROCESS = """
import time
import numpy as np
import roughcontact as rc
rough = rc.self_affine(rc.Grid((256, 256), 1 / 256), 0.8, 0.01, np.random.default_rng(0))
seconds = []
for _ in range(4):
    start = time.perf_counter()
    rc.press(rough, 1.0, force=0.2 * 0.01)
    seconds.append(time.perf_counter() - start)
print(seconds[0], min(seconds[1:]))
"""


def main() -> None:
    print("| process | first load [s] | again [s] | waited for [s] |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        places = {"XDG_CACHE_HOME": folder, "LOCALAPPDATA": folder, "HOME": folder}
        for name in ("first on the machine", "second", "third"):
            run = [sys.executable, "-c", PROCESS]
            done = subprocess.run(run, env=os.environ | places, capture_output=True, text=True, check=True)
            first, again = map(float, done.stdout.split())
            print(f"| {name} | {first:.2f} | {again:.2f} | {first - again:.2f} |")


if __name__ == "__main__":
    main()
