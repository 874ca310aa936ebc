"""The commands ``surface info`` and ``surface make``: look at a file, or make one."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli import options
from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.messages import as_typed, note, plain, reported
from roughcontact.cli.option_groups import option
from roughcontact.cli.picture_options import FORMAT, PictureFormat, picture_ending
from roughcontact.cli.report import print_facts, surface_facts, surface_record, tell
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import require_output, save_surface
from roughcontact.cli.unit_options import (
    LENGTH,
    parse,
    parse_band,
    parse_number,
    parse_points,
    parse_seed,
    parse_size,
)
from roughcontact.progress.events import task

if TYPE_CHECKING:
    from roughcontact.grid import Grid
    from roughcontact.surface.preparation.spikes import Spikes
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "info", "make"]

EXAMPLES = {
    "info": """
roughcontact surface info part.x3p --out result --format svg
roughcontact surface info heights.csv --unit nm --size 1mm --json
roughcontact surface info scan.csv
""",
    "make": """
roughcontact surface make rough.npz --hurst 0.8 --rms 1um --size 1mm
roughcontact surface make r.x3p --hurst 2 --rms 1um --size 1mm --points 65x257
""",
}
_BYTES_TO_LOOK = 100  # a point, beside the surface: its levelled twins, windows about its points, steps
_BYTES_PER_POINT = 47  # of the synthesis 21, of its facts and the file up to 49: measured with NPZ and X3P


def info(
    source: options.Source,
    *,
    out: Path | None = options.OUT,
    format: PictureFormat | None = FORMAT,
    json: bool = options.JSON,
) -> None:
    """Say what a file holds, a map or a profile: channels, size, unit, missing points, roughness.

    What looks suspicious comes with the option of 'surface prepare' that mends it. With --out a picture of the heights,
    their spikes ringed, and of their distribution.
    """
    file = source.file
    with reported(file, out, as_json=json) as beside:
        from roughcontact.files.aside import output_folder
        from roughcontact.files.file_errors import ReadError
        from roughcontact.plot.preparation_warnings import preparation_warnings

        ending = picture_ending(format, out)
        channels = _channels(file)
        try:
            surface = source.map_or_line()
        except ReadError:
            # What the file leaves open, such as its size, does not hide what it holds.
            beside |= {"file": plain(str(file)), "channels": channels}
            if not json:
                print_facts([("file", beside["file"]), *_channel_facts(channels)])
            raise
        require_memory(_BYTES_TO_LOOK * surface.grid.size, surface.grid.shape)
        with task("Looking for spikes, steps and form"):
            spikes, warnings = preparation_warnings(surface)
        lines = [str(warning) for warning in warnings]
        found = {"spikes": spikes.count, "spike_cells": int(spikes.mask.sum()), "suspicious": lines}
        record = {"file": plain(str(file)), "channels": channels} | surface_record(surface) | found
        facts = [*_channel_facts(channels), *surface_facts(surface, record)]
        mended = [("mended by", "these options of 'roughcontact surface prepare'")] if lines else []
        with nullcontext() if out is None else output_folder(out) as folder:
            if folder is not None:
                with task("Drawing"):
                    _draw(surface, spikes, folder / f"surface.{ending}")
        tell(record, [*facts, *(("suspicious", line) for line in lines), *mended], as_json=json)
        if folder is not None:
            note(f"surface.{ending} is in {folder}")


def _draw(surface: Surface, spikes: Spikes, path: Path) -> None:
    from roughcontact.plot.canvas import save, surface_figure

    save(surface_figure(surface, spikes), path)


@dataclass(frozen=True, slots=True, kw_only=True)
class Recipe:
    """A self-affine surface, as the user described it."""

    hurst: str = option("Hurst exponent, from -1 to 3.", "0.8", default=...)
    rms: str = option("Root mean square height.", "1um", default=...)
    rms_band: str | None = option(
        "Longest and shortest of the waves whose rms height is --rms (all), for one surface on several grids.",
        "1mm:10um",
    )
    size: str = option("Width (cells are square), or height x width.", "1mm", default=...)
    points: str = option("Points a side, or rows x columns.", "512", default="512")
    seed: str = option("Seed of the random phases.", "1", default="1")
    rolloff: str | None = option("Roll-off: the spectrum of longer waves is constant.", "100um")
    long_cutoff: str | None = option("Longer waves are absent.", "500um")
    short_cutoff: str | None = option("Shorter waves are absent.", "5um")
    periodic: bool = option("For a surface that repeats itself.", default=False)
    nodal: bool = option(
        "Repeat the first row and column at the end: grids of 2^m + 1 points.", default=False
    )


def make(out: Path = options.OUTPUT, *, recipe: Recipe, json: bool = options.JSON) -> None:
    """Make a self-affine rough surface and save its heights."""
    with reported(out, as_json=json):
        import numpy as np

        import roughcontact as rc

        slabs = slabs_of_job()
        require_output(out, in_slabs=slabs is not None)
        grid = _grid(recipe.size, recipe.points, recipe.periodic)
        share = 1 if slabs is None else slabs.communicator.size
        require_memory(_BYTES_PER_POINT * grid.size // share, grid.shape)
        height, exponent = parse(recipe.rms, LENGTH, "--rms"), parse_number(recipe.hurst, "--hurst", "0.8")
        chosen = parse_seed(recipe.seed, "--seed")
        waves = {
            name: parse(text, LENGTH, f"--{name.replace('_', '-')}")
            for name in ("rolloff", "long_cutoff", "short_cutoff")
            if (text := getattr(recipe, name)) is not None
        }
        band = None if recipe.rms_band is None else parse_band(recipe.rms_band, "--rms-band")
        surface = rc.self_affine(
            grid,
            exponent,
            height,
            np.random.default_rng(chosen),
            rms_band=band,
            nodal=recipe.nodal,
            slabs=slabs,
            **waves,  # type: ignore[arg-type]
        )
        made = ", ".join([f"seed {chosen}", *(f"{name} {length:g} m" for name, length in waves.items())])
        made = f"made by roughcontact {rc.__version__}: {made}"
        surface = replace(surface, provenance=(*surface.provenance, made))
        save_surface(surface, out)
        record = {"file": plain(str(out)), "seed": chosen} | surface_record(surface)
        tell(record, surface_facts(surface, record), as_json=json)


def _grid(size: str, points: str, periodic: bool) -> Grid:
    """Return the grid of a new surface; with one length the cells are square."""
    import roughcontact as rc

    shape = parse_points(points, "--points")
    lengths = parse_size(size, "--size")
    width = lengths[-1] / shape[1]
    height = lengths[0] / shape[0] if len(lengths) == 2 else width
    return rc.Grid(shape, (height, width), periodic=periodic)


def _channels(file: Path) -> list[dict[str, Any]]:
    """Return the channels of a file as plain records."""
    from roughcontact.files.read import channels

    with as_typed(file):
        return [asdict(channel) for channel in channels(file)]


def _channel_facts(channels: list[dict[str, Any]]) -> list[tuple[str, str]]:
    facts = []
    for channel in channels:
        shape = " x ".join(str(n) for n in channel["shape"])
        unit = "without a unit" if channel["unit"] is None else f"in {channel['unit']}"
        kind = "" if channel["is_height"] else ", not heights"
        if len(channel["shape"]) == 1:
            kind = ", a profile"
        facts.append(("channel", f"{channel['name']}: {shape}, {unit}{kind}"))
    return facts
