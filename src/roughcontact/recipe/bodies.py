"""The two bodies: elastic constants, hardness of the softer body, resistivity and conductivity."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import CONDUCTIVITY, HARDNESS, RESISTIVITY
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.texts import (
    METALS,
    RIGID,
    Amount,
    Choice,
    Likely,
    PureNumber,
    known_material,
    modulus,
)

__all__ = ["Bodies", "Conduction", "hardness_of", "of_both"]

_YOUNG = modulus("Young's modulus")
_POISSON = PureNumber(-0.99, 0.5, "Poisson's ratio", "0.3")


def _pair_of_materials(text: str) -> tuple[str, str]:
    """Return the names of two materials, of which one may be rigid."""
    names = [part.strip() for part in text.split(",")]
    if len(names) != 2 or not all(names):
        raise InputError(
            f"{text!r} does not name two bodies",
            "name both, such as steel,aluminium or steel,steel or steel,rigid",
        )
    for name in names:
        if name.lower() != RIGID and known_material(name) is None:
            raise InputError(f"{name!r} is not a name", "give a number of yours as `young` or `modulus`")
    one, other = map(str.lower, names)
    if one == other == RIGID:
        raise InputError("one of the two bodies must be elastic", "name a material, such as steel,rigid")
    return one, other


def hardness_of(text: str) -> Call | float:
    """Return a hardness [Pa], or the call that returns that of a material."""
    if (material := known_material(text)) is not None:
        return Call("rc.handbook", (material.name,), attribute="hardness")
    return modulus("a hardness", HARDNESS)(text)


@dataclass(frozen=True, slots=True, kw_only=True)
class Bodies:
    """Two half-spaces: by a reduced modulus, by the names of materials, or by Young's moduli and Poisson's ratios."""

    TITLE: ClassVar = "The two bodies"
    ONE_OF: ClassVar = ("modulus", "materials", "young")
    modulus: str | None = described(
        "Reduced modulus E*.", "110GPa", read=modulus("the reduced modulus"), everyday=True
    )
    materials: str | None = described(
        f"Names of both bodies: {', '.join(METALS)}; or rigid for one of them.",
        "steel,aluminium",
        read=_pair_of_materials,
        everyday=True,
        names=(*METALS, RIGID),
    )
    young: str | None = described("Young's modulus.", "210GPa", read=_YOUNG, everyday=True)
    poisson: str | None = described("Poisson's ratio.", "0.3", read=_POISSON, needs="young", everyday=True)
    young2: str | None = described(
        "Young's modulus of the other body (default: rigid).", "70GPa", read=_YOUNG, needs="young"
    )
    poisson2: str | None = described(
        "Poisson's ratio of the other body.", "0.33", read=_POISSON, needs="young2"
    )

    def __post_init__(self) -> None:
        check(self)
        for young, poisson in (("young", "poisson"), ("young2", "poisson2")):
            if getattr(self, young) is not None and getattr(self, poisson) is None:
                raise InputError(
                    f"`{young}` is given without `{poisson}`", f"give `{poisson}`, such as 0.3", poisson
                )

    def calls(self) -> Iterator[Call]:
        """Yield the call that returns the reduced modulus, or the materials with their hardness."""
        function = "" if self.young is None else "rc.reduced_modulus"
        given = self.elastic()
        if self.young is None:
            given = (given or value_of(self, "modulus"),)
        yield Call(function, given, result="modulus", place="bodies")

    def elastic(self) -> tuple[Any, ...]:
        """Return the materials or solids that are not rigid; none for a reduced modulus."""
        if self.materials is not None:
            return tuple(name for name in value_of(self, "materials") if name != RIGID)
        pairs = (("young", "poisson"), ("young2", "poisson2"))
        return tuple(
            Call("rc.Solid", tuple(value_of(self, name) for name in pair))
            for pair in pairs
            if getattr(self, pair[0]) is not None
        )

    @property
    def softer(self) -> str | None:
        """The name of the softer of two named materials; None if they are not named."""
        if self.materials is None:
            return None
        from roughcontact.materials import handbook

        return str(min(self.elastic(), key=lambda name: handbook(name).hardness))


# Carbon has 0.1 mohm*m at most, and metals 2 uohm*m.
_RESISTIVITY = Likely(
    Amount(RESISTIVITY, positive=False, zero=True), 0, 1e-3, "far above any metal or carbon", "nohm*m"
)
_CONDUCTIVITY = Amount(CONDUCTIVITY, positive=False, zero=True)


def of_both(amount: Amount | Likely, name: str) -> Callable[[str], tuple[Call | float, Call | float]]:
    """Return a reader of a property of both bodies: numbers with units or names of materials, or one for both."""
    kind = amount.kind

    def read(text: str) -> tuple[Call | float, Call | float]:
        parts = [part for part in text.split(",") if part.strip()]
        if len(parts) not in (1, 2):
            raise InputError(
                f"{text!r} contains {len(parts)} values for two bodies",
                f"give one for both or two, such as {kind.example},{kind.example}, or names such as steel,aluminium",
            )
        values: list[Call | float] = [
            amount(part)
            if (material := known_material(part)) is None
            else Call("rc.handbook", (material.name,), attribute=name)
            for part in parts
        ]
        if values[0] == values[-1] == 0:
            raise InputError(f"both bodies have the {name} 0", f"give one such as {kind.example}")
        return values[0], values[-1]

    return read


@dataclass(frozen=True, slots=True, kw_only=True)
class Conduction:
    """Resistivity and conductivity of the two bodies."""

    TITLE: ClassVar = "Conduction"
    resistivity: str | None = described(
        "Electrical resistivity of both bodies, or two values for the two bodies: numbers or names of "
        "materials such as copper,gold. The resistance of the contact is computed.",
        "17nohm*m[,...]",
        read=of_both(_RESISTIVITY, "resistivity"),
        names=METALS,
    )
    conductivity: str | None = described(
        "Thermal conductivity of both bodies, in the same form.",
        "400W/m/K[,...]",
        read=of_both(_CONDUCTIVITY, "conductivity"),
        names=METALS,
    )
    of: str = described(
        "Conductance and resistance of the interface only, per area, or the total of this patch between two "
        "half-spaces, including its spreading resistance.",
        read=Choice(("interface", "total")),
        default="interface",
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self) -> dict[str, Any]:
        """Return the arguments of `roughcontact.conductance` by name; empty if none is given."""
        pairs = {
            "resistivities": value_of(self, "resistivity"),
            "conductivities": value_of(self, "conductivity"),
        }
        return {name: pair for name, pair in pairs.items() if pair is not None}
