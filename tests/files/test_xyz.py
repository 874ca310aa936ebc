"""Lists of points."""

import numpy as np
import pytest

import roughcontact as rc

RNG = np.random.default_rng(7)
HEIGHTS = RNG.standard_normal((5, 7))


def points(heights=HEIGHTS, dx=0.438027, dy=2.0, keep=None, digits=6, order=None):
    rows, columns = np.indices(heights.shape).reshape(2, -1)
    places = np.arange(heights.size) if keep is None else keep
    places = places if order is None else order.permutation(places)
    return (
        "".join(
            f"{columns[k] * dx:.{digits}g}\t{rows[k] * dy + 3:.{digits}g}\t{heights.flat[k]!r}\n".replace(
                "np.float64", ""
            )
            for k in places
        )
        .replace("(", "")
        .replace(")", "")
    )


@pytest.mark.parametrize("header", ["# x [um] y [um] z [nm]\n", "# x (um)\ty (um)\tz (nm)\n"])
def test_points_in_any_order_with_units(put, header):
    surface = rc.read(put("a.xyz", header + points(order=RNG)))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)
    # The last coordinate is printed with six digits: half a unit of the sixth of 2.62816 over six steps.
    np.testing.assert_allclose(surface.grid.spacing, (2e-6, 0.438027e-6), rtol=0, atol=1e-6 * 5e-6 / 6)


def test_gaps_are_missing_points(put):
    gaps = [0, 8, 9, 34]
    keep = np.setdiff1d(np.arange(HEIGHTS.size), gaps)
    surface = rc.read(put("a.xyz", points(keep=keep)), unit="um")
    expected = HEIGHTS.copy()
    expected.flat[gaps] = np.nan
    np.testing.assert_allclose(surface.heights, expected * 1e-6, rtol=1e-15)


def test_a_column_and_a_row_without_points_are_missing(put):
    keep = np.flatnonzero((np.indices(HEIGHTS.shape)[1] != 2) & (np.indices(HEIGHTS.shape)[0] != 1))
    surface = rc.read(put("a.xyz", points(keep=keep)), unit="um")
    assert surface.grid.shape == HEIGHTS.shape
    assert np.isnan(surface.heights[:, 2]).all()
    assert np.isnan(surface.heights[1]).all()
    assert surface.missing == 5 + 7 - 1


def test_few_digits_do_not_add_up_along_a_wide_map(put):
    wide = 0.01 * RNG.standard_normal((2, 900)).cumsum(axis=1)
    surface = rc.read(put("a.xyz", points(wide, dx=0.33333333, digits=5)), unit="um")
    np.testing.assert_allclose(surface.heights, wide * 1e-6, rtol=1e-15)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("".join(f"{x} {y} 1\n" for x, y in RNG.random((40, 2))), "scattered"),
        ("".join(f"{k} 0 1\n" for k in range(9)), "share one y: it is a profile"),
        ("0 0 1\n1 0 1\n0 1 1\n1 1 1\n1 1 2\n", "share one place"),
        ("0 0\n1 0\n", "its rows hold 2 numbers; give three columns"),
        ("0 0 1\nnan 0 1\n0 1 1\n", "not finite"),
    ],
)
def test_what_is_no_grid_is_refused(put, content, message):
    with pytest.raises(rc.ReadError, match=r"bad\.xyz: .*" + message):
        rc.read(put("bad.xyz", content), unit="um")


def test_a_list_without_units_asks_for_one(put):
    with pytest.raises(rc.ReadError, match=r"no unit of its heights; pass unit="):
        rc.read(put("a.xyz", points()))


@pytest.mark.parametrize("by_columns", [False, True])
@pytest.mark.parametrize("left", [29, 35])
def test_a_scan_that_ends_within_a_line_may_be_cut_short(put, by_columns, left):
    """Row by row or column by column; in another order a missing point is one that was not measured."""
    scan = np.arange(HEIGHTS.size).reshape(HEIGHTS.shape)
    order = (scan.T if by_columns else scan).ravel()[:left]
    file = put("a.xyz", points(keep=order))
    if left == HEIGHTS.size:
        rc.read(file, unit="um")
    else:
        whole = 30 if by_columns else 35  # columns that were not begun are no part of it
        with pytest.warns(rc.SurfaceWarning, match=f"it ends after 29 of {whole} points, within a line"):
            rc.read(file, unit="um")
    rc.read(put("b.xyz", points(keep=np.r_[order[3:29], order[:2]])), unit="um")
