"""Viscoelastic contact in time beside the Maxwell contact of Tamaas, on one periodic surface, in one run.

python benchmarks/viscoelastic_peer.py [cells]

The nominal pressure jumps at 0, is held for 1 s, and falls by a fifth in the next second. At 1 s the contact still
grows: its gap and area are those of an elastic contact with the modulus 1/J(1 s) (Lee and Radok), computed here to
1e-10. Pressures are compared with those of our steps with a tolerance of 1e-4. `relaxed` shows for which shear modulus
of its model the pressures of Tamaas relax to those of the spring: for 1. So this is the unit of stress.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from suite.programs import limit_threads

limit_threads(1)
import tamaas  # noqa: E402  # reads the number of threads once

import roughcontact as rc  # noqa: E402

tamaas.set_log_level(tamaas.LogLevel.error)
Array = npt.NDArray[np.float64]

ARMS, TAUS = [1.0, 1.0], [0.5, 4.0]  # shear moduli over that of the spring, and relaxation times [s]
# Poisson's ratio 0: the reduced modulus is twice the shear modulus.
MATERIAL = rc.Viscoelastic(2.0, [2 * arm for arm in ARMS], TAUS)
TIMES, SHARES, GROWN = [0.0, 0.0, 1.0, 2.0], [0.0, 1.0, 1.0, 0.8], 1.0
PRESSURE = 0.02
States = dict[float, tuple[Array, Array]]  # pressure and gap of each time


def surface(cells: int) -> rc.Surface:
    """Return heights on a period of 1 m."""
    grid = rc.Grid((cells, cells), 1 / cells, periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=0.01, rng=3, rolloff=0.25, short_cutoff=8 / cells)


def ours(face: rc.Surface, **settings: float) -> tuple[States, int]:
    """Return the states at 1 and 2 s and the number of steps."""
    states: States = {}
    count = -1
    pressures = [PRESSURE * share for share in SHARES]
    for state in rc.viscoelastic_path(face, MATERIAL, times=TIMES, pressures=pressures, **settings):
        count += 1
        if state.prescribed and state.time >= GROWN:
            states[state.time] = state.pressure, state.gap
    return states, count


def model_of(shape: tuple[int, ...], shear: float) -> tamaas.Model:
    """Return an elastic model with the shear modulus of the spring, and Poisson's ratio 0."""
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], list(shape))
    model.E, model.nu = 2 * shear, 0.0
    return model


def theirs(face: rc.Surface, each_second: int, tolerance: float) -> tuple[States, int]:
    """Return the same of Tamaas with steps of equal length."""
    model = model_of(face.heights.shape, 1.0)
    solver = tamaas.MaxwellViscoelastic(model, face.heights.copy(), tolerance, 1 / each_second, ARMS, TAUS)
    solver.max_iter = 10_000
    states: States = {}
    count = round(TIMES[-1] * each_second)
    for step in range(1, count + 1):
        now = step / each_second
        solver.solve(PRESSURE * float(np.interp(now, TIMES[2:], SHARES[2:])))
        if now in (GROWN, TIMES[-1]):
            states[now] = np.array(model.traction).reshape(face.heights.shape), np.zeros(0)
    return states, count


def grown(face: rc.Surface) -> rc.Solution:
    """Return the elastic contact with the gap at 1 s."""
    return rc.press(face, 1 / float(MATERIAL.creep()(GROWN)), pressure=PRESSURE, tolerance=1e-10)


def relaxed(shear: float) -> float:
    """Return the pressure of a wave after 40 relaxation times of Tamaas, over the exact one of full contact."""
    x = np.arange(16) / 16
    wave = 0.01 * np.cos(2 * np.pi * x)[:, None] * np.ones(16)
    model = model_of(wave.shape, shear)
    solver = tamaas.MaxwellViscoelastic(model, wave.copy(), 1e-12, 0.1, [shear], [1.0])
    for _ in range(400):
        solver.solve(shear)
    return float(np.ptp(model.traction) / (2 * shear * np.pi * np.ptp(wave)))


def main() -> None:
    """Print the table."""
    cells = int(sys.argv[1]) if len(sys.argv) > 1 else 256
    face = surface(cells)
    for shear in (1.0, 0.5, 2.0):
        print(
            f"Tamaas {tamaas.__version__}, shear modulus {shear:g}: relaxed wave {relaxed(shear):.4f} of the exact one"
        )
    exact = grown(face)
    best, count = ours(face, time_tolerance=1e-4)
    print(
        f"{cells} x {cells} cells, A/A0 {exact.contact_fraction:.4f} at 1 s; the reference takes {count} steps"
    )
    gap_error = np.abs(best[GROWN][1] - exact.gap).max() / exact.depth
    print(f"reference: gap differs from the elastic one by {gap_error:.1e} of the depth\n")
    rows: list[tuple[str, Callable[[], tuple[States, int]]]] = [
        ("roughcontact, time_tolerance=1e-2", lambda: ours(face, time_tolerance=1e-2)),
        ("roughcontact, time_tolerance=1e-3", lambda: ours(face, time_tolerance=1e-3)),
        ("roughcontact, steps=10", lambda: ours(face, steps=10)),
    ]
    rows += [
        (f"Tamaas, steps of 1/{each} s", lambda each=each: theirs(face, each, 1e-8)) for each in (10, 30, 100)
    ]
    print("| program | steps | CPU [s] | area at 1 s | pressure at 1 s | pressure at 2 s |")
    print("|---|---|---|---|---|---|")
    for name, call in rows:
        start = time.process_time()
        states, count = call()
        seconds = time.process_time() - start
        area = np.mean(states[GROWN][0] > 0) / exact.contact_fraction - 1
        off = [np.abs(states[t][0] - best[t][0]).sum() / best[t][0].sum() for t in (GROWN, TIMES[-1])]
        print(f"| {name} | {count} | {seconds:.1f} | {area:+.1e} | {off[0]:.1e} | {off[1]:.1e} |")


if __name__ == "__main__":
    main()
