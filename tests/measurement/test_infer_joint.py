"""Inference from stiffness and closure of joints whose truth is known, drawn from the emulator itself."""

import dataclasses
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.measurement.joint_emulator import (
    BAND,
    HURST,
    LARGE,
    LEAST_AREA,
    SIDE,
    joint_emulator,
    terms,
)
from roughcontact.measurement.joint_model import JointModel, discrepancy
from roughcontact.measurement.joint_plan import fisher_width
from roughcontact.measurement.joint_topography import prior_of

RMS, ROLLOFF, MODULUS = 1.2e-6, 1e-4, 115e9
AREA = (12 * ROLLOFF) ** 2
SCALED = np.geomspace(0.01, 0.2, 5)  # p l/(E* h)
GIVEN = {"modulus": MODULUS, "modulus_error": 0.02, "area": AREA, "branch": "loading"}
TOPOGRAPHY = rc.JointTopography(RMS, 0.4, ROLLOFF, 0.17, 0.75, 0.2)


def pressures(rms=RMS):
    return SCALED * MODULUS * rms / ROLLOFF


def drawn(rng, rms=RMS, errors=0.05, gain=0.03):
    """A joint of the model, measured."""
    p = pressures(rms)
    point = np.log([[rms, ROLLOFF, 1, 6, MODULUS]])
    point[0, 2] = 0.8
    mean, covariance = JointModel(joint_emulator(), AREA).stiffness(point, np.log(p))
    noise = np.diag(np.full(p.size, errors**2)) + gain**2
    return rc.JointStiffness(p, np.exp(rng.multivariate_normal(mean[0], covariance[0] + noise)), errors, gain)


def height(found, rms=RMS):
    return rms**found.exponent * ROLLOFF ** (1 - found.exponent)


def test_intervals_hold_the_height_as_often_as_they_say():
    """Of 40 joints of the model itself: 99.9 % binomial limits of 50 and 90 %."""
    rng = np.random.default_rng(1)
    inside = {0.5: 0, 0.9: 0}
    flagged = 0
    for _ in range(40):
        prior = math.exp(0.4 * rng.standard_normal()) * RMS
        found = rc.infer_joint(drawn(rng, prior), **GIVEN, profile=TOPOGRAPHY)
        flagged += not found.fits
        for level in inside:
            low, high = (
                found.posterior.quantiles(_heights(found), np.array([1 - level, 1 + level]) / 2)
            ).tolist()
            inside[level] += low < math.log(height(found, prior)) < high
    assert 10 <= inside[0.5] <= 30
    assert 29 <= inside[0.9] <= 40
    assert flagged <= 4


def _heights(found):
    rms, rolloff = found.posterior.points[:, :2].T
    return found.exponent * rms + (1 - found.exponent) * rolloff


@pytest.fixture(scope="module")
def data():
    return drawn(np.random.default_rng(5))


@pytest.fixture(scope="module")
def found(data):
    return rc.infer_joint(data, **GIVEN)


def test_the_height_is_told_and_the_hurst_exponent_is_not(found):
    assert found.fits
    low, high = found.interval(0.9)
    assert low < found.effective_height < high
    assert found.share_below(found.effective_height) == pytest.approx(0.5, abs=0.01)
    assert high / low < 2
    told = {each.name: each.informed for each in found.parameters}
    assert told["rms"]
    assert not told["hurst"]
    assert not told["modulus"]
    assert "no information" in str(found.parameters[2])
    low, median, high = found.predicted(pressures())
    assert ((low < median) & (median < high)).all()
    assert np.isnan(found.predicted([1e-3])[0]).all()


def test_units_do_not_matter(data, found):
    """The same joint with all lengths a thousandfold, and a modulus of a hundredth."""
    scaled = rc.JointStiffness(data.pressures / 100, data.stiffness / 1e5, data.errors, data.gain)
    given = GIVEN | {"modulus": MODULUS / 100, "area": AREA * 1e6}
    wide = rc.JointTopography(RMS * 1e3, 0.4, ROLLOFF * 1e3, 0.17, 0.75, 0.2)
    here = rc.infer_joint(data, **GIVEN, profile=TOPOGRAPHY)
    there = rc.infer_joint(scaled, **given, profile=wide)
    assert there.effective_height == pytest.approx(1e3 * here.effective_height, rel=1e-6)
    assert there.p_value == pytest.approx(here.p_value, rel=1e-6)


def test_errors_widen_the_interval_and_the_modulus_enters(data, found):
    rough = rc.JointStiffness(data.pressures, data.stiffness, 0.2, data.gain)
    assert rc.infer_joint(rough, **GIVEN).width > found.width
    point = np.array([*np.log([RMS, ROLLOFF]), 0.8, np.log(6), np.log(MODULUS)])
    widths, bounds = [], []
    for error in (0.02, 0.8):
        inferred = rc.infer_joint(data, **(GIVEN | {"modulus_error": error}), profile=TOPOGRAPHY)
        widths.append(inferred.width)
        prior = prior_of((MODULUS, error), AREA, TOPOGRAPHY)
        bounds.append(fisher_width(JointModel(joint_emulator(), AREA), data, point, prior))
    # A width of 3000 effective draws scatters by 1.3 %, a ratio by 1.9 %: four of these. The bound is for small errors;
    # so large a one is also limited by the curvature of ln K, which shows p l/(E* h).
    assert 1 + 4 * 0.019 < widths[1] / widths[0] < bounds[1] / bounds[0] + 4 * 0.019


def test_a_slope_of_other_contacts_is_not_this_model(data):
    bent = rc.JointStiffness(
        data.pressures, data.stiffness * (data.pressures / 3e7) ** -0.45, data.errors, data.gain
    )
    found = rc.infer_joint(bent, **GIVEN)
    assert not found.fits
    assert found.departs == "slope"
    assert math.isnan(found.effective_height)
    assert all(map(math.isnan, found.interval()))
    assert found.parameters == ()
    assert "not this model" in repr(found)
    assert any("in series" in note for note in found.notes)


def test_a_level_off_is_seen_with_a_topography_only(data):
    low = rc.JointStiffness(data.pressures, data.stiffness / 1.8, data.errors, data.gain)
    assert rc.infer_joint(low, **GIVEN).fits
    topography = rc.JointTopography(RMS, 0.1, ROLLOFF, 0.2)
    found = rc.infer_joint(low, **GIVEN, profile=topography)
    assert not found.fits
    assert found.departs == "level"
    assert rc.infer_joint(data, **GIVEN, profile=topography).fits


def test_one_load_tells_the_height_only(data):
    one = rc.JointStiffness(data.pressures[2:3], data.stiffness[2:3], 0.05, 0.03)
    found = rc.infer_joint(one, **GIVEN)
    assert found.parameters == ()
    assert found.fits
    assert found.interval()[0] < height(found) * 2


def test_closures_tell_what_stiffness_tells(data, found):
    """Closure of a smooth curve through the stiffnesses, with the compliance of a machine."""
    p = np.geomspace(data.pressures[0], data.pressures[-1], 10)
    fine = np.geomspace(p[0], p[-1], 4001)
    a, b = np.polyfit(np.log(data.pressures), np.log(data.stiffness), 1)
    closure = (fine ** (1 - a) - fine[0] ** (1 - a)) / ((1 - a) * math.exp(b))
    machine = 1e-15
    values = np.interp(p, fine, closure) + machine * p + 3e-6
    closures = rc.JointClosures(p, values, 2e-9, machine, machine / 100)
    same = rc.infer_joint(closures, **GIVEN, profile=TOPOGRAPHY)
    assert same.fits
    assert abs(math.log(same.effective_height / found.effective_height)) < 2 * found.width
    forgotten = rc.infer_joint(rc.JointClosures(p, values, 2e-9), **GIVEN, profile=TOPOGRAPHY)
    assert forgotten.effective_height > same.effective_height  # a machine in series makes it softer


def test_the_closure_is_the_integral_of_the_compliance():
    data = rc.JointClosures([1e6, 3e6, 9e6], [0, 1e-6, 2e-6], 1e-8)
    mean, _ = data.observed(
        0.9 * data.log_pressures[None] + 12, np.zeros((1, data.log_pressures.size, data.log_pressures.size))
    )
    p = data.pressures
    truth = (p**0.1 - p[0] ** 0.1) / (0.1 * math.exp(12))
    np.testing.assert_allclose(mean[0], truth[1:], rtol=1e-9)


def test_scatter_of_the_closure_is_of_first_order_and_its_mean_of_second():
    data = rc.JointClosures([1e6, 9e6], [0, 1e-6], 1e-8)
    n = data.log_pressures.size
    sd = 0.05
    mean, covariance = data.observed(np.full((1, n), 30.0), np.full((1, n, n), sd**2))  # all nodes together
    plain = 8e6 * math.exp(-30)
    assert mean[0, 0] == pytest.approx(plain * math.exp(sd**2 / 2), rel=sd**4)
    assert math.sqrt(covariance[0, 0, 0]) == pytest.approx(plain * sd, rel=1e-9)


def test_a_reflection_is_a_stiffness():
    from roughcontact.theory import ultrasound

    impedances = (46.2e6, 46.2e6)
    k, error = ultrasound.stiffness_from_reflection(np.array([0.9, 0.8]), 5e6, impedances, 0.01)
    data = rc.JointStiffness.from_reflection(
        [1e6, 2e6], [0.9, 0.8], 0.01, frequency=5e6, impedances=impedances
    )
    np.testing.assert_allclose(data.stiffness, k)
    np.testing.assert_allclose(data.errors, error / k)
    with pytest.raises(ValueError, match="times less certain"):
        rc.JointStiffness.from_reflection([1e6], [0.999], 0.01, frequency=5e6, impedances=impedances)


class TestEmulator:
    def test_terms_are_a_basis_of_second_degree(self):
        rng = np.random.default_rng(1)
        points = [rng.uniform(*ends, 40) for ends in (HURST, SIDE, BAND)]
        basis = terms(*points)
        assert basis.shape == (40, 10)
        assert np.linalg.matrix_rank(basis) == 10
        h, s, b = points[0], np.log(points[1]), np.log(points[2])
        target = 1 + h - 2 * h * s + b**2
        assert np.linalg.lstsq(basis, target, rcond=None)[1] < 1e-20 * (target**2).sum()

    def test_between_nodes_it_is_smooth_and_on_them_it_is_the_fit(self):
        emulator = joint_emulator()
        one = (np.array([0.7]), np.array([10.0]), np.array([5.0]))
        mean, covariance = emulator.at(*one, emulator.nodes[None])
        np.testing.assert_allclose(mean[0], (terms(*one) @ emulator.mean)[0], rtol=1e-12)
        assert np.linalg.eigvalsh(covariance[0])[0] > 0
        middle = (emulator.nodes[1:] + emulator.nodes[:-1]) / 2
        between, _ = emulator.at(*one, middle[None])
        assert (np.diff(between[0]) > 0).all()
        assert (mean[0, :-1] < between[0]).all()
        assert (between[0] < mean[0, 1:]).all()

    def test_the_variance_of_larger_joints_falls_with_the_area_and_ln_of_the_mean_stays(self):
        emulator = joint_emulator()
        sides = np.array([SIDE[1], 4 * SIDE[1]])
        two = (np.full(2, 0.8), sides, np.full(2, 6.0), np.tile(emulator.nodes, (2, 1)))
        pieces = dataclasses.replace(emulator, departure=0 * emulator.departure)
        mean, covariance = pieces.at(*two)
        variance = np.diagonal(covariance, axis1=1, axis2=2) - emulator.misfit**2
        np.testing.assert_allclose(variance[0] / variance[1], 16, rtol=1e-9)
        variance /= emulator.inflation
        np.testing.assert_allclose(mean[0] + variance[0] / 2, mean[1] + variance[1] / 2, rtol=1e-12)
        softer, wider = emulator.at(*two)
        np.testing.assert_array_equal(softer[0], mean[0])
        beyond = (1 - 1 / 16) / (1 - (SIDE[1] / LARGE) ** 2)
        np.testing.assert_allclose(softer[1] - mean[1], beyond * emulator.departure)
        more = np.diagonal(wider[1] - covariance[1])
        np.testing.assert_allclose(more, (beyond * emulator.departure / 2) ** 2, atol=1e-15)


@pytest.fixture(scope="module")
def plan():
    return rc.plan_joint(
        pressures(),
        errors=0.05,
        gain=0.03,
        modulus=MODULUS,
        modulus_error=0.02,
        areas=np.array([0.7e-6, 1.4e-6, 2.5e-6]),
        specimens=(1, 4, 16),
        profile=TOPOGRAPHY,
    )


class TestPlan:
    def test_area_and_specimens_narrow_the_interval(self, plan):
        assert (np.diff(plan.width, axis=0) < 0).all()
        assert (np.diff(plan.width, axis=1) < 0).all()

    def test_the_least_total_area_is_found_or_none(self, plan):
        wanted = plan.width[1, 1]
        area, number = plan.reaching(wanted)
        assert area * number <= 4 * 1.4e-6
        row, column = plan.areas.tolist().index(area), plan.specimens.tolist().index(number)
        assert plan.width[row, column] <= wanted
        assert plan.reaching(plan.width.min() / 2) is None

    def test_without_a_load_it_is_that_of_the_others(self, plan):
        others = rc.plan_joint(
            plan.pressures[1:],
            errors=0.05,
            gain=0.03,
            modulus=MODULUS,
            modulus_error=0.02,
            areas=plan.areas,
            specimens=(int(plan.specimens[0]),),
            profile=TOPOGRAPHY,
        )
        assert plan.without[0] == pytest.approx(others.width[0, 0], rel=1e-12)
        assert (plan.without >= plan.width[0, 0]).all()

    def test_it_is_what_the_posterior_gives(self):
        """Fisher's bound with the prior: the posterior of a nearly linear model has that width, to 15 %."""
        rng = np.random.default_rng(5)
        point = np.array([*np.log([RMS, ROLLOFF]), 0.8, np.log(6), np.log(MODULUS)])
        prior = prior_of((MODULUS, 0.02), AREA, TOPOGRAPHY)
        widths = []
        for _ in range(10):
            data = drawn(rng)
            widths.append(rc.infer_joint(data, **GIVEN, profile=TOPOGRAPHY).width)
        bound = fisher_width(JointModel(joint_emulator(), AREA), data, point, prior)
        assert np.mean(widths) == pytest.approx(bound, rel=0.15)


def test_discrepancy_is_correlated_over_a_decade():
    found = discrepancy(np.log([1e6, 1e7]))
    assert found[0, 0] == pytest.approx(0.05**2)
    assert found[0, 1] / found[0, 0] == pytest.approx(math.exp(-0.5))


class TestRefused:
    @pytest.mark.parametrize(
        ("wrong", "words"),
        [
            ({"branch": None}, "branch must be 'loading' or 'unloading', not None"),
            ({"modulus": -1.0}, "modulus"),
            ({"modulus_error": 0.0}, "modulus_error"),
            ({"area": 0.0}, "area"),
        ],
    )
    def test_what_is_missing_or_wrong_is_named(self, data, wrong, words):
        with pytest.raises(ValueError, match=words):
            rc.infer_joint(data, **(GIVEN | wrong))

    def test_a_joint_of_few_squares(self, data):
        small = {"area": 0.9 * LEAST_AREA * ROLLOFF**2}
        with pytest.raises(ValueError, match="squares of the roll-off wavelength"):
            rc.infer_joint(data, **(GIVEN | small), profile=TOPOGRAPHY)

    def test_loads_beyond_the_emulator(self, data):
        heavy = rc.JointStiffness(data.pressures * 300, data.stiffness * 300, 0.05)
        with pytest.raises(ValueError, match="beyond the emulator"):
            rc.infer_joint(heavy, **GIVEN, profile=TOPOGRAPHY)

    @pytest.mark.parametrize("errors", [0.0, -0.1, math.nan, [0.1, 0.1]])
    def test_errors(self, errors):
        with pytest.raises(ValueError, match="errors"):
            rc.JointStiffness([1e6, 2e6, 3e6], [1e12, 2e12, 3e12], errors)

    def test_closures_of_one_load_or_out_of_order(self):
        for p in ([1e6], [2e6, 1e6]):
            with pytest.raises(ValueError, match="two or more pressures that increase"):
                rc.JointClosures(p, np.zeros(len(p)), 1e-9)
