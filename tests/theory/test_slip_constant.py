"""Thesis, eq. 7.7: its constants are those of another fit than eq. 4.74."""

import pytest
from scipy.integrate import quad

from roughcontact.theory.joints import mindlin

MODULUS, FORCE, FRICTION, POISSON = 1e11, 20.0, 0.3, 0.3


def printed_7_7(hurst, theta):
    """Z = (H+1)/(0.2055 H) (0.086 Theta)^(1/(H+1))."""
    return (hurst + 1) / (0.2055 * hurst) * (0.086 * theta) ** (1 / (hurst + 1))


def gross_slip(hurst, theta):
    """mu C_m d(F), with d = int dF/k of the thesis' eq. 7.2 and 4.74 by quadrature (Jaeger, Ciavarella)."""

    def compliance(t):
        # F t^n with n = (H+1)/H makes the integrand constant in t: its only singularity is taken out.
        n = (hurst + 1) / hurst
        k = MODULUS * 1.7 / (hurst + 1) * (FORCE * t**n / (MODULUS * theta)) ** (1 / (hurst + 1))
        return FORCE * n * t ** (n - 1) / k

    depth = quad(compliance, 0, 1, epsabs=0, epsrel=1e-12)[0]
    return FRICTION * (2 - POISSON) / (2 * (1 - POISSON)) * depth


@pytest.mark.parametrize(
    ("hurst", "off"), [(0.3, -0.036), (0.5, 0.0745), (0.7, 0.149), (1.0, 0.213), (2.0, 0.217)]
)
def test_the_largest_displacement_is_the_depth_and_by_eq_7_7_that_of_another_fit(hurst, off):
    theta = 2e-6 * 3e-3**-hurst
    given = {"friction": FRICTION, "ratio": mindlin.ratio(POISSON)}
    exact = gross_slip(hurst, theta)
    constant = mindlin.slip_constant(theta, hurst)
    assert mindlin.fractal_gross_slip(FORCE, MODULUS, hurst, constant, **given) == pytest.approx(
        exact, rel=1e-10
    )
    legacy = printed_7_7(hurst, theta)
    assert mindlin.slip_constant(theta, hurst, constants="printed") == pytest.approx(legacy, rel=1e-14)
    # How far both fits are apart, to the digits given.
    value = mindlin.fractal_gross_slip(FORCE, MODULUS, hurst, legacy, **given)
    assert value / exact - 1 == pytest.approx(off, abs=1e-3)
