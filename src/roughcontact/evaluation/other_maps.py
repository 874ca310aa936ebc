"""The difference between maps of the same surface, from four quarters of one map, each pressed separately."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.press import solve
from roughcontact.contact.problem import separation_of
from roughcontact.contact.solution import Solution
from roughcontact.evaluation.error_budget import ErrorSource
from roughcontact.evaluation.error_numbers import NUMBERS, number_table
from roughcontact.halfspace.operators.build import half_space
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.progress.events import tracked
from roughcontact.solver.control import Force
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["Sampling", "sampling_of"]

SPOTS = 10  # with fewer, quarters show 0.6 of the scatter of maps (docs/concepts/errors.md)
CELLS = 4  # along each axis of a quarter
MEASURED = 0.5  # of the cells of a quarter
LENGTHS = ("depth", "mean_gap")  # numbers that do not grow with the area
# Numbers that do not depend on the size of a map.
OF_JOINT = ("interfacial_stiffness_per_area", "contact_fraction", "corrected_contact_fraction", "mean_gap")
HOW = "four free quarters at the same nominal pressure, their relative standard deviation over two"

Window = tuple[slice, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Sampling:
    """The scatter of the quarters of a map.

    Attributes
    ----------
    source : ErrorSource
        Its kind is "unknown", with the reason in a sentence, if the parts are unknown.
    parts : array, shape (numbers,)
        Half of the relative standard deviation of the quarters times the number, for each of NUMBERS; NaN if unknown.
    bias_of_size : mapping of str to float
        Relative difference between the mean of the quarters and the whole, for the numbers that do not depend on the
        size of a map.
    """

    source: ErrorSource
    parts: Array
    bias_of_size: Mapping[str, float]


def sampling_of(solution: Solution) -> Sampling:
    """Return the difference between maps of the same surface, as an order of magnitude.

    A map consists of four quarters. If these were independent, the scatter of the mean over a map would be half of the
    scatter of the quarters. Each quarter carries the force in proportion to its measured cells, and its forces,
    stiffnesses, areas and energies count per measured cell. If the number of cells is odd, the middle row or column
    belongs to no quarter.

    Raises
    ------
    ConvergenceError
        If a quarter missed the tolerance.
    """
    problem, surface = solution.problem, solution.problem.surface
    assert isinstance(surface, Surface)
    windows = _quarters(surface.grid.shape)
    measured = [float(surface.measured[window].mean()) for window in windows]
    why = _no_estimate(solution, measured)
    bodies = [] if why else _free_bodies(problem.operator, windows)
    if not bodies:
        source = ErrorSource("sampling", "unknown", why or "this body is not known with a free boundary")
        return Sampling(source, np.full(len(NUMBERS), math.nan), {})
    pressed, pairs = [], list(zip(windows, bodies, strict=True))
    for window, body in tracked(pairs, "Errors: pressing quarters", "quarters"):
        part = surface.cropped(*window)
        force = Force(solution.force * int(part.measured.sum()) / int(surface.measured.sum()))
        quarter = replace(problem, separation=separation_of(part), operator=body, surface=part, control=force)
        pressed.append(solve(quarter))
        if not pressed[-1].status.converged:
            raise ConvergenceError(pressed[-1])
    density = np.array(measured) / surface.measured.mean()
    return _scatter(number_table([solution])[:, 0], number_table(pressed), density, solution)


def _scatter(whole: Array, quarters: Array, density: Array, solution: Solution) -> Sampling:
    """Return the scatter of the numbers of quarters, shape (numbers, 4), as errors of the whole."""
    found = dict(zip(NUMBERS, quarters, strict=True))
    if all(solution.problem.grid.periodic):  # where both stiffnesses of the whole are equal
        found["stiffness"] = found["interfacial_stiffness"]
    each = np.array([row if name in LENGTHS else row / density for name, row in found.items()])
    with np.errstate(invalid="ignore", divide="ignore"):  # in full contact stiffnesses are infinite
        deviation, mean = each.std(axis=1, ddof=1), each.mean(axis=1)
        parts = np.where(deviation == 0, 0.0, deviation / np.abs(mean) / 2 * np.abs(whole))
        bias = dict(zip(NUMBERS, (mean / whole - 1).tolist(), strict=True))
    source = ErrorSource("sampling", "order of magnitude", HOW)
    return Sampling(source, parts, {name: bias[name] for name in OF_JOINT})


def _no_estimate(solution: Solution, measured: list[float]) -> str:
    """Return the reason why quarters give no estimate, in a sentence; an empty text if they give one."""
    count, shape = solution.spot_count, solution.problem.grid.shape
    if count < SPOTS:
        spots = f"{count} spot{'s' if count != 1 else ''}"
        return f"{spots}, too few to estimate from one map how much another map of this surface would differ"
    if min(shape) < 2 * CELLS:
        return (
            f"a map of {' x '.join(map(str, shape))} cells has no quarters of {CELLS} cells along each axis"
        )
    if min(measured) < MEASURED:
        return "more than half of the heights of one quarter are missing"
    return ""


def _quarters(shape: tuple[int, ...]) -> list[Window]:
    """Return the corners of a map, of half as many cells along each axis, rounded down."""
    halves = [(slice(0, n // 2), slice(n - n // 2, n)) for n in shape]
    return [(rows, columns) for rows in halves[0] for columns in halves[1]]


def _free_bodies(operator: Operator, windows: list[Window]) -> list[Operator]:
    """Return the same body under each window, with nothing around it; an empty list if it exists only periodic."""
    grid = operator.grid
    if not any(grid.periodic):
        return [operator.restrict(window) for window in windows]
    modulus = capabilities(operator).modulus
    if modulus is None:
        return []
    return [half_space(grid.window(windows[0]), modulus)] * len(windows)  # type: ignore[arg-type]
