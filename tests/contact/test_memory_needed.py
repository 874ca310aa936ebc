"""The model of the memory that a load or a curve takes is held against the peak that Python's allocators report."""

import gc
import tracemalloc

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.kernels import buffers, loader
from roughcontact.threads import limit_threads

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


def surface(n, periodic, flat):
    waves = {"long_cutoff": 0.25, "short_cutoff": 8 / n} if flat else {}
    return rc.self_affine(rc.Grid((n, n), 1 / n, periodic), 0.8, 0.01, np.random.default_rng(0), **waves)


def peak(run):
    """Return the largest memory of a run [bytes] that begins with nothing kept; what is made once is made before.

    By one thread: what several hold at one time is chance.
    """
    gc.collect()  # or what others have left is kept meanwhile
    with buffers.no_fork:
        buffers._kept.clear()
        buffers._total[0] = 0
    tracemalloc.start()
    try:
        with limit_threads(1):
            run()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.fixture(scope="module", autouse=True)
def _made_once():
    for periodic in (False, True):
        rc.loading_curve(surface(64, periodic, False), 1.0, forces=[1e-4, 1e-3, 1e-2])


# The largest force over E* L h_rms; 7 % of a fractal are in contact at 1, half of it at 10.
@pytest.mark.parametrize(
    ("n", "periodic", "flat", "load"),
    [
        *((512, False, flat, load) for flat in (False, True) for load in (1e-3, 0.046, 1.0, 10.0)),
        *((512, True, flat, load) for flat in (False, True) for load in (0.046, 1.0, 10.0)),
        *((1024, False, False, load) for load in (0.046, 10.0)),
        *((1024, True, False, load) for load in (0.046, 10.0)),
    ],
)
def test_a_load(n, periodic, flat, load):
    """Within a fifth, which is what is said of it."""
    rough, force = surface(n, periodic, flat), 0.01 * load
    found = peak(lambda: rc.press(rough, 1.0, force=force))
    assert rc.memory_needed(rough, 1.0, force=force) == pytest.approx(found, rel=0.2)


@pytest.mark.parametrize(
    ("n", "periodic", "load"),
    [
        *((512, periodic, load) for periodic in (False, True) for load in (0.046, 1.0, 10.0)),
        *((1024, periodic, 1.0) for periodic in (False, True)),
    ],
)
def test_a_curve(n, periodic, load):
    rough, forces = surface(n, periodic, False), 0.01 * np.geomspace(load / 50, load, 6)
    found = peak(lambda: rc.loading_curve(rough, 1.0, forces=forces))
    assert rc.memory_needed(rough, 1.0, force=forces[-1], curve=True) == pytest.approx(found, rel=0.2)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("curve", [False, True])
def test_no_load_takes_more_than_the_most(periodic, curve):
    rough = surface(512, periodic, False)
    needed = [rc.memory_needed(rough, 1.0, force=f, curve=curve) for f in (1e-5, 1e-2, 1.0)]
    assert max(needed) <= 1.2 * rc.memory_needed(rough.grid, curve=curve)  # a factorised matrix beside it
    assert rc.memory_needed(rough.grid, curve=curve) == rc.memory_needed(rough, curve=curve)


def test_a_period_of_16384_cells_fits_20_gigabytes_with_its_heights():
    grid = rc.Grid((16384, 16384), 1.0, True)
    assert rc.memory_needed(grid) + 8 * grid.size < 20e9


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"surface": rc.Grid(64, 1.0)}, "two axes"),
        ({"surface": rc.Grid((64, 64), 1.0), "force": 1.0}, "give the surface and the modulus"),
        ({"surface": surface(64, False, False), "force": 1.0}, "give the surface and the modulus"),
        ({"surface": surface(64, False, False), "modulus": 1.0, "force": 1.0, "depth": 1.0}, "one of"),
    ],
)
def test_nonsense_is_refused(given, message):
    with pytest.raises(ValueError, match=message):
        rc.memory_needed(**given)
