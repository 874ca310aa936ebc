"""The errors of a load, from solutions on maps that were made differently."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.loads.load_search import SurfaceKind
from roughcontact.contact.press import solve
from roughcontact.contact.problem import ContactProblem, separation_of
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.evaluation.error_budget import ErrorBudget, ErrorSource, QuotedNumber
from roughcontact.evaluation.error_noise import errors_of_noise
from roughcontact.evaluation.error_notes import note_on_size, notes_on_sources
from roughcontact.evaluation.error_numbers import NUMBERS, border_floor, number_table, symmetries
from roughcontact.evaluation.noise import Noise
from roughcontact.evaluation.other_maps import sampling_of
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import capabilities
from roughcontact.labels.variables import VARIABLES
from roughcontact.progress.events import tracked
from roughcontact.solver.control import Force
from roughcontact.surface.border_step import open_border
from roughcontact.surface.finest_waves import is_rough_to_cells
from roughcontact.surface.preparation.filters import require_cells
from roughcontact.surface.preparation.halving import halved
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric, positive_scalar

__all__ = ["checked_cutoff", "error_budget"]

CELLS = 4  # of the default short cut-off: with fewer, a Gaussian filter does not work on a free map
OF_CELLS = ("grid", "short cut-off")  # sources without waves shorter than the cells; they come first
OF_FORM = (
    "Levelling and sampling are left out: the form of the map is larger than its roughness, and is taken for the body "
    "itself. If it is not, remove it (levelled('quadratic'), --level quadratic)."
)
AT_DEPTH = "Sampling is left out: at a given depth, maps differ by their highest points. Prescribe force or pressure."
FLOOR = "areas and stiffnesses at least by the cells along the border of the contact"
SAME = 1e-9  # relative difference up to which two loads or spacings are equal


@numeric(short_cutoff="m")
def error_budget(
    pressed: Solution | Sequence[Solution], *, short_cutoff: float | None = None, noise: Noise | None = None
) -> ErrorBudget:
    """Return the errors of the numbers of a pressed map, or of the means of several patches.

    The load is computed again on half as many cells, on the map without its short waves, and, if the map is nominally
    flat and free, or periodic without closing at its border, without its quadratic form; the changes of a number are
    its parts. They are not corrections: each is the sensitivity of the number to a property of the map that is
    unknown. Four quarters of the map show how much another map would differ.

    Parameters
    ----------
    pressed : Solution or sequence of Solution
        The solution of `press` for a map of heights; or the solutions for several patches of one size, at the same
        load.
    short_cutoff : float, optional
        Wavelength [m] below which the instrument does not measure: the Gaussian filter halves the amplitude there. By
        default four cells.
    noise : Noise, optional
        Noise that the heights of the map contain. It adds spread and bias to the sources, and corrects the numbers that
        it surely changes.

    Returns
    -------
    ErrorBudget
        It does not contain the prescribed number, force or depth.

    Raises
    ------
    ValueError
        If a solution is not that of a map of heights, if the cut-off has fewer than four cells or is as long as the
        map, or if patches differ in their grid or load. Noise is refused for a load at given depth, and with a
        correlation length above a quarter of the map.
    ConvergenceError
        If a load missed its tolerance.

    Notes
    -----
    *Grid*: mean heights on half as many cells of the same map, which leaves long waves unchanged. The part is the
    difference between the two grids; on nested surfaces it exceeds the remaining error of the finer one. Two grids may
    agree by chance, so the parts of areas and stiffnesses are at least the error from the cells along the border.
    *Short cut-off*: the effect of the shortest waves of the map. Still shorter waves change the area by as much again,
    and the depth counts from the highest point, so these errors hold for a surface without shorter waves than its map.
    On a map that is rough down to its cells the depth has no error (NaN), because it would grow with the grid. The
    largest pressure has no error at all: it grows with the waves, and at the border of a free map with the grid.
    *Levelling*: the map without its least-squares quadratic. *Patches*: the standard error of the mean over them. Grid
    and short cut-off both change the waves of two to four cells, so the error is rather too large
    (docs/concepts/errors.md). *Sampling*: how much another map of the surface would differ, as an order of magnitude,
    for one periodic or nominally flat map under a force. Four free quarters are pressed at the same nominal pressure;
    the part is half of their relative standard deviation. With fewer than ten spots the part, and therefore the error,
    is NaN. *Noise*, *noise bias*: the standard deviation of a number by the noise of the map, and the change of the
    number without this noise, extrapolated from maps with more noise. A change above two of its errors is added to the
    value; ``ErrorBudget.corrections`` lists these changes, and the part is then the error of the correction
    (docs/concepts/noise-errors.md).

    The area is given both as counted by cells and corrected for its perimeter by Yastrebov, Anciaux and Molinari,
    Tribology International 114 (2017) 161.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> waves = {"hurst": 0.8, "rms": 1e-7, "rolloff": 16e-6, "short_cutoff": 8e-6}
    >>> surface = rc.self_affine(grid, rng=np.random.default_rng(1), **waves)
    >>> budget = rc.error_budget(rc.press(surface, 1e9, pressure=1e6))
    >>> [source.name for source in budget.sources]
    ['grid', 'short cut-off', 'sampling']
    >>> budget["interfacial_stiffness"].relative_error < 0.3
    True
    """
    patches = tuple(pressed) if isinstance(pressed, Iterable) else (pressed,)
    _check(patches)
    first = patches[0].problem
    surfaces = [each.problem.surface for each in patches if isinstance(each.problem.surface, Surface)]
    shortest = checked_cutoff(surfaces[0], short_cutoff)
    cut = f"Gaussian low-pass at {shortest:.3g} m{'' if short_cutoff is not None else f', {CELLS} cells'}"
    sources = [ErrorSource("grid", "bias", f"half as many cells along each axis, of mean heights; {FLOOR}")]
    otherwise: list[Callable[[Surface], Surface]] = [halved]
    sources.append(ErrorSource("short cut-off", "bias", cut))
    otherwise.append(lambda surface: surface.filtered(short_cutoff=shortest))
    kinds = {_kind_of(surface) for surface in surfaces}
    notes = []
    if SurfaceKind.FLAT in kinds and SurfaceKind.FORM not in kinds:
        sources.append(ErrorSource("levelling", "bias", "without the least-squares quadratic"))
        otherwise.append(lambda surface: surface.levelled("quadratic"))
    elif SurfaceKind.FORM in kinds:
        notes.append(OF_FORM)
    values, parts = number_table(patches), []
    border = [each.spot_count for each in patches], [symmetries(each) for each in patches]
    with np.errstate(invalid="ignore"):  # in full contact stiffnesses are infinite
        maps = list(zip(sources, otherwise, strict=True))
        for source, change in tracked(maps, "Errors: pressing maps made otherwise", "maps"):
            again = number_table([_again(each, change) for each in patches])
            part = np.where(again == values, 0.0, again - values).mean(axis=1)
            if source.name == "grid":  # two grids agree by chance where their borders do
                part = np.copysign(np.maximum(abs(part), border_floor(values, *border).mean(axis=1)), part)
            parts.append(part)
            if np.isnan(again).all(axis=0).any():
                notes.append(
                    f"The map made otherwise ({source.name}) cannot carry this load, so its part is unknown."
                )
        if len(patches) > 1:
            many = f"standard error of the mean of {len(patches)} patches"
            sources.append(ErrorSource("patches", "standard error", many))
            parts.append(values.std(axis=1, ddof=1) / math.sqrt(len(patches)))
    prescribed = "force" if isinstance(first.control, Force) else "depth"
    bias_of_size: Mapping[str, float] = {}
    if len(patches) == 1 and SurfaceKind.FORM not in kinds:
        if prescribed == "depth":
            notes.append(AT_DEPTH)
        else:
            sampling = sampling_of(patches[0])
            sources.append(sampling.source)
            parts.append(sampling.parts)
            bias_of_size = sampling.bias_of_size
    means, corrections = values.mean(axis=1), {}
    if noise is not None:
        noisy = errors_of_noise(patches, noise)
        means += noisy.correction
        added = zip(NUMBERS, noisy.correction.tolist(), strict=True)
        corrections = {name: change for name, change in added if change and name != prescribed}
        sources += noisy.sources
        parts += noisy.parts
        notes += noisy.notes
    if any(map(is_rough_to_cells, surfaces)):
        for part in parts[: len(OF_CELLS)]:
            part[NUMBERS.index("depth")] = math.nan
        notes.append(_of_highest_point(prescribed))
    numbers = tuple(
        QuotedNumber(name, float(value), VARIABLES[name].unit, tuple(map(float, part)))
        for name, value, part in zip(NUMBERS, means, np.transpose(parts), strict=True)
        if name != prescribed
    )
    notes += [*notes_on_sources(numbers, sources), *note_on_size(bias_of_size)]
    return ErrorBudget(numbers, tuple(sources), tuple(notes), bias_of_size, corrections)


def _kind_of(surface: Surface) -> SurfaceKind:
    """Return the kind of a map: a periodic one that does not close is nominally flat, since it is called periodic."""
    return SurfaceKind.FLAT if open_border(surface) else SurfaceKind.of(surface)


def _of_highest_point(prescribed: str) -> str:
    """Return the note on the depth of a map that is rough down to its cells."""
    why = "This map is rough down to its cells, and finer waves raise the highest point, from which the depth counts"
    if prescribed == "depth":
        return f"{why}: the errors at a given depth grow with the grid. Prescribe the force or the pressure."
    return f"{why}: the depth has no error, because it would grow with the grid. Quote the mean gap."


def _check(patches: Sequence[Solution]) -> None:
    """Raise an error for solutions that are not those of maps within their tolerance, and for different patches."""
    if not patches or not all(isinstance(each, Solution) for each in patches):
        raise InputError(
            "an error budget takes solutions",
            "give the Solution that press returned, or several of one size and load",
        )
    first = patches[0].problem
    for each in patches:
        problem = each.problem
        if problem.geometry is not Geometry.SURFACE or not isinstance(problem.surface, Surface):
            raise InputError(
                f"errors are those of a map of heights that was pressed, not of a {problem.geometry.value} or of a "
                "separation without a map",
                "press a Surface of two axes",
            )
        if not is_numpy(problem.surface.heights):
            raise InputError(
                "an error budget needs heights in NumPy's memory",
                "press the surface there, or take solution.on_host()",
            )
        if problem.flow is not None or problem.rise or not isinstance(problem.hardness, int | float):
            raise InputError(
                "errors are those of one load that is pressed again on other maps: not of a surface that has flowed "
                "before or that rises as it flows, nor of a hardness that differs from cell to cell"
            )
        if not each.status.converged:
            raise ConvergenceError(each)
        same = (
            type(problem.control) is type(first.control)
            and math.isclose(problem.control.value, first.control.value, rel_tol=SAME)
            and problem.grid.shape == first.grid.shape
            and problem.grid.periodic == first.grid.periodic
            and np.allclose(problem.grid.spacing, first.grid.spacing, rtol=SAME, atol=0)
        )
        if not same:
            raise about(
                "patches",
                "must have one size and one load to have a mean",
                f"crop them to one size, and press each by "
                f"the same force, pressure or depth, not {_words(first)} and {_words(problem)}",
            )


def _words(problem: ContactProblem) -> str:
    return f"{problem.grid.shape} cells of {problem.grid.spacing} m under {problem.control}"


def checked_cutoff(surface: Surface, given: float | None) -> float:
    """Return the short cut-off [m] of the errors of a map: `given`, or four cells.

    Raises
    ------
    ValueError
        If the map has too few cells for the cut-off, or is not longer than it.
    """
    cutoff = (
        CELLS * max(surface.grid.spacing) if given is None else positive_scalar(given, "short_cutoff [m]")
    )
    if cutoff >= min(surface.grid.lengths):
        raise InputError(
            f"a short_cutoff of {cutoff:g} m leaves nothing of a map of {min(surface.grid.lengths):g} m",
            "give the shortest wave that the instrument records, or take a larger map",
        )
    require_cells(cutoff, surface)
    return cutoff


def _again(solution: Solution, change: Callable[[Surface], Surface]) -> Solution | None:
    """Return the same load on a changed surface; None if that cannot carry it, as near full contact."""
    problem = solution.problem
    surface, operator = change(problem.surface), problem.operator  # type: ignore[arg-type]
    if surface.grid != problem.grid:
        other = capabilities(operator).coarsened(surface.grid)
        if other is None:
            raise InputError(
                "this body cannot be made on other cells, so the error of its grid cannot be estimated",
                "press the surface without operator=",
            )
        operator = other
    try:
        other_map = replace(problem, separation=separation_of(surface), operator=operator, surface=surface)
    except ValueError:  # every other value was accepted before
        return None
    answer = solve(other_map)
    if not answer.status.converged:
        raise ConvergenceError(answer)
    return answer
