"""Names and values of the parameters of a study for columns, legends and notes, in units with short numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from roughcontact.labels.engineering_units import Scale, scale

if TYPE_CHECKING:
    import xarray

__all__ = ["ParameterLabel", "parameter_labels"]


@dataclass(frozen=True, slots=True)
class ParameterLabel:
    """The title of a parameter that varies, and the texts of its values.

    Parameters
    ----------
    name : str
    scale : Scale
        The unit of its values.
    """

    name: str
    scale: Scale

    @property
    def title(self) -> str:
        """Its name and unit, such as ``rms [µm]``."""
        words = self.name.replace("_", " ")
        return f"{words} [{self.scale.unit}]" if self.scale.unit else words

    def value(self, value: Any) -> str:
        """Return a value in this unit, without the unit."""
        return f"{value * self.scale.factor:g}" if _is_number(value) else str(value)

    def equation(self, value: Any) -> str:
        """Return name, value and unit: ``rms = 0.5 µm``."""
        return f"{self.name.replace('_', ' ')} = {self.value(value)} {self.scale.unit}".rstrip()


def parameter_labels(averaged: xarray.Dataset) -> Mapping[str, ParameterLabel]:
    """Return the labels of the parameters that vary in the averages of a study, by their names."""
    from roughcontact.statistics.averages import combinations

    values: dict[str, list[Any]] = {}
    for parameters, _ in combinations(averaged):
        for name, value in parameters.items():
            values.setdefault(name, []).append(value)
    return {name: ParameterLabel(name, _scale(averaged[name], each)) for name, each in values.items()}


def _scale(parameter: xarray.DataArray, values: list[Any]) -> Scale:
    if not all(map(_is_number, values)):
        return Scale(1.0, "")
    return scale(max(map(abs, values)), parameter.attrs.get("units", ""))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
