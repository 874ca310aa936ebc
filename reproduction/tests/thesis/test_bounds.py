"""The window between one cell and the whole square."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact_thesis import bounds


def test_one_cell():
    """Eq. 4.16, against the house's own cell."""
    assert bounds.cell(1.0, 1.0) == pytest.approx(0.891106989096, rel=1e-12)
    assert pytest.approx(np.pi / 3.525494348078172, rel=1e-15) == bounds.CELL
    mask = np.zeros((5, 5), bool)
    mask[2, 3] = True
    stiffness = rc.contact_stiffness(mask, rc.Grid((5, 5), 1e-7), 2e11)
    assert bounds.cell(2e11, 1e-7) == pytest.approx(stiffness, rel=1e-12)
    # The factor of the text below eq. 4.16, with the printed full-contact stiffness and with the right one.
    assert bounds.cell(1.0, 1.0) / bounds.king_full_contact_stiffness(1.0, 1.0) == pytest.approx(
        0.7804, abs=5e-5
    )
    assert bounds.cell(1.0, 1.0) / bounds.full_contact_stiffness(1.0, 1.0) == pytest.approx(0.7733, abs=5e-5)


def test_full_contact_stiffness():
    assert bounds.full_contact_stiffness(2.0, np.array([1.0, 3.0])) == pytest.approx(
        [2.304596, 6.913788], rel=1e-12
    )
    assert bounds.king_full_contact_stiffness(1.0, 1.0) == pytest.approx(1.1419, abs=5e-5)
    assert bounds.full_contact_stiffness(1.0, 1.0) / bounds.king_full_contact_stiffness(
        1.0, 1.0
    ) == pytest.approx(1.0091, abs=5e-5)


@pytest.mark.parametrize(("points", "lowest"), [(513, 0.0348), (1025, 0.0174), (2049, 0.0087)])
def test_window_of_the_thesis_grids(points, lowest):
    low, high = bounds.window(1.0, 1.0, 1 / (points - 1))
    assert low == pytest.approx(lowest, abs=5e-5)
    assert high == bounds.full_contact_stiffness(1.0, 1.0)
    assert bounds.resolved(np.array([0.99, 1.01, 30.0]) * low, 1.0, 1.0, 1 / (points - 1)).tolist() == [
        0,
        1,
        1,
    ]
    assert not bounds.resolved(high, 1.0, 1.0, 1 / (points - 1))


def test_springs():
    assert bounds.WINDOW * bounds.spring(1.0, 1 / 512) == pytest.approx(20 / 512, rel=1e-15)


def test_a_grid_too_coarse_has_no_window():
    with pytest.raises(ValueError, match=r"spacing must be below 0\.0647 of the length"):
        bounds.window(1.0, 1.0, 1 / 15)
    low, high = bounds.window(1.0, 1.0, 1 / 16)
    assert low < high
