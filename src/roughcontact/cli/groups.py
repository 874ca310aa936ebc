"""Options that several commands share, as one parameter of each: a dataclass with a field an option."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, get_type_hints

__all__ = ["grouped"]


def grouped(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command whose parameters that are dataclasses of options are these options, side by side."""
    hints = get_type_hints(command, include_extras=True)
    flat: list[inspect.Parameter] = []
    for parameter in inspect.signature(command).parameters.values():
        kind = hints[parameter.name]
        flat += _options(kind) if is_dataclass(kind) else [parameter.replace(annotation=kind)]

    def run(**given: Any) -> None:
        command(**{name: _built(kind, name, given) for name, kind in hints.items() if name != "return"})

    flat = [each.replace(kind=inspect.Parameter.KEYWORD_ONLY) for each in flat]
    run.__signature__ = inspect.Signature(flat)  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in flat}
    run.__name__, run.__doc__ = command.__name__, command.__doc__
    return run


def _options(kind: Any) -> Iterator[inspect.Parameter]:
    """Yield the options of a group and of the groups in it."""
    hints = get_type_hints(kind, include_extras=True)
    for field in fields(kind):
        if is_dataclass(hints[field.name]):
            yield from _options(hints[field.name])
        else:
            default = inspect.Parameter.empty if field.default is MISSING else field.default
            yield inspect.Parameter(
                field.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=hints[field.name]
            )


def _built(kind: Any, name: str, given: dict[str, Any]) -> Any:
    """Return the value of one parameter: what was given, or a group made of what was."""
    if not is_dataclass(kind):
        return given[name]
    hints = get_type_hints(kind, include_extras=True)
    return kind(**{each.name: _built(hints[each.name], each.name, given) for each in fields(kind)})  # type: ignore[operator]
