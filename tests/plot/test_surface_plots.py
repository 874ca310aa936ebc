"""Pictures of a surface: what is drawn is what was measured, in the units that the labels say."""

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.distributions import height_distribution
from roughcontact.plot.profile_plot import profile_curve
from roughcontact.plot.spectrum_plot import spectrum_curve
from roughcontact.plot.view import surface_view


def single(**named):
    figure = Figure(figsize=(4, 4), dpi=60)
    return figure, figure.add_subplot(**named)


def drawn(figure):
    FigureCanvasAgg(figure).draw()


@pytest.fixture
def rough():
    grid = rc.Grid((96, 128), (2e-6, 1e-6), periodic=True)
    return rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(2))


def spectrum_of(density, kind="C2D", low=2e4, high=2e6):
    q = np.geomspace(1e4, 1e7, 61)
    return rc.PowerSpectrum(q, density(q), kind, np.full(61, 10.0), np.full(61, 5.0), low, high)


def law_of(**limits):
    limits = dict.fromkeys(("rolloff", "long_cutoff", "short_cutoff")) | limits
    return rc.HurstFit(0.5, 0.01, 1e-22, 1e6, "C2D", **limits, misfit=1.0, band=(2e4, 2e6))


def line(axes, label):
    return next(each for each in axes.lines if str(each.get_label()).startswith(label))


@pytest.mark.parametrize(("kind", "power"), [("C2D", 4), ("C1D", 3)])
def test_a_spectrum_is_drawn_in_the_units_of_its_labels(kind, power):
    # A power law stays one when bins are averaged only if each bin is drawn alone: 20 a decade are.
    spectrum = spectrum_of(lambda q: 1e-2 * q ** (-power + 0.0), kind)
    figure, axes = single()
    spectrum_curve(spectrum, axes)
    drawn(figure)
    assert "[rad/µm]" in axes.get_xlabel()
    assert axes.get_xscale() == axes.get_yscale() == "log"
    unit = axes.get_ylabel().split("[")[1].rstrip("]")
    factor = {"µm⁴": 1e24, "nm⁴": 1e36, "mm⁴": 1e12, "µm³": 1e18, "nm³": 1e27, "mm³": 1e9}[unit]
    q, density = line(axes, "measured").get_data()
    inside = (spectrum.wavenumber >= 2e4) & (spectrum.wavenumber <= 2e6)
    np.testing.assert_allclose(q, spectrum.wavenumber[inside] * 1e-6, rtol=1e-12)
    np.testing.assert_allclose(density, spectrum.density[inside] * factor, rtol=1e-12)


def test_the_upper_axis_of_a_spectrum_is_the_wavelength():
    figure, axes = single()
    spectrum_curve(spectrum_of(lambda q: q**-4.0), axes)
    drawn(figure)
    top = axes.child_axes[0]
    assert top.get_xlabel() == "wavelength [µm]"
    for q in (0.05, 3.0):
        below, above = axes.transData.transform((q, 1.0)), top.transData.transform((2 * math.pi / q, 0.5))
        assert above[0] == pytest.approx(below[0], abs=1e-6)  # pixels


def test_a_narrow_spectrum_has_plain_numbers_on_its_axes():
    q = np.geomspace(2e4, 2e5, 12)
    spectrum = rc.PowerSpectrum(q, q**-4.0, "C2D", np.full(12, 10.0), np.full(12, 5.0), 2e4, 2e5)
    figure, axes = single()
    spectrum_curve(spectrum, axes, label="from a profile")
    drawn(figure)
    low, high = axes.get_xlim()
    ticks = dict(zip(axes.get_xticks(), axes.get_xticklabels(), strict=True))
    shown = [text.get_text() for place, text in ticks.items() if low <= place <= high]
    assert shown == ["0.02", "0.05", "0.1", "0.2"]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["from a profile"]


def test_bins_outside_the_reliable_band_are_drawn_apart():
    figure, axes = single()
    spectrum_curve(spectrum_of(lambda q: q**-4.0), axes)
    drawn(figure)
    assert len(axes.lines[0].get_xdata()) == 61
    assert 0 < len(line(axes, "measured").get_xdata()) < 61


def test_a_law_lies_over_its_band_and_bends_where_it_says():
    law = law_of(rolloff=5e-5)
    spectrum = spectrum_of(law)
    figure, axes = single()
    spectrum_curve(spectrum, axes, law=law)
    drawn(figure)
    assert law.hurst == 0.5
    q, density = line(axes, "H = 0.500 ± 0.010").get_data()
    assert (q[0], q[-1]) == pytest.approx((2e-2, 2.0), rel=1e-12)
    corner = 2 * math.pi / 50
    # The law is flat up to the corner and falls from there on.
    flat = density[q <= corner * (1 + 1e-12)]
    np.testing.assert_allclose(flat, flat[0], rtol=1e-12)
    assert (np.diff(density[q >= corner * (1 - 1e-12)]) < 0).all()
    marks = [each.get_xdata()[0] for each in axes.lines if list(each.get_ydata()) == [0, 1]]
    assert marks == pytest.approx([corner], rel=1e-12)
    assert [text.get_text() for text in axes.texts] == ["roll-off 50 µm"]


def test_empty_bins_of_a_cut_off_spectrum_have_no_place_on_a_logarithmic_axis():
    figure, axes = single()
    spectrum_curve(
        spectrum_of(lambda q: np.where(q < 0.99e5, 0.0, q**-4.0)), axes, law=law_of(long_cutoff=6e-5)
    )
    drawn(figure)
    assert len(axes.lines[0].get_xdata()) == 41
    assert (line(axes, "measured").get_ydata() > 0).all()
    assert (line(axes, "H = ").get_xdata() >= 2 * math.pi / 60 * (1 - 1e-9)).all()


def test_a_real_spectrum_can_be_drawn(rough):
    figure, axes = single()
    spectrum_curve(rc.power_spectrum(rough, per_decade=200), axes, law=rc.hurst_exponent(rough))
    drawn(figure)


def test_a_profile_is_a_row_of_the_picture(rough):
    figure, axes = single()
    profile_curve(rough, axes, row=-1)
    drawn(figure)
    x, z = axes.lines[0].get_data()
    np.testing.assert_allclose(x, np.arange(128) + 0.5, rtol=1e-12)
    np.testing.assert_allclose(z, rough.heights[95] * 1e6, rtol=1e-12)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [µm]", "height [µm]")
    assert axes.get_xlim() == pytest.approx((0, 128), rel=1e-12)


def test_a_profile_is_broken_where_points_are_missing_and_says_which_rows_there_are(rough):
    heights = rough.heights.copy()
    heights[48] = np.nan
    surface = rc.Surface(heights, rough.grid)
    figure, axes = single()
    profile_curve(surface, axes)  # the middle row, of which nothing was measured
    drawn(figure)
    assert np.isnan(axes.lines[0].get_ydata()).all()
    with pytest.raises(ValueError, match="between -96 and 95, not 96"):
        profile_curve(surface, axes, row=96)
    scan = rc.Surface(heights[0], rc.Grid((128,), (1e-6,)))
    profile_curve(scan, axes)
    np.testing.assert_allclose(axes.lines[-1].get_ydata(), heights[0] * 1e6, rtol=1e-12)
    with pytest.raises(ValueError, match="leave row out"):
        profile_curve(scan, axes, row=0)


def test_a_histogram_has_the_area_1_and_the_normal_distribution_its_rms(rough):
    figure, axes = single()
    height_distribution(rough, axes, bins=30)
    drawn(figure)
    values, edges, _ = axes.patches[0].get_data()
    assert len(values) == 30
    assert float(values @ np.diff(edges)) == pytest.approx(1, rel=1e-12)
    normal = line(axes, "normal, rms 1 µm").get_ydata()
    # The grid of 400 points lies within half a step, range/800, of the top.
    near = math.exp(-((edges[-1] - edges[0]) ** 2) / 800**2 / 2)
    assert near / math.sqrt(2 * math.pi) <= normal.max() <= 1 / math.sqrt(2 * math.pi) * (1 + 1e-9)


def test_a_flat_surface_has_a_histogram_and_a_view():
    flat = rc.Surface(np.zeros((4, 6)), rc.Grid((4, 6), 1e-6))
    figure, axes = single()
    height_distribution(flat, axes)
    assert len(axes.lines) == 0
    drawn(figure)
    figure, axes = single(projection="3d")
    surface_view(flat, axes)
    drawn(figure)


def test_a_view_shows_the_heights_with_the_first_row_at_the_back():
    heights = np.arange(12.0).reshape(3, 4) * 1e-6
    figure, axes = single(projection="3d")
    surface_view(rc.Surface(heights, rc.Grid((3, 4), (2e-6, 1e-6))), axes)
    drawn(figure)
    assert axes.get_zlim() == pytest.approx((0, 11), rel=1e-12)
    assert axes.get_ylim() == pytest.approx((6, 0), rel=1e-12)
    assert len(axes.collections[0].get_facecolor()) == 2 * 3  # quadrilaterals between 3 x 4 points
    assert (axes.get_xlabel(), axes.get_zlabel()) == ("x [µm]", "height [µm]")


def test_a_view_has_each_point_at_its_place_and_its_colour():
    """On a map of 6 um by 4 um that falls to the front and to the right; heights in nanometres."""
    nm = np.arange(12.0)[::-1].reshape(3, 4) ** 1.5
    axes = surface_view(rc.Surface(nm * 1e-9, rc.Grid((3, 4), (2e-6, 1e-6))), single(projection="3d")[1])
    assert (axes.get_ylabel(), axes.get_zlabel()) == ("y [µm]", "height [nm]")
    [drawn] = axes.collections
    # Corners in space: Matplotlib before 3.10 keeps them as rows x, y, z and 1.
    corners = drawn._faces.reshape(-1, 3) if hasattr(drawn, "_faces") else drawn._vec[:3].T
    assert len(corners) == 4 * 6  # of each quadrilateral, in space
    for x, y, z in corners:
        column, row = x - 0.5, (y - 1) / 2
        assert (row, column) == pytest.approx((round(row), round(column)), abs=1e-12)
        assert z == pytest.approx(nm[round(row), round(column)], rel=1e-12)
    sides = np.asarray(axes.get_box_aspect())
    np.testing.assert_allclose(sides / sides[1], (4 / 6, 1, 0.3), rtol=1e-12)
    # Viridis in whatever light, from the back to the front: the highest is yellow, the lowest violet.
    colours = drawn.get_facecolor()[:, :3]
    assert colours[0, 2] < colours[0, 0]
    assert colours[-1, 2] > colours[-1, 0]


def test_the_light_on_a_bent_sheet_knows_the_side_along_which_it_bends():
    """Its slopes, and so its colours, are the same however far apart the rows lie."""
    heights = np.tile(np.arange(12.0) ** 2, (3, 1)) * 1e-9
    one, two = (
        surface_view(rc.Surface(heights, rc.Grid((3, 12), (step, 1e-6))), single(projection="3d")[1])
        for step in (1e-6, 2e-6)
    )
    colours = (np.unique(axes.collections[0].get_facecolor().round(9), axis=0) for axes in (one, two))
    np.testing.assert_allclose(*colours, atol=2e-9)


def test_a_view_averages_a_large_surface_over_blocks_even_one_whose_period_they_do_not_fit():
    grid = rc.Grid((403, 402), 1e-6, periodic=True)
    surface = rc.self_affine(grid, 1.0, 1e-6, np.random.default_rng(3))
    figure, axes = single(projection="3d")
    surface_view(surface, axes, frame=False)
    drawn(figure)
    # 403 // 3 = 134 and 402 // 3 = 134 points.
    assert len(axes.collections[0].get_facecolor()) == 133 * 133
    low, high = axes.get_zlim()
    assert surface.heights.min() * 1e6 < low < high < surface.heights.max() * 1e6


def test_a_view_is_open_where_nothing_was_measured():
    heights = np.random.default_rng(4).random((8, 8))
    heights[3, 3] = np.nan
    figure, axes = single(projection="3d")
    surface_view(rc.Surface(heights * 1e-6, rc.Grid((8, 8), 1e-6)), axes)
    drawn(figure)
    corners = [path.vertices for path in axes.collections[0].get_paths()]
    # Its four neighbours are triangles in older Matplotlib, not drawn in newer; a closed quadrilateral has five points.
    assert sum(len(each) == 5 and np.isfinite(each).all() for each in corners) == 49 - 4
    with pytest.raises(ValueError, match="profile_curve"):
        surface_view(rc.Surface(heights[0], rc.Grid((8,), (1e-6,))), axes)
