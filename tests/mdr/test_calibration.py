"""The factor that makes a line as stiff as its surface."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.calibration import calibrated_lambda
from roughcontact.mdr.equivalent_line import line_spectrum
from roughcontact.mdr.lattice_sums import lambda_rms
from roughcontact.mdr.random_lines import line_heights, random_waves
from roughcontact.mdr.rough_line import loading_curves

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


def test_defaults_are_those_stated():
    found = calibrated_lambda(1.0)
    assert found == calibrated_lambda(1.0, line_prefactor=0.808, surface_prefactor=0.85)
    assert found == pytest.approx(lambda_rms(1.0) * (0.808 / 0.85) ** 4, rel=1e-13)
    between = calibrated_lambda(0.9)
    assert between == pytest.approx(lambda_rms(0.9) * ((0.879 + 0.808) / 2 / (1.7 / 1.9)) ** 3.8, rel=1e-12)


@pytest.mark.parametrize(
    ("hurst", "options", "says"),
    [
        (-0.1, {}, "at least 0"),
        (math.nan, {}, "finite"),
        (2.1, {}, "give surface_prefactor"),
        (3.1, {"surface_prefactor": 0.5}, "give line_prefactor"),
        (1.0, {"line_prefactor": 0.0}, "line_prefactor must be positive"),
        (1.0, {"surface_prefactor": math.inf}, "surface_prefactor must be positive"),
    ],
)
def test_what_makes_no_sense_is_refused(hurst, options, says):
    with pytest.raises(ValueError, match=says):
        calibrated_lambda(hurst, **options)
