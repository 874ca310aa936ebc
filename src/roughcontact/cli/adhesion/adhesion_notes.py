"""Warnings for a reader of an adhesive state."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.cli.messages import note
from roughcontact.cli.report import quantity

if TYPE_CHECKING:
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.surface.surface import Surface

__all__ = ["note_long_range"]


def note_long_range(adhesion: Adhesion, surface: Surface) -> None:
    """Print a note if the range exceeds the height of the surface: most likely its unit is missing."""
    import numpy as np

    span = float(np.nanmax(surface.heights) - np.nanmin(surface.heights))
    if adhesion.range > span > 0:
        note(
            f"the range of {quantity('adhesion_range', adhesion.range)} is longer than the surface is high, "
            f"{quantity('depth', span)} from lowest to highest: a --range without a unit is in metres"
        )
