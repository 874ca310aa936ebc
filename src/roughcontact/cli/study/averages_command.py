"""The commands ``study average``, ``study plot`` and ``study table``: what a study says on the average."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.options import JSON
from roughcontact.cli.report import emit, print_facts, print_table
from roughcontact.cli.study.study_command import FOLDER, dataset_writer, own_cases, require_results
from roughcontact.errors import InputError, placed
from roughcontact.files.quantity import parse_number
from roughcontact.plot.drawing.engineering_units import scale
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.texts import choose

if TYPE_CHECKING:
    import xarray

    from roughcontact.statistics.fit_window import Window

__all__ = ["EXAMPLES", "average", "plot", "table"]

EXAMPLES = {
    "average": """
roughcontact study average results --out averages.csv
roughcontact study average results --out averages.nc --window 1e-3:0.07
""",
    "plot": """
roughcontact study plot results --out hurst.png
roughcontact study plot results --out area.pdf --quantity contact_area
roughcontact study plot results --out slope.svg --quantity rms_slope --along hurst
""",
    "table": """
roughcontact study table results
roughcontact study table results --quantity stiffness,contact_area --at 0.01
""",
}

FILE = option("File to write: .nc or .csv.", "FILE", default=...)
PICTURE = option("Picture to write: .png, .pdf or .svg.", "FILE", default=...)
QUANTITY = option(
    "What to draw (default: stiffness over E* L, with its power laws; else the first that differs).", "NAME"
)
QUANTITIES = option(
    "Whose mean and standard error to print (default: power laws; else all numbers without loads).",
    "NAME,...",
)
ALONG = option("The parameter on the axis (default: the number with most values).", "NAME")
AT = option("For quantities along the loads: at which force over E* h L.", "0.01")

_STIFFNESS = "dimensionless_stiffness"
_LAW = ("exponent", "prefactor")
_EQUAL = 1e-12  # of a mean: samples that differ by no more are equal
_CERTIFICATES = ("residual", "stiffness_residual", "resolved")  # shown where they are asked for
_MOST_DECIMALS = 5  # beyond these a power of ten is shorter
_LEAST = 3  # forces that make a law, as in statistics.fit


def _window(text: str) -> tuple[float, float]:
    """Return the two ends of a window of forces over E* h L."""
    parts = text.split(":")
    if len(parts) != 2:
        raise InputError(f"{text!r} is no window", "write two forces over E* h L, 1e-3:0.07")
    low, high = (parse_number(part, "1e-3") for part in parts)
    if not 0 <= low < high:
        raise InputError(f"a window goes from a force to a larger one, unlike {text!r}", "exchange the two")
    return low, high


@dataclass(frozen=True, slots=True, kw_only=True)
class LawWindow:
    """Where the power laws are fitted."""

    window: str | None = described(
        "Window of F/(E* h L) that power laws are fitted in (default: where the mean stiffness is resolved, up to "
        "0.07).",
        "1e-3:0.07",
        read=_window,
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)

    def value(self) -> Window | None:
        """Return the window; None where it was left out."""
        from roughcontact.statistics.fit_window import force_window

        ends = value_of(self, "window")
        return None if ends is None else force_window(*ends)


def average(folder: Path = FOLDER, *, out: Path = FILE, window: LawWindow, json: bool = JSON) -> None:
    """Write means, scatter and errors of all that a study computed, and its power laws, into one file."""
    with reported(folder, out, as_json=json), own_cases():
        write = dataset_writer(out)
        averaged = _averaged(folder, window.value())
        write(averaged)
        _note_laws(averaged)
        cases = int(averaged["cases"].sum())
        if json:
            emit({"command": "study average", "folder": str(folder), "file": str(out), "cases": cases})
        else:
            combinations = averaged["cases"].size
            what = f"averages of {cases} cases, {combinations} combination{'s' if combinations != 1 else ''}"
            print_facts([("file", str(out)), ("content", what)])


def plot(
    folder: Path = FOLDER,
    *,
    out: Path = PICTURE,
    quantity: str | None = QUANTITY,
    along: str | None = ALONG,
    window: LawWindow,
    json: bool = JSON,
) -> None:
    """Draw means with their errors: against force with power laws, or against what varies."""
    with reported(folder, out, as_json=json), own_cases():
        from roughcontact.files.aside import require_target
        from roughcontact.plot.canvas import require_picture, save
        from roughcontact.plot.study_picture import study_figure

        require_picture(out)
        require_target(out)
        averaged = _averaged(folder, window.value())
        chosen = quantity or _first(averaged)
        save(study_figure(averaged, chosen, along), out)
        if chosen == _STIFFNESS:
            _note_laws(averaged)
        if json:
            emit({"command": "study plot", "folder": str(folder), "file": str(out), "quantity": chosen})
        else:
            print_facts([("file", str(out)), ("quantity", chosen)])


def table(
    folder: Path = FOLDER,
    *,
    quantity: str | None = QUANTITIES,
    at: str | None = AT,
    window: LawWindow,
    json: bool = JSON,
) -> None:
    """Print one line for each combination of what varies: power laws, or means with their standard errors."""
    with reported(folder, as_json=json), own_cases():
        with placed("at"):
            force = None if at is None else parse_number(at, "0.01")
        if force is not None and not force > 0:
            raise UsageError(f"a force over E* h L is above 0, not {at!r}", place="--at")
        averaged = _averaged(folder, window.value(), force)
        laws = quantity is None and "exponent" in averaged and force is None
        names = () if laws else _quantities(averaged, quantity, force)
        if json:
            emit(_record(averaged, folder, names, laws, force))
        else:
            print_table(*_table(averaged, names, laws))
        if laws or (quantity is None and force is None):
            _note_laws(averaged)


def _averaged(folder: Path, window: Window | None, force: float | None = None) -> xarray.Dataset:
    """Return the averages of what a folder holds, all of it or at one force."""
    import numpy as np

    from roughcontact.statistics.averages import averages
    from roughcontact.statistics.common_forces import on_common
    from roughcontact.study.export import export
    from roughcontact.study.store import Store

    with Store.open(folder) as store:
        summary, seed = store.summary(), store.study.seed
        require_results(folder, summary)
        dataset = export(store)
    if summary.failed or summary.left:
        note(f"{summary.failed} cases failed and {summary.left} are left: they have no part in the averages")
    if force is not None:
        _require_between(dataset, force)
        dataset = on_common(dataset, [force]).isel(dimensionless_force=0)
    return averages(dataset, window, rng=np.random.default_rng(seed))


def _require_between(dataset: xarray.Dataset, force: float) -> None:
    """Refuse a force that no load of the study comes near."""
    from roughcontact.statistics.power_law import ROUNDING

    if "dimensionless_force" not in dataset:
        raise UsageError("the study has no forces over E* h L", "see roughcontact study export", place="--at")
    low, high = (
        float(each) for each in (dataset["dimensionless_force"].min(), dataset["dimensionless_force"].max())
    )
    if not low * (1 - ROUNDING) <= force <= high * (1 + ROUNDING):
        raise UsageError(
            f"the loads go from {low:g} to {high:g}",
            f"choose a force between them, not {force:g}",
            place="--at",
        )


def _first(averaged: xarray.Dataset) -> str:
    """Return what is drawn unasked: the stiffness over E* L, else what differs first along the loads, else at all."""
    names = _means(averaged)
    along = [name for name in names if "load" in averaged[f"{name}_mean"].dims and "force" not in name]
    found = [name for name in (_STIFFNESS, *along, *names) if name in names]
    if not found:
        raise UsageError(
            "nothing in the study differs from sample to sample", "see roughcontact study export"
        )
    return found[0]


def _means(averaged: xarray.Dataset) -> list[str]:
    """Return the names of what has a mean."""
    return [str(name).removesuffix("_mean") for name in averaged.data_vars if _is_mean(str(name))]


def _is_mean(name: str) -> bool:
    return name.endswith("_mean") and not name.endswith("_geometric_mean")


def _quantities(averaged: xarray.Dataset, asked: str | None, force: float | None) -> tuple[str, ...]:
    """Return the quantities of a table: one number for each combination."""
    single = [name for name in _means(averaged) if averaged[f"{name}_mean"].dims == averaged["cases"].dims]
    if asked is None:
        if not single:
            raise UsageError(
                "all quantities lie along the loads", "choose a force by --at, such as --at 0.01"
            )
        return tuple(name for name in single if name not in _CERTIFICATES)
    names = tuple(part.strip() for part in asked.split(",") if part.strip())
    for name in names:
        if name not in _means(averaged):
            raise UsageError(
                f"no {name!r} differs between samples",
                choose(name, _means(averaged)),
                place="--quantity",
            )
        if name not in single:
            missing = (
                "choose a force by --at, such as --at 0.01"
                if force is None
                else f"choose of {', '.join(single)}"
            )
            raise UsageError(f"{name} lies along {_rest(averaged, name)}: {missing}", place="--quantity")
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

    for name in points[0][0]:
        values = [parameters[name] for parameters, _ in points]
        add(*_parameter(name, values, averaged[name].attrs.get("units", "")))
    add("samples", [str(int(point["cases"])) for _, point in points])
    if laws:
        for name in _LAW:
            pairs = [(point[name].item(), point[f"{name}_error"].item()) for _, point in points]
            add(name, [_with_error(*pair) for pair in pairs])
        add("from F/(E* h L)", [_number(point["window_low"].item()) for _, point in points])
        add("to", [_number(point["window_high"].item()) for _, point in points])
        add("loads", [str(int(point["law_count"])) for _, point in points])
    for name in names:
        mean, error = averaged[f"{name}_mean"], averaged[f"{name}_standard_error"]
        chosen = scale(float(abs(mean).max()), mean.attrs.get("units", ""))
        cells = [
            _with_error(*(point[each.name].item() * chosen.factor for each in (mean, error)))
            for _, point in points
        ]
        add(f"{name.replace('_', ' ')} [{chosen.unit}]" if chosen.unit else name.replace("_", " "), cells)
    return header, [list(row) for row in zip(*columns, strict=True)]


def _parameter(name: str, values: list[Any], unit: str) -> tuple[str, list[str]]:
    """Return title and cells of a parameter that varies."""
    title = name.replace("_", " ")
    if not all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        return title, [str(value) for value in values]
    chosen = scale(max(map(abs, values)), unit)
    return (f"{title} [{chosen.unit}]" if chosen.unit else title), [f"{v * chosen.factor:g}" for v in values]


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
    averaged: xarray.Dataset, folder: Path, names: Sequence[str], laws: bool, force: float | None
) -> dict[str, Any]:
    """Return the table as plain values."""
    from roughcontact.labels.labelled import plain_values
    from roughcontact.statistics.averages import combinations

    words = ("mean", "standard_deviation", "standard_error", "count")
    rows = []
    for parameters, point in combinations(averaged):
        row: dict[str, Any] = {"parameters": parameters, "samples": int(point["cases"])}
        if laws:
            law = [str(n) for n in point if str(n).startswith((*_LAW, "window_", "law_")) or n == "misfit"]
            row["power_law"] = {name: plain_values(point[name].item()) for name in law}
        for name in names:
            row[name] = {word: plain_values(point[f"{name}_{word}"].item()) for word in words}
        rows.append(row)
    record: dict[str, Any] = {"command": "study table", "folder": str(folder), "rows": rows}
    if force is not None:
        record["dimensionless_force"] = force
    if "window" in averaged.attrs:
        record["window"] = averaged.attrs["window"]
    units = {name: averaged[f"{name}_mean"].attrs.get("units", "") for name in names}
    return record | {"units": {name: unit for name, unit in units.items() if unit}}


def _note_laws(averaged: xarray.Dataset) -> None:
    """Say where there is no power law, and why."""
    from roughcontact.statistics.averages import combinations

    if "no_power_law" in averaged.attrs:
        why, _, ways = averaged.attrs["no_power_law"].partition(": give a window")
        note(f"no power laws: {why}{': give a --window, such as 1e-3:0.07' if ways else ''}")
        return
    without = [
        ", ".join(f"{name} = {value}" for name, value in parameters.items()) or "the study"
        for parameters, point in combinations(averaged)
        if point["law_count"].item() < _LEAST
    ]
    if without:
        shown = "; ".join(without[:3]) + (f" and {len(without) - 3} more" if len(without) > 3 else "")
        note(
            f"no power law for {shown}: fewer than {_LEAST} loads lie in the window ({averaged.attrs['window']}); "
            "compute more loads or more points, or choose another --window"
        )
