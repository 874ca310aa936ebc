"""The height of Nanoscope scans that are not square, in every way in which their headers state it."""

import numpy as np
import pytest

import roughcontact as rc
from instruments import NANOSCOPE_STEP, hills, nanoscope
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels

pytest.importorskip("SurfaceTopography")


def counts(ny, nx):
    return np.rint(hills(ny, nx) * 9000)


# Points (ny, nx), the sizes and the aspect ratios of the image and of the scan, lines of the scan, height over width.
RIGHT = [
    ((32, 32), "2 2 ~m", "1:1", "1:1", 32, 1.0),
    ((16, 32), "2 2 ~m", "1:1", "1:1", 16, 1.0),  # oblong cells
    ((32, 36), "1.8 1.8 ~m", "1.125:1", "1.125:1", 32, 32 / 36),
    ((16, 32), "2 2 ~m", "2:1", "2:1", 16, 0.5),
    ((8, 32), "2 2 ~m", "4:1", "4:1", 8, 0.25),
    ((64, 32), "2 2 ~m", "1:2", "1:2", 64, 2.0),
    ((64, 32), "2 2 ~m", "0.5:1", "0.5:1", 64, 2.0),
    ((24, 32), "2 2 ~m", "1.33:1", "1.33:1", 24, 0.75),  # the ratio is rounded
    ((16, 32), "2 1 ~m", "2:1", "2:1", 16, 0.5),  # the height stands beside the width
    ((32, 32), "2 1 ~m", "2:1", "2:1", 32, 0.5),
    ((24, 32), "2 2 ~m", "1.3333:1", "1:1", 32, 0.75),  # stopped early
    ((16, 64), "2 2 ~m", "2:1", "1:1", 32, 0.5),  # stopped early, its cells oblong
    ((16, 32), "2000 2000 nm", "2:1", "2:1", 16, 0.5),
    ((16, 32), "2 ~m", "2:1", "2:1", 16, 0.5),
    ((16, 32), "0.002 0.001 mm", "2:1", "2:1", 16, 0.5),
    ((16, 32), "2 2 ~m", None, "2:1", 16, 0.5),
    ((16, 32), "2 2 ~m", "1.01:1", "1:1", 16, 1.0),  # a whole square scan, its ratio inexact
    ((200, 32), "2 2 ~m", "0.1612:1", "0.1612:1", 200, 6.25),  # 0.75 % off: within a line and half a percent
]


@pytest.mark.parametrize(("shape", "size", "aspect", "scan", "lines", "ratio"), RIGHT)
@pytest.mark.parametrize("names", [("Height",), ("Phase", "Height", "ZSensor")])
def test_the_size_is_right(put, shape, size, aspect, scan, lines, ratio, names):
    z = counts(*shape)
    path = put("a.001", nanoscope(z, size=size, aspect=aspect, scan_aspect=scan, lines=lines, names=names))
    surface = rc.read(path, channel="Height")
    np.testing.assert_allclose(
        surface.grid.lengths, (2e-6 * ratio * (0.9 if "1.8" in size else 1), surface.grid.lengths[1])
    )
    assert surface.grid.lengths[1] == pytest.approx(1.8e-6 if "1.8" in size else 2e-6, rel=1e-12)
    np.testing.assert_allclose(surface.heights, z * NANOSCOPE_STEP, rtol=1e-12, atol=1e-22)
    for channel in channels(path):
        np.testing.assert_allclose(channel.size, surface.grid.lengths, rtol=1e-12)


@pytest.mark.parametrize("ratio", ["2", "2:0", "0:1", "none:1", "1:none", "-2:1"])
def test_a_ratio_that_is_none_is_one(put, ratio):
    data = nanoscope(counts(16, 32), size="2 2 ~m", aspect=ratio, scan_aspect=ratio)
    np.testing.assert_allclose(rc.read(put("a.spm", data)).grid.lengths, (2e-6, 2e-6), rtol=1e-12)


def test_images_of_four_bytes_a_point(put):
    z = counts(16, 32)
    data = nanoscope(z * 65536, size="2 2 ~m", aspect="2:1", scan_aspect="2:1", width=4)
    surface = rc.read(put("a.spm", data))
    np.testing.assert_allclose(surface.grid.lengths, (1e-6, 2e-6), rtol=1e-12)
    np.testing.assert_allclose(surface.heights, z * NANOSCOPE_STEP, rtol=1e-12, atol=1e-22)


def test_a_slow_axis_of_its_own_is_the_height(put):
    data = nanoscope(
        counts(16, 32), size="2 2 ~m", aspect="2:1", scan_aspect="2:1", scan=[r"\Slow Axis Size: 1 ~m"]
    )
    np.testing.assert_allclose(rc.read(put("a.spm", data)).grid.lengths, (1e-6, 2e-6), rtol=1e-12)


# What contradicts itself: square by its points and oblong by its ratio, or the other way, or of a third height.
OPEN = [
    ((32, 32), "2 2 ~m", "2:1", "2:1", 32),
    ((16, 32), "2 2 ~m", "4:1", "4:1", 16),
    ((16, 32), "2 2 ~m", "1:2", "1:2", 16),
    ((16, 32), "2 0.7 ~m", "2:1", "2:1", 16),
    ((30, 32), "2 2 ~m", "0.51216:1", "0.51216:1", 30),
    ((200, 32), "2 2 ~m", "0.1622:1", "0.1622:1", 200),  # 1.4 % off: more than a line and half a percent
]


@pytest.mark.parametrize(("shape", "size", "aspect", "scan", "lines"), OPEN)
def test_sizes_that_contradict_each_other_are_asked_about(put, shape, size, aspect, scan, lines):
    z = counts(*shape)
    path = put("a.001", nanoscope(z, size=size, aspect=aspect, scan_aspect=scan, lines=lines))
    with pytest.raises(
        rc.ReadError, match=rf"a scan size of {size}, an aspect ratio of {aspect}.*pass size="
    ):
        rc.read(path)
    assert channels(path)[0].size is None
    surface = rc.read(path, size=("1 um", "2 um"))
    np.testing.assert_allclose(surface.grid.lengths, (1e-6, 2e-6), rtol=1e-12)
    np.testing.assert_allclose(surface.heights, z * NANOSCOPE_STEP, rtol=1e-12, atol=1e-22)


def test_a_width_of_zero_is_replaced_by_the_size_that_is_given(put):
    path = put("a.001", nanoscope(counts(16, 32), size="0 1 ~m", aspect="2:1", scan_aspect="2:1"))
    with pytest.raises(rc.ReadError, match=r"it states cells of .* x 0 m; pass size="):
        rc.read(path)
    with pytest.warns(SurfaceWarning, match="as given, instead of the file's"):
        surface = rc.read(path, size=("1 um", "2 um"))
    assert surface.grid.lengths == pytest.approx((1e-6, 2e-6), rel=1e-12)


@pytest.mark.parametrize("spare", [b"\0", b"\0" * 63])
def test_a_byte_more_is_warned_of(put, spare):
    """A byte that came in before the heights moves them all, and the file ends a byte later."""
    with pytest.warns(SurfaceWarning, match=f"{len(spare)} bytes at its end belong to no channel"):
        rc.read(put("a.001", nanoscope(counts(32, 32), size="2 2 ~m", aspect="1:1", spare=spare)))
