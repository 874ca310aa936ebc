"""Which figures of the thesis there are, and the module of each.

A module named ``fig``, a number and what is seen is a figure of the thesis, one named ``outlook_`` and a word answers a
question of its outlook. A simple one computes what it draws from a seed, in seconds. That of an ensemble names studies,
averages what they export, and draws the averages.
"""

from __future__ import annotations

import pkgutil
import re
from importlib import import_module
from pathlib import Path
from typing import Any, Literal, Protocol, TypeGuard, cast

import matplotlib
import xarray
from matplotlib.figure import Figure

from roughcontact.errors import InputError
from roughcontact.study.study import Study
from roughcontact_thesis.drawing import STYLE, TICK
from roughcontact_thesis.verdict import Verdict

__all__ = [
    "FIGURES",
    "EnsembleFigure",
    "FigureModule",
    "Scale",
    "SimpleFigure",
    "Studies",
    "drawn",
    "figure",
    "findings",
    "is_ensemble",
    "module",
    "verdicts",
]

Scale = Literal["small", "thesis"]
"""How large the ensembles are: two minutes on two cores at most, or the counts of the thesis."""

Studies = tuple[Study, ...]
"""What the figure of an ensemble stands on."""

_FIGURE = re.compile(r"(fig(\d+)|outlook_[a-z]+)(_[a-z_]+)?")


def _figures() -> dict[str, str]:
    """Return the modules of all figures by the names that users give them, those with numbers first.

    The module ``fig27_exponent`` is the figure ``fig27``.
    """
    names = (each.name for each in pkgutil.iter_modules([str(Path(__file__).parent)]))
    found = filter(None, map(_FIGURE.fullmatch, names))
    ordered = sorted(found, key=lambda match: (int(match[2] or 1000), match[0]))
    return {match[1].replace("_", "-"): f"roughcontact_thesis.{match[0]}" for match in ordered}


FIGURES = _figures()


class FigureModule(Protocol):
    """What the module of every figure holds. It may also hold `verdicts` and `findings`, see the functions."""

    TITLE: str
    CHOSEN: tuple[str, ...]  # what the thesis leaves open, and what is taken here
    SIZE: tuple[float, float]  # of the picture [inches]

    def draw(self, figure: Figure, data: Any) -> None:
        """Draw it."""


class SimpleFigure(FigureModule, Protocol):
    """What the module of a figure holds that is computed from a seed.

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig6")
    >>> found.SEED, len(found.case()) == len(found.EXPONENTS)
    (4, True)
    """

    SEED: int

    def case(self, seed: int = ...) -> Any:
        """Return what is drawn: the same for the same seed.

        Parameters
        ----------
        seed : int
            Of the random numbers; by default ``SEED``.

        Returns
        -------
        object
            What the figure draws.
        """


class EnsembleFigure(FigureModule, Protocol):
    """What the module of a figure holds that stands on studies.

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig27")
    >>> [study.case for study in found.studies("small")]
    ['curve', 'lines']
    """

    def studies(self, scale: Scale) -> Studies:
        """Return the studies; those that figures share have one name and are run once.

        Parameters
        ----------
        scale : {"small", "thesis"}
            Two minutes on two cores at most, or the counts of the thesis.

        Returns
        -------
        tuple of Study
        """

    def averages(self, *datasets: xarray.Dataset) -> xarray.Dataset:
        """Return what is drawn, small, from what the studies export, in their order.

        Parameters
        ----------
        *datasets : Dataset
            Of each study, as `roughcontact.study.export` makes it.

        Returns
        -------
        Dataset
        """


def module(name: str) -> SimpleFigure | EnsembleFigure:
    """Return the module of the figure `name`.

    Parameters
    ----------
    name : str
        One of ``FIGURES``, such as ``"fig6"``.

    Returns
    -------
    SimpleFigure or EnsembleFigure

    Raises
    ------
    ValueError
        If there is no such figure.

    Examples
    --------
    >>> import roughcontact_thesis
    >>> roughcontact_thesis.module("fig17").TITLE
    'stiffness of the stepped indenter against load, schematic and computed'
    """
    if name not in FIGURES:
        raise InputError(f"there is no figure {name!r}", f"choose one of {', '.join(FIGURES)}")
    return cast("SimpleFigure | EnsembleFigure", import_module(FIGURES[name]))


def is_ensemble(found: SimpleFigure | EnsembleFigure) -> TypeGuard[EnsembleFigure]:
    """Return whether a figure stands on studies.

    Parameters
    ----------
    found : SimpleFigure or EnsembleFigure
        Of `module`.

    Returns
    -------
    bool

    Examples
    --------
    >>> import roughcontact_thesis
    >>> [roughcontact_thesis.is_ensemble(roughcontact_thesis.module(name)) for name in ("fig6", "fig27")]
    [False, True]
    """
    return hasattr(found, "studies")


def drawn(found: FigureModule, data: object) -> Figure:
    """Return the picture of what a figure shows.

    Parameters
    ----------
    found : FigureModule
        Of `module`.
    data : object
        What it shows: of a simple figure ``found.case(seed)``, of an ensemble its averages, see `averages_of`.

    Returns
    -------
    Figure
        Of Matplotlib, without pyplot; `roughcontact.plot.save` writes it.

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig4")
    >>> len(roughcontact_thesis.drawn(found, found.case(seed=2)).axes)
    4
    """
    picture = Figure(figsize=found.SIZE, layout="constrained")
    with matplotlib.rc_context(STYLE):
        found.draw(picture, data)
    for axes in picture.axes:  # ticks are made when they are drawn
        axes.tick_params(labelsize=TICK, which="both")
    return picture


def verdicts(found: FigureModule, data: object) -> tuple[Verdict, ...]:
    """Return what a figure shows beside what the thesis says; empty where the text holds no number.

    Parameters
    ----------
    found : FigureModule
        Of `module`.
    data : object
        What it shows, see `drawn`.

    Returns
    -------
    tuple of Verdict

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig20")
    >>> [verdict.word for verdict in roughcontact_thesis.verdicts(found, found.case())]
    ['holds', 'does not hold', 'holds']
    """
    judge = getattr(found, "verdicts", None)
    return () if judge is None else tuple(judge(data))


def findings(found: FigureModule, data: Any) -> str:
    """Return what a figure says about the whole, in a sentence; empty for most."""
    said = getattr(found, "findings", None)
    return "" if said is None else str(said(data))


def figure(name: str, seed: int | None = None) -> Figure:
    """Return the simple figure `name`, computed and drawn.

    Parameters
    ----------
    name : str
        One of ``FIGURES`` that stands on no ensemble.
    seed : int, optional
        Of the random numbers; by default the figure's own.

    Returns
    -------
    Figure
        Of Matplotlib, without pyplot; `roughcontact.plot.save` writes it.

    Raises
    ------
    ValueError
        If there is no such figure, or it stands on studies: see `averages_of`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> import roughcontact_thesis
    >>> rc.plot.save(roughcontact_thesis.figure("fig4"), "fig4.png")
    """
    found = module(name)
    if is_ensemble(found):
        raise InputError(
            f"{name} stands on an ensemble",
            f"compute it with averages_of, or 'roughcontact thesis {name}'",
            place=name,
        )
    simple = cast("SimpleFigure", found)
    return drawn(simple, simple.case(simple.SEED if seed is None else seed))
