"""Greenwood and Williamson: quadrature over asperities, the exponential law, inverses, derivatives, refusals."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.asperity_models import greenwood_williamson as gw, interface
from roughcontact.theory.random_surfaces import nayak

MODULUS, DENSITY, RADIUS, STD, MEAN = 2e11, 3e9, 2e-5, 4e-7, 6e-7
AREA = 1e-6
MOMENTS = rc.Moments(1e-12, 0.01, 1e9)  # Nayak's parameter 10


def spheres(distribution="gaussian"):
    return gw.Population(gw.Asperity.hertz(RADIUS, MODULUS), DENSITY, STD, MEAN, distribution)


def springs(exponent, distribution):
    return gw.Population(gw.Asperity(7e5, exponent, MODULUS), DENSITY, STD, MEAN, distribution)


def average(function, separation, distribution):
    """Sum over all asperities of a function of the excess, per area, by adaptive quadrature."""

    def density(x):
        if distribution == "gaussian":
            return math.exp(-((x - MEAN) ** 2) / (2 * STD**2)) / (STD * math.sqrt(2 * math.pi))
        return math.exp(-(x - MEAN + STD) / STD) / STD

    end = separation + 40 * STD
    value, _ = quad(
        lambda z: function(z - separation) * density(z), separation, end, epsabs=0, epsrel=1e-11, limit=400,
        points=[separation + STD, separation + 4 * STD],
    )  # fmt: skip
    return DENSITY * value


@pytest.mark.parametrize("distribution", ["gaussian", "exponential"])
@pytest.mark.parametrize("separation", [3e-7, 9e-7, 2.5e-6])
class TestQuadrature:
    def test_spheres(self, separation, distribution):
        population = spheres(distribution)
        means = {
            "pressure": lambda d: 4 / 3 * MODULUS * math.sqrt(RADIUS) * d**1.5,
            "stiffness": lambda d: 2 * MODULUS * math.sqrt(RADIUS * d),
            "contact_fraction": lambda d: math.pi * RADIUS * d,
            "spot_density": lambda d: 1.0,
            "energy": lambda d: 8 / 15 * MODULUS * math.sqrt(RADIUS) * d**2.5,
        }
        for name, function in means.items():
            expected = average(function, separation, distribution)
            assert getattr(population, name)(separation) == pytest.approx(expected, rel=1e-9), name

    @pytest.mark.parametrize("exponent", [1.0, 2.0, 2.25])
    def test_asperities_of_any_power(self, separation, distribution, exponent):
        population = springs(exponent, distribution)
        assert population.pressure(separation) == pytest.approx(
            average(lambda d: 7e5 * d**exponent, separation, distribution), rel=1e-9
        )
        # The stiffness of a circle, 2 E* a, has its area.
        assert population.contact_fraction(separation) == pytest.approx(
            average(
                lambda d: math.pi * (7e5 * exponent * d ** (exponent - 1) / (2 * MODULUS)) ** 2,
                separation,
                distribution,
            ),
            rel=1e-9,
        )


class TestExponentialHeights:
    @pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 2.25, 11.0])
    def test_stiffness_is_force_over_std_for_any_exponent(self, exponent):
        population = springs(exponent, "exponential")
        s = np.linspace(population.lowest, 30 * STD, 12)
        # Thesis, eq. 3.9.
        assert population.stiffness(s) == pytest.approx(population.pressure(s) / STD, rel=1e-13)

    def test_area_is_proportional_to_force(self):
        population, s = spheres("exponential"), np.linspace(3e-7, 5e-6, 7)
        expected = population.pressure(s) * math.sqrt(math.pi * RADIUS / STD) / MODULUS
        assert population.contact_fraction(s) == pytest.approx(expected, rel=1e-13)

    def test_below_the_lowest_asperity_the_law_is_another(self):
        population = spheres("exponential")
        highest = population.pressure(population.lowest)
        with pytest.raises(ValueError, match="touches every asperity"):
            population.pressure(population.lowest - 0.01 * STD)
        with pytest.raises(ValueError, match="touches every asperity"):
            population.separation(1.01 * highest)
        assert population.separation(highest) == pytest.approx(population.lowest, abs=1e-12 * STD)


class TestGaussianHeights:
    def test_stiffness_over_force(self):
        t = np.arange(5.0)
        population, s = spheres(), MEAN + STD * t
        ratio = population.stiffness(s) * STD / population.pressure(s)
        assert ratio == pytest.approx([1.434, 2.065, 2.816, 3.647, 4.530], abs=5e-4)

    def test_local_exponent_of_stiffness_over_force(self):
        # dlnK/dlnF by differences, whose error is of the order of the step squared: thesis' 0.8 to 0.9.
        step = 1e-4
        s = MEAN + STD * (np.arange(5.0)[:, None] + step * np.array([1, -1]))
        k, p = np.log(spheres().stiffness(s)), np.log(spheres().pressure(s))
        slope = np.diff(k, axis=1)[:, 0] / np.diff(p, axis=1)[:, 0]
        assert slope == pytest.approx([0.730, 0.836, 0.900, 0.935, 0.956], abs=6e-4)

    def test_inverse_over_three_hundred_decades(self):
        p = np.geomspace(1e-290, spheres().pressure(0.0), 400)
        found = spheres().separation(p)
        assert (np.diff(found) < 0).all()
        # The pressure falls by exp(-t dt): at t = 37 with an error of 40 units in the last place of the separation.
        assert spheres().pressure(found) == pytest.approx(p, rel=40 * 37 * 2.3e-16)

    def test_scalars_and_no_load(self):
        assert spheres().separation(0.0) == math.inf
        assert np.shape(spheres().separation(1e5)) == ()
        assert spheres().separation(np.array([[1e5, 0.0]])).shape == (1, 2)


class TestDerivatives:
    @pytest.mark.parametrize("distribution", ["gaussian", "exponential"])
    def test_energy_pressure_stiffness(self, distribution):
        # Central differences with a step of 1e-4 std err by its square times the third derivative over the first, up
        # to t^2 / 6, and by rounding over the step.
        population, s, step = spheres(distribution), np.array([6e-7, 1.5e-6]), 1e-4 * STD
        for above, below in [("energy", "pressure"), ("pressure", "stiffness")]:
            function = getattr(population, above)
            slope = (function(s - step) - function(s + step)) / (2 * step)
            assert slope == pytest.approx(getattr(population, below)(s), rel=3e-8)


class TestLaw:
    @pytest.mark.parametrize("distribution", ["gaussian", "exponential"])
    def test_from_moments(self, distribution):
        law, mean = gw.law(MOMENTS, MODULUS, AREA, distribution=distribution), nayak.summits(MOMENTS)
        by_hand = gw.Population(
            gw.Asperity.hertz(mean.radius, MODULUS), mean.density, mean.std, mean.mean_height, distribution
        )
        force = np.geomspace(1e-6, law.domain[1], 50)
        gap = law.predict("mean_gap", force)
        assert AREA * by_hand.pressure(gap) == pytest.approx(force, rel=1e-11)
        assert law.predict("interfacial_stiffness", force) == pytest.approx(
            AREA * by_hand.stiffness(gap), rel=1e-11
        )
        assert gap[-1] == pytest.approx(max(0, by_hand.lowest), abs=1e-12 * mean.std)

    def test_says_nothing_beyond_the_mean_plane_and_nothing_of_the_body(self):
        law = gw.law(MOMENTS, MODULUS, AREA)
        assert np.isnan(law.predict("contact_area", 1.01 * law.domain[1]))
        with pytest.raises(ValueError, match="has no 'stiffness'"):
            law.predict("stiffness", 1.0)

    def test_no_force(self):
        law = gw.law(MOMENTS, MODULUS, AREA)
        assert law.predict("mean_gap", 0.0) == math.inf
        assert all(law.predict(name, 0.0) == 0 for name in law.quantities if name != "mean_gap")

    def test_any_population_makes_a_law(self):
        law = interface.loading_law(springs(2.0, "exponential"), AREA, name="cones", source="here")
        assert law.predict("interfacial_stiffness", 2e-4) == pytest.approx(2e-4 / STD, rel=1e-12)


class TestRefusals:
    @pytest.mark.parametrize(
        "change", [{"density": 0.0}, {"std": -1.0}, {"mean_height": math.nan}, {"distribution": "uniform"}]
    )
    def test_populations(self, change):
        given = {"asperity": gw.Asperity.hertz(RADIUS, MODULUS), "density": DENSITY, "std": STD} | change
        with pytest.raises(ValueError, match=next(iter(change)).replace("std", "standard deviation")):
            gw.Population(**given)

    @pytest.mark.parametrize("exponent", [0.9, 11.5, math.nan])
    def test_asperities(self, exponent):
        with pytest.raises(
            ValueError, match=r"exponent must lie from 1 to 11|exponent must be a number, not nan"
        ):
            gw.Asperity(1.0, exponent, MODULUS)

    def test_pressures(self):
        with pytest.raises(ValueError, match="not negative"):
            spheres().separation(-1.0)

    @pytest.mark.parametrize("distribution", ["gaussian", "exponential"])
    def test_the_flat_stays_above_the_mean_plane(self, distribution):
        population = gw.Population(gw.Asperity.hertz(RADIUS, MODULUS), DENSITY, STD, 0.0, distribution)
        assert population.lowest == 0
        assert population.separation(population.pressure(0.0)) == pytest.approx(0, abs=1e-11 * STD)
        with pytest.raises(ValueError, match=r"reaches the mean plane of the surface.*given: 1e\+12"):
            population.separation(1e12)
        for name in ("pressure", "stiffness", "contact_fraction", "spot_density", "energy"):
            for height in (-0.01 * STD, -1.0, [1e-6, math.nan]):
                with pytest.raises(ValueError, match="at least 0 m"):
                    getattr(population, name)(height)

    def test_what_is_no_asperity_and_what_is_no_surface(self):
        with pytest.raises(ValueError, match="an Asperity is needed"):
            gw.Population(5, DENSITY, STD)
        surface = rc.Surface(np.zeros((2, 2)), rc.Grid((2, 2), 1.0))
        with pytest.raises(ValueError, match=r"rc.surface_moments\(surface\).*not a Surface"):
            gw.population(surface, MODULUS)
