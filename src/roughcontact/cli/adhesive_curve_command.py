"""The command ``curve`` of surfaces that stick: approach and retreat, with jumps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.messages import UsageError, note, plain
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.profile_options import kinds_of
from roughcontact.cli.report import (
    ADHESIVE_COLUMNS,
    adhesive_loop_facts,
    doing,
    emit,
    law_facts,
    load_table,
    note_files,
    print_facts,
    print_table,
    screen,
    size_of,
)

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from roughcontact.adhesion.adhesive_state import AdhesiveState
    from roughcontact.cli import options
    from roughcontact.cli.adhesion_options import Sticking
    from roughcontact.contact.adhesive_branches import AdhesiveLoop

__all__ = ["curve_sticking"]

_LOADS = ("depths", "forces", "mean_gaps")
_POINTS = 40  # of the approach of a loop, as in the library


def curve_sticking(
    reading: options.Reading,
    prescribed: tuple[str, npt.NDArray[np.float64]],
    elasticity: options.Elasticity,
    sticking: Sticking,
    asked: options.Answer,
    *,
    loop: bool,
    points: int | None,
) -> None:
    """Follow surfaces that stick along loads, or along a loop to a depth; print the path, write it to a folder."""
    modulus, adhesion, tolerance = elasticity.reduced_modulus(), sticking.adhesion(), asked.residual
    name, loads = prescribed
    count = _points_of_loop(name, loads, loop=loop, points=points)
    with output(asked.out) as folder:
        surface = reading.surface()
        pressed = Pressed.of(surface, modulus, None)
        unit = kinds_of(reading.profile)[name.removesuffix("s")].unit
        if loop:
            from roughcontact.contact.adhesive_loop import loop_depths

            control = f"loop to a depth of {loads[0]:g} m in {count} steps"
            loads = loop_depths(adhesion, float(loads[0]), count)
        else:
            control = f"{name.replace('_', ' ')} {', '.join(f'{load:g}' for load in loads)} {unit}"
        limits = {"operator": reading.body(surface, modulus), "tolerance": tolerance, "adhesion": adhesion}
        path, whole = _follow(surface, modulus, {name: loads, **limits}, count if loop else None)
        record = {
            "command": "curve",
            "file": plain(str(reading.source.file)),
            "surface": list(surface.provenance),
            "kind": pressed.kind.value,
            **path.to_record(),
            "converged": path.converged,
            "whole": whole,
        }
        if folder is not None:
            with doing("Writing files"):
                _write(path, record, surface, folder, control, asked.ending)
    if asked.json:
        emit(record)
    else:
        size = ("surface", size_of(surface.grid))
        print_facts([size, *pressed.facts(), *law_facts(adhesion, modulus, surface.grid.spacing)])
        print_table(*load_table(path.to_dataset(), ADHESIVE_COLUMNS))
        print_facts(adhesive_loop_facts(path))
    if missed := sum(not status.converged for status in path.status):
        note(f"{missed} of {len(path)} loads missed the tolerance: see their residual")
    sticking.remark(unresolved=path.unresolved, ambiguous=path.ambiguous)
    if folder is not None:
        note_files(folder, ("curve.csv", "jumps.csv", "curve.json", "curve.nc", f"curve.{asked.ending}"))
    if not whole:
        end = "the loop is not closed" if loop else f"{len(path)} of {len(loads)} loads are kept"
        note(f"stopped: {end}; a path of surfaces that stick begins anew, what comes depends on what was")
        raise typer.Exit(INTERRUPTED)
    if not path.converged:
        raise typer.Exit(MISSED)


def _points_of_loop(name: str, loads: npt.NDArray[np.float64], *, loop: bool, points: int | None) -> int:
    """Return the steps of the approach of a loop; refuse what no loop goes by, and points of what is none."""
    if not loop:
        if points is not None:
            raise UsageError(
                "--points is about a --loop: without it name all --depths, --forces or --mean-gaps"
            )
        return 0
    if name != "depths" or len(loads) != 1:
        raise UsageError(
            "--loop of surfaces that stick goes by depth, to the one that is named and back until the bodies are "
            "apart: give one, such as --depths 20nm; or leave out --loop, and name all --depths, --forces or "
            "--mean-gaps"
        )
    if points is not None and not 2 <= points <= 10_000:
        raise UsageError(f"--points: an approach has from 2 to 10000 depths, not {points}")
    return _POINTS if points is None else points


def _follow(
    surface: Any, modulus: float, given: dict[str, Any], loop: int | None
) -> tuple[AdhesiveLoop, bool]:
    """Return the path, and whether it is whole: Ctrl-C ends it with the loads that are done."""
    import roughcontact as rc
    from roughcontact.contact.adhesive_branches import collect_states
    from roughcontact.contact.adhesive_loop import until_off

    [(name, loads)] = ((name, values) for name, values in given.items() if name in _LOADS)
    states = rc.loading_path(surface, modulus, **given)
    if loop is not None:
        states, loads = until_off(states, loop), loads[1:]
    stopped: list[bool] = []

    def watched() -> Iterator[AdhesiveState]:
        done = 0
        try:
            for state in states:
                done += 1
                progress.advance(task)
                yield state
        except KeyboardInterrupt:
            if not done:  # nothing to keep
                raise
            stopped.append(True)

    columns = (TextColumn("Approach and retreat"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=screen()) as progress:
        task = progress.add_task("", total=None if loop is not None else len(loads))
        # The bodies draw near as the mean gap falls.
        path = collect_states(watched(), -loads if name == "mean_gaps" else loads)
    return path, not stopped


def _write(
    path: AdhesiveLoop, record: dict[str, Any], surface: Any, folder: Path, control: str, ending: str
) -> None:
    """Write NetCDF, tables, picture and summary into a folder: all of them or none."""
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.jumps import jump_figure

    source = provenance(
        surface, modulus=path.modulus, control=control, tolerance=path.tolerance, command=command_line()
    )
    dataset = path.to_dataset()
    with all_or_none(folder) as aside:
        write_netcdf(dataset, aside / "curve.nc", source)
        write_csv(dataset, aside / "curve.csv", source)
        write_csv(dataset, aside / "jumps.csv", source, dimension="jump")
        save(jump_figure(path), aside / f"curve.{ending}")
        write_json(record, aside / "curve.json", source)
