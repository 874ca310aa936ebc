"""One member of every ensemble of the law, on 64 cells a side, solved again by a program of its own.

The iteration of `law_peer.py` on the products of `certificate.py`, and stiffnesses from full matrices; rough lines by
bisection for the depth of their springs. Of roughcontact only the heights are used.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

import law_peer
import numpy as np
from law_ensembles import ROOT, STUDIES

sys.path.append(str(ROOT / "benchmarks"))  # of roughcontact
from suite.certificate import Judge

from roughcontact.grid import Grid
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.study.cases import find_case
from roughcontact.study.cases.curve_case import CurveParameters
from roughcontact.study.cases.patch_case import PatchParameters
from roughcontact.study.study import Study
from roughcontact.study.task import generator
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

POINTS = 64
# Which member: parameters beside the number of points.
MEMBERS: Mapping[str, Mapping[str, Any]] = MappingProxyType(
    {
        "e1-lines": {"hurst": 0.7, "lines": 3, "lowest_force": 7e-4},
        "e1-surfaces": {"hurst": 0.7},
        "e2-grids": {"hurst": 1.3, "short_cutoff": 1 / 16},
        "e3-modes": {"hurst": 0.1},
        "e4-models": {"hurst": 0.7, "amplitudes": "gaussian", "short_cutoff": 2 / POINTS},
        "e5-flat": {"rolloff": 0.25, "periodic": True, "highest_force": 0.4, "lowest_force": 4e-4},
        "e5-patches": {
            "points": 32,
            "period": 2,
            "rolloff": 0.25,
            "highest_force": 0.4,
            "lowest_force": 4e-4,
        },
        "e6-spheres": {},
        "e7-sizes": {"hurst": 0.4},
        "e8-border": {"hurst": 0.7, "crest": 0.0},
        "e8-cut": {"hurst": 0.7, "crest": 0.5},
    }
)


def member(name: str) -> tuple[CurveParameters, Any, Surface]:
    """Return parameters, record and surface of the first sample of an ensemble."""
    study = Study.read(STUDIES / f"{name}.toml")
    case = find_case(study.case)
    given = {key: each for key, each in study.parameters.items() if key not in ("points", "loads")}
    parameters: Any = case.parameters(**(given | {"points": POINTS, "loads": 4} | dict(MEMBERS[name])))
    record = case.run(parameters, generator(study.seed, 0))
    return parameters, record, pressed(parameters, generator(study.seed, 0))


def pressed(parameters: CurveParameters, rng: np.random.Generator) -> Surface:
    """Return the surface that a case presses."""
    if not isinstance(parameters, PatchParameters):
        return parameters.on_body(parameters.roughness(rng))
    n = parameters.points
    whole = parameters.roughness_on(parameters.whole, rng)
    patch = whole.heights[:n, :n]
    y, x = np.mgrid[:n, :n] - (n - 1) / 2
    tilt = (patch * y).sum() / (y**2).sum() * y + (patch * x).sum() / (x**2).sum() * x
    return Surface(patch - patch.mean() - tilt, parameters.grid)


def stiffnesses(judge: Judge, contact: Array, cell: float) -> tuple[float, float]:
    """Return k and K of a contact region, from its full matrix."""
    y, x = np.nonzero(contact)
    matrix = judge._table[y[:, None] - y, x[:, None] - x]
    unit = np.zeros(contact.shape)
    unit[contact] = np.linalg.solve(matrix, np.ones(len(y)))
    k = float(unit.sum()) * cell
    return k, k / (1 - float(judge.displacement(unit).mean()))


def springs_in_contact(heights: Array, force: float) -> float:
    """Return the part of a line's springs that carries a force F/(E* L), by bisection for the depth."""
    below = heights.max() - heights
    low, high = 0.0, force + float(below.max())
    for _ in range(200):  # to the last bit
        depth = (low + high) / 2
        low, high = (depth, high) if np.maximum(depth - below, 0).mean() < force else (low, depth)
    return float((below < high).mean())


def check_lines(name: str) -> list[str]:
    """Return the row of rough lines: k of the last line by both programs, and how far it differs at most."""
    study = Study.read(STUDIES / f"{name}.toml")
    case = find_case(study.case)
    given = dict(study.parameters) | {"points": POINTS, "loads": 4} | dict(MEMBERS[name])
    parameters: Any = case.parameters(**given)
    record = case.run(parameters, generator(study.seed, 0))
    grid = Grid(POINTS, 1 / POINTS, periodic=True)
    spectrum = SelfAffineSpectrum(parameters.hurst, dimension=1)
    blocks = rough_lines(grid, spectrum, generator(study.seed, 0), parameters.lines, rms=1.0)
    forces = record["dimensionless_force"].values
    found = np.array([[springs_in_contact(z, f) for f in forces] for block in blocks for z in block])
    mine = record["dimensionless_stiffness"].values
    worst = float(np.abs(found / mine - 1).max())
    return [name, f"{POINTS} springs", f"{mine[-1, -1]:.6f}", f"{found[-1, -1]:.6f}", _below(worst)]


def _below(worst: float) -> str:
    return f"below {10 ** np.ceil(np.log10(max(worst, 1e-9))):.0e}"


def check(names: Iterable[str] = tuple(MEMBERS)) -> list[list[str]]:
    """Return a row for every ensemble: k by both programs, and how far k, K and depth differ at most."""
    rows = []
    for name in names:
        if Study.read(STUDIES / f"{name}.toml").case == "lines":
            rows.append(check_lines(name))
            continue
        parameters, record, surface = member(name)
        cell = surface.grid.spacing[0] * surface.grid.spacing[1]
        judge = Judge(surface.grid.shape, surface.grid.spacing, parameters.periodic, parameters.modulus)
        worst = 0.0
        for load in (1, 2, 3):
            found = law_peer.pressed(judge.displacement, surface.heights, float(record["force"][load]), cell)
            depth = (judge.displacement(found) + surface.heights.max() - surface.heights)[found > 0].mean()
            k, interfacial = stiffnesses(judge, found > 0, cell)
            mine = {"stiffness": k, "interfacial_stiffness": interfacial, "depth": float(depth)}
            worst = max(worst, *(abs(one / float(record[name][load]) - 1) for name, one in mine.items()))
        scale = parameters.modulus * parameters.size
        both = f"{float(record['stiffness'][-1]) / scale:.6f}", f"{k / scale:.6f}"
        rows.append([name, f"{parameters.points}²", *both, _below(worst)])
    return rows


if __name__ == "__main__":
    for row in check():
        print(*row)
