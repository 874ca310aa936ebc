"""The verb ``press``: one load, its pressure map and summary."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from roughcontact.cli import options
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import UsageError, note, plain, reported
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import emit, note_files, print_facts, screen, solution_facts
from roughcontact.cli.unit_options import FORCE, LENGTH, PRESSURE, parse_load, parse_tolerance

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from roughcontact.contact.solution import Solution
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "press"]

EXAMPLES = """Examples:

roughcontact press part.x3p --force 10N --modulus 110GPa --out result

roughcontact press part.x3p --pressure 1MPa --young 210GPa --poisson 0.3

roughcontact press part.x3p --pressure 1MPa --modulus 110GPa --theory persson --out result

roughcontact press h.csv --unit nm --size 1mm --depth 5um --modulus 110GPa
"""

_LOAD = "Load (one of them)"
_KINDS = {"force": FORCE, "pressure": PRESSURE, "depth": LENGTH}


class Theory(StrEnum):
    """Theories of the distribution of the pressure."""

    PERSSON = "persson"


ForceOption = Annotated[str | None, typer.Option(metavar="10N", help="Normal force.", rich_help_panel=_LOAD)]
PressureOption = Annotated[
    str | None, typer.Option(metavar="1MPa", help="Nominal pressure: force over area.", rich_help_panel=_LOAD)
]
TheoryOption = Annotated[
    Theory | None,
    typer.Option(
        help="With --out: draw the distribution of the pressure beside that of a theory.",
        rich_help_panel="Answer",
    ),
]
DepthOption = Annotated[
    str | None, typer.Option(metavar="1um", help="Approach since first touch.", rich_help_panel=_LOAD)
]


def press(
    file: options.FileArgument,
    *,
    force: ForceOption = None,
    pressure: PressureOption = None,
    depth: DepthOption = None,
    modulus: options.ModulusOption = None,
    young: options.YoungOption = None,
    poisson: options.PoissonOption = None,
    young2: options.Young2Option = None,
    poisson2: options.Poisson2Option = None,
    channel: options.ChannelOption = None,
    unit: options.UnitOption = None,
    size: options.SizeOption = None,
    periodic: options.PeriodicOption = None,
    level: options.LevelOption = None,
    hardness: options.HardnessOption = None,
    theory: TheoryOption = None,
    tolerance: options.ToleranceOption = "1e-8",
    out: options.OutOption = None,
    json: options.JsonOption = False,
) -> None:
    """Press a rough surface by one load: pressure map, area, depth and stiffness."""
    with reported(file, out):
        given = {"force": force, "pressure": pressure, "depth": depth}
        name = options.only_one({f"--{key}": value for key, value in given.items()}, "one load")[2:]
        if theory is not None and out is None:
            raise UsageError("--theory draws a picture: say where by --out")
        load = {name: parse_load(str(given[name]), _KINDS[name], f"--{name}")}
        asked = parse_tolerance(tolerance, "--tolerance")
        reduced = options.Bodies(modulus, young, poisson, young2, poisson2).reduced_modulus()
        strength = options.hardness_of(hardness)
        with output(out) as folder:
            surface = options.Reading(file, channel, unit, size, level, periodic).surface()
            solution = _solve(surface, reduced, load, asked, strength)
            record = _record(solution, file)
            if folder is not None:
                _write(solution, record, folder, f"{name} = {load[name]!r} {_KINDS[name].unit}", theory)
        _tell(solution, record, json)
        pictures = ("pressure.png",) if theory is None else ("distribution.png", "pressure.png")
        note_files(folder, ("pressure.nc", *pictures, "summary.json"))
        if not solution.status.converged:
            raise typer.Exit(MISSED)


def _solve(
    surface: Surface, modulus: float, load: dict[str, float], tolerance: float, hardness: float | None
) -> Solution:
    """Return the loaded state, the best that was reached where the tolerance was missed."""
    import roughcontact as rc

    cells = " x ".join(str(n) for n in surface.grid.shape)
    with screen().status(f"Pressing {cells} cells ..."):
        try:
            return rc.press(
                surface,
                modulus,
                force=load.get("force"),
                pressure=load.get("pressure"),
                depth=load.get("depth"),
                tolerance=tolerance,
                hardness=hardness,
            )
        except rc.ConvergenceError as error:
            return error.solution


def _record(solution: Solution, file: Path) -> dict[str, Any]:
    from roughcontact.contact.dataset import solution_record

    surface = solution.problem.surface
    history = list(surface.provenance) if surface is not None else []
    return {
        "verb": "press",
        "file": plain(str(file)),
        "surface": history,
        **solution_record(solution),
        "largest_pressure": float(solution.pressure.max()),
        "tolerance": solution.problem.tolerance,
        "converged": solution.status.converged,
    }


def _write(
    solution: Solution, record: dict[str, Any], folder: Path, control: str, theory: Theory | None
) -> None:
    from roughcontact.contact.dataset import solution_dataset
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_json, write_netcdf
    from roughcontact.plot.canvas import save, solution_figure

    problem = solution.problem
    source = provenance(
        problem.surface,
        modulus=problem.modulus,
        control=control,
        tolerance=problem.tolerance,
        command=command_line(),
    )
    with all_or_none(folder) as aside:
        write_netcdf(solution_dataset(solution), aside / "pressure.nc", source)
        save(solution_figure(solution), aside / "pressure.png")
        if theory is not None:
            save(_distribution(solution), aside / "distribution.png")
        write_json(record, aside / "summary.json", source)


def _distribution(solution: Solution) -> Figure:
    from roughcontact.contact.theories import persson_pressures
    from roughcontact.plot.distributions import pressure_distribution_figure

    return pressure_distribution_figure(solution, {"Persson": persson_pressures(solution)})


def _tell(solution: Solution, record: dict[str, Any], json: bool) -> None:
    if json:
        emit(record)
    else:
        print_facts(solution_facts(solution))
    for line in solution.notes:
        note(line)
