"""Surfaces as datasets of xarray, and arrays of xarray as surfaces."""

import numpy as np
import pint
import pytest
import xarray

import roughcontact as rc

ROUGH = rc.self_affine(
    rc.Grid((16, 24), (2e-6, 1e-6), (True, False)), 0.8, 1e-7, np.random.default_rng(3), amplitudes="gaussian"
)
STEPS = {"y": np.arange(4) * 2.0, "x": np.arange(6) * 0.5}
U = pint.get_application_registry()
HEIGHTS = np.arange(24.0).reshape(4, 6)


def array(units="nm", **more):
    coordinates = {axis: (axis, places, {"units": "um"}) for axis, places in STEPS.items()}
    return xarray.DataArray(HEIGHTS, coordinates, ("y", "x"), "topography", {"units": units} | more)


def test_a_surface_comes_back_from_its_dataset_to_the_last_bit():
    dataset = ROUGH.to_dataset()
    again = rc.Surface.from_dataarray(dataset["heights"])
    np.testing.assert_array_equal(again.heights, ROUGH.heights)
    assert again.grid.periodic == (True, False)
    np.testing.assert_allclose(again.grid.spacing, ROUGH.grid.spacing, rtol=1e-15)
    assert dataset.attrs["input_surface"] == "\n".join(ROUGH.provenance)


def test_a_line_and_missing_points_come_back():
    line = rc.Surface(
        np.where(np.arange(32) == 7, np.nan, np.cos(np.arange(32))) * 1e-9, rc.Grid(32, 3e-7, True)
    )
    again = rc.Surface.from_dataarray(line.to_dataset()["heights"])
    np.testing.assert_array_equal(again.heights, line.heights)
    assert again.grid.periodic == (True,)


def test_the_file_and_the_dataset_hold_the_same(tmp_path):
    rc.write(ROUGH, tmp_path / "rough.nc")
    with xarray.open_dataset(tmp_path / "rough.nc", engine="h5netcdf") as stored:
        xarray.testing.assert_equal(stored.load(), ROUGH.to_dataset())
        assert rc.Surface.from_dataarray(stored["heights"]).grid.periodic == (True, False)


def test_units_of_heights_and_of_places_are_read():
    surface = rc.Surface.from_dataarray(array())
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2e-6, 0.5e-6), rtol=1e-15)
    assert surface.grid.periodic == (False, False)
    assert "DataArray 'topography'" in surface.provenance[0]


def test_columns_and_rows_are_told_apart_by_the_names_of_dimensions():
    turned = rc.Surface.from_dataarray(array().transpose("x", "y"))
    np.testing.assert_array_equal(turned.heights, rc.Surface.from_dataarray(array()).heights)


def test_quantities_of_pint_state_the_unit():
    quantities = U.Quantity(HEIGHTS, "nm")
    coordinates = {axis: (axis, places, {"units": "um"}) for axis, places in STEPS.items()}
    surface = rc.Surface.from_dataarray(xarray.DataArray(quantities, coordinates, ("y", "x")))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            xarray.DataArray(HEIGHTS, dims=("y", "x")),
            "states no unit of its heights and no size; pass unit= .* size=",
        ),
        (array(units="V"), "heights in 'V', which is no length"),
        (
            array().assign_coords(x=("x", [0, 1, 2, 3, 4, 6.0], {"units": "um"})),
            "coordinates along x are not even",
        ),
        (HEIGHTS, "an xarray.DataArray is needed, not a ndarray"),
        (array().expand_dims(time=2), "3-dimensional"),
    ],
)
def test_what_is_left_open_is_asked_for(given, message):
    with pytest.raises(ValueError, match=message):
        rc.Surface.from_dataarray(given)


def test_what_the_array_leaves_open_may_be_given():
    bare = xarray.DataArray(HEIGHTS, dims=("y", "x"))
    surface = rc.Surface.from_dataarray(bare, unit="nm", size=("8 um", "3 um"), periodic=True)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.lengths, (8e-6, 3e-6), rtol=1e-15)
    assert surface.grid.periodic == (True, True)


@pytest.mark.parametrize("unit", [U.nm, 1 * U.nm, "nm", 1e-9])
@pytest.mark.parametrize("size", [(8 * U.um, 3 * U.um), [8e-6, 3e-6] * U.m, ("8 um", "3 um"), (8e-6, 3e-6)])
def test_units_and_sizes_may_carry_units(unit, size, tmp_path):
    np.save(tmp_path / "bare.npy", HEIGHTS)
    bare = xarray.DataArray(HEIGHTS, dims=("y", "x"))
    for surface in (
        rc.read(tmp_path / "bare.npy", unit=unit, size=size),
        rc.Surface.from_dataarray(bare, unit=unit, size=size),
    ):
        np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)
        np.testing.assert_allclose(surface.grid.lengths, (8e-6, 3e-6), rtol=1e-15)


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        ({"unit": U.s}, "unit must be in m, .*not in second"),
        ({"unit": []}, "unit must be a text such as 'nm', or metres per unit"),
        ({"size": 3 * U.N}, "size must be in m, .*not in newton"),
    ],
)
def test_units_that_are_no_lengths_are_refused(stated, message, tmp_path):
    np.save(tmp_path / "bare.npy", HEIGHTS)
    with pytest.raises(ValueError, match=message):
        rc.read(tmp_path / "bare.npy", **{"unit": "nm", "size": 1e-5} | stated)


@pytest.mark.parametrize("unit", [np.timedelta64(1, "s"), [1e-6, 2e-6]])
def test_a_unit_that_is_no_number_is_refused(unit):
    with pytest.raises(ValueError, match="unit must be one number in SI units"):
        rc.Surface.from_dataarray(array(), unit=np.array(unit))


def test_a_warning_names_the_line_that_called():
    heights = HEIGHTS.copy()
    heights[1, 2] = 1e9
    with pytest.warns(rc.SurfaceWarning) as caught:
        rc.Surface.from_dataarray(array().copy(data=heights))
    assert {each.filename for each in caught} == {__file__}
