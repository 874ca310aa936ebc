"""A case: the loading curve of a rough square whose highest crest lies at random, or at a distance from the border.

A free square is one period of a random surface, and the phases of its waves choose where it is cut. If the crest is
closer to the border than its contact is wide, the square contains two parts of the crest, far from each other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from roughcontact.labels.labelled import described
from roughcontact.study.case import Case
from roughcontact.study.cases.curve_case import CurveParameters, curve_of, moments_of

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.study.case import Record
    from roughcontact.surface.surface import Surface
    from roughcontact.validation import Array

__all__ = ["CASE", "CrestParameters", "border_share", "crest_distance", "run"]

_KEPT = (
    *("force", "depth", "stiffness", "interfacial_stiffness", "contact_area", "residual", "status"),
    *("dimensionless_force", "dimensionless_stiffness", "cell_stiffness", "full_contact_stiffness"),
)


class CrestParameters(CurveParameters):
    """The parameters of the case ``curve``, and the place of the highest crest.

    Parameters
    ----------
    crest : float, optional
        Distance from the border x = 0 to the highest cell, over the side; along y this cell is in the middle. With 0.5
        it is in the middle of the square, with 0 it adjoins the border. The surface is shifted by whole cells within
        its period, so all values give the same waves. By default the crest stays where the phases put it.
    """

    crest: float | None = Field(default=None, ge=0, le=0.5)

    def roughness(self, rng: np.random.Generator) -> Surface:
        """Return the roughness with its highest cell at the place of the parameters."""
        drawn = super().roughness(rng)
        if self.crest is None:
            return drawn
        row, column = np.unravel_index(drawn.heights.argmax(), drawn.shape)
        shift = self.points // 2 - int(row), int(self.crest * self.points) - int(column)
        words = f"highest cell at {self.crest:g} of the side"
        return drawn.with_heights(np.roll(drawn.heights, shift, (0, 1)), words)


def border_share(solution: Solution) -> dict[str, float]:
    """Return the share of the force within the contact radius of the border of a free square.

    Parameters
    ----------
    solution : Solution
        A state.

    Returns
    -------
    dict of str to float
        ``border_share``. The contact radius is k/(2 E*), that of a disc with the stiffness k of the contact; the same
        radius as Hertz's for one smooth crest. Cells that lie partly within it count in part.
    """
    radius = solution.stiffness / (2 * solution.problem.modulus)
    grid, pressure = solution.problem.grid, solution.pressure
    down, along = (
        _beyond(radius / side, count) for side, count in zip(grid.spacing, grid.shape, strict=True)
    )
    near = 1 - np.outer(down, along)  # exactly zero where nothing is near: so is the share
    return {"border_share": float((pressure * near).sum() / pressure.sum())}


def _beyond(width: float, count: int) -> Array:
    """Return which part of every cell of a row lies more than `width` cells from both ends."""
    cells = np.arange(count)
    near: Array = np.clip(width - cells, 0, 1) + np.clip(width - cells[::-1], 0, 1)
    return np.maximum(1 - near, 0)


def crest_distance(roughness: Surface) -> float:
    """Return the distance from the centre of the highest cell to the nearest border, over the side."""
    places = np.unravel_index(roughness.heights.argmax(), roughness.shape)
    pairs = zip(places, roughness.shape, strict=True)
    return float(min(min(place + 0.5, count - place - 0.5) / count for place, count in pairs))


def run(parameters: CrestParameters, rng: np.random.Generator) -> Record:
    """Return the loading curve of one sample.

    Returns
    -------
    xarray.Dataset
        A part of the record of the case ``curve``; along ``load`` also `border_share`, and ``crest_distance``, that of
        the highest cell from the nearest border over the side.
    """
    roughness = parameters.roughness(rng)
    record = curve_of(roughness, moments_of(roughness), parameters, [border_share])[[*_KEPT, "border_share"]]
    words = "distance of the highest cell from the nearest border over the side"
    record["crest_distance"] = described((), crest_distance(roughness), words)
    return record


CASE = Case("crest", 1, CrestParameters, run)
