"""Surfaces and solutions written, and read back to the last bit."""

import hashlib
import struct
import tempfile
import warnings
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

import numpy as np
import pytest
import xarray
from hypothesis import given, settings, strategies as st
from hypothesis.extra import numpy as hnp

import roughcontact as rc
from roughcontact.evaluation.interface_calculix import calculix_text
from roughcontact.evaluation.interface_columns import column_text, moose_text
from roughcontact.evaluation.interface_text import abaqus_text, lammps_text
from roughcontact.files.aside import WriteError
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import read_line
from roughcontact.files.save import require_surface_file, write
from tables import read_table

RNG = np.random.default_rng(8)


@pytest.fixture(scope="module")
def surface():
    heights = 1e-6 * RNG.standard_normal((9, 14))
    heights[2, 3] = np.nan
    return rc.Surface(heights, rc.Grid((9, 14), (1e-6 / 3, 2e-6 / 7), (True, False)), ("made", "say <b> & c"))


@pytest.fixture(scope="module")
def solution():
    grid = rc.Grid((12, 20), (1e-6, 2e-6))
    return rc.press(rc.Surface(1e-7 * RNG.standard_normal(grid.shape), grid, ("made",)), 1e10, force=1e-3)


@pytest.mark.parametrize("suffix", [".npz", ".nc", ".x3p", ".NPZ"])
def test_a_surface_comes_back_to_the_last_bit(tmp_path, surface, suffix):
    path = tmp_path / f"a{suffix}"
    write(surface, path)
    back = rc.read(path)
    assert np.array_equal(back.heights, surface.heights, equal_nan=True)
    assert back.grid.spacing == surface.grid.spacing
    if suffix != ".x3p":  # which has no place for them
        assert back.grid == surface.grid
        assert back.provenance[:2] == surface.provenance
    assert back.provenance[-1].startswith(f"read from a{suffix} (")
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", [".npz", ".nc", ".x3p"])
def test_a_line_comes_back_to_the_last_bit(tmp_path, suffix):
    line = rc.Surface(RNG.standard_normal(30) * 1e-6, rc.Grid(30, 1e-6 / 3))
    write(line, tmp_path / f"a{suffix}")
    back = read_line(tmp_path / f"a{suffix}")
    assert np.array_equal(back.heights, line.heights)
    assert back.grid == line.grid


MAPS = hnp.arrays(
    np.float64,
    hnp.array_shapes(min_dims=2, max_dims=2, min_side=2, max_side=5),
    elements=st.floats(-1e-3, 1e-3, width=64) | st.just(np.nan),
).filter(lambda a: not np.isnan(a).all() and not 0 < np.nanmax(a) - np.nanmin(a) < 1e-50)


@settings(max_examples=25, deadline=None)
@given(heights=MAPS, step=st.floats(1e-3, 1e-2), suffix=st.sampled_from([".npz", ".nc", ".x3p"]))
def test_whatever_is_written_is_read(heights, step, suffix):
    surface = rc.Surface(heights, rc.Grid(heights.shape, (step, step / 3)))
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", SurfaceWarning)  # of heights that no instrument sees
        write(surface, Path(folder) / f"a{suffix}")
        back = rc.read(Path(folder) / f"a{suffix}")
    assert np.array_equal(back.heights, heights, equal_nan=True)
    assert back.grid == surface.grid


def test_a_text_holds_every_digit_and_its_header(tmp_path, surface):
    write(surface, tmp_path / "a.txt")
    back = rc.read(tmp_path / "a.txt")
    assert np.array_equal(back.heights, surface.heights, equal_nan=True)
    # Lengths are written, cells are read: two roundings.
    np.testing.assert_allclose(back.grid.spacing, surface.grid.spacing, rtol=4e-16)
    lines = (tmp_path / "a.txt").read_text(encoding="utf-8").splitlines()
    rows = f"# Rows: {len(surface.heights)}"
    assert lines[3:7] == ["# Value units: m", rows, "# History: made", "# History: say <b> & c"]
    np.testing.assert_array_equal(np.loadtxt(tmp_path / "a.txt"), surface.heights)


def test_the_other_library_reads_our_text(tmp_path, surface):
    topography = pytest.importorskip("SurfaceTopography")
    write(surface.filled(), tmp_path / "a.txt")
    theirs = topography.read_topography(str(tmp_path / "a.txt"))
    assert theirs.unit == "m"
    np.testing.assert_array_equal(theirs.heights().T, surface.filled().heights)
    np.testing.assert_allclose(theirs.physical_sizes, surface.grid.lengths[::-1], rtol=1e-12)


def test_a_line_as_text_is_places_and_heights(tmp_path):
    line = rc.Surface(RNG.standard_normal(30) * 1e-6, rc.Grid(30, 1e-6 / 3), ("made",))
    write(line, tmp_path / "a.txt")
    back = read_line(tmp_path / "a.txt")
    assert np.array_equal(back.heights, line.heights)
    # The step is the difference of the ends over their number: an error of an ulp of the last place.
    np.testing.assert_allclose(back.grid.spacing, line.grid.spacing, rtol=1e-15)


def test_npy_holds_heights_and_nothing_else(tmp_path, surface):
    write(surface, tmp_path / "a.npy")
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), surface.heights)
    with pytest.raises(rc.ReadError, match="no unit of its heights and no size"):
        rc.read(tmp_path / "a.npy")


def test_what_can_be_written_is_known_before_the_work(tmp_path):
    require_surface_file(tmp_path / "a.NC")
    for name, message in (
        ("a.gwy", "written as one of"),
        ("no/a.npz", "no folder"),
        (".", "written as one of"),
    ):
        with pytest.raises(WriteError, match=message):
            require_surface_file(tmp_path / name)
    (tmp_path / "b.npz").mkdir()
    with pytest.raises(WriteError, match="it is a folder"):
        require_surface_file(tmp_path / "b.npz")


def test_x3p_carries_its_checksums(tmp_path, surface):
    write(surface, tmp_path / "a.x3p")
    with zipfile.ZipFile(tmp_path / "a.x3p") as archive:
        main, points = archive.read("main.xml"), archive.read("bindata/data.bin")
        assert archive.read("md5checksum.hex").split() == [
            hashlib.md5(main).hexdigest().encode(),
            b"*main.xml",
        ]
    root = ElementTree.fromstring(main)
    assert root.findtext("Record3/DataLink/MD5ChecksumPointData") == hashlib.md5(points).hexdigest().upper()
    assert root.findtext("Record2/Comment") == "made; say <b> & c"
    assert points == surface.heights.tobytes()


def test_the_other_library_reads_our_x3p(tmp_path, surface):
    topography = pytest.importorskip("SurfaceTopography")
    write(surface, tmp_path / "a.x3p")
    theirs = topography.read_topography(str(tmp_path / "a.x3p"))
    heights = np.ma.filled(theirs.heights(), np.nan).T
    assert np.array_equal(heights, surface.heights, equal_nan=True)
    np.testing.assert_allclose(theirs.physical_sizes, surface.grid.lengths[::-1], rtol=1e-12)


def vti(path):
    """Return (attributes of the image, fields) of a file, parsed by its own few lines."""
    data = path.read_bytes()
    head, _, rest = data.partition(b'<AppendedData encoding="raw">\n_')
    root = ElementTree.fromstring(head + b"<AppendedData/></VTKFile>")
    image = root.find("ImageData")
    fields = {}
    for array in image.iter("DataArray"):
        start = int(array.get("offset"))
        (size,) = struct.unpack_from("<Q", rest, start)
        kind = {"Float64": "<f8", "UInt8": "u1"}[array.get("type")]
        fields[array.get("Name")] = np.frombuffer(rest[start + 8 : start + 8 + size], kind)
    assert rest[start + 8 + size :] == b"\n</AppendedData>\n</VTKFile>\n"
    return image.attrib, fields


def test_paraview_gets_an_upright_picture(tmp_path, solution):
    write(solution, tmp_path / "a.vti")
    image, fields = vti(tmp_path / "a.vti")
    assert image["WholeExtent"] == "0 20 0 12 0 0"
    assert [float(step) for step in image["Spacing"].split()][:2] == [2e-6, 1e-6]
    for name in ("heights", "pressure", "displacement", "gap", "contact"):
        expected = getattr(solution, name, solution.problem.surface.heights)
        assert np.array_equal(fields[name].reshape(12, 20)[::-1], expected)


def test_paraview_gets_surfaces_and_lines(tmp_path, surface):
    write(surface, tmp_path / "a.vti")
    image, fields = vti(tmp_path / "a.vti")
    assert image["WholeExtent"] == "0 14 0 9 0 0"
    assert np.array_equal(fields["heights"].reshape(9, 14)[::-1], surface.heights, equal_nan=True)
    write(rc.Surface(np.arange(5.0), rc.Grid(5, 1e-6)), tmp_path / "b.vti")
    image, fields = vti(tmp_path / "b.vti")
    assert image["WholeExtent"] == "0 5 0 0 0 0"
    assert np.array_equal(fields["heights"], np.arange(5.0))


def test_the_surface_of_a_solution_is_read_from_its_netcdf(tmp_path, solution):
    write(solution, tmp_path / "a.nc")
    back = rc.read(tmp_path / "a.nc")
    assert np.array_equal(back.heights, solution.problem.surface.heights)
    assert back.grid == solution.problem.grid
    assert back.provenance[0] == "made"
    pressure = rc.read(tmp_path / "a.nc", channel="gap")
    assert np.array_equal(pressure.heights, solution.gap)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("a.csv", "written as one of .npz, .nc, .x3p, .txt, .npy, .vti"),
        ("a", "written as one of"),
        ("no/a.npz", "no folder"),
    ],
)
def test_what_cannot_be_written_is_refused(tmp_path, surface, name, message):
    with pytest.raises(WriteError, match=message):
        write(surface, tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_solution_is_no_x3p(tmp_path, solution):
    with pytest.raises(WriteError, match=r"one of \.nc, \.vti; write solution\.problem\.surface"):
        write(solution, tmp_path / "a.x3p")
    with pytest.raises(WriteError, match="a ndarray"):
        write(np.eye(3), tmp_path / "a.npz")


def test_a_failure_leaves_the_old_file(tmp_path, surface, monkeypatch):
    write(surface, tmp_path / "a.x3p")
    before = (tmp_path / "a.x3p").read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(WriteError, match="No space left"):
        write(surface, tmp_path / "a.x3p")
    assert (tmp_path / "a.x3p").read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["a.x3p"]


def test_equal_surfaces_give_equal_npz_and_vti(tmp_path, surface):
    for suffix in (".npz", ".vti"):
        write(surface, tmp_path / f"a{suffix}")
        write(surface, tmp_path / f"b{suffix}")
        assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_a_curve_is_written_and_can_be_opened(tmp_path):
    grid = rc.Grid((24, 24), 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    curve = rc.loading_curve(rough, 1e11, forces=[1e-3, 1e-2])
    rc.write(curve, tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc", engine="h5netcdf") as dataset:
        np.testing.assert_array_equal(dataset.stiffness, curve.stiffness)
    rc.write(curve, tmp_path / "curve.csv")
    header = (tmp_path / "curve.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
    assert {"force", "depth", "stiffness"} <= {title.partition(" [")[0] for title in header}
    assert header[-1] == "status"  # words go last
    with pytest.raises(rc.WriteError, match=r"a Curve is written as one of \.nc, \.csv"):
        rc.write(curve, tmp_path / "curve.vti")


def test_the_table_of_an_interface_is_written_for_other_programs(tmp_path):
    grid = rc.Grid((48, 48), 1e-6, periodic=True)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0), short_cutoff=8e-6)
    table = rc.interface_table(rc.loading_curve(rough, 1e11, pressures=[1e8, 3e8, 1e9]))
    for name in ("a.csv", "a.inp", "a.table"):
        rc.write(table, tmp_path / name)
    columns = read_table(tmp_path / "a.csv")
    np.testing.assert_array_equal(columns["nominal_pressure"], table.pressure)
    np.testing.assert_array_equal(columns["overclosure"], table.overclosure)
    assert (tmp_path / "a.inp").read_text(encoding="utf-8") == abaqus_text(table)
    rc.write(table, tmp_path / "mm.inp", units="mm")
    assert (tmp_path / "mm.inp").read_text(encoding="utf-8") == abaqus_text(table, units="mm")
    for name, units in (("a.csv", "mm"), ("a.inp", "inch")):
        with pytest.raises(rc.InputError, match=f"{name} is not written in the units '{units}'"):
            rc.write(table, tmp_path / name, units=units)
    assert (tmp_path / "a.table").read_text(encoding="utf-8") == lammps_text(table)
    for name, text, how in (
        ("c.inp", calculix_text(table), {"dialect": "calculix"}),
        ("d.inp", calculix_text(table, units="mm"), {"dialect": "calculix", "units": "mm"}),
        ("e.inp", abaqus_text(table), {"dialect": "abaqus"}),
        ("f.csv", moose_text(table), {"dialect": "moose"}),
        ("g.txt", column_text(table), {}),
    ):
        rc.write(table, tmp_path / name, **how)
        assert (tmp_path / name).read_text(encoding="utf-8") == text
    with pytest.raises(
        rc.InputError, match=r"c\.inp is not written in the dialect 'moose': choose abaqus or cal"
    ):
        rc.write(table, tmp_path / "c.inp", dialect="moose")
    with pytest.raises(rc.InputError, match="only the table of an interface has dialects"):
        rc.write(rough, tmp_path / "a.npz", dialect="calculix")
    with pytest.raises(
        WriteError, match=r"a InterfaceTable is written as one of \.csv, \.inp, \.table, \.txt"
    ):
        rc.write(table, tmp_path / "a.nc")
