"""What can be wrong with a file: one error that says what to do, one warning that asks to look twice."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["ContentError", "ReadError", "SurfaceWarning"]


@dataclass(eq=False, repr=False)
class ContentError(ValueError):
    """Bytes that a reader cannot turn into heights; `content` makes a `ReadError` of it, which names the file."""

    problem: str
    remedy: str


@dataclass(eq=False, repr=False)
class ReadError(ValueError):
    """A file that cannot be turned into a surface, or into a curve.

    Parameters
    ----------
    file : str
        Name of the file.
    problem : str
        What is wrong, with the value that is wrong.
    remedy : str
        What the reader of the message can do about it.
    """

    file: str
    problem: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.file}: {self.problem}; {self.remedy}"


class SurfaceWarning(UserWarning):
    """A file was read, but something about it deserves a second look."""
