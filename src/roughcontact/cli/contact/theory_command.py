"""The command ``theory``: predictions for a joint of which only rms height and slope are known."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli import report
from roughcontact.cli.cited import cited
from roughcontact.cli.contact.conductance_command import conductor_facts, conductors_of
from roughcontact.cli.contact_of_job import note_materials
from roughcontact.cli.messages import note
from roughcontact.cli.options import CITE, JSON, OUT, Answer
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.recipe.job_calls import performed
from roughcontact.recipe.jobs import calls_of, known_names
from roughcontact.recipe.theory_job import TheoryJob
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    import xarray

    from roughcontact.surface.generation.specification import SurfaceSpecification

__all__ = ["EXAMPLES", "theory"]

EXAMPLES = {
    "theory": """
roughcontact theory --sigma 1.2um --slope 0.12 --materials copper,steel --theory cmy,mikic --pressures 1MPa:10MPa:3
roughcontact theory --sigma 1um,2um --slope 0.1,0.12 --modulus 57GPa --theory mikic --pressures 5MPa --out result
roughcontact theory --ra 1um --slope 0.1 --nayak 20 --modulus 57GPa --theory mikic,gw --pressures 1MPa,5MPa
""",
}


_COLUMNS = (
    *("nominal_pressure", "contact_fraction", "interfacial_stiffness_per_area", "mean_gap"),
    *("thermal_conductance_per_area", "electrical_conductance_per_area"),
)
_VACUUM = "the spots in vacuum: gas in the gap, films and radiation are not included"


@dataclass(frozen=True, slots=True)
class TableAnswer:
    """Folder and form of an answer that has no pictures; see `Answer`."""

    PANEL: ClassVar = Answer.PANEL
    out: Path | None = OUT
    json: bool = JSON
    cite: bool = CITE
    is_kept: bool = True  # no option, see `Answer`


def theory(job: TheoryJob, *, answer: TableAnswer) -> None:
    """Predict area, stiffness and conductance per area of a joint from its rms height and slope.

    The theories cmy and mikic need only these two numbers. Other theories also need the bandwidth of the roughness,
    such as --nayak; the error lists the options.
    """
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.labels.labelled import plain_values

    with output(answer.out) as folder:
        note_materials(job.bodies)
        known = performed(calls_of(job), known_names())
        table = _by_row(known["table"])
        columns = {str(name): plain_values(values.to_numpy()) for name, values in table.data_vars.items()}
        units = {name: unit for name in columns if (unit := table[name].attrs.get("units"))}
        record = {"command": job.NAME, **columns, "units": units}
        record |= {"converged": True, "recipe": carried(job, answer.out)}  # there is nothing to solve
        if folder is not None:
            source = provenance(modulus=columns["modulus"], command=command_line(), recipe=record["recipe"])
            with all_or_none(folder) as aside:
                write_netcdf(known["table"], aside / "theory.nc", source)
                write_csv(table, aside / "theory.csv")
                write_json(record, aside / "theory.json", source)
    if answer.json:
        report.emit(record)
    else:
        report.print_facts(_facts(job, known["joint"], table))
        _print(table)
    more = cited(folder, job, as_json=answer.json) if answer.cite else ()
    if folder is not None and answer.is_kept:
        note(f"{', '.join(('theory.csv', 'theory.json', *more))} and theory.nc are in {folder}")


def _by_row(table: xarray.Dataset) -> xarray.Dataset:
    """Return the predictions along one dimension, theory by theory."""
    rows = table.reset_coords("nominal_pressure").stack(row=("theory", "load")).reset_index("row")
    return rows.drop_vars("load").rename(row="load").reset_coords("theory")


def _facts(job: TheoryJob, joint: SurfaceSpecification, table: xarray.Dataset) -> list[tuple[str, str]]:
    """Return the input of the theories, line by line."""
    words = [f"sigma {report.quantity('rms', joint.sigma)}"]
    if joint.slope is not None or joint.has_spectrum:
        mean = math.sqrt(2 * joint.m2 / math.pi)
        words.append(f"mean absolute slope m {mean:.4g} (rms slope of a profile {math.sqrt(joint.m2):.4g})")
    facts = [("both faces together", ", ".join(words))]
    if joint.has_spectrum:
        law = joint.spectrum
        ends = (2 * math.pi / q for q in (law.q_rolloff, law.q_max))
        longest, shortest = (report.quantity("lengths", end) for end in ends)
        words = [f"H {law.hurst:g}", f"roll-off {longest}", f"shortest wave {shortest}"]
        facts.append(("spectrum", ", ".join([*words, f"Nayak's parameter {law.moments().nayak:.4g}"])))
    facts.append(("reduced modulus E*", report.quantity("modulus", float(table["modulus"]))))
    if "hardness" in table:
        of = f", of {job.bodies.softer}" if job.theories.hardness is None else ""
        facts.append(("hardness", report.quantity("hardness", float(table["hardness"])) + of))
    if (conductors := conductors_of(job.conduction)) is not None:
        facts += [*conductor_facts(conductors), ("conductance of", _VACUUM)]
    return facts


def _print(table: xarray.Dataset) -> None:
    """Print the predictions: a row for each theory and pressure."""
    zero = table["nominal_pressure"] * 0  # the origin of gaps, which are no differences here
    shown = [name for name in _COLUMNS if name in table]
    header, rows = report.load_table(table.assign(depth=zero), shown)
    names = table["theory"].to_numpy().tolist()
    lines = [
        [name, *("-" if cell == "nan" else cell for cell in row)]
        for name, row in zip(names, rows, strict=True)
    ]
    report.print_table(["theory", *header], lines)
    if any("-" in line for line in lines):
        note("-: the theory does not predict this quantity, or it does not hold at this pressure")
