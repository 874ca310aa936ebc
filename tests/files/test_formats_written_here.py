"""A file of every format that a few lines can write comes out as it was written: what anyone can run."""

import hashlib
import warnings
from pathlib import Path

import numpy as np
import pytest

import roughcontact as rc
from files.written import FILES, TWINS
from roughcontact.files.dispatch import READERS
from roughcontact.files.read import channels, read_line

SINGLE = 2e-7  # two roundings to single precision, relative to the largest height


@pytest.fixture(params=FILES)
def written(request):
    """A file, whose reader is here."""
    file = FILES[request.param]
    if file.needs_library:
        pytest.importorskip("SurfaceTopography")
    return file


def read(file, path):
    """Return the surface, read as a map or a profile, without any warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return (read_line if file.is_line else rc.read)(path, **file.given)


def test_a_file_comes_out_as_it_was_written(written, put):
    surface = read(written, put(written.name, written.data))
    largest = np.nanmax(np.abs(written.expected))
    np.testing.assert_allclose(surface.heights, written.expected, rtol=0, atol=SINGLE * largest)
    np.testing.assert_allclose(surface.grid.spacing, written.spacing, rtol=SINGLE)
    assert surface.missing == np.isnan(written.expected).sum()
    assert not any(surface.grid.periodic)
    assert surface.provenance[0].startswith(f"read from {written.name} (")
    assert f"sha256 {hashlib.sha256(written.data).hexdigest()[:16]}" in surface.provenance[0]


def test_its_only_channel_is_listed(written, put):
    (channel,) = channels(put(written.name, written.data))
    assert channel.shape == written.expected.shape
    assert written.given or channel.is_height != written.is_line


def test_a_map_is_no_profile_and_a_profile_no_map(written, put):
    path = put(written.name, written.data)
    units = {key: value for key, value in written.given.items() if key == "unit"}
    with pytest.raises(rc.ReadError, match=written.name):
        (rc.read if written.is_line else read_line)(path, **units)


def test_what_a_file_does_not_state_is_asked_for(written, put):
    if not written.given:
        return
    size = " and no size" if "size" in written.given else ""
    with pytest.raises(rc.ReadError, match=rf"no unit of its heights{size}; pass unit="):
        rc.read(put(written.name, written.data))


def test_every_reader_of_ours_has_a_file():
    suffixes = {Path(name).suffix for name in FILES}
    assert {id(READERS[suffix]) for suffix in suffixes & READERS.keys()} == set(map(id, READERS.values()))


def test_every_measured_file_has_a_written_twin():
    assert set(TWINS.values()) <= FILES.keys()
    for measured, twin in TWINS.items():
        assert (Path(measured).suffix in READERS) == (not FILES[twin].needs_library)
