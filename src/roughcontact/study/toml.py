"""Values as text in TOML, as `tomllib` reads them back."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

from roughcontact.errors import InputError

__all__ = ["toml_of"]


def toml_of(
    head: Mapping[str, Any],
    tables: Mapping[str, Mapping[str, Any]],
    arrays: Mapping[str, Sequence[Mapping[str, Any]]],
) -> str:
    """Return single values, then tables, then arrays of tables; empty ones are left out.

    Raises
    ------
    ValueError
        If a value has no place in TOML.
    """
    parts = [_lines(head)]
    parts += [f"[{_key(name)}]\n{_lines(table)}" for name, table in tables.items() if table]
    parts += [f"[[{_key(name)}]]\n{_lines(each)}" for name, array in arrays.items() for each in array]
    return "\n".join(parts)


def _lines(table: Mapping[str, Any]) -> str:
    return "".join(f"{_key(name)} = {_value(value)}\n" for name, value in table.items())


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, (bool, str)):
        return _text(value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_key(str(name))} = {_value(each)}' for name, each in value.items())} }}"
    raise InputError(
        f"{value!r} has no place in a study file", "give numbers, text, truth values or lists of them"
    )


def _text(text: bool | str) -> str:
    # JSON writes truth values as TOML does, and its escapes are among those of TOML, which wants one more.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
