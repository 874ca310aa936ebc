"""The verb ``curve``: stiffness, area and depth against load."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from roughcontact.cli import options
from roughcontact.cli.conductance import COLUMNS, ConductivityOption, Materials, ResistivityOption
from roughcontact.cli.errors import note, plain, reported
from roughcontact.cli.exits import MISSED
from roughcontact.cli.output import all_or_none, command_line, output
from roughcontact.cli.quantity import FORCE, LENGTH, PRESSURE, parse_loads, parse_tolerance
from roughcontact.cli.report import curve_table, emit, print_facts, print_table, quantity, screen, size_of

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    import xarray

    from roughcontact.contact.conductance import Conductors
    from roughcontact.contact.curve import Curve, PowerLaw
    from roughcontact.contact.solution import Solution
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "curve"]

EXAMPLES = """Examples:

roughcontact curve part.x3p --modulus 110GPa

roughcontact curve part.x3p --forces 1mN:1N:100 --modulus 110GPa --out result

roughcontact curve part.x3p --depths 0.1um,0.2um,0.5um --young 210GPa --poisson 0.3

roughcontact curve part.x3p --pressures 1kPa:10MPa:40 --modulus 110GPa --json
"""

_LOADS = "Loads (at most one of them)"
_KINDS = {"forces": FORCE, "pressures": PRESSURE, "depths": LENGTH}

ForcesOption = Annotated[
    str | None,
    typer.Option(
        metavar="1mN:1N:100",
        help="Normal forces: from:to:count, evenly spaced in the logarithm, or a comma list "
        "(default, if no loads are named: 30 forces from 1e-4 to 0.07 of E* h L).",
        rich_help_panel=_LOADS,
    ),
]
PressuresOption = Annotated[
    str | None,
    typer.Option(metavar="1kPa:1MPa:100", help="Nominal pressures, likewise.", rich_help_panel=_LOADS),
]
DepthsOption = Annotated[
    str | None,
    typer.Option(metavar="1nm:1um:100", help="Depths since first touch, likewise.", rich_help_panel=_LOADS),
]


def curve(
    file: options.FileArgument,
    *,
    forces: ForcesOption = None,
    pressures: PressuresOption = None,
    depths: DepthsOption = None,
    modulus: options.ModulusOption = None,
    young: options.YoungOption = None,
    poisson: options.PoissonOption = None,
    young2: options.Young2Option = None,
    poisson2: options.Poisson2Option = None,
    resistivity: ResistivityOption = None,
    conductivity: ConductivityOption = None,
    channel: options.ChannelOption = None,
    unit: options.UnitOption = None,
    size: options.SizeOption = None,
    periodic: options.PeriodicOption = None,
    level: options.LevelOption = None,
    tolerance: options.ToleranceOption = "1e-8",
    out: options.OutOption = None,
    json: options.JsonOption = False,
) -> None:
    """Press a rough surface by rising loads: stiffness, area and depth against force."""
    with reported(file, out):
        given = {"forces": forces, "pressures": pressures, "depths": depths}
        named = {f"--{key}": value for key, value in given.items()}
        name = "forces" if set(given.values()) == {None} else options.only_one(named, "the loads")[2:]
        text = given[name]
        loads = None if text is None else parse_loads(text, _KINDS[name], f"--{name}")
        reduced = options.Bodies(modulus, young, poisson, young2, poisson2).reduced_modulus()
        conductors = Materials(resistivity, conductivity).conductors()
        asked = parse_tolerance(tolerance, "--tolerance")
        with output(out) as folder:
            surface = options.Reading(file, channel, unit, size, level, periodic).surface()
            if loads is None:
                loads = _suggested(surface, reduced)
            answer, notes = _load(surface, reduced, name, loads, asked)
            law = _fit(answer)
            dataset = _dataset(answer, conductors)
            record = _record(answer, law, file, surface, asked) | {"notes": list(notes)}
            _add_conductance(record, dataset)
            if folder is not None:
                control = (
                    f"{name} from {loads[0]:g} to {loads[-1]:g} {_KINDS[name].unit}, {loads.size} of them"
                )
                _write(answer, law, dataset, record, folder, _source(surface, reduced, control, asked))
        _tell(answer, law, surface, record, json)
        if folder is not None:
            note(f"summary.json, curve.csv, curve.nc and curve.png are in {folder}")
        if not record["converged"]:
            raise typer.Exit(MISSED)


def _suggested(surface: Surface, modulus: float) -> npt.NDArray[np.float64]:
    """Return the forces [N] that suit a surface, and say which they are."""
    from roughcontact.contact.loading import suggested_forces

    loads = suggested_forces(surface, modulus)
    low, high = (quantity("force", float(load)) for load in (loads[0], loads[-1]))
    note(
        f"no loads are named: {loads.size} forces from {low} to {high}, 1e-4 to 0.07 of E* h L (--forces for others)"
    )
    return loads


def _load(
    surface: Surface, modulus: float, name: str, loads: npt.NDArray[np.float64], tolerance: float
) -> tuple[Curve, tuple[str, ...]]:
    """Return the curve and the notes on its last load; a bar on standard error moves on at every load."""
    import roughcontact as rc
    from roughcontact.contact.curve import collect

    given = {kind: loads if kind == name else None for kind in _KINDS}
    path = rc.loading_path(
        surface,
        modulus,
        forces=given["forces"],
        pressures=given["pressures"],
        depths=given["depths"],
        tolerance=tolerance,
    )
    notes: list[tuple[str, ...]] = []

    def watched(path: Iterator[Solution]) -> Iterator[Solution]:
        for solution in path:
            notes[:] = [solution.notes]
            yield solution

    columns = (
        TextColumn("Pressing"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
    )
    with Progress(*columns, console=screen()) as progress:
        curve = collect(progress.track(watched(path), total=loads.size))
    return curve, notes[0]


def _fit(curve: Curve) -> PowerLaw | None:
    """Return the power law through the resolved points, if they allow one."""
    try:
        return curve.fit()
    except ValueError as error:
        note(f"no power law: {error}")
        return None


def _record(
    curve: Curve, law: PowerLaw | None, file: Path, surface: Surface, tolerance: float
) -> dict[str, Any]:
    from roughcontact.contact.dataset import curve_record

    return {
        "verb": "curve",
        "file": plain(str(file)),
        "surface": list(surface.provenance),
        **curve_record(curve),
        "fit": None if law is None else _law_record(law),
        "tolerance": tolerance,
        "converged": all(status.converged for status in curve.status),
    }


def _law_record(law: PowerLaw) -> dict[str, Any]:
    return {
        "exponent": float(law.exponent),
        "prefactor": float(law.prefactor),
        "scatter": float(law.scatter),
        "window": [float(end) for end in law.window],
        "count": int(law.count),
    }


def _dataset(curve: Curve, conductors: Conductors | None) -> xarray.Dataset:
    from roughcontact.contact.dataset import curve_dataset, with_conductance

    dataset = curve_dataset(curve)
    return dataset if conductors is None else with_conductance(dataset, conductors)


def _add_conductance(record: dict[str, Any], dataset: xarray.Dataset) -> None:
    """Add the columns of conductance and their units, if there are any."""
    from roughcontact.contact.dataset import plain_values

    for name in COLUMNS:
        if name in dataset:
            record[name] = plain_values(dataset[name].to_numpy())
            record["units"][name] = dataset[name].attrs["units"]


def _source(surface: Surface, modulus: float, control: str, tolerance: float) -> dict[str, str | float]:
    from roughcontact.files.provenance import provenance

    return provenance(surface, modulus=modulus, control=control, tolerance=tolerance, command=command_line())


def _write(
    curve: Curve,
    law: PowerLaw | None,
    dataset: xarray.Dataset,
    record: dict[str, Any],
    folder: Path,
    source: dict[str, str | float],
) -> None:
    from roughcontact.files.write import write_csv, write_json, write_netcdf
    from roughcontact.plot.figures import curve_figure, save

    with all_or_none(folder) as aside:
        write_netcdf(dataset, aside / "curve.nc", source)
        write_csv(dataset, aside / "curve.csv", source)
        save(curve_figure(curve, law), aside / "curve.png")
        write_json(record, aside / "summary.json", source)


def _tell(curve: Curve, law: PowerLaw | None, surface: Surface, record: dict[str, Any], json: bool) -> None:
    if json:
        emit(record)
    else:
        print_facts(
            [("surface", size_of(surface.grid)), ("reduced modulus E*", quantity("modulus", curve.modulus))]
        )
        print_table(*curve_table(curve, {name: record[name] for name in COLUMNS if name in record}))
        print_facts(_law_facts(law, curve))
    missed = sum(not status.converged for status in curve.status)
    if missed:
        note(f"{missed} of {len(curve)} loads missed the tolerance: see their status")
    for line in record["notes"]:
        note(line)


def _law_facts(law: PowerLaw | None, curve: Curve) -> list[tuple[str, str]]:
    facts = [
        ("saturation", f"{quantity('saturation', curve.saturation)}, every measured cell in contact"),
        ("largest certificate", f"{curve.residual.max():.1e}"),
    ]
    if law is not None:
        low, high = (quantity("force", end) for end in law.window)
        text = f"k/(E* L) = {law.prefactor:.4g} (F/(E* L h))^{law.exponent:.4f}"
        fitted = f"{law.count} loads from {low} to {high}, scatter {law.scatter:.2g}"
        facts = [("power law", text), ("fitted to", fitted), *facts]
    return facts
