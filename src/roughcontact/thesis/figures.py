"""Which figures of the thesis there are, and the module of each."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol, cast

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["FIGURES", "FigureModule", "figure", "module"]

FIGURES = {name: f"roughcontact.thesis.{name}" for name in ("fig4", "fig5", "fig6", "fig7", "fig14", "fig34")}


class FigureModule(Protocol):
    """What the module of a figure holds."""

    TITLE: str
    CHOSEN: tuple[str, ...]  # what the thesis leaves open, and what is taken here
    SEED: int
    SIZE: tuple[float, float]  # of the picture [inches]

    def case(self, seed: int = ...) -> Any:
        """Return what is drawn: the same for the same seed."""

    def draw(self, figure: Figure, data: Any) -> None:
        """Draw it."""


def module(name: str) -> FigureModule:
    """Return the module of the figure `name`.

    Raises
    ------
    ValueError
        If there is no such figure.
    """
    if name not in FIGURES:
        raise ValueError(f"there is no figure {name!r}: choose one of {', '.join(FIGURES)}")
    return cast("FigureModule", import_module(FIGURES[name]))


def figure(name: str, seed: int | None = None) -> Figure:
    """Return the figure `name`, computed and drawn."""
    from matplotlib.figure import Figure

    found = module(name)
    drawn = Figure(figsize=found.SIZE, layout="constrained")
    found.draw(drawn, found.case(found.SEED if seed is None else seed))
    return drawn
