"""Texts as instruments, spreadsheets and programs of maps write them: read right, or asked about."""

import numpy as np
import pytest

import roughcontact as rc
from hills import HILLS, HOLED, NX, NY, X, Y, is_right, table
from roughcontact.files.file_errors import SurfaceWarning

GIVEN = {"unit": "um", "size": ("16 um", "18 um")}
HEADER = "# unit: um\n# pixel size: 0.5 um\n"


@pytest.mark.parametrize("quoted", [False, True])
@pytest.mark.parametrize(
    ("separator", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", ","), (" ", ".")]
)
@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le"])
def test_quotes_separators_and_encodings(put, quoted, separator, decimal, encoding):
    text = table(separator=separator, decimal=decimal, quoted=quoted).replace("\n", "\r\n")
    is_right(rc.read(put("a.csv", text.encode(encoding)), **GIVEN))


def test_decimal_commas_in_quotes(put):
    is_right(rc.read(put("a.csv", table(decimal=",", quoted=True)), **GIVEN))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("20,000;30,000\n40,125;50,500\n", r"row 1 \(line 1\): '20,000' may be 20.000 or 20000"),
        ('"20,000","30,000"\n"40,125","50,500"\n', "'20,000' may be 20.000 or 20000"),
        ("1,234,567;2,234,567\n1,234,567;2,234,568\n", "may be"),
        ("0,184,0,357\n0,025,1,012\n", "'0,184,0,357' may be 4 numbers, or half as many with decimal commas"),
    ],
)
def test_commas_that_may_mean_two_things_are_asked_about(put, text, message):
    with pytest.raises(rc.ReadError, match=message + r".*; write decimal points, (and no|or semicolons)"):
        rc.read(put("a.csv", text), **GIVEN)


@pytest.mark.parametrize(
    "text", ["20,000;30,0\n40,125;50,500\n", "20.000;30.000\n40.125;50.500\n", "0,020;1,5\n1,250;3,125\n"]
)
def test_one_certain_comma_is_enough(put, text):
    assert rc.read(put("a.csv", text), **GIVEN).rms > 1e-8


NUMBERED = [str(k) for k in range(NX)]
FROM_ONE = [str(k + 1) for k in range(NX)]
PLACES = [f"{k * 0.5}" for k in range(NX)]
SHORT = [f"{k * 0.438:.1f}" for k in range(NX)]


def framed(columns, rows, corner="", values=HILLS, separator=","):
    """Return a table with a first row and a first column."""
    lines = [separator.join([corner, *columns])] if columns else []
    for name, row in zip(rows or [None] * len(values), values, strict=True):
        lines.append(separator.join([*([] if name is None else [name]), *(f"{v:.3f}" for v in row)]))
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    "text",
    [
        table(header=[NUMBERED]),
        table(header=[FROM_ONE], separator=";"),
        table(header=[NUMBERED], separator=" "),
        table(header=[PLACES]),
        framed([], NUMBERED[:NY]),
        framed([], FROM_ONE[:NY], separator="\t"),
        framed([], [str(k + 140) for k in range(NY)]),
        framed(NUMBERED, NUMBERED[:NY]),
        framed(FROM_ONE, FROM_ONE[:NY], separator=";"),
        framed(PLACES, PLACES[:NY]),
        framed(PLACES, PLACES[:NY], "0"),
        framed(PLACES, PLACES[:NY], "nan"),
        framed(PLACES, PLACES[:NY], "y [um]"),
        framed(PLACES, PLACES[:NY], r"y\x"),
        framed(SHORT, SHORT[:NY], "nan"),
        framed(PLACES, PLACES[NY - 1 :: -1]),
        '"",' + ",".join(f'"V{k}"' for k in range(NX)) + "\n" + framed([], [f'"{k + 1}"' for k in range(NY)]),
        " ".join(NUMBERED) + "\n" + framed([], NUMBERED[:NY], separator=" "),
    ],
)
def test_numbers_of_rows_and_columns_and_axes_are_no_heights(put, text):
    with pytest.warns(
        SurfaceWarning, match=r"first (row|column) \(.*places, not heights, and (is|are) left out; to keep"
    ):
        surface = rc.read(put("a.csv", text), **GIVEN)
    is_right(surface)


@pytest.mark.parametrize("axis", [0, 1])
def test_they_are_none_in_an_array(put, npy, axis):
    values = np.concatenate(
        [np.arange(HILLS.shape[1 - axis])[None] if axis == 0 else np.arange(NY)[:, None], HILLS], axis
    )
    with pytest.warns(SurfaceWarning, match=r"first (row|column) \(0, 1, 2, \.\.\., 3[15]\) holds places"):
        is_right(rc.read(put("a.npy", npy(values)), **GIVEN))


def test_the_remedy_keeps_them(put, npz):
    values = np.vstack([np.arange(NX), HILLS])
    surface = rc.read(put("a.npz", npz(heights=values)), **GIVEN)
    assert np.array_equal(surface.heights, values * 1e-6)


@pytest.mark.parametrize(
    "values",
    [
        np.arange(1200.0).reshape(30, 40),
        0.5 * X + 0.25 * Y,
        np.where((X == 20) & (Y == 20), 5.0, X + Y),
        np.where((X == 1) & (Y == 1), np.nan, 0.25 * X - Y),
        np.where((X == 0) | (Y == 0), np.nan, HILLS),
        np.where((X == 0) & (Y == 0), np.nan, HILLS),
        np.where((X < 2) | (Y < 2), np.nan, 0.25 * X - Y),
        HILLS,
    ],
)
def test_slopes_are_heights(put, npy, values):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            "roughcontact.files.assemble.height_warnings", lambda *_: ()
        )  # one point on a slope is a spike
        surface = rc.read(put("a.npy", npy(values)), unit="um", size="1 mm")
    assert surface.heights.shape == values.shape


@pytest.mark.parametrize(
    ("above", "corner", "keywords"),
    [
        ("# lateral unit: um\n", "", {"unit": "um"}),
        ("# x [um], y [um], z [um]\n", "", {}),
        ("", "y/x [microns]", {"unit": "um"}),
        ("# z-unit: um\n", "y [um] x [um]", {}),
    ],
)
@pytest.mark.filterwarnings("ignore::roughcontact.files.file_errors.SurfaceWarning")
def test_axes_with_a_unit_state_the_size(put, above, corner, keywords):
    is_right(rc.read(put("a.csv", above + framed(PLACES, PLACES[:NY], corner)), **keywords))


@pytest.mark.filterwarnings("ignore::roughcontact.files.file_errors.SurfaceWarning")
@pytest.mark.parametrize("columns", [PLACES, NUMBERED])
def test_axes_without_a_unit_leave_the_size_open(put, columns):
    with pytest.raises(rc.ReadError, match="no size; pass size="):
        rc.read(put("a.csv", framed(columns, columns[:NY])), unit="um")


@pytest.mark.filterwarnings("ignore:.*interquartile")
def test_uneven_axes_lead_somewhere(put, npz):
    columns = [f"{k**1.5:.3f}" for k in range(NX)]
    path = put("a.csv", framed(columns, columns[:NY], "0"))
    with pytest.raises(
        rc.ReadError, match=r"sorted and uneven, like places.*interpolate .*save the table as \.npz"
    ):
        rc.read(path, **GIVEN)
    table_of = np.loadtxt(path, delimiter=",")
    assert rc.read(put("a.npz", npz(heights=table_of, unit="um")), size="18 um").grid.shape == table_of.shape


@pytest.mark.parametrize("turned", [False, True])
def test_heights_that_rise_along_one_side_are_no_reason_for_axes(put, turned):
    """A slope: its first row and column are sorted, and so is what lies beside one of them."""
    y, x = np.indices((20, 24))
    slope = (x + 1) ** 1.5 + np.where(x == 0, y**1.4, 0.3 * np.sin(2.0 * y))
    path = put("a.txt", table(slope.T if turned else slope))
    assert rc.read(path, **GIVEN).grid.shape == ((24, 20) if turned else (20, 24))


def test_names_of_columns_are_left_out(put):
    surface = rc.read(put("a.csv", table(header=[[f"c{k}" for k in range(NX)]])), **GIVEN)
    is_right(surface)
    assert any("names the columns" in line for line in surface.provenance)


@pytest.mark.parametrize(
    "hole",
    [
        "NaN",
        "***",
        "BAD",
        "Bad",
        "--",
        "---",
        "N/A",
        "#N/A",
        "null",
        "None",
        "1.#QNAN",
        "-nan(ind)",
        "masked",
    ],
)
def test_words_for_a_missing_point(put, hole):
    surface = rc.read(put("a.csv", table(HOLED, hole=hole)), **GIVEN)
    is_right(surface, HOLED)


@pytest.mark.parametrize("hole", ["", "-", "?"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_marks_that_damage_may_leave_are_told(put, hole, separator):
    with pytest.warns(SurfaceWarning, match="fields read as missing points: 256"):
        is_right(rc.read(put("a.csv", table(HOLED, separator, hole=hole)), **GIVEN), HOLED)


def test_an_empty_first_field_is_told(put):
    values = HILLS.copy()
    values[0, 0] = np.nan
    with pytest.warns(SurfaceWarning, match="its first field is empty, and is read as a missing point"):
        is_right(rc.read(put("a.csv", table(values, hole="")), **GIVEN), values)


@pytest.mark.parametrize(
    ("stated", "printed"),
    [
        ("-99.9", "-99.90000153"),
        ("-99.90000153", "-99.9"),
        ("-9999", "-9999.000"),
        ("1.70141e38", "1.70141183460469e+38"),
        ("-3.40282346638529e+38", "-3.4028e+38"),
        ("-3.4028235e38", "-3.402823e+38"),
        ("-9999 um", "-9999"),
        ("-99,9", "-99.9"),
        ("-9999, -32768", "-32768"),
        ("-9999; 1e20", "1e+20"),
        ("BAD", "BAD"),
    ],
)
def test_marks_are_compared_as_they_were_printed_or_stored(put, stated, printed):
    text = HEADER + f"# nodata: {stated}\n" + table(HOLED, " ", hole=printed)
    is_right(rc.read(put("a.txt", text)), HOLED)


@pytest.mark.parametrize(
    "label", ["missing_value", "FillValue", "no data value", "nodata [um]", "Fehlwert", "bad data value"]
)
def test_labels_of_a_mark(put, label):
    is_right(rc.read(put("a.txt", HEADER + f"# {label} = -77.7\n" + table(HOLED, " ", hole="-77.7"))), HOLED)


@pytest.mark.parametrize("line", ["NODATA_value -77.7", "nodata,-77.7", "missing value; -77.7"])
def test_a_mark_without_a_sign_before_it(put, line):
    is_right(rc.read(put("a.txt", HEADER + f"# {line}\n" + table(HOLED, " ", hole="-77.7"))), HOLED)


def test_several_lines_may_state_marks(put):
    values = HOLED.copy()
    text = table(values, " ", hole="-55").replace("-55 ", "-66 ", 5)
    is_right(rc.read(put("a.txt", HEADER + "# nodata: -55\n# missing value: -66\n" + text)), values)


@pytest.mark.parametrize(
    "printed", ["3.40282e+38", "-3.4028235e38", "1.70141e+38", "-1.7976931348623157e308", "9.96921e+36"]
)
def test_what_programs_store_for_missing_points_is_told(put, printed):
    with pytest.warns(
        SurfaceWarning, match=r"256 points hold .*, a mark of missing points, and are read as missing"
    ):
        is_right(rc.read(put("a.txt", HEADER + table(HOLED, " ", hole=printed))), HOLED)


@pytest.mark.filterwarnings("ignore:.*like a mark of missing points")
def test_a_mark_printed_with_fewer_digits_is_told_and_the_remedy_works(put):
    text = HEADER + "# nodata: -99.99\n" + table(HOLED, " ", hole="-100")
    message = r"-99.99 marks missing points, and 256 of its heights are -100; state -100 if they are missing"
    with pytest.warns(SurfaceWarning, match=message):
        rc.read(put("a.txt", text))
    is_right(rc.read(put("a.txt", text.replace("-99.99", "-100"))), HOLED)


def test_a_mark_that_nothing_states_is_told_and_the_remedy_works(put):
    message = (
        r"256 points hold -5e-06 m, like a mark .* and the others -1.532e-06 to .* m; mark them as missing"
    )
    with pytest.warns(SurfaceWarning, match=message):
        surface = rc.read(put("a.txt", HEADER + table(HOLED, " ", hole="-5")))
    is_right(surface.masked(below=-3e-6), HOLED)


def test_heights_beyond_any_body_lead_to_a_mark(put):
    path = put("a.txt", HEADER + table(HOLED, " ", hole="1e+30"))
    with pytest.raises(
        rc.ReadError,
        match=r"heights up to 1e.24 m; pass unit= .*, or write nan where this number marks a missing",
    ):
        rc.read(path)
    is_right(rc.read(put("a.txt", path.read_text().replace("1e+30", "nan"))), HOLED)


@pytest.mark.parametrize(
    "header",
    [
        "width: 18 um\nheight: 16 um\nunit: um",
        "Width [um]: 18\nHeight [um]: 16\nz unit: um",
        "dx = 0.5 microns\nz-unit = Micrometers",
        "x-unit: um\ny-unit: nm\nwidth: 18\nheight: 16000\nz-unit: um",
        "Width: 0.018 millimeters\nHeight: 0.016 millimetre\nValue units: micrometer",
        "Šířka: 18 um\nVýška: 16 um\nJednotky hodnot: um",
        "幅：18 um\n高さ：16 um\n値の単位：um",  # noqa: RUF001
        "Pixelgröße: 0,5 µm\nEinheit: µm",
        "Height: of sample 5\ndx: 0.5 um\nunit: um",
    ],
)
@pytest.mark.parametrize("mark", ["# ", "", "% ", "// "])
def test_headers_in_other_words(put, header, mark):
    text = "".join(f"{mark}{line}\n" for line in header.split("\n")) + table(separator="\t")
    is_right(rc.read(put("a.txt", text)))


@pytest.mark.parametrize(
    ("header", "stated"),
    [
        ("dx: 0.5 um\ndy: 0.5 blorg\nunit: um", "dy = 0.5 blorg"),
        ("dx: 0.5\nunit: um\nx-unit: steps", "dx = 0.5"),
        ("width: 18 mystery\nheight: 16 um\nunit: um", "width = 18 mystery"),
        ("Width: 18,000 um\nHeight: 16,000 um\nunit: um", "width = 18,000 um"),
    ],
)
def test_a_size_that_is_not_understood_is_asked_for(put, header, stated):
    path = put("a.txt", header + "\n" + table(separator="\t"))
    with pytest.raises(rc.ReadError, match=rf"no size that is understood \({stated}\); pass size="):
        rc.read(path)
    is_right(rc.read(path, size=("16 um", "18 um")))


def test_a_unit_that_is_not_understood_is_asked_for_and_any_length_answers(put):
    path = put("a.txt", "# unit: parsnips\n# dx: 0.5 um\n" + table(separator=" "))
    with pytest.raises(
        rc.ReadError, match="heights in 'parsnips', which is no length known here; pass unit="
    ):
        rc.read(path)
    is_right(rc.read(path, unit="microinch"), unit=2.54e-8)
    with pytest.warns(SurfaceWarning, match="unusual"):
        is_right(rc.read(path, unit="ft"), unit=0.3048)
