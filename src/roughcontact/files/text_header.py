"""What the lines above a table of heights state: sizes, units, numbers of points."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from roughcontact.files.length_units import is_length, length_factor, parse_length
from roughcontact.files.numbers import last_digit

__all__ = ["TextHeader", "header_of"]

# What programs call it, in lower case, with blanks for underscores and hyphens. Width and height in the languages of
# Gwyddion's menus that Western files come in.
_LABELS = {
    "channel": r"channel( name)?|kanal|canal|canale",
    "width": r"width|breite|largeur|anchura|larghezza|largura",
    "height": r"height|höhe|hauteur|altura|altezza",
    "x": r"(scan )?x (length|range)|length x",
    "y": r"(scan )?y (length|range)|length y",
    "dx": r"pixel ?size( x)?|x ?pixel ?size|cell ?size|d ?x|x (step|spacing|increment)|scale x|pitch( x)?|spacing",
    "dy": r"pixel ?size y|y ?pixel ?size|d ?y|y (step|spacing|increment)|scale y|pitch y",
    "columns": r"x pixels|x ?res|nx|n ?cols|columns|number of columns|points per line",
    "unit": r"(value|height|data|z) ?units?|unit (z|data)|einheit(en)?( der werte)?|werteeinheit(en)?"
    r"|unités|unità valore|unidades de valor",
    "lateral": r"(lateral|x|xy) ?units?|unit (x|xy)",
    "any": r"units?",
    "missing": r"(no ?data|missing|invalid|bad|undefined)( data)? ?values?|no ?data|missing data",
    "format": r"file format",
}
_LABELS_OF = {name: re.compile(words) for name, words in _LABELS.items()}
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
# What changes heights and is no unit: a reader that does not know it must say so.
_SCALES = re.compile(
    r"(z|height|data) scale|scale (z|data)|bit2nm|multiplier"
    r"|((z|height|data|value|scale|scaling|conversion) )*factor( .*)?"
)


@dataclass(frozen=True, slots=True)
class TextHeader:
    """What a header states; None where it is silent.

    Parameters
    ----------
    channel : str, optional
        Name of the channel.
    width, height : float, optional
        Sides of the map [m].
    dx, dy : float, optional
        Sides of a cell [m].
    rounding : float
        By how much of themselves the printed sides of the map may be off.
    columns : int, optional
        Number of heights in a row.
    unit : str, optional
        Unit of the heights.
    missing : float, optional
        Number that stands where nothing was measured.
    doubts : tuple of str
        What was read and may be otherwise.
    """

    channel: str | None = None
    width: float | None = None
    height: float | None = None
    dx: float | None = None
    dy: float | None = None
    rounding: float = 0.0
    columns: int | None = None
    unit: str | None = None
    missing: float | None = None
    doubts: tuple[str, ...] = ()

    @property
    def states_a_size(self) -> bool:
        """Whether it is that of a map."""
        return any(each is not None for each in (self.width, self.height, self.dx, self.dy, self.columns))

    def spacing(self, shape: tuple[int, int]) -> tuple[float, float] | None:
        """Return the cell (dy, dx) of a map of a shape (ny, nx) [m]; with one side of a cell alone it is a square."""
        dy = self.dy if self.height is None else self.height / shape[0]
        dx = self.dx if self.width is None else self.width / shape[1]
        if dy is None and self.height is None and self.width is None:
            dy = dx
        return None if dx is None or dy is None else (dy, dx)


def header_of(lines: Iterable[str], shape: tuple[int, int]) -> TextHeader:
    """Return what lines such as ``Width: 10 µm``, ``x-length = 10`` or ``nodata = -9999`` state of a map (ny, nx).

    A side of the map in pixels states nothing; any other bare number is in the lateral unit, in SPIP's files in
    nanometres.
    """
    stated: dict[str, str] = {}
    doubts: list[str] = []
    for line in lines:
        label, value = _parts(line)
        name = next((name for name, words in _LABELS_OF.items() if words.fullmatch(label)), None)
        if name is not None and value:
            stated.setdefault(name, value)
        elif _SCALES.fullmatch(label) and not _is_one(value):
            doubts.append(f"its header states {line.strip()[:60]!r}, which is not applied: check the heights")
    for name, axis, points in (("height", "y", shape[0]), ("width", "x", shape[1])):
        if _value(stated.get(name)) == points:
            del stated[name]  # pixels
        if axis in stated:
            stated[name] = stated[axis]
    lateral, unit = stated.get("lateral"), stated.get("unit") or stated.get("any")
    if lateral is None and stated.get("format", "").casefold() == "ascii":
        lateral = "nm"  # SPIP's
    elif lateral is None and "any" in stated and _bare(stated):
        lateral = stated["any"]
        doubts.append(
            f"its one unit, {lateral}, is taken for lengths along the map as for heights; else pass size="
        )
    lengths = {name: _length(stated.get(name), lateral) for name in ("width", "height", "dx", "dy")}
    sides = [stated[name] for name in ("width", "height") if name in stated]
    return TextHeader(
        channel=stated.get("channel"),
        **lengths,
        rounding=sum(map(_rounding, sides)),
        columns=_whole(stated.get("columns")),
        unit=unit,
        missing=_value(stated.get("missing")),
        doubts=tuple(doubts),
    )


def _parts(line: str) -> tuple[str, str]:
    """Return the label and the value of a line ``label = value`` or ``label: value``."""
    label, _, value = re.sub(r"[=:]", "=", line, count=1).partition("=")
    return re.sub(r"[\s_-]+", " ", label).strip().casefold(), value.strip()


def _bare(stated: dict[str, str]) -> bool:
    """Whether a length of the map or of a cell is stated without a unit."""
    return any(_NUMBER.fullmatch(stated.get(name, "")) for name in ("width", "height", "dx", "dy"))


def _length(text: str | None, lateral: str | None) -> float | None:
    if text is None:
        return None
    text = text.replace(",", ".")
    try:
        if _NUMBER.fullmatch(text):
            length = (
                float(text) * length_factor(lateral)
                if lateral is not None and is_length(lateral)
                else math.nan
            )
            return length if length > 0 else None
        return parse_length(text)
    except ValueError:
        return None


def _rounding(text: str) -> float:
    """Return by how much of itself a printed number may have been rounded."""
    number = re.match(r"\d+\.?\d*(?:[eE][-+]?\d+)?", text.replace(",", "."))
    if number is None or float(number[0]) == 0:
        return 0.0
    return 0.5 * last_digit(number[0]) / float(number[0])


def _whole(text: str | None) -> int | None:
    return int(text) if text is not None and re.fullmatch(r"\d{1,9}", text) else None


def _value(text: str | None) -> float | None:
    return float(text) if text is not None and _NUMBER.fullmatch(text) else None


def _is_one(value: str) -> bool:
    """Whether a factor changes nothing."""
    return _NUMBER.fullmatch(value) is not None and float(value) == 1.0
