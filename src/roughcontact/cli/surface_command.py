"""The commands ``surface info`` and ``surface make``: look at a file, or make one."""

from __future__ import annotations

from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from roughcontact.cli import options
from roughcontact.cli.messages import as_typed, plain, reported
from roughcontact.cli.report import emit, print_facts, quantity, size_of
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import require_output, save_surface
from roughcontact.cli.unit_options import LENGTH, parse, parse_number, parse_points, parse_seed, parse_size

if TYPE_CHECKING:
    from roughcontact.grid import Grid
    from roughcontact.surface.surface import Surface

__all__ = ["INFO_EXAMPLES", "MAKE_EXAMPLES", "info", "make"]

INFO_EXAMPLES = """Examples:

roughcontact surface info part.x3p

roughcontact surface info heights.csv --unit nm --size 1mm --json

roughcontact surface info scan.csv
"""
MAKE_EXAMPLES = """Examples:

roughcontact surface make rough.npz --hurst 0.8 --rms 1um --size 1mm

roughcontact surface make r.x3p --hurst 2 --rms 1um --size 1mm --points 65x257
"""
_LENGTHS = ("spacing", "lengths", "rms", "rms_levelled", "lowest", "highest")
_BYTES_TO_LOOK = 40  # a point, beside the surface: its levelled twin and the roughness of both
_BYTES_PER_POINT = 90  # of the synthesis: heights, noise, its transform, wavenumbers, amplitudes


def info(source: options.Source, *, json: options.JsonOption = False) -> None:
    """Say what a file holds, a map or a profile: channels, size, unit, missing points, roughness."""
    file = source.file
    with reported(file):
        from roughcontact.files.file_errors import ReadError

        channels = _channels(file)
        try:
            surface = source.map_or_line()
        except ReadError as error:
            # What the file leaves open, such as its size, does not hide what it holds.
            _tell(
                {"file": plain(str(file)), "channels": channels, "error": str(error)},
                _channel_facts(channels),
                json,
            )
            raise
        require_memory(_BYTES_TO_LOOK * surface.grid.size, surface.grid.shape)
        record = {"file": plain(str(file)), "channels": channels} | _record(surface)
        _tell(record, [*_channel_facts(channels), *_facts(surface, record)], json)


def make(
    out: options.OutputArgument,
    *,
    hurst: Annotated[str, options.option("Hurst exponent, from -1 to 3.", "0.8")],
    rms: Annotated[str, options.option("Root mean square height.", "1um")],
    size: Annotated[str, options.option("Width (cells are square), or height x width.", "1mm")],
    points: Annotated[str, options.option("Points a side, or rows x columns.", "512")] = "512",
    seed: Annotated[str, options.option("Seed of the random phases.", "1")] = "1",
    rolloff: Annotated[
        str | None, options.option("Roll-off: the spectrum of longer waves is constant.", "100um")
    ] = None,
    long_cutoff: Annotated[str | None, options.option("Longer waves are absent.", "500um")] = None,
    short_cutoff: Annotated[str | None, options.option("Shorter waves are absent.", "5um")] = None,
    periodic: Annotated[
        bool, options.option("For a surface that repeats itself.", None, "--periodic")
    ] = False,
    nodal: Annotated[
        bool,
        options.option(
            "Repeat the first row and column at the end: grids of 2^m + 1 points.", None, "--nodal"
        ),
    ] = False,
    json: options.JsonOption = False,
) -> None:
    """Make a self-affine rough surface and save its heights."""
    with reported(out):
        import numpy as np

        import roughcontact as rc

        require_output(out)
        grid = _grid(size, points, periodic)
        require_memory(_BYTES_PER_POINT * grid.size, grid.shape)
        height, exponent = parse(rms, LENGTH, "--rms"), parse_number(hurst, "--hurst", "0.8")
        chosen = parse_seed(seed, "--seed")
        given = {"rolloff": rolloff, "long_cutoff": long_cutoff, "short_cutoff": short_cutoff}
        waves = {
            name: parse(text, LENGTH, f"--{name.replace('_', '-')}")
            for name, text in given.items()
            if text is not None
        }
        surface = rc.self_affine(
            grid,
            exponent,
            height,
            np.random.default_rng(chosen),
            nodal=nodal,
            rolloff=waves.get("rolloff"),
            long_cutoff=waves.get("long_cutoff"),
            short_cutoff=waves.get("short_cutoff"),
        )
        recipe = ", ".join([f"seed {chosen}", *(f"{name} {length:g} m" for name, length in waves.items())])
        made = f"made by roughcontact {rc.__version__}: {recipe}"
        surface = replace(surface, provenance=(*surface.provenance, made))
        save_surface(surface, out)
        record = {"file": plain(str(out)), "seed": chosen} | _record(surface)
        _tell(record, _facts(surface, record), json)


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
    from roughcontact.files.inspect import channels

    with as_typed(file):
        return [asdict(channel) for channel in channels(file)]


def _record(surface: Surface) -> dict[str, Any]:
    import numpy as np

    grid = surface.grid
    return {
        "shape": list(grid.shape),
        "spacing": list(grid.spacing),
        "lengths": list(grid.lengths),
        "periodic": list(grid.periodic),
        "missing": surface.missing,
        "rms": surface.rms,
        "rms_levelled": surface.levelled("plane").rms,
        "lowest": float(np.nanmin(surface.heights)),
        "highest": float(np.nanmax(surface.heights)),
        "provenance": list(surface.provenance),
        "units": dict.fromkeys(("spacing", "lengths", "rms", "rms_levelled", "lowest", "highest"), "m"),
    }


def _facts(surface: Surface, record: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what is worth telling of a surface, line by line."""
    cell = " x ".join(quantity("spacing", step) for step in surface.grid.spacing)
    missing = f"{surface.missing} ({surface.missing / surface.grid.size:.2%})" if surface.missing else "none"
    trend = "plane" if surface.grid.ndim == 2 else "slope"
    rms = f"{quantity('rms', surface.rms)}; {quantity('rms', record['rms_levelled'])} about its {trend}"
    return [
        ("size", size_of(surface.grid)),
        ("cell", cell),
        ("missing points", missing),
        ("rms height", rms),
        ("heights", f"{quantity('heights', record['lowest'])} to {quantity('heights', record['highest'])}"),
        *(("history", line) for line in record["provenance"]),
    ]


def _channel_facts(channels: list[dict[str, Any]]) -> list[tuple[str, str]]:
    facts = []
    for channel in channels:
        shape = " x ".join(str(n) for n in channel["shape"])
        unit = "without a unit" if channel["unit"] is None else f"in {channel['unit']}"
        kind = "" if channel["is_height"] else ", not heights"
        if len(channel["shape"]) == 1:
            kind = ", a line scan"
        facts.append(("channel", f"{channel['name']}: {shape}, {unit}{kind}"))
    return facts


def _tell(record: dict[str, Any], facts: list[tuple[str, str]], json: bool) -> None:
    if json:
        emit(record)
    else:
        print_facts([("file", record["file"]), *facts])
