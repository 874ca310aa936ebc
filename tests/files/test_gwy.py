"""Gwyddion's own files, from a writer of a few lines."""

import struct

import numpy as np
import pytest

import roughcontact as rc
from instruments import gwy, gwy_field, gwy_item, gwy_object, hills
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.read import channels, read_line

Z = hills() * 1e-6
CELL = (4e-7, 5e-7)


@pytest.mark.parametrize("title", ["Height", None, "ZSensor"])
@pytest.mark.parametrize("shape", [(32, 36), (40, 3)])
def test_heights_and_cells(put, title, shape):
    z = hills(*shape) * 1e-6
    surface = rc.read(put("a.gwy", gwy(gwy_field(z), titles=(title,))))
    assert np.array_equal(surface.heights, z)
    np.testing.assert_allclose(surface.grid.spacing, CELL, rtol=1e-14)


@pytest.mark.parametrize(
    ("units", "problem", "given"),
    [
        (
            (None, None),
            "no unit of its heights and no size that is understood .*in no unit",
            {"unit": "m", "size": "18 um"},
        ),
        (
            ("", ""),
            "no unit of its heights and no size that is understood .*in no unit",
            {"unit": "m", "size": "18 um"},
        ),
        (("", "m"), "no size that is understood .sides of .* in no unit", {"size": ("16 um", "18 um")}),
        (("m", ""), "states no unit of its heights;", {"unit": "m"}),
        (("deg", "m"), "in 'deg'", {"size": 18e-6}),
    ],
)
def test_units_that_are_absent_are_asked_for_and_then_read(put, units, problem, given):
    path = put("a.gwy", gwy(gwy_field(Z, units, sides=(18e-6, 16e-6))))
    with pytest.raises(rc.ReadError, match=rf"a\.gwy: .*{problem}.*pass ") as refused:
        rc.read(path)
    assert all(f"{name}=" in refused.value.remedy for name in given)
    surface = rc.read(path, **given)
    assert np.array_equal(surface.heights, Z)
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 5e-7), rtol=1e-14)


def test_a_channel_of_volts_is_listed_and_not_taken(put):
    path = put("a.gwy", gwy(gwy_field(Z, ("m", "V")), gwy_field(Z + 1e-6), titles=("Height", "Height")))
    assert [(c.name, c.unit, c.is_height) for c in channels(path)] == [
        ("Height", "V", False),
        ("Height#2", "m", True),
    ]
    assert np.array_equal(rc.read(path).heights, Z + 1e-6)
    alone = put("b.gwy", gwy(gwy_field(Z, ("m", "V"))))
    with pytest.raises(rc.ReadError, match=r"no channel is a height.*'Height' \(32 x 36, V\).*pass channel="):
        rc.read(alone)
    with pytest.warns(SurfaceWarning) as said:
        surface = rc.read(alone, channel="Height", unit="m")
    assert np.array_equal(surface.heights, Z)
    assert any("in V is not marked as heights" in str(one.message) for one in said)


def test_two_heights_are_warned_of(put):
    path = put("a.gwy", gwy(gwy_field(Z), gwy_field(-Z), titles=("Height", "Topography")))
    with pytest.warns(SurfaceWarning, match="2 channels are heights .*took 'Height', pass channel="):
        assert np.array_equal(rc.read(path).heights, Z)
    assert np.array_equal(rc.read(path, channel="Topography").heights, -Z)


def test_points_under_a_mask_are_missing(put):
    mask = np.zeros(Z.shape)
    mask[3, 4:7] = 1
    surface = rc.read(put("a.gwy", gwy(gwy_field(Z), masks=(mask,))))
    assert np.array_equal(np.isnan(surface.heights), mask == 1)
    assert any("3 points under its mask" in line for line in surface.provenance)


def test_what_else_the_tree_holds_is_passed_over(put):
    extra = (
        gwy_item("/filename", "s", "C:\\µ")
        + gwy_item("/0/base/range-type", "i", 2)
        + gwy_item("/0/data/visible", "b", True)
        + gwy_item("names", "S", ["a", "b"])
        + gwy_item("/0/meta", "o", gwy_object("GwyContainer", gwy_item("n", "q", 3)))
        + gwy_item("/brick/0/data", "o", gwy_object("Unknown", b"?"))
    )
    assert np.array_equal(rc.read(put("a.gwy", gwy(gwy_field(Z), extra=extra))).heights, Z)


def test_one_line_is_a_profile(put):
    assert read_line(put("a.gwy", gwy(gwy_field(Z[:1])))).grid.spacing == pytest.approx((5e-7,), rel=1e-14)


def test_a_file_without_a_channel_is_refused_for_what_it_lacks(put):
    with pytest.raises(rc.ReadError, match="holds no channel; give a file of Gwyddion with a channel"):
        rc.read(put("a.gwy", gwy(extra=gwy_item("/filename", "s", "x"))))


def changed(old, new):
    return lambda d: d.replace(old, new)


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda d: d[:-1], "cut short"),
        (lambda d: d + b"\0", "damaged"),
        (changed(b"xresi\x24", b"xresi\x23"), "damaged"),
        (changed(b"xresi\x24", b"xresi\0"), "damaged"),
        (changed(b"xres\0i\x24\0\0\0", b"xres\0i\x23\0\0\0"), "32 x 35 points with 1152 numbers"),
        (changed(b"xres\0i\x24\0\0\0", b"xres\0i\xff\xff\xff\xff"), "damaged"),
        (changed(b"xres\0i", b"xres\0s"), "damaged"),
        (changed(b"xres\0i", b"xres\0?"), "unknown kind"),
        (changed(b"xres\0i", b"yres\0i"), "damaged .*'xres'"),
        (changed(b"data\0D", b"data\0Q"), "damaged"),
        (changed(struct.pack("<I", 1152), struct.pack("<I", 2**31)), "reaches beyond"),
        (changed(b"GwyDataField", b"GwyDataFielt"), "a GwyDataFielt"),
        (changed(b"GwyContainer", b"GwyContainar"), "a GwyContainar"),
        (lambda d: b"GWYQ" + d[4:], "does not begin"),
        (lambda d: bytes(10_000_000), "does not begin"),
    ],
)
def test_damage_is_refused(put, damage, message):
    whole = gwy(gwy_field(Z))
    spoilt = damage(whole)
    if spoilt == whole:
        return
    with pytest.raises(rc.ReadError, match=rf"a\.gwy: .*{message}"):
        rc.read(put("a.gwy", spoilt))


def test_a_mask_of_another_size_is_refused(put):
    with pytest.raises(rc.ReadError, match=r"a mask of \(3, 3\) points"):
        rc.read(put("a.gwy", gwy(gwy_field(Z), masks=(np.zeros((3, 3)),))))
