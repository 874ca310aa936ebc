"""Bruggeman's effective medium."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory import leakage


def test_media_of_one_and_of_two_kinds():
    assert leakage.bruggeman([3.0, 3.0, 3.0]) == pytest.approx(3.0, rel=1e-12)
    # Two kinds of equal area: the square root of the product, exact for a checkerboard.
    assert leakage.bruggeman([1e-20, 1e-18]) == pytest.approx(1e-19, rel=1e-12)


@pytest.mark.parametrize("threshold", [0.5, 0.42])
def test_open_cells_of_one_gap_conduct_linearly_down_to_the_threshold(threshold):
    # Of a closed part c: (1 - c)(1 - k)/(1 + s k) = c/s, so k = 1 - c/threshold.
    for closed in (0, 10, 30, 41):
        cells = np.ones(100)
        cells[:closed] = 0
        expected = 1 - closed / 100 / threshold
        assert leakage.bruggeman(cells, threshold) == pytest.approx(expected, rel=1e-10)
    assert leakage.bruggeman(np.repeat([0.0, 1.0], 50), threshold) == 0.0


def test_a_light_contact_conducts_as_the_theory_says():
    """Of six surfaces it is 9 % too high on average at A/A0 = 0.05, and 6 % scatter: three times that here."""
    grid = rc.Grid((64, 64), 1 / 64, periodic=True)
    rng = np.random.default_rng(3)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=1 / 8)
    flow = rc.gap_flow(rc.press(surface, 1.0, pressure=0.005))
    ratio = leakage.bruggeman(flow.gap**3) / (np.trace(flow.transmissivity) / 2)
    assert ratio == pytest.approx(1.09, abs=0.18)


@pytest.mark.parametrize("threshold", [0.0, 1.0])
def test_a_threshold_out_of_range_is_refused(threshold):
    with pytest.raises(rc.InputError, match="threshold must lie between 0 and 1"):
        leakage.bruggeman([1.0], threshold)
