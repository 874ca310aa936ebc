"""Bruggeman's effective medium, and Persson's critical constriction."""

import numpy as np
import pytest
import scipy.optimize

import roughcontact as rc
from roughcontact.theory import leakage, persson, persson_separation
from roughcontact.theory.random_surfaces.waves import Waves


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


SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)


@pytest.mark.parametrize(
    ("pressure", "threshold", "gamma"), [(1e8, 0.4, 0.45), (4e8, 0.4, 1.0), (4e8, 0.5, 0.45)]
)
def test_the_critical_constriction_is_that_of_parts_of_the_spectrum(pressure, threshold, gamma):
    """By the definition: A(q) of the waves up to q; u(q) of those beyond at p/A(q); the gap d(A u)/dA.

    The nodes of the whole spectrum are not those of its parts: 3e-4.
    """

    def fraction(q):
        return float(persson.contact_fraction(pressure, 1e11, Waves.of_spectrum(SPECTRUM, q_max=q)))

    def volume(q):
        area, beyond = fraction(q), Waves.of_spectrum(SPECTRUM, q_min=q)
        return area * float(persson_separation.mean_gap(pressure / area, 1e11, beyond, gamma=gamma))

    q = scipy.optimize.brentq(lambda x: fraction(x) - threshold, 1.001 * SPECTRUM.q_min, SPECTRUM.q_max)
    less, more = q * 0.999, q * 1.001
    gap = (volume(less) - volume(more)) / (fraction(less) - fraction(more))
    found = leakage.critical_constriction(pressure, 1e11, SPECTRUM, threshold=threshold, gamma=gamma)
    assert found.wavenumber == pytest.approx(q, rel=2e-3)  # between nodes
    assert found.gap == pytest.approx(gap, rel=3e-4)
    assert found.transmissivity == found.gap**3


def test_the_critical_constriction_narrows_and_closes():
    """It closes where the whole surface has the threshold in contact; it scales with height and modulus."""
    closing = float(persson.pressure_for(0.4, 1e11, Waves.of(SPECTRUM)))
    pressures = closing * np.array([0.01, 0.1, 0.5, 0.9, 0.999])
    places = [leakage.critical_constriction(p, 1e11, SPECTRUM) for p in pressures]
    assert np.all(np.diff([place.gap for place in places]) < 0)
    assert np.all(np.diff([place.wavenumber for place in places]) > 0)
    assert 0 <= places[-1].gap < 1e-3 * places[-2].gap  # exponentially small beside the threshold
    assert leakage.critical_constriction(1.001 * closing, 1e11, SPECTRUM) is None
    higher = leakage.critical_constriction(pressures[1], 5e10, SPECTRUM.scaled(2e-6))
    assert higher.gap == pytest.approx(2 * places[1].gap, rel=1e-9)


def test_the_critical_constriction_of_heights_is_near_a_computed_flow():
    """Within a factor of four at A/A0 = 0.05, where it is 1.5 +- 0.3 times that of six surfaces."""
    grid = rc.Grid((64, 64), 1 / 64, periodic=True)
    rng = np.random.default_rng(3)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=1 / 8)
    flow = rc.gap_flow(rc.press(surface, 1.0, pressure=0.005))
    for spectrum in (rc.power_spectrum(surface), Waves.of_heights(surface.heights, grid.spacing)):
        ratio = leakage.critical_constriction(0.005, 1.0, spectrum).transmissivity / flow.eigenvalues.mean()
        assert 1 < ratio < 4


@pytest.mark.parametrize(("name", "value"), [("threshold", 1.0), ("pressure", 0.0), ("gamma", 2.0)])
def test_a_critical_constriction_out_of_range_is_refused(name, value):
    with pytest.raises(rc.InputError, match=name):
        leakage.critical_constriction(**{"pressure": 1e8, "modulus": 1e11, "spectrum": SPECTRUM, name: value})
