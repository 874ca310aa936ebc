"""The verb ``curve``: stiffness, area and depth against load."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from roughcontact.cli import options
from roughcontact.cli.conductance_command import ConductivityOption, Materials, ResistivityOption
from roughcontact.cli.curve_answer import CurveAnswer
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import note, reported
from roughcontact.cli.output import output
from roughcontact.cli.report import note_files, quantity, screen
from roughcontact.cli.theory_options import HurstOption, RadiusOption, RolloffOption, Theories, TheoryOption
from roughcontact.cli.unit_options import FORCE, LENGTH, PRESSURE, parse_loads, parse_tolerance

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "curve"]

EXAMPLES = """Examples:

roughcontact curve part.x3p --modulus 110GPa

roughcontact curve part.x3p --forces 1mN:1N:100 --modulus 110GPa --out result

roughcontact curve part.x3p --depths 0.1um,0.2um,0.5um --young 210GPa --poisson 0.3

roughcontact curve part.x3p --modulus 110GPa --theory persson,gw,power-law --resistivity 17nohm*m --out result

roughcontact curve part.x3p --pressures 1kPa:10MPa:40 --modulus 110GPa --json
"""

_LOADS = "Loads (at most one of them)"
_KINDS = {"forces": FORCE, "pressures": PRESSURE, "depths": LENGTH}

ForcesOption = Annotated[
    str | None,
    typer.Option(
        metavar="1mN:1N:100",
        help="Normal forces: from:to:count, evenly spaced in the logarithm, or a comma list "
        "(default, if no loads are named: 30 forces from 1e-4 to 0.07 of E* h L).",
        rich_help_panel=_LOADS,
    ),
]
PressuresOption = Annotated[
    str | None,
    typer.Option(metavar="1kPa:1MPa:100", help="Nominal pressures, likewise.", rich_help_panel=_LOADS),
]
DepthsOption = Annotated[
    str | None,
    typer.Option(metavar="1nm:1um:100", help="Depths since first touch, likewise.", rich_help_panel=_LOADS),
]


def curve(
    file: options.FileArgument,
    *,
    forces: ForcesOption = None,
    pressures: PressuresOption = None,
    depths: DepthsOption = None,
    modulus: options.ModulusOption = None,
    young: options.YoungOption = None,
    poisson: options.PoissonOption = None,
    young2: options.Young2Option = None,
    poisson2: options.Poisson2Option = None,
    hardness: options.HardnessOption = None,
    resistivity: ResistivityOption = None,
    conductivity: ConductivityOption = None,
    theory: TheoryOption = None,
    hurst: HurstOption = None,
    rolloff: RolloffOption = None,
    radius: RadiusOption = None,
    channel: options.ChannelOption = None,
    unit: options.UnitOption = None,
    size: options.SizeOption = None,
    periodic: options.PeriodicOption = None,
    level: options.LevelOption = None,
    tolerance: options.ToleranceOption = "1e-8",
    out: options.OutOption = None,
    json: options.JsonOption = False,
) -> None:
    """Press a rough surface by rising loads: stiffness, area and depth against force."""
    with reported(file, out):
        given = {"forces": forces, "pressures": pressures, "depths": depths}
        named = {f"--{key}": value for key, value in given.items()}
        name = "forces" if set(given.values()) == {None} else options.only_one(named, "the loads")[2:]
        text = given[name]
        loads = None if text is None else parse_loads(text, _KINDS[name], f"--{name}")
        reduced = options.Bodies(modulus, young, poisson, young2, poisson2).reduced_modulus()
        strength = options.hardness_of(hardness)
        conductors = Materials(resistivity, conductivity).conductors()
        theories = Theories(theory, hurst, rolloff, radius)
        theories.check()
        asked = parse_tolerance(tolerance, "--tolerance")
        with output(out) as folder:
            surface = options.Reading(file, channel, unit, size, level, periodic).surface()
            laws = theories.laws(surface, reduced)
            if loads is None:
                loads = _suggested(surface, reduced)
            computed, notes = _load(surface, reduced, name, loads, asked, strength)
            answer = CurveAnswer(computed, surface, file, asked, notes, laws, conductors)
            if folder is not None:
                kind = _KINDS[name].unit
                answer.write(
                    folder, f"{name} from {loads[0]:g} to {loads[-1]:g} {kind}, {loads.size} of them"
                )
        answer.tell(json)
        note_files(folder, ("curve.csv", "curve.nc", "curve.png", "summary.json"))
        if not answer.converged:
            raise typer.Exit(MISSED)


def _suggested(surface: Surface, modulus: float) -> npt.NDArray[np.float64]:
    """Return the forces [N] that suit a surface, and say which they are."""
    from roughcontact.contact.loading import suggested_forces

    loads = suggested_forces(surface, modulus)
    low, high = (quantity("force", float(load)) for load in (loads[0], loads[-1]))
    note(
        f"no loads are named: {loads.size} forces from {low} to {high}, 1e-4 to 0.07 of E* h L (--forces for others)"
    )
    return loads


def _load(
    surface: Surface,
    modulus: float,
    name: str,
    loads: npt.NDArray[np.float64],
    tolerance: float,
    hardness: float | None,
) -> tuple[Curve, tuple[str, ...]]:
    """Return the curve and the notes on its last load; a bar on standard error moves on at every load."""
    import roughcontact as rc
    from roughcontact.contact.curve import collect

    given = {kind: loads if kind == name else None for kind in _KINDS}
    path = rc.loading_path(
        surface,
        modulus,
        forces=given["forces"],
        pressures=given["pressures"],
        depths=given["depths"],
        tolerance=tolerance,
        hardness=hardness,
    )
    notes: list[tuple[str, ...]] = []

    def watched(path: Iterator[Solution]) -> Iterator[Solution]:
        for solution in path:
            notes[:] = [solution.notes]
            yield solution

    columns = (
        TextColumn("Pressing"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
    )
    with Progress(*columns, console=screen()) as progress:
        curve = collect(progress.track(watched(path), total=loads.size))
    return curve, notes[0]
