"""Power laws of ensembles: exact ones, windows, what is missing, and how often intervals hold the truth."""

import numpy as np
import pytest
import xarray
from scipy import stats

from roughcontact.statistics.ensemble_fit import fit_ensemble
from roughcontact.statistics.fit import fit_power_laws, law_at
from roughcontact.statistics.fit_window import Window, force_window, resolved_window, window_of

FORCE = np.geomspace(1e-4, 0.3, 24)
HURST = np.array([0.2, 0.6, 1.0])
EVERYTHING = force_window(1e-9, 1.0)


def rng():
    return np.random.default_rng(12)


def scattered(samples, *, correlated=0.3, loose=0.1, seed=0, hurst=HURST):
    """Return k/(E* L), (hurst, sample, load), about a power law: each curve by a factor and a slope of its own."""
    draw = np.random.default_rng(seed)
    shape = (len(hurst), samples, 1)
    x = np.log(FORCE)
    noise = draw.normal(0, correlated, shape) + 0.05 * draw.normal(0, 1, shape) * (x - x.mean())
    noise = noise + draw.normal(0, loose, (len(hurst), samples, len(x)))
    # The mean of the exponential of a normal number of variance v is exp(v/2): off with it, and the mean is the law.
    variance = correlated**2 + (0.05 * (x - x.mean())) ** 2 + loose**2
    return 0.9 * FORCE ** (1 / (1 + hurst[:, np.newaxis, np.newaxis])) * np.exp(noise - variance / 2)


def curves(stiffness, *, hurst=HURST, cell=1e-3, **more):
    dims = ("hurst", "sample", "load")
    scale = 7e3  # E* L
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", FORCE),
            "dimensionless_stiffness": (dims, stiffness),
            "stiffness": (dims, scale * stiffness),
            "cell_stiffness": ((), scale * cell),
            "full_contact_stiffness": ((), scale * 1.15),
        }
        | more,
        {"hurst": hurst},
    )


class TestLaw:
    def test_an_exact_one_is_found_and_certain(self):
        exact = 0.9 * FORCE ** (1 / (1 + HURST[:, np.newaxis, np.newaxis])) * np.ones((3, 4, 1))
        fits = fit_power_laws(curves(exact), EVERYTHING, rng=rng())
        np.testing.assert_allclose(fits["exponent"], 1 / (1 + HURST), rtol=1e-12)
        np.testing.assert_allclose(fits["prefactor"], 0.9, rtol=1e-12)
        for name in ("exponent_error", "prefactor_error", "exponent_sandwich_error", "misfit"):
            np.testing.assert_allclose(fits[name], 0, atol=1e-13)
        np.testing.assert_allclose(fits["exponent_high"] - fits["exponent_low"], 0, atol=1e-13)
        assert fits["count"].dtype.kind == "i"
        np.testing.assert_array_equal(fits["hurst"], HURST)

    @pytest.mark.parametrize("mean", ["arithmetic", "geometric"])
    def test_is_the_line_through_the_means(self, mean):
        stiffness = scattered(30)
        fits = fit_power_laws(curves(stiffness), EVERYTHING, rng=rng(), mean=mean)
        logs = np.log(stiffness.mean(axis=1)) if mean == "arithmetic" else np.log(stiffness).mean(axis=1)
        slope, offset = np.polyfit(np.log(FORCE), logs.T, 1)
        np.testing.assert_allclose(fits["exponent"], slope, rtol=1e-12)
        np.testing.assert_allclose(fits["prefactor"], np.exp(offset), rtol=1e-12)
        assert fits.attrs["mean"] == mean

    def test_forces_may_differ_from_ensemble_to_ensemble(self):
        data = curves(scattered(5))
        factors = xarray.DataArray([1.0, 2.0, 3.0], dims="hurst")
        moved = fit_power_laws(
            data.assign(dimensionless_force=factors * data["dimensionless_force"]), EVERYTHING, rng=rng()
        )
        fits = fit_power_laws(data, EVERYTHING, rng=rng())
        np.testing.assert_allclose(moved["exponent"], fits["exponent"], rtol=1e-11)
        np.testing.assert_allclose(moved["window_low"], factors * FORCE[0], rtol=1e-15)

    def test_errors_of_resampling_are_those_of_what_each_sample_adds(self):
        fits = fit_power_laws(curves(scattered(60)), EVERYTHING, rng=rng(), replicates=4000)
        # A deviation of B replicates is known to 1/sqrt(2 B), four of which are 4.5 %; replicates scatter less by
        # sqrt(1 - 1/n), 0.8 %; and logarithms of means are curved, which is another 1/n.
        for name in ("exponent", "prefactor"):
            np.testing.assert_allclose(fits[f"{name}_error"], fits[f"{name}_sandwich_error"], rtol=0.07)
        # The same draws, the same numbers.
        assert fit_power_laws(curves(scattered(60)), EVERYTHING, rng=rng(), replicates=4000).identical(fits)

    def test_lines_within_samples_count_as_samples(self):
        stiffness = scattered(12)
        pairs = curves(stiffness).drop_vars(["stiffness", "dimensionless_stiffness"])
        pairs["dimensionless_stiffness"] = (
            ("hurst", "sample", "line", "load"),
            stiffness.reshape(3, 4, 3, len(FORCE)),
        )
        found = fit_power_laws(pairs, EVERYTHING, rng=rng(), samples=("sample", "line"))
        expected = fit_power_laws(curves(stiffness), EVERYTHING, rng=rng())
        xarray.testing.assert_allclose(found, expected, rtol=1e-14)


class TestWindow:
    def test_that_of_the_thesis(self):
        stiffness = scattered(20)
        data = curves(stiffness)
        fits = fit_power_laws(data, rng=rng())
        means = stiffness.mean(axis=1)
        for i, mean in enumerate(means):
            inside = (mean > 20e-3) & (mean < 0.9 * 1.15) & (FORCE <= 0.07)
            assert 3 < inside.sum() < len(FORCE)
            assert fits["count"][i] == inside.sum()
            assert (fits["window_low"][i], fits["window_high"][i]) == (FORCE[inside][0], FORCE[inside][-1])
            slope, _ = np.polyfit(np.log(FORCE[inside]), np.log(mean[inside]), 1)
            assert fits["exponent"][i] == pytest.approx(slope, rel=1e-12)
        given = resolved_window(1e-3, 1.15)
        xarray.testing.assert_allclose(fit_power_laws(data, given, rng=rng()), fits)

    def test_may_hang_on_the_ensemble(self):
        points = xarray.DataArray([1000, 3000, 10_000], dims="hurst", coords={"hurst": HURST})
        stiffness = scattered(20)
        fits = fit_power_laws(curves(stiffness), resolved_window(1 / points, 1.0), rng=rng())
        means = stiffness.mean(axis=1)
        for i, cells in enumerate(points.to_numpy()):
            inside = (means[i] > 20 / cells) & (means[i] < 0.9) & (FORCE <= 0.07)
            assert fits["count"][i] == inside.sum() > 3

    def test_ends_with_full_contact(self):
        stiffness = np.minimum(np.ones((3, 2, 1)) * 2 * FORCE**0.5, 1.0)
        fits = fit_power_laws(curves(stiffness), resolved_window(1e-9, 1.0, highest=1.0), rng=rng())
        assert (fits["window_high"] == FORCE[2 * FORCE**0.5 < 0.9][-1]).all()

    def test_of_forces_holds_its_ends(self):
        window = force_window(FORCE[3], FORCE[9] * (1 - 1e-12))
        fits = fit_power_laws(curves(scattered(5)), window, rng=rng())
        assert (fits["count"] == 7).all()
        assert fits.attrs["window"] == f"force from {FORCE[3]:g} to {FORCE[9]:g}"

    def test_without_points_gives_a_count_and_no_law(self):
        stiffness = scattered(5)
        stiffness[1] *= 1e-4  # one ensemble is not resolved; the others know nothing of it
        fits = fit_power_laws(curves(stiffness), rng=rng())
        assert fits["count"][1] == 0
        assert fits["samples"][1] == 5
        assert np.isnan(fits["exponent"][1])
        assert np.isfinite(fits.isel(hurst=[0, 2]).to_array()).all()

    def test_of_two_points_is_too_few(self):
        fits = fit_power_laws(curves(scattered(5)), force_window(FORCE[3], FORCE[4]), rng=rng())
        assert (fits["count"] == 2).all()
        assert np.isnan(fits["exponent"]).all()

    def test_wants_a_rule_where_curves_have_none(self):
        data = curves(scattered(3))
        with pytest.raises(ValueError, match="without cell_stiffness, full_contact_stiffness: give a window"):
            fit_power_laws(data.drop_vars(["cell_stiffness", "full_contact_stiffness"]), rng=rng())
        with pytest.raises(ValueError, match="for a line contact"):
            fit_power_laws(data.assign_attrs(geometry="line"), rng=rng())
        with pytest.raises(ValueError, match="from a dimensionless force to a larger one"):
            force_window(0.1, 0.1)
        with pytest.raises(ValueError, match="larger one"):
            Window((-1.0, 1.0), (0, 1), "")

    def test_takes_the_scale_from_the_curves_wherever_they_touch(self):
        stiffness = scattered(4)
        stiffness[0, 1, :4] = 0  # no contact yet
        stiffness[1, 2, -1] = np.inf  # full contact of a periodic surface
        window = window_of(curves(stiffness), ("sample",), "load")
        np.testing.assert_allclose(window.stiffness[0], 20e-3, rtol=1e-14)
        np.testing.assert_allclose(window.stiffness[1], 0.9 * 1.15, rtol=1e-14)


class TestMissing:
    def test_one_sample_has_a_law_and_no_error(self):
        fits = fit_power_laws(curves(scattered(1)), EVERYTHING, rng=rng())
        assert np.isfinite(fits["exponent"]).all()
        assert (fits["samples"] == 1).all()
        for name in ("exponent_error", "prefactor_low", "correlation", "exponent_sandwich_error"):
            assert np.isnan(fits[name]).all()

    def test_samples_that_failed_are_as_if_they_had_never_been(self):
        stiffness = scattered(20)
        holed = stiffness.copy()
        holed[1, [3, 11]] = np.nan
        fits = fit_power_laws(curves(holed), EVERYTHING, rng=rng())
        np.testing.assert_array_equal(fits["samples"], [20, 18, 20])
        whole = fit_power_laws(curves(stiffness), EVERYTHING, rng=rng())
        assert fits.isel(hurst=[0, 2]).identical(whole.isel(hurst=[0, 2]))
        few = fit_ensemble(FORCE, np.delete(stiffness[1], [3, 11], axis=0), (1.0, 1.0))
        assert fits["exponent"][1] == few.exponent
        assert fits["prefactor_sandwich_error"][1] == few.prefactor_error
        # Eighteen of twenty, drawn anew: the width of an interval of 1000 draws is known to some 6 %.
        width = fits["exponent_high"] - fits["exponent_low"]
        expected = 2 * stats.t.ppf(0.975, 17) * few.exponent_error
        assert float(width[1]) == pytest.approx(expected, rel=0.2)

    def test_forces_of_samples_that_failed_are_missing_too(self):
        data = curves(scattered(6))
        data["dimensionless_force"] = data["dimensionless_force"] * xarray.ones_like(data["stiffness"])
        expected = fit_power_laws(data.isel(sample=slice(1, None)), EVERYTHING, rng=rng())
        data = data.where(data["stiffness"]["sample"] > 0)
        found = fit_power_laws(data, EVERYTHING, rng=rng())
        np.testing.assert_array_equal(found["exponent"], expected["exponent"])
        np.testing.assert_array_equal(found["exponent_sandwich_error"], expected["exponent_sandwich_error"])

    def test_no_sample_at_all(self):
        stiffness = scattered(4)
        stiffness[2] = np.nan
        fits = fit_power_laws(curves(stiffness), EVERYTHING, rng=rng())
        assert (fits["count"][2], fits["samples"][2]) == (0, 0)
        assert np.isnan(fits["exponent"][2])

    def test_points_that_did_not_converge_have_no_part(self):
        stiffness = scattered(20)
        status = np.full(stiffness.shape, "converged", dtype="<U12")
        status[0, 4, 7] = "stagnated"
        status[1, 5, 2] = ""
        status[2, 0, 0] = "no contact"  # converged, with a stiffness that is known
        spoilt = stiffness.copy()
        spoilt[0, 4, 7] = spoilt[1, 5, 2] = 1e6
        more = {"status": (("hurst", "sample", "load"), status)}
        fits = fit_power_laws(curves(spoilt, **more), EVERYTHING, rng=rng())
        stiffness[0, 4, 7] = stiffness[1, 5, 2] = np.nan
        assert fits.identical(fit_power_laws(curves(stiffness), EVERYTHING, rng=rng()))
        assert (fits["count"] == len(FORCE)).all()

    def test_forces_where_a_tenth_or_more_is_missing_are_left_out(self):
        stiffness = scattered(20)
        stiffness[0, :2, 5] = stiffness[0, :3, 8] = np.nan
        fits = fit_power_laws(curves(stiffness), EVERYTHING, rng=rng())
        np.testing.assert_array_equal(fits["count"], [len(FORCE) - 1, len(FORCE), len(FORCE)])

    def test_stiffness_that_all_samples_share_has_a_law(self):
        data = curves(scattered(1)).isel(sample=0).expand_dims(number=3)
        data = data.assign(dimensionless_stiffness=data["dimensionless_stiffness"].isel(number=0)).rename(
            number="sample"
        )
        fits = fit_power_laws(data, EVERYTHING, rng=rng())
        assert (fits["samples"] == 3).all()
        np.testing.assert_allclose(fits["exponent_error"], 0, atol=1e-13)


class TestRefused:
    def test_forces_of_their_own(self):
        data = curves(scattered(3))
        own = data["dimensionless_force"] * xarray.DataArray([1.0, 1.01, 1.02], dims="sample")
        with pytest.raises(ValueError, match="on_common first"):
            fit_power_laws(data.assign(dimensionless_force=own), EVERYTHING, rng=rng())
        rounded = data["dimensionless_force"] * xarray.DataArray([1.0, 1 + 1e-13, 1 - 1e-13], dims="sample")
        fit_power_laws(data.assign(dimensionless_force=rounded), EVERYTHING, rng=rng())

    def test_what_is_no_loading_curve(self):
        data = curves(scattered(3))
        with pytest.raises(ValueError, match="dimensionless_stiffness is missing"):
            fit_power_laws(data.drop_vars("dimensionless_stiffness"), EVERYTHING, rng=rng())
        with pytest.raises(ValueError, match="does not lie along 'load'"):
            fit_power_laws(data.rename(load="step"), EVERYTHING, rng=rng())
        with pytest.raises(ValueError, match="no samples along 'line'"):
            fit_power_laws(data, EVERYTHING, rng=rng(), samples="line")

    def test_levels_and_means_that_are_none(self):
        with pytest.raises(ValueError, match="level of an interval lies between 0 and 1"):
            fit_power_laws(curves(scattered(3)), EVERYTHING, rng=rng(), level=95)
        with pytest.raises(ValueError, match="'arithmetic' or 'geometric'"):
            fit_power_laws(curves(scattered(3)), EVERYTHING, rng=rng(), mean="median")


class TestCoverage:
    """Of 400 ensembles of a known law, as many intervals must hold it as a binomial number allows."""

    TRIALS = 400
    TRUTH = np.full(TRIALS, 0.7)

    @pytest.mark.parametrize(("samples", "level", "mean"), [(50, 0.95, "arithmetic"), (8, 0.8, "geometric")])
    def test_intervals_hold_the_truth(self, samples, level, mean):
        stiffness = scattered(samples, seed=samples, hurst=self.TRUTH)
        data = curves(stiffness, hurst=self.TRUTH)
        window = force_window(FORCE[4], FORCE[16])
        fits = fit_power_laws(data, window, rng=rng(), mean=mean, level=level, replicates=400)
        x = np.log(FORCE)
        # The logarithm of a geometric mean lies below that of the mean by half the variance.
        below = (0.3**2 + (0.05 * (x - x.mean())) ** 2 + 0.1**2) / 2 if mean == "geometric" else 0 * x
        truth = np.polyfit(x[4:17], (np.log(0.9) + x / 1.7 - below)[4:17], 1)
        for name, value in zip(("exponent", "prefactor"), (truth[0], np.exp(truth[1])), strict=True):
            held = ((fits[f"{name}_low"] <= value) & (fits[f"{name}_high"] >= value)).sum()
            low, high = stats.binom.interval(0.999, self.TRIALS, level)
            assert low <= held <= high, (name, int(held))


class TestLawAt:
    def test_is_the_law_with_the_error_of_both_numbers(self):
        fits = fit_power_laws(curves(scattered(30)), EVERYTHING, rng=rng(), replicates=4000)
        found = law_at(fits, [1e-3, 0.07])
        assert found["stiffness"].dims == ("hurst", "dimensionless_force")
        for i, force in enumerate((1e-3, 0.07)):
            law = fits["prefactor"] * force ** fits["exponent"]
            np.testing.assert_allclose(found["stiffness"][:, i], law, rtol=1e-14)
            single = fit_ensemble(FORCE, scattered(30)[0], (1.0, 1.0)).stiffness_error(force)
            # Both errors are known to 1/sqrt(2 B), and stand for one of n = 30 and of n - 1.
            assert float(found["stiffness_error"][0, i]) == pytest.approx(float(single), rel=0.08)

    def test_at_one_force_has_no_dimension_more(self):
        fits = fit_power_laws(curves(scattered(4)), EVERYTHING, rng=rng())
        assert law_at(fits, 0.01)["stiffness"].dims == ("hurst",)
