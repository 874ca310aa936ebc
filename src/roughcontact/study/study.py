"""A study: a case, the parameters that it is computed for, and how many samples of each."""

from __future__ import annotations

import itertools
import math
import os
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    PlainValidator,
    TypeAdapter,
    ValidationError,
    model_validator,
)

from roughcontact.errors import InputError
from roughcontact.files.aside import written_aside
from roughcontact.study.case import Case, Parameters
from roughcontact.study.cases import find_case
from roughcontact.study.checked import TOO_DEEP, Checked
from roughcontact.study.ranges import Range
from roughcontact.study.study_errors import StudyError, expected, invalid
from roughcontact.study.task import Task, canonical, key_of
from roughcontact.study.toml import toml_of
from roughcontact.units import as_text

__all__ = ["Study"]

MOST_CASES = 10_000_000  # of a study: every one has a key in memory and a row in a database


def _study_name(name: str) -> str:
    """Return the name of a study, which must do as the name of a folder on every system.

    Raises
    ------
    ValueError
        If it does not.
    """
    if re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name, re.ASCII) is None:
        raise InputError(
            f"{name!r} is no name for a study",
            "use letters, digits, '-', '_' and '.', and begin with a letter or digit",
            place=name,
        )
    return name


def _case_name(case: Any) -> Any:
    """Return the name of a case; other processes need it to find the case.

    Raises
    ------
    ValueError
        If it is a case itself.
    """
    if isinstance(case, Case):
        raise InputError(
            f"other processes cannot import the case {case.name!r}",
            "name it by its module, such as 'mycases:CASE'",
        )
    return case


def _plain(value: Any) -> Any:
    """Return arrays and numbers of NumPy, at any depth, as lists and numbers of Python, with a unit as text."""
    value = as_text(value)
    if isinstance(value, Mapping):
        return {name: _plain(each) for name, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return value.tolist() if hasattr(value, "tolist") else value


def _entry(value: Any) -> Range | tuple[Any, ...]:
    """Return the values of one parameter of a table.

    Raises
    ------
    ValueError
        If they are neither a list nor a range.
    """
    value = _plain(value)
    if isinstance(value, Range):
        return value
    if isinstance(value, Mapping):
        return Range(**value)
    if not isinstance(value, list):
        raise InputError(
            f"{value!r} is neither a list nor a range: a single value is given under parameters, a range as "
            "{ start = 0.1, stop = 0.9, count = 9 }"
        )
    if not value:
        raise InputError("the list is empty", "give one value or more")
    return tuple(value)


class Study(Checked):
    """A case, the parameters that it is computed for, and how many samples of each.

    Parameters
    ----------
    name : str
        What the study is called: letters, digits, ``-``, ``_`` and ``.``; folders are named by it.
    case : str
        A case that comes with the package, or ``"module:attribute"`` for a `Case` of the user's.
    seed : int
        Of the random numbers. Sample 7 draws the same ones whatever the parameters are.
    samples : int
        Samples of every combination of parameters.
    parameters : dict
        Parameters that are the same for all cases.
    table : dict
        Parameters with lists of values, or a `Range`; every combination of them is computed.
    rows : sequence of dict
        Combinations spelt out, instead of a table or crossed with it.

    Raises
    ------
    StudyError
        If it makes no sense; the case is asked whether it takes all of the parameters.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed, table={"hurst": [0.6, 0.8]})
    >>> len(study.combinations()), len(list(study.tasks())), len(list(study.with_samples(5).tasks()))
    (2, 4, 10)
    >>> study.write("few.toml")
    >>> rc.study.Study.read("few.toml") == study
    True
    >>> study.to_toml().splitlines()[:2]
    ['name = "few"', 'case = "curve"']
    """

    name: Annotated[str, AfterValidator(_study_name)]
    case: Annotated[str, BeforeValidator(_case_name)]
    seed: Annotated[int, BeforeValidator(_plain), Field(ge=0, strict=True)] = 0
    samples: Annotated[int, BeforeValidator(_plain), Field(ge=1, strict=True)] = 1
    parameters: Annotated[dict[str, Any], BeforeValidator(_plain)] = Field(default_factory=dict)
    table: dict[str, Annotated[Range | tuple[Any, ...], PlainValidator(_entry)]] = Field(default_factory=dict)
    rows: Annotated[tuple[dict[str, Any], ...], BeforeValidator(_plain)] = ()

    @model_validator(mode="after")
    def _sound(self) -> Study:
        self.combinations()
        self.to_toml()
        return self

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Study:
        """Return the study of a TOML file.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Study
            Checked as one that is made in Python.

        Raises
        ------
        StudyError
            If the file cannot be read or makes no sense.
        """
        try:
            return cls(**tomllib.loads(Path(path).read_text(encoding="utf-8")))
        except OSError as error:
            raise StudyError(
                f"{path}: {error.strerror}", "name the file of a study, such as study.toml"
            ) from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise StudyError(f"{path}: it is no TOML file: {error}") from error
        except RecursionError:
            raise StudyError(f"{path}: {TOO_DEEP}") from None
        except StudyError as error:
            raise StudyError(f"{path}: {error.message}", error.remedy, error.place) from None

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the study as a TOML file, which appears whole or not at all.

        Parameters
        ----------
        path : str or path
            File to write; one that is there is replaced.

        Raises
        ------
        WriteError
            If it cannot be written.
        """
        text = self.to_toml()
        with written_aside(path) as aside:
            aside.write_text(text, encoding="utf-8")

    def to_toml(self) -> str:
        """Return the study as text in TOML.

        Returns
        -------
        str
            What `read` takes.
        """
        head = {"name": self.name, "case": self.case, "seed": self.seed, "samples": self.samples}
        table = {
            name: each.model_dump(exclude_defaults=True) if isinstance(each, Range) else each
            for name, each in self.table.items()
        }
        return toml_of(head, {"parameters": self.parameters, "table": table}, {"rows": self.rows})

    def with_samples(self, count: int) -> Study:
        """Return the same study with another number of samples.

        Parameters
        ----------
        count : int
            Number of samples of each combination.

        Returns
        -------
        Study
            The samples that both have are the same.

        Raises
        ------
        StudyError
            If there are too many cases.
        """
        return Study(**(dict(self) | {"samples": count}))

    def combinations(self) -> tuple[Parameters, ...]:
        """Return the parameters of all cases of one sample, row by row, the last name of the table varying fastest.

        Returns
        -------
        tuple of Parameters
            One for each case of a sample.

        Raises
        ------
        StudyError
            If the case does not take them, if two of them are the same, or if there are more than ``MOST_CASES`` cases.
        """
        model = find_case(self.case).parameters
        self._require_names(model)
        values = [self._values(model, name) for name in self.table]
        cases = self.samples * max(len(self.rows), 1) * math.prod(map(len, values))
        if cases > MOST_CASES:
            raise StudyError(
                f"samples, rows and table make {cases:,} cases, and a study has {MOST_CASES:,} at most",
                "take fewer samples or values, or several studies",
                place="samples, rows, table",
            )
        found: dict[str, Parameters] = {}
        for row in self.rows or ({},):
            for chosen in itertools.product(*values):
                given = self.parameters | row | dict(zip(self.table, chosen, strict=True))
                try:
                    parameters = model(**given)
                except StudyError as error:
                    raise StudyError(
                        f"the case {self.case!r} does not take these parameters: {error.message}",
                        error.remedy,
                        error.place,
                    ) from None
                text = canonical(parameters)
                if text in found:
                    raise StudyError(
                        f"a case comes twice: {text}",
                        "take one of them out of the table or the rows",
                        place="table, rows",
                    )
                found[text] = parameters
        return tuple(found.values())

    def tasks(self) -> Iterator[Task]:
        """Yield every case of the study: the first sample of all combinations, then the second of all, and so on.

        Yields
        ------
        Task
            One for each case.
        """
        case = find_case(self.case)
        combinations = [(each, canonical(each)) for each in self.combinations()]
        for sample in range(self.samples):
            for parameters, text in combinations:
                key = key_of(case, text, seed=self.seed, sample=sample)
                yield Task(key, case, parameters, self.seed, sample)

    def _require_names(self, model: type[Parameters]) -> None:
        """Refuse names that the case does not take, and such as are given in two places."""
        in_rows = {name for row in self.rows for name in row}
        places = {"parameters": self.parameters.keys(), "table": self.table.keys(), "rows": in_rows}
        for place, names in places.items():
            for name in sorted(names - model.model_fields.keys()):
                raise StudyError(
                    f"{place}: the case {self.case!r} has no parameter {name!r}: {expected(name, model.model_fields)}",
                    place=f"{place}.{name}",
                )
        for one, other in itertools.combinations(places, 2):
            for name in sorted(places[one] & places[other]):
                raise StudyError(
                    f"{name!r} is given both in {one} and in {other}",
                    "take it out of one of them",
                    place=f"{one}.{name}, {other}.{name}",
                )

    def _values(self, model: type[Parameters], name: str) -> tuple[Any, ...]:
        """Return the values that the table has for a parameter."""
        values = self.table[name]
        if not isinstance(values, Range):
            return values
        field = model.model_fields[name]
        # The type of the parameter turns text with units into numbers.
        reader: TypeAdapter[Any] = TypeAdapter(Annotated[field.annotation, field])  # type: ignore[arg-type]
        try:
            return values.values(_reading(reader.validate_python))
        except InputError as error:
            raise StudyError(f"table: {name}: {error.message}", error.remedy, f"table.{name}") from None


def _reading(read: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return `read` with errors in plain words."""

    def reading(value: Any) -> Any:
        try:
            return read(value)
        except ValidationError as error:
            raise invalid(error) from None

    return reading
