"""Intervals of a contact from surfaces that a measured spectrum allows."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.stats import binom

import roughcontact as rc
from roughcontact.measurement.press_draws import NUMBERS, _curves, _shared_error

SIZE, SHORTEST, MODULUS, PRESSURE = 32e-6, 4e-6, 1e9, 1e6
SCATTER, ERROR = 0.9, 0.6  # of ln C


def law(q):
    """Return C [m^4], a power law with H = 0.8 below the roll-off at 32 um, flat beyond; rms height 1e-7 m, nearly."""
    return 1e-14 * (SIZE / (2 * np.pi)) ** 2 / 8 * np.maximum(q * SIZE / (2 * np.pi), 1.0) ** -3.6


def spectrum(longest=SIZE, shortest=SHORTEST, error=ERROR, spread=SCATTER, off=0.0, kind="C2D"):
    """Return a combined spectrum with given errors in eleven bins."""
    ends = 2 * np.pi / longest, 2 * np.pi / shortest
    edges = np.geomspace(*ends, 12)
    q = np.sqrt(edges[1:] * edges[:-1])
    full = np.full(q.size, 1.0)
    return rc.CombinedSpectrum(
        *(
            q,
            law(q) * np.exp(off),
            kind,
            error * full,
            0 * full,
            spread * full,
            np.inf * full,
            ("a",),
            law(q)[None],
        ),
        *(*ends, (), ()),
    )


def correlated(rng, scale):
    """Return an error of ln C at the bins, correlated over an octave."""
    x = np.log(spectrum().wavenumber)
    covariance = np.exp(-(((x[:, None] - x) / math.log(2)) ** 2))
    return scale * rng.multivariate_normal(np.zeros(x.size), covariance, method="eigh")


def specimen(rng):
    """Press a surface whose ln C scatters about the law, with new waves in the band."""
    x, off = np.log(spectrum().wavenumber), correlated(rng, SCATTER)

    def density(q):
        inside = (q > 2 * np.pi / SIZE * (1 - 1e-9)) & (q < 2 * np.pi / SHORTEST * (1 + 1e-9))
        return np.where(inside, law(q) * np.exp(np.interp(np.log(q), x, off)), 0.0)

    grid = rc.Grid((48, 48), SIZE / 48, periodic=True)
    return rc.press(rc.synthesise(grid, density, rng, amplitudes="gaussian"), MODULUS, pressure=PRESSURE)


def covered(seed, count=60, **given):
    """Return how many specimens lie in the intervals of nine draws, and of how many, by name."""
    rng, inside, of = np.random.default_rng(seed), dict.fromkeys(NUMBERS, 0), dict.fromkeys(NUMBERS, 0)
    for _ in range(count):
        # An estimate whose roll-off seems shorter gives no K/A0; that depends on the estimate, not on the specimen.
        found = rc.press_draws(
            spectrum(off=correlated(rng, ERROR), **given), MODULUS, PRESSURE, SIZE, draws=9, rng=rng
        )
        assert found.level == pytest.approx(0.8)
        true = specimen(rng)
        for name, (low, high) in found.intervals.items():
            inside[name] += low <= getattr(true, name) <= high
            of[name] += 1
    return inside, of


@pytest.mark.slow
def test_the_next_specimen_lies_in_the_interval_as_often_as_stated():
    """Estimate and specimen scatter about the same spectrum: the specimen is one more draw about the estimate.

    The count of n specimens with probability 0.8 lies in the bounds with probability 0.99. Without the errors of the
    spectrum, the intervals are too narrow. A spread that is wrong by a factor shows as well as in intervals of 90 %,
    of twice as many draws: there it moves the probability less, and the count scatters less.
    """
    inside, of = covered(11)
    for name in NUMBERS:
        assert of[name] >= 20
        low, high = binom.ppf([0.005, 0.995], of[name], 0.8)
        assert low <= inside[name] <= high, name
    narrow, of = covered(11, count=36, error=0, spread=0)
    assert narrow["mean_gap"] < binom.ppf(0.005, of["mean_gap"], 0.8)


def test_the_mean_is_known_better_than_the_next_specimen():
    """Of the mean count the error of the spectrum and that of the mean of all surfaces, two of each of twelve draws."""
    sd = {}
    for of, error in (("specimen", 0.0), ("mean", 0.0), ("mean", 0.6)):
        found = rc.press_draws(
            spectrum(error=error, spread=0), MODULUS, PRESSURE, SIZE, draws=12, of=of, rng=2
        )
        sd[of, error] = np.std(np.log(found.values["mean_gap"]), ddof=1)
    assert rc.press_draws(spectrum(), MODULUS, PRESSURE, SIZE, rng=1).level == pytest.approx(0.9)
    # With 12 draws the ratio of two variances, the lower one a bootstrap of twelve pairs, lies within 1/9 and 9 with a
    # probability of 0.99: chi-squared of 11 over the product of two of them.
    ratio = (sd["specimen", 0.0] / sd["mean", 0.0]) ** 2
    assert 24 / 9 < ratio < 24 * 9
    # ln h has half the error of ln C if all waves have it; they have it over an octave, which holds most of the height.
    assert 0.3 * 0.3 < sd["mean", 0.6] < 0.3 * 2
    assert rc.press_draws(spectrum(), MODULUS, PRESSURE, SIZE, draws=39, rng=1).level == pytest.approx(0.95)


def test_errors_of_waves_are_independent_between_bins_and_the_others_are_not():
    """Of 4000 draws a correlation has a standard error of at most 1/sqrt(4000) = 0.016, and a variance 0.022."""
    whole = spectrum(error=0.3)
    q = whole.wavenumber
    for waves, expected in ((0.0, math.exp(-((math.log(q[1] / q[0]) / math.log(2)) ** 2))), (0.3, 0.0)):
        one = dataclasses.replace(whole, log_waves=np.full(q.size, waves))
        shared, _ = _shared_error(one, "mean")
        random = np.random.default_rng(1)
        off = np.array([np.log(density(q) / law(q)) for density in _curves(one, shared, 4000, random)])
        np.testing.assert_allclose(off.std(axis=0), 0.3, rtol=4 * 0.5 * 0.022)
        found = np.mean([np.corrcoef(off[:, k], off[:, k + 1])[0, 1] for k in range(q.size - 1)])
        assert found == pytest.approx(expected, abs=4 * 0.016)


def test_a_number_that_needs_scales_beyond_the_band_is_refused_alone():
    def found(size=SIZE, **ends):
        return rc.press_draws(spectrum(**ends), MODULUS, PRESSURE, size, draws=2, rng=1, measures=measures)

    measures = [lambda solution: {"largest_gap": float(np.nanmax(solution.gap))}]
    whole = found()
    assert not whole.refused
    assert not whole.notes
    assert set(whole.values) == {*NUMBERS, "largest_gap"} == set(whole.rests_on)
    assert whole.rests_on["contact_fraction"].startswith("waves down to l_c = 4e-06 m")
    assert whole.rests_on["interfacial_stiffness_per_area"] == "waves from 3.2e-05 m to 4e-06 m"

    coarse = found(shortest=1.2 * SHORTEST)
    assert set(coarse.refused) == {"interfacial_stiffness_per_area"}
    assert coarse.refused["interfacial_stiffness_per_area"].startswith(
        "needs waves down to an eighth of the roll-off"
    )
    assert "measure with finer points" in coarse.notes[0]

    short = found(longest=SIZE / 2)
    assert set(short.values) == {"contact_fraction"}
    assert set(short.refused) == {"interfacial_stiffness_per_area", "mean_gap", "largest_gap"}
    # What the text says is followed: the part of this size needs no longer waves.
    assert short.refused["mean_gap"].endswith("or press a size of at most 1.6e-05 m")
    assert "mean_gap" in found(longest=SIZE / 2, size=1.6e-5).values
    # And longer waves of a spectrum that is flat beyond the roll-off hold little.
    assert "mean_gap" in found(longest=6 * SIZE, size=8 * SIZE, shortest=4 * SHORTEST).values


def test_a_leak_is_pressed_too():
    found = rc.press_draws(
        spectrum(), MODULUS, PRESSURE, SIZE, draws=3, measures=[rc.Transmissivity(axis=0)], rng=1
    )
    low, high = found.intervals["hydraulic_gap"]
    assert 0 < low < high


def test_scatter_that_is_known_in_some_bins_is_continued_with_a_note():
    partly = spectrum(spread=np.r_[np.full(5, np.nan), np.full(6, SCATTER)])
    found = rc.press_draws(partly, MODULUS, PRESSURE, SIZE, draws=2, rng=1)
    assert "not known in 5 of 11 bins" in found.notes[0]
    all_known = rc.press_draws(spectrum(), MODULUS, PRESSURE, SIZE, draws=2, rng=1)
    np.testing.assert_array_equal(found.values["mean_gap"], all_known.values["mean_gap"])
