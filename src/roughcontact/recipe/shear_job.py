"""The job of an interface under shear: a normal curve, the tangential law that follows from it, and partial slip."""

from __future__ import annotations

import math
from bisect import bisect
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError, within
from roughcontact.files.quantity import PRESSURE
from roughcontact.recipe.bodies import Bodies
from roughcontact.recipe.contact import Contact
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.plastic_flow import AfterLoad, yields_at
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.prescribed_loads import numbers, one_load
from roughcontact.recipe.recipe_fields import check, described, value_of, with_fields_of
from roughcontact.recipe.source import Source
from roughcontact.recipe.texts import Amount, PureNumber
from roughcontact.recipe.theory_job import NominalPressures

__all__ = ["Shear", "ShearJob"]

_SHARE = PureNumber(1e-3, 1, "the amplitude", "0.5")
_PER_DECADE = 10  # loads
_SPAN = 0.01  # lowest load over the lowest pressure
_APART = 1e-3  # relative: between loads that are nearer, the mean gap changes by rounding errors


def _shares(text: str) -> list[float]:
    shares = sorted({_SHARE(part) for part in text.split(",") if part.strip()})
    if not shares:
        raise InputError(f"{text!r} holds no amplitude", "write 0.5 or a comma list such as 0.1,0.5")
    return shares


@dataclass(frozen=True, slots=True, kw_only=True)
@with_fields_of(NominalPressures)
class Shear:
    """Nominal pressures, friction, and amplitudes of the tangential traction."""

    TITLE: ClassVar = "Shear"
    friction: str = described(
        "Coefficient of friction mu.",
        "0.2",
        read=PureNumber(0, 10, "the coefficient of friction", "0.2", ends=False),
        default=...,
        everyday=True,
    )
    amplitude: str = described(
        "Amplitudes of the tangential traction in a cycle, as shares of mu p, up to 1: a comma list.",
        "0.1,0.5,0.9",
        read=_shares,
        default="0.5",
        everyday=True,
    )
    shear_strength: str | None = described(
        "Largest traction that a spot bears: a note states where mu p exceeds it.",
        "300MPa",
        read=Amount(PRESSURE),
    )
    compute: bool = described(
        "Also compute the cycles at the largest pressure by partial slip, and compare. This takes much longer.",
        default=False,
        needs_whole=True,
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearJob:
    """Tangential stiffness, slip and damping per area of an interface at given pressures."""

    NAME: ClassVar = "shear"
    source: Source
    bodies: Bodies
    shear: Shear
    preparation: Preparation = field(default_factory=Preparation)
    contact: Contact = field(default_factory=Contact)
    plastic: AfterLoad = field(default_factory=AfterLoad)

    def __post_init__(self) -> None:
        check(self)
        if self.bodies.modulus is not None:
            raise InputError(
                "shear needs Poisson's ratios, which a reduced modulus does not contain",
                "give `materials`, such as steel,aluminium, or `young` and `poisson`",
                "bodies.modulus",
            )
        if self.contact.profile is not None:
            raise InputError("shear needs a map of heights", "leave `profile` out", "contact.profile")
        yields_at(self.bodies, self.plastic)
        self.curve_pressures()

    def curve_pressures(self) -> list[float]:
        """Return the pressures of the normal curve [Pa], ten a decade from a hundredth of the lowest pressure on.

        The given pressures p, p - tau/mu of the amplitudes tau, and the middle of both are among them.
        """
        pressures, shares = self._pressures(), value_of(self.shear, "amplitude")
        most = pressures[-1]
        if self.plastic.after is not None:
            with within("plastic"):
                most = one_load(self.plastic.after, PRESSURE, "after")
            if most <= pressures[-1]:
                raise InputError(
                    f"`after` {self.plastic.after} is not larger than the pressures",
                    "leave it out, or give a larger one",
                    "plastic.after",
                )
        lowest = pressures[0] * min(_SPAN, (1 - shares[-1]) / 2 or _SPAN)
        count = math.ceil(_PER_DECADE * math.log10(most / lowest))
        between = [lowest * (most / lowest) ** (k / count) for k in range(count)]
        between += [
            p * (1 - part * f) for p in pressures for f in shares for part in (0.5, 1) if part * f < 1
        ]
        loads = list(dict.fromkeys([*pressures, most]))
        for load in between:
            place = bisect(loads, load)
            if all(abs(load / each - 1) > _APART for each in loads[max(place - 1, 0) : place + 1]):
                loads.insert(place, float(f"{load:.9g}"))
        return loads

    def calls(self) -> Iterator[Call]:
        """Yield the calls that follow the loads, those of the law, and those of partial slip."""
        hardness, solver = yields_at(self.bodies, self.plastic), self.contact.named()
        named: dict[str, Any] = {} if hardness is None else {"hardness": hardness}
        named |= {"flow": "raised"} if self.plastic.flow == "raised" else {}
        function, result = ("rc.loading_curve", "curve") if hardness is None else ("rc.loading_loop", "loop")
        yield _pressed(function, "surface", {"pressures": self.curve_pressures(), **named, **solver}, result)
        solids = self.bodies.elastic()
        bodies = solids if len(solids) > 1 else solids[0]
        known = {name: value_of(self.shear, name) for name in ("friction", "shear_strength")}
        known = {name: value for name, value in known.items() if value is not None}
        yield Call("rc.shear_law", (Name(result), bodies), known, result="law", place="shear")
        pressures, shares = self._pressures(), value_of(self.shear, "amplitude")
        beside = {}
        if self.shear.compute:
            of = "surface" if hardness is None else "loop.flattened"
            yield _pressed("rc.loading_path", of, {"pressures": pressures[-1:], **solver}, "*_, solution")
            given = (Name("solution"), bodies)
            tractions = [share * known["friction"] * pressures[-1] for share in shares]
            cycles = [
                Call("rc.shear_cycle", given, known | solver | {"traction": each}) for each in tractions
            ]
            yield Call("", (cycles,), result="cycles", place="shear", doing="Partial slip")
            beside = {"cycles": Name("cycles")}
        fields = {"amplitudes": "amplitude", "traction": "amplitude"}
        table = (Name("law"), pressures, shares)
        yield Call("rc.shear_dataset", table, beside, result="shear", place="shear", fields=fields)

    def _pressures(self) -> list[float]:
        found: list[float] = numbers({"pressures": value_of(self.shear, "pressures")}).tolist()
        return found


def _pressed(function: str, surface: str, named: dict[str, Any], result: str) -> Call:
    given = (Name(surface), Name("modulus"))
    fields = {"force": "pressures"}
    return Call(function, given, named, result=result, place="shear", doing="Pressing", fields=fields)
