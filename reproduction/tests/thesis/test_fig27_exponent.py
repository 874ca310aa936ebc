"""Figure 27: exponents of surfaces and lines."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig27_exponent as fig27
from roughcontact_thesis.figures import drawn, findings, verdicts
from thesis.synthetic import curves, lines

HURST = np.array([-0.5, -0.05, 0.4, 1.0, 2.0, 2.5, 2.95])
ALPHA = 1 / (np.clip(HURST, 0.2, 2) + 1)
LAWS = "1/(H + 1)", "1/3"


def data(alpha=ALPHA, scatter=0.2, reduced=ALPHA):
    surfaces = curves(alpha, 0.9, HURST, scatter=scatter)
    return fig27.averages(surfaces, lines(reduced, 0.9, HURST, scatter=0.2))


def test_what_the_thesis_says_would_hold_if_it_were_so():
    found = verdicts(fig27, data())
    assert [each.word for each in found] == ["holds", "holds", "not decided", "not decided", "holds"]
    assert found[0].ruling.span == "0.40 <= H <= 1.00"
    # The thesis refers to figure 26 for H < 0.2.
    assert found[4].ruling.span == "0.40 <= H <= 2.95"
    assert [*found[4].ruling.ranges] == [
        "below 0",
        "within 0.25 of 0",
        "0.25 to 1.75",
        "within 0.25 of 2",
        "above 2",
    ]
    assert "The central claim, an exponent of 1/(H + 1) within 10%, holds for surfaces" in findings(
        fig27, data()
    )


@pytest.mark.parametrize(("place", "which"), [(3, 0), (5, 1), (2, 4)])
def test_an_exponent_that_is_off_is_told(place, which):
    alpha = ALPHA.copy()
    alpha[place] += 0.15
    assert verdicts(fig27, data(alpha))[which].ruling.word == "holds in part"


def test_what_the_thesis_expects_at_the_limits_does_not_count():
    alpha = ALPHA.copy()
    alpha[[0, 1, 4]] += 0.3
    assert verdicts(fig27, data(alpha))[0].word == "holds"
    assert verdicts(fig27, data(1.3 * ALPHA))[0].word == "does not hold"


@pytest.fixture(scope="module")
def axes():
    figure = drawn(fig27, data(reduced=0.9 * ALPHA))
    FigureCanvasAgg(figure).draw()
    return figure.axes[0]


def test_the_law_is_drawn(axes):
    """1/(H + 1) up to H = 2, and from there on what it is there."""
    curve, plateau = ([line.get_data() for line in axes.lines if line.get_label() == law] for law in LAWS)
    ((hurst, alpha),), ((high, third),) = curve, plateau
    np.testing.assert_allclose(alpha * (hurst + 1), 1, rtol=1e-14)
    assert (hurst[0] <= 0, hurst[-1], high[0]) == (True, 2, 2)
    assert high[-1] >= HURST[-1]
    np.testing.assert_allclose(third, 1 / 3, rtol=1e-14)


def test_exponents_are_drawn_as_they_were_found(axes):
    """Surfaces as crosses with bars, rough lines as lines, the finest in its band."""
    found = data(reduced=0.9 * ALPHA)
    crosses, _, (bars,) = axes.containers[0]
    np.testing.assert_array_equal(crosses.get_xdata(orig=False), HURST)
    np.testing.assert_allclose(crosses.get_ydata(orig=False), ALPHA, rtol=1e-9)
    limits = np.stack([found[f"exponent_{end}"].to_numpy() for end in ("low", "high")], axis=1)
    np.testing.assert_allclose([bar[:, 1] for bar in bars.get_segments()], limits, rtol=1e-12)
    lines = [line for line in axes.lines if str(line.get_label()).startswith("rough lines")]
    for line, points in zip(lines, found["points"].to_numpy(), strict=True):
        assert line.get_label() == rf"rough lines, $N = 2^{{{np.log2(points):.0f}}}$"
        np.testing.assert_array_equal(line.get_xdata(orig=False), HURST)
        np.testing.assert_allclose(line.get_ydata(orig=False), 0.9 * ALPHA, rtol=1e-9)
    labels = [text.get_text() for text in axes.figure.legends[0].get_texts()]
    assert {*LAWS, "surfaces, 513² cells"} < set(labels)


def test_the_studies_are_shared_with_figure_28():
    from roughcontact_thesis import fig28_prefactor as fig28

    assert fig28.studies("thesis")[: len(fig27.studies("thesis"))] == fig27.studies("thesis")
