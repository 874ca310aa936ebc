"""Figure 15: cylinders that follow the fractal law."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig15_stepped_shape as fig15
from roughcontact_thesis.figures import drawn, verdicts


def test_the_cylinders_are_those_of_the_thesis():
    shape = fig15.case()
    indenter = shape.indenter
    assert (indenter.ratio, indenter.hurst) == (2, 0.5)
    np.testing.assert_allclose(indenter.radii(4), [1, 2, 4, 8], rtol=1e-15)
    np.testing.assert_allclose(indenter.heights(4), [1, 2**0.5, 2, 2**1.5], rtol=1e-14)


def test_the_smooth_indenter_goes_through_the_upper_rims():
    shape = fig15.case()
    radii, tops = shape.rims
    np.testing.assert_allclose(tops, [0, 1, 1 + 2**0.5, 3 + 2**0.5], rtol=1e-14)
    # z = Q r^H is a power law from its own tip: four times the radius, twice the depth.
    np.testing.assert_allclose(shape.depth(radii), tops, atol=1e-14)
    below_tip = shape.depth(radii) + shape.apex
    np.testing.assert_allclose(below_tip[2:] / below_tip[:-2], 2.0, rtol=1e-14)
    assert shape.apex == pytest.approx(1 + 2**0.5, rel=1e-14)  # 1/(sqrt 2 - 1)


def test_it_is_drawn_and_judged():
    shape = fig15.case()
    FigureCanvasAgg(drawn(fig15, shape)).draw()
    (verdict,) = verdicts(fig15, shape)
    assert verdict.word == "holds"
