"""ReynoldsFlow (BSD-3-Clause): the flow along axis 0, with harmonic means of g^3 at the faces; no contact."""

from __future__ import annotations

from typing import Any

from reynoldsflow import transport

PACKAGE = "reynoldsflow"
SETTINGS = "solve_fluid_problem, its default solver with the tolerance, in units of the mean gap"
DRIVEN = {"pressure": {"p_west": 1.0, "p_east": 0.0}, "periodic": {"pressure_gradient": 1.0}}

transport.set_verbosity("error")


def transmissivity(gap: Any, mode: str, tolerance: float | None = None) -> float:
    """Return the transmissivity of a gap along axis 0 in units of its mean gap cubed."""
    given = {"boundary_mode": mode, "rtol": tolerance} | DRIVEN[mode]
    kept, _, flux = transport.solve_fluid_problem(gap / gap.mean(), **given)
    if flux is None:
        return 0.0
    return float(transport.compute_total_flux(kept, flux, len(gap), boundary_mode=mode)[0])


def flow(problem: Any, tolerance: float) -> dict[str, Any]:
    found = transmissivity(problem.gap, "periodic" if problem.periodic else "pressure", tolerance)
    return {"transmissivity": found * float(problem.gap.mean()) ** 3, "status": "converged"}  # or it raises
