import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.power_map import power_map
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum


def noise(shape, spacing=(0.5, 0.25), periodic=True, seed=0):
    grid = rc.Grid(shape, spacing, periodic)
    return rc.Surface(np.random.default_rng(seed).standard_normal(shape), grid)


@pytest.mark.parametrize("shape", [(6, 8), (7, 8), (6, 9), (7, 9)])
def test_the_powers_add_up_to_the_mean_square(shape):
    surface = noise(shape)
    assert power_map(surface).variance == pytest.approx(surface.rms**2, rel=1e-12)


@pytest.mark.parametrize("shape", [(6, 8), (7, 9)])
def test_the_whole_plane_is_that_of_the_complex_transform(shape):
    surface = noise(shape)
    qy, qx, density = power_map(surface).centred()
    scale = surface.grid.area / (2 * math.pi) ** 2
    whole = np.abs(np.fft.fft2(surface.heights - surface.heights.mean()) / surface.grid.size) ** 2 * scale
    np.testing.assert_allclose(density, np.fft.fftshift(whole), rtol=1e-12, atol=1e-14 * whole.max())
    np.testing.assert_allclose(qy, np.fft.fftshift(2 * np.pi * np.fft.fftfreq(shape[0], 0.5)), atol=1e-12)
    np.testing.assert_allclose(qx, np.fft.fftshift(2 * np.pi * np.fft.fftfreq(shape[1], 0.25)), atol=1e-12)


def test_one_wave_has_its_power_in_one_place():
    """Two opposite waves of amplitude A/2: C2D = (A/2)^2 L^2/(2 pi)^2 (thesis, eq. 2.14)."""
    n, length, amplitude = 32, 3.0, 0.7
    x = (np.arange(n) + 0.5) * length / n
    heights = amplitude * np.cos(2 * np.pi / length * (3 * x[:, None] + 5 * x))
    waves = power_map(rc.Surface(heights, rc.Grid((n, n), length / n, True)))
    expected = (amplitude / 2) ** 2 * (length / (2 * np.pi)) ** 2
    assert waves.density[3, 5] == pytest.approx(expected, rel=1e-12)
    assert (waves.density > 1e-20).sum() == 1


@pytest.mark.parametrize("length", [1.0, 2.0])
def test_spectrum_to_surface_to_spectrum(length):
    """And L = 1 against L = 2 in metres: C2D scales as m^4 (thesis, eq. 2.7)."""
    n, law = 64, SelfAffineSpectrum(0.7, rolloff=length / 4)
    grid = rc.Grid((n, n), length / n, True)
    surface = rc.self_affine(grid, 0.7, 1e-2, np.random.default_rng(3), rolloff=length / 4)
    waves = power_map(surface)
    q = np.hypot(waves.qy[:, None], waves.qx)
    keep = (q > 0) & (np.arange(n) != n // 2)[:, None] & (np.arange(n // 2 + 1) != n // 2)
    both = np.where(np.arange(n // 2 + 1) > 0, 2, 1)
    constant = 1e-4 / (np.where(keep, law(q), 0) * both).sum() * (length / (2 * np.pi)) ** 2
    # The error of an amplitude is that of the largest one, of the order of eps log2(n^2) = 3e-15, and the weakest has
    # 1/60 of that, (44/4)^-1.7: 2 * 60 * 3e-15 of its power, 3e-13.
    np.testing.assert_allclose(waves.density[keep], constant * law(q)[keep], rtol=1e-12)
    assert waves.variance == pytest.approx(1e-4, rel=1e-12)


def test_a_window_leaves_the_level_of_white_noise():
    """Its mean over all waves but the lowest; that mean has the relative scatter sqrt(overlap^2/waves)."""
    surface = noise((128, 128), (1.0, 1.0), periodic=False)
    density = power_map(surface).density[3:-3, 3:-1]
    scatter = (35 / 18) / math.sqrt(density.size)
    assert density.mean() == pytest.approx(1 / (2 * math.pi) ** 2, rel=4 * scatter)


def test_a_tilted_plane_has_no_power_unless_it_is_kept():
    y, x = np.mgrid[:40, :50]
    surface = rc.Surface(1e6 + 3.0 * x - 2.0 * y, rc.Grid((40, 50), 1.0))
    assert power_map(surface).variance < 1e-16
    assert power_map(surface, level="mean", window="none").variance == pytest.approx(
        surface.rms**2, rel=1e-12
    )


def test_what_cannot_be_transformed_is_refused():
    holed = np.ones((4, 4))
    holed[1, 1] = np.nan
    with pytest.raises(ValueError, match="1 are missing"):
        power_map(rc.Surface(holed, rc.Grid((4, 4), 1.0)))
    with pytest.raises(ValueError, match="2 x 2"):
        power_map(rc.Surface(np.ones(4), rc.Grid(4, 1.0)))
    with pytest.raises(ValueError, match="level must be"):
        power_map(noise((4, 4)), level="bowl")
