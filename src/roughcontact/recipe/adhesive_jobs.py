"""Jobs of adhesive surfaces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError, within
from roughcontact.files.quantity import LENGTH
from roughcontact.recipe.adhesion_law import AdhesionLaw, Sticking
from roughcontact.recipe.bodies import Bodies
from roughcontact.recipe.contact import Contact, pressed
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.prescribed_loads import AdhesiveLoad, AdhesiveLoads, FallingLoads, OneLoad
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.source import Source
from roughcontact.recipe.texts import Amount, whole

__all__ = ["AdhesiveCurveJob", "AdhesiveLoopJob", "AdhesivePressJob", "DetachJob"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Turn:
    """The loop of an adhesive surface."""

    TITLE: ClassVar = "Loads"
    depth: str = described(
        "Indentation depth at which the retreat begins; it may be negative.",
        "20nm",
        read=Amount(LENGTH, positive=False),
        default=...,
        everyday=True,
    )
    points: str = described(
        "Number of equal steps in depth of the approach; the retreat has the same steps.",
        "N",
        read=whole(2, "the number of steps", 10_000),
        default="40",
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesivePressJob:
    """One state of adhesive surfaces."""

    NAME: ClassVar = "adhesion press"
    source: Source
    load: AdhesiveLoad
    bodies: Bodies
    adhesion: AdhesionLaw
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)

    def __post_init__(self) -> None:
        check(self)
        with within("load"):
            self.load.named(self.contact.profile)

    def calls(self) -> Iterator[Call]:
        """Yield the calls that find the state."""
        yield from self.adhesion.calls()
        yield _sticking(
            "rc.adhesive_state", self.load.named(self.contact.profile) | self.contact.named(), "state"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesiveCurveJob:
    """Loads of either sign on adhesive surfaces."""

    NAME: ClassVar = "adhesion curve"
    source: Source
    loads: AdhesiveLoads
    bodies: Bodies
    adhesion: AdhesionLaw
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)

    def __post_init__(self) -> None:
        check(self)
        with within("loads"):
            self.loads.named(self.contact.profile)

    def calls(self) -> Iterator[Call]:
        """Yield the calls that follow the loads."""
        yield from self.adhesion.calls()
        yield _sticking(
            "rc.adhesive_curve", self.loads.named(self.contact.profile) | self.contact.named(), "curve"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesiveLoopJob:
    """An approach and a retreat of adhesive surfaces."""

    NAME: ClassVar = "adhesion loop"
    source: Source
    turn: Turn
    bodies: Bodies
    adhesion: AdhesionLaw
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)

    def __post_init__(self) -> None:
        check(self)

    def calls(self) -> Iterator[Call]:
        """Yield the calls that follow the loop."""
        yield from self.adhesion.calls()
        named = {name: value_of(self.turn, name) for name in ("depth", "points")}
        yield _sticking("rc.adhesive_loop", named | self.contact.named(), "curve")


@dataclass(frozen=True, slots=True, kw_only=True)
class DetachJob:
    """A surface that was pressed, has stuck, and is retracted."""

    NAME: ClassVar = "adhesion detach"
    source: Source
    load: OneLoad
    bodies: Bodies
    adhesion: Sticking
    retreat: FallingLoads = field(default_factory=FallingLoads)
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)

    def __post_init__(self) -> None:
        check(self)
        with within("load"):
            load = self.load.named(self.contact.profile)
        with within("retreat"):
            retreat = self.retreat.named(self.contact.profile)
        for name, value in load.items():
            first = retreat.get(f"{name}s", [value])[0]
            if first > value:
                raise InputError(
                    f"the retreat begins at a {name} of {value:g}, and {first:g} is above it",
                    f"press to that {name}, or begin with {value:g} or less",
                    f"retreat.{name}s",
                )

    def calls(self) -> Iterator[Call]:
        """Yield the calls that press the surface and retract it."""
        load = self.load.named(self.contact.profile) | self.contact.named()
        yield pressed("rc.press", load, "solution", "load")
        given = (Name("solution"), value_of(self.adhesion, "work"))
        retreat = self.retreat.named(self.contact.profile)
        yield Call(
            "rc.detachment_curve", given, retreat, result="curve", place="retreat", doing="Drawing back"
        )


def _sticking(function: str, named: Mapping[str, Any], result: str) -> Call:
    given = (Name("surface"), Name("modulus"), Name("adhesion"))
    return Call(function, given, named, result=result, place="loads", doing="Approach and retreat")
