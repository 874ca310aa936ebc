"""Contact spots: cells that share an edge, found by a search of a few lines."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.spots import count_spots, find_spots
from roughcontact.solver.inner_product import Measure


def flooded(contact, periodic):
    """Return the labels of a map: each spot is filled from its first cell."""
    labels = np.zeros(contact.shape, int)
    for first in np.argwhere(contact):
        todo = [tuple(first)] if labels[tuple(first)] == 0 else []
        number = labels.max() + 1
        while todo:
            cell = todo.pop()
            if contact[cell] and labels[cell] == 0:
                labels[cell] = number
                for axis, n in enumerate(contact.shape):
                    for step in (-1, 1):
                        moved = cell[axis] + step
                        if periodic[axis] or 0 <= moved < n:
                            todo.append((*cell[:axis], moved % n, *cell[axis + 1 :]))
    return labels


@pytest.mark.parametrize(
    ("shape", "periodic"),
    [
        *(((7, 12), (y, x)) for y in (False, True) for x in (False, True)),
        ((1, 12), (False, True)),
        ((12, 1), (True, False)),
        ((30,), (False,)),
        ((30,), (True,)),
    ],
)
@pytest.mark.parametrize("filled", [0.0, 0.3, 0.55, 0.9, 1.0])
def test_spots_are_cells_that_share_an_edge(shape, periodic, filled):
    rng = np.random.default_rng(3)
    grid = rc.Grid(shape, (2e-6, 3e-6)[: len(shape)], periodic)
    for _ in range(5):
        pressure = np.where(rng.random(shape) < filled, rng.integers(1, 9, shape), 0).astype(float)
        expected = flooded(pressure > 0, periodic)
        spots = find_spots(pressure > 0, pressure, grid, Measure(grid.cell_area))
        assert spots.count == expected.max() == count_spots(pressure > 0, grid)
        np.testing.assert_array_equal(spots.labels, expected)
        of = [expected == k + 1 for k in range(spots.count)]
        # Whole numbers times a cell: each is rounded as often as it has cells.
        areas = [cells.sum() * grid.cell_area for cells in of]
        loads = [pressure[cells].sum() * grid.cell_area for cells in of]
        np.testing.assert_allclose(spots.areas, areas, rtol=pressure.size * 2.3e-16)
        np.testing.assert_allclose(spots.loads, loads, rtol=pressure.size * 2.3e-16)
