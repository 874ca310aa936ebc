"""A case: the computation of one sample of a study, a pure function of its parameters and a random generator.

Parameters are numbers in SI, or text with a unit: a model with a field ``size: Length`` accepts
``"1 mm"`` and ``1e-3``, and stores 0.001 for both.
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
        """Return the function that converts the text of a parameter into its value; ranges use it.

        Parameters
        ----------
        name : str
            Name of the parameter.
        beside : dict
            The other parameters, as given.

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
        """Return the parameters by name, each value in SI with its unit if it has one.

        Parameters
        ----------
        names : sequence of str, optional
            Names that the result must contain.

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
            Empty if it reads no files.

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
        Its name in study files and in the database.
    version : int
        Raise it whenever the same parameters give a different answer: it is part of every key.
    parameters : type of Parameters
        Model of its parameters.
    run : function
        ``run(parameters, rng) -> xarray.Dataset``. Pure: the same parameters and generator give the same record bit
        for bit. The record holds scalars and short arrays with their dimensions, ``units`` and ``long_name``; all
        samples of a study are laid side by side along these dimensions. A variable ``residual`` is taken as the
        certificate of the case (its largest value).
    fields : tuple of str
        Large variables of the record: stored in a separate NetCDF file, beside the database.

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


Record: TypeAlias = "xarray.Dataset"  # the result of a case

_T = TypeVar("_T")
Positive = Annotated[_T, Field(gt=0)]
"""``Positive[Length]``: a length above zero."""


def _quantity(kind: Kind) -> BeforeValidator:
    """Return a validator that converts text with a unit of this kind into its number; numbers stay unchanged."""

    def read(value: Any) -> Any:
        if isinstance(value, bool):
            raise InputError(f"{value} is not {kind.name}", f"write {kind.name} such as {kind.example!r}")
        return parse(value, kind) if isinstance(value, str) else value

    return BeforeValidator(read)


def _without_names(value: Any) -> Any:
    """Raise an error for names of materials, with the number to write instead."""
    if isinstance(value, str) and value[:1].isalpha():
        names = [part.strip() for part in value.split(",")][:2]
        elastic = [name for name in (names * 2)[:2] if name != RIGID] or names
        written = f"{reduced_modulus(*elastic) / 1e9:.4g} GPa"
        raise InputError(
            f"{value!r} is a name, but a reduced modulus is a number",
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
    # The annotations of an optional quantity are one level down.
    parts = [getattr(part, "__metadata__", ()) for part in get_args(field.annotation)]
    marks = [*field.metadata, *chain(*parts)]
    return next((unit for kind, unit in _UNITS if get_args(kind)[1] in marks), None)
