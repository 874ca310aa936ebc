"""Figure 45: Hertz' contact and its springs."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig45_hertz_and_springs as fig45
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig45.case()


def test_sphere_and_springs_have_the_force_and_radius_of_hertz(data):
    # F = 4/3 sqrt(R) d^(3/2) and a = sqrt(R d), R = 1, d = 0.04. The radius ends at the edge of a ring of 1e-3 or of a
    # spring of 5e-4; the rim carries little, so that the force is off by the square of a ring over the radius.
    for force, radius in zip(data.force, data.radius, strict=True):
        assert force == pytest.approx(4 / 3 * 0.04**1.5, rel=1e-4)
        assert radius == pytest.approx(0.2, abs=1e-3)


def test_the_surface_is_that_of_hertz(data):
    rings = data.solution.problem.grid.coordinates[0]
    inside = rings < 0.199
    np.testing.assert_allclose(
        data.solution.displacement[inside], 0.04 - rings[inside] ** 2 / 2, atol=0.04 * 1e-4
    )
    # Outside: ((2 a^2 - r^2) asin(a/r) + a sqrt(r^2 - a^2))/(pi R).
    r = rings[rings > 0.22]
    outside = ((2 * 0.04 - r**2) * np.arcsin(0.2 / r) + 0.2 * np.sqrt(r**2 - 0.04)) / np.pi
    np.testing.assert_allclose(data.solution.displacement[rings > 0.22], outside, atol=0.04 * 1e-3)


def test_springs_are_pressed_by_the_parabola_of_half_the_radius(data):
    np.testing.assert_allclose(data.springs, np.maximum(0.04 - data.x**2, 0), atol=1e-15)
    assert data.springs.sum() * (data.x[1] - data.x[0]) == pytest.approx(data.force[1], rel=1e-9)


def test_it_is_drawn_and_judged(data):
    FigureCanvasAgg(drawn(fig45, data)).draw()
    assert [each.word for each in verdicts(fig45, data)] == ["holds"]
