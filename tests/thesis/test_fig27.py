"""Figure 27: exponents of surfaces and lines."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.thesis import fig27
from roughcontact.thesis.figures import drawn
from thesis.synthetic import curves, lines

HURST = np.array([-0.5, -0.05, 0.4, 1.0, 2.0, 2.5, 2.95])
ALPHA = 1 / (np.clip(HURST, 0.2, 2) + 1)


def data(alpha=ALPHA, scatter=0.2, reduced=ALPHA):
    surfaces = curves(alpha, 0.9, HURST, scatter=scatter)
    return fig27.averages(surfaces, lines(reduced, 0.9, HURST, scatter=0.2))


def test_what_the_thesis_says_would_hold_if_it_were_so():
    found = fig27.verdicts(data())
    assert [each.holds for each in found] == [True] * 4
    assert "for 0.40 <= H <= 2.00" in found[0].found


@pytest.mark.parametrize(("place", "which"), [(3, 0), (5, 1), (2, 2), (0, 3)])
def test_an_exponent_that_is_off_is_told(place, which):
    alpha = ALPHA.copy()
    alpha[place] += 0.15
    assert fig27.verdicts(data(alpha))[which].holds is False


def test_it_is_drawn():
    figure = drawn(fig27, data())
    FigureCanvasAgg(figure).draw()
    labels = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert "1/(H + 1)" in labels
    assert "surfaces, 513² cells" in labels


def test_the_studies_are_shared_with_figure_28():
    from roughcontact.thesis import fig28

    assert fig28.studies("thesis")[: len(fig27.studies("thesis"))] == fig27.studies("thesis")
