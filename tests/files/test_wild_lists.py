"""Points and profiles as instruments and data frames write them: read right, or asked about."""

import numpy as np
import pytest

import roughcontact as rc
from hills import HILLS, HOLED, NX, NY, X, Y, is_right
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import read_line

POINTS = [(f"{x * 0.5:.1f}", f"{y * 0.5:.1f}", f"{HILLS[y, x]:.3f}") for y in range(NY) for x in range(NX)]
UNITS = "# x [um] y [um] z [um]\n"


def points(separator=" ", *, between="", numbered=False):
    """Return lines of points, with something between two lines of the scan."""
    lines = [
        separator.join([*([str(k)] if numbered else []), *point]) + "\n" for k, point in enumerate(POINTS)
    ]
    return between.join("".join(lines[k : k + NX]) for k in range(0, len(lines), NX))


def numbered_from(first):
    return "".join(f"{k % NX + first} {k // NX + first} {z}\n" for k, (_, _, z) in enumerate(POINTS))


@pytest.mark.parametrize(
    "header",
    [
        "X [um],Y [um],Z [um]",
        "x (microns);y (microns);z (microns)",
        "X_um Y_um Z_um",
        "x/um y/um z/um",
        "um um um",
        "Measured by me\nunit: um",
        "# x-unit = um\n# z-unit = um",
        "Messung vom 3. Mai\nX [µm]\tY [µm]\tZ [µm]",
    ],
)
@pytest.mark.parametrize("separator", [" ", ",", ";", "\t"])
def test_words_above_points(put, header, separator):
    is_right(rc.read(put("a.xyz", f"{header}\n{points(separator)}")))


@pytest.mark.parametrize("between", ["\n", "\n\n", "# a line\n"])
def test_lines_between_those_of_a_scan(put, between):
    is_right(rc.read(put("a.xyz", (UNITS + points(between=between) + "\n\n").replace("\n", "\r\n"))))


def test_decimal_commas(put):
    is_right(rc.read(put("a.xyz", "x [um];y [um];z [um]\n" + points(";").replace(".", ","))))


@pytest.mark.parametrize("header", [UNITS, ",x [um],y [um],z [um]\n"])
def test_a_column_that_numbers_the_points_is_told(put, header):
    with pytest.warns(SurfaceWarning, match="its first column numbers the points, and is left out"):
        is_right(rc.read(put("a.xyz", header + points(",", numbered=True))))


@pytest.mark.parametrize(
    ("content", "stated"),
    [
        ("x [px],y [px],z [um]\n" + points(","), "x and y in 'px' and 'px'"),
        ("x,y,z [um]\n" + points(","), "z in um, x and y without a unit"),
        (
            "".join(f"{k % NX} {k // NX} {z}\n" for k, (_, _, z) in enumerate(POINTS)),
            "x and y number the points",
        ),
        (
            "".join(f"{k % NX + 1} {k // NX + 1} {z}\n" for k, (_, _, z) in enumerate(POINTS)),
            "x and y number the points",
        ),
    ],
)
def test_places_without_a_length_leave_the_size_open(put, content, stated):
    path = put("a.xyz", content)
    with pytest.raises(rc.ReadError, match=rf"no size that is understood \({stated}\); pass size="):
        rc.read(path, unit="um")
    is_right(rc.read(path, unit="um", size="18 um"))


@pytest.mark.parametrize("share", [0.3, 0.06, 0.03])
def test_a_grid_that_is_sparsely_filled_is_read_and_told(put, share):
    kept = np.random.default_rng(3).random(HILLS.shape) < share
    kept[0, 0] = kept[-1, -1] = True
    content = UNITS + "".join(
        " ".join(p) + "\n" for p, keep in zip(POINTS, kept.ravel(), strict=True) if keep
    )
    with pytest.warns(SurfaceWarning, match=f"{1 - kept.mean():.0%} of its points are missing"):
        is_right(rc.read(put("a.xyz", content)), np.where(kept, HILLS, np.nan))


def test_scattered_points_on_a_printed_grid_are_refused(put):
    places = np.random.default_rng(4).random((300, 2))
    with pytest.raises(rc.ReadError, match="scattered"):
        rc.read(put("a.xyz", UNITS + "".join(f"{x:.2f} {y:.2f} 1\n" for x, y in places)))


@pytest.mark.parametrize("hole", ["nan", "***", "BAD", "-9999"])
def test_marks_among_points(put, hole):
    lines = [
        f"{x} {y} {hole if np.isnan(HOLED[int(float(y) * 2), int(float(x) * 2)]) else z}\n"
        for x, y, z in POINTS
    ]
    is_right(rc.read(put("a.xyz", UNITS + "# nodata = -9999\n" + "".join(lines))), HOLED)


@pytest.mark.parametrize("columns", [True, False])
def test_a_long_run_of_one_number_is_told(put, columns):
    damaged = (Y == 10) & (X > 4) & (X < 30)
    order = np.arange(NX * NY) if columns else np.arange(NX * NY).reshape(NY, NX).T.ravel()
    lines = [
        f"{p[0]} {p[1]} {'0.0' if bad else p[2]}\n" for p, bad in zip(POINTS, damaged.ravel(), strict=True)
    ]
    with (
        pytest.warns(
            SurfaceWarning, match="25 neighbouring points from cell 10, 5 hold 0 m, as in a damaged file"
        ),
        pytest.warns(SurfaceWarning, match="spike"),
    ):
        rc.read(put("a.xyz", UNITS + "".join(lines[k] for k in order)))


def test_a_table_of_points_leads_to_a_list(put):
    content = "x,y,z\n" + points(",")
    with pytest.raises(
        rc.ReadError, match=r"a list of coordinates, not a map; name a list of points x, y, z \.xyz"
    ):
        rc.read(put("a.csv", content), unit="um")
    is_right(rc.read(put("a.xyz", content), unit="um"))


def test_a_matrix_with_gaps_leads_to_a_list(put):
    with pytest.raises(rc.ReadError, match=r"is a hole after row 36; .*name a list of points x, y, z \.xyz"):
        rc.read(put("a.txt", points(" ", between="\n")), unit="um")


ARRAY = np.c_[X.ravel() * 0.5, Y.ravel() * 0.5, HILLS.ravel()]


@pytest.mark.parametrize(
    "array",
    [ARRAY, ARRAY.T, ARRAY.astype("f4"), np.random.default_rng(5).permutation(ARRAY), ARRAY * [2, 2, 1]],
)
def test_an_array_of_points_is_put_on_its_grid_and_told(put, npy, array):
    path = put("a.npy", npy(array))
    with pytest.warns(
        SurfaceWarning, match="1152 rows of 3 are points x, y, z, and are put on their grid of 32 x 36"
    ):
        surface = rc.read(path, unit="um", size="18 um")
    np.testing.assert_allclose(surface.heights, HILLS * 1e-6, rtol=1e-6, atol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 5e-7), rtol=1e-12)
    with pytest.raises(rc.ReadError, match=r"no size that is understood \(steps of .* along x .*pass size="):
        rc.read(path, unit="um")


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.random.default_rng(6).random((300, 3)), "300 rows of 3 look like points x, y, z, not a map"),
        (
            ARRAY[:, 1:],
            "1152 x 2 numbers look like places and heights, not a map; save only the column, array",
        ),
        (ARRAY.T[1:], "2 x 1152 numbers look like places and heights, not a map; save only the row, array"),
    ],
)
@pytest.mark.filterwarnings("ignore:.*spikes of")
def test_other_lists_in_arrays_lead_somewhere(put, npy, npz, array, message):
    for read in (rc.read, read_line):
        with pytest.raises(rc.ReadError, match=message):
            read(put("a.npy", npy(array)), unit="um", size="18 um")
    surface = rc.read(put("a.npz", npz(heights=array, unit="um")), size=("18 um", "18 um"))
    assert surface.grid.shape == array.shape
    if min(array.shape) == 2:
        alone = array[:, 1] if array.shape[1] == 2 else array[1]
        assert read_line(put("b.npy", npy(alone)), unit="um", size="18 um").grid.shape == alone.shape


PLACES = np.arange(1200) * 0.5
WAVES = np.round(40 * (np.sin(PLACES / 9) + 0.3 * np.cos(PLACES / 2.3)), 3)
GAPS = np.where((PLACES > 50) & (PLACES < 80), np.nan, WAVES)


def profile(values=WAVES, separator=",", hole="nan", decimal="."):
    rows = zip(PLACES, values, strict=True)
    return "".join(
        f"{x:.1f}{separator}".replace(".", decimal)
        + (hole if np.isnan(z) else f"{z:.3f}".replace(".", decimal))
        + "\n"
        for x, z in rows
    )


@pytest.mark.parametrize(
    ("header", "keywords"),
    [
        ("X_(microns),y1", {"unit": "um"}),
        ("X_(microns),Y_(microns)", {}),
        ("X in microns, Z in microns", {}),
        ("Distance um,Height um", {}),
        ("x / um,z / um", {}),
        ("x,z", {"unit": "um"}),
        ("# unit: um", {}),
        ("x-unit: um\nz-unit: um", {}),
        ('"x [um]","z [um]"', {}),
    ],
)
def test_headers_of_profiles(put, header, keywords):
    is_right(read_line(put("a.csv", f"{header}\n{profile()}"), **keywords), WAVES)


def test_places_have_their_own_unit(put):
    surface = read_line(put("a.csv", "X_(microns),y1\n" + profile()), unit="nm")
    is_right(surface, WAVES, unit=1e-9)


@pytest.mark.parametrize(
    ("content", "stated"),
    [
        ("x [furlongs],z [um]\n" + profile(), "places in 'furlongs'"),
        ("x,z [um]\n" + profile(), "heights in um, places without a unit"),
        (",0\n" + "".join(f"{k},{z}\n" for k, z in enumerate(WAVES)), "the first column numbers the heights"),
        ("".join(f"{k + 1};{z}\n" for k, z in enumerate(WAVES)), "the first column numbers the heights"),
    ],
)
def test_places_of_a_profile_without_a_length_leave_the_size_open(put, content, stated):
    path = put("a.csv", content)
    with pytest.raises(rc.ReadError, match=rf"no size that is understood \({stated}\); pass size="):
        read_line(path, unit="um")
    is_right(read_line(path, unit="um", size="600 um"), WAVES)


@pytest.mark.parametrize(
    ("stated", "printed"),
    [
        ("-9999", "-9999.000"),
        ("-99.9", "-99.90000153"),
        ("-3.4028235e38", "-3.402823e+38"),
        ("BAD", "BAD"),
        ("--", "--"),
    ],
)
@pytest.mark.parametrize("line", ["# nodata = {}", "nodata: {}", "missing value: {}"])
def test_marks_in_profiles(put, line, stated, printed):
    text = line.format(stated) + "\nx [um],z [um]\n" + profile(GAPS, hole=printed)
    is_right(read_line(put("a.txt", text)), GAPS)


def test_empty_heights_of_a_profile_are_told(put):
    with pytest.warns(SurfaceWarning, match="fields read as missing points: 59 empty"):
        is_right(read_line(put("a.txt", "x [um],z [um]\n" + profile(GAPS, hole=""))), GAPS)


@pytest.mark.parametrize("separator", [";", "\t", " "])
def test_decimal_commas_of_profiles(put, separator):
    text = "x [um]\tz [um]\n" + profile(separator=separator, decimal=",")
    is_right(read_line(put("a.txt", text.encode("utf-16"))), WAVES)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("20,000;30,000\n21,000;30,125\n", "'20,000' may be 20.000 or 20000"),
        ("12,0184\n13,9400\n15,3200\n", "may be 2 numbers, or half as many with decimal commas"),
    ],
)
def test_commas_in_profiles_that_may_mean_two_things(put, text, message):
    with pytest.raises(rc.ReadError, match=message):
        read_line(put("a.txt", text), unit="um", size="1 mm")


def test_the_name_of_a_lone_column_is_told(put):
    text = "0\n" + "".join(f"{z:.3f}\n" for z in WAVES)
    with pytest.warns(
        SurfaceWarning, match="its first number, 0, is taken for the name of the column, and left out"
    ):
        is_right(read_line(put("a.csv", text), unit="um", size="600 um"), WAVES)


@pytest.mark.parametrize("header", ["# dx: 0.5 um\n# unit: um\n", "width: 600 um\nunit: um\n"])
def test_a_lone_column_under_a_size(put, header):
    is_right(read_line(put("a.csv", header + "".join(f"{z:.3f}\n" for z in WAVES))), WAVES)


@pytest.mark.parametrize(
    ("header", "order"),
    [
        ("y,x,z", (1, 0, 2)),
        ("z [um],x [um],y [um]", (2, 0, 1)),
        ("# Height/um\tY/um\tX/um", (2, 1, 0)),
        ("# y [um] x [um] z [um]", (1, 0, 2)),
        ("row,column,height", (1, 0, 2)),
        (",y,x,z", (1, 0, 2)),
        ("x and y are measured, z too", (0, 1, 2)),
    ],
)
def test_names_of_columns_give_their_order(put, header, order):
    numbered = header.startswith(",")
    lines = [[point[k] for k in order] for point in POINTS]
    text = "".join(",".join([str(n)] * numbered + line) + "\n" for n, line in enumerate(lines))
    path = put("a.xyz", f"{header}\n{text}")
    if numbered:
        with pytest.warns(SurfaceWarning, match="numbers the points"):
            is_right(rc.read(path, unit="um"))
    else:
        is_right(rc.read(path, unit="um"))


def test_each_column_keeps_its_unit_in_another_order(put):
    text = "".join(f"{float(y) / 1e3:g},{x},{float(z) * 1e3:.0f}\n" for x, y, z in POINTS)
    is_right(rc.read(put("a.xyz", f"y [mm],x [um],z [nm]\n{text}")))


def test_a_table_of_numbered_points_leads_to_a_list(put):
    path = put("a.csv", ",x,y,z\n" + points(",", numbered=True))
    with pytest.raises(rc.ReadError, match=r"1152 rows of 4 columns look like a list of coordinates, .*name"):
        rc.read(path, unit="um", size="18 um")
    with pytest.warns(SurfaceWarning, match="numbers the points"):
        is_right(rc.read(path.rename(path.with_suffix(".xyz")), unit="um"))


def in_container(tmp_path, kind, values):
    """Write an array into a file that states nothing about it."""
    path = tmp_path / f"a{kind}"
    if kind == ".npz":
        np.savez(path, data=values)
    elif kind == ".npy":
        np.save(path, values)
    elif kind == ".tif":
        pytest.importorskip("tifffile").imwrite(path, values)
    elif kind == ".mat":
        pytest.importorskip("SurfaceTopography")
        pytest.importorskip("scipy.io").savemat(path, {"data": values})
    else:
        xarray = pytest.importorskip("xarray")
        xarray.Dataset({"data": (("a", "b"), values)}).to_netcdf(path, engine="scipy")
    return path


@pytest.mark.filterwarnings("ignore:Could not import mpi4py")
@pytest.mark.parametrize("kind", [".npz", ".npy", ".tif", ".mat", ".nc"])
@pytest.mark.parametrize(
    ("values", "told"),
    [
        (ARRAY, "1152 rows of 3 are points"),
        (np.c_[np.arange(len(ARRAY)), ARRAY], "1152 rows of 3 are points"),
        (np.c_[np.arange(NY), HILLS], r"first column \(0, 1, 2, ..., 31\) holds places, not heights"),
        (np.r_[np.arange(NX)[None] * 0.5, HILLS], "first row .* holds places, not heights"),
    ],
)
def test_no_container_turns_places_into_heights(tmp_path, kind, values, told):
    path = in_container(tmp_path, kind, values)
    with pytest.warns(SurfaceWarning, match=told):
        is_right(rc.read(path, unit="um", size="18 um"))


def test_numbers_named_heights_are_heights(tmp_path):
    pytest.importorskip("xarray").Dataset(
        {"heights": (("a", "b"), np.random.default_rng(1).random((20, 3)))}
    ).to_netcdf(tmp_path / "a.nc", engine="scipy")
    assert rc.read(tmp_path / "a.nc", unit="um", size="18 um").grid.shape == (20, 3)


def test_heights_before_places_of_a_profile(put):
    text = "".join(f"{z:.4f},{k * 0.5:g}\n" for k, z in enumerate(WAVES))
    is_right(read_line(put("a.csv", "Height [um],Position [um]\n" + text)), WAVES)


def test_a_unit_of_axes_by_name(put):
    text = "".join(f"{k * 5e-4:.4f}\t{z}\n" for k, z in enumerate(WAVES))
    is_right(read_line(put("a.txt", "# X-Axis: mm\n# Z-Axis: um\n" + text), unit="um"), WAVES)


@pytest.mark.parametrize(("kind", "read"), [("txt", read_line), ("xyz", rc.read)])
def test_two_units_in_a_word_are_asked_about(put, kind, read):
    content = profile() if kind == "txt" else points()
    path = put(f"a.{kind}", "# Units: mm um\n" + content)
    with pytest.raises(rc.ReadError, match=r"no size that is understood \(.* mm um.*pass size="):
        read(path, unit="um")
    read(path, unit="um", size=f"{len(WAVES) / 2} um" if kind == "txt" else "18 um")


@pytest.mark.parametrize(
    "header", ["", "Zygo XYZ Data File - Format 1\n1 9 0 1 0 Thu\n0 0 36 32\n0 0 0 0 0\n#\n"]
)
def test_points_of_zygo(put, header):
    lines = [
        f"{x} {y} {'No Data' if np.isnan(HOLED[y, x]) else f'{HOLED[y, x]:.3f}'}\n"
        for y in range(NY)
        for x in range(NX)
    ]
    path = put("a.xyz", header + "".join(lines) + "#\n")
    is_right(rc.read(path, unit="um", size=("16 um", "18 um")), HOLED)


def test_words_with_commas_and_points_are_no_decimals(put):
    path = put("a.csv", "Measured date,2020/01/06\nXY calibration,0.5,um\n1,2,3\n4,5,6\n")
    with pytest.raises(rc.ReadError, match="column 1: 'XY' is not a number"):
        rc.read(path, unit="um", size="18 um")
