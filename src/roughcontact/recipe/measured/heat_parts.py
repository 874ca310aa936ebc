"""Heat that crosses a joint beside the bare spots: through a gas, by radiation, and a film on the spots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import PRESSURE, RESISTANCE_AREA, has_unit, unit_in
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described, specs, value_of
from roughcontact.recipe.texts import Amount, Choice, PureNumber, temperature

__all__ = ["GASES", "HeatParts", "gas_of"]

GASES = ("air", "nitrogen", "helium", "argon")  # those of `fluid.fluids`, which imports NumPy
_ALPHA = PureNumber(0.001, 1, "an accommodation coefficient", "0.9")
_EMISSIVITY = PureNumber(0.001, 1, "an emissivity", "0.2")


def gas_of(text: str) -> Call:
    """Return the call that makes the gas of "air,1bar,20degC,alpha=0.9:0.9".

    Pressure, temperature and accommodation coefficients of both bodies follow the name in any order. Each may be left
    out.
    """
    name, *parts = (part.strip() for part in text.split(","))
    named: dict[str, Any] = {}
    for part in parts:
        word, equals, value = map(str.strip, part.partition("="))
        if equals:
            if word != "alpha":
                raise InputError(
                    f"a gas has no {word!r}", "write alpha=0.9:0.9 for the accommodation coefficients"
                )
            found: tuple[str, Any] = ("accommodation", _of_both(value, ":", _ALPHA))
        elif not has_unit(part):
            raise InputError(
                f"{part!r} has no unit", "write a pressure such as 1bar, or a temperature such as 20degC"
            )
        elif unit_in(part) in ("K", "degC", "°C"):
            found = ("temperature", temperature(part))
        else:
            found = ("pressure", Amount(PRESSURE)(part))
        if found[0] in named:
            raise InputError(f"{text!r} states the {found[0]} twice", "leave one of them out")
        named |= [found]
    return Call("rc.Gas", (Choice(GASES)(name),), named)


def _conducting(text: str) -> Call:
    """Return the call that makes a gas that conducts heat, which needs all of its parts."""
    from roughcontact.fluid import fluids  # late, with NumPy

    gas = gas_of(text)
    for name, example in (
        ("pressure", "1bar"),
        ("temperature", "20degC"),
        ("accommodation", "alpha=0.9:0.9"),
    ):
        if name not in gas.named:
            words = "coefficients of both bodies" if name == "accommodation" else "of the gas"
            raise InputError(
                f"the conductance of a gas depends on the {name} {words}, which {text!r} lacks",
                f"write {text},{example}, with your values",
            )
    gas.value({"rc": fluids})  # raises an error for a number out of range
    return gas


def _emissivities(text: str) -> tuple[float, float]:
    return _of_both(text, ",", _EMISSIVITY)


def _of_both(text: str, separator: str, number: PureNumber) -> tuple[float, float]:
    """Return a number of each body, or one for both."""
    parts = text.split(separator)
    if len(parts) > 2:
        raise InputError(
            f"{text!r} contains {len(parts)} values for two bodies",
            f"give one for both, such as {number.example}, or two, such as {number.example}{separator}{number.example}",
        )
    return number(parts[0]), number(parts[-1])


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatParts:
    """Gas in the gap, radiation across it, and a film on the spots."""

    TITLE: ClassVar = "Gas, radiation and film"
    gas: str | None = described(
        "Gas that conducts heat in the gap: name, absolute pressure, temperature, and the thermal accommodation "
        "coefficients of both bodies. Needs the conductivity of the bodies, as the other options of this group.",
        "air,1bar,20degC,alpha=0.9:0.9",
        read=_conducting,
        names=GASES,
        needs_whole=True,
    )
    emissivity: str | None = described(
        "Emissivities of both bodies, or one for both, for radiation across the gap.",
        "0.2,0.3",
        read=_emissivities,
        needs_whole=True,
    )
    temperature: str | None = described(
        "Temperature of the joint, for radiation in vacuum; that of a gas is used otherwise.",
        "20degC",
        read=temperature,
        needs="emissivity",
    )
    film: str | None = described(
        "Thermal resistance times area of a film on the spots, such as an oxide: its thickness over its conductivity. "
        "It is solved together with the constriction of the spots.",
        "0.1mm^2*K/W",
        read=Amount(RESISTANCE_AREA),
        needs_whole=True,
    )

    def __post_init__(self) -> None:
        check(self)
        if self.gas is not None and self.temperature is not None:
            raise InputError("the gas has a temperature already", "leave `temperature` out", "temperature")
        if self.emissivity is not None and self.gas is None and self.temperature is None:
            raise InputError(
                "radiation depends on the temperature", "give `temperature`, such as 20degC", "temperature"
            )

    def named(self) -> dict[str, Any]:
        """Return the arguments of `roughcontact.ConductanceParts` by name, except the conductivities; empty if none."""
        names = {"emissivity": "emissivities"}
        values = {names.get(each.name, each.name): value_of(self, each.name) for each, _ in specs(self)}
        return {name: value for name, value in values.items() if value is not None}
