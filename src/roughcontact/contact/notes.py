"""What a reader of the numbers of a contact should know, and what an engineer would question in them."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.note import Note, Rank
from roughcontact.materials import MATERIALS
from roughcontact.solver.complementarity import SLIGHT, added_stiffness
from roughcontact.statistics.fit_window import CELLS
from roughcontact.surface.border_step import open_border
from roughcontact.surface.preparation.outliers import OUTLYING, height_limits
from roughcontact.surface.surface import Surface

__all__ = ["notes_on"]

STRAINED = 0.5  # of the reduced modulus: a pressure beyond is a matter for another theory
ABOVE = 0.2  # of the contact, above the hardness: with less, area and stiffness change by less than a tenth
BEYOND = 1e-3  # of the hardness, on unloading: more than what a tolerance leaves open
EDGE = 0.01  # of the force, on the outermost cells: below, what lies beyond them changes no number by more


def notes_on(solution: Solution) -> Iterator[Note]:
    """Yield what is to be said of a solution."""
    count, problem = solution.problem.measure.xp.count_nonzero, solution.problem
    yielding, in_contact = int(count(solution.pressure >= problem.hardness)), int(count(solution.contact))
    if not solution.status.converged:
        yield Note(Rank.WRONG, f"Residual {solution.residual:.1e}: {solution.status.message}")
    if in_contact == 1:
        text = "A single cell is in contact: stiffness and area are those of the grid, not of the body."
        yield Note(Rank.WRONG, text)
    elif in_contact and not solution.resolved_from_below:
        line = problem.geometry is Geometry.LINE
        small = f"narrower than {CELLS} cells" if line else f"less stiff than {CELLS} cells"
        text = f"Not resolved: the contact is {small}, so that the grid sets the stiffness, not the surface."
        yield Note(Rank.WRONG, text)
    if yielding:
        yield Note(
            Rank.LIMITED,
            f"{yielding} of {in_contact} cells in contact are at the hardness: they are plastic, and the stiffness is "
            "that of the others.",
        )
    yield from _of_hardness(solution)
    yield from _of_flow(solution)
    yield from _of_two_sides(solution, int(count(solution.touching)) if in_contact else 0)
    yield from _of_input(solution)
    if solution.missing:
        hold = "1 cell holds" if solution.missing == 1 else f"{solution.missing} cells hold"
        yield Note(Rank.USUAL, f"{hold} no height: kept out of contact.")
    if solution.edge_share >= EDGE and problem.surface is not None:
        yield Note(
            Rank.USUAL,
            f"Contact reaches the edge of the map, whose cells carry {100 * solution.edge_share:.2g} % of the force: "
            "what lies beyond it would carry load too.",
        )


def _of_hardness(solution: Solution) -> Iterator[Note]:
    """Yield what is wrong with an elastic contact of a metal that would flow."""
    problem, softer = solution.problem, solution.problem.softer
    is_elastic = not problem.plastic and problem.flow is None and problem.geometry is not Geometry.FOUNDATION
    if softer is None or not is_elastic or not solution.contact_area:
        return
    above = problem.measure.total(solution.pressure > softer.hardness) / solution.contact_area
    if above >= ABOVE:
        given = repr(softer.name) if softer.name in MATERIALS else f"{softer.hardness:.4g}"
        yield Note(
            Rank.WRONG,
            f"{above:.0%} of the contact area is above the hardness of {softer.name}, {softer.hardness / 1e9:.3g} GPa "
            f"(the largest pressure is {solution.max_pressure / softer.hardness:.2g} times the hardness): "
            f"{softer.name} flows there, and the elastic area and stiffness are wrong. Give hardness={given}, "
            "or unload the joint by loading_loop.",
        )


def _of_flow(solution: Solution) -> Iterator[Note]:
    """Yield what there is to say where a flattened surface bears more than the pressure that flattened it."""
    flow = solution.flow
    if flow is not None and math.isnan(flow.energy):
        yield Note(
            Rank.LIMITED,
            "The energy of flow is not known, because the loads are too few for the work by which the rise of the "
            "surface lifts the force: give more loads between zero and the largest.",
        )
    elif flow is not None and solution.problem.flow is not None:
        beyond = float(solution.problem.measure.xp.max(solution.pressure / flow.hardness)) - 1
        if beyond > BEYOND:
            yield Note(
                Rank.LIMITED,
                f"On the flattened surface the largest pressure is {beyond:.1e} of the hardness beyond it: on these "
                "cells unloading is not quite elastic.",
            )


def _of_two_sides(solution: Solution, touching: int) -> Iterator[Note]:
    """Yield what there is to say where the stiffness on loading is another."""
    if not touching:
        return
    k = solution.stiffness
    most = added_stiffness(solution.problem.operator, solution.contact, solution.touching)
    if most <= SLIGHT * k or solution.loading_stiffness <= (1 + SLIGHT) * k:
        return
    touch = "1 cell touches" if touching == 1 else f"{touching} cells touch"
    yield Note(
        Rank.LIMITED,
        f"{touch} without pressure: as the load grows the stiffness is {solution.loading_stiffness:.6g}, and "
        f"{k:.6g} as it is reduced, which is the one that is given.",
    )


def _of_input(solution: Solution) -> Iterator[Note]:
    """Yield what an engineer would question in load, modulus and surface."""
    problem, largest = solution.problem, solution.max_pressure
    modulus, surface = problem.modulus, problem.surface
    springs = problem.geometry is Geometry.FOUNDATION  # their pressure is a force per length
    if largest > STRAINED * modulus and not springs:
        yield Note(
            Rank.DOUBTFUL,
            f"The largest pressure, {largest:.3g} Pa, is {largest / modulus:.0%} of the reduced modulus: real bodies "
            "yield or break at lower pressures, and the theory of small strains does not hold.",
        )
    if solution.depth > max(problem.grid.lengths):
        yield Note(
            Rank.DOUBTFUL,
            f"The depth, {solution.depth:.3g} m, exceeds the map: check the units of load and modulus.",
        )
    if surface is not None and is_numpy(surface.heights):
        _, above = height_limits(surface.heights)
        outlying = surface.heights > above
        if far := int(np.count_nonzero(outlying)):
            stand = "1 point stands" if far == 1 else f"{far} points stand"
            carry = "carries" if far == 1 else "carry"
            borne = problem.measure.total(solution.pressure * outlying) / (solution.force or 1.0)
            yield Note(
                Rank.DOUBTFUL,
                f"{stand} more than {OUTLYING:g} rms heights above the mean of nearly all, and {carry} {borne:.0%} of "
                f"the force. If they are faults of the measurement, take them out by masked(above={above:.6g}).",
            )
    if isinstance(surface, Surface) and is_numpy(surface.heights) and (step := open_border(surface)):
        yield Note(
            Rank.DOUBTFUL,
            f"The periodic map does not close: heights step by {step.height:.3g} m from one edge to the opposite one, "
            f"{step.ratio:.2g} times as much as between neighbouring cells. If the surface does not repeat itself, "
            "press it as free too and compare.",
        )
