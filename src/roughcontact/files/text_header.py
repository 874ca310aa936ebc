"""What the lines above a table of heights state: sizes, units, numbers of points."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from roughcontact.files.length_units import is_length, length_factor, stated_length
from roughcontact.files.numbers import last_digit

__all__ = ["TextHeader", "header_of"]

# Names that programs use, in lower case, with blanks for underscores and hyphens. Width and height also in the
# Western languages of Gwyddion's menus.
_LABELS = {
    "channel": r"channel( name)?|kanal|kanál|canal|canale|канал|チャネル|채널",
    "width": r"width|breite|largeur|anchura|larghezza|largura|šířka|ширина|幅|폭",
    "height": r"height|höhe|hauteur|altura|altezza|výška|высота|高さ|높이",
    "x": r"(scan )?x (length|range)|length x",
    "y": r"(scan )?y (length|range)|length y",
    "dx": r"pixel ?size( x)?|x ?pixel ?size|cell ?size( x)?|d ?x|x (step|spacing|increment)|scale x|pitch( x)?|spacing"
    r"|(pixelgrösse|schrittweite)( x)?",
    "dy": r"pixel ?size y|y ?pixel ?size|cell ?size y|d ?y|y (step|spacing|increment)|scale y|pitch y"
    r"|(pixelgrösse|schrittweite) y",
    "columns": r"x pixels|x ?res|nx|n ?cols|columns|number of columns|points per line",
    "unit": r"(value|height|data|z) ?units?|unit (z|data)|(z ?)?einheit(en)?( der werte)?|werteeinheit(en)?"
    r"|unités|unità valore|unidades de valor|jednotky hodnot|единицы измерения|値の単位|값 단위",
    "lateral": r"(lateral|x|xy) ?units?|unit (x|xy)|(laterale|x) ?einheit|x axis",
    "lateral y": r"y ?units?|unit y|y ?einheit",
    "any": r"units?",
    "missing": r"(no ?data|missing|invalid|bad|undefined|null|void|fill|mask|blank)( data| pixel| point)? ?values?"
    r"|no ?data|missing data|fehlwert|fehlender wert|ungültiger wert|valeur manquante|sin datos",
    "format": r"file format",
}
_LABELS_OF = {name: re.compile(words) for name, words in _LABELS.items()}
_SIDES = ("width", "height", "dx", "dy")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_THOUSANDS = re.compile(r"[1-9]\d{0,2}(,\d{3})+(?!\d)")  # or three decimals: ambiguous
_LABELLED = re.compile(r"([^\d=:]+?)[\s,;]\s*([-+]?\.?\d[^=:]*)")
_DIGIT = re.compile(r"[-+.]*\d")
_PIXELS = re.compile(r"\d+\s*(px|pix|pixels?|points?|pts|samples?|cells?)?\.?", re.IGNORECASE)
# Entries that change heights and are not units: they are not applied, so the reader warns about them.
_SCALES = re.compile(
    r"(z|height|data) scale|scale (z|data)|bit2nm|multiplier"
    r"|((z|height|data|value|scale|scaling|conversion) )*factor( .*)?"
)


@dataclass(frozen=True, slots=True)
class TextHeader:
    """The values that a header states; None for those that it does not state.

    Parameters
    ----------
    channel : str, optional
        Name of the channel.
    width, height : float, optional
        Sides of the map [m].
    dx, dy : float, optional
        Sides of a cell [m].
    rounding : float
        Relative rounding error of the printed sides of the map.
    columns : int, optional
        Number of heights in a row.
    unit : str, optional
        Unit of the heights.
    lateral : str, optional
        Unit of lengths along the map.
    missing : tuple of float
        Marks of points that were not measured.
    unclear : str, optional
        A side of the map or of a cell in words that are not understood.
    warnings : tuple of str
        Values that were read and may be wrong.
    """

    channel: str | None = None
    width: float | None = None
    height: float | None = None
    dx: float | None = None
    dy: float | None = None
    rounding: float = 0.0
    columns: int | None = None
    unit: str | None = None
    lateral: str | None = None
    missing: tuple[float, ...] = ()
    unclear: str | None = None
    warnings: tuple[str, ...] = ()

    @property
    def states_a_size(self) -> bool:
        """Whether it is the header of a map."""
        return any(each is not None for each in (self.width, self.height, self.dx, self.dy, self.columns))

    @property
    def unit_unknown(self) -> str | None:
        """The unit of heights if it is not a known length; it cannot be used for places either."""
        return None if is_length(self.unit) else self.unit

    def spacing(self, shape: tuple[int, int]) -> tuple[float, float] | None:
        """Return the cell (dy, dx) [m] of a map of a shape (ny, nx); if only one side is stated, the cell is a square.

        None if a side that is needed is not stated, or not understood.
        """
        dy = self.dy if self.height is None else self.height / shape[0]
        dx = self.dx if self.width is None else self.width / shape[1]
        if dy is None and self.width is None and self.unclear is None:
            dy = dx
        return None if dx is None or dy is None else (dy, dx)


def header_of(lines: Iterable[str], shape: tuple[int, int]) -> TextHeader:
    """Return the statements about a map (ny, nx) in lines such as ``Width: 10 µm`` or ``nodata = -9999``.

    A side of the map in pixels states nothing; any other bare number is in the lateral unit, in SPIP's files in
    nanometres.
    """
    stated: dict[str, str] = {}
    missing: list[float] = []
    warnings: list[str] = []
    for line in lines:
        label, value = _parts(line)
        name = next((name for name, each in _LABELS_OF.items() if each.fullmatch(label)), None)
        if name == "missing":
            missing += _numbers(value)
        elif name is not None and value:
            stated.setdefault(name, value)
        elif _SCALES.fullmatch(label) and not _is_one(value):
            words = line.strip()[:60]
            warnings.append(f"its header states {words!r}, which is not applied: check the heights")
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
        warnings.append(
            f"its one unit, {lateral}, is assumed for lengths along the map as for heights; pass size= if that is wrong"
        )
    along_y = stated.get("lateral y", lateral)
    units = {"width": lateral, "height": along_y, "dx": lateral, "dy": along_y}
    lengths = {name: _length(stated.get(name), each) for name, each in units.items()}
    sides = [stated[name] for name in ("width", "height") if name in stated]
    return TextHeader(
        channel=stated.get("channel"),
        **lengths,
        rounding=sum(map(_rounding, sides)),
        columns=_whole(stated.get("columns")),
        unit=unit,
        lateral=lateral,
        missing=tuple(missing),
        unclear=_unclear(stated, lengths),
        warnings=tuple(warnings),
    )


def _unclear(stated: dict[str, str], lengths: dict[str, float | None]) -> str | None:
    """Return the first side that is stated with a number but is neither understood nor in pixels."""
    sides = {name: stated[name] for name in _SIDES if name in stated and lengths[name] is None}
    unclear = (name for name, text in sides.items() if _DIGIT.match(text) and not _PIXELS.fullmatch(text))
    return next((f"{name} = {sides[name][:40]}" for name in unclear), None)


def _parts(line: str) -> tuple[str, str]:
    """Return the label and the value of a line ``label = value``, ``label: value`` or ``label [unit]: value``.

    A number may also follow a label directly: ``NODATA_value -9999``.
    """
    bare = _LABELLED.fullmatch(line)
    label, _, value = re.sub(r"[=:]", "=", line, count=1).partition("=")
    if bare is not None:
        label, value = bare[1], bare[2]
    named = re.fullmatch(r"(.*?)\s*[\[(]([^\])]+)[\])]\s*", label)
    if named is not None and _NUMBER.fullmatch(value.strip().replace(",", ".")):
        label, value = named[1], f"{value} {named[2]}"
    return re.sub(r"[\s_-]+", " ", label).strip().casefold(), value.strip()


def _numbers(text: str) -> list[float]:
    """Return the numbers in a list, with or without a unit after them; a comma in a single number is a decimal mark."""
    whole = text.replace(",", ".") if re.fullmatch(rf"{_NUMBER.pattern},\d+", text.strip()) else text
    return [float(found[0]) for found in re.finditer(rf"(?<![\w.]){_NUMBER.pattern}", whole)]


def _bare(stated: dict[str, str]) -> bool:
    """Whether a length of the map or of a cell is stated without a unit."""
    return any(_NUMBER.fullmatch(stated.get(name, "")) for name in _SIDES)


def _length(text: str | None, lateral: str | None) -> float | None:
    if text is None or _THOUSANDS.match(text):
        return None
    text = text.replace(",", ".")
    if not _NUMBER.fullmatch(text):
        return stated_length(text)
    if not is_length(lateral):
        return None
    length = float(text) * length_factor(lateral or "")
    return length if length > 0 else None


def _rounding(text: str) -> float:
    """Return the relative rounding error of a printed number."""
    number = re.match(r"\d+\.?\d*(?:[eE][-+]?\d+)?", text.replace(",", "."))
    if number is None or float(number[0]) == 0:
        return 0.0
    return 0.5 * last_digit(number[0]) / float(number[0])


def _whole(text: str | None) -> int | None:
    return int(text) if text is not None and re.fullmatch(r"\d{1,9}", text) else None


def _value(text: str | None) -> float | None:
    return float(text) if text is not None and _NUMBER.fullmatch(text) else None


def _is_one(value: str) -> bool:
    """Whether a factor is 1."""
    return _NUMBER.fullmatch(value) is not None and float(value) == 1.0
