"""Surfaces that a command writes: checked before the work, written whole, with a note on what the format loses."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.messages import UsageError, note, remark
from roughcontact.cli.verbosity import is_quiet
from roughcontact.files.standard_streams import kind_of, standard

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["answer_beside", "require_output", "save_surface"]

_LEFT_OUT = {
    ".x3p": "keeps neither the history nor whether the surface repeats itself",
    ".txt": "keeps the history as text only, and not whether the surface repeats itself",
    ".npy": "keeps neither the history nor the unit (m) nor the size",
    ".vti": "is for ParaView: it keeps no history and is not read back",
}


def require_output(
    out: Path, source: Path | None = None, *, in_slabs: bool = False, as_json: bool = False
) -> None:
    """Raise an error, before the work, for a file that cannot be written or must not be overwritten."""
    from roughcontact.files.save import require_surface_file

    require_surface_file(out, in_slabs=in_slabs)
    if standard(out) is not None:
        if as_json:
            raise UsageError(
                "--json and the surface would both go to standard output",
                "leave it out, or name a file",
                "--json",
            )
        if sys.stdout.isatty():
            raise UsageError(
                "standard output is a terminal", "pipe the surface into another command, or name a file"
            )
    elif source is not None and out.exists() and source.exists() and out.samefile(source):
        raise UsageError(f"{out} is the measured file itself", "name another file to write")


def save_surface(surface: Surface, out: Path) -> None:
    """Write a surface in the format of its ending, or to standard output."""
    import roughcontact as rc

    if out.exists() and standard(out) is None:
        remark(f"{out} exists and is replaced")
    rc.write(surface, out)
    kind = kind_of(out)
    if kind in _LEFT_OUT:
        note(f"a file {kind} {_LEFT_OUT[kind]}; .npz and .nc keep everything")


@contextmanager
def answer_beside(out: Path | None) -> Iterator[None]:
    """Print an answer, on standard error if the surface goes to standard output; then not with --quiet."""
    if out is None or standard(out) is None:
        yield
        return
    with redirect_stdout(StringIO() if is_quiet() else sys.stderr):
        yield
