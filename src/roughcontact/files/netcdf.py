"""NetCDF, classic or on HDF5: the layout of contact.engineering, our own, and maps with even coordinates."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from io import BytesIO
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.bare_table import heights_alone
from roughcontact.files.file_errors import ContentError
from roughcontact.files.hdf5 import is_hdf5, opened_hdf5, require_memory_for
from roughcontact.files.heightmap import (
    Channel,
    HeightMap,
    as_heights,
    names_a_height,
    names_something_else,
    pick,
)
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.missing_marks import holds_mark
from roughcontact.files.table_axes import counts
from roughcontact.units import word_of

__all__ = ["StoredVariable", "height_map_of", "list_netcdf", "opened", "read_netcdf"]

_AGAIN = "copy the file again, or write it once more"
# Kinds of curves by a variable that only they have, the special ones first.
_CURVES = {
    "jump_lost": ("a curve of adhesive contact", "read_adhesive_curve"),
    "detachment_lost": ("a curve of detachment", "read_detachment_curve"),
    "interfacial_stiffness": ("a loading curve", "read_curve"),
}
# Coordinates and lengths are often computed in single precision.
_EVEN = 1e-5


@dataclass(frozen=True, slots=True, eq=False)
class StoredVariable:
    """One variable of an open file: its attributes, and how to load it."""

    dimensions: tuple[str, ...]
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    attributes: Mapping[str, Any]
    load: Callable[[], npt.NDArray[Any]]

    def word(self, *names: str) -> str | None:
        """Return the first of these attributes that is present, as text."""
        for name in names:
            value = self.attributes.get(name)
            if value is not None:
                return word_of(value).strip() or None
        return None

    def numbers(self) -> npt.NDArray[np.float64]:
        """Return the values as float64, NaN where they are marked as missing."""
        values = self.load()
        # Damaged numbers are detected later, in the heights.
        with np.errstate(all="ignore"):
            if str(self.word("_Unsigned")).casefold() == "true" and values.dtype.kind == "i":
                values = values.view(values.dtype.str.replace("i", "u"))
            result = values.astype(np.float64)
            marks = (*self._stated("_FillValue"), *self._stated("missing_value"))
            result[holds_mark(result, marks) | self._invalid(result)] = np.nan
            for name, apply in (("scale_factor", np.multiply), ("add_offset", np.add)):
                if name in self.attributes:
                    result = apply(result, float(np.asarray(self.attributes[name]).reshape(-1)[0]))
        return result

    def _stated(self, name: str) -> tuple[float, ...]:
        """Return the numbers of an attribute, which may be text; empty if it is missing or holds none."""
        value = np.asarray(self.attributes.get(name, ())).reshape(-1)
        try:
            return tuple(float(number) for number in value)
        except ValueError:
            return ()

    def _invalid(self, stored: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
        """Return where stored values lie outside ``valid_min`` to ``valid_max``, or ``valid_range``.

        The limits apply to the stored values, unless these are packed into integers and the limits are not integers.
        """
        limits = self._stated("valid_range")
        low = self._stated("valid_min") or limits[:1]
        high = self._stated("valid_max") or limits[1:]
        outside = np.zeros(stored.shape, dtype=bool)
        if not (low or high):
            return outside
        names = ("valid_range", "valid_min", "valid_max")
        kinds = {np.asarray(self.attributes[name]).dtype.kind for name in names if name in self.attributes}
        factor, offset = 1.0, 0.0
        if self.dtype.kind in "iu" and kinds == {"f"}:
            factor, offset = (
                (self._stated("scale_factor") or (1.0,))[0],
                (self._stated("add_offset") or (0.0,))[0],
            )
        compared = (stored * factor + offset).astype(np.float32)
        for limit in low:
            outside |= compared < np.float32(limit)
        for limit in high:
            outside |= compared > np.float32(limit)
        return outside


def read_netcdf(data: bytes, channel: str | int | None) -> HeightMap:
    """Return one variable of two dimensions, or of one for a profile.

    It is `channel`, or ``heights``, or the only map. Dimensions ``(x, y)`` are transposed to ``(y, x)``; others are
    rows and columns in their order. The size of a cell is that of the variable ``spacing`` (y, x) [m], or follows from
    the attribute ``length`` of the coordinates, or from coordinates with even steps. A third dimension of one entry,
    such as the time, is left out. Values that count downwards are depths.
    """
    with opened(data) as (variables, attributes):
        found = height_map_of(variables, attributes, channel, "NetCDF")
        return found if found.channel == "heights" else heights_alone(found)


def height_map_of(
    variables: Mapping[str, StoredVariable],
    attributes: Mapping[str, Any],
    channel: str | int | None,
    format: str,
) -> HeightMap:
    """Return the map or the profile of heights in variables, such as those of an open file."""
    variables = {name: _of_one(variable) for name, variable in variables.items()}
    found = _channels(variables)
    if not found:
        _refuse_curves(variables)
    if channel is None and "heights" in variables:
        channel = "heights"
    name = found[pick(found, channel)].name
    chosen = variables[name]
    heights = as_heights(_checked(chosen, name))
    if "mask" in variables and variables["mask"].shape == heights.shape and name == "heights":
        heights = np.where(variables["mask"].load() != 0, np.nan, heights)
    axes = chosen.dimensions
    if axes == ("x", "y"):
        heights, axes = heights.T, ("y", "x")
    unit = chosen.word("unit", "units")
    spacing = _spacing(variables, axes, heights.shape, unit)
    silent = [axis for axis in axes if axis in variables and not variables[axis].word("unit", "units")]
    borrowed = spacing is not None and "spacing" not in variables and silent
    warning = f"its {' and '.join(silent)} state no unit, and {unit} is assumed; pass size= if that is wrong"
    down = chosen.word("positive") == "down"  # CF's word for depths
    depths = "it states that its values count downwards: they are read with the other sign"
    return HeightMap(
        -heights if down else heights,
        format,
        channel=name,
        unit=unit,
        spacing=spacing,
        periodic=_periodic(variables, axes),
        history=_history(attributes),
        warnings=(*((warning,) if borrowed else ()), *((depths,) if down else ())),
    )


def list_netcdf(data: bytes) -> tuple[Channel, ...]:
    """Return the variables that can be maps or profiles."""
    with opened(data) as (variables, _):
        return _channels({name: _of_one(variable) for name, variable in variables.items()})


@contextmanager
def opened(data: bytes) -> Iterator[tuple[dict[str, StoredVariable], Mapping[str, Any]]]:
    """Yield the variables by name and the attributes of the file; any error becomes a ContentError."""
    try:
        if data.startswith(b"CDF"):
            from scipy.io import netcdf_file

            reader: Any = netcdf_file
            with reader(BytesIO(data), "r", mmap=False) as classic:
                yield _classic(classic), dict(classic._attributes)
        elif is_hdf5(data):
            with opened_hdf5(data) as modern:
                yield _modern(modern), dict(modern.attrs)
        else:
            raise ContentError("it is not a NetCDF file", "check its extension; copy it again")
    except (
        ContentError,
        ImportError,
    ):  # a library that cannot be imported does not mean that the file is damaged
        raise
    except Exception as error:  # damaged files raise a dozen kinds of errors, even OverflowError
        reason = (str(error).strip().splitlines() or [""])[0][:120] or type(error).__name__
        raise ContentError(f"it is damaged ({reason})", _AGAIN) from error


def _classic(file: Any) -> dict[str, StoredVariable]:
    return {
        name: StoredVariable(
            tuple(v.dimensions), tuple(v.shape), v.data.dtype, dict(v._attributes), partial(_values, v)
        )
        for name, v in file.variables.items()
    }


def _of_one(variable: StoredVariable) -> StoredVariable:
    """Return a map that is stored at one time, or one of another dimension, without that dimension."""
    kept = [k for k, n in enumerate(variable.shape) if n != 1]
    if len(variable.shape) <= 2 or len(kept) != 2:
        return variable
    shape = tuple(variable.shape[k] for k in kept)
    dimensions = tuple(variable.dimensions[k] for k in kept)
    return replace(variable, dimensions=dimensions, shape=shape, load=lambda: variable.load().reshape(shape))


def _modern(opened: Any) -> dict[str, StoredVariable]:
    """Return the data sets of an HDF5 file; the names of their dimensions are those of the scales attached."""
    found = {}
    for name, values in opened.items():
        # Groups have no shape; a dimension without values has a notice in its attribute NAME.
        if not hasattr(values, "shape") or "not a netCDF variable" in str(values.attrs.get("NAME", "")):
            continue
        axes = [str(axis[0].name).lstrip("/") if len(axis) else "" for axis in values.dims]
        if values.is_scale and values.ndim == 1:
            axes = [name]
        attributes = {key: value for key, value in values.attrs.items() if not key.isupper()}
        load = partial(_stored, values)
        found[name] = StoredVariable(tuple(axes), values.shape, values.dtype, attributes, load)
    return found


def _stored(values: Any) -> npt.NDArray[Any]:
    require_memory_for(values)
    return _values(values)


def _values(variable: Any) -> npt.NDArray[Any]:
    return np.array(variable[...])


def _channels(variables: Mapping[str, StoredVariable]) -> tuple[Channel, ...]:
    """Return the variables that can be pressed: maps, and the profile named ``heights``."""
    maps = {
        name: v
        for name, v in variables.items()
        if (len(v.shape) >= 2 or name == "heights") and v.dtype.kind in "fiu" and name != "mask"
    }
    return tuple(
        Channel(
            name,
            v.shape[::-1] if v.dimensions == ("x", "y") else v.shape,
            v.word("unit", "units"),
            None,
            len(v.shape) <= 2
            and (names_a_height(name) or (len(maps) == 1 and not names_something_else(name))),
        )
        for name, v in maps.items()
    )


def _refuse_curves(variables: Mapping[str, StoredVariable]) -> None:
    """Refuse a file of a curve that `write` has written, and name the function that reads it."""
    for name, (what, reader) in _CURVES.items():
        if name in variables:
            raise ContentError(f"it holds {what}, not heights", f"read it with rc.{reader}")


def _checked(variable: StoredVariable, name: str) -> npt.NDArray[np.float64]:
    values = variable.numbers()
    if values.shape != variable.shape:
        raise ContentError(
            f"its {name} holds {values.shape} numbers where {variable.shape} are announced", _AGAIN
        )
    return values


def _spacing(
    variables: Mapping[str, StoredVariable],
    axes: tuple[str, ...],
    shape: tuple[int, ...],
    unit: str | None,
) -> tuple[float, ...] | None:
    """Return the cell [m] along `axes`, or None if the file does not state it for an axis."""
    own = variables.get("spacing")
    if own is not None and own.shape == (len(axes),) and is_length(own.word("unit", "units")):
        factor = length_factor(own.word("unit", "units") or "")
        return tuple(float(step) * factor for step in own.numbers())
    steps = [
        _step(variables[axis], axis, n, unit) if axis in variables else None
        for axis, n in zip(axes, shape, strict=True)
    ]
    known = tuple(step for step in steps if step is not None)
    return known if len(known) == len(steps) else None


def _step(coordinate: StoredVariable, axis: str, count: int, unit: str | None) -> float | None:
    """Return the step [m] of a coordinate from its length or its values, which must not contradict each other."""
    own = coordinate.word("unit", "units")
    unit = own or unit
    if not is_length(unit) or coordinate.shape != (count,) or count < 2:
        return None
    places = coordinate.numbers()
    if own is None and counts(places):
        return None  # the coordinates number the points
    with np.errstate(all="ignore"):  # infinite coordinates
        steps = np.diff(places)
        step = (places[-1] - places[0]) / (count - 1)
        uneven = np.abs(steps - step)
    slack = _EVEN * np.abs(places).max()
    # A zero or NaN step passes here and is refused later as a size of a cell.
    if (uneven > slack).any():
        raise ContentError(
            f"its coordinates along {axis} are not even", "interpolate to a regular grid first"
        )
    if "length" in coordinate.attributes:
        length = float(np.asarray(coordinate.attributes["length"]).reshape(-1)[0])
        if not abs(length / count - abs(step)) <= slack:
            raise ContentError(
                f"its length {length:g} along {axis} contradicts {count} steps of {step:g}", _AGAIN
            )
        step = length / count
    return abs(float(step)) * length_factor(unit or "")


def _periodic(variables: Mapping[str, StoredVariable], axes: tuple[str, ...]) -> tuple[bool, ...]:
    own = variables.get("periodic")
    if own is not None and own.shape == (len(axes),) and own.dtype.kind in "biu":
        return tuple(bool(value) for value in own.load())
    return tuple(
        bool(np.asarray(variables[axis].attributes.get("periodic", 0)).reshape(-1)[0])
        if axis in variables
        else False
        for axis in axes
    )


def _history(attributes: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the provenance that this package writes."""
    return tuple(line for line in word_of(attributes.get("input_surface", "")).split("\n") if line)
