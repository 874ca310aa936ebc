"""The commands ``study average`` and ``study plot``, and the averages for them and ``study table``."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.options import JSON
from roughcontact.cli.report import emit, print_facts
from roughcontact.cli.study.study_command import FOLDER, dataset_writer, own_cases, require_results
from roughcontact.errors import InputError, placed
from roughcontact.files.quantity import FORCE, PRESSURE, has_unit, parse, parse_number
from roughcontact.labels.engineering_units import written
from roughcontact.plot.drawing.parameter_labels import parameter_labels
from roughcontact.recipe.recipe_fields import check, described, value_of

if TYPE_CHECKING:
    import xarray

    from roughcontact.statistics.fit_window import Window

__all__ = [
    "AT",
    "EXAMPLES",
    "USUAL",
    "LawWindow",
    "average",
    "averaged_in",
    "load_of",
    "means_of",
    "note_laws",
    "note_unresolved",
    "plot",
    "resolved_in",
    "written_load",
]

EXAMPLES = {
    "average": """
roughcontact study average results --out averages.csv
roughcontact study average results --out averages.nc --window 1e-3:0.07
""",
    "plot": """
roughcontact study plot results --out hurst.png
roughcontact study plot results --out area.pdf --quantity contact_area
roughcontact study plot results --out slope.svg --quantity rms_slope --along hurst
roughcontact study plot results --out pressed.png --at 1MPa --along rms
""",
}

FILE = option("File to write: .nc or .csv.", "FILE", default=...)
PICTURE = option("Picture to write: .png, .pdf or .svg.", "FILE", default=...)
QUANTITY = option(
    "Quantity to draw (default: stiffness over E* L, with its power laws; with --at the interfacial "
    "stiffness per area; otherwise the first quantity that differs between samples).",
    "NAME",
)
ALONG = option(
    "With --at, the parameter on the axis; for curves, the parameter that differs within a panel (default: the "
    "number with most values; for curves, among those that change them).",
    "NAME",
)
AT = option(
    "Load at which quantities along the loads are taken: a pressure (1MPa) or a force (10N). A number without a unit "
    "is not in SI units: it is the force over E* h L.",
    "1MPa",
)

USUAL = ("interfacial_stiffness_per_area", "stiffness", "contact_fraction", "mean_gap")  # at one load

_STIFFNESS = "dimensionless_stiffness"
_LEAST = 3  # least number of forces for a law, as in statistics.fit


def _window(text: str) -> tuple[float, float]:
    """Return the ends of a window of forces over E* h L."""
    parts = text.split(":")
    if len(parts) != 2:
        raise InputError(f"{text!r} is not a window", "write two forces over E* h L, 1e-3:0.07")
    low, high = (parse_number(part, "1e-3") for part in parts)
    if not 0 <= low < high:
        raise InputError(
            f"the first force of the window {text!r} must be smaller than the second", "exchange the two"
        )
    return low, high


@dataclass(frozen=True, slots=True, kw_only=True)
class LawWindow:
    """The window of the power laws."""

    window: str | None = described(
        "Window of F/(E* h L) for the fit of power laws (default: where the mean stiffness is resolved, up to "
        "0.07).",
        "1e-3:0.07",
        read=_window,
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)

    def value(self) -> Window | None:
        """Return the window; None if it is not given."""
        from roughcontact.statistics.fit_window import force_window

        ends = value_of(self, "window")
        return None if ends is None else force_window(*ends)


def average(folder: Path = FOLDER, *, out: Path = FILE, window: LawWindow, json: bool = JSON) -> None:
    """Write means, scatter and errors of all results of a study, and its power laws, into one file."""
    with reported(folder, out, as_json=json), own_cases():
        write = dataset_writer(out)
        averaged = averaged_in(folder, window.value())
        write(averaged)
        note_laws(averaged)
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
    at: str | None = AT,
    window: LawWindow,
    json: bool = JSON,
) -> None:
    """Draw means with their errors: against force with power laws, or against a parameter."""
    with reported(folder, out, as_json=json), own_cases():
        from roughcontact.files.aside import require_target
        from roughcontact.plot.canvas import require_picture, save
        from roughcontact.plot.study_picture import study_figure

        require_picture(out)
        require_target(out)
        load = load_of(at)
        averaged = averaged_in(folder, window.value(), load)
        chosen = quantity or _first(averaged, () if load else (_STIFFNESS,))
        save(study_figure(averaged, chosen, along, at=written_load(*load) if load else ""), out)
        if load is not None:
            note_unresolved(averaged, chosen)
        elif chosen == _STIFFNESS:
            note_laws(averaged)
        if json:
            record = {"command": "study plot", "folder": str(folder), "file": str(out), "quantity": chosen}
            emit(record | (dict([load]) if load else {}))
        else:
            print_facts([("file", str(out)), ("quantity", chosen)])


def load_of(at: str | None) -> tuple[str, float] | None:
    """Return the variable and the value in SI of ``--at``; None if it is not given."""
    if at is None:
        return None
    with placed("at"):
        name, value = _with_unit(at) if has_unit(at) else ("dimensionless_force", parse_number(at, "0.01"))
        if not value > 0:
            raise InputError(f"{at!r} is not above 0", "choose a load above 0")
    return name, value


def written_load(name: str, value: float) -> str:
    """Return a load in words, such as 1 MPa."""
    from roughcontact.labels.variables import VARIABLES

    words = written(value, VARIABLES[name].unit, 4)
    return f"F/(E* h L) = {words}" if name == "dimensionless_force" else words


def _with_unit(text: str) -> tuple[str, float]:
    for name, kind in (("nominal_pressure", PRESSURE), ("force", FORCE)):
        with suppress(InputError):
            return name, parse(text, kind)
    raise InputError(
        f"{text!r} is neither a pressure nor a force",
        "write a pressure such as 1MPa, a force such as 10N, or a force over E* h L such as 0.01",
    )


def averaged_in(folder: Path, window: Window | None, load: tuple[str, float] | None = None) -> xarray.Dataset:
    """Return the averages of the results in a folder, at all loads or at one."""
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
        without = f"{summary.failed} cases failed, {summary.left} are not computed"
        note(f"{without}: the averages are of the other {summary.done}")
    if load is not None:
        name, value = load
        _require_between(dataset, name, value)
        dataset = on_common(dataset, [value], at=name).isel({name: 0})
    return averages(dataset, window, rng=np.random.default_rng(seed))


def _require_between(dataset: xarray.Dataset, name: str, value: float) -> None:
    """Raise an error for a load outside the loads of the study."""
    from roughcontact.labels.variables import VARIABLES
    from roughcontact.statistics.power_law import ROUNDING

    words = VARIABLES[name].label
    such = {
        "nominal_pressure": "the pressure",
        "force": "the force",
        "dimensionless_force": "the force over E* h L",
    }
    if name not in dataset or "load" not in dataset[name].dims:
        known = [words.replace("the ", "a ") for each, words in such.items() if each in dataset]
        raise UsageError(
            f"the loads of the study have no {words}",
            f"give {' or '.join(known)}" if known else "see roughcontact study export",
            place="--at",
        )
    low, high = float(dataset[name].min()), float(dataset[name].max())
    if not low * (1 - ROUNDING) <= value <= high * (1 + ROUNDING):
        low_, high_, value_ = (written(each, VARIABLES[name].unit, 4) for each in (low, high, value))
        raise UsageError(
            f"{such[name]} of the study goes from {low_} to {high_}, and {value_} is not between them",
            "choose a load between them"
            + ("; a pressure or a force has a unit: 1MPa, 10N" if name == "dimensionless_force" else ""),
            place="--at",
        )


def _first(averaged: xarray.Dataset, preferred: tuple[str, ...]) -> str:
    """Return the default quantity: a preferred or usual one, or the first along the loads, or the first."""
    names = means_of(averaged)
    along = [name for name in names if "load" in averaged[f"{name}_mean"].dims and "force" not in name]
    found = [name for name in (*(preferred or USUAL), *along, *names) if name in names]
    if not found:
        raise UsageError(
            "nothing in the study differs from sample to sample", "see roughcontact study export"
        )
    return found[0]


def means_of(averaged: xarray.Dataset) -> list[str]:
    """Return the names of the quantities that have a mean."""
    return [str(name).removesuffix("_mean") for name in averaged.data_vars if _is_mean(str(name))]


def _is_mean(name: str) -> bool:
    return name.endswith("_mean") and not name.endswith("_geometric_mean")


def resolved_in(averaged: xarray.Dataset) -> xarray.DataArray | None:
    """Return the number of samples of each combination that resolve the load; None unless there is one load each."""
    found = averaged.get("resolved_samples")
    return found if found is not None and found.dims == averaged["cases"].dims else None


def note_unresolved(averaged: xarray.Dataset, quantity: str) -> None:
    """Print a note if means at one load contain samples that do not resolve it, or lack samples."""
    resolved = resolved_in(averaged)
    if resolved is not None and bool((short := resolved < averaged["cases"]).any()):
        note(
            f"{'all' if bool(short.all()) else 'some'} means contain loads that are not resolved (column resolved of "
            "study table): compute more points or larger loads"
        )
    if bool((averaged[f"{quantity}_count"] < averaged["cases"]).any()):
        note(
            "the loads of some samples do not reach this load (column samples of study table): prescribe loads on both "
            "sides of it"
        )


def note_laws(averaged: xarray.Dataset) -> None:
    """Print which power laws are missing, and why."""
    from roughcontact.statistics.averages import combinations

    if "no_power_law" in averaged.attrs:
        why, _, ways = averaged.attrs["no_power_law"].partition(": give a window")
        note(f"no power laws: {why}{': give a --window, such as 1e-3:0.07' if ways else ''}")
        return
    labels = parameter_labels(averaged)
    without = [
        ", ".join(labels[name].equation(value) for name, value in parameters.items()) or "the study"
        for parameters, point in combinations(averaged)
        if point["law_count"].item() < _LEAST
    ]
    if without:
        shown = "; ".join(without[:3]) + (f" and {len(without) - 3} more" if len(without) > 3 else "")
        note(
            f"no power law for {shown}: fewer than {_LEAST} loads lie in the window ({averaged.attrs['window']}); "
            "compute more loads or more points, or choose another --window"
        )
