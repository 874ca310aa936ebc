"""Means, scatter and power laws of ensembles of lines."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.statistics.ensemble_fit import fit_ensemble
from roughcontact.statistics.power_law import fit_power_law

GRID = rc.Grid(1024, 1 / 1024)
FORCES = np.geomspace(1e-4, 0.07, 12)


def ensemble(count, hurst=0.8, seed=0, forces=FORCES):
    spectrum = rc.SelfAffineSpectrum(hurst, dimension=1)
    batches = rough_lines(GRID, spectrum, np.random.default_rng(seed), count, rms=1.0)
    return LineCurves.joined(loading_curves(h, GRID.spacing[0], 1.0, forces=forces) for h in batches)


def lawful(count, exponent, prefactor, seed=0):
    """Return samples that scatter about an exact power law, each by one factor at all forces."""
    factors = np.exp(np.random.default_rng(seed).normal(0, 0.3, (count, 1)))
    return FORCES, factors * prefactor * FORCES**exponent


class TestMeans:
    def test_of_the_definition(self):
        curves = ensemble(20)
        stiffness = curves.stiffness
        np.testing.assert_allclose(curves.mean_stiffness(), stiffness.mean(axis=0), rtol=1e-14)
        geometric = np.prod(stiffness ** (1 / 20), axis=0)
        np.testing.assert_allclose(curves.mean_stiffness("geometric"), geometric, rtol=1e-13)
        scatter = stiffness.std(axis=0, ddof=1) / stiffness.mean(axis=0)
        np.testing.assert_allclose(curves.scatter, scatter, rtol=1e-13)
        assert len(curves) == 20

    def test_the_geometric_mean_lies_below_by_half_the_variance_of_ln_k(self):
        curves = ensemble(200)
        ratio = np.log(curves.mean_stiffness() / curves.mean_stiffness("geometric"))
        logs = np.log(curves.stiffness)
        away = logs - logs.mean(axis=0)
        second, third, fourth = ((away**n).mean(axis=0) for n in (2, 3, 4))
        # The series of the cumulants of ln k; the next term is a 120th of the fifth.
        series = second / 2 + third / 6 + (fourth - 3 * second**2) / 24
        assert (np.abs(ratio - series) < (np.abs(away) ** 5).mean(axis=0) / 60).all()
        np.testing.assert_allclose(series, second / 2, rtol=0.1)

    def test_without_contact_there_is_no_scatter(self):
        curves = loading_curves(np.array([[0.0, -1, -2], [0, -3, -1]]), 1.0, 1.0, depths=[0, 1.5])
        np.testing.assert_array_equal(curves.mean_stiffness(), [0, 2])
        np.testing.assert_array_equal(curves.mean_stiffness("geometric"), [0, 2])
        np.testing.assert_array_equal(curves.scatter, [0, 0])

    def test_of_one_line_says_nothing_about_scatter(self):
        assert np.isnan(ensemble(1).scatter).all()

    def test_of_another_kind_is_refused(self):
        with pytest.raises(ValueError, match="'arithmetic' or 'geometric'"):
            ensemble(2).mean_stiffness("harmonic")


class TestJoined:
    def test_is_the_whole(self):
        heights = np.concatenate(list(rough_lines(GRID, lambda q: q**-2.0, np.random.default_rng(1), 5)))
        for loads in ({"forces": FORCES}, {"depths": [1e-3, 1e-2]}):
            whole = loading_curves(heights, 1.0, 2.0, **loads)
            parts = [loading_curves(h, 1.0, 2.0, **loads) for h in (heights[:2], heights[2:])]
            joined = LineCurves.joined(parts)
            for name in ("force", "depth", "springs", "elastic_energy", "rms"):
                np.testing.assert_array_equal(getattr(joined, name), getattr(whole, name))
            assert (joined.modulus, joined.spacing, joined.points) == (2.0, 1.0, 1024)

    def test_of_different_loads_is_refused(self):
        with pytest.raises(ValueError, match="same loads"):
            LineCurves.joined([ensemble(1), ensemble(1, forces=2 * FORCES)])

    def test_of_nothing_is_refused(self):
        with pytest.raises(ValueError, match="no curves"):
            LineCurves.joined([])


class TestFit:
    def test_finds_an_exact_law(self):
        fit = fit_ensemble(*lawful(50, 0.6, 1.1), (2.0, 3.0), "geometric")
        forces, stiffness = lawful(50, 0.6, 1.1)
        factor = np.exp(np.log(stiffness[:, 0] / (1.1 * forces[0] ** 0.6)).mean())
        assert fit.exponent == pytest.approx(0.6, rel=1e-12)
        assert fit.prefactor == pytest.approx(factor * 1.1 * 2**0.6 / 3, rel=1e-12)

    def test_a_common_factor_is_an_error_of_the_prefactor_alone(self):
        count = 4000
        for mean in ("arithmetic", "geometric"):
            fit = fit_ensemble(*lawful(count, 0.6, 1.1), (1.0, 1.0), mean)
            assert fit.exponent_error < 1e-14
            # Of the mean of ln k: 0.3/sqrt(n); of the mean of k its relative scatter, sqrt(exp(0.3^2) - 1). A standard
            # deviation over n samples is known to 1/sqrt(2 n), of skew samples to about twice that.
            scatter = 0.3 if mean == "geometric" else np.sqrt(np.expm1(0.09))
            error = fit.prefactor * scatter / np.sqrt(count)
            assert fit.prefactor_error == pytest.approx(error, rel=6 / np.sqrt(2 * count))

    def test_is_a_line_through_the_points_of_the_window(self):
        curves = ensemble(30)
        inside = curves.mean_stiffness() > 20 / 1024
        assert 3 < inside.sum() < len(FORCES)
        law = fit_power_law(FORCES[inside], curves.mean_stiffness()[inside], 1.0, 1.0)
        fit = curves.fit()
        assert fit.exponent == pytest.approx(law.exponent, rel=1e-12)
        assert fit.prefactor == pytest.approx(law.prefactor, rel=1e-12)
        assert fit.law.window == (FORCES[inside][0], FORCES[-1])
        assert (fit.samples, fit.mean) == (30, "arithmetic")
        np.testing.assert_array_equal(curves.resolved(), inside)

    def test_takes_a_window_of_ones_own(self):
        fit = ensemble(5).fit(window=(FORCES[2], FORCES[6]))
        assert fit.law.window == (FORCES[2], FORCES[6])
        assert fit.law.count == 5

    def test_ends_where_the_thesis_ends(self):
        curves = ensemble(5, forces=np.append(FORCES, [0.1, 0.5, 3.0]))
        assert curves.fit().law.window[1] == pytest.approx(0.07)
        # A line in full contact is not resolved.
        assert not curves.resolved()[-1]

    @pytest.mark.parametrize("mean", ["arithmetic", "geometric"])
    def test_standard_errors_are_those_of_ensembles(self, mean):
        # The scatter of fits to 100 ensembles of 25 lines each is known to 1/sqrt(200): 7 %, three of which are 21 %,
        # and the errors of so few lines are themselves off by up to 1/sqrt(50), averaged here.
        curves = ensemble(2500)
        window = (FORCES[4], FORCES[-1])
        fits = [
            fit_ensemble(FORCES[4:], part, (1.0, 1.0), mean)
            for part in np.split(curves.stiffness[:, 4:], 100)
        ]
        exponents, ln_prefactors = np.array([(f.exponent, np.log(f.prefactor)) for f in fits]).T
        fit = curves.fit(mean, window)
        assert fit.exponent_error == pytest.approx(exponents.std(ddof=1) / 10, rel=0.25)
        error = fit.prefactor * ln_prefactors.std(ddof=1) / 10
        assert fit.prefactor_error == pytest.approx(error, rel=0.25)
        # A correlation r of 100 pairs is known to (1 - r^2)/10.
        r = np.corrcoef(exponents, ln_prefactors)[0, 1]
        assert fit.correlation == pytest.approx(r, abs=3 * (1 - r**2) / 10)
        for force in (FORCES[4], FORCES[-1]):
            laws = [f.law.stiffness(force) for f in fits]
            assert fit.stiffness_error(force) == pytest.approx(np.std(laws, ddof=1) / 10, rel=0.25)

    def test_of_one_line_has_no_errors(self):
        fit = ensemble(1).fit()
        assert np.isnan([fit.exponent_error, fit.prefactor_error, fit.correlation]).all()

    def test_wants_enough_points(self):
        with pytest.raises(ValueError, match="at least 3 forces"):
            ensemble(3, forces=[1e-6, 2e-6]).fit()

    def test_wants_forces(self):
        curves = loading_curves(np.arange(5.0), 1.0, 1.0, depths=[1, 2, 3, 4])
        with pytest.raises(ValueError, match="equal forces"):
            curves.fit()


def test_it_says_what_it_is():
    assert repr(ensemble(3)) == "LineCurves(3 lines of 1024 points, 12 loads, force 0.0001 to 0.07 N)"


def test_scales_of_flat_lines_are_none():
    curves = loading_curves(np.zeros((2, 4)), 1.0, 1.0, forces=[1.0, 2.0])
    assert np.isnan(curves.dimensionless_force).all()
