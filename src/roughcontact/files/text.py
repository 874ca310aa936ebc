"""Heights as a matrix in a text, with or without the header that Gwyddion writes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from roughcontact.files.errors import ReadError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.numbers import parse_table
from roughcontact.files.units import parse_length

__all__ = ["read_text"]

# The words of Gwyddion's header in the languages of its menus that Western files come in.
_LABELS = {
    "channel": re.compile(r"channel|kanal|canal|canale"),
    "width": re.compile(r"width|breite|largeur|anchura|larghezza|largura"),
    "height": re.compile(r"height|höhe|hauteur|altura|altezza"),
    "unit": re.compile(
        r"value units?|einheit(en)?( der werte)?|werteeinheit(en)?|unités|unità valore|unidades de valor"
    ),
}
_COORDINATES = 8  # rows from which two or three bare columns are taken for coordinates


@dataclass(frozen=True, slots=True)
class _Header:
    """What the comment lines state: size in metres, unit of the heights."""

    channel: str | None = None
    width: float | None = None
    height: float | None = None
    unit: str | None = None


def read_text(data: bytes, file: str) -> HeightMap:
    """Return a matrix of heights; without a header it states neither unit nor size."""
    table = parse_table(data, file)
    header = _header(table.comments)
    ny, nx = table.values.shape
    if nx in (2, 3) and ny >= _COORDINATES and header == _Header():
        raise ReadError(
            file,
            f"its {ny} rows of {nx} columns look like a list of coordinates, not a map",
            "name a list of x, y, z .xyz; read a line scan by read_line",
        )
    spacing = None
    if header.width is not None and header.height is not None:
        spacing = (header.height / ny, header.width / nx)
    return HeightMap(
        as_heights(table.values, file),
        "text" if header == _Header() else "Gwyddion text",
        channel=header.channel,
        unit=header.unit,
        spacing=spacing,
    )


def _header(comments: Iterable[str]) -> _Header:
    """Return what lines such as ``Width: 10 µm`` state; a size in pixels states nothing."""
    stated: dict[str, str] = {}
    for comment in comments:
        label, _, value = comment.partition(":")
        for key, words in _LABELS.items():
            if words.fullmatch(label.strip().casefold()) and value.strip():
                stated.setdefault(key, value.strip())
    return _Header(
        stated.get("channel"), _length(stated.get("width")), _length(stated.get("height")), stated.get("unit")
    )


def _length(text: str | None) -> float | None:
    try:
        return None if text is None else parse_length(text.replace(",", "."))
    except ValueError:
        return None
