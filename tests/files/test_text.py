"""Matrices in texts."""

import tempfile
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from hypothesis.extra import numpy as hnp

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import read_line

GIVEN = {"unit": "mm", "size": 1e-2}
VALUES = [[1.5, -2.0, 3e-3, 0.0], [4.0, 5.25, 6.0, 1.0], [7.0, 8.0, -9.0, 2.0]]
MILLI = np.array(VALUES) * 1e-3


def text(separator, decimal=".", end=""):
    return "".join(separator.join(str(v).replace(".", decimal) for v in row) + end + "\n" for row in VALUES)


@pytest.mark.parametrize(
    "content",
    [
        text(" "),
        text("   "),
        text("\t"),
        text(","),
        text(", "),
        text(";"),
        text("; "),
        text(";", decimal=","),
        text("\t", decimal=","),
        text(" ", decimal=","),
        text(",", end=","),
        text("\t", end="\t"),
        text(" ").replace("\n", "\r\n"),
        "\n# words\n\n" + text(" ") + "\n\n# end\n",
        "\ufeff" + text(" "),
    ],
)
@pytest.mark.parametrize("name", ["a.txt", "a.csv", "a.ASC", "a.tsv"])
def test_every_way_to_write_a_matrix(put, name, content):
    surface = rc.read(put(name, content), unit="mm", size="1 mm")
    np.testing.assert_allclose(surface.heights, MILLI, rtol=1e-15)


def test_utf16_and_latin1(put):
    assert rc.read(put("a.txt", text(" ").encode("utf-16")), **GIVEN).grid.shape == (3, 4)
    header = "# Breite: 4 µm\n# Höhe: 3 µm\n# Value units: µm\n"
    surface = rc.read(put("b.txt", (header + text(" ")).encode("latin-1")))
    np.testing.assert_allclose(surface.grid.spacing, (1e-6, 1e-6), rtol=1e-15)
    np.testing.assert_allclose(surface.heights, np.array(VALUES) * 1e-6, rtol=1e-15)


@pytest.mark.parametrize(
    ("width", "height", "unit"),
    [
        ("Width", "Height", "Value units"),
        ("Breite", "Höhe", "Einheit der Werte"),
        ("Breite", "Höhe", "Einheiten"),
        ("Largeur", "Hauteur", "Unités"),
    ],
)
def test_the_header_of_gwyddion(put, width, height, unit):
    header = f"# Channel: Z: one\n# {width}: 8,00 µm\n# {height}: 3000 nm\n# {unit}: nm\n"
    surface = rc.read(put("a.txt", header + text("\t")))
    np.testing.assert_allclose(surface.grid.spacing, (1e-6, 2e-6), rtol=1e-15)
    np.testing.assert_allclose(surface.heights, np.array(VALUES) * 1e-9, rtol=1e-15)
    assert "(text with a header, channel 'Z: one'," in surface.provenance[0]


def test_a_header_in_pixels_or_volts_leaves_the_size_or_unit_open(put):
    header = "# Width: 4 px\n# Height: 3 px\n# Value units: V\n"
    with pytest.raises(
        rc.ReadError, match=r"heights in 'V', which is no length.* and no size; pass unit=.*size="
    ):
        rc.read(put("a.txt", header + text(" ")))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("1 2 3 4\n1 2 3\n1 2 3 4\n", r"row 2 \(line 2\) holds 3 numbers, the first row 4; write nan"),
        ("1,2,3,\n1,2,3\n", r"row 2 \(line 2\) holds 3 numbers, the first row 4; write nan"),
        ("1,2,3\n1,2;3\n", r"row 2 \(line 2\)"),
        ("1,2\n1;2\n", r"row 2 \(line 2\) has other separators than the first row"),
        ("z[m]\n", r"row 1 \(line 1\), column 1: 'z\[m\]' is not a number"),
        ('"\n5\n', r"row 2 \(line 2\) holds 1 numbers, the first row 0"),
        ("1 2\n\n3 4\n", "line 2, empty or a comment, is a hole after row 1"),
        ("1 2\n3 4\n# second\n3 4\n", "line 3, empty or a comment, is a hole after row 2"),
        ("1 2\n3 abc\n", r"row 2 \(line 2\), column 2: 'abc' is not a number"),
        ("1 2\n3 1_000\n", "'1_000' is not a number"),
        ("1;2,5\n3;4.5\n", "decimal commas and points"),
        ("ncols 4\n1 2\n", "it does not state the number of nrows"),
        ("1 2 3 4\n", "1 x 4 heights, which is not a map"),
        ("1\n2\n3\n", "3 x 1 heights, which is not a map"),
        ("# only words\n", "holds no numbers"),
        (" \n", "holds no numbers"),
        ("1 2\n3 \0\n", "zero bytes"),
        ("1 2\n3 inf\n", "1 height is infinite"),
        ("nan nan\nnan nan\n", "all heights are NaN"),
        ("".join(f"{k} {k * k}\n" for k in range(20)), "list of coordinates"),
        ("PK\x03\x04 not a text", "not a number"),
    ],
)
def test_what_is_no_matrix_is_refused_with_its_place(put, content, message):
    with pytest.raises(rc.ReadError, match=r"hole\.csv: .*" + message):
        rc.read(put("hole.csv", content), **GIVEN)


ROUGH = rc.self_affine(rc.Grid((26, 20), 1e-6), 0.8, 1e-7, np.random.default_rng(26)).heights
TABLES = {
    "blanks": "".join(" ".join(map(repr, row)) + "\n" for row in ROUGH.tolist()),
    "tabs": "".join("\t".join(f"{z:.6e}" for z in row) + "\n" for row in ROUGH.tolist()),
    "commas": "".join(",".join(map(repr, row)) + ",\n" for row in ROUGH.tolist()),
    "decimal commas": "".join(
        ";".join(f"{z:.6e}".replace(".", ",") for z in row) + "\r\n" for row in ROUGH.tolist()
    ),
}
HEADERS = {
    "Gwyddion": "# Channel: Z\n# Width: 20.00 µm\n# Height: 26.00 µm\n# Value units: m\n",
    "German": "# Breite: 20,0 µm\n# Höhe: 26,0 µm\n# Einheiten: m\n",
    "rows": "# Rows: 26\n",
    "pixels": "# x-pixels = 20\n# y-pixels = 26\n",
}


@pytest.mark.parametrize("table", TABLES)
@pytest.mark.parametrize("header", HEADERS)
def test_a_map_that_ends_early_is_told(put, header, table):
    """After 14 of 26 rows, after the last but one, and within the last one: within a number or between two."""
    head, rows = HEADERS[header], TABLES[table].splitlines(keepends=True)
    assert not told(put("a.txt", head + "".join(rows)))
    assert told(put("a.txt", head + "".join(rows[:14])))
    assert told(put("a.txt", head + "".join(rows[:25])))
    last = rows[-1].rstrip("\r\n")
    for count in places_within(last):
        assert told(put("a.txt", head + "".join(rows[:-1]) + last[:count]))


@pytest.mark.parametrize("table", TABLES)
def test_a_bare_matrix_that_ends_within_a_row_is_told(put, table):
    rows = TABLES[table].splitlines(keepends=True)
    last = rows[13].rstrip("\r\n")
    for count in places_within(last):
        assert told(put("a.txt", "".join(rows[:13]) + last[:count]))


def places_within(row):
    """Return some places to cut a row at: in its first number, in its last ones, and before its end."""
    return (1, 5, len(row) // 2, *range(len(row) - 16, len(row)))


def told(path):
    """Whether a warning is spoken, or the file refused."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            rc.read(path, unit="m", size=20e-6)
        except rc.ReadError:
            return True
    return any("cut short" in str(one.message) for one in said)


def test_rows_apart_by_choice_are_not_told(tmp_path, put):
    surface = rc.Surface(ROUGH, rc.Grid((26, 20), (3e-6, 1e-6)))
    rc.write(surface, tmp_path / "a.txt")
    np.testing.assert_allclose(rc.read(tmp_path / "a.txt").grid.spacing, (3e-6, 1e-6), rtol=1e-15)
    # Printed without decimals, 8 um by 9 um may be 7.5 um by 9.5 um: room for 3.2 rows of square cells, not 3.6.
    square = "# Width: 9 µm\n# Height: 8 µm\n# Value units: nm\n" + text("\t")
    assert not told(put("b.txt", square))


def test_a_line_that_states_its_rows_and_ends_early_is_refused(tmp_path):
    rc.write(rc.Surface(ROUGH[0], rc.Grid(20, 1e-6)), tmp_path / "a.txt")
    lines = (tmp_path / "a.txt").read_text().splitlines(keepends=True)
    (tmp_path / "a.txt").write_text("".join(lines[:-6]))
    with pytest.raises(rc.ReadError, match="it holds 14 rows and states 20: it is cut short"):
        read_line(tmp_path / "a.txt")


def test_a_list_of_points_that_ends_within_a_number_is_told(put):
    points = "".join(f"{k % 4 / 2} {k // 4} 0.{k + 1}\n" for k in range(12))
    assert not any("cut short" in line for line in rc.read(put("a.xyz", points), unit="nm").provenance)
    with pytest.warns(SurfaceWarning, match="its last line has no end: it may be cut short"):
        rc.read(put("a.xyz", points[:-2]), unit="nm")


def test_nan_marks_a_missing_point(put):
    surface = rc.read(put("a.txt", "1 nan 3\n4 5 NaN\n"), **GIVEN)
    assert surface.missing == 2


def test_what_the_file_leaves_open_is_asked_for(put):
    path = put("a.txt", text(" "))
    with pytest.raises(
        rc.ReadError, match=r"a\.txt: it states no unit of its heights and no size; pass unit=.* and size="
    ):
        rc.read(path)
    with pytest.raises(rc.ReadError, match=r"no unit of its heights; pass unit="):
        rc.read(path, size=1e-3)
    with pytest.raises(rc.ReadError, match=r"it states no size; pass size="):
        rc.read(path, unit="um")


MAPS = hnp.arrays(
    np.float64,
    hnp.array_shapes(min_dims=2, max_dims=2, min_side=2, max_side=6),
    elements=st.floats(-1e3, 1e3, width=64) | st.just(np.nan),
).filter(lambda a: not np.isnan(a).all() and not 0 < np.nanmax(a) - np.nanmin(a) < 1e-50)


@settings(max_examples=60, deadline=None)
@given(heights=MAPS, separator=st.sampled_from([" ", "\t", ",", ";", ", "]), binary=st.booleans())
@pytest.mark.filterwarnings("ignore::roughcontact.files.file_errors.SurfaceWarning")
def test_what_is_written_is_read(heights, separator, binary):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / ("a.npy" if binary else "a.txt")
        if binary:
            np.save(path, heights)
        else:
            path.write_text("\n".join(separator.join(map(repr, row)) for row in heights.tolist()))
        surface = rc.read(path, unit="m", size=(0.5, 0.25))
    assert np.array_equal(surface.heights, heights, equal_nan=True)
    ny, nx = heights.shape
    assert surface.grid.spacing == (0.5 / ny, 0.25 / nx)
