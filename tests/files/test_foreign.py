"""The guard before SurfaceTopography, on small files written here."""

import io
import warnings

import numpy as np
import pytest
from scipy.io import savemat

import roughcontact as rc
from roughcontact.files.errors import SurfaceWarning
from roughcontact.files.inspect import channels

pytest.importorskip("SurfaceTopography")

HEIGHTS = np.arange(12.0).reshape(3, 4)


def mat(**arrays):
    stream = io.BytesIO()
    savemat(stream, arrays)
    return stream.getvalue()


def test_a_bare_matrix_keeps_its_rows(put):
    path = put("a.mat", mat(Z=HEIGHTS, dx=1.0, dy=2.0))
    with pytest.raises(rc.ReadError, match=r"a\.mat: it states no unit of its heights and no size"):
        rc.read(path)
    surface = rc.read(path, unit="um", size=(3e-6, 4e-6))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)
    assert [channel.is_height for channel in channels(path)] == [True, False, False]


def test_two_maps_that_name_no_height_must_be_chosen_from(put):
    path = put("a.mat", mat(A=HEIGHTS, B=HEIGHTS + 1))
    with pytest.raises(rc.ReadError, match=r"no channel is a height.*'A' \(3 x 4, no unit\).*pass channel="):
        rc.read(path, unit="um", size=1e-5)
    surface = rc.read(path, unit="um", size=1e-5, channel="B")
    np.testing.assert_allclose(surface.heights, (HEIGHTS + 1) * 1e-6, rtol=1e-15)


def test_heights_are_told_by_name_and_not_by_place(put):
    path = put("a.mat", mat(Phase=HEIGHTS, Z_sensor=HEIGHTS + 1, HeightError=HEIGHTS))
    surface = rc.read(path, unit="um", size=1e-5)
    np.testing.assert_allclose(surface.heights, (HEIGHTS + 1) * 1e-6, rtol=1e-15)
    both = put("b.mat", mat(Topography=HEIGHTS, Height=HEIGHTS + 1))
    with pytest.warns(SurfaceWarning, match="2 channels are heights .* pass channel="):
        surface = rc.read(both, unit="um", size=1e-5)
    assert any("2 channels are heights" in line for line in surface.provenance)


def test_a_channel_of_something_else_is_read_aloud(put):
    path = put("a.mat", mat(Phase=HEIGHTS, Z_sensor=HEIGHTS + 1))
    with pytest.warns(SurfaceWarning, match=r"channel 'Phase' is not marked as heights"):
        surface = rc.read(path, unit="um", size=1e-5, channel="Phase")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)


def test_missing_points_are_nan(tmp_path):
    heights = HEIGHTS.copy()
    heights[1, 2] = np.nan
    path = tmp_path / "a.mat"
    path.write_bytes(mat(Z=heights))
    surface = rc.read(path, unit="um", size=1e-5)
    assert np.array_equal(np.isnan(surface.heights), np.isnan(heights))


def test_a_format_of_ours_under_another_name_is_not_read_leniently(put, npy):
    for name, content in (
        ("a.dat", "1 2 3 4\n5 6 7 8\n9 1 2 3\n"),
        ("b.dat", npy(HEIGHTS)),
        ("c.dat", "0 0 1\n1 0 1\n0 1 1\n"),
    ):
        with pytest.raises(rc.ReadError, match=f"{name}: .*rename it"):
            rc.read(put(name, content), unit="um", size=1e-5)


def test_bytes_without_a_mark_are_not_taken_for_a_terrain(put):
    terrain = np.random.default_rng(3).integers(200, 900, 400).astype(">i2").tobytes()
    with pytest.raises(rc.ReadError, match=r"a\.bin: .*\.hgt"):
        rc.read(put("a.bin", terrain), unit="m", size=1e-2)
    surface = rc.read(put("a.hgt", terrain), unit="mm", size=0.5)
    assert surface.grid.shape == (20, 20)


@pytest.mark.parametrize(
    "name", ["a.opd", "a.sur", "a.gwy", "a.nid", "a.h5", "a.mat", "a.tiff", "a.unknown", "a"]
)
@pytest.mark.parametrize("content", [b"\0", b"x", bytes(999), b"\xff" * 300, b"PK\x03\x04" + b"junk" * 30])
def test_rubbish_is_refused_under_any_name(put, name, content):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(rc.ReadError, match=name):
            rc.read(put(name, content), unit="um", size=1e-5)
        with pytest.raises(rc.ReadError, match=name):
            channels(put(name, content))
