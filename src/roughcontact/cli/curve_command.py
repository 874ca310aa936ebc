"""The command ``curve``: stiffness, area and depth against load."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any, ClassVar

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from roughcontact.cli import options
from roughcontact.cli.adhesion_options import POINTS, Sticking
from roughcontact.cli.conductance_command import Materials
from roughcontact.cli.curve_answer import CurveAnswer
from roughcontact.cli.error_options import Errors
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.job import refuse_in_slabs, slabs_of_job
from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import output
from roughcontact.cli.plastic_options import LoopLoads, write_loop
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.profile_options import ProfileBody, kinds_of
from roughcontact.cli.report import doing, note_files, quantity, screen
from roughcontact.cli.sticking_curve import curve_sticking
from roughcontact.cli.table_options import InterfaceTables
from roughcontact.cli.theory_options import Theories
from roughcontact.cli.unit_options import LENGTH, parse_loads, parse_path
from roughcontact.cli.units_of_answer import Units
from roughcontact.halfspace.operators.geometry import Geometry

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from roughcontact.contact.curve import Curve
    from roughcontact.contact.loop import Loop
    from roughcontact.contact.solution import Solution
    from roughcontact.halfspace.operators.operator import Operator
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "curve"]

EXAMPLES = {
    "curve": """
roughcontact curve part.x3p --modulus 110GPa
roughcontact curve part.x3p --forces 1N:100N:30 --modulus 110GPa --out result
roughcontact curve part.x3p --depths 0.1um,0.2um,0.5um --young 210GPa --poisson 0.3
roughcontact curve part.x3p --modulus 110GPa --theory persson,gw,power-law --resistivity 17nohm*m --out result
roughcontact curve part.x3p --pressures 1kPa:10MPa:40 --modulus 110GPa --unit-pressure MPa --unit-stiffness N/um/mm^2
roughcontact curve part.x3p --modulus 110GPa --errors --short-cutoff 5um
roughcontact curve scan.csv --profile line --forces 1N/mm:100N/mm:12 --modulus 110GPa
roughcontact curve part.x3p --materials steel,aluminium --theory mikic,cmy --hardness aluminium
roughcontact curve part.x3p --materials steel,aluminium --hardness aluminium --loop --out result
roughcontact curve part.x3p --modulus 10MPa --work 50mJ/m^2 --range 20nm --loop --depths 100nm --out result
roughcontact curve part.x3p --modulus 10MPa --work 50mJ/m^2 --range 20nm --forces 0N,1mN,-1mN
roughcontact curve part.x3p --modulus 10MPa --work 50mJ/m^2 --range 20nm --periodic --mean-gaps 3um:1um:5,3um
roughcontact curve joint.npz --modulus 110GPa --conductivity steel,aluminium --table abaqus-mm,csv --out result
""",
}

_FEWEST = 3  # resolved loads that a power law takes


@dataclass(frozen=True, slots=True)
class Loads:
    """Loads, as the user gave them: rising, with adhesion of either sign, up and down."""

    PANEL: ClassVar = "Loads (at most one of them)"
    forces: str | None = option(
        "Normal forces: from:to:count, evenly spaced in the logarithm, or a comma list "
        "(default, if no loads are named: 24 forces that suit the surface, found by a search).",
        "1N:100N:30",
    )
    pressures: str | None = option("Nominal pressures, likewise.", "1kPa:1MPa:100")
    depths: str | None = option(
        "Indentation depths since first touch, likewise. With --work depths and forces go up and down and may be "
        "negative, and from:to:count is evenly spaced; with --work and --loop one depth, where it turns.",
        "1nm:1um:100",
    )
    mean_gaps: str | None = option(
        "Mean gaps of surfaces that stick (--work), on whole periodic maps, likewise.", "100nm:20nm:9"
    )

    def values(self, body: ProfileBody | None) -> tuple[str, npt.NDArray[np.float64] | None]:
        """Return what the loads are, and their values in SI units; None where they were left out.

        Raises
        ------
        UsageError
            If several are named, or their text is none.
        ValueError
            If they are mean gaps.
        """
        given = asdict(self)
        if (gaps := given.pop("mean_gaps")) is not None:
            from roughcontact.contact.mean_gaps import refuse_gaps

            refuse_gaps(parse_path(gaps, LENGTH, "--mean-gaps"))
        if not any(text is not None for text in given.values()):
            return "forces", None
        name = options.only_one(given, "the loads")
        return name, parse_loads(given[name], kinds_of(body)[name.removesuffix("s")], f"--{name}")

    def path(self, body: ProfileBody | None) -> tuple[str, npt.NDArray[np.float64]]:
        """Return what the loads of surfaces that stick are, and their values: of either sign, up and down.

        Raises
        ------
        UsageError
            If they are pressures, or none are named: no search finds them.
        """
        if self.pressures is not None:
            raise UsageError(
                "--pressures does not go with --work: give --forces, pressures times area, or --depths"
            )
        given = {"depths": self.depths, "forces": self.forces, "mean-gaps": self.mean_gaps}
        option = options.only_one(given, "the loads of surfaces that stick")
        name, text = option.replace("-", "_"), given[option]
        assert text is not None
        return name, parse_path(text, kinds_of(body)[name.removesuffix("s")], f"--{option}")


def curve(
    reading: options.Reading,
    *,
    given: Loads,
    elasticity: options.Elasticity,
    plastic: LoopLoads,
    sticking: Sticking,
    points: int | None = POINTS,
    materials: Materials,
    theories: Theories,
    errors: Errors,
    asked: options.Answer,
    units: Units,
    tables: InterfaceTables,
) -> None:
    """Press a rough surface by rising loads: stiffness, area and more against force, or per area against pressure.

    Per area for a periodic map, with --pressures and where a unit is named: the numbers of a joint of any size.
    """
    file, out = reading.source.file, asked.out
    with reported(file, out, as_json=asked.json):
        refuse_in_slabs(
            {
                "--loop": plastic.loop,
                "--flow": plastic.flow,
                "--work": sticking.work,
                "--theory": theories.theory,
                "--errors": errors.errors,
                "--table": tables.table,
            }
        )
        if sticking.asked:
            others: dict[str, Any] = {
                "--flow": plastic.flow,
                "--theory": theories.theory,
                "--table": tables.table,
            }
            others |= {"--hardness": elasticity.hardness, "--errors": errors.errors}
            others |= {"--resistivity": materials.resistivity, "--conductivity": materials.conductivity}
            sticking.refuse(
                others | {"--unit-stiffness": units.unit_stiffness, "--unit-pressure": units.unit_pressure}
            )
            prescribed = given.path(reading.profile)
            curve_sticking(reading, prescribed, elasticity, sticking, asked, loop=plastic.loop, points=points)
            return
        in_slabs = slabs_of_job() is not None
        if points is not None:
            raise UsageError(
                "--points is about a --loop of surfaces that stick: leave it out, or give --work"
            )
        name, loads = given.values(reading.profile)
        if in_slabs and loads is None:
            raise UsageError(
                "several processes do not look for loads: name them, such as --pressures 1kPa:1MPa:20"
            )
        chosen = units.chosen()
        modulus, hardness = elasticity.reduced_modulus(), plastic.hardness(elasticity)
        plastic.check(name, errors)
        conductors = materials.conductors()
        if reading.profile is not None:
            part = None if conductors is None else materials.of.value
            reading.profile.require(conducting=part, areal_units=bool(chosen), hardness=hardness is not None)
        theories.check()
        errors.check()
        tables.check(out)
        tolerance, ending = asked.residual, asked.ending
        more: tuple[str, ...] = ()
        with output(out) as folder:
            surface = reading.surface()
            errors.check_for(surface)
            operator = reading.body(surface, modulus)
            pressed = Pressed.of(surface, modulus, elasticity.softer())
            laws, taken, refused = theories.laws(surface, modulus, hardness)
            if loads is None:
                loads = _suggested(surface, modulus, pressed, operator=operator, hardness=hardness)
            elif name != "depths" and not in_slabs:
                _look_ahead(surface, modulus, name, loads, operator)
            path = {
                "tolerance": tolerance,
                "hardness": hardness,
                "operator": operator,
                "flow": plastic.reading,
            }
            path[name] = plastic.up_and_down(loads)
            computed, notes, outer, loop = _load(surface, modulus, path, loads.size)
            left = loads[len(computed) :]
            if left.size:
                rest = ",".join(f"{load:.12g}" for load in left)
                elsewhere = "" if folder is None else ", and a new --out: this folder would be replaced"
                notes += (
                    f"stopped: {len(computed)} of {loads.size} loads are computed; compute the others with "
                    f"--{name} {rest}{elsewhere}",
                )
            per_area = name == "pressures" or all(surface.grid.periodic) or bool(chosen)
            if errors.errors and not outer:
                note("no errors: no load is resolved")
            if plastic.loop and loop is None:
                notes += ("stopped: the loop is not closed, only what was computed of first loading is kept",)
            joint = (materials.of.value, per_area, chosen, refused, errors.of(outer), pressed)
            answer = CurveAnswer(computed, surface, file, tolerance, notes, laws, taken, conductors, *joint)
            if out is not None:
                unit, done = kinds_of(reading.profile)[name.removesuffix("s")].unit, loads[: len(computed)]
                source = answer.source(f"{name} from {done[0]:g} to {done[-1]:g} {unit}, {done.size} of them")
            if folder is not None:
                with doing("Writing files"):
                    answer.write(folder, source, ending)
                    more = tables.write(folder, computed, surface, conductors)
                    if loop is not None:
                        more += write_loop(loop, folder, source, ending)
        answer.tell(asked.json, loop)
        if folder is not None:
            note_files(folder, ("curve.csv", "curve.json", "curve.nc", f"curve.{ending}", *more))
        if left.size or (plastic.loop and loop is None):
            raise typer.Exit(INTERRUPTED)
        if not answer.converged:
            raise typer.Exit(MISSED)


def _suggested(
    surface: Surface, modulus: float, pressed: Pressed, *, operator: Operator | None, hardness: float | None
) -> npt.NDArray[np.float64]:
    """Return the forces [N] that suit a surface, and say which they are."""
    from roughcontact.contact.load_outlook import load_outlook
    from roughcontact.contact.load_range import load_range
    from roughcontact.halfspace.operators.operator import geometry_of

    with doing("Looking for the loads that suit this surface"):
        found = load_range(surface, modulus, operator=operator, hardness=hardness)
    loads, end = found.forces, found.reasons[1]
    kind = Geometry.SURFACE if operator is None else geometry_of(operator)
    low, high = (quantity("force", float(load), kind) for load in (loads[0], loads[-1]))
    below = found.below
    if kind is Geometry.LINE:  # whose forces are not searched for
        below = load_outlook(surface, modulus, forces=loads, operator=operator).below
    note(
        f"the map is {pressed.words}; no loads are named: {loads.size} forces from {low} to {high}, to {end}, "
        f"{below} of them below what the grid resolves (--forces for others)"
    )
    for line in found.notes:
        note(line)
    return loads


def _look_ahead(
    surface: Surface, modulus: float, name: str, loads: npt.NDArray[np.float64], operator: Operator | None
) -> None:
    """Say before the work if the grid resolves none of the named loads, or too few for a power law."""
    from roughcontact.contact.load_outlook import load_outlook

    given: dict[str, Any] = {name: loads}
    with doing("Looking which of these loads the grid resolves"):
        ahead = load_outlook(surface, modulus, operator=operator, **given)
    if ahead.resolved >= min(_FEWEST, ahead.count):
        return
    ends = ((ahead.below, "too small: the cells set the stiffness"), (ahead.above, "near full contact"))
    why = ", ".join(f"{count} {words}" for count, words in ends if count)
    note(
        f"{ahead.resolved or 'none'} of the {ahead.count} {name} can be resolved by this grid ({why}): leave out "
        f"--{name}, and forces that suit the map are found"
    )


def _load(
    surface: Surface, modulus: float, given: dict[str, Any], count: int
) -> tuple[Curve, tuple[str, ...], list[Solution], Loop | None]:
    """Return the curve, the notes on its last load, the first and last load that are resolved, and the whole loop.

    There is a loop where more loads are given than the `count` of the curve. A bar on standard error moves on at every
    load. Ctrl-C ends the curve with the loads that are done.
    """
    import roughcontact as rc
    from roughcontact.contact.curve import collect
    from roughcontact.contact.loop import closed_loop

    path = rc.loading_path(surface, modulus, **given)
    total = max(len(loads) for name, loads in given.items() if name in ("forces", "depths", "pressures"))
    notes: list[tuple[str, ...]] = []
    ends: list[Solution] = []
    turn: list[Solution] = []

    def watched(path: Iterator[Solution]) -> Iterator[Solution]:
        try:
            for solution in islice(path, count):
                resolved = solution.resolved and solution.status.converged  # which takes as long as the load
                notes[:], turn[:] = [solution.notes], [solution]
                if resolved:
                    ends[1 if ends else 0 :] = [solution]
                yield solution
        except KeyboardInterrupt:
            if not notes:  # nothing to keep
                raise

    columns = (
        TextColumn("Pressing"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
    )
    with Progress(*columns, console=screen()) as progress:
        task = progress.add_task("Pressing", total=total)

        def moving(path: Iterator[Solution]) -> Iterator[Solution]:
            for solution in path:
                progress.advance(task)
                yield solution

        curve = collect(moving(watched(path)))
        loop = None
        if len(curve) == count < total:
            with suppress(KeyboardInterrupt):
                loop = closed_loop(curve, turn[0], moving(path))
    return curve, notes[0], ends, loop
