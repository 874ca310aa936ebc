"""What single ideas do: products with the operator and processor seconds with and without each.

python benchmarks/ideas.py [n]
"""

import sys
import time
from dataclasses import dataclass, replace

import numpy as np

import roughcontact as rc
from roughcontact.halfspace.sums.particle_mesh import TileOperator
from roughcontact.kernels import loader
from roughcontact.solver import nested_iteration
from roughcontact.solver.inner_operator import FullGrid
from roughcontact.solver.nested_iteration import block_minimum

EXTRAS = (
    "positive",
    "submatrix",
    "coarsened",
    "approximate_inverse",
    "local_inverse",
    "single_precision",
    "single_convolution",
    "particle_mesh",
)
NOTHING = rc.Capabilities()


@dataclass(frozen=True)
class Without:
    """An operator that hides what it could do beyond the protocol, but for the names in `kept`."""

    inner: object
    kept: tuple

    def __getattr__(self, name):
        return getattr(self.inner, name)

    @property
    def capabilities(self):
        """Return what the operator states, with the default of each name that is not kept."""
        stated = replace(self.inner.capabilities, coarsened=self._coarsened)
        return replace(stated, **{name: getattr(NOTHING, name) for name in set(EXTRAS) - set(self.kept)})

    def restrict(self, window):
        """Return the operator of a window, which hides the same."""
        return Without(self.inner.restrict(window), self.kept)

    def _coarsened(self, grid):
        coarse = self.inner.capabilities.coarsened(grid)
        return None if coarse is None else Without(coarse, self.kept)


def cases(n):
    x = (np.arange(n) + 0.5) / n - 0.5
    a = np.sqrt(0.12 / np.pi)
    sphere = rc.Surface(-(x[:, None] ** 2 + x**2) / 2, rc.Grid((n, n), 1 / n))
    yield "sphere, 12 % in contact", sphere, 4 / 3 * a**3
    for periodic in (False, True):
        grid = rc.Grid((n, n), 1 / n, periodic)
        band = {"long_cutoff": 1 / 4, "short_cutoff": 8 / n}
        flat = rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(0), **band)
        slope = np.sqrt(sum(np.mean(d**2) for d in np.gradient(flat.heights, 1 / n)))
        yield f"nominally flat, {'periodic' if periodic else 'free'}", flat, 0.05 * slope
        if periodic:
            yield "nominally flat, periodic, heavily loaded", flat, 0.3 * slope
    for hurst, force in ((0.8, 1e-3), (0.8, 0.45), (-0.5, 0.01), (-1.0, 0.01)):
        rough = rc.self_affine(rc.Grid((n, n), 1 / n), hurst, 0.01, np.random.default_rng(0))
        yield f"fractal, H = {hurst}, {force}", rough, force * 0.01


def means(separation, factors):
    pad = [(0, -n % f) for n, f in zip(separation.shape, factors, strict=True)]
    padded = np.pad(separation, pad, mode="edge")
    blocks = padded.reshape([m for n, f in zip(padded.shape, factors, strict=True) for m in (n // f, f)])
    return blocks.mean(axis=tuple(range(1, blocks.ndim, 2)))


def measure(surface, force, kept, *changes):
    """Return products and seconds of one load, with changes of (where, name, what)."""
    extras = Without(rc.half_space(surface.grid, 1.0), kept)
    before = [getattr(where, name) for where, name, _ in changes]
    for change in changes:
        setattr(*change)
    try:
        rc.press(surface, 1.0, force=1e-3 * force, operator=extras)  # whatever is loaded late is loaded now
        start = time.process_time()
        solution = rc.press(surface, 1.0, force=force, operator=extras)
        return f"{solution.steps:4d} {time.process_time() - start:7.3f} s"
    finally:
        for (where, name, _), value in zip(changes, before, strict=True):
            setattr(where, name, value)


def main(n):
    def without(*names):
        return (tuple(name for name in EXTRAS if name not in names),)

    none = property(lambda driver: 0.0)
    variants = {
        "all": (EXTRAS,),
        "no inverse": without("approximate_inverse", "local_inverse", "particle_mesh"),
        "|q| by FFT": without("local_inverse"),
        "no Schur": (
            EXTRAS,
            (FullGrid, "diagonal_correction", none),
            (TileOperator, "diagonal_correction", none),
        ),
        "no window": without("positive"),
        "no list": without("submatrix"),
        "summits": (EXTRAS, (nested_iteration, "block_separation", block_minimum)),
        "means": (EXTRAS, (nested_iteration, "block_separation", means)),
        "no tiles": without("particle_mesh"),
        "double": without("single_precision", "particle_mesh"),
        "no machine": (EXTRAS, (loader, "is_available", lambda: False)),
    }
    print(f"{'products, seconds at n = ' + str(n):42s}" + "".join(f"{name:>16s}" for name in variants))
    for name, surface, force in cases(n):
        print(f"{name:42s}" + "".join(f"{measure(surface, force, *v):>16s}" for v in variants.values()))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 256)
