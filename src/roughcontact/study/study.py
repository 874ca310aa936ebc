"""A study: a case, its parameters, and the number of samples of each combination."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import tomli_w
from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    ModelWrapValidatorHandler,
    PlainValidator,
    ValidationError,
    model_validator,
)

from roughcontact.errors import InputError
from roughcontact.files.aside import written_aside
from roughcontact.files.fingerprint import fingerprint
from roughcontact.study.case import Case, Parameters
from roughcontact.study.cases import find_case
from roughcontact.study.checked import TOO_DEEP, Checked
from roughcontact.study.combinations import combined, reads_files
from roughcontact.study.nested_names import flat
from roughcontact.study.ranges import Range
from roughcontact.study.study_errors import StudyError, mistakes_of, refusal
from roughcontact.study.task import Task, canonical, key_of
from roughcontact.units import as_text

__all__ = ["Study"]


def _study_name(name: str) -> str:
    """Return the name of a study, which must be valid as the name of a folder on every system.

    Raises
    ------
    ValueError
        If it is not.
    """
    if re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name, re.ASCII) is None:
        raise InputError(
            f"{name!r} is not a valid name of a study",
            "use letters, digits, '-', '_' and '.', and begin with a letter or digit",
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
    value = value.tolist() if hasattr(value, "tolist") else value
    if not isinstance(value, (bool, int, float, str, list)):
        raise InputError(
            f"{value!r} cannot be written to a study file",
            "give numbers, text, truth values or lists of them",
        )
    return value


def _by_name(table: Any) -> Any:
    """Return a table with dotted names in place of nested tables, as TOML reads ``preparation.level = [...]``."""
    return flat(table) if isinstance(table, Mapping) else table


def _entry(value: Any) -> Range | tuple[Any, ...]:
    """Return the values of one parameter of a table.

    Raises
    ------
    ValueError
        If they are neither a list nor a range.
    """
    if isinstance(value, Range):
        return value
    value = _plain(value)
    if isinstance(value, Mapping):
        return Range(**value)
    if not isinstance(value, list):
        raise InputError(
            f"{value!r} is neither a list nor a range",
            "write a single value under parameters, and a range as { start = 0.1, stop = 0.9, count = 9 }",
        )
    if not value:
        raise InputError("the list is empty", "give one value or more")
    return tuple(value)


class Study(Checked):
    """A case, its parameters, and the number of samples of each combination.

    Parameters
    ----------
    name : str
        Name of the study: letters, digits, ``-``, ``_`` and ``.``; folders are named after it.
    case : str
        A case of the package, or ``"module:attribute"`` for a `Case` of the user.
    seed : int
        Seed of the random numbers. The numbers of a sample do not depend on the parameters.
    samples : int
        Number of samples of every combination of parameters.
    parameters : dict
        Parameters that are the same for all cases.
    table : dict
        Parameters with lists of values, or a `Range`; all combinations of them are computed.
    rows : sequence of dict
        Explicit combinations, in place of a table or combined with it. In rows and table, a dotted name such as
        ``"preparation.level"`` is a parameter in a nested table.
    folder : str
        File names are relative to this folder, which is itself relative to the study file. By default the folder of
        the study file, in Python the current folder.
    files : dict of str to str
        SHA-256 of the files that the parameters name. Running a study fills it in; a changed file raises an error
        later.

    Raises
    ------
    StudyError
        If it is invalid: all errors, each with its place. The model of the case checks the parameters.

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
    table: Annotated[
        dict[str, Annotated[Range | tuple[Any, ...], PlainValidator(_entry)]], BeforeValidator(_by_name)
    ] = Field(default_factory=dict)
    rows: Annotated[tuple[dict[str, Any], ...], BeforeValidator(_plain)] = ()
    folder: str = ""
    files: dict[str, str] = Field(default_factory=dict)

    @model_validator(mode="wrap")
    @classmethod
    def _sound(cls, values: Any, handler: ModelWrapValidatorHandler[Study]) -> Study:
        found: list[InputError] = []
        try:
            study = handler(values)
        except ValidationError as error:
            found = mistakes_of(error, cls.model_fields)
            try:
                study = handler(_others(values, found))
            except ValidationError:
                raise refusal(found) from None
        known = {_name(each) for each in found}
        found += [each for each in combined(study)[1] if _name(each) not in known]
        if found:
            raise refusal(found)
        return study

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
            The study, checked like one that is made in Python.

        Raises
        ------
        StudyError
            If the file cannot be read or is invalid.
        """
        try:
            values = tomllib.loads(Path(path).read_text(encoding="utf-8"))
            if "job" in values and "case" not in values:
                raise StudyError(
                    "this is a job, not a study",
                    f"run it by 'roughcontact run {path}', or vary it by 'roughcontact study from {path}'",
                )
            if reads_files(str(values.get("case"))):
                values["folder"] = os.path.normpath(Path(path).parent / str(values.get("folder", "")))
            return cls(**values)
        except OSError as error:
            raise StudyError(
                f"{path}: {error.strerror}", "name the file of a study, such as study.toml"
            ) from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise StudyError(f"{path}: it is not a valid TOML file: {error}") from error
        except RecursionError:
            raise StudyError(f"{path}: {TOO_DEEP}") from None
        except StudyError as error:
            raise StudyError(f"{path}: {error.message}", error.remedy, error.place) from None

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the study as a TOML file, which appears whole or not at all.

        Parameters
        ----------
        path : str or path
            File to write; an existing file is replaced.

        Raises
        ------
        WriteError
            If it cannot be written.
        """
        from_there = os.path.relpath(self.folder or ".", Path(path).parent) if reads_files(self.case) else ""
        text = self.model_copy(update={"folder": from_there if from_there != "." else ""}).to_toml()
        with written_aside(path) as aside:
            aside.write_text(text, encoding="utf-8")

    def to_toml(self) -> str:
        """Return the study as text in TOML.

        Returns
        -------
        str
            The contents of a file for `read`.
        """
        written = dict(self) | {
            "table": {
                name: each.model_dump(exclude_defaults=True) if isinstance(each, Range) else each
                for name, each in self.table.items()
            }
        }
        return tomli_w.dumps({name: each for name, each in written.items() if each not in ({}, (), "")})

    def with_samples(self, count: int) -> Study:
        """Return the same study with another number of samples.

        Parameters
        ----------
        count : int
            Number of samples of each combination.

        Returns
        -------
        Study
            The common samples of both studies are the same.

        Raises
        ------
        StudyError
            If there are too many cases.
        """
        return Study(**(dict(self) | {"samples": count}))

    def pinned(self) -> Study:
        """Return the same study with the SHA-256 of the files that its parameters name.

        Returns
        -------
        Study
            The study itself if they name no files.

        Raises
        ------
        StudyError
            If the case does not take the parameters, or a file cannot be read.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.write(rc.examples.surface("ground"), "part.npz")
        >>> job = {"job": "press", "source": {"file": "part.npz"}, "bodies": {"modulus": "110 GPa"}}
        >>> study = rc.study.Study(name="few", case="job", parameters=job, table={"load.force": [1, 2]}).pinned()
        >>> [(name, len(digest)) for name, digest in study.files.items()]
        [('part.npz', 64)]
        """
        files = {name: each for case in self.combinations() for name, each in case.inputs().items()}
        return self if files == self.files else Study(**(dict(self) | {"files": files}))

    def require_files(self) -> None:
        """Check that no file has changed, by the fingerprints in `files`.

        Raises
        ------
        StudyError
            If a file has changed, or cannot be read.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.write(rc.examples.surface("ground"), "part.npz")
        >>> job = {"job": "press", "source": {"file": "part.npz"}, "bodies": {"modulus": "110 GPa"}}
        >>> study = rc.study.Study(name="few", case="job", parameters=job, table={"load.force": [1, 2]}).pinned()
        >>> rc.write(rc.examples.surface("blasted"), "part.npz")
        >>> try:
        ...     study.require_files()
        ... except rc.study.StudyError as error:
        ...     print(error.message)
        part.npz is not the file that the study was begun with: its SHA-256 differs
        """
        for name, digest in self.files.items():
            if fingerprint(Path(self.folder, name)) != digest:
                raise StudyError(
                    f"{name} is not the file that the study was begun with: its SHA-256 differs",
                    "put that file back, or remove its line from [files] and choose another folder",
                    f"files.{name}",
                )

    def combinations(self) -> tuple[Parameters, ...]:
        """Return the parameters of all cases of one sample, row by row, the last name of the table varying fastest.

        Returns
        -------
        tuple of Parameters
            One for each case of a sample.

        Raises
        ------
        StudyError
            If they are invalid, if two combinations are the same, or if there are more than ``MOST_CASES`` cases.
        """
        found, mistakes = combined(self)
        if mistakes:
            raise refusal(mistakes)
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


def _others(values: Any, found: Sequence[InputError]) -> Any:
    """Return the values of a study without invalid ones, so that further errors are found."""
    if not isinstance(values, Mapping):
        return values
    wrong = {each.place for each in found}
    left = {name: values[name] for name in ("case", "parameters", "rows") if name in values}
    if isinstance(table := values.get("table", {}), Mapping):
        left["table"] = {name: each for name, each in flat(table).items() if f"table.{name}" not in wrong}
    return left | {"name": "study"}


def _name(error: InputError) -> str:
    """Return the parameter of an error, without the name of its table."""
    return (error.place or "").partition(".")[2]
