"""The command ``shear``: stiffness, slip and damping of an interface under tangential traction."""

from __future__ import annotations

from itertools import chain

import typer

from roughcontact.cli.contact_of_job import contact_of, hardness_of_job, name_of
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.messages import note
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output, writing
from roughcontact.cli.report import emit, load_table, print_facts, print_table, quantity, size_of
from roughcontact.progress.events import task
from roughcontact.recipe.job_calls import perform
from roughcontact.recipe.shear_job import ShearJob
from roughcontact.recipe.written import carried

__all__ = ["EXAMPLES", "shear"]

EXAMPLES = {
    "shear": """
roughcontact shear part.x3p --materials steel,aluminium --pressures 1MPa:30MPa:6 --friction 0.2 --out result
roughcontact shear part.x3p --materials steel,steel --pressures 10MPa --friction 0.2 --amplitude 0.1,0.5,0.9 --compute
roughcontact shear part.x3p --materials steel,steel --pressures 10MPa --after 50MPa --friction 0.2
""",
}


def shear(job: ShearJob, *, answer: Answer) -> None:
    """Shear a pressed rough interface: tangential stiffness, slip, loss per cycle and damping, per nominal area.

    The law follows from the normal curve, which is computed first. It is exact for alike bodies with Poisson's ratio 0,
    and an estimate for others: --compute adds cycles by partial slip.
    """
    import numpy as np

    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.labels.column import names_of
    from roughcontact.labels.labelled import plain_values
    from roughcontact.labels.shear_columns import BY_SLIP, SHEAR
    from roughcontact.plot.canvas import save
    from roughcontact.plot.shear_pictures import shear_figure

    hardness_of_job(job)
    whole = True
    with output(answer.out) as folder:
        known = contact_of(job)
        for call in job.calls():
            try:
                perform(call, known)
            except KeyboardInterrupt:
                if call.result != "cycles":
                    raise
                known["cycles"], whole = [], False
        law, table, cycles = known["law"], known["shear"], known.get("cycles", [])
        curve = known["loop"].reloading if "loop" in known else known["curve"]
        solved = (*curve.status, *(cycle.status for cycle in cycles))
        converged = all(status.converged for status in solved)
        lines = (table.attrs["notes"].splitlines(), *(cycle.notes for cycle in cycles))
        notes = list(dict.fromkeys(chain(curve.notes, *lines)))
        if "loop" in known and not known["loop"].flow.volume:
            notes.append("Nothing flowed: the contact is elastic.")
        pressures = np.unique(table["nominal_pressure"])
        resolved = np.interp(pressures, curve.nominal_pressure, curve.resolved) == 1
        if not resolved.all():
            text = quantity("nominal_pressure", float(pressures[~resolved][-1]))
            notes.append(
                f"{(~resolved).sum()} of {len(resolved)} pressures, up to {text}, are not resolved by the grid."
            )
        columns = {str(name): plain_values(values.to_numpy()) for name, values in table.items()}
        record = {
            "command": job.NAME,
            "file": name_of(job.source),
            "surface": list(known["surface"].provenance),
            **columns,
            "units": {name: unit for name in columns if (unit := table[name].attrs.get("units"))},
            "notes": notes,
            "tolerance": job.contact.tolerance,
            "converged": converged,
            "whole": whole,
            "recipe": carried(job, answer.out),
        }
        if folder is not None:
            source = provenance(
                known["surface"],
                modulus=curve.modulus,
                control=f"{len(curve)} pressures up to {law.normal.highest:g} Pa",
                command=command_line(),
                recipe=record["recipe"],
            )
            with task("Writing files"), writing(), all_or_none(folder) as aside:
                write_netcdf(table, aside / "shear.nc", source)
                write_csv(table, aside / "shear.csv")
                save(shear_figure(law, table, cycles), aside / f"shear.{answer.ending}")
                write_json(record, aside / "shear.json", source)
                if cycles:
                    write_netcdf(cycles[-1].to_dataset(), aside / "cycle.nc", source)
    if answer.json:
        emit(record)
    else:
        print_facts(
            [
                ("file", record["file"]),
                ("surface", size_of(known["surface"].grid)),
                ("loads of the normal curve", f"{len(curve)}"),
                ("E*/G*", f"{law.ratio:.4g}"),
            ]
        )
        print_table(*load_table(table, names_of(SHEAR)))
        if cycles:
            typer.echo(f"by partial slip at {quantity('nominal_pressure', cycles[-1].pressure)}")
            computed = table.isel(load=np.isfinite(table["computed_loss"]))
            print_table(*load_table(computed, ("traction_share", *names_of(BY_SLIP))))
    for line in notes:
        note(line)
    files = ["shear.csv", "shear.json", "shear.nc", f"shear.{answer.ending}"]
    answer.finish(folder, ["cycle.nc", *files] if cycles else files, job, law, *cycles)
    if not whole:
        note("stopped: cycles by partial slip are left out")
        raise typer.Exit(INTERRUPTED)
    if not converged:
        raise typer.Exit(MISSED)
