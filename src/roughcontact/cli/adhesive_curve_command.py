"""The commands ``adhesion curve`` and ``adhesion loop``: approach and retreat of surfaces that stick, with jumps."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli import options
from roughcontact.cli.adhesion_options import AdhesionLaw, note_unresolved
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.load_options import AdhesiveLoads, unit_of_loads
from roughcontact.cli.messages import note, plain, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.path_answer import collected
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.report import (
    ADHESIVE_COLUMNS,
    adhesive_curve_facts,
    doing,
    emit,
    law_facts,
    load_table,
    note_files,
    print_facts,
    print_table,
    size_of,
)
from roughcontact.cli.unit_options import LENGTH, parse

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.solver.loads import Loads

__all__ = ["EXAMPLES", "curve", "loop"]

EXAMPLES = {
    "curve": """
roughcontact adhesion curve part.x3p --depths -20nm:20nm:9,-20nm --modulus 10MPa --work 50mJ/m^2 --range 20nm
roughcontact adhesion curve part.x3p --forces 0N,1mN,-1mN --modulus 10MPa --work 50mJ/m^2 --range 20nm --out result
roughcontact adhesion curve part.x3p --mean-gaps 3um:1um:5,3um --periodic --modulus 10MPa --work 50mJ/m^2 --range 20nm
""",
    "loop": """
roughcontact adhesion loop part.x3p --depth 100nm --modulus 10MPa --work 50mJ/m^2 --range 20nm --out result
roughcontact adhesion loop part.x3p --depth 20nm --points 10 --modulus 10MPa --work 50mJ/m^2 --range 20nm --json
""",
}

_PANEL = "Loads"
_TURN: str = option(
    "Indentation depth at which the retreat begins; it may be negative.",
    "20nm",
    default=...,
    rich_help_panel=_PANEL,
)
_POINTS: int = option(
    "Depths of the approach, in even steps; the retreat has the same steps.",
    "N",
    default=40,
    min=2,
    max=10_000,
    rich_help_panel=_PANEL,
)


def curve(
    reading: options.Reading,
    *,
    loads: AdhesiveLoads,
    elasticity: options.Elasticity,
    law: AdhesionLaw,
    answer: options.Answer,
) -> None:
    """Bring a surface that sticks to one load after the other, up and down: force, area and stiffness, and the jumps.

    States depend on the history: approach and retreat differ. Ctrl-C keeps what is done; a path cannot be resumed.
    """
    with reported(reading.source.file, answer.out, as_json=answer.json):
        wanted = loads.values(reading.profile)
        values = ", ".join(f"{load:g}" for load in wanted.values)
        control = f"{wanted.kind}s {values} {unit_of_loads(wanted, reading.profile)}"
        _answer("curve", reading, elasticity, law.adhesion(), answer, wanted, control)


def loop(
    reading: options.Reading,
    *,
    depth: str = _TURN,
    points: int = _POINTS,
    elasticity: options.Elasticity,
    law: AdhesionLaw,
    answer: options.Answer,
) -> None:
    """Bring a surface that sticks to a depth and back until it is off: pull-off force, jumps and the lost energy.

    The approach begins ten ranges of the attraction apart. Files are those of 'adhesion curve'.
    """
    with reported(reading.source.file, answer.out, as_json=answer.json):
        from roughcontact.adhesion.adhesive_loop import loop_depths
        from roughcontact.solver.loads import Loads

        turn, adhesion = parse(depth, LENGTH, "--depth"), law.adhesion()
        wanted = Loads("depth", loop_depths(adhesion, turn, points))
        control = f"loop to a depth of {turn:g} m in {points} steps"
        _answer("loop", reading, elasticity, adhesion, answer, wanted, control, points)


def _answer(
    command: str,
    reading: options.Reading,
    elasticity: options.Elasticity,
    adhesion: Adhesion,
    asked: options.Answer,
    loads: Loads,
    control: str,
    points: int | None = None,
) -> None:
    """Follow loads, or a loop with `points` on its approach; print what was found, and write it where asked."""
    from roughcontact.adhesion.adhesive_curve import collect_states
    from roughcontact.adhesion.adhesive_loading import states_under
    from roughcontact.adhesion.adhesive_loop import until_off
    from roughcontact.solver.loads import Loads

    modulus, tolerance = elasticity.reduced_modulus(), asked.residual
    with output(asked.out) as folder:
        surface = reading.surface()
        pressed = Pressed.of(surface, modulus, None)
        states = states_under(surface, modulus, adhesion, loads, reading.body(surface, modulus), tolerance)
        if points is not None:
            states, loads = until_off(states, points), Loads("depth", loads.values[1:])
        found, whole = collected(
            states,
            lambda states: collect_states(states, loads),
            "Approach and retreat",
            len(loads.values) if points is None else None,
        )
        record = {
            "command": f"adhesion {command}",
            "file": plain(str(reading.source.file)),
            "surface": list(surface.provenance),
            "kind": pressed.kind.value,
            **found.to_record(),
            "converged": found.converged,
            "whole": whole,
        }
        if folder is not None:
            with doing("Writing files"):
                _write(found, record, surface, folder, control, asked.ending)
    if asked.json:
        emit(record)
    else:
        size = ("surface", size_of(surface.grid))
        print_facts([size, *pressed.facts(), *law_facts(adhesion, modulus, surface.grid.spacing)])
        print_table(*load_table(found.to_dataset(), ADHESIVE_COLUMNS))
        print_facts(adhesive_curve_facts(found))
    if missed := sum(not status.converged for status in found.status):
        note(f"{missed} of {len(found)} loads missed the tolerance: see their residual")
    note_unresolved(found.unresolved)
    if found.ambiguous:
        note(
            "a jump is ambiguous: two integrations of the flow after it ended in different states, of which one is "
            "given"
        )
    if folder is not None:
        note_files(folder, ("curve.csv", "jumps.csv", "curve.json", "curve.nc", f"curve.{asked.ending}"))
    if not whole:
        kept = f"{len(found)} of {len(loads.values)} loads are kept"
        note(
            f"stopped: {kept if points is None else 'the loop is not closed'}; a path of surfaces that stick "
            "cannot be resumed, because its states depend on the history"
        )
        raise typer.Exit(INTERRUPTED)
    if not found.converged:
        raise typer.Exit(MISSED)


def _write(
    found: AdhesiveCurve, record: dict[str, Any], surface: Any, folder: Path, control: str, ending: str
) -> None:
    """Write NetCDF, tables, picture and summary into a folder: all of them or none."""
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.jumps import jump_figure

    source = provenance(
        surface, modulus=found.modulus, control=control, tolerance=found.tolerance, command=command_line()
    )
    dataset = found.to_dataset()
    with all_or_none(folder) as aside:
        write_netcdf(dataset, aside / "curve.nc", source)
        write_csv(dataset, aside / "curve.csv", source)
        write_csv(dataset, aside / "jumps.csv", source, dimension="jump")
        save(jump_figure(found), aside / f"curve.{ending}")
        write_json(record, aside / "curve.json", source)
