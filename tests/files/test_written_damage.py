"""Every file that is written here, spoilt in every way: an error of ours, the right data, or a word of warning.

What a format cannot tell is listed: bytes of heights that were replaced where there is no checksum.
"""

import numpy as np
import pytest

import roughcontact as rc
from files.spoiling import GUARDED, LOST, MUTATIONS, attempt, is_right
from files.written import FILES

# Any bytes are heights here, and nothing else than other heights comes of them.
ANY_BYTES = {
    "bare.mat",
    "bare.npy",
    "binary.sdf",
    "gwyddion.gwy",
    "omnisurf.os3d",
    "park.tiff",
    "truemap.tmd",
    "wyko.opd",
    "zeta.zmg",
}
REPLACED = {name for name in MUTATIONS if name.startswith(("flipped", "garbage after"))}
# What stands behind the heights is other data of the instrument: a byte more shifts them.
SHIFTED = {("zeta.zmg", "a byte more")}
# A digit less in a text is another number, and no more than one.
TEXTS = {"text.sdf", "pixel-size.txt", "bare.csv", "gwyddion.txt", "profile.csv", "points.xyz"}
# Its number of points is stated nowhere.
ENDLESS = {"profile.csv"}


@pytest.fixture(scope="module", params=FILES)
def whole(request, tmp_path_factory):
    """A file and its surface."""
    file = FILES[request.param]
    if file.needs_library:
        pytest.importorskip("SurfaceTopography")
    path = tmp_path_factory.mktemp("whole") / file.name
    path.write_bytes(file.data)
    return file, attempt(path, file.is_line, file.given)[0]


@pytest.mark.parametrize("mutation", MUTATIONS)
def test_a_spoilt_file(whole, put, caplog, capfd, mutation):
    file, truth = whole
    path = put(file.name, MUTATIONS[mutation](file.data))
    outcome, warned = attempt(path, file.is_line, file.given)
    assert not caplog.records
    assert capfd.readouterr() == ("", "")
    if isinstance(outcome, rc.ReadError):
        assert str(outcome).startswith(f"{file.name}: ")
        return
    assert mutation not in LOST
    if file.name in ENDLESS and mutation.startswith("cut"):
        left = outcome.heights[:-1]  # the last number may be cut short
        np.testing.assert_array_equal(left, truth.heights[: len(left)])
        return
    if file.name in TEXTS and mutation == "a byte less":
        assert (outcome.heights != truth.heights)[~np.isnan(truth.heights)].sum() <= 1
        return
    untold = (file.name in ANY_BYTES and mutation in REPLACED) or (file.name, mutation) in SHIFTED
    assert is_right(outcome, truth) or untold or (warned and path.suffix not in GUARDED)


def test_the_whole_file_is_read(whole):
    _, truth = whole
    assert isinstance(truth, rc.Surface)
