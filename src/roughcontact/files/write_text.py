"""A surface as a text that people, spreadsheets and other programs read."""

from __future__ import annotations

from collections.abc import Iterable

from roughcontact.surface.surface import Surface

__all__ = ["text_of"]


def text_of(surface: Surface) -> str:
    """Return the heights [m] as rows separated by tabs, under the header that Gwyddion writes; NaN as ``nan``.

    A line scan becomes two columns, places of the cells' centres and heights. Every number has all its digits. The
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
    return "\n".join([*header, *("\t".join(map(repr, row)) for row in rows)]) + "\n"
