"""Figure 43: the matrix of a line contact."""

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.integrate import quad

from roughcontact_thesis import fig43_strip_matrix as fig43
from roughcontact_thesis.figures import drawn, verdicts

N = fig43.STRIPS


def by_quadrature(k):
    """Return A.46 with its factor, -2 int (1 - |t|) ln|k - t| dt, with the constant."""
    halves = ((-1, 0), (0, 1))
    return -2 * sum(quad(lambda t: (1 - abs(t)) * math.log(abs(k - t) / N), *half)[0] for half in halves)


def test_entries_are_those_of_hats():
    matrix = fig43.case()
    assert matrix.shape == (N, N) == (40, 40)
    for k in (0, 1, 2, 10, N - 1):
        assert matrix[0, k] == pytest.approx(by_quadrature(k), abs=1e-7)
    assert matrix[0, 0] - 2 * math.log(N) == pytest.approx(3, abs=1e-12)
    assert matrix[0, 1] - 2 * math.log(N) == pytest.approx(0.227411277760219, abs=1e-12)


def test_all_columns_are_one_shifted():
    matrix = fig43.case()
    np.testing.assert_allclose(matrix[1:, 1:], matrix[:-1, :-1], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(matrix, matrix.T, rtol=1e-12, atol=1e-12)
    # With the reference at the length of the line, every load presses it down everywhere.
    assert matrix.min() > 0
    assert np.linalg.eigvalsh(matrix).min() > 0


def test_it_is_drawn_and_judged():
    matrix = fig43.case()
    FigureCanvasAgg(drawn(fig43, matrix)).draw()
    assert [each.word for each in verdicts(fig43, matrix)] == ["holds", "does not hold"]
