"""The law of an interface between its loads: closed forms, its ends, and what is no law."""

import math
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pint
import pytest
from scipy.integrate import quad

import roughcontact as rc
from made_laws import exponential, hertz, power, sheared
from roughcontact.errors import InputError
from roughcontact.solver.control import Status

SOFT = rc.Solid(2e9, 0.0)
GRID = rc.Grid((32, 24), (1e-6, 1.5e-6), periodic=True)
SURFACE = rc.self_affine(GRID, hurst=0.8, rms=1e-7, rng=1, rolloff=2e-5, short_cutoff=5e-6)
PRESSURES = np.geomspace(1e5, 1e7, 9)
CURVE = rc.loading_curve(SURFACE, (SOFT, SOFT), pressures=PRESSURES)
LAW = rc.normal_law(CURVE)


def per_decade(law, count):
    """Return the normal law of three decades of pressure, with some loads in each."""
    return law(pressure=np.geomspace(1e-3, 1, 3 * count + 1)).normal


@pytest.mark.parametrize("a", [0.2, 1 / 3, 0.9])
def test_a_power_law_is_met_below_its_loads(a):
    """There the closure is the power that continues it: only rounding is left."""
    normal, p = per_decade(partial(power, a), 4), np.array([1e-9, 1e-5, 9e-4])
    np.testing.assert_allclose(normal.gap_at(p), -(p ** (1 - a)) / (1 - a), rtol=1e-12)
    np.testing.assert_allclose(normal.stiffness_at(p), p**a, rtol=1e-12)
    np.testing.assert_allclose(normal.pressure_at(normal.gap_at(p)), p, rtol=1e-12)
    assert normal.stiffness_at(0) < 1e-20
    assert (normal.gap_at(0), normal.lowest, normal.highest) == (0, 0, 1)
    assert normal.pressure_at(0.5) == 0  # above the gap at first touch


def test_an_exponential_law_ends_at_its_lowest_load():
    normal = per_decade(exponential, 4)
    assert normal.lowest == pytest.approx(1e-3)
    assert normal.gap_at(1e-3) == pytest.approx(-math.log(1e-3), rel=1e-14)
    assert np.isnan(normal.pressure_at(8.0))
    with pytest.raises(InputError, match=r"the law holds from 0\.001 to 1 Pa"):
        normal.gap_at(0.9e-3)


@pytest.mark.parametrize(
    ("law", "gap", "stiffness"),
    [
        (exponential, lambda p: -np.log(p), lambda p: p),
        (hertz, lambda p: -((0.75 * p) ** (2 / 3)), lambda p: 2 * (0.75 * p) ** (1 / 3)),
        (partial(power, 0.9), lambda p: -10 * p**0.1, lambda p: p**0.9),
    ],
)
def test_order_of_the_law_between_its_loads(law, gap, stiffness):
    """Mean gaps, slopes and bends are met at the loads: order 4 in their distance for the gap, 3 for the stiffness."""
    p = np.geomspace(1e-3, 1, 997)
    errors = []
    for count in (4, 8, 16):
        normal = per_decade(law, count)
        assert (np.diff(normal.stiffness_at(p)) > 0).all()
        np.testing.assert_allclose(normal.pressure_at(normal.gap_at(p)), p, rtol=1e-12)
        np.testing.assert_allclose(
            normal.stiffness_at(normal.pressure), stiffness(normal.pressure), rtol=1e-11
        )
        found = (normal.gap_at(p) - gap(p)) * stiffness(p) / p, normal.stiffness_at(p) / stiffness(p) - 1
        errors.append([abs(each).max() for each in found])
    (coarse, _), *_ = errors
    assert coarse < 3e-4
    for (g, k), (finer_g, finer_k) in pairwise(errors):
        assert g / finer_g == pytest.approx(16, rel=0.1)
        assert k / finer_k == pytest.approx(8, rel=0.15)


@pytest.mark.parametrize("law", [hertz(), power(0.9), exponential()])
@pytest.mark.parametrize("ends", [(0.5, 1.0), (0.0, 1.0), (1e-5, 1e-4), (1e-4, 0.3), (0.9999, 1.0)])
def test_the_bow_of_the_gap(law, ends):
    """``int (p_m - p)/K dp``: quadrature to 1e-10 of its terms; below the lowest load, rounding of the closure."""
    low = max(ends[0], law.normal.lowest)
    if low < ends[1]:
        middle, normal = (low + ends[1]) / 2, law.normal
        terms = middle * float(normal.gap_at(low) - normal.gap_at(ends[1]))
        expected, _ = quad(
            lambda x: (middle - math.exp(x)) * math.exp(x) / float(normal.stiffness_at(math.exp(x))),
            math.log(max(low, 1e-140)), math.log(ends[1]), epsrel=1e-9, epsabs=1e-11 * terms, limit=400,
            points=[math.log(1e-3)] if low < 1e-3 < ends[1] else None,
        )  # fmt: skip
        assert normal.bow(low, ends[1]) == pytest.approx(expected, rel=1e-8, abs=3e-11 * terms)


def test_stiffness_rises_whatever_the_loads():
    """A stiffness outside the slopes of the chords beside it, as by an error of a solve, is replaced by the nearer."""
    rng = np.random.default_rng(3)
    p = np.sort(rng.uniform(1, 10, 12))
    gap = -np.log(p)
    normal = sheared(lambda p: gap, lambda p: p * rng.lognormal(0, 0.5, p.shape), 0.5, pressure=p).normal
    at = np.linspace(0, p[-1], 2000)
    assert (np.diff(normal.stiffness_at(at)) > -1e-9).all()
    np.testing.assert_allclose(normal.gap_at(p), gap, atol=1e-14)
    assert min(normal.bow(low, 7.3) for low in (0.0, 0.3, 1.1, 7.2, 7.2999)) > 0
    # Four loads of a spring: the gap is straight, also in between.
    spring = sheared(
        lambda p: -2 * p, lambda p: np.full_like(p, 0.5), 0.0, pressure=np.array([1.0, 2, 4, 5])
    ).normal
    np.testing.assert_allclose(spring.gap_at([0.3, 1.7, 4.9]), [-0.6, -3.4, -9.8], rtol=1e-14)
    np.testing.assert_allclose(spring.stiffness_at([0.3, 1.7, 2.0, 4.9]), 0.5, rtol=1e-12)
    assert spring.bow(0.3, 4.9) == pytest.approx(0, abs=1e-13)


def test_the_law_of_a_curve_goes_through_its_loads():
    np.testing.assert_allclose(LAW.gap_at(PRESSURES), CURVE.mean_gap, rtol=1e-12)
    np.testing.assert_allclose(LAW.stiffness_at(PRESSURES), CURVE.interfacial_stiffness_per_area, rtol=1e-6)
    assert LAW.gap_at(0) == pytest.approx(CURVE.mean_gap[0] + CURVE.depth[0], rel=1e-12)
    assert LAW.cells[-1] == pytest.approx(CURVE.contact_fraction[-1] * 32 * 24)
    assert (LAW.map_area, LAW.hardness) == (GRID.area, math.inf)
    assert LAW.modulus == pytest.approx(1e9)
    assert repr(LAW) == "NormalLaw(9 loads, 1e+05 to 1e+07 Pa)"


def test_other_numbers_of_the_loads_are_kept():
    curve = rc.loading_curve(SURFACE, 1e9, pressures=PRESSURES[::4], measures=[rc.Transmissivity(axis=0)])
    normal = rc.normal_law(curve)
    assert {"contact_fraction", *curve.measured} == set(normal.columns)
    for name, values in normal.fitted.columns.items():
        at = normal.fitted.pressure[[0, 200, -1]]
        expected = np.interp(at, normal.pressure, normal.columns[name])
        np.testing.assert_allclose(values[[0, 200, -1]], expected)


def test_loads_in_any_order_and_those_that_missed_their_tolerance():
    """Loads that fall are sorted; a load that did not converge, one without force, and full contact are left out."""
    names = ("force", "depth", "mean_gap", "contact_area", "interfacial_stiffness")
    turned = replace(CURVE, **{name: getattr(CURVE, name)[::-1] for name in names})
    np.testing.assert_array_equal(rc.normal_law(turned).gap, LAW.gap)
    stalled = (Status.CONVERGED,) * 4 + (Status.STAGNATED,) + (Status.CONVERGED,) * 4
    np.testing.assert_array_equal(
        rc.normal_law(replace(CURVE, status=stalled)).pressure, np.delete(LAW.pressure, 4)
    )
    stiff = np.append(CURVE.interfacial_stiffness[:-1], np.inf)
    assert len(rc.normal_law(replace(CURVE, interfacial_stiffness=stiff)).pressure) == 8
    force = np.append(0.0, CURVE.force[1:])
    assert len(rc.normal_law(replace(CURVE, force=force)).pressure) == 8


def test_first_touch_of_free_maps_and_of_maps_with_holes_is_not_known():
    free = rc.Surface(SURFACE.heights, rc.Grid((32, 24), (1e-6, 1.5e-6)))
    holed = SURFACE.masked(above=float(np.quantile(SURFACE.heights, 0.9)))
    for surface in (free, holed):
        normal = rc.normal_law(rc.loading_curve(surface, 1e9, pressures=PRESSURES))
        assert math.isnan(normal.touch)
        assert normal.lowest == pytest.approx(PRESSURES[0])
        with pytest.raises(InputError, match="the law holds from 1"):
            normal.gap_at(PRESSURES[0] / 2)


def test_after_flow_the_law_is_that_of_the_flattened_surface():
    """Both are solved to 1e-8 of the largest displacement, here less than the gap at first touch."""
    loop = rc.loading_loop(SURFACE, (SOFT, SOFT), hardness=6e7, pressures=PRESSURES)
    assert loop.flow.volume > 0
    after, same = (
        rc.normal_law(loop),
        rc.normal_law(rc.loading_curve(loop.flattened, 1e9, pressures=PRESSURES)),
    )
    assert after.touch == pytest.approx(same.touch, rel=1e-12)
    np.testing.assert_allclose(after.gap, same.gap, rtol=0, atol=4e-8 * same.touch)
    assert (after.hardness, same.hardness) == (6e7, math.inf)
    # The flattened surface is stiffer, and touches at a smaller mean gap.
    assert after.touch < LAW.touch
    assert after.stiffness_at(1e6) > LAW.stiffness_at(1e6)
    for branch in (loop.loading, loop.unloading, loop.reloading):
        with pytest.raises(InputError, match="one branch of a surface that flows"):
            rc.normal_law(branch)


@pytest.mark.parametrize("a", [0.2, 0.9, 1.0, 1.3])
def test_the_fitted_law_meets_a_power_law(a):
    """The stiffness of the loads is not used. Exact to the passes of the fit; order 4 between 400 loads."""
    p = np.array([0.01, 0.03, 0.5, 1.0])
    gap = (lambda p: -np.log(p)) if a == 1 else (lambda p: -(p ** (1 - a)) / (1 - a))
    fitted = sheared(gap, np.ones_like, 0.0 if a < 1 else math.nan, pressure=p).normal.fitted
    at = np.array([0.01, 0.1, 0.77, 1.0])
    np.testing.assert_allclose(fitted.stiffness_at(at), at**a, rtol=1e-6)
    np.testing.assert_allclose(fitted.gap_at(at), gap(at), rtol=1e-6, atol=1e-12)
    assert np.isinf(fitted.cells).all()
    assert (fitted.lowest == 0) == (a < 1)
    with pytest.raises(
        InputError, match="needs three loads, and this law has two: press the map by more loads"
    ):
        sheared(gap, np.ones_like, math.nan, pressure=p[:2]).normal.fitted  # noqa: B018


def test_a_law_takes_units():
    U = pint.get_application_registry()
    assert LAW.gap_at(1 * U.MPa) == LAW.gap_at(1e6)
    assert LAW.pressure_at(LAW.gap_at(1e6) * 1e9 * U.nm) == pytest.approx(1e6, rel=1e-9)
    with pytest.raises(InputError, match="Pa"):
        LAW.stiffness_at(1 * U.N)


def test_arrays_keep_their_shape():
    p = np.array([[1e5, 2e5, 3e6], [1e4, 1e6, 1e7]])
    for values in (LAW.gap_at(p), LAW.stiffness_at(p), LAW.pressure_at(LAW.gap_at(p))):
        assert values.shape == p.shape
    np.testing.assert_allclose(LAW.pressure_at(LAW.gap_at(p)), p, rtol=1e-11)


@pytest.mark.parametrize(
    ("pressure", "gap"),
    [([1.0], [0.0]), ([], []), ([1.0, 1.0], [2.0, 1.0]), ([2.0, 1.0], [2.0, 1.0]), ([1.0, 2.0], [1.0, 2.0]),
     ([0.0, 1.0], [2.0, 1.0]), ([1.0, 2.0], [6.0, 1.0])],
)  # fmt: skip
def test_what_is_no_law(pressure, gap):
    """One load, none, equal loads, falling loads, a gap that rises, no pressure, a gap above that at first touch."""
    p, g = np.array(pressure), np.array(gap)
    with pytest.raises(InputError, match=r"two or more loads, .* press the map by more loads"):
        rc.NormalLaw(p, g, p, 5.0, p, 1.0, 1.0, math.inf, {})


def test_what_has_no_law_per_area():
    line = rc.self_affine(rc.Grid(64, 1e-6, periodic=True), hurst=0.8, rms=1e-8, rng=1)
    curve = rc.loading_curve(line, 1e9, forces=[1.0, 2.0], operator=rc.line(line.grid, 1e9))
    with pytest.raises(InputError, match="needs the curve of a map, not of a line: press a map of heights"):
        rc.normal_law(curve)
    for wrong in (SURFACE, 5, None, rc.press(SURFACE, 1e9, pressure=1e6)):
        with pytest.raises(InputError, match=r"must be a Curve, as .* returns it, or a Loop"):
            rc.normal_law(wrong)
    for wrong, message in (
        (lambda: LAW.gap_at(1.1e7), r"the law holds from 0 to 1e\+07 Pa .*use a curve whose loads include"),
        (lambda: LAW.gap_at(-1.0), "nominal pressure .* not negative"),
        (lambda: LAW.stiffness_at(math.nan), "must be a number"),
        (
            lambda: LAW.pressure_at(0.5 * LAW.gap_at(1e7)),
            "the smallest mean gap of the curve is .*higher loads",
        ),
    ):
        with pytest.raises(InputError, match=message):
            wrong()
