"""A matrix from pressures to displacements as a picture: all of it, and some of its columns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from roughcontact.plot.raster import LABEL, TICK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["matrix_view"]

Array = npt.NDArray[np.float64]

_COLOURS = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7")


def matrix_view(figure: Figure, matrix: Array, columns: Sequence[int], words: tuple[str, str]) -> None:
    """Draw B with a colour an entry (a), and chosen columns against the row (b).

    Parameters
    ----------
    figure : Figure
    matrix : array, shape (n, n)
        Row of what is displaced, column of what is loaded; both are counted from 1 in the picture.
    columns : sequence of int
        Columns to draw, from 0.
    words : tuple of str
        What is displaced and what is loaded, such as "displaced ring".
    """
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.15))
    n = len(matrix)
    image = left.imshow(
        matrix, cmap="viridis", interpolation="nearest", extent=(0.5, n + 0.5, n + 0.5, 0.5), aspect="equal"
    )
    bar = figure.colorbar(image, ax=left, shrink=0.85, pad=0.02)
    bar.set_label("$B_{ij}$", fontsize=LABEL)
    bar.ax.tick_params(labelsize=TICK)
    left.set_ylabel(f"{words[0]} $i$", fontsize=LABEL)
    left.set_xlabel(f"{words[1]} $j$", fontsize=LABEL)
    row = np.arange(1, n + 1)
    for column, colour in zip(columns, _COLOURS, strict=False):
        right.plot(
            row,
            matrix[:, column],
            ".-",
            color=colour,
            linewidth=1.0,
            markersize=3.5,
            label=f"$j$ = {column + 1}",
        )
    right.set_xlabel(f"{words[0]} $i$", fontsize=LABEL)
    right.set_ylabel("$B_{ij}$", fontsize=LABEL)
    right.set_ylim(top=1.25 * float(matrix.max()))  # room for the legend
    right.legend(fontsize=TICK, frameon=False, loc="upper center", ncols=3)
    right.grid(True, color="0.92", linewidth=0.8)
    right.set_axisbelow(True)
    for letter, axes in (("a", left), ("b", right)):
        axes.tick_params(labelsize=TICK)
        axes.set_title(f"({letter})", fontsize=LABEL, loc="left")
