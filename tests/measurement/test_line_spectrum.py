"""The median spectrum of profiles: its factor, its error, spikes, and profiles that are not alike."""

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((96, 128), 1e-6, periodic=True)


def rough(seed, grid=GRID):
    return rc.self_affine(grid, 0.8, 1e-7, seed, amplitudes="gaussian")


def test_the_factor_makes_the_median_that_of_the_mean():
    """Over 30 maps; the ratio of median and mean scatters by 1.04/sqrt(N) for N independent profiles, and less in bins
    of several waves."""
    found = [rc.line_spectra(rough(seed)) for seed in range(30)]
    ratio = np.mean([each.median.density / each.mean.density for each in found], axis=0)
    number = found[0].mean.freedom
    assert (np.abs(ratio - 1) < 3 * 1.04 / np.sqrt(30 * number) + 0.02).all()
    assert np.mean([each.ratio for each in found]) == pytest.approx(np.log(2), abs=0.01)
    # One map in 100 has a spoilt profile by chance, and more where few profiles are independent.
    assert sum(each.spoilt.any() for each in found) <= 3


def test_the_error_of_the_median_is_that_of_exponential_numbers():
    """Rows that are independent, in bins of one wave: 1.44/sqrt(96); of 60 maps the estimate has an error of 9 %."""
    rng = np.random.default_rng(3)
    found = [rc.line_spectra(rc.Surface(rng.standard_normal(GRID.shape), GRID)) for _ in range(60)]
    first = np.array([each.median.density[0] for each in found])
    truth = np.mean([each.mean.density[0] for each in found])
    assert np.std(first / truth) == pytest.approx(1.44 / np.sqrt(96), rel=3 * 0.09)
    assert found[0].median.freedom[0] == pytest.approx(96 / 1.44**2, rel=0.3)


def test_a_tenth_of_spoilt_profiles_changes_the_median_little():
    """The median becomes that quantile of the sound rows that lies at 0.5/0.9: -ln(1 - 0.556)/ln 2 = 1.17 times."""
    ratios, means = [], []
    for seed in range(20):
        sound = rough(seed)
        spoilt = np.random.default_rng(seed).permutation(96) < 10
        found = rc.line_spectra(rc.Surface(np.where(spoilt[:, None], 100, 1) * sound.heights, GRID))
        assert found.spoilt[spoilt].all()
        assert not found.spoilt[~spoilt].any()
        right = rc.line_spectra(sound)
        ratios.append(found.median.density / right.median.density)
        means.append(found.mean.density / right.mean.density)
    few = right.median.wavelength > 2e-5  # bins of one wave
    assert np.mean(np.array(ratios)[:, few]) == pytest.approx(1.17, abs=0.07)
    assert np.mean(ratios, axis=0).max() < 1.3
    assert np.mean(means) > 500


@pytest.mark.parametrize("direction", ["x", "y"])
def test_both_directions_and_free_maps(direction):
    surface = rough(1, rc.Grid((96, 128), (2e-6, 1e-6)))
    found = rc.line_spectra(surface, direction)
    assert found.spoilt.shape == ((96,) if direction == "x" else (128,))
    fine = rc.power_spectrum(surface, direction).rebinned(10)
    np.testing.assert_allclose(found.mean.density, fine.density, rtol=0.2)  # its waves are weighted otherwise
    well = fine.freedom > 30
    np.testing.assert_allclose(found.median.density[well], fine.density[well], rtol=0.5)


X = np.arange(128)
PHASES = 2 * np.pi * np.random.default_rng(1).random((96, 1))


@pytest.mark.parametrize(
    ("heights", "words"),
    [
        # Equal amplitudes in all profiles, with independent phases: their power does not scatter.
        (
            0.1 * rough(1).heights + 1e-7 * np.sin(np.pi * X / 8 + PHASES),
            "not alike at a wavelength of 1.6e-05 m",
        ),
        (np.exp(1.5 * rough(1).heights / rough(1).rms) * 1e-7, "profiles along x hold spikes"),
    ],
)
def test_profiles_that_are_not_alike_are_refused(heights, words):
    with pytest.raises(rc.InputError, match=words):
        rc.line_spectra(rc.Surface(heights, GRID))


def test_the_same_wave_in_all_profiles_counts_once_and_stays():
    """Its median is its mean: no factor is due."""
    lay = rc.Surface(0.01 * rough(1).heights + 1e-7 * np.sin(np.pi * X / 8), GRID)
    found = rc.line_spectra(lay)
    at = int(np.argmax(found.mean.density))
    assert found.median.density[at] / found.mean.density[at] == pytest.approx(1, abs=0.03)
