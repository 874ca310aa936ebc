"""Figure 36: a parabola, the indenter that stands for roughness, and both."""

import math

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact.mdr.bodies.indentation import indent
from roughcontact_thesis import fig36_equivalent_indenters as fig36
from roughcontact_thesis.figures import drawn, verdicts


def test_the_shapes_are_those_of_5_6_to_5_8():
    shapes = fig36.case()
    r = np.array([0.0, 0.01, 0.1, 0.5])
    hurst, zeta = 0.7, 1.0
    kappa = math.sqrt(math.pi) * math.gamma(hurst / 2 + 1) / math.gamma((hurst + 1) / 2)
    q = (2 / zeta) ** (hurst + 1) * (hurst + 1) * 9e-3 / (2 * hurst * kappa)
    assert q == pytest.approx(0.0250082, abs=5e-8)
    np.testing.assert_allclose(shapes.parabola.height(r), r**2, rtol=1e-12)  # R = 1/2
    np.testing.assert_allclose(shapes.roughness.height(r), q * r**hurst, rtol=1e-9)
    np.testing.assert_allclose(shapes.both.height(r), r**2 + q * r**hurst, rtol=1e-9)


def test_forces_of_the_sum_add_up_at_one_contact_radius():
    shapes = fig36.case()
    parts = [indent(profile, 1.0, contact_radius=0.03) for profile in (shapes.parabola, shapes.roughness)]
    whole = indent(shapes.both, 1.0, contact_radius=0.03)
    assert whole.force == pytest.approx(sum(part.force for part in parts), rel=1e-12)
    assert whole.depth == pytest.approx(sum(part.depth for part in parts), rel=1e-12)
    k = whole.stiffness
    assert k == pytest.approx(0.06, rel=1e-12)
    # Eq. 5.9 in numbers, zeta = 1.
    assert whole.force == pytest.approx(k**3 / 3 + 9e-3 * k**1.7, rel=1e-9)


def test_it_is_drawn_and_judged():
    shapes = fig36.case()
    figure = drawn(fig36, shapes)
    FigureCanvasAgg(figure).draw()
    assert len({axes.get_ylim() for axes in figure.axes}) == 1
    assert [each.word for each in verdicts(fig36, shapes)] == ["holds"] * 2
