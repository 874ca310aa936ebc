"""Ultrasound at the joint: frequency of the wave, and densities of the bodies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import DENSITY, FREQUENCY
from roughcontact.recipe.bodies import Bodies, of_both
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.texts import METALS, Amount, Likely

__all__ = ["Ultrasound"]

_FREQUENCY = Likely(Amount(FREQUENCY), 1e4, 1e10, "no ultrasound", "MHz")
_DENSITY = Likely(Amount(DENSITY), 100, 1e5, "no density of a solid", "g/cm^3")


@dataclass(frozen=True, slots=True, kw_only=True)
class Ultrasound:
    """The wave whose reflection at the joint is computed."""

    TITLE: ClassVar = "Ultrasound"
    frequency: str | None = described(
        "Frequency of a normal longitudinal wave. Its reflection is computed from K/A0, and how much less certain "
        "a K/A0 is that is inferred from a measured reflection.",
        "5MHz",
        read=_FREQUENCY,
    )
    density: str | None = described(
        "Density of both bodies, or two values for the two bodies: numbers or names of materials (default: that of "
        "the materials).",
        "7850kg/m^3[,...]",
        read=of_both(_DENSITY, "density"),
        needs="frequency",
        names=METALS,
    )

    def __post_init__(self) -> None:
        check(self)

    def require(self, bodies: Bodies, profile: str | None) -> None:
        """Raise an error if a frequency is given for a profile, or without two bodies and their densities."""
        if self.frequency is None:
            return
        if profile is not None:
            raise InputError(
                "`frequency` needs a map of heights, not a profile", "leave it out", "ultrasound.frequency"
            )
        if len(bodies.elastic()) != 2:
            raise InputError(
                "`frequency` needs two elastic bodies; E* does not determine the speed of sound",
                "name both by `materials`, such as steel,aluminium",
                "ultrasound.frequency",
            )
        for name in ("poisson", "poisson2"):
            if value_of(bodies, name) == 0.5:
                raise InputError(
                    f"`{name}` 0.5 has an infinite speed of sound",
                    "give a smaller one, such as 0.49",
                    f"bodies.{name}",
                )
        if bodies.young is not None and self.density is None:
            raise InputError(
                "`frequency` and `young` are given without `density`",
                "give `density`, such as 7850kg/m^3,2700kg/m^3",
                "ultrasound.density",
            )

    def calls(self, contact: str, bodies: Bodies) -> Iterator[Call]:
        """Yield the call that returns the reflection of a variable, a curve or a dataset, if a frequency is given."""
        if self.frequency is not None:
            densities = value_of(self, "density")
            yield Call(
                "rc.reflection",
                (Name(contact), bodies.elastic(), value_of(self, "frequency")),
                {} if densities is None else {"densities": densities},
                result="reflection",
                place="reflection",
            )
