"""The commands ``surface info``, ``make`` and ``specified``: inspect a file, or make one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.cited import cited
from roughcontact.cli.contact_of_job import name_of, prepared
from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.messages import as_typed, plain, remark, reported
from roughcontact.cli.options import JSON, OUTPUT, Answer
from roughcontact.cli.parsing.several import Cells
from roughcontact.cli.report import print_facts, quantity, surface_facts, surface_record, tell
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import answer_beside, require_output, save_surface
from roughcontact.progress.events import task
from roughcontact.recipe.elastic_jobs import SurfaceJob
from roughcontact.recipe.recipe_fields import value_of
from roughcontact.recipe.source import File, SelfAffine
from roughcontact.recipe.specified import Specified
from roughcontact.recipe.texts import points

if TYPE_CHECKING:
    from roughcontact.surface.preparation.spikes import Spikes
    from roughcontact.surface.surface import Surface

__all__ = ["CELLS", "EXAMPLES", "info", "make", "specified"]

EXAMPLES = {
    "info": """
roughcontact surface info part.x3p --out result --format svg
roughcontact surface info heights.csv --unit nm --size 1mm --json
roughcontact surface info scan.csv
roughcontact surface info *.x3p
""",
    "make": """
roughcontact surface make rough.npz --hurst 0.8 --rms 1um --size 1mm
roughcontact surface make r.x3p --hurst 2 --rms 1um --size 1mm --points 65x257
roughcontact surface make - --hurst 0.8 --rms 1um --size 1mm | roughcontact surface spectrum -
""",
    "specified": """
roughcontact surface specified joint.npz --sigma 1.2um --slope 0.12 --hurst 0.8 --rolloff 64um --size 0.5mm --periodic
roughcontact surface specified face.npz --ra 1um --hurst 0.8 --correlation-length 20um --short-cutoff 8um --size 1mm
""",
}
CELLS: dict[str, Cells] = {
    "info": {
        "cells": lambda record: " x ".join(map(str, record["shape"])),
        "size": lambda record: " x ".join(quantity("lengths", length) for length in record["lengths"]),
        "missing": lambda record: str(record["missing"]),
        "rms height": lambda record: quantity("rms", record["rms"]),
        "lowest": lambda record: quantity("depth", record["lowest"]),
        "highest": lambda record: quantity("depth", record["highest"]),
        "suspicious": lambda record: str(len(record["suspicious"])),
    }
}
_BYTES_TO_LOOK = 100  # a point, beside the surface: its levelled twins, windows about its points, steps
_BYTES_PER_POINT = 47  # synthesis 21, facts and file up to 49: measured with NPZ and X3P


def info(source: File, *, answer: Answer) -> None:
    """Print the contents of a file, a map or a profile: channels, size, unit, missing points, roughness.

    Suspicious features are listed with the option of 'surface prepare' that removes them. With --out, the heights are
    drawn with rings around spikes, beside their distribution.
    """
    with reported(Path(source.file), as_json=answer.json) as beside:
        from roughcontact.files.aside import output_folder
        from roughcontact.files.file_errors import ReadError
        from roughcontact.plot.preparation_warnings import preparation_warnings

        file, channels = name_of(source), _channels(Path(source.file))
        try:
            surface = prepared(SurfaceJob(source=source), _require_memory)["surface"]
        except ReadError:
            # The channels are printed even if facts such as the size are missing.
            beside |= {"file": file, "channels": channels}
            if not answer.json:
                print_facts([("file", file), *_channel_facts(channels)])
            raise
        with task("Looking for spikes, steps and form"):
            spikes, warnings = preparation_warnings(surface)
        lines = [str(warning) for warning in warnings]
        found = {"spikes": spikes.count, "spike_cells": int(spikes.mask.sum()), "suspicious": lines}
        record = {"file": file, "channels": channels} | surface_record(surface) | found
        facts = [*_channel_facts(channels), *surface_facts(surface, record)]
        mended = [("mended by", "these options of 'roughcontact surface prepare'")] if lines else []
        with nullcontext() if answer.out is None else output_folder(answer.out) as folder:
            if folder is not None:
                with task("Drawing"):
                    _draw(surface, spikes, folder / f"surface.{answer.ending}")
        tell(record, [*facts, *(("suspicious", line) for line in lines), *mended], as_json=answer.json)
        more = cited(folder, surface, as_json=answer.json) if answer.cite else ()
        if folder is not None:
            names = " and ".join((f"surface.{answer.ending}", *more))
            remark(f"{names} {'are' if more else 'is'} in {folder}")


def _require_memory(surface: Surface) -> None:
    require_memory(_BYTES_TO_LOOK * surface.grid.size, surface.grid.shape)


def _draw(surface: Surface, spikes: Spikes, path: Path) -> None:
    from roughcontact.plot.canvas import save, surface_figure

    save(surface_figure(surface, spikes), path)


def make(out: Path = OUTPUT, *, source: SelfAffine, json: bool = JSON) -> None:
    """Make a self-affine rough surface and save its heights."""
    _make(out, source, ("rolloff", "long_cutoff", "short_cutoff"), json=json)


def specified(out: Path = OUTPUT, *, source: Specified, json: bool = JSON) -> None:
    """Make a random surface with the rms height and slope of a specification, and save its heights.

    Rms height and slope do not determine the bandwidth: also give the Hurst exponent and one more number.
    """
    _make(out, source, (), json=json)


def _make(out: Path, source: SelfAffine | Specified, waves: Sequence[str], *, json: bool) -> None:
    """Make a surface, save it, and print its facts; its history names the `waves` that were given."""
    import roughcontact as rc

    slabs, shape = slabs_of_job(), points(source.points)
    require_output(out, in_slabs=slabs is not None, as_json=json)
    share = 1 if slabs is None else slabs.communicator.size
    require_memory(_BYTES_PER_POINT * math.prod(shape) // share, shape)
    surface = prepared(SurfaceJob(source=source))["surface"]
    seed = value_of(source, "seed")
    lengths = [f"{name} {value_of(source, name):g} m" for name in waves if getattr(source, name) is not None]
    made = f"made by roughcontact {rc.__version__}: {', '.join([f'seed {seed}', *lengths])}"
    surface = replace(surface, provenance=(*surface.provenance, made))
    save_surface(surface, out)
    record = {"file": plain(str(out)), "seed": seed} | surface_record(surface)
    with answer_beside(out):
        tell(record, surface_facts(surface, record), as_json=json)


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
