import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.generation.fourier import synthesise
from roughcontact.surface.generation.spectrum import DirectionalSpectrum, SelfAffineSpectrum
from roughcontact.surface.moments import Moments, grid_moments, surface_moments

SQUARE = rc.Grid((64, 64), 1e-6 / 64, True)


def same(one, other, rel):
    assert one.dimension == other.dimension
    for name in ("m0", "m2", "m4"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=rel)


@pytest.mark.parametrize("hurst", [-0.5, 0.3, 0.8, 1.0, 2.0])
@pytest.mark.parametrize("support", ["square", "disc"])
@pytest.mark.parametrize("grid", [SQUARE, rc.Grid((33, 48), (0.1, 0.2), True), rc.Grid(128, 0.1, True)])
def test_sums_over_a_spectrum_are_the_moments_of_its_surfaces(grid, hurst, support):
    rms = 0.01 * grid.lengths[-1]
    surface = rc.self_affine(grid, hurst, rms, np.random.default_rng(1), support=support)
    law = SelfAffineSpectrum(hurst, dimension=grid.ndim).scaled(rms, grid, support)
    same(surface_moments(surface), grid_moments(grid, law, support=support), 1e-10)
    assert surface_moments(surface).rms_height == pytest.approx(surface.rms, rel=1e-12)


def test_the_mean_of_gaussian_surfaces():
    """<z^2> of a sample scatters about the sum: within 4 of its standard errors over 400 lines."""
    grid = rc.Grid(64, 1.0, True)
    law = SelfAffineSpectrum(0.5, dimension=1)
    rng = np.random.default_rng(2)
    samples = [surface_moments(synthesise(grid, law, rng, amplitudes="gaussian")).m0 for _ in range(400)]
    error = np.std(samples, ddof=1) / 20
    assert np.mean(samples) == pytest.approx(grid_moments(grid, law).m0, abs=4 * error)


def test_a_single_wave():
    """z = h cos qx: mean squares h^2/2, q^2 h^2/2, q^4 h^2/2; on a surface the mean over directions takes 1/2, 3/8."""
    h, n = 0.3, 64
    q = 2 * np.pi * 3
    z = h * np.cos(q * np.arange(n) / n)
    line = surface_moments(rc.Surface(z, rc.Grid(n, 1 / n, True)))
    same(line, Moments(h**2 / 2, q**2 * h**2 / 2, q**4 * h**2 / 2, 1), 1e-12)
    assert line.rms_slope == pytest.approx(q * h / np.sqrt(2), rel=1e-12)
    assert line.rms_curvature == pytest.approx(q**2 * h / np.sqrt(2), rel=1e-12)
    wavy = surface_moments(rc.Surface(np.tile(z, (8, 1)), rc.Grid((8, n), 1 / n, True)))
    same(wavy, Moments(h**2 / 2, q**2 * h**2 / 4, 3 * q**4 * h**2 / 16), 1e-12)
    assert wavy.rms_slope == pytest.approx(line.rms_slope, rel=1e-12)  # |grad z| is |z'|
    assert wavy.rms_curvature == pytest.approx(
        line.rms_curvature / 2, rel=1e-12
    )  # one of two curvatures is 0


def test_profile_and_areal_moments():
    """On a square lattice the mean of <z_x^2> and <z_y^2> is m2, and that of the lines' own moments as well."""
    surface = rc.self_affine(SQUARE, 0.6, 1e-8, np.random.default_rng(3))
    line_grid = rc.Grid(64, 1e-6 / 64, True)
    lines = [rc.Surface(row, line_grid) for z in (surface.heights, surface.heights.T) for row in z]
    m2 = np.mean([surface_moments(line).m2 for line in lines])
    areal = surface_moments(surface)
    assert m2 == pytest.approx(areal.m2, rel=1e-12)
    assert areal.rms_slope == pytest.approx(np.sqrt(2 * m2), rel=1e-12)
    assert areal.profile.rms_slope == pytest.approx(np.sqrt(m2), rel=1e-12)
    assert areal.profile.rms_curvature == pytest.approx(np.sqrt(areal.m4), rel=1e-14)
    assert areal.profile.m4 == areal.m4
    assert areal.nayak == pytest.approx(areal.m0 * areal.m4 / areal.m2**2)


def test_nayak_of_a_thin_ring_of_waves():
    """One wavelength in all directions: alpha = 3/2, the smallest of an isotropic surface."""
    law = SelfAffineSpectrum(0.5, None, 1.0, 0.999)
    assert law.moments().nayak == pytest.approx(1.5, rel=1e-5)  # 1 + O(width^2)
    wide = SelfAffineSpectrum(0.8, None, 1.0, 1e-3).moments()
    # 3/2 (H (2-H))^-1 ... : m0 m4/m2^2 = (3/2) [1/2H][1/(4-2H)] (2-2H)^2 zeta^(2H), to the ends' corrections
    growth = 1.5 * (2 - 1.6) ** 2 / (1.6 * 2.4) * 1e3**1.6
    assert wide.nayak == pytest.approx(growth / (1 - 1e3**-0.4) ** 2, rel=1e-3)


@pytest.mark.parametrize("grid", [rc.Grid((128, 96), (0.1, 0.2), True), rc.Grid(128, 0.1, True)])
def test_differences_damp_each_wave_as_stated(grid):
    surface = rc.self_affine(grid, 0.7, 0.1, np.random.default_rng(4))
    parts = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(grid.shape, grid.spacing, strict=True)]
    mesh = np.meshgrid(*parts, indexing="ij")
    seen = sum((2 * np.sin(q * d / 2) / d) ** 2 for q, d in zip(mesh, grid.spacing, strict=True))
    power = np.abs(np.fft.fftn(surface.heights) / grid.size) ** 2
    squares, fourths = (1, 1) if grid.ndim == 1 else (1 / 2, 3 / 8)
    expected = Moments(
        power.sum(), squares * (seen * power).sum(), fourths * (seen**2 * power).sum(), grid.ndim
    )
    same(surface_moments(surface, derivative="difference"), expected, 1e-11)


def test_differences_see_less_slope():
    """At H = 0.7 and n = 128 the mean square slope comes out 15 % low: the equation page's 0.85."""
    surface = rc.self_affine(rc.Grid((128, 128), 1 / 128, True), 0.7, 0.1, np.random.default_rng(5))
    ratio = surface_moments(surface, derivative="difference").m2 / surface_moments(surface).m2
    assert ratio == pytest.approx(0.85, abs=0.005)


def test_free_surfaces_with_missing_points():
    """A bowl z = a x^2 + b y^2 has constant second differences, whatever is missing; a slope is seen as it is."""
    y, x = np.mgrid[:20, :30].astype(float)
    heights = 0.5 * x**2 + 0.25 * y**2
    heights[3, 4] = heights[0, 0] = heights[19, 7:9] = np.nan
    moments = surface_moments(rc.Surface(heights, rc.Grid((20, 30), (2.0, 2.0))))
    assert moments.m4 == pytest.approx(3 / 8 * ((1 + 0.5) / 4) ** 2, rel=1e-12)
    assert moments.m0 == pytest.approx(np.nanvar(heights), rel=1e-14)
    tilted = surface_moments(rc.Surface(3 * x - 4 * y, rc.Grid((20, 30), (2.0, 2.0))))
    assert tilted.rms_slope == pytest.approx(np.hypot(3, 4) / 2, rel=1e-12)
    assert tilted.m4 == pytest.approx(0, abs=1e-20)


def test_a_free_grid_does_not_wrap_unless_asked_to():
    ramp = rc.Surface(np.arange(32.0), rc.Grid(32, 1.0))
    assert surface_moments(ramp).m2 == pytest.approx(1, rel=1e-12)
    assert surface_moments(ramp, derivative="spectral").m2 > 10  # the step at the edge


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Moments(-1.0, 1.0, 1.0), "m0 must not be negative"),
        (lambda: Moments(1.0, np.nan, 1.0), "m2 must be a number"),
        (lambda: Moments(1.0, 1.0, 1.0, 3), "dimension must be"),
        (
            lambda: surface_moments(rc.Surface(np.ones(8), rc.Grid(8, 1.0)), derivative="exact"),
            "derivative must be",
        ),
        (
            lambda: surface_moments(
                rc.Surface([1.0, np.nan, 2.0], rc.Grid(3, 1.0, True)), derivative="spectral"
            ),
            "1 points are",
        ),
        (lambda: surface_moments(rc.Surface([1.0, np.nan, 2.0], rc.Grid(3, 1.0))), "measured neighbours"),
        (lambda: grid_moments(rc.Grid(9, 1.0), DirectionalSpectrum(lambda y, x: y)), "two axes"),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
