"""Figure 13: a contact region enlarged and stretched."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughcontact as rc
from roughcontact_thesis import fig13_stretched_region as fig13
from roughcontact_thesis.figures import drawn, verdicts


@pytest.fixture(scope="module")
def data():
    return fig13.case()


def test_stiffness_is_a_length(data):
    # Both solves are met to 1e-7.
    assert data.stiffness[1] == pytest.approx(fig13.STRETCH, rel=1e-6)


def test_stretched_one_way_it_grows_by_less_than_the_stretch(data):
    _, enlarged, along_x, along_y = data.stiffness
    # Stretching takes no two points nearer to each other: each stretch stiffens.
    for once in (along_x, along_y):
        assert 1 < once < enlarged
    assert abs(along_x / along_y - 1) > 0.05


def test_the_region_turned_exchanges_the_two(data):
    n = fig13.POINTS
    turned = data.region.T
    grids = rc.Grid((n, n), 1 / n), rc.Grid((n, n), (fig13.STRETCH / n, 1 / n))
    one, stretched = (rc.contact_stiffness(turned, grid, 1.0) for grid in grids)
    assert stretched / one == pytest.approx(data.stiffness[2], rel=1e-6)


def test_another_seed_makes_another_region(data):
    other = fig13.case(1)
    assert not np.array_equal(other.region, data.region)
    assert other.stiffness[1] == pytest.approx(fig13.STRETCH, rel=1e-6)


def test_it_is_drawn_to_one_scale_and_judged(data):
    figure = drawn(fig13, data)
    FigureCanvasAgg(figure).draw()
    widths = [abs(np.diff(axes.transData.transform([(0, 0), (1, 0)])[:, 0]).item()) for axes in figure.axes]
    assert max(widths) / min(widths) == pytest.approx(1, abs=0.02)
    assert [each.word for each in verdicts(fig13, data)] == ["holds"] * 3
