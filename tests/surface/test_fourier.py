import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.generation.fourier import synthesise, wavenumbers
from roughcontact.surface.generation.spectrum import (
    DirectionalSpectrum,
    SelfAffineSpectrum,
    StretchedSpectrum,
)
from roughcontact.surface.moments import surface_moments

SQUARE = rc.Grid((64, 64), (0.1, 0.1))


def make(grid=SQUARE, hurst=0.8, rms=0.3, seed=0, **more):
    return rc.self_affine(grid, hurst, rms, np.random.default_rng(seed), **more)


def amplitudes(surface):
    return np.abs(np.fft.rfft2(surface.heights)) / surface.grid.size


def rounding(surface):
    """Return a bound on the error of all amplitudes together, root of the sum of squares [m]: there and back.

    A transform of N values makes an error of log2(N) (1 + 4 sqrt(2)) eps/2 of their norm at most (Higham, Accuracy
    and Stability, 2nd ed., theorem 24.2), and the norm of all amplitudes is the rms height (Parseval). It is no bound
    relative to each wave: the error of a strong wave reaches weak ones.
    """
    return 2 * np.log2(surface.grid.size) * 3.33 * np.finfo(float).eps * surface.rms


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
    law = np.zeros_like(q)
    law[free] = q[free] ** (-hurst - 1)
    # The inner columns stand for two waves each; at a Nyquist wavenumber there are none.
    law *= 0.3 / np.sqrt((law**2 * np.where(np.arange(q.shape[1]) > 0, 2, 1)).sum())
    assert np.linalg.norm(b - law) < rounding(surface) < 1e-12 * surface.rms
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
    b = amplitudes(make(long_cutoff=length / 4, short_cutoff=length / 16))
    inside = (q >= 2 * np.pi * 4 / length * (1 - 1e-9)) & (q <= 2 * np.pi * 16 / length * (1 + 1e-9))
    assert (b[inside] > 1e-6).all()
    assert b[~inside].max() < 1e-15
    b = amplitudes(make(rolloff=length / 4))
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
        ({"hurst": np.nan}, "hurst must be a number"),
        ({"rms": 0.0}, "rms must be positive"),
        ({"rms": np.inf}, "rms must be positive"),
        ({"support": "ball"}, "support must be"),
        ({"amplitudes": "loud"}, "amplitudes must be"),
        ({"long_cutoff": -1.0}, "long_cutoff must be"),
        ({"short_cutoff": 2.0, "long_cutoff": 1.0}, "no wave is left"),
        ({"long_cutoff": 1e-3}, "no wave of this grid"),
        ({"grid": rc.Grid((64, 64), 0.1, True), "nodal": True}, "nodal"),
        ({"grid": rc.Grid(64, 0.1), "anisotropy": (2.0, 0.0)}, "a line has no direction"),
        ({"anisotropy": (0.0, 0.0)}, "ratio of an anisotropy"),
        ({"anisotropy": (2.0, np.inf)}, "angle of an anisotropy"),
        ({"grid": rc.Grid((1, 1), 0.1)}, "no wave of this grid"),
        ({"grid": rc.Grid(2, 0.1), "nodal": True}, "at least 3 nodes"),
    ],
)
def test_nonsense_is_refused(more, message):
    with pytest.raises(ValueError, match=message):
        make(**more)


SEEDS = {
    "int": lambda: 7,
    "numpy integer": lambda: np.int64(7),
    "sequence": lambda: [7],
    "SeedSequence": lambda: np.random.SeedSequence(7),
    "BitGenerator": lambda: np.random.PCG64(7),
    "Generator": lambda: np.random.default_rng(7),
}
MAKERS = {
    "self_affine": lambda rng: rc.self_affine(SQUARE, 0.8, 0.3, rng=rng).heights,
    "synthesise": lambda rng: rc.synthesise(SQUARE, lambda q: q**-3.0, rng=rng).heights,
    "midpoint_line": lambda rng: rc.midpoint_line(rc.Grid(17, 1.0), 0.8, rng=rng, rms=1.0).heights,
    "midpoint_surface": lambda rng: rc.midpoint_surface(rc.Grid((9, 9), 1.0), 0.8, rng=rng, rms=1.0).heights,
    "random_waves": lambda rng: rc.mdr.random_lines.random_waves(LINE, rng, 3),
    "rough_lines": lambda rng: np.concatenate(
        list(rc.mdr.random_lines.rough_lines(rc.Grid(2**19, 1.0), lambda q: q**-2.0, rng, 3))
    ),
}


@pytest.mark.parametrize("maker", MAKERS)
def test_rng_is_what_default_rng_takes(maker):
    make = MAKERS[maker]
    expected = make(np.random.default_rng(7))
    for name, seed in SEEDS.items():
        np.testing.assert_array_equal(make(seed()), expected, err_msg=name)
    assert not np.array_equal(make(8), expected)
    assert not np.array_equal(make(None), make(None))
    for wrong in ("seven", 0.5, -1):
        with pytest.raises(ValueError, match="such as rng=1, or None"):
            make(wrong)


def test_a_generator_moves_on_and_a_seed_does_not():
    rng = np.random.default_rng(7)
    assert not np.array_equal(MAKERS["self_affine"](rng), MAKERS["self_affine"](rng))
    np.testing.assert_array_equal(MAKERS["self_affine"](7), MAKERS["self_affine"](7))


def estimated(surface):
    """C2D [m^4] or C1D [m^3] at all waves: (L/2pi)^2 |fft2(h)/n^2|^2, (L/2pi) |fft(h)/n|^2."""
    cell = np.prod([length / (2 * np.pi) for length in surface.grid.lengths])
    return cell * np.abs(np.fft.fftn(surface.heights) / surface.grid.size) ** 2


def all_waves(grid):
    """Wave vectors of the full transform, and which of them are neither the mean nor at a Nyquist wavenumber."""
    parts = [np.fft.fftfreq(n, d) for n, d in zip(grid.shape, grid.spacing, strict=True)]
    mesh = np.meshgrid(*(2 * np.pi * part for part in parts), indexing="ij")
    free = np.ones(grid.shape, dtype=bool)
    free.flat[0] = False
    for axis, n in enumerate(grid.shape):
        if n % 2 == 0:
            free[(slice(None),) * axis + (n // 2,)] = False
    return mesh, free


RECTANGLE = rc.Grid((48, 35), (0.1e-6, 0.2e-6), True)
LINE = rc.Grid(128, 0.1e-6, True)


@pytest.mark.parametrize("grid", [RECTANGLE, LINE, rc.Grid(129, 2.0)])
@pytest.mark.parametrize("hurst", [-0.5, 0.3, 0.8])
def test_spectrum_to_surface_to_spectrum(grid, hurst):
    """Eqs 2.10, 2.11, 2.13, 2.14 in absolute size, and back, to 1e-12; Parseval."""
    law = SelfAffineSpectrum(hurst, dimension=grid.ndim, scale=3e-19)
    surface = synthesise(grid, law, np.random.default_rng(1))
    mesh, free = all_waves(grid)
    exact = np.zeros(grid.shape)
    exact[free] = 3e-19 * np.sqrt(sum(q**2 for q in mesh))[free] ** (-2 * hurst - grid.ndim)
    estimate = estimated(surface)
    # Wave by wave: the weakest amplitude of these grids is 5e-4 of the rms height and more, an error is seldom as
    # large as eps of it; twice their ratio is 9e-13. All waves together may be held to the bound in `rounding`.
    np.testing.assert_allclose(estimate[free], exact[free], rtol=1e-12)
    assert np.abs(estimate - exact).sum() < 1e-12 * exact.sum()
    assert estimate[~free].max() < 1e-25 * estimate.max()
    element = np.prod([2 * np.pi / length for length in grid.lengths])
    assert surface.rms**2 == pytest.approx((exact * element).sum(), rel=1e-12)


@pytest.mark.parametrize("grid", [rc.Grid(16, 0.5, True), rc.Grid((7, 6), (0.5, 0.25), True)])
def test_heights_are_the_sum_of_cosines(grid):
    """Eqs 2.12 and 2.15 as corrected: each cosine with its place in it, both signs of q, B = sqrt((2 pi)^n C/A)."""
    surface = synthesise(grid, lambda q: 2 * q**-3.0, np.random.default_rng(2))
    mesh, free = all_waves(grid)
    phase = np.angle(np.fft.fftn(surface.heights))
    places = np.meshgrid(
        *(np.arange(n) * d for n, d in zip(grid.shape, grid.spacing, strict=True)), indexing="ij"
    )
    total = np.zeros(grid.shape)
    for index in zip(*np.nonzero(free), strict=True):
        q = [part[index] for part in mesh]
        density = 2 * np.linalg.norm(q) ** -3
        amplitude = np.sqrt(np.prod([2 * np.pi / length for length in grid.lengths]) * density)
        total += amplitude * np.cos(sum(a * x for a, x in zip(q, places, strict=True)) + phase[index])
    np.testing.assert_allclose(surface.heights, total, rtol=0, atol=1e-13 * np.abs(total).max())
    assert np.ptp(surface.heights) > 0  # eq. 2.12 as printed is the same everywhere


@pytest.mark.parametrize("ndim", [1, 2])
@pytest.mark.parametrize("hurst", [0.2, 1.3])
def test_one_spectrum_on_one_and_on_two_metres(ndim, hurst):
    """Eqs 2.1 and 2.7: with the same C(q) in m^4 (m^3) a length of 2 m carries 2^H the heights of 1 m."""
    law = SelfAffineSpectrum(hurst, dimension=ndim, scale=1e-6)
    one, two = (
        synthesise(rc.Grid((32,) * ndim, length / 32, True), law, np.random.default_rng(3))
        for length in (1, 2)
    )
    # A height is a sum over waves that may cancel: the measure is the rms height, not each height by itself.
    assert np.abs(two.heights - 2**hurst * one.heights).max() < 1e-12 * two.rms
    np.testing.assert_allclose(
        estimated(two), 4**hurst * 2**ndim * estimated(one), rtol=0, atol=1e-12 * estimated(two).max()
    )


@pytest.mark.parametrize("hurst", [-0.5, 0.0, 0.7, 2.0])
def test_lines_follow_their_own_law(hurst):
    """Eq. 2.10: C1D ~ q^-(2H+1), and a plateau where a roll-off asks for one."""
    line = make(LINE, hurst, rms=1e-7, rolloff=LINE.lengths[0] / 4)
    assert line.rms == pytest.approx(1e-7, rel=1e-12)
    assert abs(line.heights.mean()) < 1e-19
    estimate = estimated(line)[1:64]
    scaled = estimate / np.maximum(np.arange(1, 64), 4.0) ** (-2 * hurst - 1)
    np.testing.assert_allclose(scaled, scaled[0], rtol=1e-8)


def test_lines_keep_their_phases_and_may_be_nodal():
    rough, smooth = (np.angle(np.fft.rfft(make(LINE, h).heights))[1:64] for h in (0.2, 1.5))
    np.testing.assert_allclose(np.exp(1j * rough), np.exp(1j * smooth), atol=1e-8)
    nodal = make(rc.Grid(65, 0.1), nodal=True)
    assert nodal.heights[0] == nodal.heights[-1]
    assert nodal.heights[:-1].std() == pytest.approx(0.3, rel=1e-12)


def test_gaussian_amplitudes_have_the_right_size():
    """The mean of |B|^2 over its law is 1, of exponential scatter: 4 standard errors of 100 lines of 63 waves."""
    law = SelfAffineSpectrum(0.5, dimension=1, scale=1e-6)
    rng = np.random.default_rng(4)
    samples = [estimated(synthesise(LINE, law, rng, amplitudes="gaussian"))[1:64] for _ in range(100)]
    exact = law(wavenumbers(LINE.shape, LINE.spacing)[1:64])
    assert np.mean(samples / exact) == pytest.approx(1, abs=4 / np.sqrt(6300))


def test_stretched_surfaces():
    """The spectrum is the isotropic one at the stretched wave vectors; the process is longer along the angle."""
    angle, ratio = 0.4, 3.0
    surface = make(RECTANGLE, 0.8, rms=1e-8, anisotropy=(ratio, angle))
    (qy, qx), free = all_waves(RECTANGLE)
    along = qx * np.cos(angle) + qy * np.sin(angle)
    across = -qx * np.sin(angle) + qy * np.cos(angle)
    law = np.zeros(RECTANGLE.shape)
    law[free] = (ratio * along**2 + across**2 / ratio)[free] ** -1.8
    np.testing.assert_allclose(
        estimated(surface) / estimated(surface).sum(), law / law.sum(), rtol=1e-9, atol=1e-18
    )
    lengthwise = make(anisotropy=(4.0, 0.0)).heights
    assert (np.diff(lengthwise, axis=1) ** 2).mean() < 0.25 * (np.diff(lengthwise, axis=0) ** 2).mean()
    assert make(anisotropy=(1.0, 0.7)).heights == pytest.approx(make().heights, abs=1e-13)


def test_a_stretched_spectrum_keeps_its_power():
    """int C2D d2q does not change, as the stretch has determinant 1; the slopes become steeper across the lay."""
    grid = rc.Grid((256, 256), 1 / 256)
    ring = SelfAffineSpectrum(0.5, long_cutoff=1 / 16, short_cutoff=1 / 32)
    base, stretched = (
        surface_moments(synthesise(grid, s, np.random.default_rng(5)), derivative="spectral")
        for s in (ring, StretchedSpectrum(ring, 2.0, 0.3))
    )
    # Waves on the rim of the band are in or out: some sqrt(rim) of the pi (32^2 - 16^2) waves, 1 %.
    assert stretched.m0 == pytest.approx(base.m0, rel=0.02)
    assert stretched.m2 == pytest.approx(base.m2 * (2 + 1 / 2) / 2, rel=0.02)


def test_a_spectrum_of_the_wave_vector():
    spectrum = DirectionalSpectrum(lambda qy, qx: 1e-33 * np.exp(-((qy / 2e7) ** 2)) / (1 + (qx / 1e7) ** 2))
    surface = synthesise(RECTANGLE, spectrum, np.random.default_rng(6))
    mesh, free = all_waves(RECTANGLE)
    np.testing.assert_allclose(estimated(surface)[free], spectrum.at(*mesh)[free], rtol=1e-12)


@pytest.mark.parametrize(
    ("spectrum", "more", "message"),
    [
        (DirectionalSpectrum(lambda qy, qx: 2 + np.sign(qx + 1e-3 * qy)), {}, r"the same at \(qy, qx\)"),
        (lambda q: -q, {}, "not negative"),
        (lambda q: q * np.nan, {}, "must be finite"),
        (lambda q: np.ones(3), {}, "returned shape"),
        (SelfAffineSpectrum(0.8, dimension=1), {}, "make it with dimension=2"),
        (SelfAffineSpectrum(0.8), {"rms": -1.0}, "rms must be positive"),
        (SelfAffineSpectrum(0.8), {"amplitudes": "loud"}, "amplitudes must be"),
        (SelfAffineSpectrum(0.8), {"grid": LINE}, "make it with dimension=1"),
        (StretchedSpectrum(SelfAffineSpectrum(0.8), 2.0), {"grid": LINE}, "two axes"),
    ],
)
def test_nonsense_spectra_are_refused(spectrum, more, message):
    options = {"grid": SQUARE, **more}
    with pytest.raises(ValueError, match=message):
        synthesise(options.pop("grid"), spectrum, np.random.default_rng(0), **options)
