"""Figure 43: the matrix of deflections of a line contact, N = 40."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.matrix_view import matrix_view
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["case", "draw", "verdicts"]

TITLE = "matrix of deflections under pressures on strips, N = 40"
STRIPS = 40
SEED = 0
CHOSEN = (
    "strips of constant pressure and mean displacements of strips; the thesis has pressures linear between nodes, with "
    "a smaller first and last column, and the same numbers between",
    "the constant C, which the thesis leaves open: no displacement at a distance of N strips",
)
SIZE = (drawing.PAGE, 3.0)


def case(seed: int = SEED) -> Array:
    """Return B of u = D/(pi E*) B p (eq. A.9), shape (40, 40); nothing is random, the seed is not used."""
    # With E* = 1 and D = 1.
    return math.pi * rc.line(rc.Grid(STRIPS, 1.0), 1.0, reference_length=float(STRIPS)).as_matrix()


def draw(figure: Figure, data: Array) -> None:
    """Draw the matrix (a), and what some strips displace (b)."""
    last = len(data) - 1
    matrix_view(figure, data, (0, last // 2, last), "strip")


def verdicts(data: Array) -> Verdicts:
    """Return whether the entries depend on the distance only, and whether eq. A.46 gives them."""
    off = np.arange(STRIPS)
    by_distance = data[0][np.abs(off[:, None] - off)]
    spread = float(np.abs(data - by_distance).max())
    # Without the constant: the distance is then counted in strips.
    own, next_one = data[0, :2] - 2 * math.log(STRIPS)
    yield Verdict(
        "the matrix of strips depends on the distance only",
        "All other values B_ij only depend on the difference |i - j|",
        "section A.1.1, fig. 43",
        f"in all columns, within {max(spread, 1e-15):.0e}",
        exactly(bool(spread < 1e-12), "rounding"),
        "method",
    )
    yield Verdict(
        "B_ii and B_i,i+1 of strips",
        f"-3/2, {-next_one / 2:.4f}",
        "eq. A.46",
        f"{own:.4f}, {next_one:.4f}: the factor -2 of eq. A.43 is lost",
        exactly(bool(abs(own + 1.5) < 1e-6), "rounding", "a factor of -2"),
        "misprint",
    )
