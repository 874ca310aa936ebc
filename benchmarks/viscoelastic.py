"""Viscoelastic contact in time: cost of a step, memory of a term, balance of energy, errors on planes.

python benchmarks/viscoelastic.py cost 512     # 100 steps with five terms beside 100 loads of an elastic curve
python benchmarks/viscoelastic.py energy       # 200 random histories
python benchmarks/viscoelastic.py sphere 256   # a sphere on a plane under a held force and through a cycle of depth
"""

import sys
import time

import numpy as np

import roughcontact as rc

TERMS = rc.Viscoelastic(1.0, [1.0] * 5, np.geomspace(0.1, 1000.0, 5))
SOLID = rc.viscoelastic.standard_solid(1.0, 3.0, 1.0)


def rough(count, periodic, seed=3):
    grid = rc.Grid((count, count), 1 / count, periodic=periodic)
    shape = {"rolloff": 0.25, "short_cutoff": 8 / count}
    return rc.self_affine(grid, hurst=0.8, rms=0.01, rng=seed, **shape)


def timed(path):
    """Return the seconds, the products and the number of states of a path, whose fields are not kept."""
    start = time.perf_counter()
    counts = [getattr(state, "products", None) or state.steps for state in path]
    return (time.perf_counter() - start) / len(counts), np.mean(counts), len(counts)


def cost(count):
    """Print the time of a step beside that of a load."""
    for periodic in (True, False):
        surface, most = rough(count, periodic), 0.02
        load, count_of_load, _ = timed(
            rc.loading_path(surface, 1.0, pressures=np.geomspace(most / 6, most, 100))
        )
        print(f"periodic {periodic}: load {load:.3f} s, {count_of_load:.1f} products")
        given = {"times": np.r_[0, np.geomspace(0.01, 1e4, 100)], "pressures": np.full(101, most), "steps": 1}
        span = {"times": [0, 1e4], "pressures": [most, most], "time_tolerance": 1e-2}
        for words, history in (("fixed", given), ("adapted", span)):
            step, products, states = timed(rc.viscoelastic_path(surface, TERMS, **history))
            print(
                f"  {words}: {states} states, {step:.3f} s = {step / load:.2f} loads, {products:.1f} products"
            )
    print(f"  memory of a term: {2 * 8 * count**2 / 1e6:.1f} MB")


def energy():
    """Print the largest leak of energy, over the largest energy, in 200 random histories."""
    worst = least = 0.0
    for seed in range(200):
        rng, surface = np.random.default_rng(seed), rough(32, bool(seed % 2))
        count = int(rng.integers(2, 6))
        times = np.cumsum(rng.choice([0.0, 0.1, 1.0, 5.0], count))
        loads = rng.uniform(0, 1, count) * (rng.uniform(size=count) > 0.2)
        kind, scale = (("forces", 0.03), ("depths", 0.02))[seed // 2 % 2]
        material = (SOLID, TERMS)[seed // 4 % 2]
        path = rc.viscoelastic_path(
            surface, material, times=times, **{kind: loads * scale}, time_tolerance=1e-2
        )
        states = list(path)
        scale = max(state.stored_energy + state.dissipated_energy for state in states)
        if scale > 0:
            worst = max(worst, *(abs(state.energy_leak) / scale for state in states))
        least = max(least, states[-1].time_error)
        assert all(state.status.converged for state in states)
    print(f"largest leak {worst:.1e} of the energy, largest estimate {least:.1e}, tolerance 1e-2")


def sphere(count):
    """Print the errors on a plane: by time beside the elastic contact of the same grid, and all."""
    ball = rc.shapes.paraboloid(rc.Grid((count, count), 1.1 / count), radius=1.0)
    *_, held = rc.viscoelastic_path(ball, SOLID, times=[0, 1], forces=[0.1, 0.1])
    elastic = rc.press(ball, 1 / float(SOLID.creep()(1.0)), force=0.1)
    print(
        f"held force: depth {held.depth / 0.115343847208 - 1:.1e}, by time {held.depth / elastic.depth - 1:.1e}"
    )
    small = rc.shapes.paraboloid(rc.Grid((count, count), 0.25 / count), radius=1.0)
    path = rc.viscoelastic_path(small, SOLID, times=[0, 1, 1.4], depths=[0, 0.01, 0.006])
    _, top, back = (state for state in path if state.prescribed)
    for state, truth in ((top, 3.181015305682e-3), (back, 7.432398878284e-4)):
        print(f"depth up and down, t = {state.time:g}: force {state.force / truth - 1:.1e}")


if __name__ == "__main__":
    what, *size = sys.argv[1:]
    {"cost": cost, "energy": energy, "sphere": sphere}[what](*map(int, size))
