"""Surfaces that a command writes: refused before the work, written whole, with a word on what the format leaves out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.messages import UsageError, note, remark

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["require_output", "save_surface"]

_LEFT_OUT = {
    ".x3p": "keeps neither the history nor whether the surface repeats itself",
    ".txt": "keeps the history for people only, and not whether the surface repeats itself",
    ".npy": "keeps no history, and neither the unit (m) nor the size",
    ".vti": "is for ParaView: it keeps no history and is not read back",
}


def require_output(out: Path, source: Path | None = None, *, in_slabs: bool = False) -> None:
    """Refuse what cannot be written before any work, and what must not be overwritten."""
    from roughcontact.files.save import require_surface_file

    require_surface_file(out, in_slabs=in_slabs)
    if source is not None and out.exists() and source.exists() and out.samefile(source):
        raise UsageError(f"{out} is the measured file itself", "name another file to write")


def save_surface(surface: Surface, out: Path) -> None:
    """Write a surface in the format of its ending."""
    import roughcontact as rc

    if out.exists():
        remark(f"{out} was there before and is replaced")
    rc.write(surface, out)
    kind = out.suffix.casefold()
    if kind in _LEFT_OUT:
        note(f"a file {kind} {_LEFT_OUT[kind]}; .npz and .nc keep everything")
