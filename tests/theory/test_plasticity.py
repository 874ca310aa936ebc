"""Plasticity indices: closed forms, limits, and how the two forms are related."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.plastic_asperities import plasticity

MODULUS, HARDNESS = 1.1e11, 2e9


def moments(alpha, slope):
    """A surface of rms slope `slope`, with m0 = 1 um^2."""
    return rc.Moments(1e-12, slope**2 / 2, alpha * (slope**2 / 2) ** 2 / 1e-12)


def test_slope_form():
    index = plasticity.slope_index(moments(5.0, 0.01), MODULUS, HARDNESS)
    assert index.value == pytest.approx(MODULUS * 0.01 / HARDNESS, rel=1e-14)
    assert index.elastic_below == pytest.approx(2 / 3)


@pytest.mark.parametrize("alpha", [1.5, 10.0, 1e3])
@pytest.mark.parametrize("slope", [0.003, 0.2])
def test_both_forms_differ_by_a_function_of_nayaks_parameter(alpha, slope):
    given = moments(alpha, slope), MODULUS, HARDNESS
    ratio = plasticity.asperity_index(*given).value / plasticity.slope_index(*given).value
    # s/R = (8/3) sqrt(m0 m4 (1 - c/alpha)/pi), against 2 m2.
    c = 1 + 16 / math.pi - 3 * math.sqrt(3)
    assert ratio == pytest.approx(math.sqrt(4 / (3 * math.sqrt(math.pi)) * math.sqrt(alpha - c)), rel=1e-12)


@pytest.mark.parametrize(
    ("value", "regime"), [(0.59, "elastic"), (0.61, "mixed"), (0.99, "mixed"), (1.01, "plastic")]
)
def test_regimes_of_the_asperity_form(value, regime):
    given = moments(4.0, 0.01)
    at_one = plasticity.asperity_index(given, 1.0, 1.0).value
    assert plasticity.asperity_index(given, value / at_one, 1.0).regime == regime


@pytest.mark.parametrize(("value", "regime"), [(0.66, "elastic"), (0.67, "mixed"), (50.0, "mixed")])
def test_the_slope_form_never_says_plastic(value, regime):
    assert plasticity.slope_index(moments(4.0, 1.0), value, 1.0).regime == regime


def test_an_infinite_slope_is_refused():
    with pytest.raises(ValueError, match="shortest wave"):
        plasticity.slope_index(rc.Moments(1.0, math.inf, math.inf), MODULUS, HARDNESS)


@pytest.mark.parametrize("index", [plasticity.slope_index, plasticity.asperity_index])
def test_a_surface_is_not_its_moments(index):
    with pytest.raises(ValueError, match=r"rc\.surface_moments"):
        index(rc.Surface([[0.0, 1.0]], rc.Grid((1, 2), 1.0)), MODULUS, HARDNESS)


def test_they_say_what_they_predict():
    assert repr(plasticity.PlasticityIndex(0.8, 0.6, 1.0)) == (
        "PlasticityIndex(0.8, mixed: elastic below 0.6, plastic above 1)"
    )
    assert repr(plasticity.PlasticityIndex(0.5, 2 / 3, math.inf)) == (
        "PlasticityIndex(0.5, elastic: elastic below 0.667)"
    )


@pytest.mark.parametrize("bad", [(0.0, HARDNESS), (MODULUS, 0.0)])
def test_moduli_and_hardness_must_be_positive(bad):
    with pytest.raises(ValueError, match="positive"):
        plasticity.slope_index(moments(4.0, 0.1), *bad)


def test_the_index_of_measured_summits():
    index = plasticity.summit_index([1e-6, 3e-6], [1e4, 3e4], MODULUS, HARDNESS)
    assert index.value == pytest.approx(MODULUS / HARDNESS * math.sqrt(1e-6 * 2e4), rel=1e-14)
    assert (index.elastic_below, index.plastic_above) == (0.6, 1.0)


@pytest.mark.parametrize(("cutoff", "rolloff"), [(16e-6, 64e-6), (8e-6, 32e-6)])
def test_on_a_gaussian_surface_both_ways_to_the_summits_agree(cutoff, rolloff):
    grid = rc.Grid((512, 512), 1e-6, True)
    rng = np.random.default_rng(7)
    surface = rc.self_affine(grid, 0.8, 1e-6, rng, rolloff=rolloff, short_cutoff=cutoff)
    found = rc.find_summits(surface)
    measured = plasticity.summit_index(found.height, found.mean_curvature, MODULUS, HARDNESS).value
    stated = plasticity.asperity_index(rc.surface_moments(surface), MODULUS, HARDNESS).value
    # Central differences miss (qD)^2/12 of a curvature, at most that of the shortest wave; a standard deviation of n
    # heights is known to 1/sqrt(2n). The root halves both; three standard errors.
    allowed = 0.5 * ((2 * math.pi * 1e-6 / cutoff) ** 2 / 12 + 3 / math.sqrt(2 * found.count))
    assert allowed < 0.1
    assert measured == pytest.approx(stated, rel=allowed)


@pytest.mark.parametrize(
    ("height", "curvature", "message"),
    [
        ([1e-6], [1e4], "at least two summits"),
        ([1e-6, 2e-6], [1e4], "at least two summits"),
        ([1e-6, math.nan], [1e4, 1e4], "every height"),
        ([1e-6, 2e-6], [-1e4, -1e4], "mean curvature of the summits"),
    ],
)
def test_what_are_no_summits_is_refused(height, curvature, message):
    with pytest.raises(ValueError, match=message):
        plasticity.summit_index(height, curvature, MODULUS, HARDNESS)
