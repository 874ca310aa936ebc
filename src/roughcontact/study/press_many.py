"""Many surfaces pressed one by one, by a process for each core."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any, NamedTuple, cast

import numpy as np

from roughcontact.contact.press import grid_of, make_problem, press
from roughcontact.contact.problem import Body
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.materials import Modulus
from roughcontact.solver.control import Solver
from roughcontact.solver.loads import control_of
from roughcontact.study.executors.processes import Processes
from roughcontact.study.executors.serial import Serial
from roughcontact.study.executors.worker import WorkersError
from roughcontact.study.task import Executor, Result, Task
from roughcontact.threads import limit_threads
from roughcontact.validation import exactly_one, numeric

__all__ = ["press_many"]

CELLS = 2**17  # of the surfaces that a worker is sent at a time: 32 of 64 x 64
FEW = 2**19  # cells in all, up to which workers would take longer to start than to work


@numeric(modulus="Pa", force=force_unit, depth="m", pressure="Pa", hardness="Pa")
def press_many(
    surfaces: Iterable[Body],
    modulus: Modulus,
    *,
    force: float | None = None,
    depth: float | None = None,
    pressure: float | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: Hardness | None = None,
    executor: Executor | None = None,
) -> Iterator[Solution]:
    """Press many surfaces under one load, and yield their solutions in order: each equals that of `press` to the bit.

    Parameters
    ----------
    surfaces : iterable of Surface or RadialProfile
        One after the other is taken when a worker becomes free; a generator will do.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from. This and what follows is the same for all surfaces.
    force, depth, pressure : float
        Exactly one: normal force [N], indentation depth [m], or nominal pressure [Pa].
    operator : Operator, optional
        A body other than the half-space on the surfaces' grid.
    solver : Solver, optional
        Settings of the method.
    tolerance : float
        Largest residual.
    hardness : float, array, function, Material or str, optional
        Pressure that no cell exceeds [Pa].
    executor : Executor, optional
        `study.Processes` (default: one process for each core), `study.Dask`, or `study.Serial` for this process, which
        is the default for a list of surfaces with up to 524 288 cells in all. Processes take a moment to
        start: docs/how-to/threads.md.

    Yields
    ------
    Solution
        One for each surface.

    Raises
    ------
    ValueError, ConvergenceError
        As `press` does, when the turn of that surface comes; a note of the error has its number.
    WorkersError
        If workers cannot be started, or three of them die on the same surfaces.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((16, 16), 1e-6)
    >>> balls = [rc.shapes.paraboloid(grid, radius=radius) for radius in (1e-4, 2e-4)]
    >>> [f"{solution.depth * 1e9:.0f} nm" for solution in rc.press_many(balls, 1e9, force=1e-4)]
    ['35 nm', '29 nm']
    """
    load = exactly_one(force=force, depth=depth, pressure=pressure)
    settings = _Settings(modulus, load, operator, solver, tolerance, hardness)
    if executor is None:
        few = isinstance(surfaces, list | tuple) and sum(grid_of(one).size for one in surfaces) <= FEW
        executor = Serial() if few else Processes()
    return _solutions(iter(surfaces), settings, executor)


class _Settings(NamedTuple):
    """What is the same for all surfaces."""

    modulus: Modulus
    load: tuple[str, float]
    operator: Operator | None
    solver: Solver | None
    tolerance: float
    hardness: Hardness | None

    def press(self, surface: Body) -> Solution:
        name, value = self.load
        given: Any = self._asdict() | {name: value}
        del given["load"]
        return press(surface, **given)


class _Found(NamedTuple):
    """A solution without its problem, which need not be sent; a pressure [Pa] only where there is some."""

    cells: Any
    pressure: Any
    rest: tuple[Any, ...]

    def solution(self, surface: Body, settings: _Settings) -> Solution:
        control = control_of(*settings.load, grid_of(surface))
        problem = make_problem(
            surface, settings.modulus, control, settings.operator,
            tolerance=settings.tolerance, hardness=settings.hardness,
        )  # fmt: skip
        pressure = np.zeros(problem.grid.shape)
        pressure.ravel()[self.cells] = self.pressure
        pressure.flags.writeable = False
        return Solution(problem, pressure, *self.rest)


@dataclass(frozen=True, slots=True)
class _Part:
    """Some surfaces, as a task of an executor."""

    name = "press_many"
    key: str
    surfaces: list[Body]
    settings: _Settings

    @property
    def case(self) -> _Part:
        return self


def _press_part(part: _Part) -> Result:
    """Press surfaces up to the first that fails."""
    start = time.perf_counter()
    found: list[_Found | Solution | Exception] = []
    with limit_threads(1):
        for surface in part.surfaces:
            try:
                found.append(_compact(part.settings.press(surface)))
            except Exception as error:
                found.append(error)
                break
    return Result(part.key, cast(Any, found), "", time.perf_counter() - start)


def _compact(solution: Solution) -> _Found | Solution:
    if solution.problem.size_law is not None or not isinstance(solution.pressure, np.ndarray):
        return solution  # its hardness follows from its contact
    cells = np.flatnonzero(solution.pressure)
    rest = solution.depth, solution.status, solution.residual, solution.steps
    return _Found(cells, solution.pressure.ravel()[cells], rest)


def _parts(surfaces: Iterator[Body], settings: _Settings, sent: dict[str, list[Body]]) -> Iterator[_Part]:
    """Yield parts of surfaces, and keep each under its key."""
    for first in surfaces:
        size = max(1, CELLS // grid_of(first).size)
        key = str(len(sent))
        sent[key] = [first, *islice(surfaces, size - 1)]
        yield _Part(key, sent[key], settings)


def _solutions(surfaces: Iterator[Body], settings: _Settings, executor: Executor) -> Iterator[Solution]:
    sent: dict[str, list[Body]] = {}
    done: dict[str, Result] = {}
    count = turn = 0
    parts = cast(Iterable[Task], _parts(surfaces, settings, sent))
    for result in executor.results(cast(Any, _press_part), parts):
        done[result.key] = result
        while (key := str(turn)) in done:
            each, turn = done.pop(key), turn + 1
            if each.record is None:
                raise WorkersError(f"surfaces from number {count} on were not pressed: {each.message}")
            for surface, found in zip(sent[key], cast(Any, each.record), strict=False):
                if isinstance(found, Exception):
                    found.add_note(f"This is surface number {count}, counted from 0.")
                    raise found
                yield found if isinstance(found, Solution) else found.solution(surface, settings)
                count += 1
            sent[key] = []
