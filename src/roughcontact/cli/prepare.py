"""The verb ``surface prepare``: from what was measured to what is analysed or pressed."""

from __future__ import annotations

import re
from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from roughcontact.cli import options
from roughcontact.cli.errors import UsageError, note, plain, reported
from roughcontact.cli.memory import require_memory, require_memory_to_read
from roughcontact.cli.quantity import LENGTH, parse
from roughcontact.cli.report import emit, print_facts, quantity, size_of

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "prepare"]

EXAMPLES = """Examples:

roughcontact surface prepare part.x3p flat.npz --level plane --long 0.8mm

roughcontact surface prepare part.x3p small.x3p --crop 100:612,0:512 --fill --downsample 2
"""
_KINDS = (".npz", ".x3p", ".nc", ".vti")
_BYTES_PER_POINT = 120  # heights before and after a step, masks, weights and the work of a filter
_Step = Callable[["Surface"], "Surface"]


class Trend(StrEnum):
    """What is taken out of the heights."""

    NONE = "none"
    MEAN = "mean"
    PLANE = "plane"
    QUADRATIC = "quadratic"


_STEPS = "Steps, in the order in which they are taken"


def _step(help_text: str, metavar: str | None = None, *names: str) -> Any:
    return typer.Option(*names, metavar=metavar, help=help_text, rich_help_panel=_STEPS)


OutputArgument = Annotated[
    Path, typer.Argument(metavar="OUT", help="File to write: .npz, .x3p, .nc, or .vti for ParaView.")
]
CropOption = Annotated[
    str | None, _step("1. Keep these rows and columns, counted from 0 at the top left.", "0:512,100:612")
]
TrendOption = Annotated[Trend, _step("2. Take out the mean, the plane or the quadratic.", None, "--level")]
FormOption = Annotated[
    str | None, _step("3. Take out a form: a polynomial's degree, sphere or cylinder.", "2")
]
FillOption = Annotated[
    bool, _step("4. Fill missing points smoothly; else they stay missing.", None, "--fill")
]
ShortOption = Annotated[
    str | None, _step("5. Gaussian filter: take out waves shorter than this (S-filter).", "10um")
]
LongOption = Annotated[
    str | None, _step("5. Gaussian filter: take out waves longer than this (L-filter).", "1mm")
]
DownsampleOption = Annotated[
    int | None, _step("6. Keep every K-th row and column; shorter waves are filtered out first.", "K")
]
AliasOption = Annotated[bool, _step("6. Thin out without that filter.", None, "--alias")]


def prepare(
    file: options.FileArgument,
    out: OutputArgument,
    *,
    crop: CropOption = None,
    level: TrendOption = Trend.NONE,
    form: FormOption = None,
    fill: FillOption = False,
    short: ShortOption = None,
    long: LongOption = None,
    downsample: DownsampleOption = None,
    alias: AliasOption = False,
    channel: options.ChannelOption = None,
    unit: options.UnitOption = None,
    size: options.SizeOption = None,
    periodic: options.PeriodicOption = None,
    json: options.JsonOption = False,
) -> None:
    """Crop, level, take out form, fill, filter and thin out a surface, in this order, and save it.

    Nothing is done unasked. What is done stands in the file's history.
    """
    with reported(file, out):
        import roughcontact as rc

        _check_target(out, file)
        steps = _steps(crop, level, form, fill, _cutoffs(short, long), (downsample, alias))
        require_memory_to_read(file)
        surface = options.Reading(file, channel, unit, size, None, periodic).as_it_is()
        require_memory(_BYTES_PER_POINT * surface.grid.size, surface.grid.shape)
        if not steps:
            note("no step is asked for: the surface is written as it was read")
        for step in steps:
            surface = step(surface)
        if out.exists():
            note(f"{out} was there before and is replaced")
        rc.write(surface, out)
        if out.suffix.casefold() in (".x3p", ".vti"):
            note(f"a {out.suffix} file has no place for the history; .npz and .nc keep it")
        record = _record(surface, out)
        if json:
            emit(record)
        else:
            print_facts(_facts(surface, record))


def _check_target(out: Path, file: Path) -> None:
    """Refuse what cannot be written before any work, and what must not be overwritten."""
    if out.suffix.casefold() not in _KINDS:
        raise UsageError(f"cannot write {out}: name a file that ends in {', '.join(_KINDS)}")
    if out.exists() and file.exists() and out.samefile(file):
        raise UsageError(f"{out} is the measured file itself: name another file to write")


def _steps(
    crop: str | None,
    level: Trend,
    form: str | None,
    fill: bool,
    cutoffs: dict[str, float],
    thinning: tuple[int | None, bool],
) -> list[_Step]:
    """Return what was asked for, in the order of application."""
    steps: list[_Step] = []
    if crop is not None:
        parts = _parts(crop)
        steps.append(lambda surface: surface.cropped(*parts))
    if level is not Trend.NONE:
        trend: Any = level.value
        steps.append(lambda surface: surface.levelled(trend))
    if form is not None:
        shape = _form(form)
        steps.append(lambda surface: surface.without_form(shape))
    if fill:
        steps.append(lambda surface: surface.filled() if surface.missing else surface)
    if cutoffs:
        steps.append(lambda surface: _filtered(surface, cutoffs))
    factor, alias = thinning
    if factor is None and alias:
        raise UsageError("--alias belongs to --downsample: give its K as well")
    if factor is not None:
        if factor < 1:
            raise UsageError(f"--downsample: K must be a whole number from 1 up, not {factor}")
        steps.append(lambda surface: surface.downsampled(factor, anti_alias=not alias))
    return steps


def _parts(text: str) -> tuple[slice, slice]:
    """Return the rows and columns of ``0:512,100:612``; an end left open is that of the map."""
    match = re.fullmatch(r"\s*(\d*)\s*:\s*(\d*)\s*,\s*(\d*)\s*:\s*(\d*)\s*", text, re.ASCII)
    if match is None:
        raise UsageError(f"--crop: {text!r} is no part of a map; write rows,columns such as 0:512,100:612")
    rows_from, rows_to, columns_from, columns_to = (int(part) if part else None for part in match.groups())
    return slice(rows_from, rows_to), slice(columns_from, columns_to)


def _form(text: str) -> Any:
    """Return the form that the library knows by `text`: a degree or a word."""
    if text in ("sphere", "cylinder"):
        return text
    if re.fullmatch(r"\d{1,2}", text, re.ASCII) is None or int(text) > 12:
        raise UsageError(f"--form: {text!r} is no form; write a degree from 0 to 12, sphere or cylinder")
    return int(text)


def _cutoffs(short: str | None, long: str | None) -> dict[str, float]:
    return {
        name: parse(text, LENGTH, option)
        for name, text, option in (("short_cutoff", short, "--short"), ("long_cutoff", long, "--long"))
        if text is not None
    }


def _filtered(surface: Surface, cutoffs: dict[str, float]) -> Surface:
    short, longest = cutoffs.get("short_cutoff"), max(surface.grid.lengths)
    if short is not None and short >= longest:
        # Most likely a unit was forgotten: nothing but the mean would be left.
        raise UsageError(
            f"--short: a cut-off of {quantity('lengths', short)} leaves nothing of a map of "
            f"{quantity('lengths', longest)}; give its unit, such as 10um"
        )
    return surface.filtered(**cutoffs)


def _record(surface: Surface, out: Path) -> dict[str, Any]:
    grid = surface.grid
    return {
        "verb": "surface prepare",
        "file": plain(str(out)),
        "shape": list(grid.shape),
        "spacing": list(grid.spacing),
        "lengths": list(grid.lengths),
        "periodic": list(grid.periodic),
        "missing": surface.missing,
        "rms": surface.rms,
        "provenance": list(surface.provenance),
        "units": dict.fromkeys(("spacing", "lengths", "rms"), "m"),
    }


def _facts(surface: Surface, record: dict[str, Any]) -> list[tuple[str, str]]:
    return [
        ("file", record["file"]),
        ("size", size_of(surface.grid)),
        ("missing points", str(surface.missing) if surface.missing else "none"),
        ("rms height", quantity("rms", surface.rms)),
        *(("history", line) for line in record["provenance"]),
    ]
