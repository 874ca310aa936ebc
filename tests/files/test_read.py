"""The keywords of `read`, its errors and its warnings."""

import hashlib
import os
import pickle
import re
import subprocess
import sys

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels

TEXT = "1 2 3 4\n5 6 7 8\n"


def test_a_missing_file_a_folder_and_an_empty_file(tmp_path, put):
    for function in (rc.read, channels):
        with pytest.raises(
            rc.ReadError, match=r"nowhere\.x3p: it cannot be opened \(No such file.*check the path"
        ):
            function(tmp_path / "nowhere.x3p")
        with pytest.raises(rc.ReadError, match="it is a folder; name a file in it"):
            function(tmp_path)
        with pytest.raises(rc.ReadError, match="cannot be opened"):
            function(str(tmp_path / "a\0b.txt"))
        for name in ("a.npy", "a.npz", "a.txt", "a.xyz", "a.x3p", "a.opd", "a.hgt", "a"):
            with pytest.raises(rc.ReadError, match=f"{name}: it is empty"):
                function(put(name, ""))


@pytest.mark.parametrize(
    ("size", "spacing"),
    [
        (8e-6, (2e-6, 2e-6)),
        ("8 um", (2e-6, 2e-6)),
        ((4e-6, 12e-6), (2e-6, 3e-6)),
        (["4um", "0.012 mm"], (2e-6, 3e-6)),
        (np.array([4e-6, 12e-6]), (2e-6, 3e-6)),
    ],
)
def test_size_is_a_width_or_y_and_x(put, size, spacing):
    surface = rc.read(put("a.txt", TEXT), unit="nm", size=size)
    np.testing.assert_allclose(surface.grid.spacing, spacing, rtol=1e-15)


@pytest.mark.parametrize("unit", ["µm", "μm", "um", "micron", " um ", 1e-6])
def test_one_unit_by_all_its_names(put, unit):
    surface = rc.read(put("a.txt", TEXT), unit=unit, size=1e-3)
    np.testing.assert_allclose(surface.heights[0], np.arange(1, 5) * 1e-6, rtol=1e-15)


@pytest.mark.parametrize(
    "keywords",
    [
        {"unit": "V", "size": 1e-3},
        {"unit": "A", "size": 1e-3},
        {"unit": 0.0, "size": 1e-3},
        {"unit": np.nan, "size": 1e-3},
        {"unit": "um", "size": 0},
        {"unit": "um", "size": -1e-3},
        {"unit": "um", "size": "10"},
        {"unit": "um", "size": "ten um"},
        {"unit": "um", "size": "10 s"},
        {"unit": "um", "size": (1e-3,)},
        {"unit": "um", "size": (1e-3, np.inf)},
        {"unit": "um", "size": (1e-3, 1e-3, 1e-3)},
    ],
)
def test_a_wrong_keyword_is_an_error_before_the_file_is_touched(tmp_path, keywords):
    with pytest.raises(ValueError, match=r"unit|length|size") as caught:
        rc.read(tmp_path / "nowhere.txt", **keywords)
    assert not isinstance(caught.value, rc.ReadError)


def test_the_users_word_goes_before_the_files(put):
    header = "# Width: 4 mm\n# Height: 2 mm\n# Value units: nm\n"
    path = put("a.txt", header + TEXT)
    with pytest.warns(SurfaceWarning, match="as given, instead of the file's") as spoken:
        given = rc.read(path, unit="um", size=(2e-6, 8e-6))
    assert len(spoken) == 2
    np.testing.assert_allclose(given.heights[0, 0], 1e-6, rtol=1e-15)
    np.testing.assert_allclose(given.grid.spacing, (1e-6, 2e-6), rtol=1e-15)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:16]
    assert given.provenance == (
        f"read from a.txt (text with a header, sha256 {digest})",
        "unit of the heights um as given, instead of the file's nm",
        "size 2e-06 x 8e-06 m (y, x) as given, instead of the file's 0.002 x 0.004",
    )
    assert len(rc.read(path).provenance) == 1
    # Who repeats the file's own words hears nothing: a warning would be an error here.
    assert rc.read(path, unit=1e-9, size=("2 mm", "4 mm")).grid == rc.read(path).grid


def test_a_file_with_one_map_has_one_channel(put):
    path = put("a.txt", "# Channel: Z\n" + TEXT)
    assert rc.read(path, channel="Z", unit="um", size=1e-3).grid.shape == (2, 4)
    with pytest.raises(rc.ReadError, match=r"no channel 'Height', only 'Z' \(2 x 4, no unit\)"):
        rc.read(path, channel="Height", unit="um", size=1e-3)
    (channel,) = channels(path)
    assert (channel.name, channel.shape, channel.unit, channel.size, channel.is_height) == (
        "Z",
        (2, 4),
        None,
        None,
        True,
    )


@pytest.mark.parametrize(
    ("unit", "size", "message"),
    [
        ("pm", 4e-10, "a surface of 2e-10 m x 4e-10 m is unusual; check size="),
        ("nm", 10.0, "a surface of 5 m x 10 m is unusual"),
        ("m", 0.5, "heights up to 8 m are unusual; check unit="),
        ("cm", 1e-4, "an rms height of 0.0229 m on 5e-05 m is unusual"),
    ],
)
def test_absurd_sizes_and_heights_are_warned_of_not_refused(put, unit, size, message):
    with pytest.warns(SurfaceWarning, match=f"a.txt: {message}") as caught:
        surface = rc.read(put("a.txt", TEXT), unit=unit, size=size)
    assert caught[0].filename == __file__
    assert any(message in line for line in surface.provenance)


@pytest.mark.filterwarnings("ignore::roughcontact.files.file_errors.SurfaceWarning")
def test_heights_beyond_all_measure_are_warned_of_or_refused_without_noise(put):
    assert rc.read(put("a.txt", "1e5 2\n3 4\n"), unit="m", size=1e-3).grid.shape == (2, 2)
    with pytest.raises(rc.ReadError, match=r"a\.txt: it holds heights up to 1e\+300 m.*unit="):
        rc.read(put("a.txt", "1e300 2\n3 4\n"), unit="m", size=1e-3)
    with pytest.raises(rc.ReadError, match=r"a\.txt: .*infinite"):
        rc.read(put("a.txt", "1e308 2\n3 4\n"), unit="km", size=1e-3)


def test_a_sane_surface_raises_no_warning(put):
    rc.read(put("a.txt", TEXT), unit="um", size=1e-3)  # a warning would be an error here


def test_the_error_keeps_its_parts_and_can_be_sent_between_processes():
    error = rc.ReadError("a.txt", "it is odd", "make it even")
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == "a.txt: it is odd; make it even"
    assert (copy.file, copy.problem, copy.remedy) == ("a.txt", "it is odd", "make it even")
    assert isinstance(copy, ValueError)


def test_without_the_other_library_the_remedy_is_named(put, monkeypatch):
    for name in [n for n in sys.modules if n.split(".")[0] == "SurfaceTopography"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    with pytest.raises(rc.ReadError, match=r"a\.opd: .*-m pip install 'roughcontact\[formats\]'"):
        rc.read(put("a.opd", b"anything"))
    with pytest.raises(rc.ReadError, match=f"run: {re.escape(sys.executable)} -m pip"):
        rc.read(put("a.opd", b"anything"))


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names of files are letters there")
def test_a_name_that_is_no_text_reads_and_leaves_text(tmp_path):
    path = os.fsencode(tmp_path / "r") + b"\xff.txt"
    with open(path, "w") as stream:
        stream.write(TEXT)
    surface = rc.read(os.fsdecode(path), unit="um", size=1e-3)
    assert surface.provenance[0].startswith("read from r?.txt (")


def test_reading_needs_no_heavy_library():
    code = (
        "import sys, roughcontact as rc; rc.read; "
        "assert not {'SurfaceTopography', 'xarray', 'matplotlib', 'pint', 'h5py'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("side", [1e-310, 1e-120, 1e120])
def test_cells_of_a_size_that_cannot_be_are_those_of_the_file(tmp_path, side):
    """The file is named, and the remedy reads it."""
    file = tmp_path / "part.gsf"
    sides = f"XReal = {4 * side}\nYReal = 4e-6\nZUnits = m\nXYUnits = m\n"
    header = f"Gwyddion Simple Field 1.0\nXRes = 4\nYRes = 4\n{sides}".encode()
    numbers = 1e-7 * np.arange(16, dtype="<f4")
    file.write_bytes(header + bytes(4 - len(header) % 4) + numbers.tobytes())
    with pytest.raises(rc.ReadError, match=r"^part\.gsf: it states cells of .*; pass size="):
        rc.read(file)
    with pytest.warns(SurfaceWarning, match="as given, instead of the file's"):
        assert rc.read(file, size=("4 um", "4 um")).grid.spacing == (1e-6, 1e-6)
