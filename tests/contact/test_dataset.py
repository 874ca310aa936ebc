"""Answers as labelled data and as plain records."""

from __future__ import annotations

import json
import re
from types import SimpleNamespace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.curve import CURVE_POINTS
from roughcontact.contact.dataset import curve_dataset, curve_record, solution_dataset, solution_record
from roughcontact.labels import labelled
from roughcontact.labels.column import columns, names_of, shown_in
from roughcontact.labels.contact_columns import CERTIFICATES, POINTS
from roughcontact.labels.labelled import record_of, variables_of
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.facts import column_facts

MODULUS = 1e11
GRID = rc.Grid((24, 32), (2e-7, 1e-7))


@pytest.fixture(scope="module")
def surface() -> rc.Surface:
    made = rc.self_affine(GRID, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    heights = made.heights.copy()
    heights[5, 6:9] = np.nan
    return rc.Surface(heights, GRID, made.provenance)


@pytest.fixture(scope="module")
def solution(surface: rc.Surface) -> rc.Solution:
    return rc.press(surface, MODULUS, force=1e-3)


@pytest.fixture(scope="module")
def curve(surface: rc.Surface) -> rc.Curve:
    return rc.loading_curve(surface, MODULUS, forces=[1e-4, 1e-3, 1e-2])


@pytest.fixture(scope="module")
def full() -> rc.Solution:
    """Return a periodic surface in full contact: infinitely stiff."""
    grid = rc.Grid((8, 8), (1e-7, 1e-7), periodic=True)
    wavy = rc.self_affine(grid, hurst=0.8, rms=1e-12, rng=np.random.default_rng(1))
    return rc.press(wavy, MODULUS, pressure=1e9)


def test_every_variable_says_what_the_table_says(solution, curve):
    for dataset in (solution_dataset(solution), curve_dataset(curve)):
        for name in set(dataset.variables) - {"spot", "axis"}:
            attributes, known = dataset[name].attrs, VARIABLES[name]
            assert attributes["long_name"] == known.long_name, name
            assert attributes.get("units", "") == known.unit, name


def test_units_are_understood_by_a_unit_library():
    import pint

    registry = pint.UnitRegistry()
    for name, known in VARIABLES.items():
        # UDUNITS writes powers as bare numbers behind the unit.
        text = re.sub(r"([A-Za-z]+)(-?\d+)", r"\1**\2", known.unit).replace(" ", " * ")
        if text:
            assert registry.Quantity(1.0, text).to_base_units().magnitude == 1.0, name


def test_solution_dataset_holds_the_solution(solution):
    dataset = solution_dataset(solution)
    assert dataset.pressure.dims == ("y", "x")
    for name in ("pressure", "displacement", "gap", "contact"):
        np.testing.assert_array_equal(dataset[name], getattr(solution, name))
    for name in (
        "force",
        "depth",
        "stiffness",
        "interfacial_stiffness",
        "contact_area",
        "mean_gap",
        "missing",
    ):
        assert dataset[name].dims == ()
        assert dataset[name] == getattr(solution, name), name
    np.testing.assert_array_equal(dataset.heights, solution.problem.surface.heights)
    assert dataset.max_pressure == solution.pressure.max()
    assert dataset.status == "converged"
    assert dataset.missing == 3
    assert int(np.isnan(dataset.gap).sum()) == 3
    assert dataset.contact.dtype == bool


def test_coordinates_are_the_centres_of_cells(solution):
    dataset = solution_dataset(solution)
    np.testing.assert_array_equal(dataset.x[:2], [0.5e-7, 1.5e-7])
    np.testing.assert_array_equal(dataset.y[:2], [1e-7, 3e-7])
    # x runs along a row: 32 of them, 24 rows.
    assert dataset.sizes["x"] == 32
    assert dataset.sizes["y"] == 24
    assert list(dataset.lengths.sel(axis=["x", "y"])) == [32 * 1e-7, 24 * 2e-7]


def test_spots_can_be_found_by_their_number(solution):
    dataset = solution_dataset(solution)
    assert dataset.spots == solution.spots.count > 1
    for number in dataset.spot:
        inside = dataset.spot_label == number
        assert dataset.spot_area.sel(spot=number) == pytest.approx(int(inside.sum()) * 2e-14, rel=1e-14)
        load = float(dataset.pressure.where(inside, 0.0).sum()) * 2e-14
        assert dataset.spot_load.sel(spot=number) == pytest.approx(load, rel=1e-13)


def test_curve_dataset_holds_the_curve(curve):
    dataset = curve_dataset(curve)
    for name in ("force", "depth", "stiffness", "contact_area", "spots", "resolved", "dimensionless_force"):
        assert dataset[name].dims == ("load",)
        np.testing.assert_array_equal(dataset[name], getattr(curve, name))
    np.testing.assert_array_equal(dataset.secant_stiffness, curve.secant_stiffness)
    assert dataset.sizes == {"load": 3, "interval": 2, "axis": 2}
    assert dataset.resolved.dtype == bool
    assert list(dataset.status.to_numpy()) == ["converged"] * 3
    assert dataset.modulus == MODULUS
    assert dataset.full_contact_stiffness == curve.full_contact_stiffness


def test_the_classes_hand_out_the_same(solution, curve):
    assert solution.to_dataset().identical(solution_dataset(solution))
    assert curve.to_dataset().identical(curve_dataset(curve))
    assert solution.to_record() == solution_record(solution)
    assert curve.to_record() == curve_record(curve)


@pytest.mark.parametrize("which", ["solution", "curve", "full"])
def test_records_are_strict_json_and_lose_nothing(which, request):
    answer = request.getfixturevalue(which)
    record = answer.to_record()
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    numbers = {name for name, value in record.items() if isinstance(value, int | float) and value is not True}
    assert {name for name in numbers if not isinstance(record[name], bool)} <= record["units"].keys()
    assert record["units"]["stiffness"] == "N m-1"


def test_a_record_holds_the_numbers_of_the_answer(solution, curve):
    record = solution_record(solution)
    assert record["force"] == solution.force
    assert record["spots"] == solution.spots.count
    assert record["periodic"] == [False, False]
    assert record["status"] == "converged"
    assert curve_record(curve)["stiffness"] == curve.stiffness.tolist()
    assert curve_record(curve)["resolved"] == curve.resolved.tolist()


def test_infinity_stays_in_the_dataset_and_is_none_in_the_record(full):
    assert full.stiffness == np.inf
    assert solution_dataset(full).stiffness == np.inf
    assert solution_record(full)["stiffness"] is None


def test_bodies_that_do_not_touch(surface):
    apart = rc.press(surface, MODULUS, depth=0.0)
    dataset = solution_dataset(apart)
    assert dataset.sizes["spot"] == 0
    assert dataset.status == "no contact"
    assert not dataset.contact.any()
    assert solution_record(apart)["max_pressure"] == 0.0


@pytest.mark.parametrize(
    ("body", "units"),
    [
        (lambda grid: rc.line(grid, MODULUS), {"force": "N m-1", "stiffness": "N m-2", "contact_area": "m"}),
        (
            lambda grid: rc.foundation(grid, MODULUS),
            {"force": "N", "stiffness": "N m-1", "contact_area": "m"},
        ),
    ],
    ids=["line", "foundation"],
)
def test_a_line_has_units_of_its_own(body, units):
    grid = rc.Grid(64, 1e-7)
    line = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    operator = body(grid)
    curve = rc.loading_curve(line, MODULUS, forces=[1.0, 2.0], operator=operator)
    solution = rc.press(line, MODULUS, force=1.0, operator=operator)
    for dataset in (curve_dataset(curve), solution_dataset(solution)):
        assert {name: dataset[name].attrs["units"] for name in units} == units
        assert dataset.attrs["geometry"] == operator.capabilities.geometry.value
        assert list(dataset.axis.values) == ["x"]
    assert solution_dataset(solution).pressure.dims == ("x",)
    for record in (curve_record(curve), solution_record(solution)):
        assert {name: record["units"][name] for name in units} == units
        json.dumps(record, allow_nan=False)


def test_rings_lie_along_the_radius():
    rings = rc.RadialGrid.uniform(16, 1e-5)
    dataset = rc.press(rc.RadialProfile(-(rings.radii**2), rings), MODULUS, force=1.0).to_dataset()
    assert dataset.pressure.dims == ("r",)
    np.testing.assert_array_equal(dataset.r, rings.radii)
    assert dataset.contact_area.attrs["units"] == "m2"


def test_a_column_of_the_table_is_in_every_form(solution, curve, monkeypatch):
    """In the dataset, its CSV, the record, the lines on a screen and the page, by one line of the table."""
    [line] = columns("volume | m3 | volume below the surface | patch page facts | volume V")
    table = {("load",): (line,)}
    curve = SimpleNamespace(volume=np.array([1e-18, 2e-18]))
    [(name, (along, values, words))] = variables_of(curve, table, rc.Geometry.SURFACE).items()
    assert (name, along, words) == ("volume", ("load",), {"long_name": line.long_name, "units": "m3"})
    np.testing.assert_array_equal(values, curve.volume)
    monkeypatch.setattr(labelled, "VARIABLES", {"volume": line})
    record = record_of({"volume": (along, values, words)}, rc.Geometry.LINE)
    assert record == {"volume": [1e-18, 2e-18], "geometry": "line", "units": {"volume": "m2"}}
    assert [names_of(shown_in(place, (line,))) for place in ("page", "joint")] == [("volume",), ()]
    state = SimpleNamespace(volume=2e-18, depth=0.0)
    assert column_facts(state, (line,), rc.Geometry.SURFACE, {}) == [("volume V", "2 µm³")]


def test_what_is_shown_on_a_screen_and_on_the_page_is_marked_in_the_table():
    columns_of = (*POINTS, *CERTIFICATES)
    assert names_of(shown_in("patch", columns_of)) == (
        *("force", "depth", "stiffness", "contact_area", "spots", "mean_gap", "residual"),
    )
    assert names_of(shown_in("joint", columns_of)) == (
        *("nominal_pressure", "contact_fraction", "interfacial_stiffness_per_area"),
        *("spots", "mean_gap", "residual"),
    )
    assert set(CURVE_POINTS) == {
        *("force", "depth", "stiffness", "interfacial_stiffness"),
        *("contact_area", "max_pressure", "mean_gap", "elastic_energy"),
    }


def test_a_state_has_the_columns_of_a_curve_under_the_same_names(solution):
    [curve] = [rc.loading_curve(solution.problem.surface, MODULUS, forces=[1e-3]).to_record()]
    state = solution.to_record()
    for column in (*POINTS, *CERTIFICATES[:1]):
        assert state[column.name] == pytest.approx(curve[column.name][0], rel=1e-6, abs=1e-7), column.name
