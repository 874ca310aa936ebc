"""A job without heights: theories of a joint given by its specification."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import PRESSURE
from roughcontact.recipe.bodies import Bodies, Conduction, hardness_of
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.specified import SpecifiedJoint, specification
from roughcontact.recipe.texts import METALS, Names, rising_loads

__all__ = ["JOINT_THEORIES", "JointTheories", "NominalPressures", "TheoryJob"]

# Those of `evaluation.theory_table`, which imports NumPy.
JOINT_THEORIES = (
    *("persson", "gw", "gw-exponential", "bgt", "mikic", "cmy", "ceb", "kogut-etsion", "persson-plastic"),
    "pullen-williamson",
)


def _pressures(text: str) -> Call | list[float]:
    return rising_loads(text, PRESSURE)


@dataclass(frozen=True, slots=True, kw_only=True)
class NominalPressures:
    """Increasing nominal pressures."""

    TITLE: ClassVar = "Loads"
    pressures: str = described(
        "Nominal pressures: from:to:count with equal ratios, or a comma list.",
        "1MPa,5MPa,10MPa",
        read=_pressures,
        default=...,
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class JointTheories:
    """Theories of a joint of any size, and the hardness that some theories need."""

    TITLE: ClassVar = "Theories"
    theory: str = described(
        f"Theories of the joint: {', '.join(JOINT_THEORIES)}. mikic and cmy need sigma and slope; pullen-williamson "
        "needs only the hardness; all other theories also need the bandwidth.",
        "cmy,mikic,...",
        read=Names("theory", JOINT_THEORIES),
        default=...,
        everyday=True,
    )
    hardness: str | None = described(
        "Hardness of the softer body, or the name of its material, for plastic theories (default: that of the softer "
        "of two materials).",
        "1GPa",
        read=hardness_of,
        names=METALS,
        everyday=True,
    )

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class TheoryJob:
    """Theories of a joint given by rms height and slope: area, stiffness and conductance against pressure."""

    NAME: ClassVar = "theory"
    source: SpecifiedJoint
    bodies: Bodies
    pressures: NominalPressures
    theories: JointTheories
    conduction: Conduction = field(default_factory=Conduction)

    def __post_init__(self) -> None:
        check(self)
        if self.conduction.of != "interface":
            raise InputError(
                "a joint without a size only has the conductance of its interface",
                "leave out `of`",
                "conduction.of",
            )
        self.hardness()

    def names(self) -> tuple[str, ...]:
        """Return the names of the theories."""
        found: tuple[str, ...] = value_of(self.theories, "theory")
        return found

    def hardness(self) -> Call | float | None:
        """Return the given hardness [Pa], or that of the softer material; None if no theory needs one.

        Raises
        ------
        InputError
            If a theory needs a hardness, and none is known.
        """
        from roughcontact.theory.laws import LAWS  # late, with NumPy

        if all("hardness" not in LAWS[name].needs for name in self.names()):
            return None
        text = self.theories.hardness or self.bodies.softer
        if text is None:
            raise InputError(
                f"a theory of {self.theories.theory} needs the hardness of the softer body, which is not given",
                "give `hardness`, or both bodies as `materials`",
                "theories.hardness",
            )
        return hardness_of(text)

    def calls(self) -> Iterator[Call]:
        """Yield the calls that make the table."""
        yield specification(self.source)
        yield from self.bodies.calls()
        hardness = self.hardness()
        named: dict[str, Any] = {} if hardness is None else {"hardness": hardness}
        given = (Name("joint"), Name("modulus"), list(self.names()), value_of(self.pressures, "pressures"))
        # An error here means that the specification is incomplete.
        yield Call("rc.theory_table", given, named | self.conduction.named(), result="table", place="source")
