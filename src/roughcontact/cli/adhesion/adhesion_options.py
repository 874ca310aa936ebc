"""The law of adhesion as options, and warnings for a reader of an adhesive state."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli.messages import note
from roughcontact.cli.option_groups import option
from roughcontact.cli.report import quantity
from roughcontact.cli.unit_options import ENERGY_PER_AREA, LENGTH, parse_positive

if TYPE_CHECKING:
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.surface.surface import Surface

__all__ = ["WORK", "AdhesionLaw", "LawChoice", "note_long_range", "note_unresolved", "parse_work"]

LawChoice = StrEnum("LawChoice", ["EXPONENTIAL", "DUGDALE"])
_PANEL = "Adhesion"
WORK: str = option(
    "Work of adhesion: the energy that parts a unit area.", "50mJ/m^2", default=..., rich_help_panel=_PANEL
)


@dataclass(frozen=True, slots=True)
class AdhesionLaw:
    """The attraction across a gap, as the user gave it."""

    PANEL: ClassVar = _PANEL
    work: str = WORK
    range: str = option(
        "Length over which the attraction falls with the gap; by Dugdale's law the gap up to which it acts.",
        "20nm",
        default=...,
    )
    law: LawChoice = option("How the attraction falls with the gap.", default=LawChoice.EXPONENTIAL)
    allow_unresolved: bool = option(
        "Compute although the attraction varies from cell to cell beside a contact; answers are marked.",
        default=False,
    )

    def adhesion(self) -> Adhesion:
        """Return the law of adhesion.

        Raises
        ------
        UsageError
            If a number makes no sense.
        """
        import roughcontact as rc

        length = parse_positive(self.range, LENGTH, "--range", "the range of the attraction")
        return rc.Adhesion(parse_work(self.work), length, self.law.value, self.allow_unresolved)


def parse_work(text: str) -> float:
    """Return a work of adhesion [J/m^2].

    Raises
    ------
    UsageError
        If it is not positive.
    """
    return parse_positive(text, ENERGY_PER_AREA, "--work", "the work of adhesion")


def note_long_range(adhesion: Adhesion, surface: Surface) -> None:
    """Say on standard error if the attraction reaches beyond the heights of a surface: a forgotten unit."""
    import numpy as np

    span = float(np.nanmax(surface.heights) - np.nanmin(surface.heights))
    if adhesion.range > span > 0:
        note(
            f"the range of {quantity('adhesion_range', adhesion.range)} is longer than the surface is high, "
            f"{quantity('depth', span)} from lowest to highest: a --range without a unit is in metres"
        )


def note_unresolved(unresolved: bool) -> None:
    """Say on standard error if the grid does not resolve the attraction."""
    if unresolved:
        note(
            "unresolved: the attraction varies from cell to cell beside a contact, so that the lattice traps every "
            "state; what jumps and sticks here is the lattice, not the body"
        )
