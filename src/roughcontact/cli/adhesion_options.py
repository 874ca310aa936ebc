"""Options about what holds the bodies together, and what does not go with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.messages import UsageError, note
from roughcontact.cli.option_groups import option
from roughcontact.cli.unit_options import ENERGY_PER_AREA, LENGTH, parse_positive

if TYPE_CHECKING:
    from roughcontact.adhesion.attraction import Adhesion

__all__ = ["POINTS", "LawChoice", "Sticking"]

LawChoice = StrEnum("LawChoice", ["EXPONENTIAL", "DUGDALE"])
POINTS: int | None = option(
    "Depths of the approach of a --loop with --work, in even steps; the retreat has the same (default: 40).",
    "40",
    rich_help_panel="Adhesion",
)


@dataclass(frozen=True, slots=True)
class Sticking:
    """The law of adhesion, as the user gave it."""

    PANEL: ClassVar = "Adhesion"
    work: str | None = option(
        "Work of adhesion: the surfaces attract each other, and depths or forces may be negative.", "50mJ/m^2"
    )
    range: str | None = option(
        "Length over which the attraction falls, or as far as which it reaches.", "2nm"
    )
    law: LawChoice | None = option("How it falls with the gap (default: exponential).")
    allow_unresolved: bool = option(
        "Compute although the attraction varies from cell to cell beside a contact; answers are marked.",
        default=False,
    )

    @property
    def asked(self) -> bool:
        """Whether the surfaces stick.

        Raises
        ------
        UsageError
            If something is said about adhesion, and no work of adhesion.
        """
        if self.work is not None:
            return True
        said = {"--range": self.range, "--law": self.law, "--allow-unresolved": self.allow_unresolved or None}
        for name, value in said.items():
            if value is not None:
                raise UsageError(
                    f"{name} is about adhesion: give the work of adhesion, such as --work 50mJ/m^2"
                )
        return False

    def adhesion(self) -> Adhesion:
        """Return the law of adhesion.

        Raises
        ------
        UsageError
            If its range is not given, or a number makes no sense.
        """
        import roughcontact as rc

        assert self.work is not None
        if self.range is None:
            raise UsageError(
                "--work and --range belong together: give the length over which the attraction falls, such as "
                "--range 2nm"
            )
        work = parse_positive(self.work, ENERGY_PER_AREA, "--work", "the work of adhesion")
        length = parse_positive(self.range, LENGTH, "--range", "the range of the attraction")
        law: Any = "exponential" if self.law is None else self.law.value
        return rc.Adhesion(work, length, law, self.allow_unresolved)

    def refuse(self, others: Mapping[str, Any]) -> None:
        """Refuse options that are about surfaces that do not stick.

        Raises
        ------
        UsageError
            If one was given.
        """
        for name, value in others.items():
            if value is not None and value is not False:
                raise UsageError(
                    f"{name} is about surfaces that do not stick: leave it out, or leave out --work"
                )

    def remark(self, *, unresolved: bool, ambiguous: bool) -> None:
        """Say on standard error what a reader should doubt."""
        if unresolved:
            note(
                "unresolved: the attraction varies from cell to cell beside a contact, so that the lattice traps every "
                "state; what jumps and sticks here is the lattice, not the body"
            )
        if ambiguous:
            note(
                "a jump is ambiguous: two integrations of the flow after it ended in different states, of which one is "
                "given"
            )
