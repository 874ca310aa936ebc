import itertools

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import zeta

import roughcontact as rc
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum
from roughcontact.surface.moments import grid_moments

TAU = 2 * np.pi


def by_quadrature(spectrum, n):
    """Profile moment by integrating over ln q, piece by piece."""
    angular = 2.0 if spectrum.dimension == 1 else {0: TAU, 2: np.pi, 4: 3 * np.pi / 4}[n]
    bends = sorted(
        {spectrum.q_min, np.clip(spectrum.q_rolloff, spectrum.q_min, spectrum.q_max), spectrum.q_max}
    )
    pieces = itertools.pairwise(bends)

    def integrand(u):
        return np.exp(u * (n + spectrum.dimension)) * float(spectrum(np.exp(u)))

    return angular * sum(quad(integrand, np.log(a), np.log(b), epsrel=1e-12, epsabs=0)[0] for a, b in pieces)


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("rolloff", [None, 0.1, 5.0, 1e-3])
@pytest.mark.parametrize("hurst", [-1.0, 0.0, 0.7, 1.0, 1.5, 2.0, 3.0])
def test_moments_in_closed_form(hurst, rolloff, dimension):
    """Against quadrature: with a bend inside the band, below and above it; logarithms at H = 0, 1, 2."""
    spectrum = SelfAffineSpectrum(hurst, rolloff, 1.0, 0.01, dimension, scale=2.5)
    moments = spectrum.moments()
    assert moments.dimension == dimension
    for n, value in ((0, moments.m0), (2, moments.m2), (4, moments.m4)):
        assert value == pytest.approx(by_quadrature(spectrum, n), rel=1e-9)


@pytest.mark.parametrize("hurst", [0.0, 1.0, 2.0])
def test_moments_pass_smoothly_through_their_logarithms(hurst):
    at, beside = (SelfAffineSpectrum(h, None, 1.0, 0.01).moments() for h in (hurst, hurst + 1e-11))
    for name in ("m0", "m2", "m4"):
        # d ln(moment)/dH is at most 2 ln(q_max): 1e-11 * 2 ln(628)
        assert getattr(at, name) == pytest.approx(getattr(beside, name), rel=2e-10)


def test_slope_of_the_thesis():
    """Eq. 4.18: <|grad z|^2> = 2 pi C(q0) q0^(2H+2) (q1^(2-2H) - q0^(2-2H))/(2-2H)."""
    h, q0, q1 = 0.8, TAU, 100 * TAU
    spectrum = SelfAffineSpectrum(h, long_cutoff=1.0, short_cutoff=0.01)
    expected = (
        TAU * q0 ** (-2 * h - 2) * q0 ** (2 * h + 2) * (q1 ** (2 - 2 * h) - q0 ** (2 - 2 * h)) / (2 - 2 * h)
    )
    assert spectrum.moments().rms_slope ** 2 == pytest.approx(expected, rel=1e-12)


def test_moments_of_a_band_without_ends_diverge_where_they_must():
    endless = SelfAffineSpectrum(0.8)
    assert (endless.q_min, endless.q_max) == (0, np.inf)
    assert endless.moments().m0 == endless.moments().m2 == endless.moments().m4 == np.inf
    assert np.isnan(endless.moments().nayak)
    flat = SelfAffineSpectrum(1.5, rolloff=1.0).moments()
    # plateau q_r^2/2 and tail q_r^2/(2H), times C(q_r)
    assert flat.m0 == pytest.approx(TAU * TAU**-5 * TAU**2 * (1 / 2 + 1 / 3), rel=1e-12)
    assert flat.m2 == pytest.approx(np.pi * TAU**-5 * TAU**4 * (1 / 4 + 1), rel=1e-12)
    assert flat.m4 == np.inf
    steep = SelfAffineSpectrum(-0.5, short_cutoff=1.0).moments()
    assert steep.m0 == pytest.approx(TAU * TAU, rel=1e-12)


@pytest.mark.parametrize("dimension", [1, 2])
@pytest.mark.parametrize("unit", [1.0, 1e-9])
def test_scaled_to_an_rms_height(dimension, unit):
    """Of the integral, or of the sum over a grid; the law itself stays."""
    law = SelfAffineSpectrum(0.7, 0.5 * unit, unit, 0.01 * unit, dimension)
    scaled = law.scaled(0.3 * unit)
    assert scaled.moments().rms_height == pytest.approx(0.3 * unit, rel=1e-13)
    q = np.array([0.5, 1, 3, 20, 99, 101]) * TAU / unit
    np.testing.assert_allclose(scaled(q), scaled.scale * law(q), rtol=1e-13)
    grid = rc.Grid((64,) * dimension, unit / 64)
    on_grid = law.scaled(0.3 * unit, grid, "disc")
    assert grid_moments(grid, on_grid, support="disc").rms_height == pytest.approx(0.3 * unit, rel=1e-13)
    assert on_grid.scale != pytest.approx(scaled.scale, rel=1e-3)


def test_the_sum_over_a_lattice():
    """Sum' (n^2 + m^2)^-(H+1) = 4 zeta(H+1) beta(H+1); beta(3) = pi^3/32, so 1.49 times the integral pi/H."""
    n = 256
    grid = rc.Grid((n, n), TAU / n)  # q counts waves, B^2 = C2D
    total = grid_moments(grid, SelfAffineSpectrum(2.0)).m0
    beyond = TAU / 4 * (n / 2 - 1) ** -4.0  # the integral of q^-6 outside the circle in the square
    assert 0 < 4 * zeta(3) * np.pi**3 / 32 - total < 1.05 * beyond


def test_values_without_a_scale():
    """C(q)/C(1), zero outside the band and at q = 0."""
    q = np.array([0.0, 1.0, 2.0, 4.0, 8.0])
    np.testing.assert_allclose(SelfAffineSpectrum(0.5)(q), [0, 1, 2**-3, 4**-3, 8**-3], rtol=1e-14)
    np.testing.assert_allclose(
        SelfAffineSpectrum(0.5, dimension=1)(q), [0, 1, 2**-2, 4**-2, 8**-2], rtol=1e-14
    )
    banded = SelfAffineSpectrum(0.5, TAU / 4, TAU / 2, TAU / 6)
    np.testing.assert_allclose(banded(q), [0, 0, 4**-3, 4**-3, 0], rtol=1e-14)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: SelfAffineSpectrum(0.8, dimension=3), "dimension must be"),
        (lambda: SelfAffineSpectrum(0.8, scale=0.0), "scale must be"),
        (lambda: SelfAffineSpectrum(0.8).scaled(1.0), "give long_cutoff"),
        (lambda: SelfAffineSpectrum(0.8, None, 1.0).scaled(0.0), "rms must be"),
        (lambda: SelfAffineSpectrum(0.8, None, 1.0, 1.0).scaled(1.0), "give long_cutoff"),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
