"""The guard before SurfaceTopography, on small files written here."""

import hashlib
import io
import logging
import sys
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.io import savemat

import roughcontact as rc
from instruments import TEXT, hills, tiff
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_either

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


def test_only_texts_are_tried_as_texts(put):
    """The readers of texts pass over the lines above a table, whatever these hold."""
    table = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n"
    for encoding in ("utf-8", "utf-16"):
        with pytest.raises(rc.ReadError, match=r"it is a text of numbers; rename it"):
            rc.read(put("a.dat", table.encode(encoding)), unit="um", size=1e-5)
    with pytest.raises(rc.ReadError, match="its format is not recognised"):
        rc.read(put("a.dat", b"a mark\0 of some length\n" + table.encode()), unit="um", size=1e-5)


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


@pytest.mark.parametrize(
    "tag", [(50432, 3, [1]), (0x8000, 3, [1]), (0x8050, 3, [1]), (270, TEXT, b"TiffTagDescData\0")]
)
def test_a_file_of_an_instrument_is_not_read_as_grey_values(put, tag):
    """Park, JPK and Olympus state the unit and the size in tags of their own: these files have nothing else of them."""
    pytest.importorskip("tifffile")
    path = put("a.tif", tiff(np.rint(hills() * 100 + 400).astype("u2"), tags=[tag]))
    for reader in (lambda: rc.read(path, unit="nm", size=1e-5), lambda: channels(path)):
        with pytest.raises(rc.ReadError, match="it holds no channel that can be read; export it"):
            reader()


class ByName:
    """A reader that knows its format by the extension, as some libraries do."""

    def __init__(self, stream):
        if not stream.name.endswith(".known"):
            raise ValueError(stream.name)
        self.name = stream.name
        self.heights = np.frombuffer(stream.read(), "<f8").reshape(3, 4)

    @classmethod
    def format(cls):
        return "known"

    @classmethod
    def can_read(cls, _):
        from SurfaceTopography.IO import MagicMatch

        return MagicMatch.MAYBE

    @property
    def channels(self):
        return [
            SimpleNamespace(
                nb_grid_pts=(3, 4),
                physical_sizes=None,
                unit=None,
                data_unit=None,
                name=self.name,
                is_periodic=False,
            )
        ]

    def topography(self, **_):
        return SimpleNamespace(heights=lambda: self.heights)

    def close(self):
        pass


@pytest.mark.parametrize("name", ["a.known", "A.KNOWN", "../evil; rm.known", "a b.known"])
def test_a_format_known_by_its_extension_is_reached(put, tmp_path, monkeypatch, name):
    """Under a name that holds nothing of the user's but the extension."""
    import SurfaceTopography.IO

    monkeypatch.setattr(SurfaceTopography.IO, "readers", [ByName])
    (channel,) = channels(put(name.replace("/", "_"), HEIGHTS.astype("<f8").tobytes()))
    assert (channel.name, channel.shape) == ("surface.known", (4, 3))
    with pytest.raises(rc.ReadError, match="not recognised"):
        rc.read(put("a.kn\u00f6wn", HEIGHTS.tobytes()), **{"unit": "um", "size": 1e-5})


@pytest.mark.parametrize(
    ("content", "advised"),
    [
        (b"width = 4 um\nheight = 3 um\nunit = nm\n1 2 3 4\n5 6 7 8\n9 1 2 3\n", ".txt"),
        (b"X;Y;valid\n[mm];[um];[1/0]\n0;1;1\n1;2;1\n2;1;0\n3;1;1\n", ".txt"),
        (b"X;Y;valid\n[mm];[um];[1/0]\n0,0;1,5;1\n1,0;2,5;1\n2,0;1,5;0\n", ".txt"),
        (b"# x [um] y [um] z [um]\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n", ".xyz"),
    ],
)
def test_a_text_under_another_extension_is_read_under_the_one_that_is_advised(put, content, advised):
    with pytest.raises(rc.ReadError, match=r"name") as refused:
        rc.read(put("a.dat", content))
    assert advised in refused.value.remedy
    read_either(put(f"a{advised}", content))


@pytest.mark.parametrize("kind", [".npy", ".npz", ".x3p"])
def test_a_file_of_ours_under_another_extension_is_read_under_the_one_that_is_advised(tmp_path, put, kind):
    rc.write(rc.shapes.paraboloid(rc.Grid((8, 8), 1e-6), 1e-4), tmp_path / f"a{kind}")
    with pytest.raises(rc.ReadError, match="its extension does not fit its format, which may be") as refused:
        rc.read(put("a.dat", (tmp_path / f"a{kind}").read_bytes()))
    assert refused.value.remedy.startswith(f"rename it to {kind} ")


def test_an_extension_without_a_mark_goes_before_what_the_bytes_look_like(put):
    """A terrain that another reader takes for a text: 8224 m are two blanks, 12592 m are "10"."""
    terrain = np.full((20, 20), 0x2020, ">i2")
    terrain[:, ::2] = 0x3130
    surface = rc.read(put("a.hgt", terrain.tobytes()), unit="nm", size=1e-3)
    assert {0x2020, 0x3130} == set(np.rint(surface.heights * 1e9).astype(int).ravel().tolist())


def test_what_is_read_is_what_was_hashed(put, monkeypatch):
    """Whatever happens to the file meanwhile."""
    import SurfaceTopography.IO

    first, second = (mat(Z=values) for values in (HEIGHTS, HEIGHTS + 1))
    path = put("a.mat", first)
    original = SurfaceTopography.IO.open_topography

    def swapped(*arguments, **keywords):
        path.write_bytes(second)
        return original(*arguments, **keywords)

    monkeypatch.setattr(SurfaceTopography.IO, "open_topography", swapped)
    surface = rc.read(path, unit="um", size=1e-5)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-15)
    assert hashlib.sha256(first).hexdigest()[:16] in surface.provenance[0]


def test_reading_switches_nothing_of_the_process(put, monkeypatch):
    """Seen from inside the reader: what other threads print, log and warn goes its usual way."""
    import SurfaceTopography.IO

    path = put("a.mat", mat(Z=HEIGHTS))
    original = SurfaceTopography.IO.open_topography
    seen = []

    def switches():
        return (
            sys.stdout,
            sys.stderr,
            logging.root.manager.disable,
            warnings.showwarning,
            list(warnings.filters),
        )

    def looked(*arguments, **keywords):
        seen.append(switches())
        return original(*arguments, **keywords)

    monkeypatch.setattr(SurfaceTopography.IO, "open_topography", looked)
    before = switches()
    rc.read(path, unit="um", size=1e-5)
    channels(path)
    assert seen == [before, before]


def test_only_the_reading_thread_is_spared_the_log(put, monkeypatch, caplog):
    import SurfaceTopography.IO

    def speak(*_, **__):
        logging.getLogger("tifffile").error("of the reader")
        other = threading.Thread(target=logging.getLogger("tifffile").error, args=("of another thread",))
        other.start()
        other.join()
        raise ValueError("damaged")

    monkeypatch.setattr(SurfaceTopography.IO, "open_topography", speak)
    with pytest.raises(rc.ReadError, match="damaged"):
        rc.read(put("a.opd", "II"), unit="um", size=1e-5)
    assert [record.message for record in caplog.records] == ["of another thread"]


def test_threads_leave_the_process_as_it_was(put):
    paths = [put(f"{k}.mat", mat(Z=HEIGHTS + k)) for k in range(4)]
    before = sys.stdout, logging.root.manager.disable, list(warnings.filters)

    def read(k):
        return [rc.read(paths[k], unit="um", size=1e-5).heights for _ in range(3)]

    with ThreadPoolExecutor(4) as pool:
        for k, maps in enumerate(pool.map(read, range(4))):
            for heights in maps:
                np.testing.assert_allclose(heights, (HEIGHTS + k) * 1e-6, rtol=1e-15)
    assert before == (sys.stdout, logging.root.manager.disable, list(warnings.filters))


@pytest.mark.parametrize("name", ["job.toml", "curve.json"])
def test_a_job_or_a_result_is_no_surface_and_the_remedy_names_run(put, name):
    with pytest.raises(rc.ReadError, match="repeated by 'roughcontact run'"):
        rc.read(put(name, b'job = "press"'))
