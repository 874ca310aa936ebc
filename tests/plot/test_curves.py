"""Curves: every point drawn once, the limits where they are, the law as it was fitted."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.labels.engineering_units import Scale
from roughcontact.plot.canvas import curve_figure
from roughcontact.plot.curves import areal_curve, force_curve
from roughcontact.plot.drawing.ticks import readable_ticks
from roughcontact.theory.law import LoadingLaw

MODULUS = 1e11


@pytest.fixture(scope="module")
def curve() -> rc.Curve:
    grid = rc.Grid((48, 48), (1e-7, 1e-7))
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    scale = MODULUS * 1e-7 * 48e-7
    return rc.loading_curve(surface, MODULUS, forces=scale * np.geomspace(1e-3, 1, 8))


@pytest.fixture
def axes() -> Axes:
    return Figure().subplots()


def line(axes: Axes, label: str):
    (found,) = [each for each in axes.lines if each.get_label() == label]
    return found


def level(axes: Axes) -> list[float]:
    """Return the heights of the horizontal lines over the whole width."""
    return sorted(each.get_ydata()[0] for each in axes.lines if list(each.get_xdata()) == [0, 1])


def test_points_are_filled_where_resolved_and_open_elsewhere(axes, curve):
    assert 0 < curve.resolved.sum() < len(curve), "both kinds are needed here"
    force_curve(curve, axes)
    for label, mask in (("resolved", curve.resolved), ("not resolved", ~curve.resolved)):
        drawn = line(axes, label)
        # Units of the axes are powers of ten: ratios tell whether the points are the curve's.
        for data, values in (
            (drawn.get_xdata(), curve.force[mask]),
            (drawn.get_ydata(), curve.stiffness[mask]),
        ):
            np.testing.assert_allclose(data / data[0], values / values[0], rtol=1e-13)
        filled = drawn.get_markerfacecolor() != "white"
        assert filled is (label == "resolved")
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")


def test_limits_are_drawn_and_lie_on_the_axes(axes, curve):
    force_curve(curve, axes)
    factor = line(axes, "resolved").get_ydata()[0] / curve.stiffness[curve.resolved][0]
    expected = [20 * curve.cell_stiffness * factor, curve.full_contact_stiffness * factor]
    assert level(axes) == pytest.approx(expected, rel=1e-12)
    assert [text.xy[1] for text in axes.texts] == pytest.approx(expected, rel=1e-12)
    low, high = axes.get_ylim()
    assert low < expected[0] < expected[1] < high


def test_the_law_is_drawn_over_its_window_with_its_exponent(axes, curve):
    law = curve.fit((float(curve.force[2]), float(curve.force[-1])))
    force_curve(curve, axes, law=law)
    (drawn,) = [each for each in axes.lines if each.get_linewidth() == 2]
    points = line(axes, "resolved")
    x, y = (
        data[0] / values[curve.resolved][0]
        for data, values in ((points.get_xdata(), curve.force), (points.get_ydata(), curve.stiffness))
    )
    np.testing.assert_allclose(drawn.get_xdata(), np.array(law.window) * x, rtol=1e-12)
    np.testing.assert_allclose(drawn.get_ydata(), law.stiffness(np.array(law.window)) * y, rtol=1e-12)
    assert f"{law.exponent:.3f}" in drawn.get_label()
    assert drawn.get_label() in [text.get_text() for text in axes.get_legend().get_texts()]
    (thin,) = [each for each in axes.lines if each.get_linewidth() == 0.8]
    beyond = curve.force[[0, -1]]  # of all points, also those before the window
    np.testing.assert_allclose(thin.get_xdata(), beyond * x, rtol=1e-12)
    np.testing.assert_allclose(thin.get_ydata(), law.stiffness(beyond) * y, rtol=1e-12)


def test_the_outer_axes_have_no_dimension(curve):
    figure = Figure()
    axes = figure.subplots()
    force_curve(curve, axes)
    figure.draw_without_rendering()
    right, upper = axes.child_axes
    x, y = line(axes, "resolved").get_data()
    first = np.flatnonzero(curve.resolved)[0]
    assert upper.get_xlim()[0] * x[0] / axes.get_xlim()[0] == pytest.approx(
        curve.dimensionless_force[first], rel=1e-12
    )
    assert right.get_ylim()[0] * y[0] / axes.get_ylim()[0] == pytest.approx(
        curve.dimensionless_stiffness[first], rel=1e-12
    )


def test_an_infinite_full_contact_stiffness_has_no_line(axes):
    grid = rc.Grid((16, 16), (1e-7, 1e-7), periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-9, rng=np.random.default_rng(3))
    curve = rc.loading_curve(surface, MODULUS, pressures=[1e7, 1e8, 1e10])
    assert np.isinf(curve.stiffness[-1])  # full contact
    force_curve(curve, axes)
    assert len(level(axes)) == 1
    drawn = sum(len(each.get_xdata()) for each in axes.lines if each.get_marker() == "o")
    assert drawn == 2
    axes.figure.draw_without_rendering()


def test_a_flat_surface_has_a_curve(axes):
    surface = rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1e-3))
    curve = rc.loading_curve(surface, MODULUS, forces=[1.0, 10.0])
    force_curve(curve, axes)
    axes.figure.draw_without_rendering()
    assert not any("force /" in each.get_xlabel() for each in axes.child_axes)


def test_area_and_depth(curve):
    for quantity in ("contact_area", "depth"):
        figure = Figure()
        axes = figure.subplots()
        values = getattr(curve, quantity)
        force_curve(curve, axes, quantity=quantity)
        data = line(axes, "resolved").get_ydata()
        np.testing.assert_allclose(
            data / data[0], values[curve.resolved] / values[curve.resolved][0], rtol=1e-13
        )
        if quantity == "contact_area":
            figure.draw_without_rendering()
            (right,) = axes.child_axes
            share = right.get_ylim()[0] / axes.get_ylim()[0] * data[0]
            expected = values[curve.resolved][0] / (48e-7 * 48e-7)
            assert share == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("ratio", [1.1, 1.7, 4.0, 6.0, 25.0, 90.0, 1e3, 1e6])
@pytest.mark.parametrize("first", [1.0, 1.3, 3.7, 8.9])
def test_numbers_on_a_logarithmic_axis_are_few_and_at_least_two(ratio, first):
    figure = Figure(figsize=(3, 2))
    axes = figure.subplots()
    axes.set_yscale("log")
    axes.plot([0, 1], [first, ratio * first])
    readable_ticks(axes.yaxis, ratio)
    figure.draw_without_rendering()
    low, high = axes.get_ylim()
    ticks = [*axes.yaxis.get_major_ticks(), *axes.yaxis.get_minor_ticks()]
    labels = [tick.label1.get_text() for tick in ticks if low <= tick.get_loc() <= high]
    numbers = [text for text in labels if text]
    assert 2 <= len(numbers) <= 7
    assert len(set(numbers)) == len(numbers)


def test_the_lower_limit_is_named_for_what_it_is(axes, curve):
    force_curve(curve, axes)
    assert [text.get_text() for text in axes.texts] == ["20 x one cell", "full contact"]


@pytest.mark.parametrize("kind", ["surface", "line"])
def test_full_contact_alone_has_a_picture(axes, kind):
    """Infinite stiffness everywhere: there is nothing to draw but the axes."""
    grid = rc.Grid((8, 8) if kind == "surface" else 8, 1e-6, True)
    wavy = rc.self_affine(grid, hurst=0.8, rms=1e-12, rng=np.random.default_rng(0))
    operator = rc.line(grid, 1e9) if kind == "line" else None
    force_curve(rc.loading_curve(wavy, 1e9, pressures=[1e6, 2e6], operator=operator), axes)
    axes.figure.canvas.draw()
    assert not axes.get_lines() or kind == "surface"


def test_on_a_line_no_stiffness_tells_what_is_resolved(axes):
    grid = rc.Grid(128, 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    force_curve(rc.loading_curve(rough, 1e9, forces=[1.0, 10.0], operator=rc.line(grid, 1e9)), axes)
    assert [text.get_text() for text in axes.texts] == ["full contact"]


@pytest.mark.parametrize(
    ("lowest", "highest"), [(1e-3, 1.0), (1e-5, 3e-3), (1e-4, 2e-3), (3e-2, 1.0), (1e-6, 1e-5)]
)
def test_no_point_lies_under_words(lowest, highest):
    """Wherever the curve crosses the stiffness of twenty cells, and where it does not."""
    grid = rc.Grid((48, 48), (1e-7, 1e-7))
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    scale = MODULUS * 1e-7 * 48e-7
    curve = rc.loading_curve(surface, MODULUS, forces=scale * np.geomspace(lowest, highest, 30))
    figure = curve_figure(curve, curve.fit((float(curve.force[0]), float(curve.force[-1]))))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    axes = figure.axes[0]
    points = np.concatenate([each.get_xydata() for each in axes.lines if each.get_marker() == "o"])
    assert len(points) == 30
    pixels = axes.transData.transform(points)
    boxes = [text.get_window_extent(canvas.get_renderer()) for text in axes.texts]
    assert len(boxes) == 2
    for box in boxes:
        inside = (pixels > (box.x0 - 2, box.y0 - 2)) & (pixels < (box.x1 + 2, box.y1 + 2))
        assert not inside.all(axis=1).any()


@pytest.mark.parametrize("periodic", [False, True])
def test_no_line_lies_under_words_where_there_is_room(periodic):
    """Laws that cross the levels at either end; on a large picture there is always a place between."""
    grid = rc.Grid((48, 48), (1e-7, 1e-7), periodic)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    scale = MODULUS * 1e-7 * 48e-7
    curve = rc.loading_curve(surface, MODULUS, forces=scale * np.geomspace(1e-3, 0.3, 12))
    level_of = 20 * curve.cell_stiffness
    laws = [
        # Through the level of twenty cells near the right end of the axis, and near the left one.
        LoadingLaw(f"at {at}", "", {"stiffness": lambda f, at=at: level_of * (f / (scale * at)) ** 0.5})
        for at in (2e-3, 0.2)
    ]
    figure = Figure(figsize=(8, 6), dpi=100)
    axes = force_curve(curve, figure.subplots(), theories=laws)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    texts = [text for text in axes.texts if text.get_text()]
    assert len(texts) == 1 + (not periodic)
    for text in texts:
        box = text.get_window_extent(canvas.get_renderer())
        for drawn in axes.lines:
            if drawn.get_transform() == axes.transData and len(drawn.get_xdata()) > 1:
                x, y = axes.transData.transform(drawn.get_xydata()).T
                fine = np.linspace(x.min(), x.max(), 4000)
                across = np.interp(fine, x, y)
                if drawn.get_linestyle() == "None":
                    fine, across = x, y
                inside = (fine > box.x0) & (fine < box.x1) & (across > box.y0) & (across < box.y1)
                assert not inside.any(), (text.get_text(), drawn.get_label())


AREAL = ("interfacial_stiffness_per_area", "contact_fraction", "mean_gap")


@pytest.mark.parametrize("name", AREAL)
def test_per_area_is_drawn_in_the_unit_that_is_named(axes, curve, name):
    units = {"nominal_pressure": Scale(1e-5, "bar"), name: Scale(3.0, "thirds")}
    areal_curve(curve, axes, quantity=name, units=units)
    drawn = line(axes, "resolved")
    np.testing.assert_allclose(drawn.get_xdata(), curve.nominal_pressure[curve.resolved] / 1e5, rtol=1e-14)
    np.testing.assert_allclose(drawn.get_ydata(), 3 * getattr(curve, name)[curve.resolved], rtol=1e-14)
    assert axes.get_xlabel() == "nominal pressure [bar]"
    assert axes.get_ylabel().endswith("[thirds]")


@pytest.mark.parametrize("periodic", [False, True])
def test_what_belongs_to_k_is_drawn_with_the_interface_only_where_the_two_are_one(axes, periodic):
    grid = rc.Grid((48, 48), (1e-7, 1e-7), periodic)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(3))
    scale = MODULUS * 1e-7 * 48e-7
    computed = rc.loading_curve(surface, MODULUS, forces=scale * np.geomspace(1e-2, 0.3, 8))
    law = computed.fit((float(computed.force[2]), float(computed.force[-1])))
    areal_curve(computed, axes, law=law)
    strong = [each for each in axes.lines if each.get_linewidth() == 2]
    assert bool(strong) is periodic
    if periodic:
        area, to_pressure = (
            48e-7**2,
            line(axes, "resolved").get_xdata()[0] / computed.force[computed.resolved][0],
        )
        np.testing.assert_allclose(strong[0].get_xdata(), np.array(law.window) * to_pressure, rtol=1e-12)
        expected = law.stiffness(np.array(law.window)) / area * 1e-12  # N/um/mm^2
        np.testing.assert_allclose(strong[0].get_ydata(), expected, rtol=1e-12)


@pytest.mark.parametrize("name", AREAL)
def test_theories_pass_through_what_they_say_per_area(axes, curve, name):
    """A theory that says what was computed goes through the points."""
    given = {"interfacial_stiffness": 1e3, "contact_area": 1e-13, "mean_gap": 1e-8}
    law = LoadingLaw("straight", "", {each: lambda f, c=c: c * f for each, c in given.items()})
    areal_curve(curve, axes, quantity=name, theories=[law])
    (drawn,) = [each for each in axes.lines if each.get_label() == "straight"]
    points = line(axes, "resolved")
    area = curve.nominal_area
    to_y = points.get_ydata()[0] / getattr(curve, name)[curve.resolved][0]
    to_x = points.get_xdata()[0] / curve.nominal_pressure[curve.resolved][0]
    of_force = np.array(drawn.get_xdata()) / to_x * area
    quantity = {AREAL[0]: "interfacial_stiffness", AREAL[1]: "contact_area", AREAL[2]: "mean_gap"}[name]
    expected = given[quantity] * of_force * to_y / (1.0 if name == "mean_gap" else area)
    np.testing.assert_allclose(drawn.get_ydata(), expected, rtol=1e-12)
