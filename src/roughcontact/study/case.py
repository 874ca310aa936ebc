"""A case: what one sample of a study computes, as a pure function of its parameters and a random generator.

Parameters are numbers in SI, or text with a unit: a model that has a field ``size: Length`` takes ``1e-3`` as well as
``"1 mm"``, and holds 0.001 in both cases.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias, TypeVar, get_args

import numpy as np
from pydantic import BeforeValidator, Field, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from roughcontact.errors import InputError
from roughcontact.files.quantity import ENERGY_PER_AREA, FORCE, LENGTH, MODULUS, PRESSURE, Kind, parse
from roughcontact.materials import reduced_modulus
from roughcontact.recipe.texts import RIGID
from roughcontact.study.checked import Checked
from roughcontact.study.nested_names import at
from roughcontact.study.study_errors import mistakes_of, refusal

if TYPE_CHECKING:
    import xarray

__all__ = [
    "Area",
    "Case",
    "Energy",
    "EnergyPerArea",
    "Force",
    "Length",
    "Modulus",
    "Parameters",
    "Positive",
    "Pressure",
    "Record",
    "Stiffness",
]


class Parameters(Checked):
    """The parameters of a case: a model whose fields have types and limits; unknown names are refused.

    Examples
    --------
    >>> import roughcontact as rc
    >>> class Block(rc.study.Parameters):
    ...     side: rc.study.Positive[rc.study.Length]
    >>> Block(side="2 mm").side, Block(side="2 mm").labelled()
    (0.002, {'side': (0.002, 'm')})
    """

    @classmethod
    def reader(cls, name: str, beside: Mapping[str, Any]) -> Callable[[Any], Any]:
        """Return what turns the text of a parameter into its value: ranges are made with it.

        Parameters
        ----------
        name : str
            Of the parameter.
        beside : dict
            The other parameters, as they are given.

        Returns
        -------
        function
            Takes text or a number and returns the number.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.study.find_case("curve").parameters.reader("size", {})("2 mm")
        0.002
        """
        field = cls.model_fields[name]
        reader: TypeAdapter[Any] = TypeAdapter(Annotated[field.annotation, field])  # type: ignore[arg-type]

        def read(value: Any) -> Any:
            try:
                return reader.validate_python(value)
            except ValidationError as error:
                raise refusal(mistakes_of(error)) from None

        return read

    def labelled(self, names: Iterable[str] = ()) -> dict[str, tuple[Any, str | None]]:
        """Return what is given by name, each value with its unit in SI if it has one.

        Parameters
        ----------
        names : sequence of str, optional
            What is to be there in any case.

        Returns
        -------
        dict of str to tuple
            The values of an export.
        """
        values = self.model_dump(mode="json")
        found = {name: (each, _unit(type(self).model_fields[name])) for name, each in values.items()}
        return found | {name: (at(values, name), None) for name in names if name not in found}

    def inputs(self) -> dict[str, str]:
        """Return the SHA-256 of the files that the case reads, by their names.

        Returns
        -------
        dict of str to str
            Empty where it reads none.

        Examples
        --------
        >>> import roughcontact as rc
        >>> class Block(rc.study.Parameters):
        ...     side: rc.study.Length
        >>> Block(side=1.0).inputs()  # the case "job" names the files of its source
        {}
        """
        return {}


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
    run: Callable[[Any, np.random.Generator], Record]
    fields: tuple[str, ...] = ()


Record: TypeAlias = "xarray.Dataset"  # what a case returns

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


def _without_names(value: Any) -> Any:
    """Refuse the names of materials with the number to write instead: a reduced modulus is that of two bodies."""
    if isinstance(value, str) and value[:1].isalpha():
        names = [part.strip() for part in value.split(",")][:2]
        elastic = [name for name in (names * 2)[:2] if name != RIGID] or names
        written = f"{reduced_modulus(*elastic) / 1e9:.4g} GPa"
        raise InputError(
            f"{value!r} is a name, and a reduced modulus is a number",
            f"write {written!r}, that of {names[0]} and {names[-1]}",
        )
    return value


Length = Annotated[float, _quantity(LENGTH)]
Pressure = Annotated[float, _quantity(PRESSURE)]
Modulus = Annotated[float, _quantity(MODULUS), BeforeValidator(_without_names)]
Force = Annotated[float, _quantity(FORCE)]
Area = Annotated[float, _quantity(Kind("an area", "m**2", "1mm**2"))]
Stiffness = Annotated[float, _quantity(Kind("a stiffness", "N/m", "1MN/m"))]
Energy = Annotated[float, _quantity(Kind("an energy", "J", "1mJ"))]
EnergyPerArea = Annotated[float, _quantity(ENERGY_PER_AREA)]
_UNITS = (
    *(
        (Length, "m"),
        (Area, "m2"),
        (Pressure, "Pa"),
        (Modulus, "Pa"),
        (Force, "N"),
        (Stiffness, "N m-1"),
        (Energy, "J"),
    ),
    (EnergyPerArea, "J m-2"),
)


def _unit(field: FieldInfo) -> str | None:
    """Return the SI unit of a parameter that is declared as a quantity."""
    # A quantity that may be none carries its marks one level down.
    parts = [getattr(part, "__metadata__", ()) for part in get_args(field.annotation)]
    marks = [*field.metadata, *chain(*parts)]
    return next((unit for kind, unit in _UNITS if get_args(kind)[1] in marks), None)
