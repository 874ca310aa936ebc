"""Containers of contact.engineering: each measurement is a channel, prepared or as it was uploaded."""

import io
import json
import sys
import zipfile

import numpy as np
import pytest
from scipy.io import netcdf_file

import roughcontact as rc
from roughcontact.files.container import stated_in
from roughcontact.files.read import channels

HEIGHTS = np.random.default_rng(4).standard_normal((12, 20))


def squeezed(heights):
    """Return NetCDF as contact.engineering prepares it: (x, y), sides and heights in one unit."""
    stream = io.BytesIO()
    file = netcdf_file(stream, "w")
    for axis, size, length in (("x", heights.shape[1], 10.0), ("y", heights.shape[0], 6.0)):
        file.createDimension(axis, size)
        variable = file.createVariable(axis, "f8", (axis,))
        variable[:] = (np.arange(size) + 0.5) * length / size
        variable.length, variable.length_unit, variable.periodic, variable.units = length, "um", 0, "um"
    variable = file.createVariable("heights", "f8", ("x", "y"))
    variable[:] = heights.T
    variable.units = "um"
    file.flush()
    return stream.getvalue()


def container(topographies, files, index="index.json"):
    meta = {"surfaces": [{"name": "part", "topographies": topographies}]}
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        if index == "index.json":
            archive.writestr(index, json.dumps(meta))
        elif index:
            yaml = pytest.importorskip("yaml")
            archive.writestr(index, yaml.dump(meta))  # tuples are written as Python's
        for name, data in files.items():
            archive.writestr(name, data)
    return stream.getvalue()


PREPARED = {
    "name": "left",
    "datafile": {"original": "a.opd", "squeezed-netcdf": "a.nc"},
    "detrend_mode": "height",
}
UPLOADED = {
    "name": "right",
    "datafile": {"original": "b.npy"},
    "unit": "nm",
    "size": (4000.0, 3000.0),
    "height_scale": 2.0,
    "is_periodic": True,
}


def npy(values):
    stream = io.BytesIO()
    np.save(stream, values)
    return stream.getvalue()


FILES = {"a.nc": squeezed(HEIGHTS), "b.npy": npy(HEIGHTS)}


@pytest.mark.parametrize("index", ["index.json", "meta.yml"])
def test_each_measurement_is_a_channel(put, index):
    path = put("part.zip", container([PREPARED, UPLOADED], FILES, index))
    assert [channel.name for channel in channels(path)] == ["left", "right"]
    with pytest.raises(
        rc.ReadError, match=r"several channels may be heights: 'left' .* 'right' .*pass channel="
    ):
        rc.read(path)
    left, right = rc.read(path, channel="left"), rc.read(path, channel="right")
    np.testing.assert_allclose(left.heights, HEIGHTS * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(left.grid.lengths, (6e-6, 10e-6), rtol=1e-12)
    assert "as contact.engineering prepared it (detrend mode: height)" in left.provenance
    np.testing.assert_allclose(right.heights, 2 * HEIGHTS * 1e-9, rtol=1e-15)
    np.testing.assert_allclose(right.grid.lengths, (3e-6, 4e-6), rtol=1e-12)
    assert right.grid.periodic == (True, True)
    assert left.grid.periodic == (False, False)


def test_one_measurement_needs_no_channel(put):
    surface = rc.read(put("part.zip", container([PREPARED], FILES)))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)


def npz(values):
    stream = io.BytesIO()
    np.savez(stream, heights=values, unit="um", spacing=(5e-7, 5e-7), periodic=(True, False))
    return stream.getvalue()


def test_what_the_index_leaves_open_is_what_the_file_states(put):
    silent = {"name": "map", "datafile": {"original": "c.npz"}}
    surface = rc.read(put("part.zip", container([silent], {"c.npz": npz(HEIGHTS)})))
    assert surface.grid.periodic == (True, False)
    free = silent | {"is_periodic": False}
    assert rc.read(put("free.zip", container([free], {"c.npz": npz(HEIGHTS)}))).grid.periodic == (
        False,
        False,
    )


def test_only_the_chosen_file_is_read(put):
    path = put("part.zip", container([PREPARED, UPLOADED], {"a.nc": b"no NetCDF", "b.npy": npy(HEIGHTS)}))
    assert rc.read(path, channel="right").grid.shape == HEIGHTS.shape
    with pytest.raises(rc.ReadError, match="not a NetCDF file"):
        rc.read(path, channel="left")


def test_the_library_writes_a_container_that_is_read(put, tmp_path):
    pytest.importorskip("SurfaceTopography")
    from SurfaceTopography import Topography
    from SurfaceTopography.Container.IO.CE import write_containers
    from SurfaceTopography.Container.SurfaceContainer import InMemorySurfaceContainer

    theirs = Topography(HEIGHTS.T, (10.0, 6.0), unit="um", info={"name": "map"})
    write_containers([InMemorySurfaceContainer([theirs])], str(tmp_path / "theirs.zip"))
    surface = rc.read(tmp_path / "theirs.zip")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-12)
    np.testing.assert_allclose(surface.grid.lengths, (6e-6, 10e-6), rtol=1e-12)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (container([], {"a.txt": b"1 2"}, ""), "a ZIP archive without index.json or meta.yml.*; unpack it"),
        (container([PREPARED], {}), "it is damaged .*a.nc.*; download it"),
        (container([{"name": "no file"}], FILES), "it is damaged .*datafile"),
        (container([PREPARED], FILES)[:-100], "it is damaged .*; download it"),
        (b"PK\x03\x04" + bytes(100), "it is damaged"),
    ],
)
def test_what_is_no_whole_container_is_refused(put, data, message):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("part.zip", data))


def test_without_the_package_that_reads_the_index_the_remedy_is_named(put, monkeypatch):
    path = put("part.zip", container([PREPARED], FILES, "meta.yml"))
    monkeypatch.setitem(sys.modules, "yaml", None)
    with pytest.raises(rc.ReadError, match=r"needs the package yaml.*pip install 'roughcontact\[formats\]'"):
        rc.read(path)


@pytest.mark.parametrize(
    ("stated", "name", "lengths"),
    [
        (
            {
                "name": "AFM",
                "type": "contact-based",
                "parameters": {"tip_radius": {"value": 20, "unit": "nm"}},
            },
            "AFM",
            {"tip_radius": 20e-9},
        ),
        (
            {
                "type": "optical",
                "parameters": {"resolution": {"value": 0.5, "unit": "um"}, "tip_radius": None},
            },
            "optical",
            {"resolution": 0.5e-6},
        ),
        ({"name": "stylus", "parameters": None}, "stylus", {}),
        (None, "", {}),
    ],
)
def test_instruments_are_those_of_the_index(stated, name, lengths):
    found = stated_in(container([PREPARED | {"instrument": stated}, UPLOADED], FILES))
    assert [place[:2] for place in found] == [("part", "left"), ("part", "right")]
    left, right = (place[2] for place in found)
    assert (left.name, right) == (name, rc.Instrument(""))
    known = {each: getattr(left, each) for each in ("tip_radius", "resolution")}
    assert {each: length for each, length in known.items() if length} == pytest.approx(lengths, rel=1e-15)
