import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.fourier import wavenumbers

SQUARE = rc.Grid((64, 64), (0.1, 0.1))


def make(grid=SQUARE, hurst=0.8, rms=0.3, seed=0, **more):
    return rc.self_affine(grid, hurst, rms, np.random.default_rng(seed), **more)


def amplitudes(surface):
    return np.abs(np.fft.rfft2(surface.heights)) / surface.grid.size


@pytest.mark.parametrize("hurst", [-1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0])
@pytest.mark.parametrize(
    "grid", [SQUARE, rc.Grid((48, 80), (0.1, 0.2)), rc.Grid((33, 50), (1e-9, 1e-9), True)]
)
def test_amplitudes_follow_the_power_law_exactly(hurst, grid):
    """Eq. 2.14: B2D ~ q^-(H+1) for every wave but the Nyquist ones, whose phases are not free."""
    surface = make(grid, hurst)
    assert surface.rms == pytest.approx(0.3, rel=1e-12)
    assert abs(surface.heights.mean()) < 1e-13
    q, b = wavenumbers(grid.shape, grid.spacing), amplitudes(surface)
    free = np.ones_like(q, dtype=bool)
    free[0, 0] = False
    if grid.shape[0] % 2 == 0:
        free[grid.shape[0] // 2] = False
    if grid.shape[1] % 2 == 0:
        free[:, -1] = False
    scaled = b[free] * (q[free] / q[0, 1]) ** (hurst + 1)
    np.testing.assert_allclose(scaled, scaled[0], rtol=1e-8)  # rounding of the largest waves in the smallest
    assert b[~free].max() < 1e-12 * b.max()


def test_phases_do_not_depend_on_hurst():
    rough, smooth = (np.angle(np.fft.rfft2(make(hurst=h).heights))[1:30, 1:30] for h in (0.2, 1.5))
    np.testing.assert_allclose(np.exp(1j * rough), np.exp(1j * smooth), atol=1e-8)


def test_a_length_of_two_metres():
    """The law knows q only through ratios: the same numbers on cells of any size."""
    one, two = make(), make(rc.Grid((64, 64), (0.2, 0.2)))
    np.testing.assert_allclose(one.heights, two.heights, rtol=0, atol=1e-14)


def test_band_limits():
    q = wavenumbers(SQUARE.shape, SQUARE.spacing)
    length = 6.4
    b = amplitudes(make(cutoff_wavelength=length / 4, short_wavelength=length / 16))
    inside = (q >= 2 * np.pi * 4 / length * (1 - 1e-9)) & (q <= 2 * np.pi * 16 / length * (1 + 1e-9))
    assert (b[inside] > 1e-6).all()
    assert b[~inside].max() < 1e-15
    b = amplitudes(make(rolloff_wavelength=length / 4))
    plateau = b[(q > 0) & (q <= 2 * np.pi * 4 / length * (1 + 1e-9))]
    np.testing.assert_allclose(plateau, plateau[0], rtol=1e-10)


def test_disc_support():
    q = wavenumbers(SQUARE.shape, SQUARE.spacing)
    b = amplitudes(make(support="disc"))
    assert b[q > np.pi / 0.1].max() < 1e-15
    assert amplitudes(make(support="square"))[q > np.pi / 0.1].max() > 1e-6


def test_nodal_grids_repeat_their_edge():
    surface = make(rc.Grid((65, 33), (0.1, 0.1)), nodal=True)
    np.testing.assert_array_equal(surface.heights[0], surface.heights[-1])
    np.testing.assert_array_equal(surface.heights[:, 0], surface.heights[:, -1])
    assert np.std(surface.heights[:-1, :-1]) == pytest.approx(0.3, rel=1e-12)


def test_gaussian_amplitudes_scatter_about_the_law():
    """|B|^2 over the law is exponential with mean 1: 4 standard errors of 200 samples of some 800 waves."""
    exact = amplitudes(make()) ** 2
    samples = [amplitudes(make(seed=s, amplitudes="gaussian")) ** 2 for s in range(200)]
    ratio = (np.array(samples) / np.where(exact > 0, exact, 1))[:, 1:30, 1:30]
    error = 1 / np.sqrt(ratio.size)
    assert ratio.mean() == pytest.approx(1, abs=4 * error)
    assert (ratio**2).mean() == pytest.approx(2, abs=4 * np.sqrt(20) * error)  # var(x^2) = 4! - 2^2


def test_the_same_generator_gives_the_same_surface():
    np.testing.assert_array_equal(make(seed=5).heights, make(seed=5).heights)
    assert not np.array_equal(make(seed=5).heights, make(seed=6).heights)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"hurst": 3.5}, "hurst must lie"),
        ({"hurst": -1.1}, "hurst must lie"),
        ({"hurst": np.nan}, "hurst must lie"),
        ({"rms": 0.0}, "rms must be positive"),
        ({"rms": np.inf}, "rms must be positive"),
        ({"support": "ball"}, "support must be"),
        ({"amplitudes": "loud"}, "amplitudes must be"),
        ({"cutoff_wavelength": -1.0}, "cutoff_wavelength must be"),
        ({"short_wavelength": 2.0, "cutoff_wavelength": 1.0}, "no wave is left"),
        ({"cutoff_wavelength": 1e-3}, "no wave of this grid"),
        ({"grid": rc.Grid((64, 64), 0.1, True), "nodal": True}, "nodal"),
        ({"grid": rc.Grid(64, 0.1)}, "two axes"),
    ],
)
def test_nonsense_is_refused(more, message):
    with pytest.raises(ValueError, match=message):
        make(**more)


def test_a_seed_is_not_a_generator():
    with pytest.raises(ValueError, match="default_rng"):
        rc.self_affine(SQUARE, 0.8, 0.3, 7)
