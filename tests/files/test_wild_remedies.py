"""What a refusal of a text names as its remedy is done to the letter, and the file is read."""

import numpy as np
import pytest

import roughcontact as rc
from hills import HILLS, HOLED, NX, NY, is_right, table
from roughcontact.files.read import read_line

GIVEN = {"unit": "um", "size": ("16 um", "18 um")}
ROWS = table(separator=" ")
COMMAS = table(np.abs(HILLS) + 1.5, ";", ",")
ESRI = f"ncols {NX}\nnrows {NY}\ncellsize 0.5\n"


def test_commas_of_thousands_hide_no_decimal_comma():
    assert all(len(field.partition(",")[2]) == 3 for field in COMMAS.replace("\n", ";").split(";") if field)


@pytest.mark.parametrize(
    ("name", "content", "message", "mended"),
    [
        (
            "a.txt",
            "Made by hand\n" + ROWS,
            "header lines must start with #",
            "# Made by hand\n" + ROWS,
        ),
        ("a.txt", "Made by hand\n" + ROWS, "or have the form name = value", "made = by hand\n" + ROWS),
        ("a.txt", "".join(ROWS.rpartition(" ")[:1]) + "\n", "write nan where a point", None),
        ("a.txt", ROWS.replace("\n", "\n\n", 1), "keep one uninterrupted table in a file", ROWS),
        ("a.txt", ROWS.replace(" ", "\t", NX - 1), "separate all numbers alike", ROWS),
        ("a.txt", "# Rows: 40\n" + ROWS, "remove that line if it has another meaning", ROWS),
        ("a.txt", "nx = 40\n" + ROWS, "remove that line if it has another meaning", ROWS),
        (
            "a.asc",
            ESRI.replace("nrows", "rows") + ROWS,
            "write ncols and nrows above the heights",
            ESRI + ROWS,
        ),
        (
            "a.asc",
            ESRI.replace(f"{NY}", "40") + ROWS,
            "or correct the numbers of rows and columns",
            ESRI + ROWS,
        ),
        ("a.asc", ESRI + table(HOLED, " ", hole="what"), "write nan where a point was not measured", None),
        ("a.asc", "Zygo ASCII Data File\n" + ROWS, "export the heights as rows of numbers", ROWS),
    ],
)
def test_a_map(put, name, content, message, mended):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put(name, content), **GIVEN)
    expected = HILLS
    if mended is None and "what" in content:
        mended, expected = content.replace("what", "nan"), HOLED
    elif mended is None:
        mended, expected = content.rstrip("\n") + " nan\n", HILLS.copy()
        expected[-1, -1] = np.nan
    is_right(rc.read(put(name, mended), **GIVEN), expected)


@pytest.mark.parametrize(
    ("content", "mended"),
    [
        (COMMAS, COMMAS.replace(",", ".")),
        (COMMAS.replace(";", ",").replace("-", ""), COMMAS.replace(",", ".").replace(";", ",")),
        (COMMAS.replace(";", ",").replace("-", ""), COMMAS.replace(",", ".")),
    ],
)
def test_commas(put, content, mended):
    with pytest.raises(
        rc.ReadError, match=r"write decimal points, (and no commas between thousands|or semicolons)"
    ):
        rc.read(put("a.csv", content), **GIVEN)
    is_right(rc.read(put("a.csv", mended), **GIVEN), np.abs(HILLS) + 1.5)


@pytest.mark.parametrize(
    ("content", "message", "mended"),
    [
        ("0 1 5\n1 2 5\n", "give one column of heights", "1\n2\n"),
        ("0 1 5\n1 2 5\n", "or two: places along the line and heights", "0.5 1\n1 2\n"),
        ("0 1 5\n1 2 5\n", "or a third, valid, of 1 and 0", "x z valid\n0.5 1 1\n1 2 1\n"),
        (
            "0.5 1\n1 2\nend\n",
            "interrupts the rows of numbers; give one column of heights, or two",
            "0.5 1\n1 2\n",
        ),
        (table(np.arange(NX * 2.0).reshape(2, NX)), "use read|give one column", "1\n2\n"),
        ("1 1\n0.5 2\n", "sort the rows by place", "0.5 2\n1 1\n"),
    ],
)
def test_a_profile(put, content, message, mended):
    with pytest.raises(rc.ReadError, match=message):
        read_line(put("a.txt", content), unit="um", size="2 um")
    assert read_line(put("a.txt", mended), unit="um", size="2 um").grid.shape == (2,)


FOUR = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("0 0\n1 0\n", "give three columns x, y, z"),
        ("nan 0 1\n" + FOUR, "leave out points without a place"),
        ("0 0 9\n" + FOUR, "give points on a regular grid, one a place"),
    ],
)
def test_points(put, content, message):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("a.xyz", content), unit="um", size="2 um")
    surface = rc.read(put("a.xyz", FOUR), unit="um", size="2 um")
    assert np.array_equal(surface.heights, np.array([[1, 2], [3, 4]]) * 1e-6)
