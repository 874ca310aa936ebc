"""Asperities that stick: against quadrature in another variable, and limits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.adhesive.adhesive_asperities import AdhesiveAsperities
from roughcontact.theory.adhesive.adhesive_sphere import JKRSphere
from roughcontact.theory.asperity_models import greenwood_williamson

SPHERE = JKRSphere(1.0, 1.0, 1e-3)


def rough(ratio, limit="jkr", work=1e-3):
    """Return asperities whose heights scatter by so many of the length that one stretches."""
    return AdhesiveAsperities(0.01, -ratio * SPHERE.least_depth, 1.0, 1.0, work, limit)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 5.0])
@pytest.mark.parametrize("shift", [-0.5, 1.0, 3.0])
def test_fuller_and_tabor_by_quadrature_over_the_contact_radius(ratio, shift):
    """The integral over heights as one over radii, in which no equation is solved."""
    asperities = rough(ratio)
    std = asperities.std
    s = shift * std
    slope = lambda a: 2 * a - math.sqrt(math.pi * 1e-3 / (2 * a))  # noqa: E731
    fold = (math.sqrt(math.pi * 1e-3 / 2) / 2) ** (2 / 3)
    top = float(SPHERE.contact_radius(9 * std + abs(s)))

    def integrand(a):
        z = (s + float(SPHERE.depth(a))) / std
        return float(SPHERE.force(a)) * slope(a) * math.exp(-(z**2) / 2) / (math.sqrt(2 * math.pi) * std)

    told, _ = quad(integrand, fold, top, epsabs=0, epsrel=1e-10, limit=400)
    assert float(asperities.pressure(s)) == pytest.approx(0.01 * told, rel=1e-8)


def test_without_scatter_every_asperity_pulls_at_once():
    assert rough(1e-3).pull_off_pressure == pytest.approx(0.01 * SPHERE.pull_off_force, rel=1e-5)
    assert rough(1e-3, "dmt").pull_off_pressure == pytest.approx(0.01 * 2 * math.pi * 1e-3, rel=2e-2)


def test_the_tension_falls_with_the_scatter():
    tensions = [rough(ratio).pull_off_pressure for ratio in (0.1, 0.5, 1.0, 2.0, 4.0)]
    assert (np.diff(tensions) < 0).all()
    assert tensions[-1] < 1e-2 * tensions[0]


@pytest.mark.parametrize("limit", ["jkr", "dmt"])
def test_without_work_it_is_greenwood_and_williamsons(limit):
    plain = greenwood_williamson.Population(
        greenwood_williamson.Asperity.hertz(1.0, 1.0), density=0.01, std=1e-2
    )
    sticky = AdhesiveAsperities(0.01, 1e-2, 1.0, 1.0, 1e-16, limit)
    s = np.array([0.0, 1.0, 2.5]) * 1e-2
    # Of the order sqrt(w): the tension of Johnson, Kendall and Roberts.
    np.testing.assert_allclose(sticky.pressure(s), plain.pressure(s), rtol=1e-5)
    np.testing.assert_allclose(sticky.contact_fraction(s), plain.contact_fraction(s), rtol=1e-5)


def test_maugis_asperities_are_hertzs_less_the_attraction_of_each_in_contact():
    asperities = rough(1.0, "dmt")
    plain = greenwood_williamson.Population(
        greenwood_williamson.Asperity.hertz(1.0, 1.0), density=0.01, std=asperities.std
    )
    for t in (0.0, 0.5, 2.0):
        touching = 0.5 * math.erfc(t / math.sqrt(2))
        wanted = float(plain.pressure(t * asperities.std)) - 0.01 * touching * 2 * math.pi * 1e-3
        assert float(asperities.pressure(t * asperities.std)) == pytest.approx(wanted, rel=1e-9)


def test_what_is_no_limit_is_refused():
    with pytest.raises(ValueError, match="'jkr', 'dmt'"):
        AdhesiveAsperities(1.0, 1.0, 1.0, 1.0, 1.0, "maugis")
    with pytest.raises(ValueError, match="the std"):
        AdhesiveAsperities(1.0, 0.0, 1.0, 1.0, 1.0)
