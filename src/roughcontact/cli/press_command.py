"""The command ``press``: one load, its pressure map and summary."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import typer

from roughcontact.arrays import largest
from roughcontact.cli import options
from roughcontact.cli.adhesion_options import Sticking
from roughcontact.cli.error_options import Errors, LoadErrors
from roughcontact.cli.exits import MISSED
from roughcontact.cli.job import refuse_in_slabs, slabs_of_job
from roughcontact.cli.messages import UsageError, note, plain, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.plastic_options import AfterLoad
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.profile_options import ProfileBody, kinds_of
from roughcontact.cli.report import doing, emit, note_files, print_facts, solution_facts
from roughcontact.cli.sticking_press import press_sticking
from roughcontact.cli.unit_options import parse, parse_load
from roughcontact.cli.write_from_slabs import write_from_slabs

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "press"]

EXAMPLES = {
    "press": """
roughcontact press part.x3p --force 10N --modulus 110GPa --out result
roughcontact press part.x3p --pressure 1MPa --young 210GPa --poisson 0.3
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --theory persson --out result
roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --errors --short-cutoff 5um
roughcontact press part.x3p --force 10N --after 100N --materials steel,aluminium --hardness aluminium --out result
roughcontact press part.x3p --depth -2nm --modulus 10MPa --work 50mJ/m^2 --range 20nm --out result
roughcontact press scan.csv --profile line --force 10N/mm --modulus 110GPa --out result
roughcontact press h.csv --unit nm --size 1mm --depth 5um --modulus 110GPa
""",
}

Theory = StrEnum("Theory", ["PERSSON"])
_THEORY = option(
    "With --out: draw the distribution of the pressure beside that of a theory.", rich_help_panel="Answer"
)


@dataclass(frozen=True, slots=True)
class Load:
    """One load, as the user gave it."""

    PANEL: ClassVar = "Load (one of them)"
    force: str | None = option("Normal force.", "10N")
    pressure: str | None = option("Nominal pressure: force over area.", "1MPa")
    depth: str | None = option(
        "Indentation depth: approach since first touch; with --work also negative.", "1um"
    )

    def value(self, body: ProfileBody | None) -> dict[str, float]:
        """Return the load in SI units, by its name."""
        given = asdict(self)
        name = options.only_one(given, "one load")
        return {name: parse_load(given[name], kinds_of(body)[name], f"--{name}")}

    def signed(self, body: ProfileBody | None) -> dict[str, float]:
        """Return a depth of either sign or a force of at least 0, of surfaces that stick."""
        given = asdict(self)
        name = options.only_one(given, "one load")
        if name == "pressure":
            raise UsageError(
                "--pressure does not go with --work: give --force, pressure times area, or --depth"
            )
        value = parse(given[name], kinds_of(body)[name], f"--{name}")
        if name == "force" and value < 0:
            raise UsageError(
                f"--force {given[name]} pulls, and a press is the end of an approach: a tension comes on the way back; "
                f"give 'curve --forces 0N,{given[name]}'"
            )
        return {name: value}


def press(
    reading: options.Reading,
    *,
    load: Load,
    elasticity: options.Elasticity,
    plastic: AfterLoad,
    sticking: Sticking,
    theory: Theory | None = _THEORY,
    errors: Errors,
    answer: options.Answer,
) -> None:
    """Press a rough surface by one load: pressure map, area, depth and stiffness."""
    file, out = reading.source.file, answer.out
    with reported(file, out, as_json=answer.json):
        slabs = slabs_of_job()
        refuse_in_slabs(
            {
                "--after": plastic.after,
                "--flow": plastic.flow,
                "--work": sticking.work,
                "--theory": theory,
                "--errors": errors.errors,
            }
        )
        if sticking.asked:
            others: dict[str, Any] = {"--after": plastic.after, "--flow": plastic.flow, "--theory": theory}
            sticking.refuse(others | {"--hardness": elasticity.hardness, "--errors": errors.errors})
            press_sticking(reading, load.signed(reading.profile), elasticity, sticking, answer)
            return
        given, body, ending = load.value(reading.profile), reading.profile, answer.ending
        errors.check()
        if theory is not None and out is None:
            raise UsageError("--theory draws a picture: say where by --out")
        if theory is not None and body is not None:
            raise UsageError("--theory is about the pressures of a surface, not of a profile: leave it out")
        limits: dict[str, Any] = {"tolerance": answer.residual, "hardness": plastic.hardness(elasticity)}
        first = plastic.first(given, body)
        plastic.check(errors)
        if body is not None:
            body.require(conducting=None, areal_units=False, hardness=limits["hardness"] is not None)
        modulus = elasticity.reduced_modulus()
        drawn: tuple[str, ...] = ()
        with output(out) as folder:
            surface = reading.surface()
            errors.check_for(surface)
            pressed = Pressed.of(surface, modulus, elasticity.softer())
            limits["operator"] = reading.body(surface, modulus)
            if first is None and not plastic.raises:
                solution = _solve(surface, modulus, **given, **limits)
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
                if slabs is not None and out is not None:
                    drawn = write_from_slabs(
                        slabs, solution, record, folder, _source(solution, control), ending
                    )
                elif folder is not None:
                    _write(solution, record, folder, _source(solution, control), theory, ending)
                    drawn = ("pressure", *plastic.draw(surface, solution, folder, ending))
        per_area = "pressure" in given or all(surface.grid.periodic)
        _tell(solution, record, pressed, found, json=answer.json, per_area=per_area)
        pictures = (*(() if theory is None else ("distribution",)), *drawn)
        note_files(folder, ("press.json", "pressure.nc", *(f"{name}.{ending}" for name in pictures)))
        if not solution.status.converged:
            raise typer.Exit(MISSED)


def _solve(surface: Surface, modulus: float, **given: Any) -> Solution:
    """Return the loaded state, the best that was reached where the tolerance was missed."""
    import roughcontact as rc

    cells = " x ".join(str(n) for n in surface.grid.shape)
    with doing(f"Pressing {cells} cells"):
        try:
            solution: Solution = rc.press(surface, modulus, **given)
        except rc.ConvergenceError as error:
            solution = error.solution
    return solution


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
        "largest_pressure": largest(solution.pressure),
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
    folder: Path,
    source: dict[str, Any],
    theory: Theory | None,
    ending: str,
) -> None:
    from roughcontact.contact.dataset import solution_dataset
    from roughcontact.contact.theories import persson_pressures
    from roughcontact.files.write import write_json, write_netcdf
    from roughcontact.plot.canvas import pressure_distribution_figure, save, solution_figure

    with all_or_none(folder) as aside:
        write_netcdf(solution_dataset(solution), aside / "pressure.nc", source)
        save(solution_figure(solution), aside / f"pressure.{ending}")
        if theory is not None:
            theories = {theory.value: persson_pressures(solution)}
            save(pressure_distribution_figure(solution, theories), aside / f"distribution.{ending}")
        write_json(record, aside / "press.json", source)


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
