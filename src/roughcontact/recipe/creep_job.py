"""The job of a history: a load that varies in time on a viscoelastic body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, ClassVar, NamedTuple

from roughcontact.errors import InputError, within
from roughcontact.files.quantity import (
    FORCE,
    FORCE_PER_LENGTH,
    LENGTH,
    PRESSURE,
    TIME,
    Kind,
    has_unit,
    parse_number,
)
from roughcontact.recipe.contact import Contact, operator_call
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.measured.leak_along import LeakAlong
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.prescribed_loads import kinds_of
from roughcontact.recipe.recipe_fields import check, described, value_of, with_fields_of
from roughcontact.recipe.source import Source
from roughcontact.recipe.texts import Amount, PureNumber, whole
from roughcontact.recipe.viscoelastic_body import ViscoelasticBody

__all__ = ["ContactOverTime", "CreepJob", "LoadHistory"]

_KINDS = (FORCE, PRESSURE, LENGTH, FORCE_PER_LENGTH)
_TIME = Amount(TIME, positive=False)
_EXAMPLE = "0s:0N,1s:10N,1000s:10N"


class _Prescribed(NamedTuple):
    """Times [s], and loads of one kind in SI; of no kind if all are 0."""

    kind: Kind | None
    times: tuple[float, ...]
    loads: tuple[float, ...]


def _history(text: str) -> _Prescribed:
    """Return the history in a list of ``time:load``."""
    times, loads, kinds = [], [], dict[Kind, str]()
    for part in (part.strip() for part in text.split(",") if part.strip()):
        time, _, load = (word.strip() for word in part.partition(":"))
        if not (time and load):
            raise InputError(f"{part!r} is not a time with a load", f"write time:load, such as {_EXAMPLE}")
        times.append(_TIME(time))
        kind, value = _load(load)
        loads.append(value)
        if kind is not None:
            kinds.setdefault(kind, load)
    if len(times) < 2:
        raise InputError(f"{text!r} holds fewer than two times", f"write two or more, such as {_EXAMPLE}")
    if len(kinds) > 1:
        one, other = list(kinds.values())[:2]
        raise InputError(
            f"{one} and {other} are loads of two kinds", "give only forces, only pressures, or only depths"
        )
    for before, after in pairwise(times):
        if after < before:
            raise InputError(
                f"times must not decrease, but {after:g} s follows {before:g} s",
                "sort them; two equal times are a jump",
            )
    kind = next(iter(kinds), None)
    if kind is not LENGTH and min(loads) < 0:
        raise InputError(
            f"a load of {min(loads):g} {'' if kind is None else kind.unit} is a tension, but without adhesion "
            "surfaces do not pull",
            "give 0 or more",
        )
    return _Prescribed(kind, tuple(times), tuple(loads))


def _load(text: str) -> tuple[Kind | None, float]:
    """Return a load in SI with the kind that its unit states; 0 needs no unit."""
    if not has_unit(text):
        if parse_number(text, "10N") == 0:
            return None, 0.0
        raise InputError(f"the load {text} has no unit", f"write {text}N, {text}Pa or {text}m")
    # First the kind whose unit it may be: others take longer to exclude.
    for kind in sorted(_KINDS, key=lambda kind: not text.endswith(kind.unit)):
        try:
            return kind, Amount(kind, positive=False)(text)
        except InputError:
            continue
    raise InputError(
        f"{text!r} is neither a force nor a pressure nor a depth", "write a load such as 10N, 10kPa or 1um"
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadHistory:
    """A load that is linear in time between given times."""

    TITLE: ClassVar = "Load in time"
    history: str = described(
        "Times with the loads at them: a comma list of time:load, linear in between. The unit of the loads makes them "
        "forces (N), nominal pressures (Pa) or depths (m). Two equal times are a jump.",
        _EXAMPLE,
        read=_history,
        default=...,
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self, profile: str | None) -> dict[str, list[float]]:
        """Return times and loads in SI, by the names of their arguments."""
        found: _Prescribed = value_of(self, "history")
        kinds = {name: kinds_of(profile)[name] for name in ("force", "pressure", "depth")}
        if found.kind is None:
            raise InputError("all loads are 0", f"give a load, such as in {_EXAMPLE}", "history")
        name = next((name for name, kind in kinds.items() if kind.unit == found.kind.unit), None)
        if name is None:
            wanted = (
                "a line contact has forces per length" if profile else "a map of heights has no such loads"
            )
            examples = " or ".join(kind.example for kind in kinds.values())
            raise InputError(
                f"the loads are those of {found.kind.name}, but {wanted}",
                f"write loads such as {examples}",
                "history",
            )
        return {"times": list(found.times), f"{name}s": list(found.loads)}


@dataclass(frozen=True, slots=True, kw_only=True)
@with_fields_of(Contact)
class ContactOverTime:
    """The model of a profile, and the tolerances of the contact conditions and of time."""

    TITLE: ClassVar = Contact.TITLE
    AT_MOST: ClassVar = ("time_tolerance", "steps")
    time_tolerance: str | None = described(
        "Largest estimated error of time over the whole history, to which the steps are adapted (default: 1e-3).",
        "1e-3",
        read=PureNumber(0, 1, "the tolerance of time", "1e-3", ends=False),
        everyday=True,
    )
    steps: str | None = described(
        "Number of equal steps between two given times instead, without an estimate of the error.",
        "20",
        read=whole(1, "the number of steps", 1_000_000),
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self) -> Iterator[Call]:
        """Yield the call that makes the body under a profile."""
        yield from operator_call(self.profile, "material.instantaneous")  # type: ignore[attr-defined]

    def named(self) -> dict[str, Any]:
        """Return its arguments, by name."""
        mine = {name: value_of(self, name) for name in self.AT_MOST}
        return Contact.named(self) | {name: value for name, value in mine.items() if value is not None}  # type: ignore[arg-type]


@dataclass(frozen=True, slots=True, kw_only=True)
class CreepJob:
    """A load that varies in time on a viscoelastic body: depth, area, stiffness and energies."""

    NAME: ClassVar = "creep"
    APART: ClassVar = {
        **dict.fromkeys(("hardness", "flow", "loop", "after", "plastic"), "plastic flow"),
        **dict.fromkeys(("work", "range", "law", "adhesion"), "adhesion"),
    }
    source: Source
    history: LoadHistory
    bodies: ViscoelasticBody
    preparation: Preparation = field(default_factory=Preparation)
    contact: ContactOverTime = field(default_factory=ContactOverTime)
    leak: LeakAlong = field(default_factory=LeakAlong)

    def __post_init__(self) -> None:
        check(self)
        with within("history"):
            self.history.named(self.profile)
        if self.leak.leak is not None and self.profile is not None:
            raise InputError(
                "`leak` does not go with `profile`: it needs a map of heights",
                "leave out one of them",
                "leak.leak",
            )

    @property
    def profile(self) -> str | None:
        """The model of a profile."""
        found: str | None = self.contact.profile  # type: ignore[attr-defined]
        return found

    def calls(self) -> Iterator[Call]:
        """Yield the call that follows the history."""
        loads = self.history.named(self.profile)
        measures = {"measures": found} if (found := self.leak.measures()) else {}
        yield Call(
            "rc.viscoelastic_curve",
            (Name("surface"), Name("material")),
            {**loads, **self.contact.named(), **measures},
            result="curve",
            place="history",
            doing="Pressing",
            fields=dict.fromkeys(loads, "history"),
        )
