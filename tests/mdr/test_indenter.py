"""Bodies of revolution: each closed form against quadrature of the definition, and the algebra of sums."""

import math
import pickle
from itertools import pairwise

import numpy as np
import pytest
from scipy import special
from scipy.integrate import quad

from roughcontact.mdr.bodies import indenter

# A body and the slope f'(r) of its height, by hand.
CASES = {
    "power law": (indenter.power_law(1.3, 0.7), lambda r: 0.91 * r**0.3),
    "cusp": (indenter.power_law(0.5, 0.2), lambda r: 0.1 / np.sqrt(r)),
    "cone": (indenter.cone(0.4), lambda r: 0.4),
    "paraboloid": (indenter.paraboloid(0.8), lambda r: r / 0.8),
    "flat-ended cone": (indenter.cone(0.4, flat=0.3), lambda r: 0.4 * (r > 0.3)),
    "flat-ended paraboloid": (indenter.paraboloid(0.8, flat=0.3), lambda r: r / 0.8 * (r > 0.3)),
    "flat-ended power law": (indenter.power_law(3.5, 0.7, flat=0.25), lambda r: 2.45 * r**2.5 * (r > 0.25)),
    "sphere": (indenter.sphere(1.5), lambda r: r / np.sqrt(2.25 - r**2)),
    "rounded cone": (indenter.rounded_cone(0.5, 0.8), lambda r: min(r / 0.8, 0.5)),
    "ripples": (indenter.ripples(0.01, 0.4, 1.2), lambda r: 0.05 * np.pi * np.sin(5 * np.pi * r)),
    "sum": (indenter.sphere(1.5) + indenter.cone(0.1), lambda r: r / np.sqrt(2.25 - r**2) + 0.1),
    "function": (indenter.of(lambda r: np.cosh(r) - 1, 1.2), np.sinh),
}
X = np.array([0.05, 0.2, 0.45, 0.8, 1.1])


def integral(function, low, high, breaks):
    ends = [low, *(b for b in breaks if low < b < high), high]
    return sum(quad(function, a, b, epsabs=0, epsrel=1e-11, limit=200)[0] for a, b in pairwise(ends))


@pytest.mark.parametrize(("body", "slope"), CASES.values(), ids=CASES.keys())
class TestClosedForms:
    def test_the_height_has_the_slope(self, body, slope):
        truth = [integral(slope, 0, r, body.breaks) for r in X]
        np.testing.assert_allclose(body.height(X), truth, rtol=1e-10, atol=1e-15)

    def test_the_transform_is_the_integral_over_the_slope(self, body, slope):
        truth = [
            x
            * integral(
                lambda t, x=x: slope(x * np.sin(t)),
                0,
                np.pi / 2,
                [math.asin(b / x) for b in body.breaks if b < x],
            )
            for x in X
        ]
        # Twice the square root of what quad leaves at the cusp; elsewhere ten times better.
        np.testing.assert_allclose(body.transform(X), truth, rtol=1e-9, atol=1e-15)

    def test_its_slope_is_its_derivative(self, body, slope):
        del slope
        step = 1e-5
        truth = (body.transform(X + step) - body.transform(X - step)) / (2 * step)
        # Third derivatives up to 1e4 times the square of the step, and rounding.
        np.testing.assert_allclose(body.transform_slope(X), truth, rtol=1e-6, atol=1e-10)

    def test_its_integral_is_its_integral(self, body, slope):
        del slope
        truth = [integral(body.transform, 0, x, body.breaks) for x in X]
        np.testing.assert_allclose(body.transform_integral(X), truth, rtol=1e-10, atol=1e-15)

    def test_it_starts_from_zero(self, body, slope):
        del slope
        # A table's first value is a sum of coefficients.
        for function in (body.height, body.transform, body.transform_integral):
            assert function(0.0) == pytest.approx(0, abs=1e-30)

    def test_it_survives_a_journey(self, body, slope):
        del slope
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(body)).transform(X), body.transform(X))


class TestSphere:
    def test_small_radii_lose_no_digits(self):
        # Series by hand: x^2/R (1 + (x/R)^2/3), x^3/(3R) (1 + (x/R)^2/5).
        x, R = 1e-5, 2.0
        body = indenter.sphere(R)
        assert body.transform(x) == pytest.approx(x**2 / R * (1 + (x / R) ** 2 / 3), rel=1e-14)
        assert body.transform_integral(x) == pytest.approx(x**3 / (3 * R) * (1 + (x / R) ** 2 / 5), rel=1e-14)
        assert body.height(x) == pytest.approx(x**2 / (2 * R), rel=1e-10)

    def test_series_and_closed_form_meet(self):
        body = indenter.sphere(1.0)
        below, above = body.transform_integral(np.array([0.25 * (1 - 1e-12), 0.25 * (1 + 1e-12)]))
        assert above == pytest.approx(below, rel=1e-11)

    def test_at_the_equator(self):
        body = indenter.sphere(2.0)
        assert body.transform(2.0) == np.inf
        assert body.transform_integral(2.0) == pytest.approx(2.0, rel=1e-14)  # R^2/2


def test_a_flat_ended_power_law_is_the_cone_and_the_paraboloid():
    """Closed forms by hand: slope x arccos(b/x), (x/R) sqrt(x^2 - b^2)."""
    x, b = np.linspace(0.31, 2, 40), 0.3
    np.testing.assert_allclose(
        indenter.cone(0.4, flat=b).transform(x), 0.4 * x * np.arccos(b / x), rtol=1e-13
    )
    parabola = x / 0.8 * np.sqrt(x**2 - b**2)
    np.testing.assert_allclose(indenter.paraboloid(0.8, flat=b).transform(x), parabola, rtol=1e-13)


def test_the_rounded_cone_has_a_smooth_joint():
    body, R, slope = indenter.rounded_cone(0.5, 0.9), 0.9, 0.5
    r = np.array([0.2, 0.45, 0.7])
    np.testing.assert_allclose(body.height(r), [0.2**2 / 1.8, 0.45**2 / 1.8, slope * 0.7 - slope**2 * R / 2])
    assert body.rises


class TestAlgebra:
    first, second = indenter.paraboloid(0.5), indenter.cone(0.1, flat=0.2)

    def test_sums_add_heights_and_transforms(self):
        body = self.first + self.second
        np.testing.assert_allclose(body.height(X), self.first.height(X) + self.second.height(X))
        np.testing.assert_allclose(body.transform(X), self.first.transform(X) + self.second.transform(X))

    def test_multiples(self):
        np.testing.assert_allclose((3 * self.first).transform(X), indenter.paraboloid(0.5 / 3).transform(X))
        np.testing.assert_allclose((self.first * 2 - self.first).transform(X), self.first.transform(X))

    def test_the_flat_face_is_the_smaller_one(self):
        assert self.second.flat == 0.2
        assert (self.first + self.second).flat == 0
        assert (self.second + indenter.cone(1.0, flat=0.1)).flat == 0.1
        assert (self.second + 0 * self.first).flat == 0.2
        assert indenter.flat_punch(0.3).flat == 0.3

    def test_the_body_ends_where_the_first_part_ends(self):
        cut = self.first + indenter.flat_punch(0.4)
        assert (cut.radius, cut.edge) == (0.4, True)
        known = self.first + indenter.of(lambda r: r**4, 0.3)
        assert (known.radius, known.edge) == (0.3, False)
        assert (known + indenter.flat_punch(0.3)).edge

    def test_a_cut_body_is_empty_space_beyond(self):
        assert self.first.cut(0.3).height(np.array([0.3, 0.31])).tolist() == [0.09, np.inf]
        assert np.isnan(indenter.of(lambda r: r**2, 0.3).height(0.31))

    def test_only_sums_of_rising_parts_are_known_to_rise(self):
        assert (self.first + self.second).rises
        assert not (self.first - self.second).rises
        assert not (-1 * self.first).rises
        assert not (self.first + indenter.ripples(0.1, 0.1, 1.0)).rises

    def test_a_table_knows_whether_it_rises(self):
        assert indenter.of(lambda r: r**2, 1.0).rises
        assert not indenter.of(lambda r: r**2 * (1 - r), 1.0).rises

    def test_what_is_no_body_is_refused(self):
        with pytest.raises(TypeError):
            self.first + 1.0
        with pytest.raises(TypeError):
            self.first - 1.0
        with pytest.raises(TypeError):
            self.first * self.second
        with pytest.raises(ValueError, match="finite factor"):
            self.first * math.inf

    def test_it_says_what_it_is(self):
        text = repr(2 * self.first + self.second + indenter.flat_punch(0.4))
        assert text.startswith("Profile(2 * PowerTerm(exponent=2.0")
        assert text.endswith("edge to 0.4 m)")


class TestRefusals:
    @pytest.mark.parametrize(
        ("make", "message"),
        [
            (lambda: indenter.power_law(0, 1), "exponent"),
            (lambda: indenter.power_law(1, -1), "coefficient"),
            (lambda: indenter.power_law(1, 1, flat=-1), "flat face"),
            (lambda: indenter.cone(math.nan), "slope"),
            (lambda: indenter.paraboloid(0), "radius"),
            (lambda: indenter.sphere(-1), "radius"),
            (lambda: indenter.flat_punch(math.inf), "radius"),
            (lambda: indenter.rounded_cone(1, 0), "radius"),
            (lambda: indenter.ripples(1, 0, 1), "wavelength"),
            (lambda: indenter.ripples(math.inf, 1, 1), "amplitude"),
            (lambda: indenter.equivalent_roughness(0, rms=1, length=1), "hurst"),
            (lambda: indenter.equivalent_roughness(1, rms=1, length=1, prefactor=0), "prefactor"),
            (lambda: indenter.of(lambda r: r**2, math.inf), "the radius of the body must be above 0"),
            (lambda: indenter.of(lambda r: np.full_like(r, np.nan), 1.0), "finite at its apex"),
            (lambda: indenter.of(np.zeros_like, 1.0), "flat_punch"),
            (lambda: indenter.cone(1.0).cut(0.0), "cut"),
            (lambda: indenter.sphere(1.0).cut(2.0), "cut"),
            (lambda: indenter.cone(1.0).height(-1.0), "not be negative"),
            (lambda: indenter.paraboloid("a"), "radius must be one number"),
            (lambda: indenter.power_law(1, 1, flat="a"), "flat face must be one number"),
            (lambda: indenter.of(lambda r: math.cosh(r) - 1, 1.0), "must accept an array of radii"),
            (lambda: indenter.of(lambda r: r if r > 0.5 else 0, 1.0), "must accept an array of radii"),
            (lambda: indenter.of(5, 1.0), "a function of the radius is needed, not 5"),
            (lambda: indenter.of(lambda r: r**2, "a"), "radius must be one number"),
            (lambda: indenter.ripples(1.0, 1.0, 2001.0), "2001 waves.*2000"),
            (lambda: indenter.sphere(1.0).cut("a"), "cut"),
        ],
    )
    def test_nonsense(self, make, message):
        with pytest.raises(ValueError, match=message):
            make()


@pytest.mark.parametrize("waves", [100, 2000])
def test_many_ripples(waves):
    body = indenter.ripples(1e-6, 1e-5, waves * 1e-5)
    x = np.linspace(0.9, 1, 500) * body.radius
    z = 2e5 * np.pi * x
    # The largest argument is known to its rounding, 2.2e-16 z; a panel errs by a few such parts of its values.
    error = 10 * 2.2e-16 * z[-1]
    np.testing.assert_allclose(body.height(x), 1e-6 * (1 - np.cos(z)), rtol=0, atol=error * 2e-6)
    # Struve's function far out (DLMF 11.6.1); the next term is 225 z^-6.
    struve = special.y0(z) + 2 / np.pi * (1 / z - 1 / z**3 + 9 / z**5)
    truth = np.pi / 2 * 1e-6 * z * struve
    np.testing.assert_allclose(body.transform(x), truth, rtol=0, atol=error * truth.max())


class TestRoughness:
    """Thesis, section 5.2."""

    def test_the_coefficient_of_figure_37(self):
        body = indenter.equivalent_roughness(0.7, rms=9e-3, length=1.0, prefactor=1.0)
        assert body.height(1.0) == pytest.approx(0.0250082, abs=5e-8)

    def test_only_rms_over_length_to_the_hurst_exponent_matters(self):
        one = indenter.equivalent_roughness(0.7, rms=1e-3, length=1.0)
        other = indenter.equivalent_roughness(0.7, rms=1e-3 * 5**0.7, length=5.0)
        assert other.height(0.3) == pytest.approx(float(one.height(0.3)), rel=1e-13)

    def test_the_default_prefactor(self):
        default = indenter.equivalent_roughness(0.4, rms=1e-3, length=1.0)
        given = indenter.equivalent_roughness(0.4, rms=1e-3, length=1.0, prefactor=1.7 / 1.4)
        assert default.height(0.3) == pytest.approx(given.height(0.3), rel=1e-14)


class TestFromTransform:
    def test_a_function_goes_back_to_the_height(self):
        body = indenter.from_transform(lambda x: x * np.arctanh(x / 2), 1.0)
        np.testing.assert_allclose(body.height(X[X < 1]), indenter.sphere(2.0).height(X[X < 1]), rtol=1e-11)

    def test_the_apex_is_at_zero(self):
        assert indenter.of(lambda r: 5 + r**2, 1.0).height(1.0) == pytest.approx(1.0)
