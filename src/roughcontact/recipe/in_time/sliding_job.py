"""The job of steady sliding: friction of a viscoelastic body against speed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import FORCE, PRESSURE, SPEED, parse_number
from roughcontact.recipe.contact import Contact
from roughcontact.recipe.in_time.viscoelastic_body import ViscoelasticBody
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.recipe_fields import check, described, values_of
from roughcontact.recipe.source import Source
from roughcontact.recipe.texts import Amount, rising_loads

__all__ = ["Sliding", "SlidingJob"]


def _speeds(text: str) -> Call | list[float]:
    return rising_loads(text, SPEED, "speed")


def _direction(text: str) -> tuple[float, float]:
    """Return the unit vector (x, y) of "x", "y" or an angle from x toward y, such as "30deg"."""
    if text in ("x", "y"):
        return (1.0, 0.0) if text == "x" else (0.0, 1.0)
    if not text.endswith("deg"):
        raise InputError(f"{text!r} is not a direction", "give x, y or an angle such as 30deg")
    angle = math.radians(parse_number(text.removesuffix("deg").strip(), "30deg"))
    return math.cos(angle), math.sin(angle)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sliding:
    """Load, speeds and direction of the sliding surface."""

    TITLE: ClassVar = "Sliding (pressure or force, and speeds)"
    ONE_OF: ClassVar = ("pressure", "force")
    pressure: str | None = described(
        "Nominal pressure: force over area.", "0.1MPa", read=Amount(PRESSURE), everyday=True
    )
    force: str | None = described("Normal force on the map.", "10N", read=Amount(FORCE), everyday=True)
    speeds: str = described(
        "Increasing speeds: from:to:count with equal ratios, or a comma list.",
        "1mm/s:10m/s:20",
        read=_speeds,
        default=...,
        everyday=True,
    )
    direction: str = described(
        "Direction in which the surface slides: x, along the rows; y, down the picture; or an angle from x toward y, "
        "such as 30deg.",
        "30deg",
        read=_direction,
        default="x",
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self) -> dict[str, Any]:
        """Return the arguments of `roughcontact.friction_curve` by name."""
        found = values_of(self)
        return found if self.direction != "x" else {k: v for k, v in found.items() if k != "direction"}


@dataclass(frozen=True, slots=True, kw_only=True)
class SlidingJob:
    """Steady sliding of a rough rigid surface over a viscoelastic body: hysteretic friction against speed."""

    NAME: ClassVar = "sliding"
    source: Source
    bodies: ViscoelasticBody
    sliding: Sliding
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)

    def __post_init__(self) -> None:
        check(self)
        if self.contact.profile is not None:
            raise InputError("sliding needs a map of heights", "leave `profile` out", "contact.profile")

    def calls(self) -> Iterator[Call]:
        """Yield the call that follows the speeds."""
        given, named = (Name("surface"), Name("material")), self.sliding.named() | self.contact.named()
        yield Call("rc.friction_curve", given, named, result="curve", place="sliding", doing="Sliding")
