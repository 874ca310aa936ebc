"""Thesis, eq. 5.9 and the text of chapter 6: the rough sphere between unequal bodies, and the exponent of one crest."""

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact.theory.stiffness_laws import pohrt_popov

RADIUS, HURST, RMS, LENGTH = 0.5, 0.7, 9e-3, 1.0
SOLID = rc.Solid(2.0, 0.3)


def printed_5_9(stiffness, modulus, young_modulus, prefactor):
    """F = E* ((k/E)^3/(6R) + L h (k/(zeta E L))^(H+1))."""
    x = stiffness / young_modulus
    return modulus * (x**3 / (6 * RADIUS) + LENGTH * RMS * (x / (prefactor * LENGTH)) ** (HURST + 1))


def sneddon(a, modulus, coefficient):
    """Force and stiffness of r^2/(2R) + Q r^H on the contact radius a: F = 2 E* int (g(a) - g(x)) dx, k = 2 E* a."""

    def g(x):
        # x int_0^1 f'(x v)/sqrt(1 - v^2) dv.
        power = quad(lambda v: 1 / np.sqrt(1 + v), 0, 1, weight="alg", wvar=(HURST - 1, -0.5))[0]
        return x**2 / RADIUS + HURST * coefficient * x**HURST * power

    force = 2 * modulus * quad(lambda x: g(a) - g(x), 0, a, epsabs=0, epsrel=1e-9)[0]
    return force, 2 * modulus * a


@pytest.mark.parametrize("a", [0.003, 0.05])
def test_5_9_the_modulus_is_the_reduced_one(a):
    modulus, zeta = rc.reduced_modulus(SOLID), 1.7 / (HURST + 1)
    force, k = sneddon(a, modulus, rough_sphere.coefficient(HURST, RMS, LENGTH))
    body = {"radius": RADIUS, "hurst": HURST, "rms": RMS, "length": LENGTH, "modulus": modulus}
    assert rough_sphere.force(k, **body) == pytest.approx(force, rel=1e-7)
    # E*/E = 1/0.91, to a power between H + 1 and 3.
    assert printed_5_9(k, modulus, SOLID.young_modulus, zeta) / force > 0.91**-1.7 * (1 - 1e-6)
    # Between bodies of one E* it would also depend on how the stiffness is shared.
    assert printed_5_9(k, modulus, modulus, zeta) == pytest.approx(force, rel=1e-7)


def printed_chapter_6(hurst):
    """alpha = 2/3 for H >= 2."""
    assert hurst >= 2
    return 2 / 3


def test_6_2_one_smooth_crest_has_the_exponent_of_hertz():
    """Two crossed waves, the limit of large H: k ~ F^(1/3) and area ~ F^(2/3), of which chapter 6 has the latter."""
    n, h = 129, 1e-3
    x = (np.arange(n) + 0.5) / n - 0.5
    heights = h * (np.cos(2 * np.pi * x)[:, None] + np.cos(2 * np.pi * x))
    surface = rc.Surface(heights, rc.Grid((n, n), 1 / n))
    assert surface.rms == pytest.approx(h, rel=1e-3)
    # Contact radii of 6 and 13 cells.
    curve = rc.loading_curve(surface, 1.0, forces=h * np.array([1e-3, 1e-2]))
    alpha = np.diff(np.log(curve.stiffness)) / np.diff(np.log(curve.force))
    # A disc of m cells has its radius to 1/(2m): 0.03 in the slope over a factor of 10.
    assert alpha[0] == pytest.approx(1 / 3, abs=0.03)
    assert alpha[0] == pytest.approx(pohrt_popov.exponent(2.5), abs=0.03)
    assert printed_chapter_6(2.5) - alpha[0] > 0.3
    area = np.diff(np.log(curve.contact_area)) / np.diff(np.log(curve.force))
    assert area[0] == pytest.approx(2 / 3, abs=0.06)
    # Hertz with the crest's radius 1/(4 pi^2 h): k/(E* L) = 0.53366 (F/(E* h L))^(1/3).
    np.testing.assert_allclose(curve.stiffness, 0.53366 * np.cbrt(curve.force / h), rtol=0.04)
