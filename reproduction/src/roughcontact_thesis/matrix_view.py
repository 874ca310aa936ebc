"""A matrix from pressures to displacements as a picture: all of it, and some of its columns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from roughcontact.validation import Array
from roughcontact_thesis import drawing

__all__ = ["matrix_view"]


def matrix_view(figure: Figure, matrix: Array, columns: Sequence[int], part: str) -> None:
    """Draw B with a colour an entry (a), and chosen columns against the row (b).

    Parameters
    ----------
    figure : Figure
    matrix : array, shape (n, n)
        Row of what is displaced, column of what is loaded; both are counted from 1 in the picture.
    columns : sequence of int
        Columns to draw, from 0.
    part : str
        What is displaced and loaded: "ring" or "strip".
    """
    left, right = drawing.panels(figure, 1, 2, width_ratios=(1, 1.15))
    n = len(matrix)
    extent = (0.5, n + 0.5, n + 0.5, 0.5)
    image = left.imshow(matrix, cmap="viridis", interpolation="nearest", extent=extent, aspect="equal")
    figure.colorbar(image, ax=left, shrink=0.85, pad=0.02).set_label("$B_{ij}$")
    left.set(xlabel=f"loaded {part} $j$", ylabel=f"displaced {part} $i$")
    row = np.arange(1, n + 1)
    for column, colour in zip(columns, drawing.COLOURS, strict=False):
        given: Any = {"color": colour, "linewidth": 1.0, "markersize": 3.5, "label": f"$j$ = {column + 1}"}
        right.plot(row, matrix[:, column], ".-", **given)
    # With room for the legend.
    drawing.label(right, f"displaced {part} $i$", "$B_{ij}$", ylim=(None, 1.25 * float(matrix.max())))
    right.legend(loc="upper center", ncols=3)
