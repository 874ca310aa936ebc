"""A case: the loading curve of a patch that is cut from a larger periodic surface, as a map is from a joint."""

from __future__ import annotations

from typing import Self

import numpy as np
from pydantic import Field, model_validator

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.curve_case import CurveParameters, curve_of, moments_of
from roughcontact.surface.surface import Surface

__all__ = ["CASE", "PatchParameters", "run"]


class PatchParameters(CurveParameters):
    """The parameters of the case ``curve``, and the size of the surface that the patch is cut from.

    `points`, `size` and all wavelengths are those of the patch, or over its side; `rms` is that of the whole surface.
    The patch is the first corner of the surface, with its tilt removed, and free: no neighbouring area carries load.

    Parameters
    ----------
    period : int
        Side of the whole surface over that of the patch.
    """

    period: int = Field(ge=2)

    @model_validator(mode="after")
    def _free(self) -> Self:
        if self.periodic:
            raise InputError("a patch is not periodic", "leave periodic out, or take the case curve")
        return self

    @property
    def whole(self) -> Grid:
        """The cells of the whole surface."""
        points = self.period * self.points
        return Grid((points, points), self.size / self.points, periodic=True)


def run(parameters: PatchParameters, rng: np.random.Generator) -> Record:
    """Return the loading curve of the patch of one sample.

    Returns
    -------
    xarray.Dataset
        The record of the case ``curve``; forces over E* h L with the rms height of the whole surface and the side of
        the patch. ``rms`` is that of the patch, ``rms_slope`` and ``rms_curvature`` those of the whole surface.
    """
    part = slice(0, parameters.points)
    whole = parameters.roughness_on(parameters.whole, rng)
    patch = Surface(whole.heights[part, part], parameters.grid).levelled("plane")
    return curve_of(patch, moments_of(whole), parameters)


CASE = Case("patch", 1, PatchParameters, run)
