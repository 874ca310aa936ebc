"""The options that several commands share: folder and form of an answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from roughcontact.cli.cited import cited
from roughcontact.cli.messages import UsageError, remark
from roughcontact.cli.option_groups import argument, option
from roughcontact.recipe.texts import Choice

__all__ = ["CITE", "FORMAT", "JSON", "OUT", "OUTPUT", "PICTURES", "Answer", "picture_ending"]

_ANSWER = "Answer"
PICTURES = ("png", "pdf", "svg")
FORMAT = option(
    "With --out: format of the pictures (default: png).",
    read=Choice(PICTURES),
    everyday=False,
    rich_help_panel=_ANSWER,
)
OUTPUT = argument(
    "File to write: .npz, .nc, .x3p, .txt, .npy, or .vti for ParaView. - is standard output, as .npz; nc:- as .nc.",
    "OUT",
)
OUT = option("Folder for files and pictures.", "DIR", rich_help_panel=_ANSWER)
CITE = option(
    "Print the references for the answer; with --out also write them as BibTeX (references.bib).",
    default=False,
    everyday=False,
    rich_help_panel=_ANSWER,
)
JSON = option("One JSON object on standard output, in SI units.", default=False, rich_help_panel=_ANSWER)


@dataclass(frozen=True, slots=True)
class Answer:
    """Where an answer goes."""

    PANEL: ClassVar = _ANSWER
    out: Path | None = OUT
    format: str | None = FORMAT
    json: bool = JSON
    cite: bool = CITE
    is_kept: bool = True  # not an option: a repeated result is only compared

    def __post_init__(self) -> None:
        picture_ending(self.format, self.out)

    def finish(self, folder: Path | None, names: Sequence[str], *found: Any) -> None:
        """Print the references, if asked for; print which files a folder that is kept holds now."""
        if self.cite:
            names = (*names, *cited(folder, *found, as_json=self.json))
        if folder is not None and self.is_kept:
            remark(f"{', '.join(names[:-1])} and {names[-1]} are in {folder}")

    @property
    def ending(self) -> str:
        """The format of pictures."""
        return picture_ending(self.format, self.out)

    @property
    def file(self) -> Path | None:
        """The file of a surface."""
        return None if self.out is None else self.out / "surface.npz"


def picture_ending(given: str | None, out: Path | None) -> str:
    """Return the format of pictures.

    Raises
    ------
    UsageError
        If a format is given without a folder for pictures.
    """
    if given is not None and out is None:
        raise UsageError("--format is that of pictures", "say where by --out", place="--format")
    return given or PICTURES[0]
