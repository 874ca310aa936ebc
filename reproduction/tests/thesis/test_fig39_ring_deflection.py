"""Figure 39: the deflection under a ring-shaped force."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.special import ellipkm1

from roughcontact_thesis import fig39_ring_deflection as fig39
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig39.case()


def test_it_is_the_elliptic_integral_of_a_19(data):
    r = data.radius
    exact = 4 / (np.pi**2 * (1 + r)) * ellipkm1(((1 - r) / (1 + r)) ** 2)
    # Means over rings in place of values: of -ln x over a width w they are w^2/(24 x^2) more, 7e-5 for rings of x/25
    # and 1e-4 for the loaded one at the nearest place, where the logarithm is 8; and 2e-4 of the disc in the middle.
    far = np.abs(r - 1) >= fig39.NEAREST
    np.testing.assert_allclose(data.computed[far], exact[far], rtol=3e-4)
    assert far.sum() > 100


def test_far_away_the_ring_is_a_point(data):
    # u = F/(pi E* r) (1 + a^2/(4 r^2) + ...).
    r = data.radius[-1]
    assert data.computed[-1] == pytest.approx(
        2 / (np.pi * r) * (1 + 1 / (4 * r**2) + 9 / (64 * r**4)), rel=2e-3
    )


def test_the_logarithm_is_off_by_half_the_distance_less_what_the_elliptic_integral_holds(data):
    # u pi^2 a E*/F = (1 - x/2 + ...) ln(8 (1 + x/2)/|x|), so that A.21 is off by x/2 (1 - 1/ln(8/x)).
    x = data.radius - 1
    near = (np.abs(x) >= 2 * fig39.NEAREST) & (np.abs(x) < 0.03)
    expected = x / 2 * (1 - 1 / np.log(8 / np.abs(x)))
    np.testing.assert_allclose(data.error[near], expected[near], rtol=0.06)


def test_it_is_drawn_and_judged(data):
    FigureCanvasAgg(drawn(fig39, data)).draw()
    assert [each.word for each in verdicts(fig39, data)] == ["holds"]
