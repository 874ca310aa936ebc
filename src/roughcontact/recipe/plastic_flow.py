"""Plastic flow under a hardness: where the material goes, and the larger load or loop before the answer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roughcontact.errors import InputError
from roughcontact.recipe.bodies import Bodies, hardness_of
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described
from roughcontact.recipe.texts import METALS, Choice

__all__ = ["AfterLoad", "LoopOfLoads", "yields_at"]

_HARDNESS = described(
    "Hardness of the softer body: the largest pressure of a cell, or the name of the material.",
    "2GPa",
    read=hardness_of,
    names=METALS,
)
_FLOW = described(
    "Where the plastically displaced material goes: it is removed, or it raises the whole surface so that volume is "
    "conserved (default: removed).",
    read=Choice(("removed", "raised")),
    needs_whole=True,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AfterLoad:
    """A hardness, and a larger load before the given one."""

    TITLE: ClassVar = "Plastic flow"
    hardness: str | None = _HARDNESS
    after: str | None = described(
        "First press by this larger load of the same kind, then unload; plastic flow stays. Needs a hardness, or both "
        "materials.",
        "100N",
        needs_whole=True,
    )
    flow: str | None = _FLOW

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopOfLoads:
    """A hardness, and whether unloading and reloading follow."""

    TITLE: ClassVar = "Plastic flow"
    hardness: str | None = _HARDNESS
    loop: bool = described(
        "Load, unload and reload: depth and stiffness of all three branches, and the flattened surface. Needs a "
        "hardness, or both materials.",
        default=False,
        needs_whole=True,
    )
    flow: str | None = _FLOW

    def __post_init__(self) -> None:
        check(self)


def yields_at(bodies: Bodies, plastic: AfterLoad | LoopOfLoads) -> Call | float | None:
    """Return the given hardness [Pa], or that of the softer material if the job needs one.

    Raises
    ------
    InputError
        If the job needs a hardness, and none is known.
    """
    asked = next((name for name in ("after", "loop", "flow") if getattr(plastic, name, None)), None)
    text = plastic.hardness or (bodies.softer if asked else None)
    if text is None and asked:
        raise InputError(
            f"`{asked}` needs a hardness, which is not given",
            "give `hardness`, or both bodies as `materials`",
            "plastic.hardness",
        )
    return None if text is None else hardness_of(text)
