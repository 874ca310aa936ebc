"""A theory laid over a curve."""

import json

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.compare import Comparison
from roughcontact.theory.law import LoadingLaw

MODULUS, RADIUS = 2.0, 1.0


@pytest.fixture(scope="module")
def curve():
    grid = rc.RadialGrid.uniform(200, 0.6)
    profile = rc.RadialProfile(-(grid.radii**2) / (2 * RADIUS), grid)
    return rc.loading_curve(profile, MODULUS, depths=[0.01, 0.04, 0.09, 0.16])


def hertz_law(domain=(0.0, np.inf)):
    def stiffness(force):
        return (6 * MODULUS**2 * RADIUS * force) ** (1 / 3)

    def depth(force):
        return (9 * force**2 / (16 * MODULUS**2 * RADIUS)) ** (1 / 3)

    return LoadingLaw(
        "Hertz", "Hertz 1881", {"stiffness": stiffness, "depth": depth, "glow": stiffness}, domain
    )


def test_the_right_theory_lies_on_the_curve(curve):
    """To the order of the rings, one in the stiffness."""
    comparison = curve.compare(hertz_law())
    assert set(comparison.predicted) == {"stiffness", "depth"}  # of what a curve has
    np.testing.assert_allclose(comparison.ratio("depth"), 1, rtol=1e-3)
    np.testing.assert_allclose(comparison.ratio("stiffness"), 1, rtol=0.02)
    assert comparison.deviation("depth") < 1e-3
    assert "Hertz" in repr(comparison)


def test_a_wrong_theory_does_not(curve):
    twice = LoadingLaw("twice", "nobody", {"depth": lambda force: 2 * hertz_law().quantities["depth"](force)})
    comparison = curve.compare(twice)
    assert comparison.deviation("depth") == pytest.approx(np.log(2), abs=1e-3)


def test_a_theory_is_silent_outside_its_domain(curve):
    comparison = curve.compare(hertz_law((0.0, float(curve.force[1]))))
    assert np.isfinite(comparison.predicted["depth"]).tolist() == [True, True, False, False]
    record = comparison.to_record()
    assert record["predicted"]["depth"][2:] == [None, None]
    json.dumps(record, allow_nan=False)


def test_local_exponents_are_of_resolved_positive_loads():
    """The lightest third grows as F, the heaviest holds zeros and a NaN; between them the stiffness is F^(1/3)."""
    force = np.geomspace(1, 1e6, 60)
    resolved = force >= 1e2
    stiffness = 1e-3 * np.where(resolved, np.cbrt(force), force)
    stiffness[-3:] = 0.0, -1.0, np.nan
    found = Comparison(
        "square root", "nobody", force, resolved, {"stiffness": stiffness}, {"stiffness": np.sqrt(force)}
    ).local_exponents("stiffness")
    assert len(found) > 2
    for computed, predicted in found:
        assert computed.exponent == pytest.approx(1 / 3, rel=1e-12)
        assert predicted.exponent == pytest.approx(1 / 2, rel=1e-12)


def test_deviation_is_none_without_resolved_loads(curve):
    from dataclasses import replace

    lost = replace(curve, cell_stiffness=float(curve.full_contact_stiffness))
    assert np.isnan(lost.compare(hertz_law()).deviation("depth"))
    assert lost.compare(hertz_law()).to_record()["deviation"]["depth"] is None


@pytest.mark.parametrize(
    ("name", "message"), [("glow", "a curve has no 'glow'"), ("force", "has no 'force'")]
)
def test_what_nobody_speaks_of_is_refused(curve, name, message):
    with pytest.raises(ValueError, match=message):
        curve.compare(hertz_law(), [name])


def test_a_law_of_the_users_own_stands_beside_a_curve(curve):
    own = LoadingLaw("own", "notes", {"stiffness": lambda force: 3.0 * force})
    np.testing.assert_allclose(curve.compare(own).predicted["stiffness"], 3 * curve.force, rtol=1e-15)
    [line] = [each for each in curve.plot(theories=[own]).lines if each.get_label().startswith("own")]
    ratio = line.get_ydata() / line.get_xdata()  # in units of the axes
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-12)


def test_a_name_is_no_theory(curve):
    with pytest.raises(ValueError, match="compare takes a theory"):
        curve.compare("persson")


def test_it_says_on_how_many_loads_it_rests(curve):
    partly = curve.compare(hertz_law((0.0, float(curve.force[1]))), ["depth"])
    resolved = int(curve.resolved.sum())
    assert f"({int(partly.common('depth').sum())} of {resolved} loads)" in repr(partly)
    never = curve.compare(hertz_law((1e9, 1e10)), ["depth"])
    assert "depth: no load in common" in repr(never)
    assert never.to_record()["loads_compared"] == {"depth": 0}


def test_a_line_is_not_held_against_laws_of_forces():
    grid = rc.Grid(32, 0.1)
    operator = rc.line(grid, MODULUS)
    line = rc.loading_curve(rc.Surface(np.arange(32.0) ** 2, grid), MODULUS, forces=[1.0], operator=operator)
    with pytest.raises(ValueError, match="per unit length"):
        line.compare(hertz_law())
