import numpy as np
import pytest

import roughcontact as rc


def test_lengths_count_cells():
    grid = rc.Grid((4, 5), (0.5, 2.0))
    assert grid.lengths == (2.0, 10.0)
    assert grid.area == 20.0
    assert grid.cell_area == 1.0
    assert grid.size == 20


def test_one_number_serves_every_axis():
    assert rc.Grid((4, 5), 0.5, True) == rc.Grid([4, 5], (0.5, 0.5), (True, True))
    assert rc.Grid(7, 0.5) == rc.Grid((7,), (0.5,))


def test_arrays_and_their_numbers_serve_too():
    assert rc.Grid(np.array([4, 5]), np.array([0.5, 2.0])) == rc.Grid((4, 5), (0.5, 2.0))
    assert rc.Grid(np.int64(7), np.float64(1.0)) == rc.Grid(7, 1.0)


def test_a_window_is_free():
    window = rc.Grid((8, 9), (1.0, 2.0), True).window((slice(2, 5), slice(0, 9)))
    assert window == rc.Grid((3, 9), (1.0, 2.0), False)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((0, 4), 1.0), "positive whole"),
        (((4, -1), 1.0), "positive whole"),
        (((4, 2.5), 1.0), "positive whole"),
        (((4, 4, 4), 1.0), "one or two axes"),
        (((4, None), 1.0), "positive whole"),
        (("4", 1.0), "positive whole"),
        ((np.nan, 1.0), "positive whole"),
        (((4, 4), 0.0), "spacing must be positive"),
        (((4, 4), None), "exactly one of spacing and size: none is given"),
        (((4, 4), (1.0, np.nan)), "spacing must be positive"),
        (((4, 4), (1.0, np.inf)), "spacing must be positive"),
        (((4, 4), (1.0, 1.0, 1.0)), "spacing needs one value or 2"),
        (((4, 4), 1.0, (True,)), "periodic needs one value or 2"),
    ],
)
def test_nonsense_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        rc.Grid(*arguments)


def test_cells_have_centres_and_ends():
    grid = rc.Grid((2, 3), (0.5, 2.0), (True, False))
    np.testing.assert_array_equal(grid.coordinates[0], [0.25, 0.75])
    np.testing.assert_array_equal(grid.coordinates[1], [1.0, 3.0, 5.0])
    assert grid.ends == ((), (0, -1))


def test_rings_fill_their_disc():
    grid = rc.RadialGrid([0.0, 0.1, 0.5, 2.0])
    np.testing.assert_allclose(grid.cell_area, np.pi * np.diff(grid.edges**2), rtol=1e-14)
    assert grid.area == pytest.approx(4 * np.pi)
    assert grid.lengths == (2.0,)
    assert grid.ends == ((-1,),)
    assert grid == rc.RadialGrid(np.array([0.0, 0.1, 0.5, 2.0]))
    assert hash(grid) == hash(rc.RadialGrid([0.0, 0.1, 0.5, 2.0]))
    assert grid != rc.RadialGrid.uniform(3, 2.0)


def test_a_window_of_rings_has_a_hole():
    window = rc.RadialGrid([0.0, 0.1, 0.5, 2.0]).window((slice(1, 3),))
    assert window == rc.RadialGrid([0.1, 0.5, 2.0])
    assert window.ends == ((0, -1),)


@pytest.mark.parametrize(
    "arguments", [(0, 1.0), (2.5, 1.0), ("3", 1.0), (np.nan, 1.0), (3, 0.0), (3, np.inf), (3, None)]
)
def test_a_disc_without_rings_is_refused(arguments):
    with pytest.raises(ValueError, match="a disc needs"):
        rc.RadialGrid.uniform(*arguments)


def test_radii_are_real_numbers():
    with pytest.raises(ValueError, match="real numbers"):
        rc.RadialGrid([0.0, 1j])
