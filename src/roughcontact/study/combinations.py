"""The combinations of the parameters, rows and table of a study, and the errors in them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TypeAlias

from roughcontact.errors import InputError, every
from roughcontact.recipe.texts import choose
from roughcontact.study.cases import find_case
from roughcontact.study.nested_names import flat, merged
from roughcontact.study.ranges import Range
from roughcontact.study.study_errors import MOST_MISTAKES, StudyError
from roughcontact.study.task import canonical

if TYPE_CHECKING:
    from roughcontact.study.case import Parameters

__all__ = ["MOST_CASES", "combined", "reads_files"]

MOST_CASES = 10_000_000  # of a study: each has a key in memory and a row in a database
Study: TypeAlias = Any  # the class of study/study.py, which imports this file
_OF_THE_STUDY = ("folder", "files")


def reads_files(case: str) -> bool:
    """Return whether a case reads files, whose names are relative to the folder of the study."""
    with suppress(StudyError):
        return _is_of_the_study(find_case(case).parameters, "folder")
    return False


def combined(study: Study) -> tuple[dict[str, Parameters], list[InputError]]:
    """Return the parameters of each combination by their canonical text, and all errors in them."""
    model = find_case(study.case).parameters
    mistakes = list(_misnamed(study, model))
    said = {one.place for one in mistakes}
    values: dict[str, tuple[Any, ...]] = {}
    for name, entry in study.table.items():
        try:
            values[name] = _values(study, model, name, entry)
        except InputError as error:
            mistakes += [InputError(one.message, one.remedy, f"table.{name}") for one in every(error)]
    cases = study.samples * max(len(study.rows), 1) * math.prod(map(len, values.values()))
    if cases > MOST_CASES:
        much = f"they make {cases:,} cases, and a study has {MOST_CASES:,} at most"
        few = "take fewer samples or values, or several studies"
        return {}, [*mistakes, InputError(much, few, "samples, rows, table")]
    # A table with unreadable values counts as empty; this must not be reported as another error.
    said |= {f"table.{name}" for name in study.table.keys() - values.keys()}
    found: dict[str, Parameters] = {}
    rows: tuple[dict[str, Any], ...] = study.rows or ({},)
    for row in rows:
        for chosen in itertools.product(*values.values()):
            if len(mistakes) > MOST_MISTAKES:
                return found, mistakes
            try:
                parameters = model(
                    **merged(study.parameters, row, dict(zip(values, chosen, strict=True))),
                    **{name: getattr(study, name) for name in _OF_THE_STUDY if _is_of_the_study(model, name)},
                )
            except InputError as error:
                new = [InputError(one.message, one.remedy, _place(study, one.place)) for one in every(error)]
                known = {(one.place, one.message) for one in mistakes}
                mistakes += [
                    one for one in new if one.place not in said and (one.place, one.message) not in known
                ]
                continue
            text = canonical(parameters)
            if text in found:
                remedy = "remove one from the table or the rows"
                mistakes.append(InputError(f"a case appears twice: {text}", remedy, "table, rows"))
            found[text] = parameters
    return found, mistakes


def _misnamed(study: Study, model: type[Parameters]) -> Iterator[InputError]:
    """Yield the errors of unknown names, and of names that are given in two places."""
    known = {name for name in model.model_fields if not _is_of_the_study(model, name)}
    wholes = {name: [each for each in values if isinstance(each, Mapping)] for name, values in _lists(study)}
    places: dict[str, set[str]] = {
        "parameters": set(flat(study.parameters)),
        "table": {
            *study.table,
            *(f"{name}.{one}" for name in wholes for each in wholes[name] for one in flat(each)),
        },
        "rows": {name for row in study.rows for name in flat(row)},
    }
    for place, names in places.items():
        for name in sorted({name.partition(".")[0] for name in names} - known):
            if model.model_config.get("extra") != "allow":
                words = f"the case {study.case!r} has no parameter {name!r}: {choose(name, sorted(known))}"
                yield InputError(words, None, f"{place}.{name}")
    for one, other in itertools.combinations(places, 2):
        for name in sorted(places[one] & places[other]):
            words = f"{name!r} is given both in {one} and in {other}"
            yield InputError(words, "remove it from one of them", f"{one}.{name}, {other}.{name}")


def _is_of_the_study(model: type[Parameters], name: str) -> bool:
    """Return whether a study sets this field of its cases, which is neither a parameter nor part of a key."""
    return name in _OF_THE_STUDY and name in model.model_fields and bool(model.model_fields[name].exclude)


def _lists(study: Study) -> Iterator[tuple[str, tuple[Any, ...]]]:
    yield from ((name, values) for name, values in study.table.items() if not isinstance(values, Range))


def _values(
    study: Study, model: type[Parameters], name: str, entry: Range | tuple[Any, ...]
) -> tuple[Any, ...]:
    """Return the values of a parameter in the table."""
    if not isinstance(entry, Range):
        return entry
    return entry.values(model.reader(name, merged(study.parameters, *study.rows[:1])))


def _place(study: Study, places: str | None) -> str | None:
    """Return the places of an error in the study, separated by commas."""
    tables = {"table": set(study.table), "rows": {name for row in study.rows for name in flat(row)}}

    def found(place: str) -> str:
        for table, names in tables.items():
            if any(
                f"{one}.".startswith(f"{other}.")
                for name in names
                for one, other in ((name, place), (place, name))
            ):
                return f"{table}.{place}"
        return f"parameters.{place}"

    return None if places is None else ", ".join(map(found, places.split(", ")))
