"""The grid of a surface that is made: its fields, and the call that makes it."""

from __future__ import annotations

from typing import Any

from roughcontact.errors import InputError, placed
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import described
from roughcontact.recipe.texts import points, size, whole

__all__ = ["PERIODIC", "POINTS", "SEED", "SIZE", "grid_call"]

SIZE = described("Width (cells are square), or height x width.", "1mm", read=size, default=..., everyday=True)
POINTS = described("Points a side, or rows x columns.", "512", read=points, default="512", everyday=True)
SEED = described("Seed of the random phases.", "1", read=whole(0, "the seed"), default="1", everyday=True)
PERIODIC = described("Make a periodic surface, which repeats itself.", default=False, everyday=True)


def grid_call(source: Any, *, line: bool) -> Call:
    """Return the call that makes the grid of a new surface; with one length the cells are square."""
    shape, lengths = points(source.points), size(source.size)
    for name, is_one in (("size", len(lengths) == 1), ("points", source.points.isdecimal())):
        if line and not is_one:
            with placed(name):
                raise InputError(
                    f"a profile has one length and one number of points, unlike {getattr(source, name)!r}",
                    "give one number",
                )
    width = lengths[-1] / shape[1]
    height = lengths[0] / shape[0] if len(lengths) == 2 else width
    named = {"periodic": True} if source.periodic else {}
    given = (shape[1], width) if line else (shape, width if width == height else (height, width))
    return Call("rc.Grid", given, named, result="grid", place="source")
