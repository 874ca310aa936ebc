"""The command ``conductance``: what a computed curve conducts, and the options that add it to a curve."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli import options
from roughcontact.cli.material_options import parse_bodies
from roughcontact.cli.messages import UsageError, plain, reported
from roughcontact.cli.option_groups import argument, option
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.picture_options import FORMAT, PictureFormat, picture_ending
from roughcontact.cli.report import emit, load_table, note_files, print_facts, print_table
from roughcontact.cli.unit_options import CONDUCTIVITY, RESISTIVITY
from roughcontact.files.installed import lacking
from roughcontact.labels import contact_columns
from roughcontact.labels.column import names_of

if TYPE_CHECKING:
    import xarray

    from roughcontact.evaluation.conduction import Conductors

__all__ = ["EXAMPLES", "Materials", "conductance", "conduction_facts", "shown_columns"]

CONDUCTION = names_of(contact_columns.CONDUCTION)
CONDUCTION_PER_AREA = names_of(contact_columns.CONDUCTION_PER_AREA)

EXAMPLES = {
    "conductance": """
roughcontact curve part.x3p --modulus 110GPa --out result
roughcontact conductance result/curve.nc --resistivity 17nohm*m
roughcontact conductance result --conductivity steel,aluminium
roughcontact conductance result --resistivity 17nohm*m,100nohm*m --conductivity 400W/m/K,50W/m/K --out result
roughcontact conductance result --resistivity 17nohm*m --of total
""",
}

_CURVE = argument("curve.nc that the command curve wrote, or its folder.", "CURVE")

Part = StrEnum("Part", ["INTERFACE", "TOTAL"])


@dataclass(frozen=True, slots=True)
class Materials:
    """The conducting bodies, as the user gave them."""

    PANEL: ClassVar = "The two bodies"
    resistivity: str | None = option(
        "Electrical resistivity of both bodies, or of one and the other, as numbers or names of materials such as "
        "copper,gold: gives the resistance of the contact.",
        "17nohm*m[,...]",
    )
    conductivity: str | None = option("Thermal conductivity of both bodies, likewise.", "400W/m/K[,...]")
    of: Part = option(
        "Conductance and resistance of the interface alone, per area, or the total of this patch between two "
        "half-spaces, its spreading resistance included.",
        default=Part.INTERFACE,
    )

    def conductors(self) -> Conductors | None:
        """Return the bodies; None where nothing was said."""
        from roughcontact.evaluation.conduction import Conductors

        if self.resistivity is None and self.conductivity is None:
            return None
        pairs = [
            None if text is None else parse_bodies(text, kind, name)
            for text, kind, name in (
                (self.resistivity, RESISTIVITY, "resistivity"),
                (self.conductivity, CONDUCTIVITY, "conductivity"),
            )
        ]
        return Conductors(*pairs)


def conductance(
    file: Path = _CURVE,
    *,
    materials: Materials,
    out: Path | None = options.OUT,
    format: PictureFormat | None = FORMAT,
    json: bool = options.JSON,
) -> None:
    """Tell what a contact conducts: electrical and thermal resistance against pressure or force."""
    from roughcontact.evaluation.conduction import with_conductance

    with reported(file, out, as_json=json):
        ending = picture_ending(format, out)
        conductors = materials.conductors()
        if conductors is None:
            raise UsageError(
                "a conductance follows from what the bodies conduct",
                "give --resistivity, --conductivity, or both, such as --resistivity 17nohm*m",
            )
        path = file / "curve.nc" if file.is_dir() else file
        with output(out) as folder:
            curve = _read(path)
            answer = with_conductance(curve, conductors, materials.of.value)
            names = shown_columns(answer)
            names = ["nominal_pressure" if names[0] in CONDUCTION_PER_AREA else "force", *names]
            if folder is not None:
                _write(answer, names, folder, ending)
        if json:
            emit(_record(answer, names, path) | {"of": materials.of.value})
        else:
            print_table(*load_table(answer, names))
            print_facts(conduction_facts(answer, materials.of.value))
        note_files(folder, ("conductance.csv", "conductance.nc", f"conductance.{ending}"))


def shown_columns(dataset: xarray.Dataset) -> list[str]:
    """Return the names of what a contact conducts: per area where it is so given."""
    found = [[name for name in names if name in dataset] for names in (CONDUCTION_PER_AREA, CONDUCTION)]
    return found[0] or found[1]


def conduction_facts(dataset: xarray.Dataset, of: str) -> list[tuple[str, str]]:
    """Return a line that says what conductance and resistance are of."""
    from roughcontact.evaluation.conduction import part_words

    return [("conductance of", part_words(dataset, of))]


def _read(path: Path) -> xarray.Dataset:
    """Return the dataset of a curve from its file."""
    import xarray

    if (lack := lacking("h5py", "h5netcdf")) is not None:
        raise UsageError(f"{path} needs {lack[0]}", lack[1])
    try:
        with xarray.open_dataset(path, engine="h5netcdf") as dataset:
            curve = dataset.load()
    except FileNotFoundError as error:
        raise UsageError(
            f"{path}: no such file", "write one with: roughcontact curve ... --out DIR"
        ) from error
    except (OSError, ValueError) as error:
        raise UsageError(
            f"{path} is not a curve.nc", "write one with: roughcontact curve ... --out DIR"
        ) from error
    if "jump_lost" in curve or "detachment_lost" in curve:
        raise UsageError(
            f"{path} holds a path of surfaces that stick, whose conductance is not computed",
            "write a curve without adhesion with: roughcontact curve ... --out DIR",
        )
    return curve


def _record(answer: xarray.Dataset, names: list[str], path: Path) -> dict[str, Any]:
    from roughcontact.labels.labelled import plain_values

    remarks = [name for name in ("resolved", "status") if name in answer]
    names = list(dict.fromkeys(["force", *names, *(name for name in CONDUCTION if name in answer)]))
    columns = {name: plain_values(answer[name].to_numpy()) for name in (*names, *remarks)}
    units = {name: answer[name].attrs["units"] for name in names}
    return {"command": "conductance", "file": plain(str(path)), **columns, "units": units}


def _write(answer: xarray.Dataset, names: list[str], folder: Path, ending: str) -> None:
    from roughcontact.files.write import write_csv, write_netcdf
    from roughcontact.plot.canvas import resistance_figure, save

    source: dict[str, str | float] = {"conductance_command": command_line()}
    with all_or_none(folder) as aside:
        write_netcdf(answer, aside / "conductance.nc", source)
        write_csv(answer, aside / "conductance.csv", source)
        save(resistance_figure(answer), aside / f"conductance.{ending}")
