"""The studies of rough surfaces behind the figures, and what they say on the average."""

import numpy as np
import pytest

from roughcontact.statistics.common_forces import on_common
from roughcontact.statistics.fit_window import force_window
from roughcontact.study.study import Study
from roughcontact_thesis.ensembles import (
    coarse_square_study,
    curve_averages,
    curve_fits,
    full_contact_study,
    laws,
    resolution_studies,
    sphere_study,
    square_study,
)
from thesis.computed import exported
from thesis.synthetic import curves, lines

HURST = np.array([0.5, 1.0, 2.0])


def test_the_studies_have_the_counts_of_the_thesis():
    squares = square_study("thesis")
    assert squares.table["hurst"].values(float) == tuple(np.round(np.arange(24) * 0.15 - 0.5, 12))
    assert (squares.samples, squares.parameters["points"], squares.parameters["loads"]) == (50, 513, 100)
    assert {each.highest_force for each in squares.combinations()} == {0.07}
    sphere = sphere_study("thesis")
    [one] = sphere.combinations()
    assert (sphere.samples, one.points, one.radius, one.hurst, one.rms) == (50, 513, 0.5, 0.7, 9e-3)
    assert [each.samples for each in resolution_studies("thesis")][:2] == [500, 500]
    assert {each.points for each in full_contact_study("thesis").combinations()} == {1025}
    assert {each.points for each in coarse_square_study("thesis").combinations()} == {257}


@pytest.mark.parametrize("scale", ["small", "thesis"])
def test_every_store_has_one_study(scale):
    found = [
        square_study(scale),
        coarse_square_study(scale),
        full_contact_study(scale),
        *resolution_studies(scale),
        sphere_study(scale),
    ]
    assert len({each.name for each in found}) == len(found)


def test_small_studies_are_other_stores_than_the_large_ones():
    for study in (square_study, coarse_square_study, full_contact_study, sphere_study):
        assert study("small").name != study("thesis").name


def test_averages_of_a_law_are_the_law_and_its_scatter():
    found = curve_averages(curves(1 / (HURST + 1), 1.7 / (HURST + 1), HURST, scatter=0.2))
    law = 1.7 / (HURST[:, None] + 1) * found["force"].to_numpy() ** (1 / (HURST[:, None] + 1))
    np.testing.assert_allclose(found["stiffness"], law, rtol=1e-12)
    # Ten samples at 1 +- 0.2: their standard deviation with n - 1.
    np.testing.assert_allclose(found["scatter"], 0.2 * np.sqrt(10 / 9), rtol=1e-12)
    np.testing.assert_allclose(found["stiffness_error"], law * 0.2 / 3, rtol=1e-12)
    np.testing.assert_allclose(found["cell_stiffness"], 0.8911 / 513, rtol=1e-12)
    np.testing.assert_array_equal(found["resolved"], law > 20 * 0.8911 / 513)


def test_a_load_that_missed_its_tolerance_has_no_part_in_the_averages():
    one = curves(0.5, 1.0, HURST)
    one["status"] = one["status"].astype("<U12")
    one["status"][0, :4, 7] = "step limit"
    found = curve_averages(one)
    assert found["samples"][0, 7] == 6
    assert found["samples"].sum() == found["samples"].size * 10 - 4
    one["status"][0, :, 7] = "stagnated"
    assert np.isnan(curve_averages(one)["stiffness"][0, 7])


def test_fits_find_the_law_in_the_window_of_the_thesis_or_another():
    one = curves(1 / (HURST + 1), 1.7 / (HURST + 1), HURST)
    for window in (None, force_window(0.01, 0.07)):
        found = curve_fits(one, window=window)
        np.testing.assert_allclose(found["exponent"], 1 / (HURST + 1), rtol=1e-10)
        np.testing.assert_allclose(found["prefactor"], 1.7 / (HURST + 1), rtol=1e-10)


def test_between_loads_a_law_is_met_exactly():
    at = on_common(curve_averages(curves(0.5, 1.0, HURST)), (3e-4, 0.011, 0.2), at="force")
    np.testing.assert_allclose(at["stiffness"][:, :2], [[3e-4**0.5, 0.011**0.5]] * 3, rtol=1e-12)
    assert np.isnan(at["stiffness"][:, 2]).all()
    assert at["resolved"].to_numpy().tolist() == [[False, True, False]] * 3


def test_laws_of_surfaces_and_lines_lie_side_by_side():
    more = np.array([-0.5, 0.5, 1.0, 2.0])
    found = laws(curves(1 / (HURST + 1), 1.0, HURST), lines(0.6, 0.9, more))
    assert found["hurst"].to_numpy().tolist() == more.tolist()
    assert np.isnan(found["exponent"][0])
    np.testing.assert_allclose(found["exponent"][1:], 1 / (HURST + 1), rtol=1e-10)
    np.testing.assert_allclose(found["line_exponent"], 0.6, rtol=1e-10)
    np.testing.assert_allclose(found["line_prefactor"], 0.9, rtol=1e-10)
    assert found.attrs == {"cells": 513, "surfaces": 10, "lines": 40}


def test_averages_are_those_of_computed_curves():
    parameters = sphere_study("small").parameters | {"points": 33, "loads": 4}
    data = exported(Study(name="few", case="curve", samples=3, parameters=parameters))
    found = curve_averages(data)
    # The side and the modulus are 1.
    np.testing.assert_allclose(found["stiffness"], data["stiffness"].mean("sample"), rtol=1e-12)
    assert float(found["cell_stiffness"]) == pytest.approx(0.891107 / 33, rel=1e-5)  # of one square cell
