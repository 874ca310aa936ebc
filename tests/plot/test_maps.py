"""Maps: the right way up, in readable units, and contact that can be seen however small."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import written
from roughcontact.plot.drawing.marks import contact_window, faint_spots
from roughcontact.plot.drawing.raster import part, pooled
from roughcontact.plot.maps import contact_map, height_map, pressure_map

MODULUS = 1e11


def peaks(shape: tuple[int, int], cells: list[tuple[int, int]], missing: int = 0) -> rc.Surface:
    """Return a flat surface with towers of equal height on single cells."""
    heights = np.zeros(shape)
    for cell in cells:
        heights[cell] = 1e-6
    heights.flat[:missing] = np.nan
    return rc.Surface(heights, rc.Grid(shape, (2e-7, 1e-7)))


def pressed(shape: tuple[int, int], cells: list[tuple[int, int]], missing: int = 0) -> rc.Solution:
    return rc.press(peaks(shape, cells, missing), MODULUS, force=1e-5)


def painted(figure: Figure) -> np.ndarray:
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].astype(int)


def single(size: float = 4.0) -> tuple[Figure, object]:
    figure = Figure(figsize=(size, size), dpi=100)
    return figure, figure.add_axes((0.1, 0.1, 0.8, 0.8))


def test_row_zero_is_on_top_and_cells_lie_where_they_are():
    solution = pressed((20, 30), [(4, 25)])
    _, axes = single()
    pressure_map(solution, axes)
    image = axes.images[-1]
    left, right, bottom, top = image.get_extent()
    # 30 cells of 0.1 um and 20 cells of 0.2 um, y pointing down.
    assert (left, right) == pytest.approx((0.0, 3.0), rel=1e-14)
    assert (top, bottom) == pytest.approx((0.0, 4.0), rel=1e-14)
    assert axes.get_ylim()[0] > axes.get_ylim()[1]
    shown = np.argwhere(~np.ma.getmaskarray(np.ma.masked_invalid(image.get_array())))
    assert shown.tolist() == [[4, 25]]
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_aspect()) == ("x [µm]", "y [µm]", 1.0)
    peak = 1e-5 / 2e-14  # all of the force on the one cell
    assert image.get_array()[4, 25] == pytest.approx(peak * 1e-6, rel=1e-9)
    assert image.colorbar.ax.get_ylabel() == "pressure [MPa]"
    heights = axes.images[0]  # in grey, behind
    assert heights.get_extent() == image.get_extent()
    np.testing.assert_allclose(heights.get_array(), solution.problem.surface.heights * 1e6, rtol=1e-12)


def test_the_axes_have_the_unit_of_the_longer_side():
    """Of a strip of 2 mm by 5 um; the unit of a height is its own."""
    grid = rc.Grid((5, 400), (1e-6, 5e-6))
    heights = np.random.default_rng(2).normal(0.0, 1e-9, grid.shape)
    axes = height_map(rc.Surface(heights, grid), Figure().subplots())
    assert axes.images[0].get_extent() == pytest.approx((0.0, 2.0, 0.005, 0.0), rel=1e-12)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "y [mm]")
    np.testing.assert_allclose(axes.images[0].get_array(), heights * 1e9, rtol=1e-12)
    assert axes.images[0].colorbar.ax.get_ylabel() == "height [nm]"


@pytest.mark.parametrize("draw", [pressure_map, contact_map])
def test_one_cell_in_a_quarter_of_a_million_is_seen_where_it_is(draw):
    solution = pressed((512, 512), [(100, 400)])
    assert solution.contact.sum() == 1
    figure, axes = single()
    draw(solution, axes)
    before = painted(figure)
    # The picture differs from that of the bare heights only by the mark.
    bare, plain = single()
    draw(rc.press(solution.problem.surface, MODULUS, depth=0.0), plain)
    plain.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
    changed = np.argwhere(np.abs(before - painted(bare)).sum(axis=-1) > 100)
    frame = axes.get_window_extent()
    changed = changed[(changed[:, 1] > frame.x0) & (changed[:, 1] < frame.x1)]  # not those of the colour bar
    assert len(changed) >= 9  # pixels: more than a speck of dust
    x, y = axes.transData.transform((40.05, 20.1))  # the centre of the cell [um]
    assert np.abs(changed.mean(axis=0) - (before.shape[0] - y, x)).max() < 3  # pixels


@pytest.mark.parametrize("window", [None, (slice(80, 336), slice(256, 512))], ids=["map", "window"])
@pytest.mark.parametrize("draw", [pressure_map, contact_map])
def test_marks_and_cells_are_drawn_where_they_are(draw, window):
    """Marks on the centres of their cells, to the last digits; pictures from edge to edge."""
    cells = [(100, 400), (300, 280)]
    solution = pressed((512, 512), cells)
    _, axes = single()
    draw(solution, axes, window=window)
    (marks,) = axes.collections
    y, x = (np.array(cells).T + 0.5) * [[0.2], [0.1]]  # um
    expected = np.stack([x, y], axis=1)[np.argsort(y)]
    found = np.asarray(marks.get_offsets())
    np.testing.assert_allclose(found[np.argsort(found[:, 1])], expected, rtol=1e-14)
    edges = (0.0, 51.2, 102.4, 0.0) if window is None else (25.6, 51.2, 67.2, 16.0)
    for image in axes.images:
        assert image.get_extent() == pytest.approx(edges, rel=1e-14)
    rows, columns = np.nonzero(~np.ma.getmaskarray(np.ma.masked_invalid(axes.images[-1].get_array())))
    first = (0, 0) if window is None else (80, 256)
    assert [*zip(rows + first[0], columns + first[1], strict=True)] == cells
    if draw is pressure_map:  # marks have the colours of their cells
        drawn = np.asarray(axes.images[-1].get_array())[rows, columns]
        np.testing.assert_allclose(np.sort(marks.get_array()), np.sort(drawn), rtol=1e-14)


def test_a_larger_load_has_a_larger_ring():
    """Areas of rings from 14 to 94 square points, in proportion to the loads beyond 14."""
    heights = np.zeros((128, 160))
    heights[30, 100], heights[90, 20], heights[110, 140] = 1e-6, 1.1e-6, 1.2e-6
    solution = rc.press(rc.Surface(heights, rc.Grid(heights.shape, (2e-7, 1e-7))), MODULUS, depth=4e-7)
    (rings,) = contact_map(solution, Figure().subplots()).collections
    loads = {cell: solution.pressure[cell] for cell in ((30, 100), (90, 20), (110, 140))}
    assert len(loads) == len(rings.get_sizes()) == solution.spots.count
    for (x, y), size in zip(rings.get_offsets(), rings.get_sizes(), strict=True):
        share = loads[int(y / 0.2), int(x / 0.1)] / max(loads.values())
        assert size == pytest.approx(14 + 80 * share, rel=1e-6)


def test_a_frame_lies_on_the_edges_of_its_cells():
    solution = pressed((512, 512), [(100, 400)])
    _, axes = single()
    contact_map(solution, axes, frame=(slice(80, 336), slice(256, 512)))
    x, y = axes.lines[0].get_data()
    np.testing.assert_allclose([x.min(), x.max(), y.min(), y.max()], [25.6, 51.2, 16.0, 67.2], rtol=1e-14)


def test_contact_that_is_plain_to_see_gets_no_marks():
    surface = rc.Surface(np.zeros((16, 16)), rc.Grid((16, 16), 1e-6))
    solution = rc.press(surface, MODULUS, force=1.0)
    assert faint_spots(solution, part(surface.grid, None))[0].size == 0
    assert contact_window(solution) is None


def test_bodies_that_do_not_touch_have_a_map_too():
    solution = rc.press(peaks((16, 16), [(3, 3)]), MODULUS, depth=0.0)
    assert contact_window(solution) is None
    for draw in (pressure_map, contact_map):
        figure, axes = single()
        draw(solution, axes)
        painted(figure)


def test_marks_stand_on_their_spots_and_not_on_one_another():
    cells = [(10, 20), (11, 22), (300, 40), (500, 500)]
    solution = pressed((512, 512), cells)
    spots, places = faint_spots(solution, part(solution.problem.grid, None))
    assert solution.spots.count == 4
    # The first two are neighbours at this scale: one mark, on the one that carries more.
    assert len(spots) == 3
    assert {tuple(place) for place in places.tolist()} < set(cells)
    for spot, place in zip(spots, places, strict=True):
        assert solution.spots.labels[tuple(place)] == spot + 1
    # In a window about the first two each of them is seen.
    window = (slice(4, 20), slice(12, 28))
    assert faint_spots(solution, window)[0].size == 0


@pytest.mark.parametrize("heavier", [(10, 20), (11, 22)])
def test_of_neighbours_the_one_that_carries_more_is_marked(heavier):
    heights = np.zeros((400, 512))
    heights[10, 20] = heights[11, 22] = heights[300, 40] = 1e-6
    heights[heavier] = 1.1e-6
    solution = rc.press(rc.Surface(heights, rc.Grid(heights.shape, (2e-7, 1e-7))), MODULUS, depth=4e-7)
    assert solution.spots.count == 3
    _, places = faint_spots(solution, part(solution.problem.grid, None))
    assert sorted(tuple(place) for place in places.tolist()) == [heavier, (300, 40)]


def test_the_window_holds_compact_contact_and_keeps_the_shape_of_the_map():
    solution = pressed((200, 400), [(30, 100), (50, 110)])
    y, x = contact_window(solution)
    assert y.start <= 30 < 51 <= y.stop
    assert x.start <= 100 < 111 <= x.stop
    assert (x.stop - x.start) / (y.stop - y.start) == pytest.approx(2, abs=0.1)
    assert 0 <= y.start < y.stop <= 200


def test_the_window_goes_to_the_heaviest_part_of_scattered_contact():
    cluster = [(100 + 2 * i, 50 + 2 * j) for i in range(3) for j in range(3)]
    solution = pressed((256, 320), [(5, 310), (250, 5), (250, 310), *cluster])
    y, x = contact_window(solution)
    assert y.start <= 100 < 105 <= y.stop
    assert x.start <= 50 < 55 <= x.stop
    assert y.stop - y.start <= 256 / 6 + 1
    assert x.stop - x.start <= 320 / 6 + 1


@pytest.mark.parametrize("cell", [(0, 0), (0, 63), (63, 0), (63, 63)])
def test_a_window_at_a_corner_lies_on_the_map(cell):
    y, x = contact_window(pressed((64, 64), [cell]))
    assert y.start <= cell[0] < y.stop <= 64
    assert x.start <= cell[1] < x.stop <= 64
    assert min(y.start, x.start) >= 0


def test_missing_points_are_hatched_and_others_not():
    for missing, hatched in ((5, True), (0, False)):
        figure, axes = single()
        height_map(peaks((8, 8), [(4, 4)], missing), axes)
        assert bool(axes.patch.get_hatch()) is hatched
        assert int(np.ma.masked_invalid(axes.images[0].get_array()).mask.sum()) == missing
        painted(figure)


def test_spikes_are_ringed_where_they_are_and_counted():
    """Rings about the cells that stand out most, beside heights that the others keep their colours for."""
    grid = rc.Grid((64, 80), (2e-6, 1e-6))
    heights = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1)).heights.copy()
    heights[20, 30:32] += 1e-4
    heights[50, 7] -= 2e-4
    surface = rc.Surface(heights, grid)
    spikes = rc.find_spikes(surface)
    assert spikes.count == 2
    axes = height_map(surface, Figure().subplots(), spikes=spikes)
    (rings,) = axes.collections
    expected = (spikes.places[:, ::-1] + 0.5) * [1.0, 2.0]  # um
    np.testing.assert_allclose(rings.get_offsets(), expected, rtol=1e-14)
    assert [7.5, 101.0] in expected.tolist()
    assert axes.get_title() == f"{spikes}, ringed"
    low, high = axes.images[0].get_clim()
    rest = np.where(spikes.mask, np.nan, heights)
    assert np.nanmin(rest) * 1e9 <= low < high <= np.nanmax(rest) * 1e9
    bar = axes.images[0].colorbar
    assert bar.extend == "both"
    ends = (written(float(end), "m") for end in (heights.min(), heights.max()))
    assert bar.ax.get_ylabel() == "height [nm]\n(heights go from {} to {})".format(*ends)


def test_a_map_without_spikes_has_no_rings_and_all_its_colours():
    surface = rc.Surface(np.random.default_rng(2).normal(0.0, 1e-9, (64, 64)), rc.Grid((64, 64), 1e-6))
    axes = height_map(surface, Figure().subplots(), spikes=rc.find_spikes(surface))
    assert len(axes.collections) == 0
    assert axes.get_title() == ""
    assert axes.images[0].get_clim() == (surface.heights.min() * 1e9, surface.heights.max() * 1e9)
    assert axes.images[0].colorbar.extend == "neither"


def test_heights_far_from_zero_are_given_above_one_of_them():
    """Micrometres on top of 76 mm."""
    heights = 76.321e-3 + np.random.default_rng(2).uniform(0.0, 3e-5, (32, 32))
    axes = height_map(rc.Surface(heights, rc.Grid((32, 32), 1e-6)), Figure().subplots())
    image = axes.images[0]
    np.testing.assert_allclose(np.asarray(image.get_array()), (heights - 76.3e-3) * 1e6, rtol=1e-9)
    assert image.colorbar.ax.get_ylabel() == "height above 76.3 mm [µm]"


def test_pits_are_no_errors():
    """A tenth of the map, far below the rest, keeps its colours."""
    heights = np.random.default_rng(2).normal(0.0, 1e-10, (64, 64))
    heights[:6] -= 1e-8
    heights[40, 40] = 1e-6
    axes = height_map(rc.Surface(heights, rc.Grid((64, 64), 1e-6)), Figure().subplots())
    low, high = (end * 1e-9 for end in axes.images[0].get_clim())
    assert low < -1e-8 + 3e-10
    assert high < 1e-8


def test_large_maps_are_pooled_without_losing_a_cell():
    values = np.full((3001, 10), np.nan)
    values[2999, 7] = 5.0
    small = pooled(values)
    assert small.shape == (1001, 10)  # blocks of three rows
    assert np.argwhere(small == 5.0).tolist() == [[999, 7]]
    assert np.isnan(small).sum() == small.size - 1


def test_pooled_cells_lie_where_they_are():
    _, axes = single()
    slope = np.repeat(np.arange(2500.0)[:, None], 1301, axis=1)
    surface = rc.Surface(slope, rc.Grid(slope.shape, (1e-6, 2e-6)))
    height_map(surface, axes)
    _, right, bottom, _ = axes.images[0].get_extent()
    # 2500 rows in blocks of three are 834 blocks, 2502 rows; 1301 columns in pairs are 1302. The axes end with the map.
    assert (right, bottom) == pytest.approx((2.604, 2.502), rel=1e-14)
    assert axes.get_xlim() == pytest.approx((0.0, 2.602), rel=1e-14)
    assert axes.get_ylim() == pytest.approx((2.5, 0.0), rel=1e-14)


def test_a_few_great_pressures_do_not_darken_the_rest():
    edge = rc.press(rc.Surface(np.zeros((32, 32)), rc.Grid((32, 32), 1e-3)), MODULUS, force=10.0)
    _, axes = single()
    pressure_map(edge, axes)
    image = axes.images[-1]
    assert image.get_clim()[1] == pytest.approx(np.quantile(edge.pressure, 0.95) * 1e-3, rel=1e-12)  # kPa
    assert image.colorbar.extend == "max"
    highest = written(np.quantile(edge.pressure, 0.95), "Pa")
    assert image.colorbar.ax.get_ylabel() == f"pressure [kPa]\n(colours end at {highest})"
