"""A case: the loading curve of a rough surface that is the same on any number of cells."""

from __future__ import annotations

from typing import Self

import numpy as np
from pydantic import Field, model_validator

from roughcontact.study.case import Case
from roughcontact.study.cases.curve_case import CurveParameters, run
from roughcontact.surface.surface import Surface

__all__ = ["CASE", "RefinedParameters"]


class RefinedParameters(CurveParameters):
    """Those of the case ``curve``, and the grid that the surface comes from.

    Parameters
    ----------
    drawn_on : int
        Points along a side of the grid on which the waves are added up, a multiple of `points`: of these every second
        one, every third and so on is taken. So surfaces of one sample are the same ones for all numbers of points,
        as long as two cells are less than the shortest wave.
    """

    drawn_on: int = Field(ge=4)
    short_cutoff: float = Field(gt=0)

    @model_validator(mode="after")
    def _sampled(self) -> Self:
        if self.drawn_on % self.points:
            raise ValueError(
                f"drawn_on must be a multiple of points, not {self.drawn_on} with {self.points} points"
            )
        if not self.short_cutoff * self.points > 2:
            raise ValueError(
                f"short_cutoff must be above two cells, {2 / self.points:g} on {self.points} points, not "
                f"{self.short_cutoff:g}"
            )
        return self

    def roughness(self, rng: np.random.Generator) -> Surface:
        """Return the roughness alone, as if on a flat body."""
        whole = CurveParameters(**(self.model_dump(exclude={"drawn_on"}) | {"points": self.drawn_on}))
        step = self.drawn_on // self.points
        drawn = whole.roughness(rng)
        return Surface(drawn.heights[::step, ::step], self.grid, drawn.provenance)


CASE = Case("refined", 2, RefinedParameters, run)
