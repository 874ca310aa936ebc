"""Asperities that yield, in both theories: quadrature over the heights, closed forms, limits, inverses, refusals."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.asperity_models import greenwood_williamson as gw
from roughcontact.theory.plastic_asperities import (
    chang_etsion_bogy as ceb,
    kogut_etsion as ke,
    yielding_asperities as ya,
)
from roughcontact.theory.random_surfaces.partial_moments import log_gaussian
from roughcontact.theory.spheres_and_punches import hertz

MODULUS, AREA = 2e11, 1e-6
MOMENTS = rc.Moments(1e-12, 0.01, 1e9)  # Nayak's parameter 10
THEORIES = {"ceb": ceb, "kogut-etsion": ke}
# Interferences at first yield of 3.2e-5, 2.9e-2 and 7.3 standard deviations.
HARDNESSES = [1e9, 3e10, 4.8e11]


def one_sphere(theory, asperities, hardness, factor):
    """Return load and area of a sphere as the papers write them, as functions of the interference."""
    r, h, e = asperities.radius, hardness, asperities.modulus
    first = (math.pi * factor * h / (2 * e)) ** 2 * r
    bounds = [first] if theory is ceb else [first, 6 * first, 110 * first]

    def load(w):
        if w <= first:
            return 4 / 3 * e * math.sqrt(r) * w**1.5
        if theory is ceb:
            return math.pi * r * w * (2 - first / w) * factor * h
        if w > 110 * first:
            return 2 * math.pi * r * w * h
        at_first, x = 2 / 3 * factor * h * math.pi * first * r, w / first
        return at_first * (1.03 * x**1.425 if x <= 6 else 1.40 * x**1.263)

    def area(w):
        if w <= first:
            return math.pi * r * w
        if theory is ceb:
            return math.pi * r * w * (2 - first / w)
        if w > 110 * first:
            return 2 * math.pi * r * w
        x = w / first
        return math.pi * r * first * (0.93 * x**1.136 if x <= 6 else 0.94 * x**1.146)

    return load, area, bounds


def average(function, asperities, separation, bounds):
    """Sum a function of the interference over all asperities, per area, by adaptive quadrature."""
    std, mean = asperities.std, asperities.mean_height

    def integrand(w):
        return (
            function(w)
            * math.exp(-(((separation + w - mean) / std) ** 2) / 2)
            / (std * math.sqrt(2 * math.pi))
        )

    # Up to where exp(-40^2/2) of the density is left, cut where the function or the density turns.
    last = max(mean - separation, 0.0) + 40 * std
    turns = {w for w in [*bounds, *(mean - separation + k * std for k in (-3, 0, 1, 3, 8))] if 0 < w < last}
    ends = [0.0, *sorted(turns), last]
    parts = [quad(integrand, a, b, epsabs=0, epsrel=1e-12, limit=200)[0] for a, b in pairwise(ends)]
    return asperities.density * math.fsum(parts)


@pytest.mark.parametrize("name", THEORIES)
@pytest.mark.parametrize("hardness", HARDNESSES)
@pytest.mark.parametrize("separation", [0.0, 9e-7, 3e-6, 1e-5])
def test_pressure_and_area_are_means_over_the_heights(name, hardness, separation):
    theory = THEORIES[name]
    asperities = theory.population(MOMENTS, hardness, MODULUS, poisson=0.2)
    load, area, bounds = one_sphere(theory, asperities, hardness, 0.454 + 0.41 * 0.2)
    assert asperities.critical_interference == pytest.approx(bounds[0], rel=1e-14)
    assert asperities.pressure(separation) == pytest.approx(
        average(load, asperities, separation, bounds), rel=1e-10
    )
    assert asperities.contact_fraction(separation) == pytest.approx(
        average(area, asperities, separation, bounds), rel=1e-10
    )
    yielded = average(lambda w: area(w) if w > bounds[0] else 0.0, asperities, separation, bounds)
    assert asperities.yielded_fraction(separation) == pytest.approx(yielded, rel=1e-10)


@pytest.mark.parametrize("hardness", HARDNESSES)
def test_area_of_chang_etsion_and_bogy_in_closed_form(hardness):
    # pi R w up to w_c and pi R (2 w - w_c) beyond are pi R (w + (w - w_c)+).
    asperities = ceb.population(MOMENTS, hardness, MODULUS)
    s = np.linspace(0.0, 8e-6, 9)
    t = (s - asperities.mean_height) / asperities.std
    width = asperities.critical_interference / asperities.std
    mean = np.exp(log_gaussian(1.0, t)) + np.exp(log_gaussian(1.0, t + width))
    expected = asperities.density * math.pi * asperities.radius * asperities.std * mean
    np.testing.assert_allclose(asperities.contact_fraction(s), expected, rtol=1e-12)


@pytest.mark.parametrize("name", THEORIES)
class TestBoth:
    def test_of_a_hard_body_it_is_greenwood_and_williamson(self, name):
        hard = THEORIES[name].population(MOMENTS, 1e15, MODULUS)
        elastic, s = gw.population(MOMENTS, MODULUS), np.linspace(0.0, 2e-5, 41)
        for quantity in ("pressure", "contact_fraction", "stiffness", "spot_density"):
            np.testing.assert_allclose(
                getattr(hard, quantity)(s), getattr(elastic, quantity)(s), rtol=1e-11, err_msg=quantity
            )
        assert (hard.yielded_fraction(s) == 0).all()

    def test_of_a_soft_body_it_is_that_of_cut_spheres(self, name):
        # Every asperity is far beyond first yield: the pressure is H, or K H, on 2 pi R w. What is left of the other
        # regimes is of the order of the widest of them in standard deviations, 110 times 3e-17.
        hardness, factor = 1e3, 0.454 + 0.41 * 0.3
        soft, s = THEORIES[name].population(MOMENTS, hardness, MODULUS), np.linspace(0.0, 5e-6, 6)
        cut = 2 * math.pi * soft.radius * soft.density * soft.std
        expected = cut * np.exp(log_gaussian(1.0, (s - soft.mean_height) / soft.std))
        np.testing.assert_allclose(soft.contact_fraction(s), expected, rtol=1e-11)
        most = hardness * (factor if name == "ceb" else 1.0)
        np.testing.assert_allclose(soft.pressure(s), most * expected, rtol=1e-11)

    @pytest.mark.parametrize("hardness", HARDNESSES)
    def test_stiffness_is_the_slope_of_the_pressure(self, name, hardness):
        # A central difference errs by step^2 p'''/(6 p'), p'''/p' at most (t/std)^2 and that of a regime's width, which
        # no derivative by the plane sees but through the density: t = 10 at most, so 1e-8 * 100/6.
        asperities = THEORIES[name].population(MOMENTS, hardness, MODULUS)
        s, step = np.linspace(2e-7, 8e-6, 12), 1e-4 * asperities.std
        slope = (asperities.pressure(s - step) - asperities.pressure(s + step)) / (2 * step)
        np.testing.assert_allclose(asperities.stiffness(s), slope, rtol=2e-7)

    def test_separation_undoes_the_pressure_over_three_hundred_decades(self, name):
        asperities = THEORIES[name].population(MOMENTS, 1e10, MODULUS)
        p = np.geomspace(1e-290, float(asperities.pressure(0.0)), 200)
        # The pressure falls by exp(-t dt): at t = 37 with the rounding of a plane of 37.
        np.testing.assert_allclose(asperities.pressure(asperities.separation(p)), p, rtol=40 * 37 * 2.3e-16)
        assert asperities.separation(0.0) == math.inf
        assert np.shape(asperities.separation(1e5)) == ()
        assert asperities.separation(np.array([[1e5, 0.0]])).shape == (1, 2)

    def test_law_is_the_population_over_an_area(self, name):
        asperities = THEORIES[name].population(MOMENTS, 1e10, MODULUS)
        law = THEORIES[name].law(MOMENTS, 1e10, MODULUS, AREA)
        force = np.geomspace(1e-6, law.domain[1], 20)
        gap = law.predict("mean_gap", force)
        np.testing.assert_allclose(AREA * asperities.pressure(gap), force, rtol=1e-11)
        for quantity, method in {
            "contact_area": "contact_fraction",
            "interfacial_stiffness": "stiffness",
            "spots": "spot_density",
        }.items():
            np.testing.assert_allclose(
                law.predict(quantity, force), AREA * getattr(asperities, method)(gap), rtol=1e-13
            )
        assert gap[-1] == pytest.approx(0.0, abs=1e-12 * asperities.std)
        assert np.isnan(law.predict("contact_area", 1.01 * law.domain[1]))

    def test_refusals(self, name):
        theory = THEORIES[name]
        asperities = theory.population(MOMENTS, 1e10, MODULUS)
        with pytest.raises(ValueError, match="must not be negative"):
            asperities.pressure(-1e-9)
        with pytest.raises(ValueError, match="the limit of this theory"):
            asperities.separation(2 * float(asperities.pressure(0.0)))
        with pytest.raises(ValueError, match="hardness"):
            theory.law(MOMENTS, 0.0, MODULUS, AREA)
        with pytest.raises(ValueError, match=r"from 0 to 0\.5"):
            theory.law(MOMENTS, 1e10, MODULUS, AREA, poisson=0.6)
        with pytest.raises(ValueError, match="nominal area"):
            theory.law(MOMENTS, 1e10, MODULUS, -1.0)


def test_first_yield_is_where_the_largest_pressure_of_hertz_is_that_part_of_the_hardness():
    asperities = ke.population(MOMENTS, 1e10, MODULUS)
    contact = hertz.point(MODULUS, radius=asperities.radius, depth=asperities.critical_interference)
    assert contact.max_pressure == pytest.approx(asperities.yield_pressure, rel=1e-13)
    assert contact.force == pytest.approx(asperities.critical_load, rel=1e-13)
    # Tabor: the mean pressure at first yield is 1.1 of the yield stress, the hardness 2.8 of it.
    assert 2 / 3 * ya.hardness_factor(0.3) * 2.8 == pytest.approx(1.1, rel=0.025)


def test_the_fits_of_kogut_and_etsion_meet_as_nearly_as_their_digits_allow():
    """Also that of the mean pressure with the hardness, where plasticity becomes full."""
    joints = list(pairwise(ke.population(MOMENTS, 1e10, MODULUS).regimes))
    loads = [ya._sum(after.load, after.start) / ya._sum(before.load, after.start) for before, after in joints]
    areas = [ya._sum(after.area, after.start) / ya._sum(before.area, after.start) for before, after in joints]
    assert loads == pytest.approx([1.030, 1.016, 1.079], abs=1e-3)
    assert areas == pytest.approx([0.930, 1.029, 1.071], abs=1e-3)
    assert loads[-1] / areas[-1] == pytest.approx(1.0, abs=0.01)
