"""Materials by name, where an option takes a number."""

from __future__ import annotations

import math

from roughcontact.cli.messages import UsageError, note
from roughcontact.cli.unit_options import Kind, parse
from roughcontact.errors import InputError
from roughcontact.material import Solid, reduced_modulus
from roughcontact.materials import Material, handbook

__all__ = ["known_material", "modulus_of", "parse_bodies", "softer_of"]

_RIGID = "rigid"


def known_material(text: str) -> Material | None:
    """Return the material that a text names; None where it is a number.

    Raises
    ------
    UsageError
        If the text is neither.
    """
    word = text.strip()
    if not word[:1].isalpha():
        return None
    try:
        return handbook(word.lower())
    except InputError as error:
        raise UsageError(error.message, error.remedy) from error


def modulus_of(text: str) -> float:
    """Return the reduced modulus [Pa] of two materials, "steel,aluminium"; say on standard error what they are.

    Raises
    ------
    UsageError
        If the text does not name two bodies, or names two rigid ones.
    """
    names = [part.strip() for part in text.split(",")]
    if len(names) != 2 or not all(names):
        raise UsageError(
            f"{text!r} are not two names",
            "name both bodies, such as steel,aluminium or steel,steel or steel,rigid",
            place="--materials",
        )
    solids: list[Solid] = []
    for name in names:
        if name.lower() == _RIGID:
            solids.append(Solid(math.inf, 0.0))
            continue
        material = known_material(name)
        if material is None:
            raise UsageError(
                f"{name!r} is no name", "for a number of yours take --young or --modulus", place="--materials"
            )
        solid = material.solid
        if solid not in solids:
            note(
                f"{material.name} is {material.grade}: E {solid.young_modulus / 1e9:.4g} GPa, "
                f"nu {solid.poisson_ratio:g} ({material.sources['solid']})"
            )
        solids.append(solid)
    if all(math.isinf(solid.young_modulus) for solid in solids):
        raise UsageError("one of the two bodies must be elastic, such as steel,rigid", place="--materials")
    return reduced_modulus(*solids)


def softer_of(text: str) -> tuple[float, str]:
    """Return the lower hardness [Pa] of two materials, of which one may be rigid, and of which it is."""
    named = [known_material(name) for name in text.split(",") if name.strip().lower() != _RIGID]
    return min((material.hardness, f"of {material.name}") for material in named if material is not None)


def parse_bodies(text: str, kind: Kind, name: str) -> tuple[float, float]:
    """Return a quantity of both bodies in SI: numbers with units or names of materials, or one for both.

    The `name` is that of the option, and of the property of a material: resistivity or conductivity.

    Raises
    ------
    UsageError
        If the text holds none or more than two, or a negative one.
    """
    option, parts = f"--{name}", [part for part in text.split(",") if part.strip()]
    if len(parts) not in (1, 2):
        raise UsageError(
            f"{text!r} holds {len(parts)} values",
            f"give one value for both bodies or two, such as {kind.example},{kind.example}, or names of "
            "materials, such as steel,aluminium",
            place=option,
        )
    values = []
    for part in parts:
        material = known_material(part)
        values.append(parse(part, kind, option) if material is None else getattr(material, name))
    if min(values) < 0:
        raise UsageError(f"{kind.name} must not be negative, not {text!r}", place=option)
    return values[0], values[-1]
