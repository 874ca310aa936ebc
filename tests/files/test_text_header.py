"""Lines above a matrix that state its sizes, units and holes, as programs write them."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning

VALUES = np.array([[1.5, -2.0, 3e-3, 0.5], [4.0, 5.25, 6.0, 1.0], [7.0, 8.0, -9.0, 2.0]])
ROWS = "".join("\t".join(map(repr, row)) + "\n" for row in VALUES.tolist())
SPIP = """# File Format = ASCII
# Created by SPIP 6.7
# x-pixels = 4
# y-pixels = 3
# x-length = 8000
# y-length = 3000
# z-unit = nm
# voidpixels =0
# Start of Data:
"""
NOVA = """File Format = ASCII
Created by Nova 1.1
NX = 4
NY = 3
Scale X = 2000
Scale Y = 1000
Unit X = nm
Unit Data = nm
Start of Data :
"""


@pytest.mark.parametrize(
    "header",
    [
        SPIP,
        NOVA,
        "width = 8 um\nheight = 3000 nm\nz-unit = nm\n",
        "Width=8 um\nHeight=3 um\nunit: nm\n\n",
        "# x_length = 8\n# y_length = 3\n# x-unit = um\n# value units = nm\n",
        "dx = 2 um\ndy = 1e-6 m\nheight units = nm\n",
        "# Width: 4 px\n# Height: 3 px\n# dx: 2 um\n# dy: 1 um\n# Value units: nm\n",
        "width = 4\nheight = 3\nx-unit = um\npixel size x = 2\npixel size y = 1\nz unit = nm\n",
    ],
)
def test_a_header_states_size_and_unit(put, header):
    surface = rc.read(put("a.txt", header + ROWS))
    np.testing.assert_allclose(surface.grid.spacing, (1e-6, 2e-6), rtol=1e-14)
    np.testing.assert_allclose(surface.heights, VALUES * 1e-9, rtol=1e-14)
    assert "(text with a header, " in surface.provenance[0]
    assert len(surface.provenance) == 1


def test_one_side_of_a_cell_is_that_of_squares(put):
    surface = rc.read(put("a.txt", "pixel size = 0.5 um\nunits = nm\n" + ROWS))
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 5e-7), rtol=1e-14)


@pytest.mark.parametrize(
    "label", ["nodata", "NODATA_value", "missing value", "Invalid data value", "no-data"]
)
def test_what_stands_for_a_missing_point_is_none(put, label):
    header = f"{label} = -9\nwidth = 8 um\nheight = 3 um\nunit = nm\n"
    surface = rc.read(put("a.txt", header + ROWS))
    assert surface.missing == 1
    assert np.isnan(surface.heights[2, 2])
    assert "not measured where it is -9, as its header states" in surface.provenance


def test_a_bare_side_in_the_only_unit_is_taken_with_a_warning(put):
    with pytest.warns(SurfaceWarning, match="its one unit, um, is assumed for lengths along the map"):
        surface = rc.read(put("a.txt", "width = 80\nheight = 60\nunit = um\n" + ROWS))
    np.testing.assert_allclose(surface.grid.lengths, (60e-6, 80e-6), rtol=1e-14)


def test_a_bare_side_that_is_the_number_of_points_is_in_pixels(put):
    with pytest.raises(rc.ReadError, match=r"it states no size; pass size="):
        rc.read(put("a.txt", "width = 4\nheight = 3\nunit = um\n" + ROWS))


@pytest.mark.parametrize(
    "line", ["scale factor = 2", "# Bit2nm = 0.1", "height conversion factor (-> m) = 1e-9"]
)
def test_a_factor_that_is_not_applied_is_told(put, line):
    header = f"width = 8 um\nheight = 3 um\nunit = nm\n{line}\n"
    with pytest.warns(SurfaceWarning, match="which is not applied: check the heights"):
        rc.read(put("a.txt", header + ROWS))


@pytest.mark.parametrize("line", ["scale factor = 1.0", "quality factor = 200", "scale = linear"])
def test_what_changes_no_height_is_not_talked_about(put, line):
    header = f"width = 8 um\nheight = 3 um\nunit = nm\n{line}\n"
    assert len(rc.read(put("a.txt", header + ROWS)).provenance) == 1


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("nx = 5\n" + ROWS, "its rows hold 4 numbers and it states 5"),
        ("# x-pixels = 3\n" + ROWS, "its rows hold 4 numbers and it states 3"),
        ("ny = 4\n" + ROWS, "it holds 3 rows and states 4: it is cut short"),
        # No name begins with a number, and nan is one: such a line is a damaged row.
        ("1=2 3 4 5\n" + ROWS, r"'1=2 3 4 5' is not a number"),
        ("nan: 3 4 5\n" + ROWS, r"'nan: 3 4 5' is not a number"),
        # Words alone are a header only among lines that state something.
        ("Created by hand\n" + ROWS, "'Created by hand' is not a number"),
        (ROWS + "width = 8 um\n", "'width' is not a number"),
        # Two columns under words are no map, however few rows there are.
        ("name: scan\n1 2\n2 3\n", "look like a list of coordinates, not a map"),
    ],
)
def test_what_contradicts_the_rows_is_refused(put, content, message):
    with pytest.raises(rc.ReadError, match=r"a\.txt: .*" + message):
        rc.read(put("a.txt", content), unit="nm", size=1e-5)
