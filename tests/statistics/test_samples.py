"""Statistics over samples by their definitions, and what is missing."""

import numpy as np
import pytest
import xarray

from roughcontact import statistics

RNG = np.random.default_rng(3)
VALUES = RNG.lognormal(size=(3, 5, 7))


def labelled(values=VALUES, name="stiffness"):
    return xarray.DataArray(
        values,
        dims=("hurst", "sample", "load"),
        coords={"hurst": [0.2, 0.5, 0.8], "sample": np.arange(values.shape[1])},
        attrs={"units": "N m-1", "long_name": "normal stiffness"},
        name=name,
    )


DEFINED = {
    "mean": lambda v: np.nanmean(v, axis=1),
    "geometric_mean": lambda v: np.exp(np.nanmean(np.log(v), axis=1)),
    "standard_deviation": lambda v: np.nanstd(v, axis=1, ddof=1),
    "standard_error": lambda v: np.nanstd(v, axis=1, ddof=1) / np.sqrt((~np.isnan(v)).sum(axis=1)),
    "scatter": lambda v: np.nanstd(v, axis=1, ddof=1) / np.nanmean(v, axis=1),
    "count": lambda v: (~np.isnan(v)).sum(axis=1),
}


@pytest.mark.parametrize("word", DEFINED)
class TestEach:
    def test_is_its_definition(self, word):
        found = getattr(statistics, word)(labelled())
        assert found.dims == ("hurst", "load")
        np.testing.assert_allclose(found, DEFINED[word](VALUES), rtol=1e-13)
        np.testing.assert_array_equal(found["hurst"], [0.2, 0.5, 0.8])
        assert found.attrs["units"] == ("1" if word in ("scatter", "count") else "N m-1")
        assert "normal stiffness" in found.attrs["long_name"]

    def test_leaves_out_what_is_missing(self, word):
        values = VALUES.copy()
        values[1, 3] = values[0, :3, 2] = np.nan
        np.testing.assert_allclose(
            getattr(statistics, word)(labelled(values)), DEFINED[word](values), rtol=1e-13
        )

    def test_knows_several_dimensions_of_samples(self, word):
        found = getattr(statistics, word)(labelled(), ("sample", "load"))
        flat = VALUES.reshape(3, 35, 1)
        np.testing.assert_allclose(found, DEFINED[word](flat)[:, 0], rtol=1e-13)

    def test_wants_samples(self, word):
        with pytest.raises(
            ValueError, match="no samples of stiffness lie along 'line'; it has hurst, sample, load"
        ):
            getattr(statistics, word)(labelled(), "line")


def test_of_nothing_there_is_nothing():
    values = labelled(np.full((3, 4, 2), np.nan))
    for word in DEFINED:
        found = getattr(statistics, word)(values)
        assert (found == 0).all() if word == "count" else np.isnan(found).all()


def test_one_sample_scatters_not():
    one = labelled(VALUES[:, :1])
    np.testing.assert_allclose(statistics.mean(one), VALUES[:, 0], rtol=1e-15)
    for word in ("standard_deviation", "standard_error", "scatter"):
        assert np.isnan(getattr(statistics, word)(one)).all()


def test_before_contact_nothing_scatters():
    assert (statistics.scatter(labelled(np.zeros((3, 4, 2)))) == 0).all()


def test_infinite_stiffness_has_an_infinite_mean_and_no_scatter():
    values = VALUES.copy()
    values[0, 0, 0] = np.inf
    assert statistics.mean(labelled(values))[0, 0] == np.inf
    assert np.isnan(statistics.scatter(labelled(values))[0, 0])


class TestSummary:
    DATASET = xarray.Dataset(
        {
            "stiffness": labelled(),
            "resolved": labelled(VALUES > 1).drop_attrs(),
            "force": ("load", np.arange(7.0)),
            "status": (("hurst", "sample"), np.full((3, 5), "converged")),
        }
    )

    def test_names_what_it_found(self):
        found = statistics.summary(self.DATASET, ["stiffness", "force"])
        assert set(found.data_vars) == {f"stiffness_{word}" for word in DEFINED} | {"force"}
        for word in DEFINED:
            expected = getattr(statistics, word)(self.DATASET["stiffness"]).rename(f"stiffness_{word}")
            xarray.testing.assert_identical(found[f"stiffness_{word}"], expected)
        assert found["force"].identical(self.DATASET["force"])
        assert "sample" not in found.variables

    def test_takes_all_numbers_along_the_samples(self):
        found = statistics.summary(self.DATASET)
        assert {name.split("_")[0] for name in found.data_vars} == {"stiffness", "resolved"}
        np.testing.assert_allclose(found["resolved_mean"], (VALUES > 1).mean(axis=1), rtol=1e-15)

    def test_a_truth_of_a_case_that_is_missing_says_nothing(self):
        status = xarray.DataArray(np.full((3, 5), "done"), dims=("hurst", "sample"))
        status[0, 0] = "failed"
        found = statistics.summary(self.DATASET.assign(case_status=status), ["resolved"])
        np.testing.assert_allclose(found["resolved_mean"][0], (VALUES > 1)[0, 1:].mean(axis=0), rtol=1e-15)
        assert (found["resolved_count"][0] == 4).all()

    def test_refuses_what_is_not_there(self):
        with pytest.raises(
            ValueError, match="no numbers named 'status'; there are stiffness, resolved, force"
        ):
            statistics.summary(self.DATASET, ["status"])
        with pytest.raises(ValueError, match="no samples lie along 'line'"):
            statistics.summary(self.DATASET, ["stiffness"], "line")
