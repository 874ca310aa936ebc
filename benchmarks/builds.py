"""Two builds in turn, on equal heights: python benchmarks/builds.py OLD/src NEW/src [ROUNDS [CASE ...]].

For each case the median seconds of both, and of the ratios new over old of neighbouring processes the median, the
least and the largest. A process gives the fastest tenth of its repeats: what disturbs the machine only adds.
"""

from __future__ import annotations

import ast
import io
import os
import subprocess
import sys
import time
import tokenize
from pathlib import Path

import numpy as np

# Cells along a side, whether periodic, mean pressure over E*, loads, repeats.
CASES = {
    "64 free": (64, False, 1e-5, 1, 200),
    "64 periodic": (64, True, 1e-4, 1, 150),
    "256 free": (256, False, 1e-5, 1, 60),
    "256 periodic": (256, True, 1e-3, 1, 30),
    "256 free, curve": (256, False, 1e-4, 12, 4),
    "512 free": (512, False, 1e-4, 1, 20),
    "512 periodic": (512, True, 1e-4, 1, 10),
    "1024 free": (1024, False, 1e-4, 1, 5),
    "1024 periodic": (1024, True, 1e-4, 1, 4),
    "2048 periodic": (2048, True, 1e-3, 1, 3),
    "4096 periodic": (4096, True, 1e-3, 1, 2),
}
BARE = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER}


def seconds(case: str) -> float:
    """Return the time of a case in this process [s]; unit side, E* = 1, rms height 1e-3, H = 0.8."""
    import roughcontact as rc

    n, periodic, pressure, loads, repeats = CASES[case]
    # Builds draw other surfaces from one seed: these heights are made of NumPy's white noise.
    q = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
    q[0, 0] = np.inf
    waves = np.fft.rfft2(np.random.default_rng(1).standard_normal((n, n)))
    heights = np.fft.irfft2(waves / np.abs(waves) * q**-1.8, s=(n, n))
    surface = rc.Surface(heights * (1e-3 / heights.std()), rc.Grid((n, n), 1 / n, periodic=periodic))
    forces = np.geomspace(pressure / 100, pressure, loads)
    times = []
    for _ in range(repeats + 2):  # the first two find tables and kernels
        begin = time.perf_counter()
        if loads > 1:
            rc.loading_curve(surface, 1.0, forces=forces)
        else:
            rc.press(surface, 1.0, force=pressure)
        times.append(time.perf_counter() - begin)
    return float(np.quantile(times[2:], 0.1))


def lines(source: Path) -> tuple[int, int]:
    """Return how many files there are, and how many lines that are no docstring, comment or blank."""
    files, total = sorted(source.rglob("*.py")), 0
    for path in files:
        text, used = path.read_text(encoding="utf-8"), set()
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type not in BARE:
                used.update(range(token.start[0], token.end[0] + 1))
        for node in ast.walk(ast.parse(text)):
            if (
                isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
                and ast.get_docstring(node) is not None
            ):
                used -= set(range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1))
        total += len(used)
    return len(files), total


def main(builds: list[str], rounds: int, cases: list[str]) -> None:
    """Print the table."""
    for build in builds:
        print("{}: {} files, {} lines".format(build, *lines(Path(build))))
    for case in cases:
        times: dict[str, list[float]] = {build: [] for build in builds}
        for k in range(rounds):
            for build in builds if k % 2 else builds[::-1]:
                command = [sys.executable, __file__, "--one", case]
                environment = os.environ | {"PYTHONPATH": str(Path(build).resolve())}
                answer = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
                times[build].append(float(answer.stdout))
        old, new = (np.array(times[build]) for build in builds)
        ratio, words = new / old, f"{case:16} {1e3 * np.median(old):8.2f} {1e3 * np.median(new):8.2f} ms"
        print(f"{words}  {np.median(ratio):.2f} ({ratio.min():.2f} to {ratio.max():.2f})", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if sys.argv[1] == "--one":
        print(seconds(sys.argv[2]))
    else:
        main(sys.argv[1:3], int(sys.argv[3]) if len(sys.argv) > 3 else 9, sys.argv[4:] or list(CASES))
