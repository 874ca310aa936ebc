"""The viscoelastic body of a contact, from a file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described
from roughcontact.recipe.texts import sha256, word

__all__ = ["ViscoelasticBody"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ViscoelasticBody:
    """A viscoelastic half-space under a rigid surface."""

    TITLE: ClassVar = "The viscoelastic body (the surface is rigid)"
    material: str = described(
        "File of the material: relaxation times and moduli in TOML, see docs/how-to/viscoelastic.md.",
        "rubber.toml",
        read=word,
        default=...,
        everyday=True,
    )
    sha256: str | None = described(
        "Fingerprint of the file of the material: a different file of the same name is refused.",
        "HEX",
        read=sha256,
        option=False,
    )

    def __post_init__(self) -> None:
        check(self)

    def calls(self) -> Iterator[Call]:
        """Yield the call that reads the material."""
        given = (self.material,)
        yield Call("rc.Viscoelastic.read", given, result="material", place="bodies.material")
