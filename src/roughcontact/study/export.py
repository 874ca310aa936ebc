"""All cases of a study as one dataset, for notebooks and files."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.labels.labelled import attributes_of
from roughcontact.labels.variables import VARIABLES
from roughcontact.study.cases import find_case
from roughcontact.study.cases.shared_parameters import RoughSquare
from roughcontact.study.collect import Collector
from roughcontact.study.nested_names import flat
from roughcontact.study.study_errors import StudyError
from roughcontact.version import __version__

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.record import Row
    from roughcontact.study.store import Store
    from roughcontact.study.study import Study

__all__ = ["assemble", "export"]

_CONVENTIONS = {"Conventions": "CF-1.11"}
Triple = tuple[tuple[str, ...], Any, dict[str, str]]


def export(store: Store, *, seconds: bool = False) -> xarray.Dataset:
    """Return all records of a store as one dataset, without their fields; see `assemble`.

    For an unfinished study, it contains the finished cases.

    Parameters
    ----------
    store : Store
        An open store.
    seconds : bool
        Whether to include the computing time of each case as a variable.

    Returns
    -------
    xarray.Dataset
        Along the parameters of the table and the samples.

    Raises
    ------
    StoreError
        If a record is damaged.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed, table={"hurst": [0.6, 0.8]})
    >>> rc.study.run(study, "few").done
    4
    >>> with rc.study.Store.open("few") as store:
    ...     dataset = rc.study.export(store)
    >>> dict(dataset["stiffness"].sizes), dataset["stiffness"].attrs["units"]
    ({'hurst': 2, 'sample': 2, 'load': 3}, 'N m-1')
    """
    dataset = assemble(store.study, store.rows(), seconds=seconds)
    is_square = issubclass(find_case(store.study.case).parameters, RoughSquare)
    return _per_area(dataset) if is_square else dataset


def _per_area(dataset: xarray.Dataset) -> xarray.Dataset:
    """Return a dataset of rough squares with quantities per area; records only hold forces and areas."""
    area = dataset["size"] ** 2
    pairs = {"nominal_pressure": "force", "contact_fraction": "contact_area"}
    pairs["interfacial_stiffness_per_area"] = "interfacial_stiffness"
    found = {name: dataset[of] / area for name, of in pairs.items() if of in dataset}
    return dataset.assign(
        {name: values.assign_attrs(attributes_of(VARIABLES[name])) for name, values in found.items()}
    )


def assemble(study: Study, rows: Iterable[Row], *, seconds: bool = False) -> xarray.Dataset:
    """Return the records of a study as one dataset.

    Dimensions are the names of the study's table in their order (after ``row`` if it has rows), ``sample``, and those
    of the collector. Their coordinates are the values of the parameters, in SI. Parameters that are the same for all
    cases are coordinates without a dimension, unless the records hold a variable of this name.

    - A variable that is the same in all records is stored once, with its dimensions in a record. So is a coordinate
      of points that longer records continue; a coordinate that differs becomes a variable ``record_NAME``.
    - Shorter records, and failed or missing cases, are filled with NaN, empty words or False. Whole numbers become
      real ones if one is missing.
    - A variable or dimension of the records with the name of a varying parameter is renamed to ``record_NAME``.
    - ``case_status`` is "done", "failed" or "missing".

    Parameters
    ----------
    study : Study
    rows : iterable of Row
        In any order; rows of other studies are left out.
    seconds : bool
        Whether to include the computing time of each case. Without it, exports of the same study are always equal.

    Raises
    ------
    ValueError
        If a variable has other dimensions or another unit in one record than in another.
    """
    import xarray

    layout = _layout_of(study)
    outer, cases = tuple(layout.sizes), tuple(layout.sizes.values())
    status = np.full(cases, "missing")
    times = np.full(cases, np.nan)
    collector = Collector(layout.sizes, frozenset(layout.coordinates))
    versions = set()
    for row in rows:
        place = layout.places.get(row.key)
        if place is None:
            continue
        status[place], times[place] = row.status, row.seconds
        record = row.record
        if record is not None:
            collector.add(place, record)
            versions.add(row.version)

    constants = {name: value for name, value in layout.constants.items() if name not in collector.names}
    data, coordinates = collector.variables()
    data["case_status"] = (outer, status, {"long_name": "whether the case is done, failed or missing"})
    if seconds:
        data["case_seconds"] = (outer, times, {"long_name": "wall time of the case", "units": "s"})
    source = {
        "source": f"roughcontact {', '.join(sorted(versions)) or __version__}",
        "study": study.model_copy(update={"folder": ""}).to_toml(),
    }
    return xarray.Dataset(
        data,
        {**layout.coordinates, **coordinates, **constants},
        {**_CONVENTIONS, **collector.attributes, **source},
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Layout:
    """The dimensions of a study: its rows, its table, its samples.

    Attributes
    ----------
    sizes : dict of int
        By name, in order; ``sample`` is the last.
    coordinates : dict
        The varying parameters, by name: dimensions, values and attributes.
    constants : dict
        The constant parameters, in the same form.
    places : dict
        The place of every case, by its key.
    """

    sizes: Mapping[str, int]
    coordinates: Mapping[str, Triple]
    constants: Mapping[str, Triple]
    places: Mapping[str, tuple[int, ...]]


def _layout_of(study: Study) -> _Layout:
    """Return the layout of a study.

    Each name of the table is a dimension, in the order of the table. Rows make a dimension ``row``; the values of all
    names in the rows are along it.

    Raises
    ------
    StudyError
        If a parameter that varies is called ``row`` or ``sample``.
    """
    in_rows = list(dict.fromkeys(name for row in study.rows for name in flat(row)))
    labelled = [each.labelled([*in_rows, *study.table]) for each in study.combinations()]
    units = {name: unit for each in labelled for name, (_, unit) in each.items() if unit}
    combinations = [{name: value for name, (value, _) in each.items()} for each in labelled]
    if taken := sorted({"row", "sample"} & {*in_rows, *study.table}):
        raise StudyError(
            f"a varying parameter cannot be called {taken[0]!r}: this is the name of another dimension"
        )

    values = {name: _distinct([each[name] for each in combinations]) for name in study.table}
    sizes = {name: len(each) for name, each in values.items()}
    in_one_row = math.prod(sizes.values())
    coordinates = {name: _coordinate((name,), each, units.get(name)) for name, each in values.items()}
    if study.rows:
        sizes = {"row": len(study.rows)} | sizes
        coordinates["row"] = (("row",), np.arange(len(study.rows)), {"long_name": "row of the study"})
        for name in in_rows:
            along = [each[name] for each in combinations[::in_one_row]]
            coordinates[name] = _coordinate(("row",), along, units.get(name))
    coordinates["sample"] = (("sample",), np.arange(study.samples), {"long_name": "number of the sample"})
    constants = {
        name: _coordinate((), value, units.get(name))
        for name, value in combinations[0].items()
        if name not in coordinates and isinstance(value, bool | int | float | str)
    }
    shape = tuple(sizes.values())
    places = {}
    for number, task in enumerate(study.tasks()):
        place = np.unravel_index(number % len(combinations), shape) if shape else ()
        places[task.key] = (*map(int, place), task.sample)
    return _Layout(sizes | {"sample": study.samples}, coordinates, constants, places)


def _distinct(values: Sequence[Any]) -> list[Any]:
    """Return values in the order in which they first occur."""
    return list({json.dumps(each, sort_keys=True): each for each in values}.values())


def _coordinate(dimensions: tuple[str, ...], values: Any, unit: str | None) -> Triple:
    """Return values as numbers, truth values or words; mixed values and all other types as JSON."""
    each = values if dimensions else [values]
    kinds = {type(value) for value in each}
    if kinds <= {int, float, type(None)} and kinds != {type(None)}:
        values = np.array([math.nan if value is None else value for value in each])
    elif kinds in ({bool}, {str}):
        values = np.array(each)
    else:
        values = np.array([value if isinstance(value, str) else json.dumps(value) for value in each])
    attributes = {"long_name": "parameter of the case"} | ({"units": unit} if unit else {})
    return dimensions, values if dimensions else values[0], attributes
