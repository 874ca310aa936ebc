"""The job of a leak: one load, and what flows through the gap that it leaves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import DENSITY, LENGTH, PRESSURE, VISCOSITY
from roughcontact.recipe.bodies import Bodies
from roughcontact.recipe.contact import Contact
from roughcontact.recipe.elastic_jobs import PressJob
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.measured.heat_parts import GASES, gas_with
from roughcontact.recipe.plastic_flow import AfterLoad
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.prescribed_loads import OneLoad
from roughcontact.recipe.recipe_fields import check, described, values_of
from roughcontact.recipe.source import Source
from roughcontact.recipe.texts import Amount, Choice

__all__ = ["Fluid", "LeakJob", "Seal"]

_ABSOLUTE = Amount(PRESSURE, positive=False, zero=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Fluid:
    """A liquid by its viscosity, or a gas by its name."""

    TITLE: ClassVar = "Fluid (a liquid or a gas)"
    ONE_OF: ClassVar = ("viscosity", "gas")
    viscosity: str | None = described(
        "Dynamic viscosity of a liquid.", "1mPa*s", read=Amount(VISCOSITY), everyday=True
    )
    density: str | None = described(
        "Density of the liquid, for its mass flow.", "1000kg/m^3", read=Amount(DENSITY), needs="viscosity"
    )
    vapour_pressure: str | None = described(
        "Pressure below which the liquid boils.", "2.3kPa", read=_ABSOLUTE, needs="viscosity"
    )
    gas: str | None = described(
        "An ideal gas: name and temperature.", "air,20degC", read=gas_with("temperature"), names=GASES
    )

    def __post_init__(self) -> None:
        check(self)

    def call(self) -> Call:
        """Return the call that makes the fluid."""
        named = values_of(self)
        made = named.pop("gas") if "gas" in named else Call("rc.Liquid", (), named)
        return replace(made, result="fluid", place="fluid")


@dataclass(frozen=True, slots=True, kw_only=True)
class Seal:
    """The pressures on both sides, and the seal of which the map is a sample."""

    TITLE: ClassVar = "Seal"
    ONE_OF: ClassVar = ("drop", "upstream")
    drop: str | None = described(
        "Drop of the pressure of a liquid.", "1bar", read=Amount(PRESSURE), everyday=True
    )
    upstream: str | None = described(
        "Absolute pressure before the seal.", "2bar", read=Amount(PRESSURE), needs="downstream"
    )
    downstream: str | None = described(
        "Absolute pressure behind it; 0 is vacuum.", "1bar", read=_ABSOLUTE, needs="upstream"
    )
    axis: str = described(
        "Direction of the flow: 0 down the picture, along y; 1 along x.", read=Choice(("0", "1")), default="0"
    )
    seal_width: str | None = described(
        "Length of the seal along the flow; required for a periodic map (default: the map is the seal).",
        "1mm",
        read=Amount(LENGTH),
        needs="circumference",
        everyday=True,
    )
    circumference: str | None = described(
        "Length of the seal across the flow.", "0.1m", read=Amount(LENGTH), needs="seal_width", everyday=True
    )
    missing: str = described(
        "Whether cells without a height are closed or wide open. The leak rate of the other choice is printed too.",
        read=Choice(("closed", "open")),
        default="closed",
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self) -> dict[str, Any]:
        """Return the arguments of `roughcontact.leak` by name."""
        return values_of(self) | {"axis": int(self.axis)}


@dataclass(frozen=True, slots=True, kw_only=True)
class LeakJob:
    """One load, and the leak rate of a liquid or gas through the gap."""

    NAME: ClassVar = "leak"
    source: Source
    load: OneLoad
    bodies: Bodies
    fluid: Fluid
    seal: Seal
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)
    plastic: AfterLoad = field(default_factory=AfterLoad)

    def __post_init__(self) -> None:
        check(self)
        _ = self.pressed
        if self.contact.profile is not None:
            raise InputError("a leak needs a map of heights", "leave `profile` out", "contact.profile")
        if self.fluid.gas is not None and self.seal.drop is not None:
            raise InputError(
                "the flow of a gas depends on the absolute pressures on both sides, not only on their difference",
                "give `upstream` and `downstream` in place of `drop`",
                "seal.drop",
            )

    @property
    def pressed(self) -> PressJob:
        """The job that presses the surface."""
        parts = ("source", "load", "bodies", "preparation", "contact", "plastic")
        return PressJob(**{name: getattr(self, name) for name in parts})

    def calls(self) -> Iterator[Call]:
        """Yield the calls that press, and those of the flow."""
        yield from self.pressed.calls()
        yield self.fluid.call()
        given = (Name("solution"), Name("fluid"))
        yield Call("rc.leak", given, self.seal.named(), result="leak", place="seal", doing="Flow")
