"""Figure 18: the scatter of surfaces and lines."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig18_scatter as fig18
from roughcontact_thesis.figures import drawn, verdicts
from thesis.synthetic import curves, lines

HURST = np.array([0.7, 1.0])


def data(scatter, samples=50):
    surfaces = curves(0.5, 1.0, HURST, scatter=scatter, samples=samples)
    return fig18.averages(surfaces, lines(0.5, 0.9, HURST, scatter=scatter))


def test_the_scatter_is_that_of_the_samples():
    found = data(0.25)
    np.testing.assert_allclose(found["scatter"], 0.25 * np.sqrt(50 / 49), rtol=1e-12)
    # Of lines four samples of ten, on the finest number of points.
    np.testing.assert_allclose(found["line_scatter"][:, :-5], 0.25 * np.sqrt(40 / 39), rtol=1e-12)
    assert found.attrs == {"cells": 513, "surfaces": 50, "points": 8192, "lines": 40}
    # 20 springs of 8192 carry load where 0.9 F^(1/2) is 20/8192.
    first = found["line_force"].to_numpy()[found["line_resolved"][0].to_numpy()][0]
    assert first == pytest.approx((20 / 8192 / 0.9) ** 2, rel=0.3)  # the step from force to force


@pytest.mark.parametrize(
    ("scatter", "word"), [(0.25, "holds"), (0.6, "does not hold"), (0.37, "not decided")]
)
def test_about_thirty_percent_holds_or_not_as_far_as_samples_tell(scatter, word):
    assert verdicts(fig18, data(scatter))[0].word == word


def test_it_is_drawn():
    FigureCanvasAgg(drawn(fig18, data(0.3))).draw()
