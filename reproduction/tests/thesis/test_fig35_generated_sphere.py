"""Figure 35: a rough sphere."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact_thesis import fig35_generated_sphere as fig35
from roughcontact_thesis.figures import drawn


def test_it_is_a_paraboloid_with_roughness_on_it():
    sphere = fig35.case()
    n = fig35.POINTS
    places = (np.arange(n) - (n - 1) / 2) / (n - 1) * fig35.LENGTH
    squared = places[:, None] ** 2 + places**2
    roughness = sphere.heights + squared / (2 * fig35.RADIUS)
    # Nodes: the last row is the first one again.
    np.testing.assert_allclose(roughness[0], roughness[-1], atol=1e-15)
    period = roughness[:-1, :-1]
    assert period.std() == pytest.approx(fig35.RMS * fig35.LENGTH, rel=1e-12)
    waves = np.abs(np.fft.rfft2(period))
    # B ~ q^-(H + 1)
    assert waves[0, 1] / waves[0, 8] == pytest.approx(8 ** (fig35.HURST + 1), rel=1e-9)


def test_another_seed_roughens_it_otherwise():
    assert not np.array_equal(fig35.case().heights, fig35.case(1).heights)


def test_it_is_drawn_whole():
    # With few points: the view of the real one takes seconds.
    small = fig35.case().averaged(7)
    figure = drawn(fig35, rc.Surface(small.heights, small.grid))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    page = np.asarray(canvas.buffer_rgba())[..., :3]
    inked = (page < 250).any(axis=2)
    assert inked.any()
    for edge in (inked[0], inked[-1], inked[:, 0], inked[:, -1]):
        assert not edge.any()
