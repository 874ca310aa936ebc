import numpy as np
import xarray

from roughcontact.files.netcdf_bytes import netcdf_bytes


def test_the_bytes_are_those_of_a_file_that_holds_the_dataset(tmp_path):
    rng = np.random.default_rng(1)
    dataset = xarray.Dataset(
        {"pressure": (("y", "x"), rng.normal(size=(40, 30)), {"units": "Pa"}), "force": 1.5, "name": "a"},
        {"x": np.arange(30.0)},
        {"title": "pressures"},
    )
    dataset["pressure"][3, 4] = np.nan
    (tmp_path / "a.nc").write_bytes(netcdf_bytes(dataset))
    back = xarray.load_dataset(tmp_path / "a.nc", engine="h5netcdf")
    xarray.testing.assert_identical(back, dataset)


def test_maps_are_compressed():
    dataset = xarray.Dataset({"gap": (("y", "x"), np.zeros((500, 500)))})
    assert len(netcdf_bytes(dataset)) < 0.05 * dataset["gap"].nbytes
