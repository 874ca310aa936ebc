"""Texts that are recognised by their first lines: grids of maps and exports of instruments."""

from __future__ import annotations

import re
from collections.abc import Callable

from roughcontact.files.esri_grid import read_esri
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap
from roughcontact.files.keyence import read_keyence
from roughcontact.files.profilm import read_profilm
from roughcontact.files.surfer_grid import read_surfer
from roughcontact.files.wyko_text import read_wyko

__all__ = ["DIALECTS", "dialect_of"]

# Pattern at the beginning of a text, for Keyence near it, and the reader.
DIALECTS: dict[str, Callable[[str], HeightMap]] = {
    r"\s*(ncols|nrows)[ \t]+\d+[ \t]*\n": read_esri,
    r"\s*DSAA\s": read_surfer,
    r"[^\n]*\n(?:[^\n]*\n){0,8}?[^\n]*\bImageDataCsv\b": read_keyence,
    r'\s*"?numCols\b': read_profilm,
    r"\s*Wyko ASCII Data File Format": read_wyko,
}
_NOT_READ = {
    r"\s*Zygo ASCII Data File": "a MetroPro text of Zygo",
    r"/0/data\b": "a dump of Gwyddion",
}


def dialect_of(text: str) -> Callable[[str], HeightMap] | None:
    """Return the reader of a text that is recognised by its first lines; refuse texts that are not supported."""
    for begins, name in _NOT_READ.items():
        if re.match(begins, text):
            raise ContentError(
                f"it is {name}, which is not read", "export the heights as rows of numbers, or as X3P"
            )
    return next((read for begins, read in DIALECTS.items() if re.match(begins, text, re.IGNORECASE)), None)
