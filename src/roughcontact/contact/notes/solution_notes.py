"""Notes on the numbers of a contact: their limits, and doubtful input."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.contact.notes.fault_notes import fault_notes
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank
from roughcontact.labels.variables import unit_of
from roughcontact.materials import MATERIALS
from roughcontact.solver.complementarity import SLIGHT, added_stiffness
from roughcontact.statistics.fit_window import CELLS
from roughcontact.surface.border_step import BorderStep, open_border
from roughcontact.surface.preparation.outliers import OUTLYING, height_limits
from roughcontact.surface.surface import Surface

__all__ = ["notes_on", "notes_on_few_cells", "notes_on_load"]

STRAINED = 0.5  # of the reduced modulus: small-strain elasticity does not hold at larger pressures
ABOVE = 0.2  # of the contact area, above the hardness: below, area and stiffness change by less than a tenth
BEYOND = 1e-3  # of the hardness, exceeded on unloading: more than the tolerance allows
EDGE = 0.01  # of the force, on the outermost cells: below, a larger map would change each number by less


def notes_on(solution: Solution) -> Iterator[Note]:
    """Yield the notes on a solution."""
    yield from notes_on_load(solution)
    yield from _of_two_sides(solution)
    yield from notes_on_few_cells(solution)


def notes_on_load(solution: Solution) -> Iterator[Note]:
    """Yield the notes on a solution that of all loads of a curve matter most at the largest."""
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
        text = f"Not resolved: the contact is {small}, and its stiffness depends on the grid, not on the surface."
        yield Note(Rank.WRONG, text)
    if yielding:
        yield Note(
            Rank.LIMITED,
            f"{yielding} of {in_contact} cells in contact are at the hardness: they are plastic, and only the others "
            "contribute to the stiffness.",
        )
    yield from _of_hardness(solution)
    yield from _of_flow(solution)
    yield from _of_input(solution)
    if solution.missing:
        hold = "1 cell holds" if solution.missing == 1 else f"{solution.missing} cells hold"
        yield Note(Rank.USUAL, f"{hold} no height and cannot come into contact.")
    if solution.edge_share >= EDGE and problem.surface is not None:
        yield Note(
            Rank.USUAL,
            f"The cells at the edge of the map carry {100 * solution.edge_share:.0f} % of the force: the surface "
            "beyond the map would carry load as well.",
        )


def _of_hardness(solution: Solution) -> Iterator[Note]:
    """Yield a note if an elastic contact exceeds the hardness of a metal."""
    problem, softer = solution.problem, solution.problem.softer
    is_elastic = not problem.plastic and problem.flow is None and problem.geometry is not Geometry.FOUNDATION
    if softer is None or not is_elastic or not solution.contact_area:
        return
    above = problem.measure.total(solution.pressure > softer.hardness) / solution.contact_area
    if above >= ABOVE:
        in_table = softer.name in MATERIALS and MATERIALS[softer.name].hardness == softer.hardness
        given = repr(softer.name) if in_table else f"{softer.hardness:.4g}"
        most = solution.max_pressure / softer.hardness
        yield Note(
            Rank.WRONG,
            f"On {100 * above:.0f} % of the contact area the pressure exceeds the hardness of {softer.name}, "
            f"{written(softer.hardness, 'Pa', 4)} (the largest pressure is {most:.2g} times the hardness): "
            f"{softer.name} flows there, and the elastic area and stiffness are wrong. If this is the first loading, "
            f"give hardness={given}. If the joint was pressed harder before, compute its unloading by loading_loop.",
        )


def _of_flow(solution: Solution) -> Iterator[Note]:
    """Yield a note if the energy of flow is unknown, or a flattened surface bears more than its hardness."""
    flow = solution.flow
    if flow is not None and math.isnan(flow.energy):
        yield Note(
            Rank.LIMITED,
            "The energy of flow is unknown, because the loads are too few for the work of the rise of the surface "
            "against the force: give more loads between zero and the largest.",
        )
    elif flow is not None and solution.problem.flow is not None:
        beyond = float(solution.problem.measure.xp.max(solution.pressure / flow.hardness)) - 1
        if beyond > BEYOND:
            yield Note(
                Rank.LIMITED,
                f"On the flattened surface the largest pressure exceeds the hardness by {beyond:.1e} of it: unloading "
                "is not quite elastic there.",
            )


def _of_two_sides(solution: Solution) -> Iterator[Note]:
    """Yield a note if the stiffness on loading differs from that on unloading: it takes a product."""
    touching = int(solution.problem.measure.xp.count_nonzero(solution.touching)) if solution.force else 0
    if not touching:
        return
    k, more = solution.stiffness, solution.loading_stiffness
    most = added_stiffness(solution.problem.operator, solution.contact, solution.touching)
    if most <= SLIGHT * k or more <= (1 + SLIGHT) * k:
        return
    touch = "1 cell touches" if touching == 1 else f"{touching} cells touch"
    unit = unit_of("stiffness", solution.problem.geometry)
    yield Note(
        Rank.LIMITED,
        f"{touch} without pressure: the stiffness is {written(more, unit, 6)} as the load grows, and "
        f"{written(k, unit, 6)} as the load is reduced. The latter is reported.",
    )


def _of_input(solution: Solution) -> Iterator[Note]:
    """Yield notes on a doubtful load, modulus or surface."""
    problem, largest = solution.problem, solution.max_pressure
    modulus, surface = problem.modulus, problem.surface
    springs = problem.geometry is Geometry.FOUNDATION  # their pressure is a force per length
    if largest > STRAINED * modulus and not springs:
        yield Note(
            Rank.DOUBTFUL,
            f"The largest pressure, {written(largest, 'Pa')}, is {largest / modulus:.3g} times the reduced modulus: "
            "real bodies yield or break at lower pressures, and the theory of small strains does not hold.",
        )
    if solution.depth > max(problem.grid.lengths):
        yield Note(
            Rank.DOUBTFUL,
            f"The depth, {written(solution.depth, 'm')}, is larger than the side of the map, "
            f"{written(max(problem.grid.lengths), 'm')}: check the units of depth, load and modulus.",
        )
    if isinstance(surface, Surface) and is_numpy(surface.heights) and (step := _border_of(solution, surface)):
        yield Note(
            Rank.DOUBTFUL,
            f"The periodic map does not close: heights step by {written(step.height, 'm')} from one edge to the "
            f"opposite one, {step.ratio:.2g} times as much as between neighbouring cells. If the surface does "
            "not repeat itself, press it as free too and compare.",
        )


def _border_of(solution: Solution, surface: Surface) -> BorderStep | None:
    """Return the open border of a surface: the same for all loads on it."""
    return solution.problem.once("border_step", lambda: open_border(surface))


def notes_on_few_cells(solution: Solution) -> Iterator[Note]:
    """Yield the notes on cells that carry too much of the force; they carry the largest share at light loads."""
    yield from fault_notes(solution)
    problem, surface = solution.problem, solution.problem.surface
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
                f"the force. If they are faults of the measurement, remove them by masked(above={above:.6g}).",
            )
