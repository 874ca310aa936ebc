"""The option that says in which format pictures are written."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path

from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import option

__all__ = ["FORMAT", "PictureFormat", "picture_ending"]

PictureFormat = StrEnum("PictureFormat", ["PNG", "PDF", "SVG"])

FORMAT = option("With --out: format of the pictures (default: png).", rich_help_panel="Answer")


def picture_ending(given: PictureFormat | None, out: Path | None) -> str:
    """Return how the names of pictures end.

    Raises
    ------
    UsageError
        If a format is given and no folder for pictures.
    """
    if given is not None and out is None:
        raise UsageError("--format is that of pictures", "say where by --out", place="--format")
    return (given or PictureFormat.PNG).value
