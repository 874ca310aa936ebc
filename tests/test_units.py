"""Units that values carry, by library; which values pass untouched, and what is refused."""

from types import SimpleNamespace

import numpy as np
import pint
import pytest
import xarray

import roughcontact as rc
from roughcontact.units import PLAIN, in_si

U = pint.get_application_registry()
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


MASK = np.arange(24).reshape(4, 6) == 7
MASKED = np.ma.array(HEIGHTS, mask=MASK)


def test_what_a_mask_covers_is_missing():
    heights = rc.Surface(U.Quantity(MASKED, "nm"), GRID).heights
    np.testing.assert_allclose(heights, np.where(MASK, np.nan, HEIGHTS * 1e-9), rtol=1e-15)
    body = rc.Surface(HEIGHTS * 1e-9, GRID)
    with pytest.raises(ValueError, match="nan"):
        rc.loading_curve(body, 1e9, forces=np.ma.array([1e-4, 2e-4], mask=[False, True]))


def test_what_a_mask_of_astropy_covers_is_missing():
    units = pytest.importorskip("astropy.units")
    masked = pytest.importorskip("astropy.utils.masked").Masked
    for values in (masked(HEIGHTS * units.nm, mask=MASK), masked(HEIGHTS * 1e-9, mask=MASK)):
        heights = rc.Surface(values, GRID).heights
        np.testing.assert_allclose(heights, np.where(MASK, np.nan, HEIGHTS * 1e-9), rtol=1e-15)


@pytest.mark.parametrize("name", ["units", "unit", "Units", "UNIT"])
def test_attributes_that_name_a_unit(name):
    pandas = pytest.importorskip("pandas")
    array, frame = xarray.DataArray(HEIGHTS, attrs={name: "nm"}), pandas.DataFrame(HEIGHTS)
    frame.attrs[name] = "nm"
    for values in (array, frame):
        np.testing.assert_allclose(rc.Surface(values, GRID).heights, HEIGHTS * 1e-9, rtol=1e-15)


@pytest.mark.parametrize("force", [np.timedelta64(1, "s"), np.datetime64("2020-01-01"), "1"])
def test_times_and_texts_are_no_numbers(force):
    body = rc.Surface(HEIGHTS * 1e-9, GRID)
    with pytest.raises(ValueError, match="force must be one number in SI units"):
        rc.press(body, 1e9, force=force)
    with pytest.raises(ValueError, match="forces must be a number or an array of numbers"):
        rc.loading_curve(body, 1e9, forces=[force, force])


def test_factors_of_bodies_are_pure_numbers():
    body = rc.Surface(HEIGHTS * 1e-9, GRID)
    np.testing.assert_allclose((body * U.Quantity(50, "percent")).heights, HEIGHTS * 0.5e-9, rtol=1e-15)
    with pytest.raises(ValueError, match="factor is read as plain numbers, not in meter: give 2"):
        body * (2 * U.m)
    profile = rc.mdr.indenter.paraboloid(1e-3)
    with pytest.raises(ValueError, match="factor is read as plain numbers, not in meter: give 2"):
        profile * (2 * U.m)


def test_spectra_and_hardness_laws_are_called_with_units():
    spectrum = rc.SelfAffineSpectrum(0.8, rolloff=1e-5)
    assert spectrum(np.array([2.0]) / U.um) == pytest.approx(spectrum(np.array([2e6])), rel=1e-12)
    law = rc.NixGao(1e9, 1e-6)
    assert law(2 * U.um) == pytest.approx(law(2e-6), rel=1e-12)
    with pytest.raises(ValueError, match="wavenumber must be in rad/m"):
        spectrum(np.array([2.0]) * U.um)
    with pytest.raises(ValueError, match="radius must be in m"):
        law(2 * U.s)


@pytest.mark.parametrize("periodic", [True, False])
def test_operators_take_plain_fields(periodic):
    units = pytest.importorskip("astropy.units")
    grid = rc.Grid((8, 8), 1e-6, periodic)
    with pytest.raises(ValueError, match="a field is read as plain SI numbers, not in MPa"):
        rc.half_space(grid, 1e9).apply(np.ones((8, 8)) * units.MPa)
