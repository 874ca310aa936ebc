"""The files of ``press`` by several processes: those of one, in one folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.messages import note
from roughcontact.cli.output import all_or_none

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.slabs.slabs import Slabs

__all__ = ["write_from_slabs"]

_DRAWN = 2**22  # cells of a picture: more are not gathered by the one process that draws


def write_from_slabs(
    slabs: Slabs,
    solution: Solution,
    record: dict[str, Any],
    folder: Path | None,
    source: dict[str, Any],
    ending: str,
) -> tuple[str, ...]:
    """Write a loaded state into the folder that the first process knows, and return the names of its pictures.

    All processes take part in what is written, and the first moves it into place.
    """
    from roughcontact.contact.dataset import numbers_dataset, solution_maps
    from roughcontact.files.write import write_json
    from roughcontact.files.write_in_slabs import write_netcdf_in_slabs
    from roughcontact.plot.canvas import save, solution_figure
    from roughcontact.slabs.agreement import by_first, entered_by_first

    communicator, size = slabs.communicator, solution.problem.grid.size
    numbers = numbers_dataset(solution).assign_attrs(source)
    drawn = solution.on_host() if size <= _DRAWN else None
    with entered_by_first(communicator, lambda: all_or_none(folder or Path())) as aside:
        write_netcdf_in_slabs(numbers, solution_maps(solution), aside / "pressure.nc")

        def write() -> None:
            if drawn is not None:
                save(solution_figure(drawn), aside / f"pressure.{ending}")
            write_json(record, aside / "press.json", source)

        by_first(communicator, write)
    if drawn is None:
        note(f"no picture: {size} cells are more than the {_DRAWN} that one process draws")
        return ()
    return ("pressure",)
