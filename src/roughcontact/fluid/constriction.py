"""The critical constriction: where a flow through a gap loses most of its pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.fluid.network import Network
from roughcontact.grid import Grid
from roughcontact.validation import Array, Mask

__all__ = ["Constriction", "cells_near", "constriction_of", "is_resolved"]

FEWEST = 4  # cells across a constriction that is resolved


@dataclass(frozen=True, slots=True)
class Constriction:
    """The place of the largest dissipation.

    Attributes
    ----------
    place : tuple of float
        Coordinates along both axes [m].
    cells : int
        Open cells across it, perpendicular to the axis of its face.
    width : float
        Width of a channel of the largest gap across it that conducts as well [m].
    gap : float
        The largest gap across it [m].
    share : float
        Part of the whole dissipation within a square of this width around it, three cells at least [1]. If all fluid
        passes here, it is the part of the drop.
    """

    place: tuple[float, float]
    cells: int
    width: float
    gap: float
    share: float

    @property
    def resolved(self) -> bool:
        """Whether it is at least four cells wide and takes less than half of the drop."""
        return is_resolved(self.cells, self.share)


def cells_near(place: Constriction, grid: Grid) -> Mask:
    """Return which cells lie in a square of the constriction's width around it, three cells at least."""
    near = []
    for centre, x, step, length, periodic in zip(
        place.place, grid.coordinates, grid.spacing, grid.lengths, grid.periodic, strict=True
    ):
        away = np.abs(x - centre)
        away = np.minimum(away, length - away) if periodic else away
        near.append(away <= max(0.5 * place.width, 1.5 * step))
    return np.logical_and.outer(*near)


def is_resolved(cells: int, share: float) -> bool:
    """Return whether a constriction is at least four cells wide and takes less than half of the drop."""
    return cells >= FEWEST and share < 0.5


def constriction_of(network: Network, drops: Array, gap: Array, grid: Grid) -> Constriction:
    """Return the critical constriction of one flow.

    Parameters
    ----------
    network : Network
    drops : array, shape (f,)
        Along each face.
    gap : array, shape of the grid
        Zero for closed cells [m].
    grid : Grid
    """
    dissipation = network.conductance * drops**2
    cells = np.flatnonzero(network.cells >= 0)
    inner = (network.first < len(cells)) & (network.second < len(cells))
    worst = int(np.argmax(np.where(inner, dissipation, -1.0)))
    axis = 1 - int(network.axis[worst])
    channels = []
    for end in (network.first[worst], network.second[worst]):
        row, column = divmod(int(cells[end]), grid.shape[1])
        across = np.take(gap, column if axis == 0 else row, 1 - axis)
        channel = _channel(across, row if axis == 0 else column, grid.periodic[axis])
        channels.append((float(np.sum(channel**3)), row, column, channel))
    # Of both ends of the face, the one whose channel conducts less.
    _, row, column, channel = min(channels, key=lambda each: each[0])
    alike = float(np.sum((channel / channel.max()) ** 3))
    half = max(round(alike), 3) // 2
    near = np.ones(len(cells), bool)
    for centre, along, n, periodic in zip((row, column), (0, 1), grid.shape, grid.periodic, strict=True):
        of = cells // grid.shape[1] if along == 0 else cells % grid.shape[1]
        away = np.abs(of - centre)
        near &= (np.minimum(away, n - away) if periodic else away) <= half
    near = np.append(near, np.ones(network.count - len(cells), bool))  # half a cell at a side belongs to it
    share = dissipation[near[network.first] & near[network.second]].sum() / dissipation.sum()
    x, y = grid.coordinates
    at = (float(x[row]), float(y[column]))
    return Constriction(at, len(channel), alike * grid.spacing[axis], float(channel.max()), float(share))


def _channel(across: Array, at: int, periodic: bool) -> Array:
    """Return the gaps of the open cells around one cell of a row."""
    if np.all(across > 0):
        return across
    if periodic:
        start = int(np.argmin(across))
        across, at = np.roll(across, -start), (at - start) % len(across)
    closed = np.flatnonzero(~(across > 0))
    before, after = closed[closed < at], closed[closed > at]
    return across[(before[-1] + 1 if len(before) else 0) : (after[0] if len(after) else len(across))]
