"""The verb ``surface prepare``: from what was measured to what is analysed or pressed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from roughcontact.cli import options
from roughcontact.cli.messages import note, plain, reported
from roughcontact.cli.report import emit, print_facts, quantity, screen, size_of
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import ENDINGS, require_output, save_surface
from roughcontact.cli.steps import TipShape, Trend, WindowShape, Wishes, steps

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "prepare"]

EXAMPLES = """Examples:

roughcontact surface prepare part.x3p flat.npz --level plane --long-cutoff 0.8mm

roughcontact surface prepare part.x3p small.x3p --crop 100:612,0:512 --fill --downsample 2

roughcontact surface prepare rough.npz seen.npz --tip 2um --average 4
"""
_BYTES_PER_POINT = 120  # heights before and after a step, masks, weights and the work of a filter
_STEPS = "Steps, in the order in which they are taken"


def _step(help_text: str, metavar: str | None = None, *names: str) -> Any:
    return typer.Option(*names, metavar=metavar, help=help_text, rich_help_panel=_STEPS)


OutputArgument = Annotated[Path, typer.Argument(metavar="OUT", help=f"File to write: {ENDINGS}.")]
CropOption = Annotated[
    str | None,
    _step(
        "1. Keep these rows and columns, counted from 0 at the top left (of a line scan 0:512).",
        "0:512,100:612",
    ),
]
TrendOption = Annotated[Trend, _step("2. Take out the mean, the plane or the quadratic.", None, "--level")]
FormOption = Annotated[
    str | None, _step("3. Take out a form: a polynomial's degree, sphere or cylinder.", "2")
]
FillOption = Annotated[
    bool, _step("4. Fill missing points smoothly; else they stay missing.", None, "--fill")
]
TipOption = Annotated[
    str | None, _step("5. What a tip of this radius records; a large one takes long.", "2um")
]
TipShapeOption = Annotated[TipShape | None, _step("5. Shape of its end (default: sphere).")]
ShortCutoffOption = Annotated[
    str | None, _step("6. Gaussian filter: take out waves shorter than this (S-filter).", "10um")
]
LongCutoffOption = Annotated[
    str | None, _step("6. Gaussian filter: take out waves longer than this (L-filter).", "1mm")
]
AverageOption = Annotated[int | None, _step("7. Average over pixels of K x K cells, as a camera does.", "K")]
DownsampleOption = Annotated[
    int | None, _step("8. Keep every K-th row and column; shorter waves are filtered out first.", "K")
]
AliasOption = Annotated[bool, _step("8. Thin out without that filter.", None, "--alias")]
WindowOption = Annotated[
    WindowShape | None, _step("9. Let the heights above their mean go to zero toward free edges.")
]
ShareOption = Annotated[
    float | None, _step("9. Part of the length that a Tukey window bends (default: 0.25).", "0.25")
]


def prepare(
    file: options.AnyFileArgument,
    out: OutputArgument,
    *,
    crop: CropOption = None,
    level: TrendOption = Trend.NONE,
    form: FormOption = None,
    fill: FillOption = False,
    tip: TipOption = None,
    tip_shape: TipShapeOption = None,
    short_cutoff: ShortCutoffOption = None,
    long_cutoff: LongCutoffOption = None,
    average: AverageOption = None,
    downsample: DownsampleOption = None,
    alias: AliasOption = False,
    window: WindowOption = None,
    share: ShareOption = None,
    channel: options.ChannelOption = None,
    unit: options.UnitOption = None,
    size: options.SizeOption = None,
    periodic: options.PeriodicOption = None,
    json: options.JsonOption = False,
) -> None:
    """Crop, level, take out form, fill, scan, filter, average, thin out and taper a surface, in this order; save it.

    Nothing is done unasked. What is done stands in the file's history. A line scan is prepared in the same way.
    """
    with reported(file, out):
        require_output(out, file)
        wishes = Wishes(
            crop,
            level,
            form,
            fill,
            tip,
            tip_shape,
            short_cutoff,
            long_cutoff,
            average,
            downsample,
            alias,
            window,
            share,
        )
        wanted = steps(wishes)
        surface = options.Reading(file, channel, unit, size, None, periodic).map_or_line()
        require_memory(_BYTES_PER_POINT * surface.grid.size, surface.grid.shape)
        if not wanted:
            note("no step is asked for: the surface is written as it was read")
        for step in wanted:
            with screen().status(f"{step.doing} ..."):
                surface = step.apply(surface)
        save_surface(surface, out)
        record = _record(surface, out)
        if json:
            emit(record)
        else:
            print_facts(_facts(surface, record))


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
