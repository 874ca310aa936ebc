"""A study on the average: what is in it, what has no part in it, and where there are no laws."""

import numpy as np
import pytest
import xarray

from roughcontact import statistics
from roughcontact.solver.control import Status
from roughcontact.statistics.averages import averages, combinations, sample_dimensions
from roughcontact.statistics.fit_window import force_window

FORCE = np.geomspace(1e-4, 0.3, 24)
HURST, POINTS = np.array([0.2, 0.6, 1.0]), np.array([64, 128])
EVERYTHING = force_window(1e-9, 1.0)


def rng():
    return np.random.default_rng(5)


def exported(samples=4):
    """Return an export of exact power laws, each curve by a factor of its own; the mean of the factors is 1."""
    factor = np.linspace(0.7, 1.3, samples)[:, np.newaxis]
    alpha = 1 / (1 + HURST)[:, np.newaxis, np.newaxis, np.newaxis]
    stiffness = 0.9 * FORCE**alpha * factor * np.ones((1, len(POINTS), 1, 1))
    dims = ("hurst", "points", "sample", "load")
    return xarray.Dataset(
        {
            "dimensionless_force": ("load", FORCE),
            "dimensionless_stiffness": (dims, stiffness, {"units": "1"}),
            "rms_slope": (dims[:3], stiffness[..., 0], {"units": "1"}),
            "status": (dims, np.full(stiffness.shape, Status.CONVERGED.value)),
            "case_status": (dims[:3], np.full(stiffness.shape[:3], "done")),
        },
        {"hurst": HURST, "points": POINTS, "sample": np.arange(samples)},
    )


def test_laws_and_means_stand_side_by_side():
    dataset = exported()
    found = averages(dataset, EVERYTHING, rng=rng())
    np.testing.assert_allclose(found["exponent"], (1 / (1 + HURST))[:, np.newaxis] * [1, 1], rtol=1e-12)
    np.testing.assert_allclose(found["prefactor"], 0.9, rtol=1e-12)
    assert found.attrs["window"] == EVERYTHING.rule
    assert (found["law_count"] == len(FORCE)).all()
    assert (found["law_samples"] == 4).all()
    for word in ("mean", "standard_deviation", "standard_error", "count"):
        statistic = getattr(statistics, word)
        for name in ("dimensionless_stiffness", "rms_slope"):
            np.testing.assert_array_equal(found[f"{name}_{word}"], statistic(dataset[name]))
    np.testing.assert_array_equal(found["dimensionless_force"], FORCE)
    assert "sample" not in found.sizes
    np.testing.assert_array_equal(found["cases"], 4)


def test_loads_that_missed_their_tolerance_have_no_part():
    dataset = exported()
    dataset["status"][0, 0, 3, 5:] = Status.STAGNATED.value
    found = averages(dataset, EVERYTHING, rng=rng())
    counted = found["dimensionless_stiffness_count"][0, 0]
    np.testing.assert_array_equal(counted, np.where(np.arange(len(FORCE)) < 5, 4, 3))
    mean = dataset["dimensionless_stiffness"][0, 0, :3, 5:].mean("sample")
    np.testing.assert_allclose(found["dimensionless_stiffness_mean"][0, 0, 5:], mean, rtol=1e-14)
    np.testing.assert_array_equal(found["rms_slope_count"], 4)  # no load, no status


@pytest.mark.parametrize("own", [True, False])
def test_it_counts_the_samples_and_the_forces_that_are_resolved(own):
    """All samples resolve the last 12 forces; where each has its own, the first sample resolves one force less."""
    dataset = exported()
    resolved = np.arange(len(FORCE)) >= 12
    if own:
        dataset["resolved"] = dataset["dimensionless_stiffness"].dims, np.tile(resolved, (3, 2, 4, 1))
        dataset["resolved"][:, :, 0, 12] = False
        dataset["resolved"][:, :, 1, -1] = True
        dataset["status"][:, :, 1, -1] = Status.STAGNATED.value
    else:
        dataset["resolved"] = "load", resolved
    dataset["case_status"][1, 0, 2] = "failed"
    found = averages(dataset, force_window(FORCE[8] * 0.999, 1.0), rng=rng())
    counts = found["resolved_samples"].transpose("hurst", "points", "load")
    expected = 4 * resolved
    if own:
        expected[[12, -1]] = 3
    np.testing.assert_array_equal(counts[0, 0], expected)
    np.testing.assert_array_equal(counts[1, 0], np.where(resolved, expected - 1, 0))
    assert not [name for name in found if str(name).startswith("resolved_") and name != "resolved_samples"]
    assert (
        found["law_count"] == len(FORCE) - 8 - own
    ).all()  # the last lacks more than a tenth of the samples
    assert (found["law_resolved"] == 12 - own).all()


def test_cases_that_failed_are_not_counted():
    dataset = exported()
    dataset["case_status"][1, 0, 2] = "failed"
    assert averages(dataset, EVERYTHING, rng=rng())["cases"].to_numpy().tolist() == [[4, 4], [3, 4], [4, 4]]


def test_many_lines_of_a_sample_are_samples():
    dataset = exported().rename(points="line").drop_vars(("rms_slope", "status", "line"))
    dataset["case_status"] = dataset["case_status"][:, 0]
    assert sample_dimensions(dataset) == ("sample", "line")
    found = averages(dataset, EVERYTHING, rng=rng())
    assert found["dimensionless_stiffness_mean"].dims == ("hurst", "load")
    assert (found["dimensionless_stiffness_count"] == 8).all()
    assert (found["law_samples"] == 8).all()
    assert found["cases"].to_numpy().tolist() == [4, 4, 4]
    assert averages(dataset, EVERYTHING, rng=rng(), samples="sample")["exponent"].dims == ("hurst", "line")


def test_without_a_window_it_says_why_there_are_no_laws():
    found = averages(exported(), rng=rng())
    assert "exponent" not in found
    assert found.attrs["no_power_law"].startswith("the resolved loads are unknown without")
    assert "dimensionless_stiffness_mean" in found


def test_combinations_come_in_their_order_with_their_parameters():
    found = list(combinations(averages(exported(), EVERYTHING, rng=rng())))
    assert [parameters for parameters, _ in found] == [
        {"hurst": hurst, "points": points} for hurst in HURST for points in POINTS
    ]
    assert [point["exponent"].item() for _, point in found] == pytest.approx(
        np.repeat(1 / (1 + HURST), 2), rel=1e-12
    )


def test_combinations_of_rows_have_the_parameters_of_their_row():
    dataset = exported().isel(points=0, drop=True).rename(hurst="row")
    dataset = dataset.assign_coords(row=np.arange(3), hurst=("row", HURST), label=("row", ["a", "b", "c"]))
    found = [parameters for parameters, _ in combinations(averages(dataset, EVERYTHING, rng=rng()))]
    assert found == [{"hurst": h, "label": word} for h, word in zip(HURST, "abc", strict=True)]


def test_what_has_no_samples_is_refused():
    with pytest.raises(
        ValueError, match=r"no samples lie along sample or line: pass the dataset of study\.export"
    ):
        averages(exported().isel(sample=0, drop=True), rng=rng())
    with pytest.raises(ValueError, match="no samples lie along draw"):
        averages(exported(), rng=rng(), samples="draw")
