"""The command ``press``: one load, its pressure map and summary."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.arrays import max_abs
from roughcontact.cli import options
from roughcontact.cli.contact.error_options import Errors, LoadErrors
from roughcontact.cli.contact.plastic_options import AfterLoad
from roughcontact.cli.contact.profile_options import kinds_of
from roughcontact.cli.exits import MISSED
from roughcontact.cli.job import communicator_of_job
from roughcontact.cli.load_options import OneLoad
from roughcontact.cli.messages import UsageError, note, plain, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.pressed import Pressed, best_state
from roughcontact.cli.report import doing, emit, note_files, print_facts, solution_facts

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["EXAMPLES", "press"]

EXAMPLES = {
    "press": """
roughcontact press part.x3p --force 10N --modulus 110GPa --out result
roughcontact press part.x3p --pressure 1MPa --young 210GPa --poisson 0.3
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --theory persson --out result
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --errors --short-cutoff 5um
roughcontact press part.x3p --force 10N --after 100N --materials steel,aluminium --hardness aluminium --out result
roughcontact press scan.csv --profile line --force 10N/mm --modulus 110GPa --out result
roughcontact press h.csv --unit nm --size 1mm --depth 5um --modulus 110GPa
""",
}

_DRAWN = 2**22  # cells of a picture: more are not gathered by the one process of a job that draws

Theory = StrEnum("Theory", ["PERSSON"])
_THEORY = option(
    "With --out: draw the distribution of the pressure beside that of a theory.",
    needs_whole=True,
    rich_help_panel="Answer",
)


def press(
    reading: options.Reading,
    *,
    load: OneLoad,
    bodies: options.TwoBodies,
    plastic: AfterLoad,
    theory: Theory | None = _THEORY,
    errors: Errors,
    answer: options.Answer,
) -> None:
    """Press a rough surface by one load: pressure map, area, depth and stiffness."""
    import roughcontact as rc

    file, out = reading.source.file, answer.out
    with reported(file, out, as_json=answer.json):
        given, body, ending = load.value(reading.profile), reading.profile, answer.ending
        errors.check()
        if theory is not None and out is None:
            raise UsageError("--theory draws a picture", "say where by --out", place="--theory")
        if theory is not None and body is not None:
            raise UsageError(
                "--theory is about the pressures of a surface, not of a profile",
                "leave it out",
                place="--theory",
            )
        limits: dict[str, Any] = {"tolerance": answer.residual, "hardness": plastic.hardness(bodies)}
        first = plastic.first(given, body)
        plastic.check(errors)
        if body is not None:
            body.require(conducting=None, areal_units=False, hardness=limits["hardness"] is not None)
        modulus = bodies.elasticity.reduced_modulus()
        drawn: tuple[str, ...] = ()
        with output(out) as folder:
            surface = reading.surface()
            errors.check_for(surface)
            pressed = Pressed.of(surface, modulus, bodies.softer())
            limits["operator"] = reading.body(surface, modulus)
            if first is None and not plastic.raises:
                solution = best_state(rc.press, surface, modulus, **given, **limits)
            else:
                solution = plastic.last_of(surface, modulus, given, first, limits)
                if solution.flow is None or not solution.flow.volume:
                    note("nothing flowed: the contact is elastic")
            found = errors.of([solution])
            budget = {"errors": found[0].to_record() if found else None}
            with doing("Stiffness, spots and files"):
                record = _record(solution, file, pressed) | budget
                [(name, value)] = given.items()
                control = f"{name} = {value!r} {kinds_of(body)[name].unit}"
                control += "" if first is None else f" after {first!r}"
                if out is not None:
                    drawn = _write(solution, record, folder, _source(solution, control), theory, ending)
                if folder is not None:
                    drawn += plastic.draw(surface, solution, folder, ending)
        per_area = "pressure" in given or all(surface.grid.periodic)
        _tell(solution, record, pressed, found, json=answer.json, per_area=per_area)
        pictures = (*(() if theory is None else ("distribution",)), *drawn)
        note_files(folder, ("press.json", "pressure.nc", *(f"{name}.{ending}" for name in pictures)))
        if not solution.status.converged:
            raise typer.Exit(MISSED)


def _record(solution: Solution, file: Path, pressed: Pressed) -> dict[str, Any]:
    from roughcontact.contact.dataset import solution_record

    surface = solution.problem.surface
    history = list(surface.provenance) if surface is not None else []
    return {
        "command": "press",
        "file": plain(str(file)),
        "surface": history,
        **pressed.record(),
        **solution_record(solution),
        "largest_pressure": max_abs(solution.pressure),
        "tolerance": solution.problem.tolerance,
        "converged": solution.status.converged,
    }


def _source(solution: Solution, control: str) -> dict[str, Any]:
    """Return what files say of where they come from."""
    from roughcontact.files.provenance import provenance

    problem = solution.problem
    return provenance(
        problem.surface,
        modulus=problem.modulus,
        control=control,
        tolerance=problem.tolerance,
        command=command_line(),
    )


def _write(
    solution: Solution,
    record: dict[str, Any],
    folder: Path | None,
    source: dict[str, Any],
    theory: Theory | None,
    ending: str,
) -> tuple[str, ...]:
    """Write a loaded state into the folder that the first process of a job has; return the names of its pictures."""
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
                save(solution_figure(drawn), aside / f"pressure.{ending}")
            if theory is not None:
                theories = {theory.value: persson_pressures(solution)}
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
    pressed: Pressed,
    errors: tuple[LoadErrors, ...],
    *,
    json: bool,
    per_area: bool,
) -> None:
    if json:
        emit(record)
    else:
        size, *others = solution_facts(solution)
        print_facts([size, *pressed.facts(), *others])
        for each in errors:
            each.tell({}, patch=True, joint=per_area)
    for line in solution.notes:
        note(line)
