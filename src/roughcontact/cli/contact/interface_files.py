"""The law of the interface in files for other programs."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.messages import note
from roughcontact.cli.output import all_or_none, command_line
from roughcontact.errors import InputError
from roughcontact.recipe.jobs import known_names

if TYPE_CHECKING:
    from collections.abc import Callable

    from roughcontact.contact.curve import Curve
    from roughcontact.recipe.elastic_jobs import CurveJob
    from roughcontact.surface.surface import Surface

__all__ = ["write_tables"]

_FILES = {
    "csv": "interface.csv",
    "abaqus": "interface.inp",
    "abaqus-mm": "interface_mm.inp",
    "calculix": "interface_ccx.inp",
    "calculix-mm": "interface_ccx_mm.inp",
    "lammps": "interface.table",
    "moose": "interface_moose.csv",
    "text": "interface.txt",
}


def write_tables(job: CurveJob, folder: Path, curve: Curve, surface: Surface) -> tuple[str, ...]:
    """Write the tables into a folder, and return the names of their files; print why a table is not possible."""
    from roughcontact.evaluation.interface_calculix import calculix_text
    from roughcontact.evaluation.interface_columns import column_text, moose_text
    from roughcontact.evaluation.interface_text import abaqus_text, lammps_text
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_text

    texts: dict[str, Callable[..., str]] = {
        "abaqus": abaqus_text,
        "abaqus-mm": partial(abaqus_text, units="mm"),
        "calculix": calculix_text,
        "calculix-mm": partial(calculix_text, units="mm"),
        "lammps": lammps_text,
        "moose": moose_text,
        "text": column_text,
    }
    names = job.tables.names()
    for call in job.tables.calls("curve", job.bodies, job.conduction.named()):
        source = provenance(surface, modulus=curve.modulus, command=command_line())
        remarks = [f"{name} = {value}" for name, value in source.items()]
        try:
            table = call.value(known_names() | {"curve": curve})
            made = {name: texts[name](table, remarks) for name in names if name != "csv"}
        except InputError as error:
            note(f"no --table: {error}")
            return ()
        with all_or_none(folder) as aside:
            for name in names:
                if name == "csv":
                    write_csv(table.to_dataset(), aside / _FILES[name])
                else:
                    write_text(made[name], aside / _FILES[name])
    return tuple(_FILES[name] for name in names)
