"""What can be wrong with a study and with its store, in words that say what to do."""

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

SAFE = "what was stored before is safe"
MOST_MISTAKES = 20  # in one message
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class StudyError(InputError):
    """A study that makes no sense; the message names the value and the remedy.

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
    """A folder of results that cannot be used as it is; nothing in it is lost.

    Parameters
    ----------
    folder : str or path
    problem : str
        What is wrong.
    remedy : str
        What the reader of the message can do about it.

    Examples
    --------
    >>> import roughcontact as rc
    >>> try:
    ...     rc.study.Store.open("nowhere")
    ... except rc.study.StoreError as error:
    ...     print(error.problem, "-", error.remedy)
    there is no study.toml in it - name the folder that a study was run in
    """

    def __init__(self, folder: str | os.PathLike[str], problem: str, remedy: str) -> None:
        super().__init__(f"{os.fspath(folder)}: {problem}", remedy, "folder")
        self.args = os.fspath(folder), problem, remedy  # with which it is made again from a pickle
        self.folder = os.fspath(folder)
        self.problem = problem


def computed_again(key: str) -> str:
    """Return how to have the case of that key computed again."""
    return f"to have it computed again, run: sqlite3 cases.sqlite \"DELETE FROM cases WHERE key = '{key}'\""


def disk_trouble(folder: str | os.PathLike[str], what: str, error: BaseException | None) -> StoreError:
    """Return the error to raise where `what` could not be written because of an error of the operating system."""
    if isinstance(error, OSError) and error.errno in _NO_ROOM:
        return StoreError(folder, f"{what}: the disk is full", f"make room and run again; {SAFE}")
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error) or type(error).__name__
    return StoreError(
        folder, f"{what}: {reason}", f"change its permissions, or copy it elsewhere and go on there; {SAFE}"
    )


@contextmanager
def on_disk(folder: str | os.PathLike[str], what: str) -> Iterator[None]:
    """Make a `StoreError` that says `what` was not done of whatever the disk does not do within."""
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
        shown.append(StudyError("more mistakes like these follow", "correct these first"))
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
    """Return all that is wrong with the values of a model, which has fields of the `known` names."""
    return [each for found in error.errors(include_url=False) for each in _mistakes(found, known)]


def _mistakes(found: Mapping[str, Any], known: Iterable[str]) -> Iterator[InputError]:
    loc = [str(part) for part in found["loc"]]
    place = ".".join(loc)
    own = found.get("ctx", {}).get("error")  # of a validator, with words of its own
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
