"""What the figures share: curves stand where the averages are, and settings reach what is drawn."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from roughcontact.plot.drawing.level import level
from roughcontact_thesis import drawing
from roughcontact_thesis.figures import FIGURES, drawn, module

FORCE = np.array([0.1, 0.2, 0.4])


@pytest.fixture
def averages():
    stiffness = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    every = ("hurst", "force")
    return xarray.Dataset(
        {"k": (every, stiffness), "k_error": (every, stiffness / 10), "law": (every, 2 * stiffness)},
        {"hurst": [0.5, 1.0], "force": FORCE},
    )


@pytest.fixture
def axes():
    return Figure().subplots()


def test_a_family_has_a_colour_for_each_value_and_errors_where_there_are_some(axes, averages):
    drawing.family(axes, averages, "hurst", {"k": "o", "law": ":"}, "H = {:g}")
    means, laws = axes.containers[::2], axes.containers[1::2]
    for i, (mean, law) in enumerate(zip(means, laws, strict=True)):
        one = averages.isel(hurst=i)
        np.testing.assert_array_equal(mean[0].get_data(), [FORCE, one["k"]])
        np.testing.assert_array_equal(law[0].get_data(), [FORCE, one["law"]])
        assert to_hex(mean[0].get_color()) == to_hex(law[0].get_color()) == drawing.COLOURS[i]
        ends = [bar[:, 1] for bar in mean[2][0].get_segments()]
        np.testing.assert_allclose(ends, np.stack([one["k"] * 0.9, one["k"] * 1.1], axis=1))
        assert not law[2]
    assert axes.get_legend_handles_labels()[1] == ["H = 0.5", "H = 1"]


def test_intervals_reach_from_the_low_to_the_high_end(axes, averages):
    one = averages.isel(hurst=0)
    one = one.assign(k_low=one["k"] - 0.5, k_high=one["k"] + 0.25)
    drawing.with_intervals(axes, FORCE, one, "k", fmt="x")
    (bars,) = axes.containers[0][2]
    ends = [bar[:, 1] for bar in bars.get_segments()]
    np.testing.assert_allclose(ends, np.stack([one["k_low"], one["k_high"]], axis=1))


def test_each_hurst_exponent_has_its_colour_and_the_key_all_of_them(axes, averages):
    hurst, parts, colours = zip(*drawing.by_hurst(averages), strict=True)
    assert hurst == (0.5, 1.0)
    for i, part in enumerate(parts):
        xarray.testing.assert_identical(part, averages.isel(hurst=i))
    assert len(set(colours)) == 2
    drawing.colour_key(axes.figure, axes, averages["hurst"].to_numpy())
    bar = axes.figure.axes[1]
    assert bar.get_ylim() == (0.5, 1.0)
    assert bar.get_ylabel() == "Hurst exponent H"


@pytest.mark.parametrize(
    ("given", "place", "above"),
    [({}, 0.01, True), ({"ha": "right"}, 0.99, True), ({"va": "top"}, 0.01, False)],
)
def test_words_stand_beside_their_level(axes, given, place, above):
    level(axes, 2.0, "two", **given)
    (line,), (words,) = axes.lines, axes.texts
    assert set(line.get_ydata()) == {2.0}
    assert words.xy == (place, 2.0)
    assert (words.get_position()[1] > 0) == above


def test_a_style_in_the_legend_draws_nothing(axes):
    drawing.key(axes, "--", "the law")
    assert axes.get_legend_handles_labels()[1] == ["the law"]
    assert not len(axes.lines[0].get_xdata())


def test_a_legend_below_covers_nothing(axes):
    axes.figure.set_layout_engine("constrained")
    axes.plot([1, 2], [1, 2], label="a line")
    drawing.legend_below(axes)
    axes.figure.draw_without_rendering()
    (legend,) = axes.figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["a line"]
    assert legend.get_window_extent().y1 <= axes.get_tightbbox().y0


def test_a_bar_on_a_map_has_its_length(axes):
    drawing.scale_bar(axes, (0.25, -0.1), 0.5, "L")
    np.testing.assert_array_equal(axes.lines[0].get_data(), [[0.25, 0.75], [-0.1, -0.1]])
    assert [text.get_text() for text in axes.texts] == ["L"]


def test_every_figure_is_as_wide_as_a_column_or_a_page():
    assert {module(name).SIZE[0] for name in FIGURES} == {drawing.COLUMN, drawing.PAGE}


def test_settings_reach_every_figure_and_end_with_it():
    def draw(figure, data):
        for axes in drawing.panels(figure, 1, 2):
            axes.plot([1, 2], [1, 2])
            drawing.label(axes, "x", data, xscale="log")

    picture = drawn(SimpleNamespace(SIZE=(4, 3), draw=draw), "y")
    assert [axes.get_title("left") for axes in picture.axes] == ["(a)", "(b)"]
    for axes in picture.axes:
        assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_xscale()) == ("x", "y", "log")
        assert axes.xaxis.label.get_fontsize() == drawing.LABEL
        assert {text.get_fontsize() for text in axes.get_xticklabels(which="both")} == {drawing.TICK}
        assert axes.lines[0].get_linewidth() == drawing.STYLE["lines.linewidth"]
    assert Figure().subplots().xaxis.label.get_fontsize() != drawing.LABEL
