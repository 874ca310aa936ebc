"""A request of a page to its worker."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from roughcontact.errors import InputError
from roughcontact.files.fingerprint import fingerprint
from roughcontact.page.forms import WITHOUT_FORM
from roughcontact.page.jobs.reduced import as_seen, factor_for
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.recipe.command import command_of
from roughcontact.recipe.job_calls import python_of
from roughcontact.recipe.jobs import JobOfHeights, calls_of
from roughcontact.recipe.source import File
from roughcontact.recipe.written import from_plain, to_plain, with_files
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.grid import AnyGrid

__all__ = ["PageJob", "PageRequest", "Send", "send_map", "sides"]

_PART_OF_COLOURS = 0.8  # least share of the colours for nearly all heights; otherwise the scale is clipped
_BAND = 0.12  # height of the band of a profile, over its length


class Send(Protocol):
    """Sends a message on its way."""

    def __call__(self, header: Mapping[str, Any], data: bytes = b"") -> None:
        """Send a header of plain values, and bytes."""
        ...


@dataclass(frozen=True, slots=True)
class PageRequest:
    """The job of a request, with its files.

    Parameters
    ----------
    job : Job
        With the paths of its files on the server.
    shown : Job
        The same job, with the user's names of its files.
    beside : PageRequest or None
        The second answer of an archive that holds two.
    more : mapping
        Further values that the worker needs.
    """

    job: JobOfHeights
    shown: JobOfHeights
    beside: PageRequest | None
    more: Mapping[str, Any]

    @classmethod
    def of(cls, plain: Any, files: Mapping[str, UploadedFile], more: Mapping[str, Any]) -> PageRequest:
        """Return the request of a job in plain values, whose files have the server's names.

        Raises
        ------
        InputError
            If the values are not a job, or the server has no such file.
        """

        def known(file: File) -> UploadedFile:
            if file.file not in files:
                raise InputError("the server no longer has this file", "drop it again", "file")
            return files[file.file]

        job = from_plain(plain)
        if isinstance(job, WITHOUT_FORM):
            raise InputError(
                f"the page does not show the job {job.NAME!r}",
                "use the command roughcontact run",
                "job",
            )
        beside = None if more.get("beside") is None else cls.of(more["beside"], files, {})
        return cls(
            with_files(job, lambda file: replace(file, file=str(known(file).path))),
            with_files(job, lambda file: replace(file, file=known(file).name)),
            beside,
            more,
        )

    @property
    def statement(self) -> dict[str, str]:
        """The job as commands for a shell, one a line, and as a program in Python."""
        recipe = f"{self.job.NAME.replace(' ', '-')}-job.toml"
        return {"command": command_of(self.shown, recipe), "python": python_of(calls_of(self.shown))}

    @property
    def recipe(self) -> dict[str, Any]:
        """The job as stored in a file: with the user's names of its files, and their fingerprints."""
        found: list[str] = []

        def kept(file: File) -> File:
            found.append(fingerprint(Path(file.file)))
            return file

        with_files(self.job, kept)
        return to_plain(with_files(self.shown, lambda file: replace(file, sha256=found.pop(0))))

    def whole(self, name: str, usual: int, most: int) -> int:
        """Return a whole number that the page states, between 1 and `most`."""
        given = self.more.get(name, usual)
        return min(max(given, 1), most) if isinstance(given, int) else usual


PageJob = Callable[[PageRequest, SessionCache, Send], None]


def sides(grid: AnyGrid) -> tuple[float, ...]:
    """Return the sides of the map of a grid [m]: that of a profile is a band."""
    lengths = tuple(grid.lengths)
    return lengths if len(lengths) == 2 else (_BAND * lengths[0], *lengths)


def send_map(
    send: Send, name: str, field: Array, grid: AnyGrid, most: int, unit: str, *, lowest: bool = False
) -> None:
    """Send a map in single precision, no side longer than `most`, its highest values kept, or its `lowest`."""
    import numpy as np

    from roughcontact.plot.drawing.usual_range import usual_range

    field = np.atleast_2d(field)
    factor = factor_for(field.shape, most)
    seen = np.ascontiguousarray(as_seen(field, factor, lowest=lowest), dtype="<f4")
    known = seen[~np.isnan(seen)]
    ends = [float(known.min()), float(known.max())] if known.size else [0.0, 0.0]
    colours = (usual_range(known, _PART_OF_COLOURS) if known.size else None) or ends
    header = {
        "type": "map",
        "map": name,
        "shape": seen.shape,
        "cells": field.shape,
        "factor": factor,
        "ends": ends,
        "colours": colours,
        "lengths": sides(grid),
        "unit": unit,
    }
    send(header, seen.tobytes())
