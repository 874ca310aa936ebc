"""Figure 41: the matrix of deflections of an axisymmetric load, N = 40."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.matrix_view import matrix_view
from roughcontact_thesis.ruling import exactly, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["case", "draw", "verdicts"]

TITLE = "matrix of deflections under pressures on rings, N = 40"
RINGS = 40
SEED = 0
CHOSEN = (
    "rings of constant pressure and mean displacements of rings; the thesis has pressures linear between nodes",
    "row of the displaced ring, column of the loaded one, so that u = D/(pi E*) B p; the thesis has the transpose in "
    "eq. A.36",
)
SIZE = (drawing.PAGE, 3.0)


def case(seed: int = SEED, rings: int = RINGS) -> Array:
    """Return B of u = D/(pi E*) B p (eq. A.9), shape (rings, rings); nothing is random, the seed is not used."""
    # With E* = 1 and D = 1.
    return math.pi * rc.ring(rc.RadialGrid.uniform(rings, float(rings)), 1.0).as_matrix()


def draw(figure: Figure, data: Array) -> None:
    """Draw the matrix (a), and what some rings displace (b)."""
    last = len(data) - 1
    matrix_view(figure, data, (0, last // 4, last // 2, 3 * last // 4, last), "ring")


def verdicts(data: Array) -> Verdicts:
    """Return how well conditioned the matrix is."""
    condition = [float(np.linalg.cond(matrix)) for matrix in (data, case(rings=2 * RINGS))]
    yield Verdict(
        "the matrix of rings is well conditioned",
        "These matrices are well conditioned.",
        "section A.1.1, fig. 41",
        f"condition number {condition[0]:.0f} for N = {RINGS}, {condition[1]:.0f} for {2 * RINGS}: about "
        f"{condition[0] / RINGS:.1f} N",
        exactly(bool(condition[0] < 1e3), "1000, of 1e16"),
        "method",
    )
    yield Verdict(
        "Polonsky and Keer's conjugate gradients converge for arbitrary surfaces",
        "his methodology does not guarantee convergence due to the local relaxation step. In contrast Polonsky and "
        "Keer [64] use the CG-method and find convergence for arbitrary surfaces.",
        "section A.1.3",
        "the thesis reports that they find it, not a proof. The method of that name in roughcontact has safeguards of "
        "later papers; thousands of surfaces that converge, as in the page on robustness, are no guarantee either",
        undecided("a finding of others without a proof", "a proof, or a surface without convergence"),
        "theory",
    )
