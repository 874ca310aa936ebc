"""Persson's elastoplastic area: the diffusion between two absorbing ends by independent sums, its limits, refusals."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.persson_theory import persson, persson_plastic

MODULUS = 1e11
SURFACE = rc.Moments(1e-12, 0.005, 1e9)  # rms slope 0.1: a spread of 5 GPa
SPREAD = 5e9
RATIOS = [
    0.05,
    0.3,
    0.499,
    0.501,
    1.0,
    3.0,
]  # of the spread to the hardness, on both sides of the change of sums
PARTS = ("contact_fraction", "plastic_fraction", "elastic_fraction")


def part(name, pressure, hardness):
    return getattr(persson_plastic, name)(pressure, hardness, MODULUS, SURFACE)


def density(stress, pressure, hardness):
    """Return the density of pressures between the ends, by images of the source at both."""
    k = 2 * hardness * np.arange(-40, 41)
    towards = np.exp(-(((stress - pressure + k) / SPREAD) ** 2) / 2)
    away = np.exp(-(((stress + pressure + k) / SPREAD) ** 2) / 2)
    return float((towards - away).sum() / (SPREAD * math.sqrt(2 * math.pi)))


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("x", [0.02, 0.5, 0.9])
def test_the_density_between_the_ends_has_the_elastic_area_and_the_rest_of_the_load(ratio, x):
    hardness = SPREAD / ratio
    pressure = x * hardness
    about = [min(max(pressure + d * SPREAD, 0.0), hardness) for d in (-3, 0, 3)]
    elastic = quad(density, 0, hardness, args=(pressure, hardness), points=about, epsrel=1e-10, limit=200)[0]
    # Absolute, beside an area of 1: images of the strongest roughness cancel to exp(-pi^2 9/2) of their size.
    assert part("elastic_fraction", pressure, hardness) == pytest.approx(elastic, rel=1e-9, abs=1e-13)
    carried = quad(
        lambda s: s * density(s, pressure, hardness) / hardness,
        0, hardness, points=about, epsrel=1e-10, limit=200,
    )[0]  # fmt: skip
    assert carried + part("plastic_fraction", pressure, hardness) == pytest.approx(x, rel=1e-9)


@pytest.mark.parametrize("ratio", RATIOS)
def test_elastic_and_plastic_make_the_contact(ratio):
    hardness = SPREAD / ratio
    pressure = hardness * np.linspace(0, 1, 21)
    contact, plastic, elastic = (part(name, pressure, hardness) for name in PARTS)
    np.testing.assert_allclose(contact, plastic + elastic, rtol=1e-13, atol=1e-16)
    assert (np.diff(contact) >= 0).all()  # it is 1 to the last digit at the higher ones
    assert (np.diff(plastic) > 0)[plastic[1:] < 1].all()
    # The pressure is at most the hardness, and flow at an end is as good as contact at the other.
    assert (contact >= pressure / hardness * (1 - 1e-14)).all()
    np.testing.assert_allclose(1 - contact, plastic[::-1], atol=1e-14)


@pytest.mark.parametrize("name", PARTS)
def test_both_sums_agree_where_they_change(name):
    x = np.array([1e-3, 0.1, 0.5, 0.99])
    either = [
        part(name, x * hardness, hardness)
        for hardness in (SPREAD / 0.5 * (1 - 1e-13), SPREAD / 0.5 * (1 + 1e-13))
    ]
    # Images are differences of numbers of order 1.
    np.testing.assert_allclose(*either, rtol=1e-11)


def test_of_a_hard_body_it_is_elastic():
    pressure = np.geomspace(1e3, 1e10, 15)
    np.testing.assert_allclose(
        part("contact_fraction", pressure, 1e12),
        persson.contact_fraction(pressure, MODULUS, SURFACE),
        rtol=1e-14,
    )
    assert (part("plastic_fraction", pressure, 1e12) == 0).all()


def test_of_a_soft_body_all_the_load_is_at_the_hardness():
    # The first term is exp(-(pi 50)^2/2) of the load.
    pressure = np.array([1.0, 1e6, 9e7])
    for name in ("contact_fraction", "plastic_fraction"):
        np.testing.assert_allclose(part(name, pressure, 1e8), pressure / 1e8, rtol=1e-15)
    assert (part("elastic_fraction", pressure, 1e8) < 1e-300).all()


def test_at_the_hardness_all_of_the_area_flows():
    for ratio in RATIOS:
        hardness = SPREAD / ratio
        assert part("contact_fraction", hardness, hardness) == pytest.approx(1.0, abs=1e-15)
        assert part("plastic_fraction", hardness, hardness) == pytest.approx(1.0, abs=1e-15)
        assert part("elastic_fraction", hardness, hardness) == pytest.approx(0.0, abs=1e-15)


def test_law_ends_where_the_hardness_does():
    spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    law = persson_plastic.law(spectrum, 2e9, MODULUS, 1e-6)
    assert law.domain == (0.0, 2e3)
    force = np.array([1.0, 100.0, 2e3])
    expected = persson_plastic.contact_fraction(force / 1e-6, 2e9, MODULUS, spectrum)
    np.testing.assert_allclose(law.predict("contact_area", force), 1e-6 * expected, rtol=1e-13)
    assert np.isnan(law.predict("contact_area", 2.01e3))


def test_refusals():
    with pytest.raises(ValueError, match="above the hardness"):
        part("contact_fraction", 1.1e9, 1e9)
    with pytest.raises(ValueError, match="hardness"):
        part("plastic_fraction", 1e6, -1e9)
    with pytest.raises(ValueError, match="shortest wave"):
        persson_plastic.contact_fraction(1e6, 1e9, MODULUS, rc.Moments(1.0, math.inf, math.inf))
    with pytest.raises(ValueError, match="nominal area"):
        persson_plastic.law(SURFACE_SPECTRUM, 1e9, MODULUS, 0.0)


SURFACE_SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
