"""From one scan to the stiffness of its surface."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import line_spectrum
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.line_scan import scan_curves, scan_spectrum
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves

HURST, N, SPACING = 0.8, 1024, 1e-6
SURFACE = rc.SelfAffineSpectrum(HURST, long_cutoff=N * SPACING, scale=1.0)
GRID = rc.Grid((N, N), SPACING, periodic=True)
LINE = rc.Grid(N, SPACING, periodic=True)
SURFACE = SURFACE.scaled(1e-6, GRID)


@pytest.fixture(scope="module")
def cuts():
    """Every eighth row of a surface: scans of it."""
    heights = rc.synthesise(GRID, SURFACE, np.random.default_rng(1)).heights
    return [rc.Surface(row, LINE) for row in heights[::8]]


def test_the_spectrum_is_that_of_the_surface_in_the_middle_of_the_band(cuts):
    # Near the longest waves a cut holds more than the law says, and near the shortest ones less.
    q = np.geomspace(10, 60, 8) * 2 * math.pi / (N * SPACING)
    densities = np.array([scan_spectrum(cut, hurst=HURST)(q) for cut in cuts])
    truth = line_spectrum(SURFACE)(q)
    # 128 cuts of a surface, a bin of a tenth of a decade with two waves at least: each mean is known to 6 %.
    np.testing.assert_allclose(densities.mean(axis=0), truth, rtol=0.25)
    assert densities.mean() / truth.mean() == pytest.approx(1, abs=0.1)


def test_without_a_hurst_exponent_it_is_fitted_to_the_scan(cuts):
    # 500 waves give H to 0.03 or so; what is left of it in the density is the factor of a cut.
    low, high = (rc.cut_factor(HURST) / rc.cut_factor(hurst) for hurst in (0.7, 0.9))
    for cut in cuts[::16]:
        fitted, given = (scan_spectrum(cut, hurst=h)(np.array([1e5, 1e6])) for h in (None, HURST))
        ratio = fitted / given
        assert ratio[0] == pytest.approx(ratio[1], rel=1e-12)
        assert low < ratio[0] < high


def test_every_wave_of_the_scan_counts_unless_a_band_is_named(cuts):
    longest = 2 * math.pi / (N * SPACING)
    whole = scan_spectrum(cuts[0])
    assert whole.q_min == pytest.approx(longest)
    assert whole(np.array([longest]))[0] > 0
    part = scan_spectrum(cuts[0], q_min=4 * longest, q_max=1e6)
    assert part(np.array([longest, 3 * longest, 1.1e6])).tolist() == [0, 0, 0]
    assert (part.q_min, part.q_max) == (4 * longest, 1e6)


def test_the_factor_is_that_of_the_line(cuts):
    one, two = (scan_spectrum(cuts[0], factor=factor) for factor in (1.0, 2.5))
    q = np.array([1e5, 1e6])
    np.testing.assert_allclose(two(q), 2.5 * one(q), rtol=1e-13)


def test_the_curve_is_that_of_lines_of_the_surface(cuts):
    modulus, rms, length = 1e11, 1e-6, N * SPACING
    forces = np.geomspace(1e-2, 7e-2, 4) * modulus * rms * length
    rng = np.random.default_rng(2)
    batches = rough_lines(LINE, line_spectrum(SURFACE), rng, 400)
    truth = LineCurves.joined(loading_curves(h, SPACING, modulus, forces=forces) for h in batches)
    stiffness = [
        scan_curves(cut, modulus, rng, forces=forces, count=20).mean_stiffness("geometric")
        for cut in cuts[::4]
    ]
    # The rms heights of these lines scatter by 22 % with the longest waves of the scans, k ~ (F/h)^0.55 by 12 %, and of
    # 32 cuts through one surface a quarter may be independent.
    ratio = np.exp(np.log(stiffness).mean(axis=0)) / truth.mean_stiffness("geometric")
    np.testing.assert_allclose(ratio, 1, atol=3 * 0.12 / math.sqrt(8))


def test_curves_have_the_scale_of_the_scan(cuts):
    forces = [1.0, 2.0, 4.0]
    one = scan_curves(cuts[0], 1e11, np.random.default_rng(3), forces=forces, count=5)
    spectrum = scan_spectrum(cuts[0])
    two = scan_curves(cuts[0], 1e11, np.random.default_rng(3), forces=forces, count=5, spectrum=spectrum)
    np.testing.assert_array_equal(one.depth, two.depth)
    assert one.length == pytest.approx(N * SPACING)
    assert len(one) == 5


def test_a_map_is_sent_to_its_own_spectrum():
    surface = rc.self_affine(rc.Grid((32, 32), 1.0), 0.8, 1.0, np.random.default_rng(0))
    with pytest.raises(ValueError, match="for a map use its spectrum C2D"):
        scan_spectrum(surface)


def test_missing_points_are_refused():
    heights = np.random.default_rng(0).standard_normal(64)
    heights[3] = np.nan
    with pytest.raises(ValueError, match="missing"):
        scan_spectrum(rc.Surface(heights, rc.Grid(64, 1.0)))


def test_a_scan_is_a_surface():
    with pytest.raises(ValueError, match=r"scan must be a Surface, as .*, not 5"):
        scan_spectrum(5)
