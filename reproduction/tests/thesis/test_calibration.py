"""The factor that makes a line as stiff as its surface."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import line_spectrum
from roughcontact.mdr.lines.lattice_sums import lambda_rms
from roughcontact.mdr.lines.random_lines import line_heights, random_waves
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact_thesis.calibration import calibrated_lambda, force_ratio, matched_lambda

# Stiffness of one wave at low load, k/(E* L) = zeta (F/(E* h L))^(1/3): a cosine line, two crossed cosines.
LINE = (3 / (math.sqrt(2) * math.pi**2)) ** (1 / 3)
SURFACE = (6 / (4 * math.pi**2)) ** (1 / 3)


def test_of_a_single_wave_is_4():
    for hurst in (60.0, 1000.0):
        found = calibrated_lambda(hurst, line_prefactor=LINE, surface_prefactor=SURFACE)
        assert found == pytest.approx(4, rel=1e-14)


def test_a_single_wave_with_4_has_the_stiffness_of_the_crest_of_its_surface():
    # Crossed cosines of amplitude h0 and wavenumber q have a crest of radius R = 1/(h0 q^2) and k = 2 E* a,
    # a^3 = 3 F R/(4 E*) (Hertz). C2D is that of their four waves, each of mean square height h0^2/4.
    n, length, h0 = 2**20, 3e-3, 1e-6
    q = 2 * math.pi / length
    grid = rc.Grid(n, length / n)
    spectrum = line_spectrum(
        lambda x: np.where(x < 1.5 * q, h0**2 / 4 * (length / (2 * math.pi)) ** 2, 0.0), 4
    )
    heights = line_heights(grid, spectrum, random_waves(grid, np.random.default_rng(0), 1))
    modulus, forces = 2e11, np.geomspace(1e-8, 1e-7, 5) * 2e11 * h0 * length
    radius = (3 * forces / (4 * modulus * h0 * q**2)) ** (1 / 3)
    curves = loading_curves(heights, length / n, modulus, forces=forces)
    # The contact's ends are known to a spring each; and away from the crest's top the cosine is no parabola: a
    # part (q a)^2/12 in its slope, twice that at most in k.
    error = 2 * length / n / (2 * radius) + (q * radius) ** 2 / 6
    assert (error < 0.01).all()
    assert (np.abs(curves.stiffness[0] / (2 * modulus * radius) - 1) < error).all()


@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0, 2.0, 2.6])
@pytest.mark.parametrize("modes", [64, None])
def test_equal_prefactors_are_equal_rms_heights(hurst, modes):
    found = calibrated_lambda(hurst, modes=modes, line_prefactor=0.9, surface_prefactor=0.9)
    assert found == lambda_rms(hurst, modes)


@pytest.mark.parametrize(("hurst", "alpha"), [(0.0, 1.0), (0.5, 1 / 1.5), (2.0, 1 / 3), (5.0, 1 / 3)])
def test_a_line_with_it_follows_the_law_of_the_surface(hurst, alpha):
    line, surface, force = 0.95, 0.8, 0.013
    # A line of C1D = lambda q C2D has a rms height larger than the surface's by the root of the lambdas.
    larger = math.sqrt(
        calibrated_lambda(hurst, line_prefactor=line, surface_prefactor=surface) / lambda_rms(hurst)
    )
    assert line * (force / larger) ** alpha == pytest.approx(surface * force**alpha, rel=1e-13)


@pytest.mark.parametrize(
    ("hurst", "options", "says"),
    [
        (-0.1, {}, "at least 0"),
        (math.nan, {}, "finite"),
        (1.0, {"line_prefactor": 0.0}, "line_prefactor must be positive"),
        (1.0, {"surface_prefactor": math.inf}, "surface_prefactor must be positive"),
        (0.8, {"line_prefactor": 1e300}, "line_prefactor"),
    ],
)
def test_what_makes_no_sense_is_refused(hurst, options, says):
    with pytest.raises(ValueError, match=says):
        calibrated_lambda(hurst, **{"line_prefactor": 0.9, "surface_prefactor": 0.8} | options)


FORCE = np.geomspace(1e-4, 1, 33)


@pytest.mark.parametrize(("hurst", "alpha"), [(0.0, 1.0), (0.5, 1 / 1.5), (1.7, 1 / 2.7)])
@pytest.mark.parametrize("modes", [64, None])
def test_of_two_power_laws_both_ways_agree(hurst, alpha, modes):
    zeta = {"line": 0.95, "surface": 0.8}
    laws = {name: (FORCE, value * FORCE**alpha) for name, value in zeta.items()}
    low = 1.01 * zeta["line"] * FORCE[0] ** alpha  # where a law begins it may already be stiffer
    found = matched_lambda(hurst, **laws, window=(low, 0.7), modes=modes)
    expected = calibrated_lambda(hurst, line_prefactor=0.95, surface_prefactor=0.8, modes=modes)
    assert found == pytest.approx(expected, rel=1e-12)


def test_curves_that_are_no_power_laws_are_matched_in_their_window_alone():
    line = 0.9 * FORCE**0.6
    line[:12] *= 1 + (FORCE[11] / FORCE[:12] - 1) / 50  # something else below the window
    line[-3:] = line[-4]  # and no rise above it
    surface = (1.7 * FORCE, line)  # every force 1.7 times
    assert force_ratio((FORCE, line), surface, (line[12], line[20])) == pytest.approx(1.7, rel=1e-12)
    # A point that is no stiffer than the one before it is as good as none.
    rests, without = line.copy(), np.delete(np.arange(33), 15)
    rests[15] = rests[14] * 0.999
    window = (line[13], line[18])
    found = force_ratio((FORCE, rests), surface, window)
    assert found == pytest.approx(force_ratio((FORCE[without], line[without]), surface, window), rel=1e-12)
    # Of a kink at the middle of the window both halves count alike.
    kinked = FORCE * np.where(np.arange(33) < 16, 1.0, 4.0)
    ratio = force_ratio(
        (FORCE, 0.9 * FORCE**0.6), (kinked, 0.9 * FORCE**0.6), tuple(0.9 * FORCE[[8, 23]] ** 0.6)
    )
    assert ratio == pytest.approx(2, rel=1e-12)


def test_a_line_of_the_matched_spectrum_has_the_curve_it_was_matched_to():
    # The line of a surface whose stiffness is known: here that of other lines, three times as high.
    n, hurst, count = 2**10, 0.8, 200
    grid, rng = rc.Grid(n, 1 / n), np.random.default_rng(5)
    waves = random_waves(grid, rng, count)
    surface = rc.SelfAffineSpectrum(hurst).scaled(1.0, rc.Grid((n, n), 1 / n, periodic=True))

    def curve(factor, forces):
        heights = line_heights(grid, line_spectrum(surface, factor), waves)
        return loading_curves(heights, 1 / n, 1.0, forces=forces).mean_stiffness()

    same = lambda_rms(hurst, n // 2 - 1)
    plain = curve(same, FORCE)
    found = matched_lambda(hurst, (FORCE, plain), (3 * FORCE, plain), window=(0.05, 0.2), modes=n // 2 - 1)
    assert found == pytest.approx(9 * same, rel=1e-12)
    # Springs in contact are whole numbers, and a force that is a little more may move one of a thousand.
    np.testing.assert_allclose(curve(found, 3 * FORCE), plain, rtol=1e-6)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"window": (0.2, 0.1)}, "a lower and a higher stiffness"),
        ({"window": (1e-9, 0.1)}, "the line goes from .* not all over the window"),
        ({"window": (0.1, 0.9)}, "the surface goes from .* not all over the window"),
        ({"line": (FORCE[:5], FORCE)}, "a stiffness for each force"),
        ({"surface": (-FORCE[::-1], FORCE)}, "the forces of the surface must be positive and rise"),
        ({"line": (np.where(FORCE[20] == FORCE, 1.0, FORCE), FORCE)}, "the forces of the line must be"),
    ],
)
def test_curves_that_cannot_be_matched_are_refused(change, says):
    given = {"line": (FORCE, FORCE), "surface": (FORCE, 0.8 * FORCE), "window": (1e-3, 0.5)}
    with pytest.raises(ValueError, match=says):
        matched_lambda(0.7, **given | change)
