"""Figure 17: the stiffness of the stepped indenter against load."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig17_stepped_stiffness as fig17
from roughcontact_thesis.figures import drawn, verdicts
from roughcontact_thesis.stepped_body import INDENTER


@pytest.fixture(scope="module")
def data():
    return fig17.case()


def test_the_staircase_is_the_sum_of_its_steps(data):
    force, stiffness = data.steps
    np.testing.assert_allclose(stiffness, 2 * 2.0 ** np.arange(fig17.COUNT), rtol=1e-14)
    # k_n h_n = 2 C^(n (1 + H)): a geometric sum.
    ratio = 2**1.5
    np.testing.assert_allclose(
        force, 2 * (ratio ** np.arange(1, fig17.COUNT + 1) - 1) / (ratio - 1), rtol=1e-13
    )


def test_far_from_the_tip_each_step_is_the_one_before_enlarged(data):
    force, stiffness = (np.array([getattr(s, name) for s in data.full]) for name in ("force", "stiffness"))
    # The body enlarged by C across and C^H upright is itself without its tip, which shifts forces by a share that falls
    # as C^-(1 + H) a step: of the last two 3e-3.
    assert force[-1] / force[-2] == pytest.approx(2**1.5, rel=3e-3)
    assert stiffness[-1] / stiffness[-2] == pytest.approx(2, rel=3e-3)


def test_the_curve_passes_through_the_states_and_keeps_below_full_discs(data):
    curve = data.curve
    for state in data.full[1:-1]:
        # Stiffness grows with force, and jumps where the next rim touches: the states lie before the jump.
        before = curve.force < state.force
        assert curve.stiffness[before].max() < state.stiffness * (1 + 1e-6)
    assert (np.diff(curve.stiffness) > -1e-6 * curve.stiffness[:-1]).all()
    whole = 2 * INDENTER.radii(fig17.COUNT + 1)
    assert (curve.stiffness <= whole[np.searchsorted(whole, curve.stiffness)]).all()
    last = data.full[-1]
    assert curve.stiffness[-1] == pytest.approx(last.stiffness, rel=1e-2)
    assert last.stiffness < whole[fig17.COUNT - 1]


def test_the_smooth_indenter_has_the_slope_of_the_law(data):
    slope = np.diff(np.log(data.smooth)) / np.diff(np.log(data.curve.force))
    np.testing.assert_allclose(slope, 1 / (1 + INDENTER.hurst), rtol=1e-9)
    # Far from the tip the computed curve goes along: a step apart, C, at the most, and to both sides.
    reached = data.curve.force > data.full[1].force
    ratio = data.curve.stiffness[reached] / data.smooth[reached]
    assert 1 < ratio.max() < 2
    assert 0.5 < ratio.min() < 1


def test_it_is_drawn_and_judged(data):
    FigureCanvasAgg(drawn(fig17, data)).draw()
    exponent, share = verdicts(fig17, data)
    assert exponent.word == "holds"
    assert share.word == "holds"
    # 1 - C^-(1 + H) of the staircase, in the limit.
    assert f"{1 - 2**-1.5:.0%} of the force of the staircase" in share.found
