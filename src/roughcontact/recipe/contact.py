"""The contact of heights, for any load."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.texts import Choice, PureNumber

__all__ = ["Contact", "operator_call", "pressed"]

_TOLERANCE = "1e-8"


@dataclass(frozen=True, slots=True, kw_only=True)
class Contact:
    """The model of a profile, and the tolerance of the contact conditions."""

    TITLE: ClassVar = "Contact"
    profile: str | None = described(
        "Model of a profile: line, a line contact that is uniform across the profile (forces per length, "
        "such as 10N/mm), or winkler, the springs of the method of dimensionality reduction. Required for "
        "profiles, because results differ.",
        read=Choice(("line", "winkler")),
        needs_whole=True,
    )
    tolerance: str = described(
        "Largest residual of the contact conditions: the certificate.",
        "1e-8",
        read=PureNumber(1e-14, 1e-2, "the tolerance", "1e-8", ends=False),
        default=_TOLERANCE,
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self) -> Iterator[Call]:
        """Yield the call that makes the body under a profile."""
        yield from operator_call(self.profile, "modulus")

    def named(self) -> dict[str, Any]:
        """Return its arguments, by name."""
        found: dict[str, Any] = {} if self.profile is None else {"operator": Name("operator")}
        return found if self.tolerance == _TOLERANCE else found | {"tolerance": value_of(self, "tolerance")}


def operator_call(profile: str | None, modulus: str) -> Iterator[Call]:
    """Yield the call that makes the body under a profile, of the modulus in a variable."""
    if profile is not None:
        function = {"line": "rc.line", "winkler": "rc.foundation"}[profile]
        yield Call(
            function, (Name("surface.grid"), Name(modulus)), result="operator", place="contact.profile"
        )


def pressed(
    function: str, named: Mapping[str, Any], result: str, place: str, *, load: str | None = None
) -> Call:
    """Return the call that presses the surface by one load or several, which are in the field `load` of the place."""
    load = load or next((name for name in ("forces", "pressures", "pressure") if name in named), "force")
    given, fields = (Name("surface"), Name("modulus")), {"force": load}
    return Call(function, given, named, result=result, place=place, doing="Pressing", fields=fields)
