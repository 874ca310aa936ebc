"""The flow through the gap at each load of a curve."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described
from roughcontact.recipe.texts import Choice

__all__ = ["LeakAlong"]


@dataclass(frozen=True, slots=True, kw_only=True)
class LeakAlong:
    """Whether the flow is computed at each load, along which axis, and the cells without a height."""

    TITLE: ClassVar = "Leak"
    leak: str | None = described(
        "Compute the flow through the gap at each load, for any liquid, drop and seal: hydraulic gap, transmissivity, "
        "flow factor, and whether an open path leads through the gap. Direction of the flow: 0 down the picture, along "
        "y; 1 along x.",
        read=Choice(("0", "1")),
        needs_whole=True,
    )
    missing: str = described(
        "Whether cells without a height are closed or wide open.",
        read=Choice(("closed", "open")),
        default="closed",
        needs="leak",
    )

    def __post_init__(self) -> None:
        check(self)

    def measures(self) -> list[Call]:
        """Return the call that makes the measure of the flow; empty if no flow is asked for."""
        if self.leak is None:
            return []
        given: dict[str, Any] = {"axis": int(self.leak)}
        if self.missing != "closed":
            given["missing"] = self.missing
        return [Call("rc.Transmissivity", (), given, place="leak")]
