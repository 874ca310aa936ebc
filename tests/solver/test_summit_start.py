"""The first pressure on the coarsest cells: that of the lowest cell of each block, as if there were no others."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.solver.summit_start import BLOCKS, summit_start

FORCE = 200.0
SHAPES = [(64, 64), (37, 50), (5, 64), (13, 14)]


def summits(separation):
    """One cell for each block, found one by one."""
    sides, found = [-(-n // BLOCKS) for n in separation.shape], []
    for y in range(0, separation.shape[0], sides[0]):
        for x in range(0, separation.shape[1], sides[1]):
            block = separation[y : y + sides[0], x : x + sides[1]]
            if np.isfinite(block).any():
                row, column = np.unravel_index(block.argmin(), block.shape)
                found.append((y + row) * separation.shape[1] + x + column)
    return np.array(found)


def rough(shape):
    rng = np.random.default_rng(5)
    separation = np.where(rng.random(shape) < 0.2, np.inf, rng.random(shape))
    return separation - separation.min()


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("control", [rc.Force(FORCE), rc.Depth(0.8)], ids=str)
def test_the_summits_alone_are_in_contact(shape, periodic, control):
    separation, body = rough(shape), rc.half_space(rc.Grid(shape, 1.0, periodic), 40.0)
    pressure, depth = summit_start(body, separation, control)
    if periodic and isinstance(control, rc.Depth):
        assert not pressure.any()
        return
    cells = summits(separation)
    assert not np.delete(pressure.ravel(), cells).any()
    assert (pressure >= 0).all()
    gap = body.as_matrix(cells) @ pressure.ravel()[cells] + separation.ravel()[cells] - depth
    pressed = pressure.ravel()[cells] > 0
    assert pressed.any()
    # A factorisation of 64 unknowns errs by 64 units in the last place at most, times a condition below a thousand.
    assert np.abs(gap[pressed]).max() < 1e-11 * depth
    if isinstance(control, rc.Force):
        assert pressure.sum() == pytest.approx(FORCE, rel=1e-12)
    else:
        assert depth == control.value


@pytest.mark.parametrize("side", [1.0, 0.25])
@pytest.mark.parametrize("count", [BLOCKS**2, BLOCKS**2 + 1])
def test_of_no_more_cells_than_summits_none_is_pressed(count, side):
    """The lowest cell alone goes as deep as the others are high, but for those that are higher by far."""
    shape = (16, 16)
    body = rc.half_space(rc.Grid(shape, side), 1.0)
    separation = np.where(np.arange(256).reshape(shape) < count, 0.9, 1.1)
    separation[0, 0] = 0.0
    force = side**2 / body.as_matrix(np.zeros(1, int))[0, 0]
    pressure, _ = summit_start(body, separation, rc.Force(force))
    assert pressure.any() == (count > BLOCKS**2)
