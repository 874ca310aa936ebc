"""Grids of maps and exports of instruments, known by their first lines."""

import numpy as np
import pytest

import roughcontact as rc
from hills import HILLS, HOLED, NX, NY, is_right, table
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_line

ESRI = f"ncols {NX}\nnrows {NY}\nxllcorner 340620.0\nyllcenter 3917730.0\n"
SURFER = f"DSAA\n{NX} {NY}\n3 20.5\n7 22.5\n{HILLS.min()} {HILLS.max()}\n"


@pytest.mark.parametrize("name", ["a.asc", "a.txt", "a.grd"])
@pytest.mark.parametrize("cell", ["cellsize 0.5", "CELLSIZE 0,5", "dx 0.5\ndy 0.5", "xdim 0.5\nydim 0.5"])
def test_esri(put, name, cell):
    text = ESRI + cell + "\nNODATA_value  -9999\n" + table(HOLED, " ", hole="-9999")
    surface = rc.read(put(name, text.replace("\n", "\r\n")), unit="um")
    is_right(surface, HOLED)
    assert "not measured where it is -9999" in surface.provenance


@pytest.mark.parametrize(
    ("stated", "printed"),
    [
        ("", "-9999"),
        ("NODATA_value nan\n", "nan"),
        ("NODATA_value -3.4028234663852886e+38\n", "-3.40282e+38"),
        ("nodata_value -99.9\n", "-99.90000153"),
        ("nodata_value 1e20\n", "1e+20"),
    ],
)
def test_esri_marks(put, stated, printed):
    text = ESRI + "cellsize 0.5\n" + stated + table(HOLED, " ", hole=printed)
    is_right(rc.read(put("a.asc", text), unit="um"), HOLED)


def test_esri_on_lines_of_any_length_and_with_decimal_commas(put):
    text = ESRI + "cellsize 0.5\n" + table(separator="\n")
    is_right(rc.read(put("a.asc", text.encode("utf-16")), unit="um"))
    is_right(rc.read(put("a.asc", text.replace(".", ",")), unit="um"))


def test_esri_cells_of_two_sides(put):
    surface = rc.read(put("a.asc", ESRI + "dx 0.25\ndy 0.5\n" + table(separator=" ")), unit="um")
    assert surface.grid.spacing == (5e-7, 2.5e-7)

    surface = rc.read(put("a.asc", ESRI + "cellsize 0.25 0.5\n" + table(separator=" ")), unit="um")
    assert surface.grid.spacing == (5e-7, 2.5e-7)


def test_esri_with_one_side_or_one_row(put):
    with pytest.raises(rc.ReadError, match="it states no size; pass size="):
        rc.read(put("a.asc", ESRI + "dx 0.25\n" + table(separator=" ")), unit="um")
    row = f"ncols {NX}\nnrows 1\ncellsize 0.5\n" + table(HILLS[:1], separator=" ")
    with pytest.raises(rc.ReadError, match="it holds 1 x 36 heights, which is not a map"):
        rc.read(put("a.asc", row), unit="um")


@pytest.mark.parametrize("sides", [(0.25, -0.5), (-0.25, 0.5), (-0.25, -0.5)])
def test_a_negative_cell_is_told(put, sides):
    dx, dy = sides
    with pytest.warns(SurfaceWarning, match=rf"its cells are {dx} x {dy}: the sign is left out"):
        surface = rc.read(put("a.asc", ESRI + f"dx {dx}\ndy {dy}\n" + table(separator=" ")), unit="um")
    assert surface.grid.spacing == (5e-7, 2.5e-7)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            (ESRI + "cellsize 0.5\n" + table(separator=" "))[:-300],
            "and states 32 rows of 36: it is cut short",
        ),
        (ESRI + "cellsize 0.5\n" + table(separator=" ") + "1 2\n", "it holds 1154 numbers and states"),
        (ESRI + "cellsize 0.5\n" + table(separator=" ").replace("0.", "O.", 1), "is not a number; write nan"),
        (
            f"ncols {NX}\ncellsize 0.5\n" + table(separator=" "),
            "it does not state the number of nrows; write ncols and nrows",
        ),
        (ESRI + table(separator=" "), "it states no size; pass size="),
        *((f"DSAA\n{start}", "its header is damaged") for start in ("", "36", "1 2\n")),
        (f"DSAA\n{NX} {NY}\n3 20.5\n", "its header is damaged"),
        (SURFER.replace("36", "36.5", 1), "its header is damaged"),
        (SURFER.replace("32", "32.5", 1), "its header is damaged"),
        ("DSAA\n1 32\n3 3\n0 15.5\n0 1\n" + "0\n" * 32, "its header is damaged"),
        ("DSAA\n36 1\n3 20.5\n0 0\n0 1\n" + "0\n" * 36, "its header is damaged"),
        (SURFER + table(separator=" ")[:-20], "it is cut short"),
        (
            "Zygo ASCII Data File - Format 2\n0 0\n1 2\n",
            "it is a MetroPro text of Zygo, which is not read; export",
        ),
        ("/0/data/xres=3\n", "it is a dump of Gwyddion, which is not read"),
    ],
)
def test_damaged_grids_are_refused(put, text, message):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("a.asc", text), unit="um")


@pytest.mark.parametrize("name", ["a.grd", "a.txt"])
@pytest.mark.parametrize("hole", ["1.70141e+038", "1.70141183460469e+38", "nan"])
def test_surfer_rows_begin_with_the_smallest_y(put, name, hole):
    rows = table(HOLED[::-1], " ", hole=hole).replace("\n", "\n\n")
    is_right(rc.read(put(name, SURFER + rows), unit="um"), HOLED)


def test_surfer_cells_of_two_sides(put):
    text = SURFER.replace("3 20.5", "38 3") + table(HILLS[::-1], separator=" ")
    surface = rc.read(put("a.grd", text), unit="um")
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 1e-6), rtol=1e-14)


@pytest.mark.parametrize(("beyond", "told"), [(0.9e-6, 0), (1.1e-6, 2)])
def test_heights_that_its_header_rounds_are_within_their_range(put, recwarn, beyond, told):
    """The lowest and the highest of the heights are printed as 0 and 1 to six digits."""
    values = np.interp(HILLS, (HILLS.min(), HILLS.max()), (-beyond, 1 + beyond))
    rows = "\n".join(" ".join(map(repr, row)) for row in values.tolist())
    rc.read(put("a.grd", SURFER.replace(f"{HILLS.min()} {HILLS.max()}", "0 1") + rows), unit="um")
    assert [str(warning.message).split()[1] for warning in recwarn] == [f"{told}"] * bool(told)


def test_heights_outside_the_stated_range_are_told(put):
    text = SURFER.replace(f"{HILLS.max()}", "0.5") + table(separator=" ")
    with pytest.warns(SurfaceWarning, match="heights lie outside the range .* that its header states"):
        rc.read(put("a.grd", text), unit="um")


@pytest.mark.parametrize("mark", [b"DSBB", b"DSRB"])
def test_a_binary_grid_is_refused_by_its_name(put, mark):
    with pytest.raises(
        rc.ReadError, match="a binary grid of Surfer, which is not read; save it in Surfer as a text grid"
    ):
        rc.read(put("a.grd", mark + bytes(100)), unit="um")


def test_a_grid_holds_a_map(put):
    path = put("a.grd", SURFER + table(separator=" "))
    assert channels(path)[0].shape == (NY, NX)
    with pytest.raises(rc.ReadError, match=r"a map of 32 x 36 heights, not a profile; use read"):
        read_line(path, unit="um")
    with pytest.raises(rc.ReadError, match=r"it is a text of a map, by its first line; use read"):
        read_line(put("a.txt", path.read_bytes()), unit="um")


ENGLISH = [
    ("Measured date", "06/01/2020"),
    ("Model", "VK-X1000 Series"),
    ("Data type\n", "ImageDataCsv"),
    ("XY Calibration", "500.000", "nm"),
    ("Output image data", "Height"),
    ("Horizontal", str(NX)),
    ("Vertical", str(NY)),
    ("Minimum value", "-1.6"),
    ("Unit", "um"),
    ("Reference data name", ""),
    ("",),
    ("Height",),
]
GERMAN = [
    ("Gemessenes Datum", "06.01.2020"),
    ("Modell", "VK-X200"),
    ("Dateityp", "ImageDataCsv"),
    ("XY-Justierung", "500,0000", "nm"),
    ("Bilddatenausg.", "Höhe"),
    ("Horizont.", str(NX)),
    ("Vertikal", str(NY)),
    ("Einheit", "µm"),
    (),
    ("Höhe",),
]


def keyence(header, separator=",", decimal=".", values=HILLS, hole=""):
    return table(values, separator, decimal, quoted=True, hole=hole, header=header)


@pytest.mark.parametrize("encoding", ["latin-1", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize(
    ("header", "separator", "decimal"), [(ENGLISH, ",", "."), (GERMAN, ";", ","), (GERMAN, ",", ",")]
)
def test_keyence(put, header, separator, decimal, encoding):
    text = keyence(header, separator, decimal).replace("\n", "\r\n") + " \r\n"
    surface = rc.read(put("a.csv", text.encode(encoding)))
    is_right(surface)
    assert f"(Keyence text, channel {header[-1][0]!r}," in surface.provenance[0]


@pytest.mark.parametrize(
    "hole", [(slice(8, 24), slice(10, 26)), (0, slice(0, 5)), (0, 2), slice(0, 3), (-1, -1), slice(30, None)]
)
def test_keyence_holes_are_told(put, hole):
    """Also in the first fields, and over whole rows."""
    holed = HILLS.copy()
    holed[hole] = np.nan
    with pytest.warns(SurfaceWarning, match=f"read as missing points: {np.isnan(holed).sum()} empty"):
        is_right(rc.read(put("a.csv", keyence(ENGLISH, values=holed))), holed)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (("Vertical", str(NY)), ("Vertical", "40"), "it holds 32 rows and states 40"),
        (("Horizontal", str(NX)), ("Horizontal", "40"), "it holds 36 columns and states 40"),
        (
            ("XY Calibration", "500.000", "nm"),
            ("XY Calibration", "500.000", "steps"),
            "it states no size; pass size=",
        ),
        (("Unit", "um"), ("Unit", ""), "it states no unit of its heights; pass unit="),
    ],
)
def test_keyence_that_is_incomplete(put, old, new, message):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("a.csv", keyence([new if line == old else line for line in ENGLISH])))


def test_keyence_that_is_cut_short(put):
    text = keyence(ENGLISH)
    first = text.index(table(quoted=True)[:40])  # of the heights
    for end, message in (
        (first + 100, "holds 1 rows and states 32"),
        (first, "without heights"),
        (-100, "cut short"),
    ):
        with pytest.raises(rc.ReadError, match=message):
            rc.read(put("a.csv", text[:end]))


def test_keyence_of_another_image(put):
    header = [("Unit", "") if line[:1] == ("Unit",) else line for line in ENGLISH[:-1]]
    with pytest.raises(
        rc.ReadError, match="it holds 'Light intensity', not heights; export the data of its height image"
    ):
        rc.read(put("a.csv", keyence([*header, ("Light intensity",)])), unit="um")


@pytest.mark.parametrize("decimal", [".", ","])
def test_profilm(put, decimal):
    head = f"numCols\tnumRows\tpixelSize (um)\n{NX}\t{NY}\t0{decimal}5\nZ-data (um)\n"
    text = (head + table(HOLED, "\t", decimal)).replace("\n", "\r\n")
    is_right(rc.read(put("a.txt", text)), HOLED)
    path = put("a.txt", text.replace("(um)", "(steps)", 1))
    with pytest.raises(rc.ReadError, match=r"no size that is understood \(numCols.*steps.*pass size="):
        rc.read(path)
    is_right(rc.read(path, size=("16 um", "18 um")), HOLED)


@pytest.mark.parametrize(
    ("columns", "rows", "values", "message"),
    [
        (NX, 1, HILLS[:1], "it holds 1 x 36 heights, which is not a map"),
        (1, NY, HILLS[:, :1], "it holds 32 x 1 heights, which is not a map"),
        (0, NY, HILLS, "it states 32 rows of 0 heights"),
        (NX, 0, HILLS, "it states 0 rows of 36 heights"),
        ("inf", NY, HILLS, "it states 32 rows of inf heights"),
        (NX, "many", HILLS, "it states nan rows of 36 heights"),
        (NX, NY, HILLS[:-1], "and states 32 rows of 36: it is cut short"),
        (NX, "", HILLS, "its header is damaged"),
        (NX, NY, HILLS[:0], "its header is damaged"),
    ],
)
def test_profilm_that_is_no_map_or_damaged(put, columns, rows, values, message):
    head = f"numCols\tnumRows\tpixelSize (um)\n{columns}\t{rows}\t0.5\nZ-data (um)\n"
    if rows == "":
        head = head.replace("\t\t", "\t")
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("a.txt", head + (table(values, "\t") if len(values) else "")))


def wyko(flag):
    """Return a text of lines along X Size, heights in waves of 500 nm over 2 or, by the second flag, in nm."""
    return (
        f"Wyko ASCII Data File Format 0\t{flag}\t1\nX Size\t{NY}\nY Size\t{NX}\nBlock Name\tType\tLength\tValue\n"
        "Wavelength\t7\t4\t500\nAspect\t7\t4\t1.0\nPixel_size\t7\t4\t0.0005\nTitle\t5\t20\tnone\nMult\t6\t2\t2\n"
        f"RAW_DATA\t3\t{4 * NX * NY}\n"
        + table(HOLED, "\t", hole="Bad")
        + "Intensity\t3\t4\n"
        + table(separator="\t")
    )


@pytest.mark.parametrize(("flag", "nanometres"), [(0, 250.0), (1, 1.0)])
def test_wyko(put, flag, nanometres):
    is_right(rc.read(put("a.asc", wyko(flag))), HOLED, unit=nanometres * 1e-9)


@pytest.mark.parametrize(
    ("old", "new", "spacing"),
    [
        ("Aspect\t7\t4\t1.0\n", "Aspect\t7\t4\t0.5\n", (5e-7, 2.5e-7)),
        ("Aspect\t7\t4\t1.0\n", "", (5e-7, 5e-7)),
        ("0.0005", "-0.00025", (2.5e-7, 2.5e-7)),
    ],
)
def test_wyko_cells(put, old, new, spacing):
    surface = rc.read(put("a.asc", wyko(0).replace(old, new)))
    np.testing.assert_allclose(surface.grid.spacing, spacing, rtol=1e-14)


def test_wyko_without_mult_is_in_waves(put):
    is_right(rc.read(put("a.asc", wyko(0).replace("Mult\t6\t2\t2\n", ""))), HOLED, unit=500e-9)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("RAW_DATA", "OTHER", "a Wyko text without heights"),
        ("X Size\t32", "X Size\t33", "is not a number|and states 33 rows"),
        ("Wavelength\t7\t4\t500", "Wavelength\t7\t4\t0", "a wavelength over Mult of 0"),
        ("Y Size", "Z Size", "it states no X Size and Y Size"),
    ],
)
def test_wyko_that_is_damaged(put, old, new, message):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("a.asc", wyko(0).replace(old, new)))


@pytest.mark.parametrize("numbered", ["rows", "columns"])
@pytest.mark.parametrize("count", [4, 5, 8])
def test_numbers_of_a_small_table_are_no_heights(put, numbered, count):
    slope = 0.2 * np.arange(count * count).reshape(count, count) + 0.15
    values = np.c_[np.arange(count), slope] if numbered == "rows" else np.r_[np.arange(count)[None], slope]
    path = put("a.csv", table(values))
    with pytest.warns(SurfaceWarning, match="holds places, not heights, and is left out"):
        surface = rc.read(path, unit="um", size="10 um")
    np.testing.assert_allclose(surface.heights, slope * 1e-6, rtol=1e-9)


def test_whole_numbers_beside_a_count_are_heights(put):
    surface = rc.read(put("a.csv", "0,1,2,3\n1,2,3,4\n2,3,4,5\n"), unit="um", size="10 um")
    assert surface.grid.shape == (3, 4)
