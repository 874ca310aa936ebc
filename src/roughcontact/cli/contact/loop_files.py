"""The files that show the plastic flow under a hardness."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.output import all_or_none

if TYPE_CHECKING:
    from roughcontact.contact.loop import Loop
    from roughcontact.surface.surface import Surface

__all__ = ["write_flattened", "write_loop"]


def write_flattened(surface: Surface, flow: Any, folder: Path, ending: str) -> tuple[str, ...]:
    """Draw the surface before and after plastic flow; return the name of the picture."""
    from roughcontact.plot.canvas import save
    from roughcontact.plot.loops import flattened_figure

    with all_or_none(folder) as aside:
        save(flattened_figure(surface, flow), aside / f"flattened.{ending}")
    return ("flattened",)


def write_loop(loop: Loop, folder: Path, source: Mapping[str, Any], ending: str) -> tuple[str, ...]:
    """Write a loop and the flattened surface into a folder, all files or none; return their names."""
    from roughcontact.files.save import write
    from roughcontact.files.write import write_csv, write_netcdf
    from roughcontact.plot.canvas import save
    from roughcontact.plot.loops import flattened_figure, loop_figure
    from roughcontact.surface.surface import Surface

    dataset = loop.to_dataset()
    with all_or_none(folder) as aside:
        write_netcdf(dataset, aside / "loop.nc", source)
        write_csv(dataset, aside / "loop.csv")
        save(loop_figure(loop), aside / f"loop.{ending}")
        save(flattened_figure(loop.surface, loop.flow), aside / f"flattened.{ending}")
        if isinstance(loop.flattened, Surface):
            write(loop.flattened, aside / "flattened.npz")
    return "loop.nc", "loop.csv", f"loop.{ending}", f"flattened.{ending}", "flattened.npz"
