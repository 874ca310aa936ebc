"""Gwyddion's simple field, from a writer of a few lines."""

import numpy as np
import pytest

import roughcontact as rc
from instruments import gsf, hills
from roughcontact.files.gsf import _count
from roughcontact.files.read import channels, read_line

Z = hills() * 1e-6


def single(z):
    return z.astype("<f4").astype(float)


@pytest.mark.parametrize("shape", [(32, 36), (3, 40), (40, 3)])
@pytest.mark.parametrize("title", ["", "T", "Tw", "Thr", "Four"])  # zeros fill the header up by one to four
def test_heights_and_cells(put, shape, title):
    z = hills(*shape) * 1e-6
    surface = rc.read(put("a.gsf", gsf(z, Title=title)))
    assert np.array_equal(surface.heights, single(z))
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 5e-7), rtol=1e-14)


@pytest.mark.parametrize(
    ("unit", "factor"), [("m", 1.0), ("nm", 1e-9), ("µm", 1e-6), ("um", 1e-6), ("mm", 1e-3)]
)
def test_units_that_the_file_states(put, unit, factor):
    z = Z / factor
    path = put("a.gsf", gsf(z, XReal=36 * 5e-7 / factor, YReal=32 * 4e-7 / factor, XYUnits=unit, ZUnits=unit))
    surface = rc.read(path)
    np.testing.assert_allclose(surface.heights, single(z) * factor, rtol=1e-15)
    np.testing.assert_allclose(surface.grid.spacing, (4e-7, 5e-7), rtol=1e-12)


@pytest.mark.parametrize(
    ("changes", "problem", "given"),
    [
        ({"drop": ("XReal",)}, "states no size", {"size": "18 um"}),
        ({"drop": ("YReal",)}, "states no size", {"size": "18 um"}),
        ({"drop": ("XReal", "YReal")}, "states no size", {"size": "18 um"}),
        (
            {"drop": ("XYUnits",)},
            r"no size that is understood \(sides of 1\.8e-05 x 1\.6e-05 \(x, y\) in no unit",
            {"size": "18 um"},
        ),
        ({"XYUnits": "deg"}, "in 'deg'", {"size": "18 um"}),
        ({"drop": ("ZUnits",)}, "no unit of its heights", {"unit": "m"}),
        ({"ZUnits": ""}, "no unit of its heights", {"unit": "m"}),
        ({"ZUnits": "V"}, "heights in 'V'", {"unit": "m"}),
        ({"drop": ("ZUnits", "XReal")}, "no unit of its heights and no size", {"unit": "m", "size": 18e-6}),
    ],
)
def test_what_the_header_lacks_is_asked_for_and_then_read(put, changes, problem, given):
    path = put("a.gsf", gsf(Z, **changes))
    with pytest.raises(rc.ReadError, match=rf"a\.gsf: .*{problem}.*pass ") as refused:
        rc.read(path)
    assert all(f"{name}=" in refused.value.remedy for name in given)
    surface = rc.read(path, **given)
    assert np.array_equal(surface.heights, single(Z))
    np.testing.assert_allclose(surface.grid.spacing, (5e-7, 5e-7), rtol=1e-14)


def test_points_that_are_no_number_are_missing(put):
    z = Z.copy()
    z[3, 4:7] = np.nan
    surface = rc.read(put("a.gsf", gsf(z)))
    assert surface.missing == 3
    assert np.isnan(surface.heights[3, 4:7]).all()


def test_one_line_is_a_profile(put):
    path = put("a.gsf", gsf(Z[:1]))
    assert read_line(path).grid.spacing == pytest.approx((5e-7,), rel=1e-14)
    with pytest.raises(rc.ReadError, match=r"profile of 36 heights.*read_line"):
        rc.read(path)


def test_its_channel_is_listed(put):
    (channel,) = channels(put("a.gsf", gsf(Z, Title="Topography")))
    assert (channel.name, channel.shape, channel.unit, channel.is_height) == (
        "Topography",
        (32, 36),
        "m",
        True,
    )


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda d: d[:-1], "take 4607 bytes where 32 x 36 points need 4608"),
        (lambda d: d + b"\0", "take 4609 bytes"),
        (lambda d: d.replace(b"XRes = 36", b"XRes = 26"), "take 4608 bytes where 32 x 26"),
        (lambda d: d.replace(b"XRes = 36", b"XRes = -6"), "states '-6' for XRes"),
        (lambda d: d.replace(b"XRes = 36", b"XRes = 9999999999"), "take 4608 bytes where 32 x 9999999999"),
        (lambda d: d.replace(b"XRes = 36", b"XRes = 10000000000"), "states '10000000000' for XRes"),
        (lambda d: d.replace(b"XRes = 36", b"XRes = 0"), "states '0' for XRes"),
        (lambda d: d.replace(b"XRes = 36", "XRes = ٣٦".encode()), "states '٣٦' for XRes"),
        (lambda d: d.replace(b"XRes", b"xRes"), "states '' for XRes"),
        (lambda d: d.replace(b"YReal = 1.6", b"YReal = 1,6"), "for YReal"),
        (lambda d: d.replace(b"YReal = 1.6", b"YReal = -.6"), "for YReal"),
        (lambda d: d.replace(b"YReal = 1.6", b"YReal = 0.0"), "for YReal"),
        (lambda d: d.replace(b"XYUnits = m", b"ZUnits = mm"), "states twice: 'ZUnits'"),
        (lambda d: d.replace(b"YRes =", b"YRes  "), "holds a line without ="),
        (lambda d: d.replace(b"\0", b" "), r"no zero byte|where"),
        (lambda d: b"gwyddion" + d[8:], "does not begin"),
        (lambda d: d[:100], "a.gsf"),
    ],
)
def test_damage_is_refused(put, damage, message):
    with pytest.raises(rc.ReadError, match=message):
        rc.read(put("a.gsf", damage(gsf(Z))))


@pytest.mark.parametrize("zeros", [1, 5000])  # Python converts no text of more than 4300 digits
def test_zeros_before_a_number_of_points_do_not_count(zeros):
    assert _count({"XRes": "0" * zeros + "36"}, "XRes") == 36
