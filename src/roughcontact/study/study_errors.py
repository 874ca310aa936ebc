"""What can be wrong with a study and with its store, in words that say what to do."""

from __future__ import annotations

import errno
import os

__all__ = ["SAFE", "StoreError", "StudyError", "computed_again", "disk_trouble"]

SAFE = "what was stored before is safe"
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class StudyError(ValueError):
    """A study that makes no sense; the message names the value and the remedy."""


class StoreError(ValueError):
    """A folder of results that cannot be used as it is; nothing in it is lost.

    Parameters
    ----------
    folder : str or path
    problem : str
        What is wrong.
    remedy : str
        What the reader of the message can do about it.
    """

    def __init__(self, folder: str | os.PathLike[str], problem: str, remedy: str) -> None:
        super().__init__(os.fspath(folder), problem, remedy)  # all three in `args`, so that it can be pickled
        self.folder = os.fspath(folder)
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.folder}: {self.problem}; {self.remedy}"


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
