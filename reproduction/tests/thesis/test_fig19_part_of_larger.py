"""Figure 19: one contact of a small indenter and of the larger one around it."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from roughcontact_thesis import fig19_part_of_larger as fig19
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig19.case()


def test_the_small_indenter_is_a_part_of_the_large_one(data):
    small, large = data.surfaces
    row, column = data.corner
    n = fig19.POINTS // fig19.SCALE
    np.testing.assert_array_equal(small.heights, large.heights[row : row + n, column : column + n])
    assert small.heights.max() == large.heights.max()


@pytest.mark.parametrize("seed", [fig19.SEED, 2, 7])
def test_both_have_one_contact(seed):
    found = fig19.case(seed)
    small, large = found.contacts
    assert small.depth == large.depth
    # Both are solved to 1e-8 of their displacements.
    assert small.force == pytest.approx(large.force, rel=1e-6)
    assert small.stiffness == pytest.approx(large.stiffness, rel=1e-6)
    row, column = found.corner
    places = np.argwhere(large.contact)
    np.testing.assert_array_equal(places - (row, column), np.argwhere(small.contact))


def test_without_dimension_they_are_as_4_28_and_4_29_say(data):
    small, large = (
        (state.stiffness / surface.grid.lengths[0], state.force / (surface.rms * surface.grid.lengths[0]))
        for surface, state in zip(data.surfaces, data.contacts, strict=True)
    )
    ratio = data.surfaces[1].rms / data.surfaces[0].rms
    assert large[0] == pytest.approx(small[0] / fig19.SCALE, rel=1e-6)
    assert large[1] == pytest.approx(small[1] / (fig19.SCALE * ratio), rel=1e-6)


def test_rms_heights_of_parts_follow_from_the_waves(data):
    heights = data.surfaces[1].heights
    power = np.abs(np.fft.fft2(heights)) ** 2
    power[0, 0] = 0
    n = fig19.POINTS
    for parts, found in zip(fig19.PARTS, data.rms, strict=True):
        # The mean over m cells leaves sin(pi j m/n)/(m sin(pi j/n)) of wave j.
        m, j = n // parts, np.arange(n)
        with np.errstate(invalid="ignore"):
            left = np.where(j == 0, 1.0, np.sin(np.pi * j * m / n) / (m * np.sin(np.pi * j / n)))
        kept = 1 - np.outer(left, left) ** 2
        assert found == pytest.approx(np.sqrt((power * kept).sum() / power.sum()), rel=1e-9)
    # Halved again and again, the exponent rises towards H, which it has not reached at the first halving.
    exponents = np.log2(data.rms[:-1] / data.rms[1:])
    assert (np.diff(exponents) > 0).all()
    assert exponents[0] < fig19.HURST / 2
    assert 0.9 * fig19.HURST < exponents[-1] < fig19.HURST


def test_it_is_drawn_and_judged(data):
    FigureCanvasAgg(drawn(fig19, data)).draw()
    assert [each.word for each in verdicts(fig19, data)] == [
        "holds",
        "holds in part (for parts of L/4 and smaller)",
    ]
