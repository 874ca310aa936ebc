"""A field of a recipe, declared once: options of commands, forms, files and checks derive from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import MISSING, Field, dataclass, field, fields
from functools import cache
from numbers import Integral, Real
from typing import Any, TypeVar, get_args, get_type_hints

from roughcontact.errors import InputError, placed, together

__all__ = [
    "Spec",
    "check",
    "described",
    "given",
    "hints_of",
    "option_of",
    "refused",
    "require_with",
    "specs",
    "value_of",
    "values_of",
    "with_fields_of",
    "words_of",
]

_T = TypeVar("_T")


@dataclass(frozen=True, slots=True)
class Spec:
    """The description of a field beside its name, its type and its default.

    Parameters
    ----------
    help : str
        Its meaning, in a sentence or two, for people.
    example : str or None
        An example of its value; None for a flag and for a choice.
    read : function
        Turns the text of the user into the value, in SI; raises `InputError` for an invalid text.
    choices : tuple of str
        The possible texts, if they can be listed.
    names : tuple of str
        Words that it may contain, separated by commas, for completion.
    needs : str or None
        The field of the same part without which this one has no meaning.
    everyday : bool
        Whether most users need it: the short help shows it, and a form shows it at the top.
    needs_whole : bool
        Whether it needs the whole surface, of which each of several processes only holds some rows.
    option : bool
        Whether a command takes it as an option.
    positional : bool
        Whether a command takes it without the name of an option.
    opposite : str or None
        For a flag with a third state, not given: the option for its contrary.
    step : Any
        For a preparation: the method that takes the value; see `roughcontact.recipe.preparation`.
    """

    help: str
    example: str | None
    read: Callable[[Any], Any]
    choices: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    needs: str | None = None
    everyday: bool = False
    needs_whole: bool = False
    option: bool = True
    positional: bool = False
    opposite: str | None = None
    step: Any = None


@cache
def hints_of(kind: Any) -> dict[str, Any]:
    """Return the types of the fields of a class (cached: a study makes many parts of each class)."""
    return get_type_hints(kind)


def described(
    help: str,
    example: str | None = None,
    *,
    read: Callable[[Any], Any] = str,
    default: Any = None,
    **more: Any,
) -> Any:
    """Return the declaration of a field; the default ``...`` makes it required. `more` goes to its `Spec`.

    If `read` has ``choices`` or ``names``, the field takes them.
    """
    listed = {name: getattr(read, name) for name in ("choices", "names") if hasattr(read, name)}
    spec = Spec(help, example, read, **(listed | more))
    return field(default=MISSING if default is ... else default, metadata={"spec": spec})


def specs(part: Any) -> Iterator[tuple[Field[Any], Spec]]:
    """Yield the fields of a part, a value or its class, with their descriptions."""
    for each in fields(part):
        if (spec := each.metadata.get("spec")) is not None:
            yield each, spec


def with_fields_of(other: Any) -> Callable[[type[_T]], type[_T]]:
    """Return a decorator for a class before `dataclass`: it prepends the fields of another part."""

    def extended(kind: type[_T]) -> type[_T]:
        for each in fields(other):
            setattr(kind, each.name, field(default=each.default, metadata=each.metadata))
        kind.__annotations__ = {each.name: each.type for each in fields(other)} | kind.__annotations__
        return kind

    return extended


def given(part: Any) -> dict[str, Any]:
    """Return the fields of a part that differ from their defaults, by name: only these must be stored."""
    return {each.name: value for each in fields(part) if (value := getattr(part, each.name)) != each.default}


def value_of(part: Any, name: str) -> Any:
    """Return the value of a field in SI; None if it is not given."""
    text, spec = getattr(part, name), next(spec for each, spec in specs(part) if each.name == name)
    if text is None or isinstance(text, bool):
        return text
    with placed(name):
        return tuple(map(spec.read, text)) if isinstance(text, tuple) else spec.read(text)


def values_of(part: Any) -> dict[str, Any]:
    """Return the values of all fields in SI, by name, without those that are not given."""
    values = {each.name: value_of(part, each.name) for each, _ in specs(part)}
    return {name: value for name, value in values.items() if value is not None}


def check(part: Any) -> None:
    """Convert every field to text; raise an error for invalid, incomplete or contradictory fields.

    A field for a part must hold an instance of its class. ``ONE_OF`` of a class names fields of which exactly one
    must be given; ``AT_MOST`` those of which at most one may be given.

    Raises
    ------
    InputError
        If a value cannot be read, or contradicts other values; its place is the field.
    """
    kind: Any = type(part)
    hints = hints_of(kind)
    mistakes = []
    for each in fields(part):
        try:
            _check_field(part, each, hints[each.name])
        except InputError as error:
            mistakes.append(error)
    if mistakes:
        raise together(mistakes)
    for names, must in ((getattr(part, "ONE_OF", ()), True), (getattr(part, "AT_MOST", ()), False)):
        _require_one(part, names, must)


def require_with(part: Any, first: str, **others: str) -> None:
    """Raise an error if the first field is given without one of the others; their values are examples."""
    for name, example in others.items():
        if getattr(part, first) is not None and getattr(part, name) is None:
            raise InputError(
                f"`{first}` is given without `{name}`", f"give `{name}`, such as {example}", name
            )


def option_of(name: str) -> str:
    """Return the option of a field of this name."""
    return f"--{name.replace('_', '-')}"


def words_of(name: str, spec: Spec) -> tuple[str, ...]:
    """Return the option of a field, and its contrary if it has one."""
    return (option_of(name), *(() if spec.opposite is None else (option_of(spec.opposite),)))


def _check_field(part: Any, declared: Field[Any], hint: Any) -> None:
    name, value, spec = declared.name, getattr(part, declared.name), declared.metadata.get("spec")
    if spec is None:
        if not isinstance(value, hint):
            classes = " or ".join(each.__name__ for each in get_args(hint) or (hint,))
            raise refused(value, f"not a `{name}` of a recipe", f"give a {classes}", name)
        return
    if type(value) is type(declared.default) and value == declared.default:
        return
    wanted = True if spec.needs is None else getattr(part, spec.needs)
    if wanted is None or wanted is False:
        raise InputError(
            f"`{name}` needs `{spec.needs}`, which is not given", f"give `{spec.needs}` too", name
        )
    with placed(name):
        object.__setattr__(part, name, _as_declared(value, hint, spec.example or "".join(spec.choices[:1])))
    value_of(part, name)


def _require_one(part: Any, names: tuple[str, ...], must: bool) -> None:
    found = [name for name in names if getattr(part, name) is not None]
    if len(found) > 1:
        raise InputError(
            f"{' and '.join(map(_quoted, found))} exclude each other", "give one of them", ", ".join(found)
        )
    if must and names and not found:
        examples = {each.name: spec.example for each, spec in specs(part)}
        quoted = [*map(_quoted, names)]
        raise InputError(
            f"{' or '.join(filter(None, (', '.join(quoted[:-1]), quoted[-1])))} is required",
            f"add one, such as {_quoted(names[0])} {examples[names[0]]}",
            names[0],
        )


def _quoted(name: str) -> str:
    """Return the name of a field as quoted in messages; a command prints the option instead."""
    return f"`{name}`"


def _as_declared(value: Any, kind: Any, example: str) -> Any:
    """Return a value in the type of its field: a flag, a text, or texts, like the `example`."""
    if kind == tuple[str, ...]:
        parts = value if isinstance(value, list | tuple) else [value]
        return tuple(_text(part, example) for part in parts)
    if kind in (bool, bool | None):
        if not isinstance(value, bool):
            raise refused(value, "neither true nor false", "write true or false")
        return value
    return _text(value, example)


def _text(value: Any, example: str) -> str:
    """Return a number or a quantity as a text that can be read back."""
    if not isinstance(value, str):
        from roughcontact.units import as_text  # late, with NumPy: options are texts

        value = as_text(value)
    if isinstance(value, bool) or not isinstance(value, str | Real):
        raise refused(
            value, "neither a text nor a number", f"give one, such as {example!r}" if example else "give one"
        )
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, Integral):
        return repr(int(value))
    number = float(value)  # whole numbers are written without a decimal point
    return repr(int(number) if number.is_integer() else number)


def refused(value: Any, what: str, remedy: str, place: str | None = None) -> InputError:
    """Return the error about a value that has no text form: a function, an operator, a surface, a table."""
    from roughcontact.validation import shown  # late, with NumPy

    return InputError(f"{shown(value)} is {what}", remedy, place)
