"""How few products could do: linear solves on a known contact, by several preconditioners.

    python benchmarks/preconditioners.py [n] [--cases flat-periodic,flat-half]

A load finds its contact and solves on it; the second alone, from nothing to 1e-7 of a unit displacement, takes as many
products as are shown. Periodic cases only: A is known by its waves, A^-1 on the whole plane too.

* "symbol": the inverse on the whole plane, E* q/2 in waves, restricted to the contact; "stencil": that of the library,
  a sum over near cells (and blocks); "corrected": with the Schur correction of docs/concepts/method.md, (3), on the
  diagonal.
* "symbol, k steps of Jacobi": with the Schur complement of (2), where k steps of Jacobi solve for the cells outside.
* "spots": block Jacobi, the exact inverse of the matrix of each contact spot; of those above LARGEST cells "stencil".
* "balanced": a coarse solve with one unknown for each spot before and after it (balancing; Mandel, Commun. Numer.
  Meth. Eng. 9, 233, 1993); two more products a step, which are counted. Up to SPOTS spots.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import scipy.ndimage
import scipy.sparse
from suite.cases import CASES, chosen

import roughcontact as rc
from roughcontact.halfspace.operators.operator import capabilities
from roughcontact.halfspace.sums.local_inverse import DIAGONAL_CORRECTION
from roughcontact.kernels.active_cells import ActiveCells, with_margins

Array = npt.NDArray[np.float64]
Map = Callable[[Array], Array]

GOAL = 1e-7
MOST = 500
LARGEST = 600  # cells of a spot whose matrix is inverted
SPOTS = 2500  # unknowns of the coarse solve at most


class Contact:
    """The cells in contact of a case, and the sums over them."""

    def __init__(self, name: str, n: int) -> None:
        problem = CASES[name](n, 0)
        if not problem.periodic:
            raise ValueError(f"{name} is not periodic")
        surface = rc.Surface(problem.heights, rc.Grid((n, n), problem.spacing, periodic=True))
        solution = rc.press(surface, problem.modulus, force=problem.force)
        self.inside, self.load = solution.contact, solution.steps
        operator = rc.half_space(surface.grid, problem.modulus)
        self.unit = np.zeros((n, n))
        self.unit[0, 0] = 1.0
        self.influence = operator.apply(self.unit)
        waves = np.fft.rfft2(self.influence).real
        waves[0, 0] = 2 * waves[0, 1]  # any: the mean pressure moves nothing
        self.plane_inverse = by_waves(1 / waves)
        self.apply, self.symbol = map(self.restricted, (by_waves(waves), self.plane_inverse))
        local = capabilities(operator).local_inverse()
        assert local is not None
        everywhere = ActiveCells(np.ones((n, n)))
        self.stencil: Map = lambda r: np.array(local.on(everywhere, with_margins(1.0 * self.inside * r)))

    def restricted(self, whole: Map) -> Map:
        """Return a map of the plane on the contact."""
        return lambda r: self.inside * whole(self.inside * r)

    def corrected(self, inverse: Map) -> Map:
        """Return an inverse with the Schur correction on the diagonal (docs/concepts/method.md, (3))."""
        taken = DIAGONAL_CORRECTION * self.inside * inverse(np.ones(self.inside.shape))
        return lambda r: self.inside * inverse(r) - taken * r

    def by_jacobi(self, steps: int) -> Map:
        """Return the symbol less Q_FO Q_OO^-1 Q_OF, Jacobi steps for Q_OO^-1 (docs/concepts/method.md, (2))."""
        whole, outside = self.plane_inverse, ~self.inside
        diagonal = whole(self.unit)[0, 0]

        def inverse(r: Array) -> Array:
            answer = whole(self.inside * r)
            y = np.zeros_like(r)
            for _ in range(steps):
                y += outside * (answer - whole(y)) / diagonal
            return self.inside * (answer - whole(y))

        return inverse

    def spots(self) -> tuple[Map, scipy.sparse.csc_array]:
        """Return the inverse spot by spot, and the pressure of each under a unit displacement of it, as columns."""
        labels, count = scipy.ndimage.label(self.inside, np.ones((3, 3)))  # cut at the edges of the period
        cells, n = np.flatnonzero(labels), len(labels)
        order = cells[np.argsort(labels.ravel()[cells], kind="stable")]
        parts = np.split(order, np.cumsum(np.bincount(labels.ravel())[1:])[:-1])
        inverses, columns, large = [], np.zeros(n * n), np.zeros(n * n, dtype=bool)
        for part in parts:
            if len(part) > LARGEST:
                large[part] = True
                continue
            y, x = np.divmod(part, n)
            matrix = self.influence[np.subtract.outer(y, y) % n, np.subtract.outer(x, x) % n]
            inverses.append((part, np.linalg.inv(matrix)))
            columns[part] = inverses[-1][1].sum(axis=1)
        big = large.reshape(n, n).astype(np.float64)
        taken = DIAGONAL_CORRECTION * self.stencil(big)
        columns[large] = ((self.stencil(big) - taken) * big).ravel()[large]

        def inverse(r: Array) -> Array:
            answer = (big * (self.stencil(big * r) - taken * r)).ravel()
            for part, each in inverses:
                answer[part] = each @ r.ravel()[part]
            return answer.reshape(n, n)

        where = labels.ravel()[order] - 1
        return inverse, scipy.sparse.csc_array((columns[order], (order, where)), shape=(n * n, count))

    def balanced(self, inverse: Map, columns: scipy.sparse.csc_array) -> Map:
        """Return an inverse between two coarse solves, for one unknown of each spot."""
        shape, count = self.inside.shape, columns.shape[1]
        small = np.empty((count, count))
        for k in range(count):
            small[:, k] = columns.T @ self.apply(columns[:, [k]].toarray().reshape(shape)).ravel()
        solve = np.linalg.inv(small)

        def coarse(r: Array) -> Array:
            return (columns @ (solve @ (columns.T @ r.ravel()))).reshape(shape)

        def both(r: Array) -> Array:
            first = coarse(r)
            z = inverse(r - self.apply(first))
            return first + z - coarse(self.apply(z))

        return both

    def steps(self, inverse: Map) -> int:
        """Return the steps of conjugate gradients, each with one product, from nothing to the goal."""
        r = self.inside.astype(np.float64)
        z = inverse(r)
        s, rz = z, float(np.vdot(r, z))
        for step in range(1, MOST):
            q = self.apply(s)
            r = r - rz / np.vdot(s, q) * q
            if np.abs(r).max() < GOAL:
                return step
            z = inverse(r)
            before, rz = rz, float(np.vdot(r, z))
            s = z + rz / before * s
        raise RuntimeError(f"not within {MOST} steps")


def by_waves(waves: Array) -> Map:
    """Return the map of a plane that multiplies its waves."""
    return lambda r: np.fft.irfft2(np.fft.rfft2(r) * waves, r.shape)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("n", type=int, nargs="?", default=512)
    parser.add_argument("--cases", default="flat-periodic,flat-half")
    asked = parser.parse_args()
    for name in chosen(asked.cases):
        contact = Contact(name, asked.n)
        spots, columns = contact.spots()
        ways = {
            "none": lambda r: r,
            "symbol": contact.symbol,
            "symbol, corrected": contact.corrected(contact.symbol),
            "symbol, 1 step of Jacobi": contact.by_jacobi(1),
            "symbol, 4 steps of Jacobi": contact.by_jacobi(4),
            "stencil, corrected (the library's)": contact.corrected(contact.stencil),
            "spots": spots,
        }
        found = {way: str(contact.steps(inverse)) for way, inverse in ways.items()}
        if columns.shape[1] <= SPOTS:
            for way in ("spots", "symbol, corrected"):
                steps = contact.steps(contact.balanced(ways[way], columns))
                found[f"{way}, balanced"] = f"{steps} steps, {3 * steps}"
        print(f"{name}, {asked.n}^2, {contact.inside.mean():.0%} in contact, {columns.shape[1]} spots:")
        print(f"  a whole load to 1e-8, after those on coarser cells: {contact.load}")
        print(*(f"  {way}: {count}" for way, count in found.items()), sep="\n", flush=True)


if __name__ == "__main__":
    main()
