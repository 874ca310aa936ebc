"""Units that values carry, by library; which values pass untouched, and what is refused."""

from types import SimpleNamespace

import numpy as np
import pint
import pytest
import xarray

import roughcontact as rc
from roughcontact.units import PLAIN, in_si

U = pint.UnitRegistry()
GRID = rc.Grid((4, 6), 1e-6)
HEIGHTS = np.arange(24.0).reshape(4, 6)


def test_values_of_pint():
    assert in_si(1 * U.GPa, "Pa", "modulus") == pytest.approx(1e9, rel=1e-15)
    assert in_si(U.Quantity(30.0, "deg"), "rad", "angle") == pytest.approx(np.pi / 6, rel=1e-15)
    assert in_si(5 * U.percent, None, "share") == pytest.approx(0.05, rel=1e-15)
    assert in_si([1 * U.kN, 0, 2 * U.N], "N", "forces") == [1000.0, 0, 2.0]
    assert in_si((1 * U.um, 2 * U.um), "m", "spacing") == pytest.approx((1e-6, 2e-6), rel=1e-15)


def test_values_in_a_unit_of_the_user():
    own = pint.UnitRegistry()
    own.define("smoot = 1.7018 * meter")
    assert in_si(2 * own.smoot, "m", "side") == pytest.approx(3.4036, rel=1e-15)


def test_values_of_astropy():
    units = pytest.importorskip("astropy.units")
    assert in_si(1 * units.kN, "N", "force") == pytest.approx(1e3, rel=1e-15)
    assert in_si(3 * units.rad / units.um, "rad/m", "q_min") == pytest.approx(3e6, rel=1e-15)
    heights = rc.Surface(HEIGHTS * units.nm, GRID).heights
    assert type(heights) is np.ndarray
    np.testing.assert_allclose(heights, HEIGHTS * 1e-9, rtol=1e-15)
    with pytest.raises(ValueError, match=r"force must be in N, .*not in s"):
        rc.press(rc.Surface(HEIGHTS, GRID), 1e9, force=1 * units.s)


@pytest.mark.parametrize("unit", ["nm", "nanometers", b"nm"])
def test_arrays_of_xarray(unit):
    array = xarray.DataArray(HEIGHTS, dims=("y", "x"), attrs={"units": unit})
    np.testing.assert_allclose(rc.Surface(array, GRID).heights, HEIGHTS * 1e-9, rtol=1e-15)


def test_arrays_of_xarray_around_quantities():
    array = xarray.DataArray(HEIGHTS * U.nm, dims=("y", "x"))
    np.testing.assert_allclose(rc.Surface(array, GRID).heights, HEIGHTS * 1e-9, rtol=1e-15)


def test_arrays_of_xarray_without_a_unit_are_in_metres():
    np.testing.assert_array_equal(rc.Surface(xarray.DataArray(HEIGHTS), GRID).heights, HEIGHTS)


def test_units_as_cf_writes_them():
    curve = rc.loading_curve(rc.Surface(HEIGHTS * 1e-9, GRID), 1e9, forces=[1e-4, 2e-4]).to_dataset()
    assert in_si(curve.stiffness, "N/m", "stiffness") == pytest.approx(curve.stiffness.values, rel=1e-15)
    assert in_si(curve.contact_area, "m^2", "area") == pytest.approx(curve.contact_area.values, rel=1e-15)
    assert in_si(xarray.DataArray(0.3, attrs={"units": "1"}), None, "hurst") == 0.3


def test_a_table_of_pandas():
    pandas = pytest.importorskip("pandas")
    forces = pandas.Series([1.0, 2.0])
    forces.attrs["units"] = "kN"
    assert in_si(forces, "N", "forces") == pytest.approx([1e3, 2e3], rel=1e-15)


def test_a_dataset_in_a_file(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        stored = file.create_dataset("heights", data=HEIGHTS)
        stored.attrs["units"] = "nm"
        np.testing.assert_allclose(in_si(stored, "m", "heights"), HEIGHTS * 1e-9, rtol=1e-15)


def test_lines_are_pressed_by_forces_per_length():
    line = rc.Surface(1e-7 * np.cos(np.arange(32) / 5), rc.Grid(32, 1e-6))
    body = rc.line(line.grid, 1e9)
    with_unit = rc.press(line, 1e9, force=2 * U.N / U.mm, operator=body)
    np.testing.assert_allclose(with_unit.force, 2e3, rtol=1e-8)
    with pytest.raises(ValueError, match="force must be in N m-1"):
        rc.press(line, 1e9, force=2 * U.N, operator=body)
    with pytest.raises(ValueError, match="force must be in N, "):
        rc.press(rc.Surface(HEIGHTS * 1e-9, GRID), 1e9, force=2 * U.N / U.mm)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (
            SimpleNamespace(units="furlongs per blink"),
            "force carries the unit 'furlongs per blink', .*give plain",
        ),
        (xarray.DataArray(1.0, attrs={"units": "N/"}), "force carries the unit 'N/', which is not known"),
        ([1 * U.N, 2.0], "force holds numbers with a unit and 2.0 without: give each a unit"),
        (2 * U.s, "force must be in N, or in a unit of the same dimension, not in second"),
    ],
)
def test_what_is_refused(value, message):
    with pytest.raises(ValueError, match=message):
        in_si(value, "N", "force")


def test_a_parameter_without_a_dimension_says_the_number_to_give():
    with pytest.raises(ValueError, match="hurst is read as plain numbers, not in nanometer: give 5e-09"):
        in_si(5 * U.nm, None, "hurst")


def test_plain_values_pass_untouched():
    values = (1.0, 2, None, "10 um", HEIGHTS, np.float64(1.0), slice(3), [1.0, 2.0], (3, 4.0), object(), GRID)
    for value in values:
        assert in_si(value, "m", "x") is value
    # Most arguments are of these types, and nothing else is asked of them.
    assert {type(value) for value in values[:7]} <= PLAIN
