"""The command ``study table``: a line for each combination of what varies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.messages import UsageError, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.options import JSON
from roughcontact.cli.report import emit, print_facts, print_table
from roughcontact.cli.study.averages_command import (
    AT,
    USUAL,
    LawWindow,
    averaged_in,
    load_of,
    means_of,
    note_laws,
    note_unresolved,
    resolved_in,
    written_load,
)
from roughcontact.cli.study.study_command import FOLDER, own_cases
from roughcontact.labels.engineering_units import scale
from roughcontact.plot.drawing.parameter_labels import parameter_labels
from roughcontact.recipe.texts import choose

if TYPE_CHECKING:
    import xarray

__all__ = ["EXAMPLES", "table"]

EXAMPLES = {
    "table": """
roughcontact study table results
roughcontact study table results --at 1MPa
roughcontact study table results --at 0.01 --quantity stiffness,contact_area
""",
}

QUANTITIES = option(
    "Quantities of which to print mean and standard error (default: power laws; with --at the usual ones; otherwise "
    "all numbers without loads).",
    "NAME,...",
)

_LAW = ("exponent", "prefactor")
_EQUAL = 1e-12  # relative to the mean: samples that differ by less are equal
_CERTIFICATES = ("residual", "stiffness_residual")  # shown only with --quantity
_MOST_DECIMALS = 5  # with more, a power of ten is shorter


def table(
    folder: Path = FOLDER,
    *,
    quantity: str | None = QUANTITIES,
    at: str | None = AT,
    window: LawWindow,
    json: bool = JSON,
) -> None:
    """Print one line for each combination of parameters: power laws, or means with their standard errors."""
    with reported(folder, as_json=json), own_cases():
        load = load_of(at)
        averaged = averaged_in(folder, window.value(), load)
        laws = quantity is None and "exponent" in averaged and load is None
        names = () if laws else _quantities(averaged, quantity, load)
        if json:
            emit(_record(averaged, folder, names, laws, load))
        else:
            if load is not None:
                print_facts([("load", written_load(*load))])
            print_table(*_table(averaged, names, laws))
        if laws or (quantity is None and load is None):
            note_laws(averaged)
        if load is not None:
            note_unresolved(averaged, names[0])


def _quantities(
    averaged: xarray.Dataset, asked: str | None, load: tuple[str, float] | None
) -> tuple[str, ...]:
    """Return the quantities of a table: one number for each combination."""
    single = [name for name in means_of(averaged) if averaged[f"{name}_mean"].dims == averaged["cases"].dims]
    if asked is None:
        if not single:
            raise UsageError("all quantities depend on the load", "choose a load by --at, such as --at 1MPa")
        usual = tuple(name for name in USUAL if name in single) if load is not None else ()
        return usual or tuple(name for name in single if name not in _CERTIFICATES)
    names = tuple(part.strip() for part in asked.split(",") if part.strip())
    for name in names:
        if name not in means_of(averaged):
            raise UsageError(
                f"no {name!r} differs between samples",
                choose(name, means_of(averaged)),
                place="--quantity",
            )
        if name not in single:
            raise UsageError(
                f"{name} depends on {_rest(averaged, name)}",
                f"choose from {', '.join(single)}" if load else "choose a load by --at, such as --at 1MPa",
                place="--quantity",
            )
    return names


def _rest(averaged: xarray.Dataset, name: str) -> str:
    return ", ".join(str(d) for d in averaged[f"{name}_mean"].dims if d not in averaged["cases"].dims)


def _table(averaged: xarray.Dataset, names: Sequence[str], laws: bool) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the table that is printed."""
    from roughcontact.statistics.averages import combinations

    points = list(combinations(averaged))
    header: list[str] = []
    columns: list[list[str]] = []

    def add(title: str, cells: list[str]) -> None:
        header.append(title)
        columns.append(cells)

    for name, label in parameter_labels(averaged).items():
        add(label.title, [label.value(parameters[name]) for parameters, _ in points])
    # A mean is over the samples whose loads reach the load of --at.
    behind = [
        [point["cases"].item(), *(point[f"{name}_count"].item() for name in names)] for _, point in points
    ]
    add("samples", [str(int(min(counts))) for counts in behind])
    if not laws and (resolved := resolved_in(averaged)) is not None:
        add("resolved", list(map(str, resolved.to_numpy().ravel())))
    if laws:
        for name in _LAW:
            pairs = [(point[name].item(), point[f"{name}_error"].item()) for _, point in points]
            add(name, [_with_error(*pair) for pair in pairs])
        add("from F/(E* h L)", [_number(point["window_low"].item()) for _, point in points])
        add("to", [_number(point["window_high"].item()) for _, point in points])
        for title, name in (("loads", "law_count"), ("resolved", "law_resolved")):
            if name in averaged:
                add(title, [str(int(point[name])) for _, point in points])
    for name in names:
        mean, error = averaged[f"{name}_mean"], averaged[f"{name}_standard_error"]
        chosen = scale(float(abs(mean).max()), mean.attrs.get("units", ""))
        cells = [
            _with_error(*(point[each.name].item() * chosen.factor for each in (mean, error)))
            for _, point in points
        ]
        add(f"{name.replace('_', ' ')} [{chosen.unit}]" if chosen.unit else name.replace("_", " "), cells)
    return header, [list(row) for row in zip(*columns, strict=True)]


def _number(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else "-"


def _with_error(value: float, error: float) -> str:
    """Return a mean and its error, both to two digits of the error."""
    if not math.isfinite(value):
        return "-"
    if not error > _EQUAL * abs(value) or not math.isfinite(error):
        return f"{value:.4g}"
    digits = max(1 - math.floor(math.log10(error)), 0)
    if digits > _MOST_DECIMALS:
        return f"{value:.3e} +- {error:.1e}"
    return f"{value:.{digits}f} +- {error:.{digits}f}"


def _record(
    averaged: xarray.Dataset, folder: Path, names: Sequence[str], laws: bool, load: tuple[str, float] | None
) -> dict[str, Any]:
    """Return the table as plain values."""
    from roughcontact.labels.labelled import plain_values
    from roughcontact.statistics.averages import combinations

    words = ("mean", "standard_deviation", "standard_error", "count")
    rows = []
    counted = resolved_in(averaged)
    resolved = None if counted is None else iter(counted.to_numpy().ravel().tolist())
    for parameters, point in combinations(averaged):
        row: dict[str, Any] = {"parameters": parameters, "samples": int(point["cases"])}
        if laws:
            law = [str(n) for n in point if str(n).startswith((*_LAW, "window_", "law_")) or n == "misfit"]
            row["power_law"] = {name: plain_values(point[name].item()) for name in law}
        elif resolved is not None:
            row["resolved"] = next(resolved)
        for name in names:
            row[name] = {word: plain_values(point[f"{name}_{word}"].item()) for word in words}
        rows.append(row)
    record: dict[str, Any] = {"command": "study table", "folder": str(folder), "rows": rows}
    if load is not None:
        record |= dict([load])
    if "window" in averaged.attrs:
        record["window"] = averaged.attrs["window"]
    units = {name: averaged[f"{name}_mean"].attrs.get("units", "") for name in names}
    return record | {"units": {name: unit for name, unit in units.items() if unit}}
