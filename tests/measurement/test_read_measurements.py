"""Many measurements of one surface are read from a container, a folder or files; what cannot be one surface is not."""

import io
import json
import zipfile

import numpy as np
import pytest

import roughcontact as rc

PLACES = {f"place {k}": rc.self_affine(rc.Grid((64, 48), (2e-6, 1e-6)), 0.8, 1e-7, k) for k in range(3)}
LINE = rc.self_affine(rc.Grid(256, 1e-6), 0.8, 1e-7, 1)
AFM = {"name": "AFM", "type": "contact-based", "parameters": {"tip_radius": {"value": 20, "unit": "nm"}}}
SCOPE = {"type": "microscope-based", "parameters": {"resolution": {"value": 6, "unit": "um"}}}


def stored(surface):
    stream = io.BytesIO()
    periodic, spacing = surface.grid.periodic, surface.grid.spacing
    np.savez(stream, heights=surface.heights, unit="m", spacing=spacing, periodic=periodic)
    return stream.getvalue()


def container(path, surfaces):
    """Write surfaces, each a mapping of names to heights and to what is stated about them."""
    index, files = [], {}
    for owner, measurements in surfaces.items():
        topographies = []
        for name, (surface, stated) in measurements.items():
            file = f"{len(files)}.npz"
            files[file] = surface if isinstance(surface, bytes) else stored(surface)
            topographies.append({"name": name, "datafile": {"original": file}} | stated)
        index.append({"name": owner, "topographies": topographies})
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("index.json", json.dumps({"surfaces": index}))
        for file, data in files.items():
            archive.writestr(file, data)
    return path


def part(instrument=None):
    stated = {} if instrument is None else {"instrument": instrument}
    return {name: (surface, stated) for name, surface in PLACES.items()}


def test_a_container_holds_maps_profiles_and_instruments(tmp_path):
    measured = part(AFM) | {"line": (LINE, {"instrument": SCOPE})}
    many = rc.read_measurements(container(tmp_path / "part.zip", {"part": measured}))
    assert many.surface == "part"
    assert [one.name for one in many] == [*PLACES, "line"]
    for one, surface in zip(many, [*PLACES.values(), LINE], strict=True):
        np.testing.assert_allclose(one.surface.heights, surface.heights, rtol=1e-12)
        assert one.surface.grid == surface.grid
    first, line = many.measurements[0].instrument, many.measurements[-1].instrument
    assert (first.name, first.tip_radius, first.resolution) == ("AFM", pytest.approx(20e-9), None)
    assert (line.name, line.resolution) == ("microscope-based", pytest.approx(6e-6))
    assert many.measurements[-1].limited_by == "resolution"
    assert many.combined_spectrum().kind == "C1D"


def test_stated_instruments_are_replaced_and_repeats_are_one_measurement(tmp_path):
    path = container(tmp_path / "part.zip", {"part": part(AFM)})
    scope = rc.Instrument("scope", resolution=7e-6)
    again = rc.read_measurements(path, instruments={"place 1": scope}, repeats=[("place 0", "place 2")])
    assert [(one.name, one.instrument.name, len(one.repeats)) for one in again] == [
        ("place 0", "AFM", 1),
        ("place 1", "scope", 0),
    ]
    assert again.measurements[0].noise_found == "repeats"


def test_one_of_several_surfaces_is_named(tmp_path):
    path = container(tmp_path / "two.zip", {"left": part(), "right": {"line": (LINE, {})}})
    with pytest.raises(rc.InputError, match=r"2 surfaces: name one by surface=, of 'left', 'right'"):
        rc.read_measurements(path)
    assert [one.name for one in rc.read_measurements(path, surface="right")] == ["line"]
    assert len(rc.read_measurements(path, surface="left")) == 3


def test_a_folder_and_a_list_of_files(tmp_path):
    for name, surface in PLACES.items():
        rc.write(surface, tmp_path / f"{name}.npz")
    (tmp_path / "notes.docx").write_text("hello")
    (tmp_path / ".hidden.npz").write_text("")
    (tmp_path / "older.npz").mkdir()
    folder = rc.read_measurements(tmp_path)
    assert [one.name for one in folder] == [f"{name}.npz" for name in PLACES]
    assert any("notes.docx" in note for note in folder.combined_spectrum().notes)
    two = rc.read_measurements([tmp_path / "place 0.npz", tmp_path / "place 2.npz"])
    assert len(two) == 2
    assert not any("not read" in note for note in two.combined_spectrum().notes)
    assert len(rc.read_measurements(str(tmp_path / "place 0.npz"))) == 1


def test_a_map_without_units_is_named(tmp_path):
    stream = io.BytesIO()
    np.savez(stream, heights=PLACES["place 0"].heights)
    path = container(tmp_path / "part.zip", {"part": part() | {"bare": (stream.getvalue(), {})}})
    with pytest.raises(
        rc.ReadError, match=r"^bare: it states no unit.*channel=3, unit=.*rc.Measurements.of"
    ) as caught:
        rc.read_measurements(path)
    assert caught.value.place == "source"
    bare = rc.read(path, channel=3, unit="m", size=(128e-6, 48e-6))
    assert len(rc.Measurements.of(PLACES | {"bare": bare})) == 4


def test_nothing_twice_and_nothing_empty(tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(rc.InputError, match="there is no measurement to read"):
        rc.read_measurements(tmp_path / "empty")
    rc.write(LINE, tmp_path / "line.npz")
    with pytest.raises(rc.InputError, match=r"two measurements are named 'line\.npz': rename a file"):
        rc.read_measurements([tmp_path / "line.npz", tmp_path / "line.npz"])
    with pytest.raises(rc.InputError, match="no container states a surface 'x'"):
        rc.read_measurements(tmp_path / "line.npz", surface="x")
