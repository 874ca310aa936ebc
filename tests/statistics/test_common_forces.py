"""Records on common forces: exact for power laws, never beyond their ends."""

import numpy as np
import pytest
import xarray

from roughcontact.statistics.common_forces import on_common

RNG = np.random.default_rng(4)
FORCE = np.sort(RNG.uniform(1, 10, (2, 3, 20)), axis=-1)
EXPONENT = np.array([0.3, 0.7])
WANTED = np.geomspace(0.5, 9, 12)


def records(force=FORCE, **more):
    stiffness = 2 * force ** EXPONENT[:, np.newaxis, np.newaxis]
    dims = ("hurst", "sample", "load")
    data = {
        "dimensionless_force": (dims, force, {"units": "1"}),
        "stiffness": (dims, stiffness, {"units": "N m-1"}),
        "area": (("hurst",), [1.0, 2.0]),
    }
    return xarray.Dataset(data | more, {"hurst": [0.2, 0.8], "load": np.arange(20)})


def test_a_power_law_stays_one_and_ends_where_its_record_ends():
    found = on_common(records(), WANTED)
    assert found["stiffness"].dims == ("hurst", "sample", "dimensionless_force")
    np.testing.assert_array_equal(found["dimensionless_force"], WANTED)
    law = 2 * WANTED ** EXPONENT[:, np.newaxis, np.newaxis]
    within = (FORCE.min(axis=-1)[..., np.newaxis] <= WANTED) & (FORCE.max(axis=-1)[..., np.newaxis] >= WANTED)
    assert 0 < within.sum() < within.size
    # A logarithm, a straight line and an exponential, each rounded.
    np.testing.assert_allclose(found["stiffness"], np.where(within, law, np.nan), rtol=1e-14)
    assert found["stiffness"].attrs == {"units": "N m-1"}
    assert "load" not in found.sizes


def test_what_does_not_lie_along_the_points_stays():
    data = records()
    assert on_common(data, WANTED)["area"].identical(data["area"])


def test_the_order_of_the_points_does_not_matter():
    order = RNG.permutation(20)
    expected = on_common(records(), WANTED)
    assert on_common(records().isel(load=order), WANTED).identical(expected)


def test_points_are_themselves_to_the_last_bit_and_so_are_ends_that_differ_by_rounding():
    data = records().isel(hurst=0, sample=0)
    force = data["dimensionless_force"].to_numpy()
    found = on_common(data, force)
    np.testing.assert_array_equal(found["stiffness"], data["stiffness"])
    found = on_common(data, [force[0] * (1 - 1e-12), force[-1] * (1 + 1e-12)])
    np.testing.assert_array_equal(found["stiffness"], data["stiffness"][[0, -1]])
    assert np.isnan(on_common(data, [force[0] * (1 - 1e-6)])["stiffness"]).all()


def test_records_of_different_length_and_none():
    force = FORCE.copy()
    force[0, 1, 8:] = force[1, 2] = np.nan
    found = on_common(records(force), WANTED)["stiffness"]
    inside = (FORCE[0, 1, 0] <= WANTED) & (FORCE[0, 1, 7] >= WANTED)
    np.testing.assert_array_equal(np.isfinite(found[0, 1]), inside)
    assert np.isnan(found[1, 2]).all()


def test_a_missing_point_is_not_bridged_and_zeros_have_no_logarithm():
    data = records().isel(hurst=0, sample=0)
    force = data["dimensionless_force"].to_numpy()
    middles = np.sqrt(force[1:] * force[:-1])
    data["stiffness"][5], data["stiffness"][10] = np.nan, 0
    found = on_common(data, middles)["stiffness"]
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(found)), [4, 5, 9, 10])
    assert on_common(data, [force[10]])["stiffness"] == 0
    data["stiffness"][:] = 0
    assert (on_common(data, middles)["stiffness"] == 0).all()


def test_truths_hold_where_both_neighbours_hold_and_words_where_both_say_them():
    force = np.array([1.0, 2.0, 3.0, 4.0])
    data = xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "resolved": ("load", [False, True, True, True]),
            "status": ("load", ["converged", "converged", "stagnated", "converged"]),
            "spots": ("load", [1, 1, 4, 9]),
        }
    )
    found = on_common(data, [0.5, 1.5, 2.0, 2.5, 3.0, 3.5])
    assert found["resolved"].dtype == bool
    np.testing.assert_array_equal(found["resolved"], [False, False, True, True, True, True])
    np.testing.assert_array_equal(found["status"], ["", "converged", "converged", "", "stagnated", ""])
    share = np.log(2.5 / 2) / np.log(3 / 2)
    np.testing.assert_allclose(found["spots"][:4], [np.nan, 1, 1, 4**share], rtol=1e-14)


def test_a_load_is_resolved_by_its_interpolated_stiffness():
    """From twenty cells on, between an unresolved load and a resolved one; widths of lines show no such limit."""
    force = np.array([1.0, 4.0, 16.0])
    data = xarray.Dataset(
        {
            "dimensionless_force": ("load", force),
            "stiffness": ("load", force),
            "cell_stiffness": ((), 0.1),  # 2 is that of twenty
            "full_contact_stiffness": ((), 10.0),  # 9 is nine tenths
            "resolved": ("load", [False, True, False], {"long_name": "resolved"}),
        }
    )
    found = on_common(data, [0.5, 1.9, 2.1, 4.0, 8.9, 9.1])["resolved"]
    np.testing.assert_array_equal(found, [False, False, True, True, True, False])
    assert found.attrs == {"long_name": "resolved"}
    missed = data.assign(status=("load", ["converged", "converged", "stagnated"]))
    np.testing.assert_array_equal(on_common(missed, [2.1, 8.9])["resolved"], [True, False])
    flows = data.assign(unloading_stiffness=("load", 2 * force))
    np.testing.assert_array_equal(
        on_common(flows, [0.9, 1.1, 4.4, 4.6])["resolved"], [False, True, True, False]
    )
    line = on_common(data.assign_attrs(geometry="line"), [2.1, 4.0])["resolved"]
    np.testing.assert_array_equal(line, [False, True])


def test_common_places_serve_variables_of_more_dimensions():
    data = records().drop_vars("dimensionless_force").assign(dimensionless_force=("load", FORCE[0, 0]))
    found = on_common(data, WANTED)
    assert found["stiffness"].dims == ("hurst", "sample", "dimensionless_force")
    single = data.isel(hurst=1, sample=2)
    xarray.testing.assert_equal(found["stiffness"][1, 2], on_common(single, WANTED)["stiffness"])


@pytest.mark.parametrize("values", [[0.0, 1.0], [-1.0], [np.nan], [[1.0]], 1.0])
def test_places_are_numbers_above_zero(values):
    with pytest.raises(ValueError, match="finite numbers above zero"):
        on_common(records(), values)


def test_wants_a_variable_that_says_where_points_stand():
    with pytest.raises(ValueError, match="no variable 'area' lies along 'load'"):
        on_common(records(), WANTED, at="area")
