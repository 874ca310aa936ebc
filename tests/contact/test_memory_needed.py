"""The table of the memory that a load or a curve takes is compared with the peak that Python's allocators report."""

import gc
import tracemalloc

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.memory_needed import largest_maps
from roughcontact.contact.problem import separation_of
from roughcontact.kernels import buffers
from roughcontact.threads import limit_threads

LAYER = {"thickness": 0.1, "base": "rigid-frictionless"}
BODIES = {
    "free": (False, None),
    "periodic": (True, None),
    "singly periodic": ((True, False), None),
    "layer, free": (False, lambda grid: rc.layer(grid, 1.0, **LAYER)),
    "layer, periodic": (True, lambda grid: rc.layer(grid, 1.0, **LAYER)),
    "line, free": (False, lambda grid: rc.line(grid, 1.0)),
    "line, periodic": (True, lambda grid: rc.line(grid, 1.0)),
    "foundation": (False, lambda grid: rc.foundation(grid, 1.0)),
}


def surface(body, n):
    periodic, _ = BODIES[body]
    lies = "line" in body or body == "foundation"
    grid = rc.Grid(n * n, 1 / n**2, periodic) if lies else rc.Grid((n, n), 1 / n, periodic)
    return rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(0))


def peak(run):
    """Return the largest memory of a run [bytes] that begins with nothing kept, by one thread."""
    gc.collect()  # or what others have left is kept meanwhile
    buffers.release()
    tracemalloc.start()
    try:
        with limit_threads(1):
            run()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.slow
@pytest.mark.parametrize("curve", [False, True])
@pytest.mark.parametrize("body", BODIES)
def test_every_load_lies_between_the_bounds(body, curve):
    rough, make = surface(body, 90 if "line" in body else 256), BODIES[body][1]
    operator = None if make is None else make(rough.grid)

    def load(pressure):
        given = {
            "operator": operator,
            "pressures" if curve else "pressure": [pressure] if curve else pressure,
        }
        (rc.loading_curve if curve else rc.press)(rough, 1.0, **given)

    load(1e-9)  # what is made once is made
    light, full = rc.memory_needed(rough, operator=operator, curve=curve)
    found = [peak(lambda pressure=pressure: load(pressure)) for pressure in (1e-9, 0.01, 10.0)]
    assert light <= min(found)
    assert max(found) <= full


@pytest.mark.parametrize("periodic", [False, True])
def test_a_heavy_load_takes_more_than_half_of_what_is_said(periodic):
    rough = surface("periodic" if periodic else "free", 1024)
    _, full = rc.memory_needed(rough)
    assert peak(lambda: rc.press(rough, 1.0, pressure=10.0)) > full / 2


def test_rings_take_the_making_of_their_matrix():
    rings = rc.RadialGrid.uniform(400, radius=1.0)
    ball = rc.RadialProfile(-(rings.radii**2) / 20, rings)
    light, full = rc.memory_needed(ball)
    assert light == 8 * 400**2
    assert light <= peak(lambda: rc.press(ball, 1.0, force=1e-3)) <= full
    assert rc.memory_needed(rings, operator=rc.ring(rings, 1.0))[0] == 8 * 400  # the matrix is there


def test_what_is_kept_and_a_matrix_of_few_cells_take_64_megabytes_at_the_most():
    def full(n):
        return rc.memory_needed(rc.Grid((n, n), 1.0))[1]

    assert (full(64) - buffers.MOST) / 64**2 == (full(16384) - buffers.MOST) / 16384**2
    assert full(8) < 1e5


def test_a_period_of_16384_cells_fits_24_gigabytes_with_its_heights():
    grid = rc.Grid((16384, 16384), 1.0, True)
    assert rc.memory_needed(grid)[1] + 8 * grid.size < 24e9


def test_nonsense_is_refused():
    with pytest.raises(ValueError, match="a surface or its grid is wanted, not"):
        rc.memory_needed(np.zeros((8, 8)))


@pytest.mark.parametrize("memory", [1e9, 23.4e9])
def test_the_largest_maps_are_the_largest_that_fit(memory):
    for which, side in enumerate(largest_maps(memory)):
        fits = [rc.memory_needed(rc.Grid((n, n), 1.0))[which] + 8 * n * n <= memory for n in (side, side + 1)]
        assert fits == [True, False]
    assert largest_maps(0.0) == (0, 0)


def test_the_gap_at_first_touch_takes_one_plane_and_a_mask():
    """8 bytes a cell and 1; the few kilobytes of a mask's totals are less than an eighth of a plane."""
    rough = surface("free", 256)
    assert peak(lambda: separation_of(rough)) < (8 + 2) * 256**2
