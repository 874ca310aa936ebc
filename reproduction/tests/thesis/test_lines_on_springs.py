"""Figures 47 and 48: a rough line on springs, and the same line sorted."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig47_springs_under_line as fig47, fig48_sorted_line as fig48
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def pressed():
    return fig47.case()


@pytest.fixture(scope="module")
def ordered():
    return fig48.case()


def test_lengths_and_force_are_sums_over_the_springs(pressed):
    above = [height - pressed.level for height in pressed.line.heights if height > pressed.level]
    assert len(pressed.lengths) == 3
    assert pressed.lengths.sum() == pytest.approx(len(above) / 256, rel=1e-12)
    assert pressed.force == pytest.approx(sum(above) / 256, rel=1e-12)
    centres = (np.arange(256) + 0.5) / 256
    inside = [any(start < x < end for start, end in pressed.spots) for x in centres]
    np.testing.assert_array_equal(inside, pressed.springs)


def test_lines_of_the_picture_end_at_the_level_and_at_the_heights(pressed):
    picture = drawn(fig47, pressed)
    FigureCanvasAgg(picture).draw()
    [axes] = picture.axes
    names = [text.get_text() for text in axes.texts]
    assert [name for name in names if name.startswith("$L")] == ["$L_1$", "$L_2$", "$L_3$"]
    assert [each.word for each in verdicts(fig47, pressed)] == ["holds", "does not hold"]


def test_both_searches_find_the_depths(ordered):
    heights = ordered.pressed.line.heights
    for force, depth in zip(fig48.FORCES[::20], ordered.by_order[::20], strict=True):
        assert np.maximum(heights - heights.max() + depth, 0).sum() / 256 == pytest.approx(force, rel=1e-12)
    np.testing.assert_allclose(ordered.by_bisection, ordered.by_order, rtol=1e-10)


def test_the_sorted_line_holds_the_same_springs(ordered):
    assert (np.diff(ordered.heights) <= 0).all()
    assert sorted(ordered.pressed.line.heights) == sorted(ordered.heights)
    picture = drawn(fig48, ordered)
    FigureCanvasAgg(picture).draw()
    touching = int(ordered.pressed.springs.sum())
    assert (ordered.heights[:touching] > ordered.pressed.level).all()
    assert ordered.heights[touching] <= ordered.pressed.level
    assert [each.word for each in verdicts(fig48, ordered)] == ["holds"]
