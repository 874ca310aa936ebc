"""Fields of a recipe as numbers with their units, by dotted names such as ``"bodies.modulus"``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import is_dataclass
from typing import Any

from roughcontact.files.quantity import parse
from roughcontact.recipe.jobs import Job
from roughcontact.recipe.prescribed_loads import kinds_of
from roughcontact.recipe.recipe_fields import specs, value_of
from roughcontact.recipe.written import field_at

__all__ = ["number_at", "number_reader"]


def number_at(job: Job, name: str) -> tuple[Any, str | None]:
    """Return the value of a field with its unit in SI; if it is not a number, the text without a unit.

    Raises
    ------
    AttributeError
        If the job has no such field.
    """
    *tables, last = name.split(".")
    part: Any = job
    for table in tables:
        part = getattr(part, table)
    text = getattr(part, last)
    spec = {each.name: spec for each, spec in specs(part)}.get(last)
    if spec is None or is_dataclass(text):
        raise AttributeError(name)
    value, kind = value_of(part, last), getattr(spec.read, "kind", None)
    if isinstance(value, str) and hasattr(part, "named"):  # loads: the unit of a force depends on the profile
        profile = job.contact.profile  # type: ignore[union-attr]
        kind = kinds_of(profile).get(last)
        value = value if kind is None else part.named(profile)[last]
    if isinstance(value, float | int):
        return value, None if kind is None else kind.unit
    try:
        return float(text), None
    except (TypeError, ValueError):
        return list(text) if isinstance(text, tuple) else text, None


def number_reader(plain: Mapping[str, Any], name: str) -> Callable[[Any], Any]:
    """Return the function that converts the text of a field into its number in SI.

    Raises
    ------
    InputError
        If the recipe has no such field.
    """
    spec, kinds = field_at(plain, name), kinds_of(plain.get("contact", {}).get("profile"))
    kind = kinds.get(name.rpartition(".")[2])

    def read(value: Any) -> Any:
        if not isinstance(value, str):
            return value
        found = spec.read(value)
        return parse(value, kind) if isinstance(found, str) and kind is not None else found

    return read
