"""Figure 20: a line of three waves."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.integrate import quad
from scipy.optimize import brentq

from roughcontact_thesis import fig20_three_waves as fig20
from roughcontact_thesis.figures import drawn, verdicts

AMPLITUDES = 7.0 ** (-0.9 * np.arange(3))


def height(x):
    """Return the depth below the crest, eqs 4.42 to 4.44, at x in wavelengths."""
    return sum(h * (np.cos(2 * np.pi * 7**n * x) - 1) for n, h in enumerate(AMPLITUDES))


@pytest.fixture(scope="module")
def data():
    return fig20.case()


def test_the_line_is_the_sum_of_its_waves(data):
    x = data.line.grid.coordinates[0] - 0.5
    assert data.line.grid.lengths[0] == pytest.approx(1, rel=1e-12)
    np.testing.assert_allclose(data.line.heights, height(x), atol=1e-11)
    np.testing.assert_allclose(data.amplitudes, AMPLITUDES, rtol=1e-13)


def test_the_depths_touch_one_crest_three_crests_and_one_spot(data):
    d1, d2, d3 = (float(d) for d in data.pressed.depth)
    assert [data.spots(d) for d in (d1, d2, d3)] == [1, 3, 1]
    # The next crest and the trough before it, of the shortest wave on the middle one.
    x = np.linspace(0.001, 0.03, 200_001)
    z = height(x)
    inner = z[1:-1]
    trough = -inner[(inner < z[:-2]) & (inner < z[2:])][0]
    crest = -inner[(inner > z[:-2]) & (inner > z[2:])][0]
    assert d1 < crest < d2 < trough < d3
    first, last = fig20._one_spot(data)
    # By depths at steps of d3/3000 and half as much again.
    assert first == pytest.approx(trough, abs=d3 / 2000)
    assert last > d3


def test_force_and_length_in_contact_at_d3_are_the_integrals(data):
    d3 = float(data.pressed.depth[2])
    edge = brentq(lambda x: height(x) + d3, 0.02, 0.04)
    # Springs at points: lengths within one of them at either end.
    spacing = data.line.grid.spacing[0]
    assert data.pressed.contact_length[0, 2] == pytest.approx(2 * edge, abs=2 * spacing)
    force = 2 * quad(lambda x: height(x) + d3, 0, edge)[0]
    # The midpoint rule, with at most half a spring of slope 2 pi h1 7 at the ends.
    assert data.pressed.force[0, 2] == pytest.approx(force, abs=2 * np.pi * 7 * AMPLITUDES[1] * spacing**2)


def test_it_is_drawn_and_judged(data):
    FigureCanvasAgg(drawn(fig20, data)).draw()
    spot, stiffness, exponent = verdicts(fig20, data)
    assert spot.word == "holds"
    assert stiffness.word == "does not hold"
    # 4 sqrt(h1/h0)/q0 as printed.
    assert float(stiffness.quote) == pytest.approx(4 * np.sqrt(AMPLITUDES[1]) / (2 * np.pi), abs=5e-5)
    assert exponent.word == "holds"
    assert exponent.found.endswith(f"{1 / 1.9:.4f} by the law")
