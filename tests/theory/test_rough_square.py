"""The law of rough squares as computed: its window, its errors, and what it is for shapes of arguments."""

import numpy as np
import pytest

from roughcontact.theory.stiffness_laws import pohrt_popov, rough_square

STEEL = {"rms": 2e-6, "length": 1e-3, "modulus": 110e9}
HURST = np.array([0.1, 0.25, 0.7, 1.0, 1.6, 2.95])


def test_exponent_prefactor_and_stiffness_are_one_law():
    alpha, zeta = rough_square.exponent(HURST), rough_square.prefactor(HURST)
    for f in (0.02, 0.05):
        k = rough_square.stiffness(f, HURST, 1.0, 1.0, 1.0)
        np.testing.assert_allclose(k, zeta * f**alpha, rtol=1e-14)
    scaled = rough_square.stiffness(0.02 * 220, HURST, **STEEL)
    np.testing.assert_allclose(scaled, 110e6 * rough_square.stiffness(0.02, HURST, 1.0, 1.0, 1.0), rtol=1e-14)


def test_errors_of_the_stiffness_follow_from_those_of_exponent_and_level():
    """Drawn with their errors and correlation, ln k scatters as is said, to four errors of a scatter, 1/sqrt(2 n)."""
    rng = np.random.default_rng(3)
    for h, _, of_alpha, _, of_level, correlation in rough_square._TABLE:
        covariance = correlation * of_alpha * of_level
        pairs = rng.multivariate_normal(
            (0, 0), [[of_alpha**2, covariance], [covariance, of_level**2]], size=1000
        )
        for force in (0.02, 0.07):
            scatter = (pairs[:, 0] * np.log(force / 0.02) + pairs[:, 1]).std()
            said = rough_square.relative_error(force, h, 1.0, 1.0, 1.0)
            assert said == pytest.approx(scatter, rel=4 / 2000**0.5)
        zeta = (pairs[:, 1] - pairs[:, 0] * np.log(0.02)).std()
        said = rough_square.prefactor_error(h) / rough_square.prefactor(h)
        assert said == pytest.approx(zeta, rel=4 / 2000**0.5)
        assert rough_square.exponent_error(h) == of_alpha


def test_between_the_hurst_exponents_of_the_ensembles_it_goes_one_way():
    dense = np.linspace(*rough_square.HURST_LIMITS, 400)
    assert (np.diff(rough_square.exponent(dense)) < 0).all()
    assert (np.diff(rough_square.stiffness(0.02, dense, 1.0, 1.0, 1.0)) > 0).all()


def test_shapes_follow_numpy():
    f = np.array([[0.02], [0.04]])
    for function in (rough_square.stiffness, rough_square.relative_error):
        assert function(f, np.array([0.7, 1.0, 1.3]), 1.0, 1.0, 1.0).shape == (2, 3)
        assert np.ndim(function(0.02, 0.7, 1.0, 1.0, 1.0)) == 0
    assert np.ndim(rough_square.exponent(0.7)) == 0


def test_it_ends_where_its_ensembles_do():
    surface = (0.7, *STEEL.values())
    law = rough_square.law(*surface)
    low, high = law.domain
    scale = 110e9 * 1e-3
    assert rough_square.stiffness(low, *surface) == pytest.approx(
        rough_square.LEAST_STIFFNESS * scale, rel=1e-12
    )
    assert high == pytest.approx(pohrt_popov.FORCE_LIMIT * scale * 2e-6, rel=1e-15)
    for outside in (low * (1 - 1e-6), high * (1 + 1e-6)):
        assert np.isnan(law.predict("stiffness", outside))
        with pytest.raises(ValueError, match="compute the surface, or use pohrt_popov"):
            rough_square.stiffness(outside, *surface)
    forces = np.geomspace(low, high, 5)
    np.testing.assert_array_equal(law.predict("stiffness", forces), rough_square.stiffness(forces, *surface))
    for hurst in (0.05, 3.0):
        with pytest.raises(ValueError, match=r"hurst must lie from 0\.1 to 2\.95"):
            rough_square.exponent(hurst)
