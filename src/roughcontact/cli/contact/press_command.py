"""The command ``press``: one load, its pressure map and summary."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.contact.load_errors import LoadErrors, errors_of, notes_on_errors, require_errors
from roughcontact.cli.contact.loop_files import write_flattened
from roughcontact.cli.contact.units_of_job import units_of_job
from roughcontact.cli.contact_of_job import best_state, contact_of, hardness_of_job, name_of, softer_of
from roughcontact.cli.exits import MISSED
from roughcontact.cli.job import communicator_of_job
from roughcontact.cli.messages import UsageError, note, note_all
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, output, source_of
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.report import emit, print_facts, solution_facts, stiffness_facts
from roughcontact.progress.events import task
from roughcontact.recipe.elastic_jobs import PressJob
from roughcontact.recipe.plastic_flow import AfterLoad
from roughcontact.recipe.prescribed_loads import kinds_of
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from collections.abc import Mapping

    from roughcontact.contact.solution import Solution
    from roughcontact.evaluation.error_budget import ErrorBudget
    from roughcontact.labels.engineering_units import Scale

__all__ = ["EXAMPLES", "press"]

EXAMPLES = {
    "press": """
roughcontact press part.x3p --force 10N --modulus 110GPa --out result
roughcontact press part.x3p --pressure 1MPa --young 210GPa --poisson 0.3 --unit-stiffness MPa/mm
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --theory persson --out result
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --errors --shortest-wave 5um
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --despike filled --short-cutoff 10um
roughcontact press part.x3p --force 10N --after 100N --materials steel,aluminium --hardness aluminium --out result
roughcontact press scan.csv --profile line --force 10N/mm --modulus 110GPa --out result
roughcontact press h.csv --unit nm --size 1mm --depth 5um --modulus 110GPa
""",
}

_DRAWN = 2**22  # cells of a picture: one process draws, and it does not gather larger fields


def press(job: PressJob, *, answer: Answer) -> None:
    """Press a rough surface by one load: pressure map, area, depth and stiffness."""
    theory = job.theories.theory
    if theory is not None and answer.out is None:
        raise UsageError("--theory draws a picture", "say where by --out", "theories.theory")
    hardness_of_job(job)
    with output(answer.out) as folder:
        known = contact_of(job)
        surface = known["surface"]
        require_errors(job.errors, surface)
        pressed = Pressed.of(surface, known["modulus"], softer_of(job))
        solution: Solution = best_state(next(job.calls()), known)
        elastic: Solution | None = None
        if job.plastic.after is not None:
            elastic = best_state(next(replace(job, plastic=AfterLoad()).calls()), known)
            if not elastic.status.converged:
                note(f"without plastic flow, residual {elastic.residual:.1e}: {elastic.status.message}")
        if (job.plastic.after or job.plastic.flow == "raised") and not (
            solution.flow is not None and solution.flow.volume
        ):
            note("nothing flowed: the contact is elastic")
        errors = errors_of(job.errors, [solution])
        drawn: tuple[str, ...] = ()
        with task("Stiffness, spots and files"):
            record = _record(solution, job, pressed, elastic)
            if answer.json or answer.out is not None:
                record["recipe"] = carried(job, answer.out)
            record["errors"] = errors[0].to_record() if errors else None
            if answer.out is not None:
                source = source_of(solution.problem, record["recipe"], _control(job))
                budget = errors[0].budget if errors else None
                drawn = _write(solution, record, folder, source, theory, answer.ending, budget)
            if folder is not None and solution.flow is not None and solution.flow.volume:
                drawn += write_flattened(surface, solution.problem.flow, folder, answer.ending)
    per_area = job.load.pressure is not None or all(surface.grid.periodic)
    units = units_of_job(job.units)
    facts, compared = pressed.facts(), []
    if elastic is not None:
        facts.append(("load", _unloaded(job)))
        compared = stiffness_facts(elastic, "without plastic flow", units)
    _tell(solution, record, facts, compared, errors, units=units, json=answer.json, per_area=per_area)
    pictures = (*(() if theory is None else ("distribution",)), *drawn)
    files = ("press.json", "pressure.nc", *(f"{name}.{answer.ending}" for name in pictures))
    answer.finish(folder, files, job, solution)
    if not all(each.status.converged for each in (solution, elastic) if each is not None):
        raise typer.Exit(MISSED)


def _control(job: PressJob) -> str:
    """Return the prescribed load, with its unit."""
    [(name, value)] = job.load.named(job.contact.profile).items()
    words = f"{name} = {value!r} {kinds_of(job.contact.profile)[name].unit}"
    [loads] = job.loads().values()
    return words if job.plastic.after is None else f"{words} after {loads[0]!r}"


def _unloaded(job: PressJob) -> str:
    """Return the load, and the larger load before it."""
    from roughcontact.labels.engineering_units import written

    [(name, (first, last))] = job.loads().items()
    unit = kinds_of(job.contact.profile)[name.removesuffix("s")].unit
    return f"{name.removesuffix('s')} {written(last, unit)}, unloaded from {written(first, unit)}"


def _record(solution: Solution, job: PressJob, pressed: Pressed, elastic: Solution | None) -> dict[str, Any]:
    from roughcontact.contact.dataset import solution_record

    surface = solution.problem.surface
    history = list(surface.provenance) if surface is not None else []
    return {
        "command": job.NAME,
        "file": name_of(job.source),
        "surface": history,
        **pressed.record(),
        **solution_record(solution),
        "without_plastic_flow": None if elastic is None else solution_record(elastic),
        "tolerance": solution.problem.tolerance,
        "converged": solution.status.converged,
    }


def _write(
    solution: Solution,
    record: dict[str, Any],
    folder: Path | None,
    source: dict[str, Any],
    theory: str | None,
    ending: str,
    errors: ErrorBudget | None,
) -> tuple[str, ...]:
    """Write a loaded state into a folder (by the first process only); return the names of its pictures."""
    from roughcontact.evaluation.theories import persson_pressures
    from roughcontact.files.save import write_solution
    from roughcontact.files.write import write_json
    from roughcontact.plot.canvas import pressure_distribution_figure, save, solution_figure
    from roughcontact.slabs.agreement import by_first, entered_by_first

    communicator, size = communicator_of_job(), solution.problem.grid.size
    drawn = solution.on_host() if communicator.size == 1 or size <= _DRAWN else None

    with entered_by_first(communicator, lambda: all_or_none(folder or Path())) as aside:
        write_solution(solution, aside / "pressure.nc", source)

        def write() -> None:
            if drawn is not None:
                save(solution_figure(drawn, errors), aside / f"pressure.{ending}")
            if theory is not None:
                theories = {theory: persson_pressures(solution)}
                save(pressure_distribution_figure(solution, theories), aside / f"distribution.{ending}")
            write_json(record, aside / "press.json", source)

        by_first(communicator, write)
    if drawn is None:
        note(f"no picture: {size} cells are more than the {_DRAWN} that one process draws")
        return ()
    return ("pressure",)


def _tell(
    solution: Solution,
    record: dict[str, Any],
    facts: list[tuple[str, str]],
    compared: list[tuple[str, str]],
    errors: tuple[LoadErrors, ...],
    *,
    units: Mapping[str, Scale],
    json: bool,
    per_area: bool,
) -> None:
    from roughcontact.contact.notes.solution_notes import notes_on

    if json:
        emit(record)
    else:
        size, *others = solution_facts(solution, units)
        print_facts([size, *facts, *others, *compared])
        for each in errors:
            each.tell(units, patch=True, joint=per_area)
    note_all([*notes_on(solution), *notes_on_errors(errors)])
