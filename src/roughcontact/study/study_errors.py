"""What can be wrong with a study and with its store, in words that say what to do."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError
from roughcontact.files.aside import WriteError

if TYPE_CHECKING:
    from pydantic import ValidationError

__all__ = [
    *(
        "SAFE",
        "StoreError",
        "StudyError",
        "computed_again",
        "disk_trouble",
        "expected",
        "invalid",
        "on_disk",
    ),
]

SAFE = "what was stored before is safe"
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
    parameters: the case 'curve' has no parameter 'hurts': did you mean 'hurst'?
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


def expected(name: str, known: Iterable[str]) -> str:
    """Return what a misspelt `name` may have meant, and all that is known."""
    known = sorted(known)
    near = get_close_matches(name, known, n=1)
    return (f"did you mean {near[0]!r}? " if near else "") + f"It may be {', '.join(known)}"


def invalid(error: ValidationError, known: Iterable[str] = ()) -> StudyError:
    """Return the error about all that is wrong with the values of a model, which has fields of the `known` names."""
    found = [_invalid(each, known) for each in error.errors(include_url=False)]
    if len(found) == 1:
        return found[0]
    return StudyError("; ".join(map(str, found)), place=", ".join(each.place for each in found if each.place))


def _invalid(found: Mapping[str, Any], known: Iterable[str]) -> StudyError:
    place = ".".join(str(part) for part in found["loc"])
    if found["type"] == "extra_forbidden":
        return StudyError(f"there is no {place!r}: {expected(place, known)}", place=place)
    if found["type"] == "missing":
        return StudyError(f"{place!r} is missing", place=place)
    own = found.get("ctx", {}).get("error")  # of a validator, with words of its own
    if isinstance(own, InputError):
        words, remedy = own.message, own.remedy
    else:
        words = f"{found['input']!r} {found['msg'].removeprefix('Input ').removeprefix('Value ')}"
        remedy = None
    return StudyError(f"{place}: {words}" if place else words, remedy, place or getattr(own, "place", None))
