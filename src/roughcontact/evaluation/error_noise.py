"""The errors that noise of the heights gives to the numbers of a load: their spread and their bias.

The pressed map holds the noise once. It is pressed again with the same noise added once and twice more, in pairs of
opposite sign, whose mean has no part of first order. Numbers with a derivative are smooth: their spread follows from
it, and their bias is extrapolated by a parabola in the variance. Areas and stiffnesses change in steps, which scatter
from map to map, so their spread follows from the draws, and their bias from the means of the draws only.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.press import solve
from roughcontact.contact.problem import separation_of
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.evaluation.error_budget import ErrorSource
from roughcontact.evaluation.error_numbers import NUMBERS, number_table
from roughcontact.evaluation.noise import Noise, between_neighbours, require_fits
from roughcontact.gradients.sensitivity import sensitivity
from roughcontact.progress.events import tracked
from roughcontact.solver.control import Force
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["NoiseErrors", "errors_of_noise"]

PAIRS = 8  # of draws: a spread from draws has a standard error of a quarter (docs/concepts/noise-errors.md)
SEED = 0  # the same for each map: two budgets differ by their maps only
SURE = 2  # standard errors of a bias, above which it is corrected
FLOOR = 1e-6  # of a number: smaller changes may be those of the tolerance
# A fit to 60 free surfaces with 10 % noise, where the bias of the areas grew as rms^(4/3): from no noise to that of the
# map by twice as much as from once to twice more, give or take a half (docs/concepts/noise-errors.md).
STEPS, UNSURE = 2.0, 0.5
DERIVATIVES = {
    "depth": "depth_at_force",
    "mean_gap": "mean_gap_at_force",
    "elastic_energy": "energy_at_force",
}
WAYS = "by derivatives, for areas and stiffnesses by draws"
ADDED = "the change without noise, from the same noise added once and twice more"
CORRECTED = (
    "a number that it changes by more than two errors is corrected, and the error of the correction is left"
)
TOO_MUCH = (
    "The noise gives larger height differences of neighbouring cells than the map has, so the map cannot hold it. If "
    "the map was filtered, give the correlation length of its noise (correlation_length, --noise-length)."
)


@dataclass(frozen=True, slots=True, eq=False)
class NoiseErrors:
    """Sources, the parts of each for NUMBERS, and what was added to each number to remove its bias."""

    sources: tuple[ErrorSource, ...]
    parts: tuple[Array, ...]
    correction: Array
    notes: tuple[str, ...] = ()


def errors_of_noise(patches: Sequence[Solution], noise: Noise) -> NoiseErrors:
    """Return the errors of the mean over patches under a force, each with other noise.

    Raises
    ------
    ValueError
        If the load is a depth, or the noise is not one of the map.
    ConvergenceError
        If a draw missed the tolerance.
    """
    if not isinstance(noise, Noise):
        raise InputError(
            f"noise is a Noise, not {noise!r}", "give one, such as noise=rc.Noise(rms=3e-9)", "noise"
        )
    if not isinstance(patches[0].problem.control, Force):
        raise InputError(
            "depth counts from the highest cell, so at a given depth the load follows the noise of this cell",
            "prescribe the force or the pressure",
            "noise",
        )
    grids = [each.grid for each in map(_surface, patches)]
    require_fits(noise, grids[0])
    rng, found = np.random.default_rng(SEED), []
    rounds = [each for each in patches for _ in range(PAIRS)]
    with np.errstate(invalid="ignore"):  # in full contact stiffnesses are infinite
        draws = [_pair(each, noise, rng) for each in tracked(rounds, "Errors: adding noise", "draws")]
        for place, each in enumerate(patches):
            found.append(_of_map(each, noise, np.array(draws[place * PAIRS :][:PAIRS])))
    spread, bias, error = (np.array(each) for each in zip(*found, strict=True))
    change, error = bias.mean(axis=0), np.sqrt((error**2).sum(axis=0)) / len(patches)
    floor = FLOOR * np.abs(number_table(patches)).mean(axis=1)
    sure = np.abs(change) > np.maximum(SURE * error, floor)
    removed = ErrorSource("noise bias", "bias", f"{ADDED}; {CORRECTED}")
    correction, left = np.where(sure, change, 0.0), np.where(sure, error, change)
    if len(patches) > 1:  # whose scatter contains that of their noise
        return NoiseErrors((removed,), (left,), correction)
    share = between_neighbours(noise, grids[0]) / _between_neighbours(_surface(patches[0]))
    of_cells = f"{100 * share:.2g} % of the height differences of neighbouring cells"
    scatter = ErrorSource("noise", "standard error", f"{noise}, {of_cells}; {WAYS}")
    return NoiseErrors((scatter, removed), (spread[0], left), correction, (TOO_MUCH,) if share > 1 else ())


def _of_map(solution: Solution, noise: Noise, draws: Array) -> tuple[Array, Array, Array]:
    """Return spread, change without noise, and error of this change; `draws` as `_pair`, one a row."""
    value = number_table([solution])[:, 0]
    once, twice = (draws[:, k].mean(axis=1) - value for k in (0, 1))
    odd = (draws[:, 0, 0] - draws[:, 0, 1]) / 2
    # A step of the map and one of its truth, each of the variance of a draw: a mean of two draws has half of it.
    spread = np.sqrt((odd**2).mean(axis=0) + 3 * once.var(axis=0, ddof=1))
    rising = once - twice
    change = STEPS * rising
    unsure = UNSURE * rising.mean(axis=0)
    for name, derivative in _derivatives(solution):
        row = NUMBERS.index(name)
        spread[row] = noise.spread(derivative, _surface(solution).grid)
        change[:, row], unsure[row] = twice[:, row] - 3 * once[:, row], 0.0
    error = np.hypot(change.std(axis=0, ddof=1) / math.sqrt(PAIRS), unsure)
    return spread, change.mean(axis=0), error


def _derivatives(solution: Solution) -> Iterator[tuple[str, Array]]:
    """Yield the numbers that have derivatives, with these."""
    for name, label in DERIVATIVES.items():
        try:
            yield name, getattr(sensitivity(solution), label)
        except InputError:  # plastic energy, a flat top, contacts without an elastic cell
            continue


def _pair(solution: Solution, noise: Noise, rng: np.random.Generator) -> Array:
    """Return the numbers with one draw of noise added once and twice more, of both signs: shape (2, 2, numbers)."""
    problem, surface = solution.problem, _surface(solution)
    draw = noise.draw(surface.grid, rng)
    pressed: list[Solution | None] = []
    for factor in (1.0, -1.0, math.sqrt(2), -math.sqrt(2)):
        noisier = surface.with_heights(surface.heights + factor * draw, "with noise")
        try:
            again = replace(problem, separation=separation_of(noisier), surface=noisier)
        except ValueError:  # the map cannot carry the load any more
            pressed.append(None)
            continue
        answer = solve(again, initial=(solution.pressure, solution.depth))
        if not answer.status.converged:
            raise ConvergenceError(answer)
        pressed.append(answer)
    return number_table(pressed).T.reshape(2, 2, len(NUMBERS))


def _between_neighbours(surface: Surface) -> float:
    """Return the rms difference of the heights of neighbouring cells [m]."""
    steps = [np.diff(surface.heights, axis=axis) for axis in range(surface.grid.ndim)]
    return math.sqrt(float(np.nanmean(np.concatenate([np.ravel(each) ** 2 for each in steps]))))


def _surface(solution: Solution) -> Surface:
    surface = solution.problem.surface
    assert isinstance(surface, Surface)  # as the budget has checked
    return surface
