"""Ours: roughcontact, with nothing set."""

from __future__ import annotations

from typing import Any

import roughcontact as rc

PACKAGE = "roughcontact"
SETTINGS = "press(surface, modulus, force=...), adhesive_state(..., mean_gap=...), gap_flow(solution)"
rc.press  # noqa: B018  # imported here, not inside the first measurement


def _surface(problem: Any, heights: Any) -> rc.Surface:
    return rc.Surface(heights, rc.Grid(heights.shape, problem.spacing, periodic=problem.periodic))


def normal(problem: Any, tolerance: float) -> dict[str, Any]:
    given = {"hardness": problem.hardness} if problem.hardness < float("inf") else {}
    surface = _surface(problem, problem.heights)
    found = rc.press(surface, problem.modulus, force=problem.force, tolerance=tolerance, **given)
    answer = {"pressure": found.pressure, "own_depth": found.depth}
    return answer | {"status": found.status.value, "products": found.steps}


plasticity = normal


def adhesion(problem: Any, tolerance: float) -> dict[str, Any]:
    law, given = rc.Adhesion(problem.work, problem.range), {"mean_gap": problem.mean_gap}
    surface = _surface(problem, problem.heights)
    found = rc.adhesive_state(surface, problem.modulus, law, tolerance=tolerance, **given)
    return {"gap": found.gap, "status": found.status.value, "products": found.products}


def flow(problem: Any, tolerance: float) -> dict[str, Any]:
    touching = rc.press(_surface(problem, -problem.gap), problem.modulus, depth=0.0)  # the gap, undeformed
    found = rc.gap_flow(touching, tolerance=tolerance)
    ended = "converged" if found.residual <= tolerance else "stagnated"
    return {"transmissivity": float(found.transmissivity[0, 0]), "status": ended}
