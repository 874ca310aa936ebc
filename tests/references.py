"""Two hundred contact problems over all operators, and what they were answered: `python tests/references.py` stores it.

A change of method must not change an answer. Surfaces are made here, by NumPy alone, so that no change of how the
library makes surfaces moves them.
"""

from pathlib import Path

import numpy as np

import roughcontact as rc
from roughcontact.contact.press import solve
from roughcontact.contact.problem import ContactProblem

STORE = Path(__file__).with_name("references.npz")
COUNT = 200
TOLERANCE = 1e-12
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


if __name__ == "__main__":
    fields = {}
    for place in range(COUNT):
        fields[f"numbers{place}"], fields[f"contact{place}"] = answer(place)
    np.savez_compressed(STORE, **fields)
