"""What a reader or a writer refuses is read or written when its message is followed."""

import warnings
from pathlib import Path

import numpy as np
import pytest

import roughcontact as rc
from followed import MODULUS, ROUGH, follow, row

HEIGHTS = np.random.default_rng(1).random((6, 8))
ROWS = [" ".join(f"{height:.4f}" for height in line) for line in HEIGHTS]
POINTS = [f"{x} {y} {HEIGHTS[y, x]:.4f}" for y in range(6) for x in range(8)]
STATED = {"unit": "um", "size": "8um"}
PEAK = np.where(HEIGHTS.max() - 1e-9 < HEIGHTS, 1e30, HEIGHTS)
RINGS = rc.RadialProfile(np.zeros(4), rc.RadialGrid.uniform(4, 1e-6))


def text(lines, name="a.txt", read=rc.read, **stated):
    """Return what writes lines into a file and reads it."""

    def written():
        Path(name).write_text("\n".join(lines) + "\n")
        return read(name, **STATED | stated)

    return written


def array(values, read=rc.read, **stated):
    def written():
        np.save("a.npy", values)
        return read("a.npy", **STATED | stated)

    return written


def keyed(read=rc.read, **arrays):
    """Return what writes an archive and reads it; what is named `stated` is what the user states."""
    stated = arrays.pop("stated", {})

    def written():
        np.savez("a.npz", **arrays)
        return read("a.npz", **stated)

    return written


def rewritten(name, spoil, read=rc.read):
    """Return what spoils a file that was written before it is read."""

    def spoiled():
        whole = Path(name).read_bytes()
        Path(name).write_bytes(spoil(whole))
        try:
            return read(name)
        finally:
            Path(name).write_bytes(whole)

    return spoiled


def renamed(name, new, **stated):
    def read():
        Path(new).write_bytes(Path(name).read_bytes())
        return rc.read(new, **stated)

    return read


def profile(lines, **stated):
    return text(lines, read=rc.read_line, **{"unit": "um", "size": None} | stated)


def bare(**stated):
    return lambda: rc.read("bare.npy", **stated)


MAP = text(ROWS)
EVEN = ["0 1", "1 2", "2 4", "3 5"]
COPIED = [  # what is whole after it was copied again
    row(
        rewritten("rough.x3p", lambda data: data[:400]),
        "copy or export the file again",
        lambda: rc.read("rough.x3p"),
    ),
    row(
        rewritten("rough.npz", lambda _: b""),
        "it is empty, or not an ordinary file; copy",
        lambda: rc.read("rough.npz"),
    ),
    row(rewritten("rough.nc", lambda data: data[:900]), "again", lambda: rc.read("rough.nc")),
    row(rewritten("bare.npy", lambda data: data[:-9]), "save it again with numpy.save", array(HEIGHTS)),
]

STATEMENTS = [
    row(lambda: rc.read("rouhg.npz"), "check the path and the permissions", lambda: rc.read("rough.npz")),
    row(lambda: rc.read("."), "it is a folder; name a file in it", lambda: rc.read("rough.npz")),
    row(
        bare(),
        "such as unit='um' and size= with the width or (Ly, Lx), such as size='500 um' or size=(4e-4, 5e-4)",
        bare(unit="um", size="500 um"),
        bare(unit="um", size=(4e-4, 5e-4)),
    ),
    row(
        bare(unit="s", size=1e-3),
        "use km, m, cm, mm, um, nm, angstrom or pm, or a number of metres",
        *(bare(unit=unit, size=1e-3) for unit in ("m", "cm", "mm", "um", "nm", "angstrom", "pm", 1e-9)),
    ),
    row(
        bare(unit="um", size="500"),
        "needs a number and a unit, such as '10 um'",
        bare(unit="um", size="10 um"),
    ),
    row(bare(unit="um", size=0), "length must be positive and finite", bare(unit="um", size=1e-3)),
    row(
        bare(unit="um", size=(1e-3, 2e-3, 3e-3)),
        "size needs a width or two lengths (Ly, Lx), not 3",
        bare(unit="um", size=1e-3),
        bare(unit="um", size=(1e-3, 2e-3)),
    ),
    row(
        keyed(a=HEIGHTS, b=HEIGHTS, stated=STATED),
        "'b' (6 x 8, no unit); pass channel= with the name of one of them",
        keyed(a=HEIGHTS, b=HEIGHTS, stated=STATED | {"channel": "a"}),
        keyed(a=HEIGHTS, b=HEIGHTS, stated=STATED | {"channel": "b"}),
    ),
    row(
        lambda: rc.read("rough.npz", channel="colour"),
        "only 'heights' (24 x 32, no unit); pass channel= with one of these names",
        lambda: rc.read("rough.npz", channel="heights"),
    ),
    row(
        keyed(spacing=1e-6),
        "it has none; give a file with a map of heights",
        keyed(heights=HEIGHTS, spacing=1e-6, unit="um"),
    ),
    row(
        keyed(heights=HEIGHTS, spacing=np.ones(5), unit="um"),
        "save one number of metres, or two (y, x)",
        keyed(heights=HEIGHTS, spacing=1e-6, unit="um"),
        keyed(heights=HEIGHTS, spacing=(1e-6, 2e-6), unit="um"),
    ),
    row(
        keyed(heights=HEIGHTS, spacing=1e-6, unit=np.ones(2)),
        "save one name such as 'um', or one number of metres",
        keyed(heights=HEIGHTS, spacing=1e-6, unit="um"),
        keyed(heights=HEIGHTS, spacing=1e-6, unit=1e-6),
    ),
    row(
        keyed(heights=HEIGHTS, spacing=1e-6, unit="um", periodic="yes"),
        "save one truth value, True or False",
        keyed(heights=HEIGHTS, spacing=1e-6, unit="um", periodic=True),
        keyed(heights=HEIGHTS, spacing=1e-6, unit="um", periodic=False),
    ),
]

TEXTS = [
    row(
        text([*ROWS[:2], "Ra Rq Rz Rt a b c d", *ROWS[2:]]),
        "give rows of numbers only; header lines must start with # or have the form name = value",
        MAP,
        text(["# Ra Rq Rz Rt a b c d", *ROWS]),
        text(["Ra = 1", *ROWS]),
    ),
    row(
        text([ROWS[0], ROWS[1].rpartition(" ")[0], *ROWS[2:]]),
        "write nan where a point was not measured, so that all rows are equally long",
        text([ROWS[0], ROWS[1].rpartition(" ")[0] + " nan", *ROWS[2:]]),
    ),
    row(
        text(["0.5,1 2.5", "1,2 3.5"]),
        "write decimal points, and no commas between thousands",
        text(["0.5 1.2 2.5", "1.2 3.5 1.0"]),
    ),
    row(
        text(["20,000;30,000", "21,000;31,000"], "a.csv"),
        "may be 20.000 or 20000; write decimal points, and no commas between thousands",
        text(["20.000;30.000", "21.000;31.000"], "a.csv"),
        text(["20000;30000", "21000;31000"], "a.csv"),
    ),
    row(
        renamed("rough.npz", "a.txt"),
        "it holds zero bytes; rename it to the extension of its format",
        renamed("rough.npz", "b.npz"),
    ),
    row(
        text([*POINTS, POINTS[0]], "a.xyz"),
        "give points on a regular grid, one a place",
        text(POINTS, "a.xyz"),
    ),
    row(
        text(["nan 0 1", *POINTS], "a.xyz"),
        "leave out points without a place",
        text(POINTS, "a.xyz"),
    ),
    row(
        text(POINTS[:8], "a.xyz"),
        "it is a profile; give a two-dimensional map, or use read_line on places and heights",
        text(POINTS, "a.xyz"),
        profile([point.replace(" 0 ", " ") for point in POINTS[:8]], size="8um"),
    ),
    row(
        profile(["0 1", "1 2", "2.5 4", "3 5"], size="8um"),
        "interpolate to even steps first",
        profile(EVEN, size="8um"),
    ),
    row(
        profile([*EVEN[:2], "a b", *EVEN[2:]], size="8um"),
        "'a b' interrupts the rows of numbers; give one column of heights, or two: places along the line and heights",
        profile(EVEN, size="8um"),
        profile([line.split()[1] for line in EVEN], size="8um"),
    ),
    row(
        lambda: rc.read_line("rough.npz"),
        "it is a map of 24 x 32 heights, not a profile; use read",
        lambda: rc.read("rough.npz"),
    ),
    row(
        lambda: rc.read("profile.txt", unit="m"),
        "it is a profile of 64 heights, not a map",
        lambda: rc.read_line("profile.txt", unit="m"),
    ),
]

HIDDEN = [
    row(
        text(ROWS, "a.dat"),
        "rename it to .txt if it is a matrix or a profile, to .xyz if it is a list of points; or export it as X3P",
        text(ROWS, "a.txt"),
        text(POINTS, "a.xyz"),
        lambda: rc.read("rough.x3p"),
    ),
    row(
        renamed("rough.npz", "a.plu"),
        "rename it to .npz if it has this format; or export it as X3P",
        renamed("rough.npz", "b.npz"),
        lambda: rc.read("rough.x3p"),
    ),
]

NUMBERS = [
    row(array(1e12 * HEIGHTS, unit="m"), "pass unit= with the right unit", array(1e12 * HEIGHTS, unit="pm")),
    row(
        array(PEAK),
        "pass unit= with the right unit, or write nan where this number marks a missing point",
        array(np.where(PEAK > 1, np.nan, PEAK)),
    ),
    row(
        array(np.where(PEAK > 1, np.inf, PEAK)),
        "mark points without a measurement by NaN",
        array(np.where(PEAK > 1, np.nan, PEAK)),
    ),
    row(array(np.full((4, 4), np.nan)), "give at least one height", array(np.where(np.eye(4), 1.0, np.nan))),
    row(
        array(1e-60 * HEIGHTS, unit="m"), "pass unit= with the right unit", array(1e-60 * HEIGHTS, unit=1e54)
    ),
    row(array(1j * HEIGHTS), "save the heights as real numbers", array((1j * HEIGHTS).imag)),
    row(
        array(np.zeros((3, 3, 3))), "give a two-dimensional map of heights, rows by columns", array(np.eye(3))
    ),
    row(
        array(np.ones((1, 8))),
        "give a two-dimensional map of at least 2 x 2 heights, or use read_line",
        array(np.eye(2)),
        array(np.ones(8), rc.read_line),
    ),
    row(
        array(np.ones(8)),
        "rows by columns, or use read_line",
        array(np.eye(2)),
        array(np.ones(8), rc.read_line),
    ),
]

CURVES = [
    row(
        lambda: rc.read_curve("curve.csv"),
        "give a .nc file of a curve that rc.write, or the command line, has written",
        lambda: rc.read_curve("curve.nc"),
    ),
    row(lambda: rc.read_curve("rough.nc"), "of a curve that rc.write", lambda: rc.read_curve("curve.nc")),
    row(
        lambda: rc.read_curve("path.nc"),
        "read it with read_adhesive_curve",
        lambda: rc.read_adhesive_curve("path.nc"),
    ),
    row(
        lambda: rc.read_adhesive_curve("curve.nc"),
        "read it with read_curve",
        lambda: rc.read_curve("curve.nc"),
    ),
    row(
        lambda: rc.read("curve.nc"),
        "it holds a loading curve, not heights; read it with rc.read_curve",
        lambda: rc.read_curve("curve.nc"),
    ),
]

WRITTEN = [
    row(
        lambda: rc.write(ROUGH, "a.docx"),
        "written as one of .npz, .nc, .x3p, .txt, .npy, .vti",
        *(
            lambda kind=kind: rc.write(ROUGH, f"a{kind}")
            for kind in (".npz", ".nc", ".x3p", ".txt", ".npy", ".vti")
        ),
    ),
    row(
        lambda: rc.write(ROUGH, "none/a.npz"),
        "create it first",
        lambda: (Path("none").mkdir(), rc.write(ROUGH, "none/a.npz")),
    ),
    row(
        lambda: (Path("b.npz").mkdir(), rc.write(ROUGH, "b.npz")),
        "it is a folder; add a file name",
        lambda: rc.write(ROUGH, "b.npz/a.npz"),
    ),
    row(
        lambda: rc.write(ROUGH.heights, "a.npz"),
        "give a Surface, a solution or a curve",
        lambda: rc.write(ROUGH, "a.npz"),
    ),
    row(
        lambda: rc.write(rc.press(ROUGH, MODULUS, force=1e-4), "a.npz"),
        "is written as one of .nc, .vti; write solution.problem.surface for only its heights",
        lambda: rc.write(rc.press(ROUGH, MODULUS, force=1e-4), "a.nc"),
        lambda: rc.write(rc.press(ROUGH, MODULUS, force=1e-4), "a.vti"),
        lambda: rc.write(rc.press(ROUGH, MODULUS, force=1e-4).problem.surface, "a.npz"),
    ),
    row(
        lambda: rc.write(rc.press(RINGS, MODULUS, force=1e-6), "a.vti"),
        "not rings: write another format",
        lambda: rc.write(rc.press(RINGS, MODULUS, force=1e-6), "a.nc"),
    ),
]


@pytest.fixture
def quiet():
    """Nothing is said of sizes of toys, of what is stated against a file, and of what the other reader looks for."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", rc.SurfaceWarning)
        warnings.simplefilter("ignore", ImportWarning)
        yield


@pytest.mark.parametrize("refusal", [*COPIED, *STATEMENTS, *TEXTS, *NUMBERS, *CURVES, *WRITTEN])
def test_files(refusal, folder, quiet):
    follow(refusal)


@pytest.mark.parametrize("refusal", HIDDEN)
def test_files_under_another_extension(refusal, folder, quiet):
    pytest.importorskip("SurfaceTopography")
    follow(refusal)


@pytest.mark.parametrize("refusal", [*STATEMENTS, *TEXTS, *HIDDEN, *NUMBERS, *CURVES])
def test_what_a_reader_found_whole_is_not_asked_to_be_whole(refusal, folder, quiet):
    with pytest.raises(ValueError) as met:
        refusal.wrong()
    assert "is whole" not in str(met.value)
