"""The command ``curve``: stiffness, area and depth against load."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from typing import TYPE_CHECKING, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from roughcontact.cli import options
from roughcontact.cli.contact.conductance_command import Materials
from roughcontact.cli.contact.curve_answer import CurveAnswer
from roughcontact.cli.contact.error_options import Errors
from roughcontact.cli.contact.plastic_options import LoopLoads, write_loop
from roughcontact.cli.contact.table_options import InterfaceTables
from roughcontact.cli.contact.theory_options import Theories
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.load_options import RisingLoads, unit_of_loads
from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.output import output
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.report import doing, note_files, quantity, screen
from roughcontact.cli.units_of_answer import Units
from roughcontact.halfspace.operators.geometry import Geometry

if TYPE_CHECKING:
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.loop import Loop
    from roughcontact.contact.solution import Solution
    from roughcontact.halfspace.operators.operator import Operator
    from roughcontact.solver.loads import Loads
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
roughcontact curve joint.npz --modulus 110GPa --conductivity steel,aluminium --table abaqus-mm,csv --out result
""",
}

_FEWEST = 3  # resolved loads that a power law takes


def curve(
    reading: options.Reading,
    *,
    given: RisingLoads,
    bodies: options.TwoBodies,
    plastic: LoopLoads,
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
        in_slabs = slabs_of_job() is not None
        loads = given.values(reading.profile)
        if in_slabs and loads is None:
            raise UsageError(
                "several processes do not look for loads", "name them, such as --pressures 1kPa:1MPa:20"
            )
        chosen = units.chosen()
        modulus, hardness = bodies.elasticity.reduced_modulus(), plastic.hardness(bodies)
        plastic.check(loads, errors)
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
            pressed = Pressed.of(surface, modulus, bodies.softer())
            laws, taken, refused = theories.laws(surface, modulus, hardness)
            if loads is None:
                loads = _suggested(surface, modulus, pressed, operator=operator, hardness=hardness)
            elif loads.kind != "depth" and not in_slabs:
                _look_ahead(surface, modulus, loads, operator)
            values, option = loads.values, f"--{loads.kind}s"
            limits = {
                "tolerance": tolerance,
                "hardness": hardness,
                "operator": operator,
                "flow": plastic.reading,
            }
            path = plastic.up_and_down(loads)
            computed, notes, outer, loop = _load(surface, modulus, path, values.size, limits)
            left = values[len(computed) :]
            if left.size:
                rest = ",".join(f"{load:.12g}" for load in left)
                elsewhere = "" if folder is None else ", and a new --out: this folder would be replaced"
                notes += (
                    f"stopped: {len(computed)} of {values.size} loads are computed; compute the others with "
                    f"{option} {rest}{elsewhere}",
                )
            per_area = loads.kind == "pressure" or all(surface.grid.periodic) or bool(chosen)
            if errors.errors and not outer:
                note("no errors: no load is resolved")
            if plastic.loop and loop is None:
                notes += ("stopped: the loop is not closed, only what was computed of first loading is kept",)
            joint = (materials.of.value, per_area, chosen, refused, errors.of(outer), pressed)
            answer = CurveAnswer(computed, surface, file, tolerance, notes, laws, taken, conductors, *joint)
            if out is not None:
                unit, done = unit_of_loads(loads, reading.profile), values[: len(computed)]
                source = answer.source(
                    f"{loads.kind}s from {done[0]:g} to {done[-1]:g} {unit}, {done.size} of them"
                )
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
) -> Loads:
    """Return the forces [N] that suit a surface, and say which they are."""
    from roughcontact.contact.loads.load_outlook import load_outlook
    from roughcontact.contact.loads.load_range import load_range
    from roughcontact.halfspace.operators.operator import geometry_of
    from roughcontact.solver.loads import Loads

    with doing("Looking for the loads that suit this surface"):
        found = load_range(surface, modulus, operator=operator, hardness=hardness)
    loads, end = Loads("force", found.forces), found.reasons[1]
    kind = Geometry.SURFACE if operator is None else geometry_of(operator)
    low, high = (quantity("force", float(load), kind) for load in loads.values[[0, -1]])
    below = found.below
    if kind is Geometry.LINE:  # whose forces are not searched for
        below = load_outlook(surface, modulus, loads, operator).below
    small = "below what the grid resolves"
    if kind is Geometry.SURFACE:  # where the stiffness may be resolved already
        small = "so light that single cells set their area and pressure"
    note(
        f"the map is {pressed.words}; no loads are named: {loads.values.size} forces from {low} to {high}, to {end}, "
        f"{below} of them {small} (--forces for others)"
    )
    for line in found.notes:
        note(line)
    return loads


def _look_ahead(surface: Surface, modulus: float, loads: Loads, operator: Operator | None) -> None:
    """Say before the work if the grid resolves none of the named loads, or too few for a power law."""
    from roughcontact.contact.loads.load_outlook import load_outlook

    name = f"{loads.kind}s"
    with doing("Looking which of these loads the grid resolves"):
        ahead = load_outlook(surface, modulus, loads, operator)
    if ahead.resolved >= min(_FEWEST, ahead.count):
        return
    ends = ((ahead.below, "too small: the cells set the stiffness"), (ahead.above, "near full contact"))
    why = ", ".join(f"{count} {words}" for count, words in ends if count)
    note(
        f"{ahead.resolved or 'none'} of the {ahead.count} {name} can be resolved by this grid ({why}): leave out "
        f"--{name}, and forces that suit the map are found"
    )


def _load(
    surface: Surface, modulus: float, loads: Loads, count: int, limits: dict[str, Any]
) -> tuple[Curve, tuple[str, ...], list[Solution], Loop | None]:
    """Return the curve, the notes on its last load, the first and last load that are resolved, and the whole loop.

    There is a loop where more loads are given than the `count` of the curve. A bar on standard error moves on at every
    load. Ctrl-C ends the curve with the loads that are done.
    """
    from roughcontact.contact.curve import collect
    from roughcontact.contact.loading import solutions_along
    from roughcontact.contact.loop import closed_loop

    path, total = solutions_along(surface, modulus, loads, **limits), loads.values.size
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
