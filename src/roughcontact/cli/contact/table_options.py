"""The options that write the law of the interface for other programs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli.messages import UsageError, note
from roughcontact.cli.option_groups import option
from roughcontact.cli.output import all_or_none, command_line
from roughcontact.cli.unit_options import AREA, parse_positive
from roughcontact.errors import InputError

if TYPE_CHECKING:
    from roughcontact.contact.curve import Curve
    from roughcontact.evaluation.conduction import Conductors
    from roughcontact.surface.surface import Surface

__all__ = ["InterfaceTables"]

_FILES = {
    "csv": "interface.csv",
    "abaqus": "interface.inp",
    "abaqus-mm": "interface_mm.inp",
    "lammps": "interface.table",
}


@dataclass(frozen=True, slots=True)
class InterfaceTables:
    """InterfaceTables of the interface, as the user asked for them."""

    PANEL: ClassVar = "Answer"
    table: list[str] | None = option(
        "With --out: pressure, stiffness and area against gap, per nominal area, for other programs: csv, abaqus "
        "(SI), abaqus-mm (mm, N, MPa), lammps.",
        "abaqus,lammps,...",
        needs_whole=True,
    )
    table_area: str | None = option(
        "Nominal area that the forces of --table lammps are for (default: that of the map).", "1mm^2"
    )

    def check(self, out: Path | None) -> None:
        """Raise a `UsageError` for what makes no sense, before anything is computed."""
        names = self._names()
        if names and out is None:
            raise UsageError("--table writes files", "say where by --out", place="--table")
        self._area()
        if self.table_area is not None and "lammps" not in names:
            raise UsageError(
                "--table-area is for --table lammps: the other tables are per area", place="--table-area"
            )

    def write(
        self, folder: Path, curve: Curve, surface: Surface, conductors: Conductors | None
    ) -> tuple[str, ...]:
        """Write the tables into a folder, and return the names of their files; say why where a curve allows none."""
        from roughcontact.evaluation.interface_table import interface_table
        from roughcontact.evaluation.interface_text import abaqus_text, lammps_text
        from roughcontact.files.provenance import provenance
        from roughcontact.files.write import write_csv, write_text

        names = self._names()
        if not names:
            return ()
        conducting = {} if conductors is None else conductors.given()
        try:
            table = interface_table(curve, area=self._area(), **conducting)
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
                    write_csv(table.to_dataset(), aside / _FILES[name], source)
                else:
                    write_text(texts[name](), aside / _FILES[name])
        return tuple(_FILES[name] for name in names)

    def _names(self) -> tuple[str, ...]:
        if not self.table:
            return ()
        given = ",".join(self.table)
        names = tuple(part.strip() for part in given.split(",") if part.strip())
        for name in names:
            if name not in _FILES:
                raise UsageError(f"there is no {name!r}", f"choose of {', '.join(_FILES)}", place="--table")
        if not names or len(set(names)) < len(names):
            raise UsageError(
                f"{given!r} names no table, or one twice",
                "name each table once, such as abaqus,csv",
                place="--table",
            )
        return names

    def _area(self) -> float | None:
        if self.table_area is None:
            return None
        return parse_positive(self.table_area, AREA, "--table-area", "the area")
