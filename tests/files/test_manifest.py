"""Measured files: rms height, size, missing points and orientation against the manifest."""

import csv
import hashlib
import warnings

import numpy as np
import pytest

import roughcontact as rc
from files.written import TWINS
from measured import NOT_HERE, SURFACES
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_line

if SURFACES is None:
    pytest.skip(NOT_HERE, allow_module_level=True)

OWN = {
    "ISO5436-sample1.x3p": {},
    "KautschukInfiniteFocus.x3p": {},
    "derived_al3d_crop.xyz": {},
    "derived_di3_nm.npy": {"unit": "nm", "size": "10 um"},
    "derived_top1.nc": {},
    "gwyddion-export-german.txt": {},
    "matrix-3.txt": {},
    "sur-2.sur": {},
    "derived_frt2_masked.gwy": {},
    "tmd-1.tmd": {},
}
FOREIGN = {
    "AR_20211011.ibw": {},
    "Park_20210916_034.tiff": {},
    "al3d-1.al3d": {},
    "derived_mi1.mat": {"unit": "m", "size": (20e-6, 20e-6)},
    "di-3.di": {},
    "frt-2.frt": {},
    "image.nid": {},
    "mi-1.mi": {},
    "sample_0.jpk-qi-image": {},
    "test_1.opd": {},
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
    # Spikes and streaks that are in the measurement.
    "derived_frt2_masked.gwy": "24 points lie more than 100 interquartile ranges",
    "frt-2.frt": "28 points lie more than 100 interquartile ranges",
    "sur-2.sur": "18 spikes of 59 cells",
    "KautschukInfiniteFocus.x3p": "1 spike of 4 cells",
    "test_1.opd": "2 spikes of 10 cells",
    "mi-1.mi": "9 spikes of 75 cells and 7 streaks of 336 cells",
    "derived_mi1.mat": "9 spikes of 75 cells and 7 streaks of 336 cells",
}
# A derived file lies as the file it was made from: its corners serve where the manifest has none.
TWIN = {"derived_di3_nm.npy": "di-3.di", "derived_mi1.mat": "mi-1.mi"}
# The manifest's mean of this one counts the missing points as heights: only differences can be compared.
OTHER_MEAN = {"sur-2.sur"}


@pytest.fixture(scope="module")
def surfaces():
    return SURFACES


@pytest.fixture(scope="module")
def manifest():
    with open(SURFACES / "MANIFEST.csv", newline="", encoding="utf-8") as lines:
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
    said = [
        one for one in said if "dateutil" not in one.filename
    ]  # a time zone, of which we know nothing either
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
    assert set(manifest) == set(OWN) | set(FOREIGN) | refused == set(TWINS)


def test_a_line_scan_is_read_when_asked_for(surfaces, manifest):
    path = surfaces / "dektak-1.csv"
    with pytest.raises(rc.ReadError, match=r"dektak-1\.csv: it is a profile of 9600 heights.*by read_line"):
        rc.read(path)
    row = manifest["dektak-1.csv"]
    line = read_line(path)
    assert line.grid.shape == (int(row["nx"]),)
    np.testing.assert_allclose(line.rms * 1e9, float(row["rms_nm_A"]), rtol=1e-6)
    # The manifest counts from the first point to the last.
    np.testing.assert_allclose(line.grid.spacing[0] * 9599 * 1e6, float(row["lx_um"]), rtol=1e-6)


def test_arbitrary_units_are_refused_by_name(surfaces, manifest):
    path = surfaces / "rsciio_test_surface_au.sur"
    row = manifest[path.name]
    with pytest.raises(rc.ReadError, match=r"rsciio_test_surface_au\.sur: it states heights in 'a\.u\.'"):
        rc.read(path)
    # The manifest's raw numbers, when the user says what they mean.
    surface = rc.read(path, unit="nm")
    assert surface.grid.shape == (int(row["ny"]), int(row["nx"]))
    assert f"raw {surface.rms * 1e9:.4f} (no unit)" == row["rms_nm_A"]
    np.testing.assert_allclose(surface.grid.lengths[1] * 1e6, float(row["lx_um"]), rtol=1e-6)


@pytest.mark.filterwarnings("ignore:tzname CEST")
def test_another_channel_is_taken_when_named(surfaces):
    pytest.importorskip("SurfaceTopography")
    surface = rc.read(surfaces / "di-3.di", channel="height")
    np.testing.assert_allclose(surface.rms * 1e9, 264.002853, rtol=1e-6)  # the manifest's second height
    assert "channel 'Height'" in surface.provenance[0]
    with pytest.warns(SurfaceWarning, match="1 spike of 2 cells"):
        second = rc.read(surfaces / "sample_0.jpk-qi-image", channel="Height (measured)#2")
    with pytest.warns(SurfaceWarning, match="1 spike of 2 cells"):
        first = rc.read(surfaces / "sample_0.jpk-qi-image", channel=1)
    assert np.array_equal(second.heights, first.heights)


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
    with pytest.warns(SurfaceWarning, match="as given, instead of the file's") as spoken:
        given = rc.read(surfaces / "tmd-1.tmd", unit="um", size=("18.9566 um", "18.9566 um"))
    assert len(spoken) == 2
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
