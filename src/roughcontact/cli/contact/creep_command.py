"""The command ``creep``: a load that varies in time on a viscoelastic body."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.contact_of_job import contact_of, name_of
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.messages import note, plain, remark
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, output, source_of, writing
from roughcontact.cli.report import emit, load_table, print_facts, print_table
from roughcontact.progress.events import task
from roughcontact.recipe.creep_job import CreepJob
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from roughcontact.viscoelastic.growing_curve import GrowingCurve
    from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve

__all__ = ["EXAMPLES", "creep"]

EXAMPLES = {
    "creep": """
roughcontact creep part.x3p --material rubber.toml --history "0s:0N, 1s:10N, 1000s:10N, 1001s:1N" --out result
roughcontact creep part.x3p --material rubber.toml --history "0s:0Pa, 0s:1MPa, 1h:1MPa" --steps 50
roughcontact creep tile.npz --material rubber.toml --history "0s:0um, 1s:2um, 1h:2um" --leak 0 --out result
"""
}
_STEM = "creep"
_CHECKPOINT = "creep_checkpoint.npz"


def creep(job: CreepJob, *, answer: Answer) -> None:
    """Press a rough surface on a viscoelastic body in time: area, depth and stiffness under a history of load.

    A computation that was stopped goes on if the same command is given again with the same --out.
    """
    from roughcontact.plot.creep_plot import CREEP_COLUMNS, CREEP_PER_AREA, creep_facts

    with output(answer.out) as folder:
        known = contact_of(job)
        growing = _growing(job, known, folder)
        if growing.rows:
            seconds = growing.rows[-1]["time"]
            remark(f"{folder} holds the states up to {seconds:.6g} s: the computation goes on from there")
        elif folder is not None and (folder / _CHECKPOINT).exists():
            note(f"{folder / _CHECKPOINT} is of another computation and is replaced; another --out keeps it")
        try:
            growing.grow()
        except KeyboardInterrupt:
            if not growing.rows:
                raise
        curve = growing.curve()
        record = _record(job, known, growing, curve, answer)
        if folder is not None:
            _write(folder, curve, record, growing, answer)
    if answer.json:
        emit(record)
    else:
        print_facts([("file", record["file"]), *creep_facts(curve, growing.history)])
        shown = curve.prescribed.copy()
        shown[-1] = True  # of a history that was stopped
        columns = CREEP_PER_AREA if "pressures" in job.history.named(job.profile) else CREEP_COLUMNS
        print_table(*load_table(curve.to_dataset().isel(time=shown), columns))
    for line in curve.notes:
        note(line)
    files = (f"{_STEM}.csv", f"{_STEM}.json", f"{_STEM}.nc", f"{_STEM}.{answer.ending}")
    answer.finish(folder, files, job, curve)
    if not growing.whole:
        where = "with --out, the same command goes on from there"
        if folder is not None:
            where = "the same command goes on from there"
        note(f"stopped at {curve.time[-1]:.6g} s; {where}")
        raise typer.Exit(INTERRUPTED)
    if not record["converged"]:
        raise typer.Exit(MISSED)


def _growing(job: CreepJob, known: dict[str, Any], folder: Path | None) -> GrowingCurve:
    """Return the curve of a job before it is computed, with the states that a folder holds."""
    from roughcontact.viscoelastic.viscoelastic_loading import growing_curve

    [call] = job.calls()
    named = {**call.named, "checkpoint": None if folder is None else folder / _CHECKPOINT}
    known["growing_curve"] = growing_curve
    perform(replace(call, function="growing_curve", named=named), known)
    found: GrowingCurve = known["curve"]
    return found


def _record(
    job: CreepJob, known: dict[str, Any], growing: GrowingCurve, curve: ViscoelasticCurve, answer: Answer
) -> dict[str, Any]:
    return {
        "command": job.NAME,
        "file": name_of(job.source),
        "material": plain(job.bodies.material),
        "surface": list(known["surface"].provenance),
        **curve.to_record(),
        "tolerance": growing.history.contact.problem.tolerance,
        "converged": all(status.converged for status in curve.status),
        "whole": growing.whole,
        "recipe": carried(job, answer.out),
    }


def _write(
    folder: Path, curve: ViscoelasticCurve, record: dict[str, Any], growing: GrowingCurve, answer: Answer
) -> None:
    """Write NetCDF, table, picture and summary, all of them or none; a finished computation needs no checkpoint."""
    from matplotlib.figure import Figure

    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.creep_plot import creep_curve

    control = f"history of {growing.history.times.size} times"
    source = source_of(growing.history.contact.problem, record["recipe"], control)
    dataset, figure = curve.to_dataset(), Figure(figsize=(6.4, 4.2), layout="constrained")
    with task("Writing files"), writing(), all_or_none(folder) as aside:
        write_netcdf(dataset, aside / f"{_STEM}.nc", source)
        write_csv(dataset, aside / f"{_STEM}.csv")
        creep_curve(curve, figure.subplots())
        save(figure, aside / f"{_STEM}.{answer.ending}")
        write_json(record, aside / f"{_STEM}.json", source)
    if growing.whole:
        (folder / _CHECKPOINT).unlink(missing_ok=True)
