"""TrueMap's files, from a writer of a few lines."""

import numpy as np
import pytest

import roughcontact as rc
from instruments import hills, tmd
from roughcontact.files.read import read_line

Z = hills() * 1e-3
HEIGHTS = Z.astype("<f4").astype(float) * 1e-3


@pytest.mark.parametrize("comment", [b"", b"x", b"Created by TrueMap v6\r\n", b"GelSight " * 30, b"\xb5m"])
@pytest.mark.parametrize("padding", [0, 1, 7, 200])
def test_the_comment_may_have_any_length(put, comment, padding):
    surface = rc.read(put("a.tmd", tmd(Z, comment=comment, padding=padding)))
    np.testing.assert_allclose(surface.heights, HEIGHTS, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (2.5e-5, 2.5e-5), rtol=1e-7)  # sides in single precision


def test_points_that_are_no_number_are_missing(put):
    z = Z.copy()
    z[3, 4:7] = np.nan
    assert rc.read(put("a.tmd", tmd(z))).missing == 3


def test_one_line_is_a_profile(put):
    assert read_line(put("a.tmd", tmd(Z[:1]))).grid.shape == (36,)


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda d: d[:-1], "contradict each other"),
        (lambda d: d + b"\0", "contradict each other"),
        (lambda d: d[:32] + b"x" + d[32:], None),  # a longer comment
        (lambda d: d[:56] + b"x" + d[56:], "contradict each other"),
        (lambda d: d.replace(b"v6\r\n\0", b"v6\r\nx"), "contradict each other"),
        (lambda d: d[:56] + b"\x25" + d[57:], "contradict each other"),
        (lambda d: d[:64] + b"\0\0\xc0\x7f" + d[68:], "sides of nan"),
        (lambda d: d[:64] + b"\0\0\x80\xbf" + d[68:], "sides of -1"),
        (lambda d: d[:40], "contradict each other"),
        (lambda d: d[:32] + bytes(10_000_000), "contradict each other"),
        (lambda d: b"x" + d[1:], "does not begin"),
    ],
)
def test_damage_is_refused(put, damage, message):
    path = put("a.tmd", damage(tmd(Z)))
    if message is None:
        np.testing.assert_allclose(rc.read(path).heights, HEIGHTS, rtol=1e-15)
        return
    with pytest.raises(rc.ReadError, match=message):
        rc.read(path)
