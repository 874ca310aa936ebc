"""How a profile is pressed, and in which units its loads are."""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum
from typing import TYPE_CHECKING

from roughcontact.cli.messages import UsageError, note
from roughcontact.cli.option_groups import option
from roughcontact.cli.unit_options import FORCE, FORCE_PER_LENGTH, LENGTH, PRESSURE, Kind

if TYPE_CHECKING:
    from roughcontact.halfspace.operators.operator import Operator
    from roughcontact.surface.surface import Surface

__all__ = ["PROFILE", "ProfileBody", "kinds_of"]


class ProfileBody(StrEnum):
    """What a profile is taken for."""

    LINE = "line"
    WINKLER = "winkler"

    def operator(self, surface: Surface, modulus: float) -> Operator:
        """Return the body under the profile; say on standard error what its numbers are."""
        import roughcontact as rc

        if self is ProfileBody.LINE:
            note(
                "a line contact: nothing changes across the profile; forces, stiffness and area are per unit length"
                + (
                    ""
                    if all(surface.grid.periodic)
                    else "; depth and k depend on the length of the profile, K does not"
                )
            )
            return rc.line(surface.grid, modulus)
        note(
            "independent springs of the method of dimensionality reduction: a measured profile is not the line that "
            "stands for its surface; rc.mdr.line_scan makes that of it"
        )
        return rc.foundation(surface.grid, modulus)

    def require(self, *, conducting: str | None, areal_units: bool, hardness: bool) -> None:
        """Refuse, before any work, what the numbers of this body do not give.

        Raises
        ------
        UsageError
            For conductances other than the total one of springs, and units per area and a hardness on springs.
        """
        if conducting is not None and self is ProfileBody.LINE:
            raise UsageError(
                "a line contact has no conductance of its own, it depends on how far away the bodies end",
                "leave them out",
                place="--resistivity, --conductivity",
            )
        if conducting == "interface" and self is ProfileBody.WINKLER:
            raise UsageError(
                "a Winkler foundation has a total conductance only", "give --of total", place="--of"
            )
        if areal_units and self is ProfileBody.WINKLER:
            raise UsageError(
                "--unit-stiffness and --unit-pressure are per area: on springs loads and stiffness are per length",
                "leave them out",
                place="--unit-stiffness, --unit-pressure",
            )
        if hardness and self is ProfileBody.WINKLER:
            raise UsageError(
                "--hardness is a pressure: springs know forces per length only",
                "leave it out, or take line",
                place="--hardness",
            )


PROFILE: ProfileBody | None = option(
    "A profile is pressed as a line contact, nothing changing across it (forces per length, such as 10N/mm), or on a "
    "Winkler foundation, the springs of the method of dimensionality reduction. To be named: the two differ.",
    needs_whole=True,
    rich_help_panel="Reading the file",
)


def kinds_of(body: ProfileBody | None) -> dict[str, Kind]:
    """Return what a force, a pressure, a depth and a mean gap are, by their names.

    On a line forces are per unit length across it; the springs of a foundation bear a force, and a force per length.
    """
    kinds = {"force": FORCE, "pressure": PRESSURE, "depth": LENGTH, "mean_gap": LENGTH}
    if body is ProfileBody.LINE:
        return kinds | {"force": FORCE_PER_LENGTH}
    return kinds if body is None else kinds | {"pressure": replace(FORCE_PER_LENGTH, example="1N/mm")}
