"""The command ``adhesion detach``: a surface that was pressed, stuck, and is drawn back."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import typer

from roughcontact.cli import options
from roughcontact.cli.adhesion_options import WORK, parse_work
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.load_options import FallingLoads, OneLoad
from roughcontact.cli.messages import note, plain, reported
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.path_answer import collected
from roughcontact.cli.pressed import Pressed, best_state
from roughcontact.cli.profile_options import kinds_of
from roughcontact.cli.report import (
    doing,
    emit,
    load_table,
    note_files,
    print_facts,
    print_table,
    size_of,
)

if TYPE_CHECKING:
    from roughcontact.adhesion.detachment_curve import DetachmentCurve

__all__ = ["EXAMPLES", "detach"]

EXAMPLES = {
    "detach": """
roughcontact adhesion detach part.x3p --force 100uN --modulus 1GPa --work 50mJ/m^2 --out result
roughcontact adhesion detach part.x3p --depth 100nm --depths 50nm:-50nm:11 --modulus 1GPa --work 50mJ/m^2
""",
}


def detach(
    reading: options.Reading,
    *,
    load: OneLoad,
    retreat: FallingLoads,
    elasticity: options.Elasticity,
    work: str = WORK,
    answer: options.Answer,
) -> None:
    """Press a surface by one load, and draw it back as if it were stuck: pull-off force, and the cells that let go.

    This is the limit of an attraction without a range, by Johnson, Kendall and Roberts. Nothing attracts the surface
    while it is pressed. With an attraction that has a range use 'adhesion loop'.
    """
    import roughcontact as rc
    from roughcontact.adhesion.detachment_curve import collect_detachments
    from roughcontact.plot.detachment_plot import DETACHMENT_COLUMNS, detachment_facts

    file, body = reading.source.file, reading.profile
    with reported(file, answer.out, as_json=answer.json):
        given, loads = load.value(body), retreat.values(body)
        falling: dict[str, Any] = {} if loads is None else {f"{loads.kind}s": loads.values}
        modulus, energy = elasticity.reduced_modulus(), parse_work(work)
        with output(answer.out) as folder:
            surface = reading.surface()
            pressed = Pressed.of(surface, modulus, None)
            limits = {"operator": reading.body(surface, modulus), "tolerance": answer.residual}
            preload = best_state(rc.press, surface, modulus, **given, **limits)
            states = rc.detachment_path(preload, energy, **falling)
            count = 1 if loads is None else loads.values.size
            control: Literal["depth", "force"] = "depth"
            if loads is not None and loads.kind != "depth":
                control = "force"
            found, whole = collected(
                states, lambda states: collect_detachments(states, control), "Drawing back", count
            )
            converged = preload.status.converged and found.converged
            record = {
                "command": "adhesion detach",
                "file": plain(str(file)),
                "surface": list(surface.provenance),
                "kind": pressed.kind.value,
                **found.to_record(),
                "converged": converged,
                "whole": whole,
            }
            if folder is not None:
                [(name, value)] = given.items()
                preloaded = f"drawn back from {name} = {value!r} {kinds_of(body)[name].unit}"
                with doing("Writing files"):
                    _write(found, record, surface, folder, preloaded, answer.ending)
        if answer.json:
            emit(record)
        else:
            print_facts([("surface", size_of(surface.grid)), *pressed.facts()])
            print_table(*load_table(found.to_dataset(), DETACHMENT_COLUMNS))
            print_facts(detachment_facts(found))
        if not preload.status.converged:
            note("the preload missed the tolerance")
        if missed := sum(not status.converged for status in found.status):
            note(f"{missed} of {len(found)} loads missed the tolerance: see their residual")
        note_files(
            folder,
            (
                "detachment.csv",
                "detachments.csv",
                "detachment.json",
                "detachment.nc",
                f"detachment.{answer.ending}",
            ),
        )
        if not whole:
            note(f"stopped: {len(found)} of {count} loads are kept; run the command again for all of them")
            raise typer.Exit(INTERRUPTED)
        if not converged:
            raise typer.Exit(MISSED)


def _write(
    found: DetachmentCurve, record: dict[str, Any], surface: Any, folder: Path, control: str, ending: str
) -> None:
    """Write NetCDF, tables, picture and summary into a folder: all of them or none."""
    from matplotlib.figure import Figure

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.detachment_plot import detachment_force

    source = provenance(
        surface, modulus=found.modulus, control=control, tolerance=found.tolerance, command=command_line()
    )
    dataset = found.to_dataset()
    figure = Figure(figsize=(5.6, 4.2), layout="constrained")
    detachment_force(found, figure.subplots())
    with all_or_none(folder) as aside:
        write_netcdf(dataset, aside / "detachment.nc", source)
        write_csv(dataset, aside / "detachment.csv", source)
        write_csv(dataset, aside / "detachments.csv", source, dimension="detachment")
        save(figure, aside / f"detachment.{ending}")
        write_json(record, aside / "detachment.json", source)
