"""Numbers at the border of all rooms: taken as floats, or refused with the name of the parameter and the reason."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from functools import partial, wraps
from typing import Any, ParamSpec, TypeAlias, TypeVar, overload

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.units import PLAIN, in_si

__all__ = [
    "Array",
    "Mask",
    "RngLike",
    "as_generator",
    "exactly_one",
    "finite",
    "fitting",
    "lengths_method",
    "moderate",
    "number",
    "numeric",
    "numeric_method",
    "pair",
    "positive",
    "positive_scalar",
    "require",
    "require_numbers",
    "scalar",
    "shown",
    "whole",
]

P = ParamSpec("P")
R = TypeVar("R")
F = TypeVar("F", bound=Callable[..., Any])
Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
RngLike: TypeAlias = (
    int | Sequence[int] | np.random.SeedSequence | np.random.BitGenerator | np.random.Generator | None
)
"""What `numpy.random.default_rng` takes."""

LONGEST = 60  # text of a value in a message
# What to give in place of a material, by the name of the parameter.
OF_MATERIALS = {
    "modulus": "give a number, or of materials rc.reduced_modulus('steel', 'aluminium')",
    "hardness": "give a number, or of a material rc.handbook('steel').hardness",
}
# Of sizes in between, whatever their unit, products of six are numbers of full precision.
SMALLEST, LARGEST = 1e-50, 1e50

# Annotations as they are written in the modules: of arrays that are broadcast, of single numbers, of whole ones.
ARRAYS = {"ArrayLike", "npt.ArrayLike", "float | Array"}
NUMBERS = {"float"}
WHOLE = {"int"}
OPTIONAL = " | None"
BODIES = {
    "Surface": "a Surface, as rc.read and rc.self_affine return it",
    "Solution": "a Solution, as rc.press returns it",
    "Solution | AdhesiveState": "a Solution, as rc.press returns it, or an AdhesiveState",
    "Curve": "a Curve, as rc.loading_curve returns it",
    "MeasuredCurve": "a curve, as rc.loading_curve or rc.viscoelastic_curve returns it",
    "Loop": "a Loop, as rc.loading_loop returns it",
    "Flow": "a Flow, as solution.flow holds it",
    "Adhesion": "an Adhesion, such as rc.Adhesion(work=0.05, range=2e-9)",
    "Body": "a Surface, such as rc.Surface(heights, spacing), or a RadialProfile",
}
# Classes that a name of `BODIES` stands for.
KINDS = {"Body": ("Surface", "RadialProfile"), "MeasuredCurve": ("Curve", "ViscoelasticCurve")}


def number(value: Any, what: str) -> Array:
    """Return `value` as float64, a number as a number and an array as an array.

    Parameters
    ----------
    value : array_like
        What the user gave.
    what : str
        Its name and unit, for the message: ``"force [N]"``.

    Raises
    ------
    ValueError
        If it is neither a number nor an array of numbers: a text, a material, nothing.
    """
    return _floats(value, what, "a number or an array of numbers")


def scalar(value: Any, what: str) -> float:
    """Return one number as a float.

    Parameters
    ----------
    value, what
        See `number`.

    Raises
    ------
    ValueError
        If it is not one number: an array, a text, a material, nothing. The command line reads units, this does not.
    """
    if type(value) is float:
        return value
    x = _floats(value, what, "one number")
    if np.ndim(x):
        raise about(what, f"must be one number in SI units, not an array of shape {np.shape(x)}")
    return float(x)


def finite(value: npt.ArrayLike, what: str) -> Array:
    """Return `value` as `number` does, if every number is finite."""
    x = number(value, what)
    if not (there := np.isfinite(x)).all():
        raise about(what, f"must be finite (given: {np.asarray(x)[~there].flat[0]:g})")
    return x


def moderate(value: float, what: str) -> float:
    """Return a positive size, of which products can be taken without overflow and without loss of digits.

    Raises
    ------
    ValueError
        If it is too small or too large for that.
    """
    if not SMALLEST <= value <= LARGEST:
        problem = (
            f"must lie between {SMALLEST:g} and {LARGEST:g}, where products keep their digits, not {value:g}"
        )
        raise about(what, problem, "give it in other units")
    return value


def positive(value: npt.ArrayLike, what: str, *, zero: bool = False) -> Array:
    """Return `value` as `number` does, if it is in range.

    Parameters
    ----------
    value, what
        See `number`.
    zero : bool
        Whether 0 will do.

    Raises
    ------
    ValueError
        If a value is NaN, or not positive (or 0) and finite.
    """
    x = number(value, what)
    right = np.isfinite(x) & ((x >= 0) if zero else (x > 0))
    if not right.all():
        wanted = "finite and not negative" if zero else "positive and finite"
        raise about(what, f"must be {wanted}, not {np.asarray(x)[~right].flat[0]}")
    return x


def positive_scalar(value: Any, what: str) -> float:
    """Return one positive, finite number as a float, or refuse what is not."""
    return float(positive(scalar(value, what), what))


def whole(value: int, what: str) -> int:
    """Return a whole number from 1 up, or refuse it."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
        raise about(what, f"must be a whole number, at least 1, not {shown(value)}")
    return int(value)


def pair(values: tuple[npt.ArrayLike, npt.ArrayLike], what: str) -> tuple[Array, Array]:
    """Return two positive numbers, or arrays of one shape.

    Raises
    ------
    ValueError
        If there are not two, they are not positive, or their shapes do not fit.
    """
    if not isinstance(values, tuple | list | np.ndarray) or len(values) != 2:
        raise about(what, f"must be two, such as (1e-3, 2e-3), not {shown(values)}")
    first, second = (positive(value, what) for value in values)
    if np.ndim(first) and np.ndim(second) and np.shape(first) != np.shape(second):
        raise about(what, f"must be two numbers or arrays of one shape, not {first.shape} and {second.shape}")
    return first, second


def require(
    condition: npt.ArrayLike,
    message: str,
    remedy: str | None = None,
    *,
    place: str | None = None,
    value: npt.ArrayLike | None = None,
) -> None:
    """Raise an `InputError` with the `message`, the `remedy` and the `place` unless the `condition` holds everywhere.

    The message ends with the first `value`, an array of the shape of the condition or one number, for which it does
    not hold.
    """
    right = np.asarray(condition)
    if not right.all():
        wrong = "" if value is None else f" (given: {np.broadcast_to(value, right.shape)[~right].flat[0]:g})"
        raise InputError(message + wrong, remedy, place)


def as_generator(rng: RngLike) -> np.random.Generator:
    """Return the source of random numbers that `numpy.random.default_rng` makes of a seed; a generator is its own.

    Raises
    ------
    ValueError
        If NumPy takes no such seed.
    """
    try:
        return np.random.default_rng(rng)
    except (TypeError, ValueError) as error:
        raise about(
            "rng",
            f"must be a numpy.random.Generator or a seed, not {shown(rng)}",
            "give a whole number from 0 up, such as rng=1, or None for numbers that differ from run to run",
        ) from error


def shown(value: object) -> str:
    """Return a value for a message: as it writes itself if that is short, or else of what kind it is."""
    text = repr(value)
    short = len(text) <= LONGEST and "\n" not in text
    return text if short else f"a {type(value).__name__}"


def exactly_one(**given: Any) -> tuple[str, Any]:
    """Return the name and the value of the one argument that is given; None is not.

    Raises
    ------
    ValueError
        If none is given, or more than one, with the names of both kinds.
    """
    stated = {name: value for name, value in given.items() if value is not None}
    *others, last = given
    wanted, found = f"{', '.join(others)} and {last}", " and ".join(stated)
    wrong = f", not {found}" if stated else ": none is given"
    require(len(stated) == 1, f"give exactly one of {wanted}{wrong}", place=", ".join(given))
    return stated.popitem()


@overload
def numeric(function: Callable[P, R], /) -> Callable[P, R]: ...


@overload
def numeric(
    **units: str | Callable[[Mapping[str, Any]], str],
) -> Callable[[Callable[P, R]], Callable[P, R]]: ...


def numeric(function: Any = None, /, **units: Any) -> Any:
    """Check the arguments of a function by the annotations of its parameters, before it sees them.

    ``float`` takes one number, ``int`` a whole one, ``ArrayLike`` and ``float | Array`` numbers or arrays that can
    be broadcast; none takes NaN. With ``| None`` they may be None. ``Surface``, ``Solution`` and the others of `BODIES`
    require one. Whatever else is annotated is passed on, as are all values as given: their range is the function's own
    affair. Only a value that carries a unit is converted: `units` gives the SI unit of each parameter that has a
    dimension, or how it follows from the other arguments.

    Raises
    ------
    ValueError
        From the decorated function: the parameter, what is required and what was given; or the shapes that do not fit.
    """
    if function is None:
        return partial(_checked, units=units)
    return _checked(function, units)


def numeric_method(function: F) -> F:
    """Check the arguments of a function that is a method, see `numeric`; each ``float`` of it is a number without unit.

    Type checkers take from only this signature what comes out, which they must where files import each other.
    """
    return numeric(function)  # type: ignore[return-value]


def lengths_method(function: F) -> F:
    """Check the arguments of a function that is a method, see `numeric_method`; each ``float`` of it is in metres."""
    kinds = {name: str(each.annotation) for name, each in inspect.signature(function).parameters.items()}
    lengths = [name for name, kind in kinds.items() if kind.removesuffix(OPTIONAL) == "float"]
    return numeric(**dict.fromkeys(lengths, "m"))(function)  # type: ignore[return-value]


def _checked(function: Callable[P, R], units: Mapping[str, Any]) -> Callable[P, R]:
    parameters = inspect.signature(function).parameters
    names = tuple(parameters)
    unknown = units.keys() - parameters.keys()
    if unknown:
        raise TypeError(f"{function.__qualname__} has no parameter {', '.join(sorted(unknown))}")
    kinds = {name: str(parameter.annotation) for name, parameter in parameters.items()}
    bodies = {name: kind for name, kind in kinds.items() if kind in BODIES}
    wanted = {
        name: kind for name, kind in kinds.items() if kind.removesuffix(OPTIONAL) in ARRAYS | NUMBERS | WHOLE
    }

    @wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> R:
        given = dict(zip(names, args, strict=False)) | kwargs
        shapes, converted = {}, {}
        for name, value in given.items():
            if name in bodies and not _is_a(bodies[name], value):
                raise about(name, f"must be {BODIES[kinds[name]]}, not {shown(value)}")
            if type(value) not in PLAIN and (name in units or name in wanted):
                unit = units.get(name)
                plain = in_si(value, unit(given) if callable(unit) else unit, name)
                if plain is not value:
                    value = converted[name] = plain
            if name in wanted and not (value is None and wanted[name].endswith(OPTIONAL)):
                shapes[name] = _shape(value, name, wanted[name].removesuffix(OPTIONAL))
        if any(shapes.values()):
            fitting(shapes)
        if converted:
            placed: Any = (converted.get(name, value) for name, value in zip(names, args, strict=False))
            named: Any = {name: converted.get(name, value) for name, value in kwargs.items()}
            return function(*placed, **named)
        return function(*args, **kwargs)

    return checked


def require_numbers(body: Any, **units: str) -> None:
    """Refuse a dataclass one of whose fields of type ``float`` or ``int`` holds anything else than one such number.

    A field that carries a unit becomes a plain number; `units` gives the SI unit of each field that has a dimension.

    Raises
    ------
    ValueError
        Naming the field.
    """
    for field in fields(body):
        value, kind = getattr(body, field.name), str(field.type)
        of_numbers = kind.removesuffix(OPTIONAL) in NUMBERS | WHOLE
        if of_numbers or field.name in units:
            plain = in_si(value, units.get(field.name), field.name)
            if plain is not value:
                object.__setattr__(body, field.name, plain)
            if of_numbers and not (plain is None and kind.endswith(OPTIONAL)):
                _shape(plain, field.name, kind.removesuffix(OPTIONAL))


def fitting(shapes: Mapping[str, tuple[int, ...]]) -> None:
    """Refuse shapes that cannot be broadcast against each other, with the names of what has them.

    Raises
    ------
    ValueError
        If they do not fit.
    """
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError as error:
        given = ", ".join(f"{name} {shape}" for name, shape in shapes.items() if shape)
        raise InputError(
            f"these shapes do not fit: {given}", "give numbers or arrays of one shape", ", ".join(shapes)
        ) from error


def _is_a(kind: str, value: Any) -> bool:
    """Return whether a value is of the class, or of one of the classes, of an annotation."""
    return any(one.__name__ in KINDS.get(kind, kind.split(" | ")) for one in type(value).__mro__)


def _shape(value: Any, name: str, kind: str) -> tuple[int, ...]:
    """Return the shape of a value, which must be numbers."""
    if type(value) is float and kind not in WHOLE and value == value:
        return ()
    x = number(value, name) if kind in ARRAYS else np.asarray(scalar(value, name))
    if kind in WHOLE:
        require(np.isfinite(x) and x % 1 == 0, f"{name} must be a whole number, not {value}", place=name)
    require(~np.isnan(x), f"{name} must be a number, not nan", place=name)
    return np.shape(x)


def _floats(value: Any, what: str, wanted: str) -> Array:
    """Return `value` as float64, or say that `what` must be what is `wanted`."""
    value = in_si(value, None, what)
    try:
        given = np.asarray(value)
        # Text and times would become numbers, and so would None.
        if value is None or given.dtype.kind not in "biufO":
            raise TypeError(f"numbers of kind {given.dtype}")
        plain: Array = np.asarray(given, dtype=np.float64)[()]
    except (TypeError, ValueError, OverflowError) as error:
        remedy = OF_MATERIALS.get(what.removeprefix("the ").removeprefix("reduced ").partition(" [")[0])
        raise about(what, f"must be {wanted} in SI units, not {shown(value)}", remedy) from error
    return plain
