"""Foreign HDF5 files show no file of this machine as heights, and declare no more than the memory holds."""

import io
import zlib
from types import SimpleNamespace

import h5py
import numpy as np
import psutil
import pytest

import roughcontact as rc
from roughcontact.files import hdf5
from roughcontact.files.file_errors import ContentError
from roughcontact.files.hdf5 import is_hdf5, opened_hdf5
from roughcontact.files.read import channels

SECRET = bytes(range(48, 96))
GIVEN = {"unit": "um", "size": 1e-3}


@pytest.fixture
def secret(tmp_path):
    """The path of a file that is not to be shown, and of an HDF5 file of the same."""
    (tmp_path / "secret").write_bytes(SECRET)
    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["heights"] = np.frombuffer(SECRET, np.uint8).reshape(6, 8)
    return tmp_path / "secret"


def crafted(path, kind, secret):
    """Write an HDF5 file whose heights are those of another file."""
    with h5py.File(path, "w") as file:
        other = str(secret) + ".h5"
        if kind == "external storage":
            file.create_dataset("heights", (6, 8), np.uint8, external=[(str(secret), 0, len(SECRET))])
        elif kind == "external storage in a group":
            file.create_dataset("deep/heights", (6, 8), np.uint8, external=[(str(secret), 0, len(SECRET))])
        elif kind == "external link":
            file["heights"] = h5py.ExternalLink(other, "/heights")
        elif kind == "soft link to an external one":
            file["group/away"] = h5py.ExternalLink(other, "/heights")
            file["heights"] = h5py.SoftLink("/group/away")
        elif kind == "external group":
            file["group"] = h5py.ExternalLink(other, "/")
            file["heights"] = h5py.SoftLink("/group/heights")
        else:
            layout = h5py.VirtualLayout((6, 8), np.uint8)
            layout[...] = h5py.VirtualSource(other, "heights", (6, 8))
            file.create_virtual_dataset("heights", layout)
    return path


KINDS = [
    "external storage",
    "external storage in a group",
    "external link",
    "soft link to an external one",
    "external group",
    "virtual dataset",
]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["a.nc", "a.nc4", "a.h5", "a.datx", "a.mat", "a.unknown"])
def test_other_files_are_not_shown(tmp_path, secret, name, kind):
    if not name.startswith("a.nc"):
        pytest.importorskip("SurfaceTopography")
    path = crafted(tmp_path / name, kind, secret)
    for function in (lambda: rc.read(path, **GIVEN), lambda: channels(path), lambda: rc.read_curve(path)):
        with pytest.raises(rc.ReadError, match=r"in another file|from other files|only; give a \.nc file"):
            function()


def test_the_same_behind_a_block_of_the_users(tmp_path, secret):
    """As MATLAB writes its files; a netCDF reader finds it there as well."""
    plain = crafted(tmp_path / "plain.h5", "external storage", secret).read_bytes()
    with h5py.File(tmp_path / "a.nc", "w", userblock_size=1024) as file:
        file.create_dataset("heights", (6, 8), np.uint8, external=[(str(secret), 0, len(SECRET))])
    assert is_hdf5(plain)
    assert is_hdf5((tmp_path / "a.nc").read_bytes())
    assert not is_hdf5(plain[1:])
    with pytest.raises(rc.ReadError, match="from other files"):
        rc.read(tmp_path / "a.nc", **GIVEN)


def test_links_within_a_file_are_followed(tmp_path):
    with h5py.File(tmp_path / "a.nc", "w") as file:
        file["group/map"] = np.eye(4)
        file["heights"] = h5py.SoftLink("/group/map")
        file["group/again"] = file["group"]  # a ring
    assert np.array_equal(rc.read(tmp_path / "a.nc", **GIVEN).heights, np.eye(4) * 1e-6)


@pytest.mark.parametrize("name", ["a.nc", "a.h5"])
def test_numbers_that_were_never_written_take_no_memory(tmp_path, name):
    """10^12 samples in a file of 2 kB, in one block and in many."""
    if name == "a.h5":
        pytest.importorskip("SurfaceTopography")
    for chunks in (None, (1000, 1000)):
        with h5py.File(tmp_path / name, "w") as file:
            file.create_dataset("heights", (1_000_000, 1_000_000), np.float32, chunks=chunks)
        with pytest.raises(rc.ReadError, match=r"reading it needs 100000 GB of memory"):
            rc.read(tmp_path / name, **GIVEN)


def test_a_block_larger_than_the_memory_is_not_unpacked(monkeypatch):
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        file.create_dataset("heights", (6, 8), np.uint8, chunks=(30000, 30000), maxshape=(None, None))
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=8e8))
    with pytest.raises(ContentError, match=r"needs 0\.9 GB"), opened_hdf5(stream.getvalue()):
        pass


@pytest.mark.parametrize("shuffle", [False, True])
def test_a_block_that_unpacks_to_more_than_it_declares_is_refused(shuffle):
    packer = zlib.compressobj(9)
    packed = b"".join(packer.compress(bytes(1_000_000)) for _ in range(110)) + packer.flush()
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        values = file.create_dataset(
            "heights", (6, 8), "f8", chunks=(6, 8), compression="gzip", shuffle=shuffle
        )
        values.id.write_direct_chunk((0, 0), packed)
    with (
        pytest.raises(ContentError, match="a block of its /heights unpacks to more than it declares"),
        opened_hdf5(stream.getvalue()),
    ):
        pass


@pytest.mark.parametrize(
    "filters", [{}, {"shuffle": True}, {"fletcher32": True}, {"shuffle": True, "fletcher32": True}]
)
def test_large_blocks_are_read(tmp_path, monkeypatch, filters):
    monkeypatch.setattr(hdf5, "_HARMLESS", 0)
    heights = np.random.default_rng(3).integers(0, 99, (60, 80)).cumsum(axis=1) * 1.0
    with h5py.File(tmp_path / "a.nc", "w") as file:
        file.create_dataset("heights", data=heights, chunks=(40, 80), compression="gzip", **filters)
    np.testing.assert_allclose(
        rc.read(tmp_path / "a.nc", unit="nm", size=1e-3).heights, heights * 1e-9, rtol=1e-15
    )
