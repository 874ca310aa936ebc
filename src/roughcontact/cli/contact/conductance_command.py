"""The command ``conductance``: conductance and resistance of a computed curve."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.messages import UsageError, plain
from roughcontact.cli.option_groups import argument
from roughcontact.cli.options import Answer
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.report import emit, load_table, print_facts, print_table
from roughcontact.files.installed import lacking
from roughcontact.recipe.bodies import Conduction
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.jobs import known_names

if TYPE_CHECKING:
    import xarray

    from roughcontact.evaluation.conduction import Conductors

__all__ = ["EXAMPLES", "conductance", "conduction_facts", "conductor_facts", "conductors_of", "shown_columns"]

EXAMPLES = {
    "conductance": """
roughcontact curve part.x3p --modulus 110GPa --out result
roughcontact conductance result/curve.nc --resistivity 17nohm*m
roughcontact conductance result --conductivity steel,aluminium
roughcontact conductance result --resistivity 17nohm*m,100nohm*m --conductivity 400W/m/K,50W/m/K --out result
roughcontact conductance result --resistivity 17nohm*m --of total
""",
}

_PROPERTIES = {
    "resistivities": ("electrical resistivities", "ohm m"),
    "conductivities": ("thermal conductivities", "W/(m K)"),
}
_CURVE = argument("File curve.nc of the command curve, or its folder.", "CURVE")


def conductors_of(conduction: Conduction) -> Conductors | None:
    """Return the conducting bodies; None if the job names no conduction."""
    from roughcontact.evaluation.conduction import Conductors

    known = known_names()
    pairs = {
        name: tuple(each.value(known) if isinstance(each, Call) else each for each in pair)
        for name, pair in conduction.named().items()
    }
    return Conductors(**pairs) if pairs else None


def conductance(file: Path = _CURVE, *, conduction: Conduction, answer: Answer) -> None:
    """Print electrical and thermal conductance and resistance against pressure or force."""
    from roughcontact.evaluation.conduction import with_conductance

    conductors = conductors_of(conduction)
    if conductors is None:
        raise UsageError(
            "a conductance needs the resistivity or conductivity of the bodies",
            "give --resistivity, --conductivity, or both, such as --resistivity 17nohm*m",
        )
    path = file / "curve.nc" if file.is_dir() else file
    with output(answer.out) as folder:
        curve = _read(path)
        found = with_conductance(curve, conductors, conduction.of)
        names = shown_columns(found)
        names = ["nominal_pressure" if names[0] in _conduction()[1] else "force", *names]
        if folder is not None:
            _write(found, names, folder, answer.ending)
    if answer.json:
        emit(_record(found, names, path) | {"of": conduction.of})
    else:
        print_table(*load_table(found, names))
        print_facts(conduction_facts(found, conductors, conduction.of))
    answer.finish(folder, ("conductance.csv", "conductance.nc", f"conductance.{answer.ending}"), conductors)


def shown_columns(dataset: xarray.Dataset) -> list[str]:
    """Return the names of conductance and resistance: per area if the curve is per area."""
    found, per_area = ([name for name in names if name in dataset] for names in _conduction())
    return per_area or found


def conduction_facts(dataset: xarray.Dataset, conductors: Conductors, of: str) -> list[tuple[str, str]]:
    """Return lines on the conducting bodies, and on the part that conductance and resistance belong to."""
    from roughcontact.evaluation.conduction import part_words

    return [*conductor_facts(conductors), ("conductance of", part_words(dataset, of))]


def conductor_facts(conductors: Conductors) -> list[tuple[str, str]]:
    """Return a line for each property of the two bodies that conductance depends on."""
    return [
        (_PROPERTIES[name][0], f"{one:.4g} and {other:.4g} {_PROPERTIES[name][1]}")
        for name, (one, other) in conductors.given().items()
    ]


def _conduction() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of conductance and resistance, in total and per area."""
    from roughcontact.labels.column import names_of
    from roughcontact.labels.contact_columns import CONDUCTION, CONDUCTION_PER_AREA

    return names_of(CONDUCTION), names_of(CONDUCTION_PER_AREA)


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
            f"{path} holds a path of adhesive states, whose conductance is not computed",
            "write a curve without adhesion with: roughcontact curve ... --out DIR",
        )
    return curve


def _record(answer: xarray.Dataset, names: list[str], path: Path) -> dict[str, Any]:
    from roughcontact.labels.labelled import plain_values

    remarks = [name for name in ("resolved", "status") if name in answer]
    names = list(dict.fromkeys(["force", *names, *(name for name in _conduction()[0] if name in answer)]))
    columns = {name: plain_values(answer[name].to_numpy()) for name in (*names, *remarks)}
    units = {name: answer[name].attrs["units"] for name in names}
    return {"command": "conductance", "file": plain(str(path)), **columns, "units": units}


def _write(answer: xarray.Dataset, names: list[str], folder: Path, ending: str) -> None:
    from roughcontact.files.write import write_csv, write_netcdf
    from roughcontact.plot.canvas import resistance_figure, save

    source: dict[str, str | float] = {"conductance_command": command_line()}
    with all_or_none(folder) as aside:
        write_netcdf(answer, aside / "conductance.nc", source)
        write_csv(answer, aside / "conductance.csv")
        save(resistance_figure(answer), aside / f"conductance.{ending}")
