"""What a reader of the numbers of a contact should know: notes, and warnings of what an engineer would question."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.solver.complementarity import SLIGHT, added_stiffness
from roughcontact.statistics.fit_window import CELLS
from roughcontact.surface.preparation.outliers import OUTLYING, height_limits

__all__ = ["notes_on"]

STRAINED = 0.5  # of the reduced modulus: a pressure beyond is a matter for another theory
BEYOND = 1e-3  # of the hardness, on unloading: more than what a tolerance leaves open


def notes_on(solution: Solution) -> tuple[str, ...]:
    """Return what is to be said of a solution."""
    problem, notes = solution.problem, []
    if not solution.status.converged:
        notes.append(f"Residual {solution.residual:.1e}: {solution.status.message}")
    count = solution.problem.measure.xp.count_nonzero
    yielding, in_contact = int(count(solution.pressure >= problem.hardness)), int(count(solution.contact))
    if yielding:
        notes.append(
            f"{yielding} of {in_contact} cells in contact are at the hardness: they are plastic, and the "
            "stiffness is that of the others."
        )
    notes.extend(_of_flow(solution))
    if solution.missing:
        hold = "1 cell holds" if solution.missing == 1 else f"{solution.missing} cells hold"
        notes.append(f"{hold} no height: kept out of contact.")
    if solution.touches_edge and problem.surface is not None:
        notes.append("Contact reaches the edge of the map: what lies beyond it would carry load too.")
    if in_contact == 1:
        notes.append(
            "A single cell is in contact: stiffness and area are those of the grid, not of the body."
        )
    elif in_contact and not solution.resolved_from_below:
        line = problem.geometry is Geometry.LINE
        small = f"narrower than {CELLS} cells" if line else f"less stiff than {CELLS} cells"
        notes.append(
            f"Not resolved: the contact is {small}, so that the grid sets the stiffness, not the surface."
        )
    touching = int(count(solution.touching))
    if in_contact and touching:
        notes.extend(_of_two_sides(solution, touching))
    return (*notes, *_warnings(solution))


def _of_flow(solution: Solution) -> tuple[str, ...]:
    """Return what there is to say where a flattened surface bears more than the pressure that flattened it."""
    flow = solution.flow
    if flow is not None and math.isnan(flow.energy):
        return (
            "The energy of flow is not known, because the loads are too few for the work by which the rise of the "
            "surface lifts the force: give more loads between zero and the largest.",
        )
    if solution.problem.flow is None or flow is None:
        return ()
    beyond = float(solution.problem.measure.xp.max(solution.pressure / flow.hardness)) - 1
    if beyond <= BEYOND:
        return ()
    return (
        f"On the flattened surface the largest pressure is {beyond:.1e} of the hardness beyond it: on these cells "
        "unloading is not quite elastic.",
    )


def _of_two_sides(solution: Solution, touching: int) -> tuple[str, ...]:
    """Return what there is to say where the stiffness on loading is another."""
    k = solution.stiffness
    most = added_stiffness(solution.problem.operator, solution.contact, solution.touching)
    if most <= SLIGHT * k or solution.loading_stiffness <= (1 + SLIGHT) * k:
        return ()
    touch = "1 cell touches" if touching == 1 else f"{touching} cells touch"
    return (
        f"{touch} without pressure: as the load grows the stiffness is {solution.loading_stiffness:.6g}, and "
        f"{k:.6g} as it is reduced, which is the one that is given.",
    )


def _warnings(solution: Solution) -> tuple[str, ...]:
    """Return warnings of what an engineer would question in these numbers."""
    problem, warnings = solution.problem, []
    modulus, surface = problem.modulus, problem.surface
    largest = float(solution.problem.measure.xp.max(solution.pressure))
    springs = problem.geometry is Geometry.FOUNDATION  # their pressure is a force per length
    if largest > STRAINED * modulus and not springs:
        warnings.append(
            f"The largest pressure, {largest:.3g} Pa, is {largest / modulus:.2g} of the reduced modulus: real "
            "bodies yield or break before, and the theory of small strains ends."
        )
    if solution.depth > max(problem.grid.lengths):
        warnings.append(
            f"The depth, {solution.depth:.3g} m, exceeds the map: check the units of load and modulus."
        )
    if surface is not None and is_numpy(surface.heights):
        _, above = height_limits(surface.heights)
        if far := int(np.count_nonzero(surface.heights > above)):
            stand = "1 point stands" if far == 1 else f"{far} points stand"
            warnings.append(
                f"{stand} more than {OUTLYING:g} rms heights above the mean of nearly all. Outliers of a measurement "
                f"carry the load: take them out by masked(above={above:.6g})."
            )
    return tuple(warnings)
