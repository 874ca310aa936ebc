"""Heat that crosses a joint beside the bare spots: through a gas, by radiation, and a film on the spots."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files.quantity import PRESSURE, RESISTANCE_AREA, has_unit, unit_in
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described, specs, value_of
from roughcontact.recipe.texts import Amount, Choice, PureNumber, temperature

__all__ = ["GASES", "HeatParts", "gas_with"]

GASES = ("air", "nitrogen", "helium", "argon")  # those of `fluid.fluids`, which imports NumPy
_ALPHA = PureNumber(0.001, 1, "an accommodation coefficient", "0.9")
_EMISSIVITY = PureNumber(0.001, 1, "an emissivity", "0.2")


_OF_A_GAS = {
    "pressure": ("pressure of the gas", "1bar"),
    "temperature": ("temperature of the gas", "20degC"),
    "accommodation": ("accommodation coefficients of both bodies", "alpha=0.9:0.9"),
}


def gas_with(*needed: str) -> Callable[[str], Call]:
    """Return a reader of a gas with these arguments of `roughcontact.Gas`, such as "air,1bar,20degC,alpha=0.9:0.9".

    Pressure, temperature and accommodation coefficients follow the name in any order.
    """

    def read(text: str) -> Call:
        from roughcontact.fluid import fluids  # late, with NumPy

        name, *parts = (part.strip() for part in text.split(","))
        found = [("name", Choice(GASES)(name)), *map(_of_a_gas, parts)]
        named: dict[str, Any] = dict(found)
        if len(named) < len(found):
            twice = next(key for key, _ in found if [each for each, _ in found].count(key) > 1)
            raise InputError(f"{text!r} states the {twice} twice", "leave one of them out")
        for key, (words, example) in _OF_A_GAS.items():
            if key in needed and key not in named:
                raise InputError(f"{text!r} lacks the {words}", f"write {text},{example}, with your values")
            if key in named and key not in needed:
                raise InputError(f"{text!r} states the {words}, which is not used here", "leave it out")
        gas = Call("rc.Gas", (named.pop("name"),), named)
        gas.value({"rc": fluids})  # raises an error for a number out of range
        return gas

    return read


def _of_a_gas(part: str) -> tuple[str, Any]:
    """Return an argument of a gas by its name."""
    word, equals, value = map(str.strip, part.partition("="))
    if equals and word != "alpha":
        raise InputError(f"a gas has no {word!r}", "write alpha=0.9:0.9 for the accommodation coefficients")
    if equals:
        return "accommodation", _of_both(value, ":", _ALPHA)
    if not has_unit(part):
        raise InputError(
            f"{part!r} has no unit", "write a pressure such as 1bar, or a temperature such as 20degC"
        )
    if unit_in(part) in ("K", "degC", "°C"):
        return "temperature", temperature(part)
    return "pressure", Amount(PRESSURE)(part)


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
        read=gas_with(*_OF_A_GAS),
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
