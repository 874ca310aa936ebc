"""A case: what one sample of a study computes, as a pure function of its parameters and a random generator.

Parameters are numbers in SI, or text with a unit: a model that has a field ``size: Length`` takes ``1e-3`` as well as
``"1 mm"``, and holds 0.001 in both cases.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import numpy as np
from pydantic import BeforeValidator, Field

from roughcontact.errors import InputError
from roughcontact.files.quantity import ENERGY_PER_AREA, FORCE, LENGTH, PRESSURE, Kind, parse
from roughcontact.study.checked import Checked

if TYPE_CHECKING:
    import xarray

__all__ = [
    "Area",
    "Case",
    "Energy",
    "EnergyPerArea",
    "Force",
    "Length",
    "Parameters",
    "Positive",
    "Pressure",
    "Stiffness",
]


class Parameters(Checked):
    """The parameters of a case: a model whose fields have types and limits; unknown names are refused.

    Examples
    --------
    >>> import roughcontact as rc
    >>> class Block(rc.study.Parameters):
    ...     side: rc.study.Positive[rc.study.Length]
    >>> Block(side="2 mm").side
    0.002
    """


@dataclass(frozen=True, slots=True)
class Case:
    """A computation that a study repeats.

    Parameters
    ----------
    name : str
        What it is called in study files and in the database.
    version : int
        To be raised whenever the same parameters give another answer than before: it is part of every key.
    parameters : type of Parameters
        Model of what it takes.
    run : function
        ``run(parameters, rng) -> xarray.Dataset``. Pure: the same parameters and generator give the same record bit
        for bit. The record holds scalars and short arrays with their dimensions, ``units`` and ``long_name``; all
        samples of a study are laid side by side along these dimensions. A variable ``residual`` is taken as the
        certificate of the case (its largest value).
    fields : tuple of str
        Variables of the record that are large: kept in a NetCDF file of their own, beside the database.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray
    >>> import roughcontact as rc
    >>> class Dice(rc.study.Parameters):
    ...     sides: int = 6
    >>> def throw(parameters: Dice, rng: np.random.Generator) -> xarray.Dataset:
    ...     return xarray.Dataset({"eyes": rng.integers(1, parameters.sides, endpoint=True)})
    >>> case = rc.study.Case("dice", version=1, parameters=Dice, run=throw)  # named as "mycases:case" in a study
    >>> 1 <= case.run(Dice(), np.random.default_rng(1))["eyes"].item() <= 6
    True
    """

    name: str
    version: int
    parameters: type[Parameters]
    run: Callable[[Any, np.random.Generator], xarray.Dataset]
    fields: tuple[str, ...] = ()


_T = TypeVar("_T")
Positive = Annotated[_T, Field(gt=0)]
"""``Positive[Length]``: a length above zero."""


def _quantity(kind: Kind) -> BeforeValidator:
    """Return what turns text with a unit of that kind into its number, and leaves numbers as they are."""

    def read(value: Any) -> Any:
        if isinstance(value, bool):
            raise InputError(f"{value} is not {kind.name}", f"write {kind.name} such as {kind.example!r}")
        return parse(value, kind) if isinstance(value, str) else value

    return BeforeValidator(read)


Length = Annotated[float, _quantity(LENGTH)]
Pressure = Annotated[float, _quantity(PRESSURE)]
Force = Annotated[float, _quantity(FORCE)]
Area = Annotated[float, _quantity(Kind("an area", "m**2", "1mm**2"))]
Stiffness = Annotated[float, _quantity(Kind("a stiffness", "N/m", "1MN/m"))]
Energy = Annotated[float, _quantity(Kind("an energy", "J", "1mJ"))]
EnergyPerArea = Annotated[float, _quantity(ENERGY_PER_AREA)]
