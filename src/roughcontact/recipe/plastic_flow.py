"""What flows under a hardness, and the larger load or the loop that leaves it behind."""

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
    "Largest pressure of a cell: there the softer body is perfectly plastic. Or the name of its material.",
    "2GPa",
    read=hardness_of,
    names=METALS,
)
_FLOW = described(
    "Under a hardness, where material that flows goes: it vanishes, or raises the whole surface, its volume conserved "
    "(default: removed).",
    read=Choice(("removed", "raised")),
    needs_whole=True,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AfterLoad:
    """A hardness, and a larger load before the load."""

    TITLE: ClassVar = "Plastic flow"
    hardness: str | None = _HARDNESS
    after: str | None = described(
        "Press by this load first, of the same kind as the load, and unload from there: what has flowed stays. Takes a "
        "hardness, or both materials.",
        "100N",
        needs_whole=True,
    )
    flow: str | None = _FLOW

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopOfLoads:
    """A hardness, and whether the loads go down and up again."""

    TITLE: ClassVar = "Plastic flow"
    hardness: str | None = _HARDNESS
    loop: bool = described(
        "Press for the first time, unload and press again: depth and stiffness of all three, and the flattened "
        "surface. Takes a hardness, or both materials.",
        default=False,
        needs_whole=True,
    )
    flow: str | None = _FLOW

    def __post_init__(self) -> None:
        check(self)


def yields_at(bodies: Bodies, plastic: AfterLoad | LoopOfLoads) -> Call | float | None:
    """Return the hardness [Pa]: the one that is given, or that of the softer material where something is to flow.

    Raises
    ------
    InputError
        If something is to flow, and no hardness is known.
    """
    asked = next((name for name in ("after", "loop", "flow") if getattr(plastic, name, None)), None)
    text = plastic.hardness or (bodies.softer if asked else None)
    if text is None and asked:
        raise InputError(
            f"`{asked}` is about what flows under a hardness, which is not given",
            "give `hardness`, or both bodies as `materials`",
            "plastic.hardness",
        )
    return None if text is None else hardness_of(text)
