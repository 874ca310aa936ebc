"""Heights as a matrix in a text, with or without the header that Gwyddion writes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import parse_length
from roughcontact.files.numbers import last_digit, parse_table, stated_rows
from roughcontact.surface.surface import Surface

__all__ = ["read_text", "text_bytes"]

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
    """What the comment lines state: size in metres, its rounding (relative), unit of the heights."""

    channel: str | None = None
    width: float | None = None
    height: float | None = None
    rounding: float = 0.0
    unit: str | None = None


def read_text(data: bytes) -> HeightMap:
    """Return a matrix of heights; without a header it states neither unit nor size."""
    table = parse_table(data)
    header = _header(table.comments)
    ny, nx = table.values.shape
    if nx in (2, 3) and ny >= _COORDINATES and header == _Header():
        raise ContentError(
            f"its {ny} rows of {nx} columns look like a list of coordinates, not a map",
            "name a list of x, y, z .xyz; read a profile by read_line",
        )
    spacing = None
    if header.width is not None and header.height is not None:
        spacing = (header.height / ny, header.width / nx)
    return HeightMap(
        as_heights(table.values),
        "text" if header == _Header() else "Gwyddion text",
        channel=header.channel,
        unit=header.unit,
        spacing=spacing,
        doubts=(*table.doubts, *(() if stated_rows(table.comments) else _rows_missing(header, (ny, nx)))),
    )


def _rows_missing(header: _Header, shape: tuple[int, int]) -> tuple[str, ...]:
    """Return a doubt where the height in the header has room for more rows of square cells than there are."""
    if header.width is None or header.height is None:
        return ()
    ny, nx = shape
    expected = header.height / (header.width / nx)
    if not expected * (1 - header.rounding) > ny + 0.5:
        return ()
    return (
        f"its height has room for {expected:.0f} rows of square cells, and {ny} are there: it may be cut short",
    )


def _header(comments: Iterable[str]) -> _Header:
    """Return what lines such as ``Width: 10 µm`` state; a size in pixels states nothing."""
    stated: dict[str, str] = {}
    for comment in comments:
        label, _, value = comment.partition(":")
        for key, words in _LABELS.items():
            if words.fullmatch(label.strip().casefold()) and value.strip():
                stated.setdefault(key, value.strip())
    width, height = (_length(stated.get(name)) for name in ("width", "height"))
    rounding = sum(_rounding(stated[name]) for name in ("width", "height") if name in stated)
    return _Header(stated.get("channel"), width, height, rounding, stated.get("unit"))


def _length(text: str | None) -> float | None:
    try:
        return None if text is None else parse_length(text.replace(",", "."))
    except ValueError:
        return None


def _rounding(text: str) -> float:
    """Return by how much of itself a printed number may have been rounded."""
    number = re.match(r"\d+\.?\d*(?:[eE][-+]?\d+)?", text.replace(",", "."))
    if number is None or float(number[0]) == 0:
        return 0.0
    return 0.5 * last_digit(number[0]) / float(number[0])


def text_bytes(surface: Surface) -> bytes:
    """Return the heights [m] as rows separated by tabs, under the header that Gwyddion writes; NaN as ``nan``.

    A profile becomes two columns, places of the cells' centres and heights. Every number has all its digits. The
    provenance follows the header for people to read.
    """
    history = [f"# History: {' | '.join(line.splitlines())}" for line in surface.provenance]
    if surface.grid.ndim == 1:
        places = surface.grid.coordinates[0].tolist()
        rows: Iterable[tuple[float, ...]] = zip(places, surface.heights.tolist(), strict=True)
        # The line above the numbers names their units.
        header = [f"# Rows: {surface.grid.size}", *history, "x [m]\tz [m]"]
    else:
        height, width = surface.grid.lengths
        rows = surface.heights.tolist()
        header = [
            "# Channel: heights",
            f"# Width: {width!r} m",
            f"# Height: {height!r} m",
            "# Value units: m",
            f"# Rows: {surface.grid.shape[0]}",
            *history,
        ]
    lines = [*header, *("\t".join(map(repr, row)) for row in rows), ""]
    return "\n".join(lines).encode()
