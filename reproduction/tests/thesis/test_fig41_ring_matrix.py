"""Figure 41: the matrix of an axisymmetric load."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.integrate import quad
from scipy.special import ellipe

import hats
from roughcontact_thesis import fig41_ring_matrix as fig41
from roughcontact_thesis.figures import drawn, verdicts

N = fig41.RINGS


def test_a_uniform_pressure_displaces_as_a_disc_does():
    matrix = fig41.case()
    assert matrix.shape == (N, N) == (40, 40)
    # 4 N E((r/N)^2) at the radius r, on the mean over each ring.
    for ring in (0, 1, 20, N - 1):
        mean = quad(lambda r: 2 * r * 4 * N * ellipe((r / N) ** 2), ring, ring + 1)[0] / (2 * ring + 1)
        assert matrix[ring].sum() == pytest.approx(mean, rel=1e-9)


def test_work_is_mutual():
    areas = 2 * np.arange(N) + 1
    work = areas[:, None] * fig41.case()
    np.testing.assert_allclose(work, work.T, rtol=1e-9)


def test_it_is_the_matrix_of_hats_where_pressure_is_smooth():
    # p = 1 - (r/N)^2 by both: means over rings differ from values by their curvature.
    middle = np.arange(N) + 0.5
    nodes = np.arange(N + 1.0)
    by_hats = hats.hat_matrix(N) @ (1 - (nodes / N) ** 2)
    by_rings = fig41.case() @ (1 - (middle / N) ** 2)
    # In the bulk; at the rim the pressure has a kink of its own.
    inner = slice(2, N - 4)
    np.testing.assert_allclose(by_rings[inner], ((by_hats[1:] + by_hats[:-1]) / 2)[inner], rtol=2e-3)


def test_it_is_drawn_and_judged():
    matrix = fig41.case()
    FigureCanvasAgg(drawn(fig41, matrix)).draw()
    assert [each.word for each in verdicts(fig41, matrix)] == ["holds", "not decided"]
    # Symmetric under the areas and positive: no pressure goes without displacement.
    root = np.sqrt(2 * np.arange(N) + 1)
    assert np.linalg.eigvalsh(root[:, None] * matrix / root).min() > 0
