"""Profiles: read when asked for, never taken for a map."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_either, read_line

HEIGHTS = np.random.default_rng(3).standard_normal(40).cumsum()


def rows(step=0.5, digits=6, start=2.0, separator=","):
    return "".join(f"{start + k * step:.{digits}f}{separator}{z!r}\n" for k, z in enumerate(HEIGHTS.tolist()))


@pytest.mark.parametrize(
    ("content", "keywords"),
    [
        ("x [mm], z [um]\n" + rows(), {}),
        ("# x (mm)\tz (um)\n" + rows(separator="\t"), {}),
        ("A profile\n\nLateral mm,Raw Micrometer,\n" + rows().replace("\n", ",,\n") + "\n\n", {}),
        (rows(separator=" "), {"unit": "um", "size": "20 mm"}),
        ("".join(f"{z!r}\n" for z in HEIGHTS.tolist()), {"unit": "um", "size": 0.02}),
    ],
)
@pytest.mark.parametrize("name", ["a.csv", "a.txt"])
def test_texts(put, name, content, keywords):
    line = read_line(put(name, content), **keywords)
    np.testing.assert_allclose(line.heights, HEIGHTS * 1e-6, rtol=1e-15)
    np.testing.assert_allclose(line.grid.spacing, (0.5e-3,), rtol=1e-12)
    assert line.grid.periodic == (False,)


VALID = "X;Y;valid\n[mm];[um];[1/0]\n"


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("hole", ["0.0", "99.5", ""])
@pytest.mark.parametrize("name", ["a.csv", "a.txt"])
def test_a_third_column_says_which_heights_are_valid(put, name, hole, decimal):
    lines = [f"{k * 0.5:.3f};{z!r};1\n" for k, z in enumerate(HEIGHTS.tolist())]
    lines[7] = f"3.500;{hole};0\n"
    content = VALID + "".join(lines).replace(".", decimal)
    line = read_line(put(name, content))
    np.testing.assert_allclose(line.grid.spacing, (0.5e-3,), rtol=1e-12)
    assert np.flatnonzero(np.isnan(line.heights)).tolist() == [7]
    measured = np.arange(40) != 7
    np.testing.assert_allclose(line.heights[measured], HEIGHTS[measured] * 1e-6, rtol=1e-15)
    assert read_either(put(name, content)).grid == line.grid


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (VALID + "0;1;1\n1;2;2\n", "interrupts|holds 3 numbers"),
        (VALID + "0;1;1\n1;;1\n", "interrupts"),
        ("X;Y;Z\n0;1;1\n1;2;1\n", "holds 3 numbers"),
    ],
)
def test_a_third_column_that_is_no_validity_is_refused(put, content, message):
    with pytest.raises(rc.ReadError, match=message):
        read_line(put("a.csv", content))


def test_places_without_a_unit_are_in_that_of_the_heights(put):
    line = read_line(put("a.csv", rows()), unit="um", periodic=True)
    np.testing.assert_allclose(line.grid.spacing, (0.5e-6,), rtol=1e-12)
    assert line.grid.periodic == (True,)


def test_what_the_file_leaves_open_is_asked_for(put):
    with pytest.raises(rc.ReadError, match=r"no unit of its heights; pass unit="):
        read_line(put("a.csv", rows()))
    with pytest.raises(rc.ReadError, match=r"no size; pass size= with the length of the line"):
        read_line(put("a.csv", "1\n2\n3\n"), unit="um")
    for size in ((1e-3, 1e-3), "wide", 0):
        with pytest.raises(ValueError, match=r"size|length"):
            read_line(put("a.csv", "1\n2\n3\n"), unit="um", size=size)


def test_places_printed_short_are_even_all_the_same(put):
    line = read_line(put("a.csv", "x [um], z [um]\n" + rows(step=0.156, digits=1)))
    # The ends are printed to 0.1: each is off by half of that at most.
    np.testing.assert_allclose(line.grid.spacing, (0.156e-6,), rtol=0, atol=0.1e-6 / 39)
    assert any("places printed to 0.1 are taken as even steps" in note for note in line.provenance)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (rows().replace("10.000000", "10.400000"), "places are not even"),
        ("0 1\n0 2\n0 3\n", "places run from 0 to 0"),
        ("3 1\n2 2\n1 3\n", "sort the rows"),
        ("0 1\n1 2\nend\n2 3\n", "line 3: 'end' interrupts"),
        ("0 1\n1\n", "line 2 holds 1 numbers"),
        ("0 1 2\n1 2 3\n", "line 1 holds 3 numbers"),
        ("words\n1 2\n", "holds 1 rows"),
        ("words\n", "holds 0 rows"),
        ("0 1\n1 1_0\n", "interrupts"),
        ("0.5 nan\n1 nan\n", "all heights are NaN"),
        ("nan 1\nnan 2\n", "places run from nan"),
    ],
)
def test_what_is_no_line_is_refused(put, content, message):
    with pytest.raises(rc.ReadError, match=r"a\.txt: .*" + message):
        read_line(put("a.txt", content), unit="um")


@pytest.mark.parametrize(("announced", "warning"), [("19.5 um", False), ("19.6 um", False), ("30 um", True)])
def test_an_announced_length_is_compared(put, announced, warning):
    path = put("a.csv", f"Length,{announced}\nx [um],z [um]\n" + rows())
    if warning:
        with pytest.warns(SurfaceWarning, match="announces a length of 3e-05 m and covers 1.95e-05 m"):
            read_line(path)
    else:
        read_line(path)


def test_numpy_files(put, npy, npz):
    line = read_line(put("a.npy", npy(HEIGHTS)), unit="um", size=1e-3)
    np.testing.assert_allclose(line.heights, HEIGHTS * 1e-6, rtol=1e-15)
    named = read_line(put("a.npz", npz(heights=HEIGHTS, unit="nm", spacing=1e-6, periodic=True)))
    assert named.grid == rc.Grid(40, 1e-6, periodic=True)
    other = read_line(put("b.npz", npz(z=HEIGHTS, unit="nm", size=8e-5)), channel="z")
    np.testing.assert_allclose(other.grid.spacing, (2e-6,), rtol=1e-15)


def test_a_profile_in_x3p(put, make_x3p):
    line = read_line(put("a.x3p", make_x3p(HEIGHTS[None] * 1e-6, feature="PRF")))
    np.testing.assert_allclose(line.heights, HEIGHTS * 1e-6, rtol=1e-15)
    assert line.grid.spacing == (3e-6,)


def test_a_map_is_no_line_and_a_line_no_map(put, npy):
    with pytest.raises(rc.ReadError, match=r"a map of 5 x 8 heights, not a profile; use read"):
        read_line(put("a.npy", npy(HEIGHTS.reshape(5, 8))), unit="um", size=1e-3)
    with pytest.raises(
        rc.ReadError, match=r"it is a profile of 40 heights, not a map .*read it by read_line"
    ):
        rc.read(put("a.csv", "x [um], z [um]\n" + rows()))
    with pytest.raises(rc.ReadError, match=r"profiles are not read from \.opd"):
        read_line(put("a.opd", b"any"))
    (channel,) = channels(put("b.csv", "x [um], z [um]\n" + rows()))
    assert (channel.shape, channel.unit, channel.is_height) == ((40,), "um", False)


def test_either_is_what_the_file_holds(put, npy, npz, make_x3p):
    for name, content, keywords in (
        ("a.csv", "x [um], z [um]\n" + rows(), {}),
        ("b.txt", "".join(f"{z!r}\n" for z in HEIGHTS.tolist()), {"unit": "um", "size": 0.02}),
        ("a.npy", npy(HEIGHTS), {"unit": "um", "size": ("2 mm",)}),
        ("a.npz", npz(heights=HEIGHTS, unit="nm", spacing=1e-6), {}),
        ("a.x3p", make_x3p(HEIGHTS[None] * 1e-6, feature="PRF"), {}),
    ):
        path = put(name, content)
        line, same = read_either(path, **keywords), read_line(path, **keywords)
        assert np.array_equal(line.heights, same.heights)
        assert (line.grid, line.provenance) == (same.grid, same.provenance)
    path = put("c.npy", npy(HEIGHTS.reshape(5, 8)))
    for size in (1e-3, (1e-3, 2e-3)):
        found, same = (reader(path, unit="um", size=size) for reader in (read_either, rc.read))
        assert np.array_equal(found.heights, same.heights)
        assert found.grid == same.grid


def test_either_refuses_what_is_neither(put, npy):
    for name, content, message in (
        ("a.npy", npy(HEIGHTS.reshape(1, 40)), "which is not a map"),
        ("a.txt", "1 2 3\n4 5\n", "row 2"),
        ("a.csv", "x [um], z [um]\n1, 2\n", "look like a list of coordinates"),
    ):
        with pytest.raises(rc.ReadError, match=message):
            read_either(put(name, content), unit="um", size=1e-3)
    with pytest.raises(ValueError, match="size needs one length, not 2"):
        read_either(put("b.npy", npy(HEIGHTS)), unit="um", size=(1e-3, 2e-3))
    with pytest.raises(ValueError, match="is not a known unit of length"):
        read_either("nowhere.npy", unit="N")


def test_a_text_has_one_channel(put):
    path = put("a.csv", "x [um], z [um]\n" + rows())
    for reader in (read_line, read_either):
        with pytest.raises(rc.ReadError, match="no channel 'Phase', only 'heights'"):
            reader(path, channel="Phase")
        assert reader(path, channel="heights").grid.shape == (40,)


def test_a_line_is_not_pressed_like_a_map(put):
    line = read_line(put("a.csv", "x [um], z [um]\n" + rows()))
    with pytest.raises(ValueError, match="operator"):
        rc.press(line, 1e9, force=1.0)
