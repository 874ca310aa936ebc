"""Figure 24: nested beats and adjacent harmonics."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.theory.springs import cosine
from roughcontact_thesis import fig24_beats as fig24
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig24.case(places=2**18)


def test_a_nested_beat_is_the_mean_of_twice_as_many_modes():
    x = np.linspace(0, 1, 1000)
    signs = np.array(np.meshgrid(*[[-1, 1]] * 4)).reshape(4, -1)
    modes = np.cos(2 * np.pi * (signs.T @ fig24.SHOWN)[:, None] * x)
    assert len(modes) == 16  # each twice, by the evenness of the cosine
    np.testing.assert_allclose(fig24.beat(x, fig24.SHOWN), modes.mean(axis=0), atol=1e-12)
    # Similar frequencies: all within a sixth of the carrier.
    frequencies = np.abs(signs.T @ fig24.SHOWN)
    assert np.ptp(frequencies) / 2 <= fig24.SHOWN[0] / 6
    assert len(np.unique(frequencies)) == 8


def test_heights_of_one_mode_are_those_of_a_cosine(data):
    one = data.heights[0]
    # Stiffness of springs under a cosine of amplitude 1: the part of the line above a depth.
    exact = cosine.stiffness(one.depth, 1.0, 1.0, 1.0)
    np.testing.assert_allclose(one.nested, exact, atol=20 / 2**18)
    np.testing.assert_allclose(one.adjacent, exact, atol=1e-3)


def test_powers_of_the_densities(data):
    modes, stiffness = verdicts(fig24, data)
    assert modes.word == "holds in part (modes that are beats of beats)"
    assert stiffness.word == "holds"
    for heights in data.heights[1:]:
        # Two phases, whatever the number of modes: a constant density.
        assert abs(heights.exponent(heights.adjacent)) < 0.15


def test_the_picture(data):
    picture = drawn(fig24, data)
    FigureCanvasAgg(picture).draw()
    assert len(picture.axes) == 5
