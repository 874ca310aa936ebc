"""The law of the interface in files for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.messages import note
from roughcontact.cli.output import all_or_none, command_line
from roughcontact.errors import InputError
from roughcontact.recipe.recipe_fields import value_of

if TYPE_CHECKING:
    from roughcontact.contact.curve import Curve
    from roughcontact.evaluation.conduction import Conductors
    from roughcontact.recipe.outputs import InterfaceTables
    from roughcontact.surface.surface import Surface

__all__ = ["write_tables"]

_FILES = {
    "csv": "interface.csv",
    "abaqus": "interface.inp",
    "abaqus-mm": "interface_mm.inp",
    "lammps": "interface.table",
}


def write_tables(
    tables: InterfaceTables, folder: Path, curve: Curve, surface: Surface, conductors: Conductors | None
) -> tuple[str, ...]:
    """Write the tables into a folder, and return the names of their files; print why a table is not possible."""
    from roughcontact.evaluation.interface_table import interface_table
    from roughcontact.evaluation.interface_text import abaqus_text, lammps_text
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_text

    if not (names := tables.names()):
        return ()
    conducting = {} if conductors is None else conductors.given()
    try:
        table = interface_table(curve, area=value_of(tables, "table_area"), **conducting)
    except InputError as error:
        note(f"no --table: {error}")
        return ()
    source = provenance(surface, modulus=curve.modulus, command=command_line())
    remarks = [f"{name} = {value}" for name, value in source.items()]
    texts = {
        "abaqus": lambda: abaqus_text(table, remarks),
        "abaqus-mm": lambda: abaqus_text(table, remarks, units="mm"),
        "lammps": lambda: lammps_text(table, remarks),
    }
    with all_or_none(folder) as aside:
        for name in names:
            if name == "csv":
                write_csv(table.to_dataset(), aside / _FILES[name])
            else:
                write_text(texts[name](), aside / _FILES[name])
    return tuple(_FILES[name] for name in names)
