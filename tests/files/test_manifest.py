"""Measured files: rms height, size, missing points and orientation against the manifest."""

import csv
import hashlib
import warnings

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.errors import SurfaceWarning
from roughcontact.files.inspect import channels

OWN = {
    "ISO5436-sample1.x3p": {},
    "KautschukInfiniteFocus.x3p": {},
    "derived_al3d_crop.xyz": {},
    "derived_di3_nm.npy": {"unit": "nm", "size": "10 um"},
    "gwyddion-export-german.txt": {},
    "matrix-3.txt": {},
}
FOREIGN = {
    "AR_20211011.ibw": {},
    "Park_20210916_034.tiff": {},
    "al3d-1.al3d": {},
    "derived_frt2_masked.gwy": {},
    "derived_mi1.mat": {"unit": "m", "size": (20e-6, 20e-6)},
    "derived_top1.nc": {},
    "di-3.di": {},
    "frt-2.frt": {},
    "image.nid": {},
    "mi-1.mi": {},
    "sample_0.jpk-qi-image": {},
    "sur-2.sur": {},
    "test_1.opd": {},
    "tmd-1.tmd": {},
    "top-1.top": {},
    "valid_zygo_dat_file.dat": {},
}
# Files about which a word is due: which one is said.
WARNED = {
    "ISO5436-sample1.x3p": "heights up to 1.05 m",
    "gwyddion-export-german.txt": "an rms height of 4.71 m",
    "AR_20211011.ibw": "took 'HeightRetrace'",
    "di-3.di": "took 'ZSensor'",
    "image.nid": "took 'Scan forward (Z-Axis)'",
    "sample_0.jpk-qi-image": "took 'Height (measured)'",
}
# A derived file lies as the file it was made from: its corners serve where the manifest has none.
TWIN = {"derived_di3_nm.npy": "di-3.di", "derived_mi1.mat": "mi-1.mi"}
# The manifest's mean of this one counts the missing points as heights: only differences can be compared.
OTHER_MEAN = {"sur-2.sur"}


@pytest.fixture(scope="module")
def manifest(surfaces):
    with open(surfaces / "MANIFEST.csv", newline="", encoding="utf-8") as lines:
        return {row["file"]: row for row in csv.DictReader(lines)}


@pytest.mark.parametrize("name", [*OWN, *FOREIGN])
def test_a_measured_file_comes_out_as_the_manifest_says(surfaces, manifest, name):
    if name in FOREIGN:
        pytest.importorskip("SurfaceTopography")
    row = manifest[name]
    path = surfaces / name
    keywords = (OWN | FOREIGN)[name]
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        surface = rc.read(path, **keywords)
    assert bool(said) == (name in WARNED)
    assert all(one.category is SurfaceWarning for one in said)
    assert name not in WARNED or any(WARNED[name] in str(one.message) for one in said)
    assert surface.grid.shape == (int(row["ny"]), int(row["nx"]))
    assert surface.missing == int(row["n_missing"])
    assert surface.grid.periodic == (False, False)
    np.testing.assert_allclose(surface.rms * 1e9, float(row["rms_nm_A"]), rtol=1e-6)
    for length, stated in zip(surface.grid.lengths, (row["ly_um"], row["lx_um"]), strict=True):
        np.testing.assert_allclose(length * 1e6, float(stated or 10.0), rtol=1e-6)
    _assert_orientation(surface.heights, manifest[TWIN.get(name, name)]["corners_nm"], name in OTHER_MEAN)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    assert surface.provenance[0].startswith(f"read from {name} (")
    assert digest.startswith(row["sha256"])
    assert f"sha256 {row['sha256']}" in surface.provenance[0]
    assert str(path.parent) not in " ".join(surface.provenance)


def _assert_orientation(heights, stated, other_mean):
    """Compare top left, top right, bottom left and the centre, above the mean, printed with five digits."""
    if not stated:
        return
    ny, nx = heights.shape
    levelled = (heights - np.nanmean(heights)) * 1e9
    ours = np.array([levelled[0, 0], levelled[0, -1], levelled[-1, 0], levelled[ny // 2, nx // 2]])
    theirs = np.array([float(value) for value in stated.split()])
    if other_mean:
        ours, theirs = ours - ours[0], theirs - theirs[0]
    # Five significant digits: half a unit of the fifth, twice where two of them were subtracted.
    tolerance = 5e-5 * np.nanmax(np.abs(theirs)) * (2 if other_mean else 1)
    np.testing.assert_allclose(
        ours, theirs, rtol=0 if other_mean else 5.001e-5, atol=tolerance if other_mean else 0
    )


def test_the_manifest_is_read_completely(manifest):
    refused = {"dektak-1.csv", "rsciio_test_surface_au.sur"}
    assert set(manifest) == set(OWN) | set(FOREIGN) | refused


def test_a_line_scan_is_refused(surfaces):
    with pytest.raises(rc.ReadError, match=r"dektak-1\.csv: row 1 .*not a number.*line scan is not a map"):
        rc.read(surfaces / "dektak-1.csv")


def test_arbitrary_units_are_refused(surfaces):
    pytest.importorskip("SurfaceTopography")
    with pytest.raises(rc.ReadError, match="rsciio_test_surface_au"):
        rc.read(surfaces / "rsciio_test_surface_au.sur")


def test_another_channel_is_taken_when_named(surfaces):
    pytest.importorskip("SurfaceTopography")
    surface = rc.read(surfaces / "di-3.di", channel="height")
    np.testing.assert_allclose(surface.rms * 1e9, 264.002853, rtol=1e-6)  # the manifest's second height
    assert "channel 'Height'" in surface.provenance[0]
    second = rc.read(surfaces / "sample_0.jpk-qi-image", channel="Height (measured)#2")
    assert np.array_equal(second.heights, rc.read(surfaces / "sample_0.jpk-qi-image", channel=1).heights)


def test_a_channel_that_is_no_height_needs_a_unit(surfaces):
    pytest.importorskip("SurfaceTopography")
    with pytest.raises(rc.ReadError, match=r"mi-1\.mi: it states heights in 'V'.*pass unit="):
        rc.read(surfaces / "mi-1.mi", channel="Deflection")
    with pytest.raises(rc.ReadError, match=r"di-3\.di: it states no unit.*pass unit="):
        rc.read(surfaces / "di-3.di", channel="Phase")
    with pytest.raises(rc.ReadError, match=r"no channel 'Tilt', only 'ZSensor' \(256 x 256, nm\)"):
        rc.read(surfaces / "di-3.di", channel="Tilt")


def test_the_users_word_goes_before_the_files(surfaces):
    pytest.importorskip("SurfaceTopography")
    stated = rc.read(surfaces / "tmd-1.tmd")
    given = rc.read(surfaces / "tmd-1.tmd", unit="um", size=("18.9566 um", "18.9566 um"))
    np.testing.assert_allclose(given.heights, stated.heights * 1e-3, rtol=1e-12)
    np.testing.assert_allclose(given.grid.lengths, 18.9566e-6, rtol=1e-12)
    assert any("instead of the file's mm" in line for line in given.provenance)
    assert any("as given, instead of the file's 0.01895" in line for line in given.provenance)


def test_channels_lists_what_a_file_holds(surfaces):
    pytest.importorskip("SurfaceTopography")
    found = {channel.name: channel for channel in channels(surfaces / "mi-1.mi")}
    assert [name for name, channel in found.items() if channel.is_height] == ["Topography"]
    assert found["Topography"].unit == "µm"
    assert found["Topography"].shape == (256, 256)
    np.testing.assert_allclose(found["Topography"].size, 20e-6, rtol=1e-12)
    assert found["Friction#2"].unit == "V"


@pytest.mark.parametrize("name", FOREIGN)
@pytest.mark.parametrize("share", [0.02, 0.5, 0.97])
def test_a_foreign_file_cut_short_is_refused_or_lost_nothing_of_the_heights(surfaces, put, name, share):
    pytest.importorskip("SurfaceTopography")
    data = (surfaces / name).read_bytes()
    outcome = attempt(put(name, data[: int(share * len(data))]), name)
    if isinstance(outcome, rc.ReadError):
        assert str(outcome).startswith(f"{name}: ")
    else:
        assert np.array_equal(outcome.heights, attempt(surfaces / name, name).heights, equal_nan=True)


@pytest.mark.parametrize("name", ["di-3.di", "AR_20211011.ibw", "test_1.opd", "Park_20210916_034.tiff"])
@pytest.mark.parametrize("seed", range(5))
def test_a_foreign_file_with_a_spoilt_header_never_fails_otherwise(surfaces, put, caplog, capfd, name, seed):
    pytest.importorskip("SurfaceTopography")
    data = bytearray((surfaces / name).read_bytes())
    for place in np.random.default_rng(seed).integers(0, min(2000, len(data)), 20):
        data[place] ^= 0xFF
    outcome = attempt(put(name, bytes(data)), name)
    assert str(outcome).startswith(f"{name}: ") if isinstance(outcome, rc.ReadError) else outcome.rms >= 0
    assert not caplog.records
    assert capfd.readouterr() == ("", "")


def attempt(path, name):
    """Return the surface or the ReadError; any other error, and any warning but our own, goes through."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SurfaceWarning)
        try:
            return rc.read(path, **(OWN | FOREIGN)[name])
        except rc.ReadError as error:
            return error
