"""What cannot fit is refused before it is tried; what could be done never is."""

import tracemalloc
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

import roughcontact as rc
from roughcontact import memory
from roughcontact.contact.problem import LEAST_BYTES

SIDE = 1536  # of so many cells it is asked


@pytest.fixture
def machine(monkeypatch, tmp_path):
    """Return a function that sets what is free, and the limits that Linux tells in files."""
    monkeypatch.setattr(memory, "OWN", tmp_path / "own")
    monkeypatch.setattr(memory, "GROUPS", tmp_path / "groups")

    def having(free, swap=0, held=0, own="", **limits):
        monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=free))
        monkeypatch.setattr(psutil, "swap_memory", lambda: SimpleNamespace(free=swap, total=swap))
        monkeypatch.setattr(psutil.Process, "memory_info", lambda _: SimpleNamespace(rss=held))
        (tmp_path / "own").write_text(own)
        for name, limit in limits.items():
            path = tmp_path / "groups" / name.replace("__", "/").replace("_", ".", 1)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(limit)

    return having


@pytest.fixture(scope="module")
def spike():
    heights = np.zeros((SIDE, SIDE))
    heights[SIDE // 2, SIDE // 2] = 1e-6
    return rc.Surface(heights, rc.Grid((SIDE, SIDE), 1e-6))


def test_a_press_that_cannot_fit_is_refused(spike, machine):
    """With an operator of the caller's, of which no more is known than what every press takes."""
    machine(free=LEAST_BYTES * SIDE**2 - 1)
    told = (
        "pressing 1536 x 1536 cells needs 0.0212 GB of memory at least, and 0.0212 GB are there: press a part"
    )
    for verb in (rc.press, rc.loading_path, rc.loading_curve):
        loads = {"force": 1e-9} if verb is rc.press else {"forces": [1e-9]}
        with pytest.raises(ValueError, match=told):
            verb(spike, 1e9, operator=rc.half_space(spike.grid, 1e9), **loads)


def test_a_press_within_the_bound_is_tried(spike, machine):
    machine(free=LEAST_BYTES * SIDE**2)
    body = rc.half_space(spike.grid, 1e9)
    assert rc.press(spike, 1e9, force=1e-9, operator=body).contact.sum() == 1


@pytest.mark.parametrize("verb", [rc.press, rc.loading_curve])
def test_a_load_that_cannot_fit_is_refused_at_once(verb, machine, monkeypatch):
    """A light one on the same cells is tried: it takes less than half."""
    grid = rc.Grid((512, 512), 1 / 512)
    rough = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    curve = verb is rc.loading_curve
    machine(free=0.7 * rc.memory_needed(grid, curve=curve))

    def load(force):
        return verb(rough, 1.0, forces=[force]) if curve else verb(rough, 1.0, force=force)

    told = "a curve on" if curve else "this load on"
    with pytest.raises(ValueError, match=f"{told} 512 x 512 cells needs 0.0.* GB of memory at least"):
        load(0.1)
    assert load(1e-6) is not None


def test_small_grids_are_not_asked_about(machine):
    machine(free=0)
    surface = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), 1e-3)
    assert rc.press(surface, 1e9, force=1e-6).force == pytest.approx(1e-6)


@pytest.mark.parametrize("periodic", [False, True])
def test_every_press_takes_the_bound(periodic):
    """The lightest contact that there is: one cell."""
    heights = np.zeros((256, 256))
    heights[100, 100] = 1e-6
    surface = rc.Surface(heights, rc.Grid((256, 256), 1e-6, periodic))
    rc.press(surface, 1e9, force=1e-9)  # what is made once is made
    tracemalloc.start()
    try:
        rc.press(surface, 1e9, force=1e-9)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most >= LEAST_BYTES * surface.grid.size


@pytest.mark.parametrize(
    ("settings", "most"),
    [
        ({"free": 5e9}, 5e9),
        ({"free": 5e9, "swap": 2e9, "held": 1e9}, 8e9),
        ({"free": 5e9, "own": "0::/job/step\n", "memory_max": "max"}, 5e9),
        ({"free": 5e9, "own": "0::/\n", "memory_max": "3000000000\n"}, 3e9),
        # The path of the host, which a container has not; swap space counts.
        ({"free": 5e9, "swap": 1e9, "own": "0::/job/step\n", "memory_max": "3000000000"}, 4e9),
        ({"free": 5e9, "own": "0::/job/step\n", "memory_max": "max", "job__memory_max": "2000000000"}, 2e9),
        ({"free": 5e9, "own": "9:cpu:/a\n4:memory:/a\n", "memory__memory_limit_in_bytes": "1000000000"}, 1e9),
        ({"free": 5e9, "own": "no such line"}, 5e9),
    ],
)
def test_what_there_is(settings, most, machine, tmp_path):
    machine(**settings)
    assert memory.most_memory() == most
