"""Peak memory of a solve beyond its surface, in bytes a cell (on Linux), beside what `memory_needed` says of it.

python benchmarks/memory.py [n [case]]
"""

import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import roughcontact as rc

CASES = {
    "free, light contact": (False, "press", 1e-9),
    "periodic, light contact": (True, "press", 1e-9),
    "free, full contact": (False, "press", 100.0),
    "free, fractal": (False, "press", 0.046),
    "free, fractal, curve": (False, "curve", 0.07),
    "periodic, full contact": (True, "press", 100.0),
    "periodic, half in contact": (True, "press", 3.0),
    "periodic, half, curve": (True, "curve", 3.0),
    "periodic, waves of 8 cells": (True, "press", 2.0),
}


def peak() -> int:
    found = re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text())
    assert found is not None
    return int(found[1]) * 1024


def measure(case: str, n: int) -> None:
    periodic, verb, load = CASES[case]
    small = rc.self_affine(rc.Grid((16, 16), 1 / 16, periodic), 0.8, 0.01, np.random.default_rng(0))
    rc.loading_curve(small, 1.0, forces=[1e-5, 1e-4])  # whatever is loaded late is loaded now
    waves = {"long_cutoff": 0.25, "short_cutoff": 8 / n} if "waves" in case else {}
    surface = rc.self_affine(rc.Grid((n, n), 1 / n, periodic), 0.8, 0.01, np.random.default_rng(0), **waves)
    Path("/proc/self/clear_refs").write_text("5")  # what the making of the surface took does not count
    before = peak()
    start = time.perf_counter()
    if verb == "press":
        residual = rc.press(surface, 1.0, force=load * 0.01).residual
    else:
        residual = rc.loading_curve(surface, 1.0, forces=np.geomspace(1e-4, load, 20) * 0.01).residual.max()
    seconds = time.perf_counter() - start
    used, whole = peak() - before, peak()
    told = rc.memory_needed(surface, 1.0, force=load * 0.01, curve=verb == "curve")
    print(
        f"{case:28s} {used / n**2:7.0f} bytes a cell ({told / n**2:.0f}), {whole / 2**20:6.0f} MB in all"
        f", residual {residual:.0e}, {seconds:.1f} s"
    )


if __name__ == "__main__":
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
    if len(sys.argv) > 2:
        measure(sys.argv[2], n)
    else:
        for case in CASES:
            subprocess.run([sys.executable, __file__, str(n), case], check=True)
