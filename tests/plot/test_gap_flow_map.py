"""The picture of a flow: the gap where it is, flow lines where fluid flows, a ring at the constriction."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

import roughcontact as rc

GRID = rc.Grid((24, 40), (2e-6, 1e-6))


def channel(row, narrow):
    """Return the flow along a straight channel of one gap, which is narrow in one column."""
    heights = np.zeros(GRID.shape)
    heights[row - 2 : row + 3] = -1e-3
    heights[row - 2 : row + 3, narrow] = 0
    heights[row, narrow] = -1e-3
    # Much deeper than any deformation: the channel is open, all else is closed.
    return rc.gap_flow(rc.press(rc.Surface(heights, GRID), 1e9, pressure=1e7), axis=1)


def test_gap_contact_lines_and_constriction_lie_where_they_are():
    flow = channel(8, 30)
    axes = flow.plot(Figure().subplots())
    [image] = axes.images
    shown = ~np.ma.getmaskarray(np.ma.masked_invalid(image.get_array()))
    np.testing.assert_array_equal(shown, flow.gap > 0)
    assert image.get_extent() == [0.0, 40.0, 48.0, 0.0]
    assert "gap [µm]" in image.colorbar.ax.get_ylabel()
    [ring] = [patch for patch in axes.patches if hasattr(patch, "radius")]
    y, x = flow.constriction.place
    assert ring.center == pytest.approx((x * 1e6, y * 1e6), rel=1e-12)
    assert ring.center[1] == pytest.approx(17)  # the middle of row 8
    assert abs(ring.center[0] - 30.5) <= 1
    assert "1 open cells across" in axes.get_title()
    [lines] = [each for each in axes.collections if isinstance(each, LineCollection)]
    points = np.concatenate(lines.get_segments())
    assert np.ptp(points[:, 0]) > 20  # along the channel,
    rows = points[:, 1] / 2
    assert 5 < rows.min() < rows.max() < 12  # and hardly beyond it: flux is interpolated between cells
    # The pressure falls along x.
    assert sum(each[-1, 0] - each[0, 0] for each in lines.get_segments()) > 20


def test_a_closed_gap_has_no_lines():
    heights = np.zeros(GRID.shape)
    heights[8, :20] = -1e-3
    flow = rc.gap_flow(rc.press(rc.Surface(heights, GRID), 1e9, pressure=1e7), axis=1)
    axes = flow.plot(Figure().subplots())
    assert axes.get_title() == "no open path leads through the gap"
    assert not axes.collections


def test_cells_without_a_height():
    """Closed they are grey, open they do not stretch the colours; both are named beside the colours."""
    heights = np.random.default_rng(2).normal(0, 1e-7, GRID.shape)
    heights[:, 20] = np.nan
    heights[5, :] = np.nan
    solution = rc.press(rc.Surface(heights, GRID), 1e9, pressure=1e4)
    limits = set()
    for missing, words in (("closed", "closed or not measured"), ("open", "not measured: darkest")):
        flow = rc.gap_flow(solution, axis=1, missing=missing)
        [image] = flow.plot(Figure().subplots()).images
        assert words in image.colorbar.ax.get_ylabel()
        limits.add(image.get_clim())
    assert len(limits) == 1


def test_on_few_cells_lines_end_at_contact():
    flow = channel(8, 30)
    axes = flow.plot(Figure().subplots())
    [lines] = [each for each in axes.collections if isinstance(each, LineCollection)]
    points = np.concatenate(lines.get_segments())
    assert (
        points[:, 1].min() >= 2 * 6 - 0.5
    )  # the channel: rows 6 to 10 of 2 um; lines step over less than a quarter cell
    assert points[:, 1].max() <= 2 * 11 + 0.5
    assert points[:, 0].min() < 0.5  # they begin at the side, not in the middle of the first cell
