"""Errors of a study and of its store, with remedies."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError, every, in_place, together
from roughcontact.files.aside import WriteError
from roughcontact.recipe.texts import choose

if TYPE_CHECKING:
    from pydantic import ValidationError

__all__ = [
    *(
        "MOST_MISTAKES",
        "SAFE",
        "StoreError",
        "StudyError",
        "computed_again",
        "disk_trouble",
        "mistakes_of",
        "on_disk",
        "refusal",
    ),
]

SAFE = "stored cases are safe"
MOST_MISTAKES = 20  # in one message
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class StudyError(InputError):
    """An invalid study; the message names the value and the remedy.

    Examples
    --------
    >>> import roughcontact as rc
    >>> try:
    ...     rc.study.Study(name="few", case="curve", parameters={"hurts": 0.8})
    ... except rc.study.StudyError as error:
    ...     print(str(error).partition("?")[0] + "?")
    parameters.hurts: the case 'curve' has no parameter 'hurts': did you mean 'hurst'?
    """


class StoreError(InputError):
    """A folder of results that cannot be used; its contents are not lost.

    Parameters
    ----------
    folder : str or path
    problem : str
        What is wrong.
    remedy : str
        What the user can do about it.

    Examples
    --------
    >>> import roughcontact as rc
    >>> try:
    ...     rc.study.Store.open("nowhere")
    ... except rc.study.StoreError as error:
    ...     print(error.problem, "-", error.remedy)
    there is no study.toml in it - name the folder of the results of a study; if 'study run' has just started, wait
    """

    def __init__(self, folder: str | os.PathLike[str], problem: str, remedy: str) -> None:
        super().__init__(f"{os.fspath(folder)}: {problem}", remedy, "folder")
        self.args = os.fspath(folder), problem, remedy  # the arguments for unpickling
        self.folder = os.fspath(folder)
        self.problem = problem


def computed_again(key: str) -> str:
    """Return the command after which the case of a key is computed again."""
    return f"to compute it again, first run: sqlite3 cases.sqlite \"DELETE FROM cases WHERE key = '{key}'\""


def disk_trouble(folder: str | os.PathLike[str], what: str, error: BaseException | None) -> StoreError:
    """Return the error to raise where `what` could not be written because of an error of the operating system."""
    if isinstance(error, OSError) and error.errno in _NO_ROOM:
        return StoreError(folder, f"{what}: the disk is full", f"make room and run again; {SAFE}")
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error) or type(error).__name__
    return StoreError(
        folder, f"{what}: {reason}", f"change its permissions, or copy it elsewhere and resume there; {SAFE}"
    )


@contextmanager
def on_disk(folder: str | os.PathLike[str], what: str) -> Iterator[None]:
    """Turn an error of the disk within into a `StoreError` with the problem `what`."""
    try:
        yield
    except OSError as error:
        raise disk_trouble(folder, what, error) from error
    except WriteError as error:
        raise disk_trouble(folder, what, error.__cause__ or error) from error


def refusal(found: Sequence[InputError]) -> StudyError:
    """Return the error about all mistakes of a study, each with its place; at most the first `MOST_MISTAKES`."""
    shown = list(found[:MOST_MISTAKES])
    if len(found) > len(shown):
        shown.append(StudyError("there are more errors", "correct these first"))
    if len(shown) == 1:
        [one] = shown
        text = in_place(InputError(one.message, None, one.place))
        error = StudyError(text, one.remedy, one.place)
    else:
        whole = together(shown)
        error = StudyError(whole.message, None, whole.place)
    error.parts = tuple(found)
    return error


def mistakes_of(error: ValidationError, known: Iterable[str] = ()) -> list[InputError]:
    """Return all errors in the values of a model with fields of the `known` names."""
    return [each for found in error.errors(include_url=False) for each in _mistakes(found, known)]


def _mistakes(found: Mapping[str, Any], known: Iterable[str]) -> Iterator[InputError]:
    loc = [str(part) for part in found["loc"]]
    place = ".".join(loc)
    own = found.get("ctx", {}).get("error")  # of a validator, which has its own message
    if isinstance(own, InputError):
        for each in every(own):
            where = ".".join([*loc, *([each.place] if each.place else [])])
            yield InputError(each.message, each.remedy, where or None)
    elif found["type"] == "extra_forbidden":
        yield InputError(f"there is no {place!r}: {choose(place, sorted(known))}", None, place)
    elif found["type"] == "missing":
        yield InputError(f"{place!r} is missing", f"give {loc[-1]}", place)
    else:
        words = found["msg"].removeprefix("Input ").removeprefix("Value ")
        yield InputError(f"{found['input']!r} {words}", None, place or None)
