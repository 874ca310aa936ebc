"""Three hundred contact problems, and what they were answered: `python tests/references.py` stores it.

Two hundred loads over all operators, forty loops under a hardness and sixty paths of surfaces that stick. A change of
method must not change an answer. Surfaces are made here, by NumPy alone, so that no change of how the library makes
surfaces moves them.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

import roughcontact as rc
from roughcontact.contact.press import solve
from roughcontact.contact.problem import ContactProblem

STORE = Path(__file__).with_name("references.npz")
LOADS, LOOPS, PATHS = range(200), range(200, 240), range(240, 300)
TOLERANCE = 1e-12  # of the loads; loops and paths have that of the library
MODULUS = 2.5


def rough(shape, hurst, rng):
    """Return separations of a self-affine surface or line, of one rms height."""
    q = np.sqrt(sum(np.meshgrid(*[np.fft.fftfreq(n) ** 2 for n in shape], indexing="ij")))
    q.flat[0] = np.inf
    heights = np.real(np.fft.ifftn(np.fft.fftn(rng.standard_normal(shape)) * q ** -(hurst + len(shape) / 2)))
    heights /= heights.std()
    return heights.max() - heights


def plane(periodic):
    def make(rng):
        shape = tuple(int(n) for n in rng.integers(12, 72, 2))
        return rc.half_space(rc.Grid(shape, tuple(rng.uniform(0.5, 2, 2)), periodic), MODULUS)

    return make


def layer(base):
    def make(rng):
        n = int(rng.integers(16, 40))
        body = rc.Solid(MODULUS, rng.uniform(0, 0.45))
        return rc.layer(rc.Grid((n, n), 1.0, bool(rng.integers(2))), body, rng.uniform(1, 20), base=base)

    return make


def line(periodic):
    return lambda rng: rc.line(rc.Grid(int(rng.integers(20, 900)), 0.5, periodic), MODULUS)


def rings(rng):
    return rc.ring(rc.RadialGrid(np.cumsum(rng.uniform(0.1, 2, int(rng.integers(20, 200))))), MODULUS)


def singly_periodic(rng):
    return rc.singly_periodic(rc.Grid((24, int(rng.integers(12, 40))), 1.0, (True, False)), MODULUS)


OPERATORS = {
    "free": plane(False),
    "periodic": plane(True),
    "singly periodic": lambda rng: rc.singly_periodic(
        rc.Grid((24, int(rng.integers(12, 40))), 1.0, (True, False)), MODULUS
    ),
    "bonded layer": layer("bonded"),
    "layer": layer("rigid-frictionless"),
    "line": line(False),
    "periodic line": line(True),
    "rings": rings,
    "springs": lambda rng: rc.foundation(rc.Grid(int(rng.integers(20, 900)), 0.5), MODULUS),
    "large": lambda rng: rc.half_space(rc.Grid((180, 160), 1.0, bool(rng.integers(2))), MODULUS),
}


def problem(number):
    """Return a problem: operators in turn, from a few cells to half of them in contact, some missing, some hardness."""
    name = list(OPERATORS)[number % len(OPERATORS)]
    rng = np.random.default_rng([20, number])
    operator = OPERATORS[name](rng)
    shape = operator.grid.shape
    separation = rough(shape, rng.uniform(0, 1.2), rng)
    if rng.random() < 0.2:
        missing = rng.random(shape) < 0.1
        separation = np.where(missing & (separation > 0), np.inf, separation)
    known = separation[np.isfinite(separation)]
    depth = float(np.quantile(known, rng.uniform(0.002, 0.4)))
    if rng.random() < 0.5 and depth > 0:
        return name, ContactProblem(separation, operator, rc.Depth(depth), TOLERANCE)
    # What the cells that overlap would carry, if each were alone.
    own = float(operator.as_matrix(np.zeros(1, np.intp))[0, 0])
    alone = np.maximum(depth - separation, 0) / own
    force = rng.uniform(0.05, 0.3) * float(np.sum(operator.weights * alone)) + 1e-3
    hardness = 0.5 * float(alone.max()) if rng.random() < 0.15 else np.inf
    return name, ContactProblem(separation, operator, rc.Force(force), TOLERANCE, hardness=hardness)


def answer(number):
    """Return what a problem is answered: depth, force, stiffness on unloading and on loading, and the contact."""
    solution = solve(problem(number)[1])
    assert solution.status is rc.Status.CONVERGED, (number, solution)
    numbers = solution.depth, solution.force, solution.stiffness, solution.loading_stiffness
    return np.array(numbers), np.packbits(solution.contact)


def loop(number):
    """Return depths, forces, areas and stiffness of a loop under a hardness, and how many spots there are."""
    rng = np.random.default_rng([21, number])
    n, periodic = int(rng.integers(20, 48)), bool(number % 2)
    surface = rc.Surface(-rough((n, n + 4), rng.uniform(0.3, 1.2), rng), rc.Grid((n, n + 4), 1.0, periodic))
    largest = rng.uniform(0.02, 0.1) * MODULUS * n
    forces = largest * np.array([0.05, 0.2, 0.5, 1.0])
    flow = "removed" if rng.random() < 0.5 else "raised"
    given = {"forces": forces, "hardness": rng.uniform(0.1, 0.6) * MODULUS, "flow": flow}
    answered = rc.loading_loop(surface, MODULUS, **given)
    branches = answered.loading, answered.unloading, answered.reloading
    assert all(status is rc.Status.CONVERGED for branch in branches for status in branch.status), number
    rows = [[each.depth, each.force, each.contact_area, each.stiffness] for each in branches]
    return np.array(rows), np.array([each.spots for each in branches])


def path(number):
    """Return depths, forces and energies of a path of a surface that sticks; of its jumps direction, depth, bracket."""
    states = list(adhesive_path(number))
    assert all(state.status.converged for state in states), number
    jumps = [jump for state in states for jump in state.jumps]
    numbers = [[state.depth, state.force, state.energy, state.contact_area] for state in states]
    return np.array(numbers).T, np.array(
        [[jump.approach, jump.depth, jump.bracket] for jump in jumps]
    ).reshape(-1, 3)


def adhesive_path(number) -> Iterator[rc.AdhesiveState]:
    """Yield the states of an approach and a retreat, under depths or, in one path of four, forces."""
    rng = np.random.default_rng([22, number])
    law = ["exponential", "dugdale"][number % 2]
    reach = rng.uniform(0.2, 0.4)
    adhesion = rc.Adhesion(work=MODULUS * reach**2 / (np.pi * rng.uniform(1.5, 2.2)), range=reach, law=law)
    if number % 3 == 0:
        rings = rc.RadialGrid.uniform(int(rng.integers(20, 50)), radius=20.0)
        surface = rc.RadialProfile(-(rings.radii**2) / rng.uniform(60, 300), rings)
    else:
        n = int(rng.integers(16, 28))
        heights = smooth(n, rng) * rng.uniform(0.1, 0.6)
        surface = rc.Surface(heights - heights.max(), rc.Grid((n, n), 1.0, number % 3 == 1))
    deepest = rng.uniform(0.1, 0.6) * (0.5 if surface.grid.ndim == 1 else -surface.heights.mean())
    if number % 4 == 0:
        loads = {"forces": np.array([0.0, 0.5, 2.0, 0.5, 0.0, -0.05, -1.0]) * MODULUS}
    else:
        near = np.linspace(-10 * reach, deepest, 6)
        loads = {"depths": np.r_[near, near[-2::-1]]}
    yield from rc.adhesive_path(surface, MODULUS, adhesion, **loads)


def smooth(n, rng):
    """Return heights of rms 1 with waves down to eight cells."""
    q = np.hypot(*np.meshgrid(np.fft.fftfreq(n), np.fft.fftfreq(n), indexing="ij"))
    gain = np.where((q > 0) & (q < 1 / 8), np.maximum(q, 2 / n) ** -1.8, 0.0)
    heights = np.fft.ifft2(gain * np.fft.fft2(rng.standard_normal((n, n)))).real
    return heights / heights.std()


KINDS = [(LOADS, answer), (LOOPS, loop), (PATHS, path)]


if __name__ == "__main__":
    fields = {}
    for numbers, answered in KINDS:
        for place in numbers:
            fields[f"numbers{place}"], fields[f"contact{place}"] = answered(place)
    np.savez_compressed(STORE, **fields)
