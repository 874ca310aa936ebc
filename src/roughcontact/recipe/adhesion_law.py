"""The attraction of the two bodies across a gap."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from roughcontact.files.quantity import ENERGY_PER_AREA, LENGTH
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.texts import Amount, Choice, Likely

__all__ = ["AdhesionLaw", "Sticking"]

LAWS = ("exponential", "dugdale")  # those of `adhesion.attraction`, which imports NumPy
_WORK = described(
    "Work of adhesion: the energy that separates a unit area.",
    "50mJ/m^2",
    read=Likely(
        # Twice the surface energy of tungsten is 7 J/m^2.
        Amount(ENERGY_PER_AREA, "the work of adhesion"),
        0,
        10,
        "more than any metal has",
        "mJ/m^2",
    ),
    default=...,
    everyday=True,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sticking:
    """The work of adhesion, for an attraction of zero range."""

    TITLE: ClassVar = "Adhesion"
    work: str = _WORK

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesionLaw:
    """The attraction across a gap."""

    TITLE: ClassVar = "Adhesion"
    work: str = _WORK
    range: str = described(
        "Length over which the attraction decreases with the gap; for Dugdale's law the gap up to which it acts.",
        "20nm",
        read=Amount(LENGTH, "the range of the attraction"),
        default=...,
        everyday=True,
    )
    law: str = described(
        "Decrease of the attraction with the gap.",
        read=Choice(LAWS),
        default="exponential",
        everyday=True,
    )
    allow_unresolved: bool = described(
        "Compute even if the grid does not resolve the attraction beside a contact; the answer contains a note.",
        default=False,
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self) -> Iterator[Call]:
        """Yield the call that makes the law."""
        given = (value_of(self, "work"), value_of(self, "range"), self.law)
        named = {"allow_unresolved": True} if self.allow_unresolved else {}
        yield Call("rc.Adhesion", given, named, result="adhesion", place="adhesion")
