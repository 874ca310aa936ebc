"""Random lines in batches are the lines that are made one by one."""

import numpy as np
import pytest
import scipy.fft

import roughcontact as rc
import roughcontact.mdr.lines.random_lines as random_lines
from roughcontact.mdr.lines.random_lines import line_heights, random_waves, rough_lines

GRID = rc.Grid(200, 1e-6)


def batch(spectrum, count, seed=0, **options):
    return np.concatenate(list(rough_lines(GRID, spectrum, np.random.default_rng(seed), count, **options)))


@pytest.mark.parametrize("n", [200, 201])
@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
@pytest.mark.parametrize("rms", [None, 3e-6])
def test_batches_hold_what_synthesise_makes_one_by_one(n, amplitudes, rms):
    grid, rng = rc.Grid(n, 1e-6), np.random.default_rng(3)
    spectrum = rc.SelfAffineSpectrum(0.7, rolloff=5e-5, dimension=1, scale=1e-9)
    alone = [rc.synthesise(grid, spectrum, rng, rms=rms, amplitudes=amplitudes).heights for _ in range(3)]
    rng = np.random.default_rng(3)
    [together] = rough_lines(grid, spectrum, rng, 3, rms=rms, amplitudes=amplitudes)
    np.testing.assert_allclose(together, alone, rtol=0, atol=1e-14 * np.abs(alone).max())


def test_batches_are_small_and_go_on_where_the_one_before_ended(monkeypatch):
    spectrum = rc.SelfAffineSpectrum(0.7, dimension=1)
    whole = batch(spectrum, 7)
    monkeypatch.setattr(random_lines, "BATCH", 600)
    parts = list(rough_lines(GRID, spectrum, np.random.default_rng(0), 7))
    assert [len(part) for part in parts] == [3, 3, 1]
    np.testing.assert_allclose(np.concatenate(parts), whole, rtol=0, atol=1e-14 * np.abs(whole).max())


def test_every_line_has_the_spectrum_and_no_mean():
    spectrum = rc.SelfAffineSpectrum(0.4, dimension=1, scale=1e-9)
    lines = batch(spectrum, 4)
    waves = np.abs(scipy.fft.rfft(lines))[:, 1:100] / 200
    q = 2 * np.pi * np.arange(1, 100) / 200e-6
    # B^2 = 2 pi/L C1D (thesis, eq. 2.11).
    np.testing.assert_allclose(waves, np.tile(np.sqrt(2 * np.pi / 200e-6 * spectrum(q)), (4, 1)), rtol=1e-10)
    np.testing.assert_allclose(lines.mean(axis=1), 0, atol=1e-14 * lines.std())


def test_the_rms_height_is_that_asked_for():
    lines = batch(rc.SelfAffineSpectrum(1.2, dimension=1), 4, rms=2e-6)
    np.testing.assert_allclose(lines.std(axis=1), 2e-6, rtol=1e-13)


def test_waves_serve_many_spectra():
    waves = random_waves(GRID, np.random.default_rng(0), 3)
    for hurst in (0.2, 1.5):
        spectrum = rc.SelfAffineSpectrum(hurst, dimension=1)
        np.testing.assert_array_equal(line_heights(GRID, spectrum, waves), batch(spectrum, 3))


def test_gaussian_waves_have_unit_power_on_average():
    waves = random_waves(GRID, np.random.default_rng(0), 500, amplitudes="gaussian")
    # 49500 exponentially distributed powers: their mean is known to 1/sqrt(49500).
    assert np.mean(np.abs(waves[:, 1:100]) ** 2) == pytest.approx(1, abs=4 / np.sqrt(49500))


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda rng: rough_lines(GRID, np.ones_like, rng, 0), "number of lines"),
        (lambda rng: rough_lines(rc.Grid((8, 8), 1.0), np.ones_like, rng, 1), "one axis"),
        (lambda rng: rough_lines(GRID, np.ones_like, "7", 1), "numpy.random.Generator"),
        (lambda rng: rough_lines(GRID, np.ones_like, rng, 1, rms=-1.0), "rms must be positive"),
        (lambda rng: rough_lines(GRID, rc.SelfAffineSpectrum(0.5), rng, 1), "dimension"),
        (lambda rng: random_waves(GRID, rng, 1, amplitudes="flat"), "'exact' or 'gaussian'"),
        (lambda rng: line_heights(GRID, np.ones_like, random_waves(rc.Grid(8, 1.0), rng, 1)), "do not fit"),
    ],
)
def test_what_makes_no_sense_is_refused_at_once(call, says):
    with pytest.raises(ValueError, match=says):
        call(np.random.default_rng(0))


def test_what_is_no_spectrum_and_no_count():
    grid = rc.Grid(64, 1e-6)
    surface = rc.Surface(np.zeros((30, 30)), rc.Grid((30, 30), 1.0))
    with pytest.raises(ValueError, match=r"spectrum C1D\(q\) is needed.*not a Surface$"):
        rough_lines(grid, surface, np.random.default_rng(0), 2)
    with pytest.raises(ValueError, match=r"number of lines.*not 2.5"):
        rough_lines(grid, lambda q: q, np.random.default_rng(0), 2.5)
