"""A case: the loading curve of a nominally flat surface, and the heights of the maxima of its cells."""

from __future__ import annotations

from copy import deepcopy
from itertools import pairwise

import numpy as np

from roughcontact.labels.labelled import described
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.curve_case import CurveParameters, run as loading_curve

__all__ = ["CASE", "CellsParameters", "run"]


class CellsParameters(CurveParameters):
    """The parameters of the case ``curve``.

    The surface is divided into square cells as long as its longest waves: `long_cutoff`, otherwise `rolloff`,
    otherwise the side, rounded to a whole fraction of the side.
    """

    @property
    def cells(self) -> int:
        """Cells along a side."""
        longest = min(self.long_cutoff or self.rolloff or 1.0, 1.0)
        return max(1, round(1 / longest))


def run(parameters: CellsParameters, rng: np.random.Generator) -> Record:
    """Return the loading curve of one sample, and the distances of the maxima of its cells from the highest.

    Returns
    -------
    xarray.Dataset
        The record of the case ``curve``, with ``below`` (cell), the sorted distances of the highest points of the
        cells from the top of the surface [m], and ``peak``, the height of the top above the mean plane [m].
    """
    heights = parameters.on_body(
        parameters.roughness(deepcopy(rng))
    ).heights  # the curve uses the same phases
    record = loading_curve(parameters, rng)
    edges = np.linspace(0, parameters.points, parameters.cells + 1).round().astype(int)
    maxima = [heights[y0:y1, x0:x1].max() for y0, y1 in pairwise(edges) for x0, x1 in pairwise(edges)]
    words = "distance of the highest point of a cell from the top of the surface"
    record["below"] = described("cell", np.sort(heights.max() - np.array(maxima)), words, "m")
    peak = float(heights.max() - heights.mean())
    record["peak"] = described((), peak, "top of the surface above its mean plane", "m")
    return record


CASE = Case("cells", 2, CellsParameters, run)
