"""Figure 3: a self-affine line and its magnified piece."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig3_magnified_line as fig3
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig3.case()


def test_the_second_differences_are_those_of_the_spectrum(data):
    # Over a period the waves are independent: the mean square is the sum of (2 - 2 cos(q r))^2 n^(-2H-1) of each.
    n = np.arange(1, fig3.POINTS // 2)  # no wave of Nyquist
    for one in data:
        power = n ** (-2 * one.hurst - 1.0)
        for points in (32, 128):
            part = (2 - 2 * np.cos(2 * np.pi * n * points / fig3.POINTS)) ** 2
            expected = np.sqrt((part * power).sum() / power.sum())  # rms height 1
            assert one.second_difference(points) == pytest.approx(expected, rel=1e-9)


def test_the_piece_is_a_quarter_of_the_line_and_fits_its_frame(data):
    for one in data:
        first = round(0.3 * fig3.POINTS)
        heights = one.line.heights[first : first + 1024]
        np.testing.assert_allclose(np.diff(one.piece), 4**one.hurst * np.diff(heights), atol=1e-9)
        assert one.piece.max() == pytest.approx(-one.piece.min(), rel=1e-9)
        assert one.piece.max() < 1.1 * np.abs(one.line.heights).max()


def test_frames_are_as_wide_and_as_high_as_what_is_magnified(data):
    picture = drawn(fig3, data)
    FigureCanvasAgg(picture).draw()
    for above, below, one in zip(picture.axes[:2], picture.axes[2:], data, strict=True):
        frame = above.lines[1]
        assert np.ptp(frame.get_xdata()) == pytest.approx(1 / 4)
        assert np.ptp(frame.get_ydata()) == pytest.approx(np.ptp(above.get_ylim()) / 4**one.hurst)
        assert below.get_xlim() == pytest.approx((0.3, 0.55))
        assert below.get_ylim() == above.get_ylim()
    assert [each.word for each in verdicts(fig3, data)] == ["holds"]


def test_a_line_of_another_exponent_is_not_magnified_to_itself(data):
    wrong = tuple(fig3.Magnified(one.hurst + 0.2, one.line) for one in data)
    assert verdicts(fig3, wrong)[0].word == "does not hold"
