"""What certifies an answer of each kind; nothing of roughcontact is used."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import scipy.sparse
import scipy.sparse.csgraph
import scipy.sparse.linalg

from suite.cases import Array, Problem
from suite.certificate import Certificate, Judge

__all__ = ["FIELDS", "Judged", "judge_of"]

Judged = Callable[[Mapping[str, Any]], Certificate]

FIELDS = {"normal": "pressure", "plasticity": "pressure", "adhesion": "gap", "flow": "transmissivity"}
CLOSED = 1e-9  # of the range: gaps that rounding leaves in contact
BYTES = {
    True: 60,
    False: 200,
}  # of a judge, per cell of a periodic or a free grid; 46 and 189 measured at 2048


def judge_of(kind: str, problem: Problem) -> Judged | str:
    """Return what certifies an answer, or why nothing can."""
    bytes_, available = BYTES[problem.periodic] * problem.heights.size, _available()
    if kind != "flow" and bytes_ > available:
        return f"its product needs {bytes_ / 1e9:.0f} GB, of which {available / 1e9:.0f} are free"
    return {"normal": _contact, "plasticity": _contact, "adhesion": _adhesion, "flow": _flow}[kind](problem)


def _available() -> float:
    """Return the free memory of the machine [bytes]; infinite where the system does not state it."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return 1024.0 * next(int(line.split()[1]) for line in lines if line.startswith("MemAvailable"))
    except (OSError, StopIteration):
        return float("inf") if os.name else 0.0


def _judge(problem: Problem) -> Judge:
    ny, nx = problem.heights.shape
    return Judge((ny, nx), problem.spacing, problem.periodic, problem.modulus)


def _contact(problem: Problem) -> Judged:
    """Certify a pressure: gaps under it, penetration elsewhere, the force, and the hardness where there is one."""
    judge = _judge(problem)
    return lambda answer: judge.certify(
        problem.heights, np.asarray(answer["pressure"]), problem.force, hardness=problem.hardness
    )


def _adhesion(problem: Problem) -> Judged:
    """Certify a gap: the traction that it needs is the attraction where open, and no more than it in contact."""
    judge = _judge(problem)

    def certified(answer: Mapping[str, Any]) -> Certificate:
        gap = np.asarray(answer["gap"])
        closed = gap <= CLOSED * problem.range
        gap = np.where(closed, 0.0, gap)
        most = problem.work / problem.range
        # The pressure of the displacement, but for its mean, which is the nominal pressure, plus the attraction.
        level = judge.pressure(gap + problem.heights) + most * np.exp(-gap / problem.range)
        lowest, highest = level[~closed].min(), level[~closed].max()
        deepest = level[closed].min() if closed.any() else highest  # a wall pushes only
        middle = (highest + min(lowest, deepest)) / 2
        residual = max(highest - middle, middle - min(lowest, deepest)) / most
        return Certificate(
            float(residual), float(abs(gap.mean() / problem.mean_gap - 1)), int(closed.sum()), np.nan
        )

    return certified


def _flow(problem: Problem) -> Judged:
    """Certify a transmissivity along axis 0 by a direct solve of the same network."""
    assert problem.gap is not None
    expected, cells = transmissivity(problem.gap), int((problem.gap == 0).sum())
    return lambda answer: Certificate(abs(float(answer["transmissivity"]) / expected - 1), 0.0, cells, np.nan)


def transmissivity(gap: Array) -> float:
    """Return the mean flux along axis 0 under a unit gradient of a periodic map, harmonic means at the faces."""
    cubes, index = gap**3, np.arange(gap.size).reshape(gap.shape)
    matrix = scipy.sparse.csr_matrix((gap.size, gap.size))
    source, conductances = np.zeros(gap.size), []
    for axis in (0, 1):
        beside = np.roll(cubes, -1, axis)
        with np.errstate(invalid="ignore"):
            c = np.where(cubes + beside > 0, 2 * cubes * beside / (cubes + beside), 0.0)
        here, there = index.ravel(), np.roll(index, -1, axis).ravel()
        links = scipy.sparse.coo_matrix((c.ravel(), (here, there)), matrix.shape)
        matrix = matrix + links + links.T
        conductances.append(c)
    # The unit gradient drives a flow through each face of axis 0; what it leaves over moves the pressure.
    source = (conductances[0] - np.roll(conductances[0], 1, 0)).ravel()
    matrix.eliminate_zeros()
    _, parts = scipy.sparse.csgraph.connected_components(matrix, directed=False)
    laplacian = scipy.sparse.diags(np.asarray(matrix.sum(1)).ravel()) - matrix
    free = np.ones(gap.size, bool)
    free[np.unique(parts, return_index=True)[1]] = False  # one cell of each part has no pressure
    shift = np.zeros(gap.size)
    shift[free] = scipy.sparse.linalg.spsolve(laplacian[free][:, free].tocsc(), source[free])
    shift = shift.reshape(gap.shape)
    return float((conductances[0] * (1 + np.roll(shift, -1, 0) - shift)).mean())
