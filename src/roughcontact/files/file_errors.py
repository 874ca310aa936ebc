"""What can be wrong with a file: one error that says what to do, one warning that asks to look twice."""

from __future__ import annotations

__all__ = ["ReadError", "SurfaceWarning"]


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

    def __init__(self, file: str, problem: str, remedy: str) -> None:
        super().__init__(file, problem, remedy)  # all three in `args`, so that the error can be pickled
        self.file = file
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.file}: {self.problem}; {self.remedy}"


class SurfaceWarning(UserWarning):
    """A file was read, but something about it deserves a second look."""
