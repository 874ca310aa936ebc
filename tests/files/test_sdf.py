"""SDF, binary and text, of ISO 25178-71 and of the BCR proposal, from writers of a few lines."""

import struct

import numpy as np
import pytest

import roughcontact as rc
from instruments import SDF_TYPES, hills, sdf_binary, sdf_text
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import read_line

STEP = 1e-9
MARKS = ["ISO-1.0", "ISO-2.0", "BCR-1.0", "BCR-0.0"]


def counts_for(kind):
    """Return numbers that the type holds, none of them at either end."""
    z = hills()
    if kind in (3, 7):
        return z.astype(SDF_TYPES[kind]).astype(float) * 1000
    low, high = {0: (1, 254), 4: (-127, 126)}.get(kind, (0 if kind < 3 else -9000, 9000))
    return np.rint(low + (z - z.min()) / np.ptp(z) * (high - low))


@pytest.mark.parametrize("kind", range(8))
@pytest.mark.parametrize("mark", MARKS)
def test_every_type_in_either_form(put, mark, kind):
    counts = counts_for(kind)
    for path in (
        put("a.sdf", sdf_binary(counts, kind, mark=f"b{mark}")),
        put("b.sdf", sdf_text(counts, kind, mark=f"a{mark}")),
        put(
            "c.sdf",
            sdf_text(
                counts, kind, mark=f"a{mark}", newline="\r\n", end="*\n<Operator>nobody</Operator>\n*\n"
            ),
        ),
        put("d.sdf", sdf_text(counts, kind, mark=f"a{mark}", end="", NumDataSet=1, NanPresent=0)),
    ):
        surface = rc.read(path)
        np.testing.assert_allclose(surface.heights, counts * STEP, rtol=1e-6 if kind == 3 else 1e-14)
        np.testing.assert_allclose(surface.grid.spacing, (4e-7, 5e-7), rtol=1e-14)
        assert surface.missing == 0


# The mark of a missing point, and whether readers agree on it.
MISSING = [
    ("ISO-1.0", 1, 2**16 - 1, True),
    ("ISO-1.0", 2, 2**32 - 1, True),
    ("ISO-1.0", 5, -(2**15), True),
    ("ISO-1.0", 6, -(2**31), True),
    ("ISO-1.0", 3, float(np.finfo("f4").min), True),
    ("ISO-1.0", 7, float(np.finfo("f8").min), True),
    ("ISO-1.0", 7, np.nan, True),
    ("ISO-2.0", 3, np.nan, True),
    ("BCR-1.0", 1, 2**16 - 1, True),
    ("BCR-1.0", 5, 2**15 - 1, False),
    ("BCR-1.0", 5, -(2**15), False),
    ("BCR-1.0", 6, 2**31 - 1, False),
    ("BCR-1.0", 6, -(2**31), False),
    ("BCR-1.0", 3, float(np.finfo("f4").max), True),
    ("BCR-1.0", 7, float(np.finfo("f8").max), True),
]


@pytest.mark.filterwarnings("ignore:4 points hold:roughcontact.files.file_errors.SurfaceWarning")
@pytest.mark.parametrize(("mark", "kind", "bad", "agreed"), MISSING)
def test_what_was_not_measured(put, recwarn, mark, kind, bad, agreed):
    counts = counts_for(kind)
    counts[4, 5:9] = bad
    for path in (
        put("a.sdf", sdf_binary(counts, kind, mark=f"b{mark}")),
        put("b.sdf", sdf_text(counts, kind, mark=f"a{mark}", bad="NaN")),
    ):
        if agreed:
            surface = rc.read(path)
        else:
            with pytest.warns(SurfaceWarning, match="4 points hold the lowest or highest number"):
                surface = rc.read(path)
        assert np.isnan(surface.heights[4, 5:9]).all()
        assert surface.missing == 4


def test_bad_in_a_text_is_missing(put):
    counts = counts_for(6)
    counts[7, 9] = np.nan
    for bad in ("BAD", "bad", "NaN"):
        surface = rc.read(put("a.sdf", sdf_text(counts, 6, mark="aBCR-1.0", bad=bad)))
        assert np.array_equal(np.isnan(surface.heights), np.isnan(counts))


@pytest.mark.parametrize(("kind", "end"), [(0, 255), (4, -128)])
def test_the_end_of_a_byte_is_a_height_and_warned_of(put, kind, end):
    counts = counts_for(kind)
    place = np.unravel_index(np.argmax(counts if end > 0 else -counts), counts.shape)
    counts[place] = end
    with pytest.warns(SurfaceWarning, match=f"1 points hold {end}, which may mark"):
        surface = rc.read(put("a.sdf", sdf_binary(counts, kind)))
    assert surface.heights[place] == pytest.approx(end * STEP, rel=1e-14)


def test_words_of_its_text_may_be_written_otherwise(put):
    text = sdf_text(counts_for(5), 5).replace(
        b"NumPoints = 36", b"numpoints=36 ; points a profile\n; a comment"
    )
    assert rc.read(put("a.sdf", text)).grid.shape == (32, 36)


def test_the_header_of_olympus_is_eight_bytes_longer(put):
    counts = counts_for(5)
    surface = rc.read(put("a.sdf", sdf_binary(counts, 5, extra=struct.pack("<2I", 5, 1))))
    np.testing.assert_allclose(surface.heights, counts * STEP, rtol=1e-14)


@pytest.mark.parametrize(
    "trailer", [b"*\r\n<Operator>nobody</Operator>\r\n*\r\n", b"Operator = nobody\n", b"<a>b</a>"]
)
def test_a_text_may_follow_its_heights(put, trailer):
    assert rc.read(put("a.sdf", sdf_binary(counts_for(5), 5, trailer=trailer))).missing == 0


@pytest.mark.parametrize("spare", [b"x", b"\0" * 8, b"\xff" * 100])
def test_other_bytes_behind_its_heights_are_warned_of(put, spare):
    with pytest.warns(SurfaceWarning, match=f"{len(spare)} bytes at its end belong to no height"):
        rc.read(put("a.sdf", sdf_binary(counts_for(7), 7, trailer=spare)))


def test_a_single_profile_is_a_line(put):
    for data in (
        sdf_binary(counts_for(5)[:1], 5, steps=(5e-7, 0.0, STEP)),
        sdf_text(counts_for(5)[:1], 5, steps=(5e-7, 0.0, STEP)),
    ):
        path = put("a.sdf", data)
        assert read_line(path).grid.spacing == (5e-7,)
        with pytest.raises(rc.ReadError, match="read_line"):
            rc.read(path)


def test_a_text_that_ends_within_its_last_number_is_warned_of(put):
    whole = sdf_text(counts_for(5), 5, end="")
    with pytest.warns(SurfaceWarning, match="its last number may lack digits"):
        rc.read(put("a.sdf", whole[:-2]))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (sdf_binary(counts_for(5), 5)[:-1], "it holds 2303 of 2304 bytes of heights"),
        (sdf_binary(counts_for(5), 5)[:60], "ends within its header"),
        (sdf_binary(counts_for(5), 5, mark="bISO-3.0"), "does not begin with aISO-1.0"),
        (sdf_binary(counts_for(5), 5, flags=(1, 0)), "1 for Compression"),
        (sdf_binary(counts_for(5), 5, flags=(0, 2)), "2 for CheckType"),
        (sdf_binary(counts_for(5), 5).replace(b"\x05\0", b"\x08\0", 1), "of type 8"),
        (sdf_binary(counts_for(5), 5, steps=(0.0, 1e-6, 1e-9)), "0 for Xscale"),
        (sdf_binary(counts_for(5), 5, steps=(1e-6, np.nan, 1e-9)), "nan for Yscale"),
        (sdf_binary(counts_for(5), 5, steps=(1e-6, 1e-6, -1e-9)), "-1e-09 for Zscale"),
        (sdf_text(counts_for(5), 5, NumPoints=35), "holds 1152 heights where its header states 32 x 35"),
        (sdf_text(counts_for(5), 5, NumPoints="3x"), "states '3x' for NumPoints"),
        (sdf_text(counts_for(5), 5, NumPoints=-36), "states -36 for NumPoints"),
        (sdf_text(counts_for(5), 5, NumPoints=36.5), "states 36.5 for NumPoints"),
        (sdf_text(counts_for(5), 5).replace(b"DataType", b"Datatipe"), "lacks DataType"),
        (sdf_text(counts_for(5), 5).replace(b"ManufacID", b"CheckType"), "states 'nobody' for CheckType"),
        (sdf_text(counts_for(5), 5).replace(b"Zresolution = -1", b"Zscale = 1"), "states Zscale twice"),
        (sdf_text(counts_for(5), 5).replace(b"*", b"+"), "no line with \\* ends its header"),
        (sdf_text(counts_for(5), 5).replace(b"*\n", b"*\n1_0", 1), "its height 1 is '1_0.*', not a number"),
        (sdf_text(counts_for(5), 5).replace(b"*\n", b"*\nx", 1), "its height 1 is 'x.*', not a number"),
    ],
)
def test_damage_is_refused(put, data, message):
    with pytest.raises(rc.ReadError, match=rf"a\.sdf: .*{message}"):
        rc.read(put("a.sdf", data))
