"""Cells as independent indenters."""

import numpy as np
import pytest

from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact_thesis.cell_law import cells_stiffness, exponential_rate, single_cell_stiffness

FORCE = np.geomspace(1e-4, 1e-2, 7)


@pytest.mark.parametrize("hurst", [0.4, 0.8, 1.5])
def test_a_single_cell_is_an_indenter_of_its_own(hurst):
    law = pohrt_popov.stiffness(FORCE, hurst, 1.0, 1.0, 1.0)
    np.testing.assert_allclose(single_cell_stiffness(1.0, FORCE, hurst), law, rtol=1e-12)
    # Of a smaller side with the same height, in units of the whole one.
    small = pohrt_popov.stiffness(FORCE, hurst, 1.0, 0.25, 1.0)
    np.testing.assert_allclose(single_cell_stiffness(0.25, FORCE, hurst), small, rtol=1e-12)
    # A power law between nodes of a power law: exact.
    np.testing.assert_allclose(cells_stiffness(np.zeros(1), 0.25, FORCE, hurst), small, rtol=1e-9)


def test_cells_of_one_height_share_the_force():
    one = 16 * single_cell_stiffness(0.25, FORCE / 16, 0.8)
    np.testing.assert_allclose(cells_stiffness(np.zeros(16), 0.25, FORCE, 0.8), one, rtol=1e-9)
    # One of them far above the others: it is alone.
    alone = np.append(0.0, np.full(15, 10.0))
    np.testing.assert_allclose(
        cells_stiffness(alone, 0.25, FORCE, 0.8), single_cell_stiffness(0.25, FORCE, 0.8), rtol=1e-9
    )


@pytest.mark.parametrize(("hurst", "rate"), [(0.5, 2.0), (0.8, 3.0), (1.0, 1.0)])
def test_exponential_tops_give_a_linear_law_whatever_the_cell(hurst, rate):
    # Thesis, eq. 3.9. Quantiles of the distribution; half a spacing that the highest ones miss counts less and less.
    count = 10_000
    tops = -np.log((np.arange(count) + 0.5) / count) / rate
    below = tops.max() - tops
    force = np.array([0.5, 1.0, 2.0])
    ratio = cells_stiffness(below, 1 / np.sqrt(count), force, hurst) / (rate * force)
    np.testing.assert_allclose(ratio, 1, atol=0.016)
    assert (np.diff(ratio) < 0).all()
    assert exponential_rate(below) == pytest.approx(rate, rel=1e-3)


def test_too_few_tops_say_nothing():
    assert np.isnan(exponential_rate(np.array([0.0, 1.0, 2.0])))
    assert exponential_rate(np.array([0.0, 1.0, 2.0, 3.0])) == pytest.approx(1.0)  # 1/((1.5 + 0.5)/2)
