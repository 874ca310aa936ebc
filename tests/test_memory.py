"""What cannot fit is refused before it is tried; what could be done never is."""

import tracemalloc
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

import roughcontact as rc
from roughcontact import memory

SIDE = 1024
CELLS = 9 * SIDE**2  # bytes of the lightest load


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
    machine(free=CELLS - 1)
    told = "on 1024 x 1024 cells needs 0.0.* GB of memory at least, and 0.00944 GB are there: press a part"
    for verb in (rc.press, rc.loading_path, rc.loading_curve):
        loads = {"force": 1e-9} if verb is rc.press else {"forces": [1e-9]}
        for operator in (None, rc.half_space(spike.grid, 1e9)):
            with pytest.raises(ValueError, match=told):
                verb(spike, 1e9, operator=operator, **loads)


def test_a_press_that_may_not_fit_is_tried_with_a_warning(spike, machine):
    machine(free=CELLS)
    told = (
        "a load on 1024 x 1024 cells needs up to 0.167 GB of memory, and 0.00944 GB are there: press a part"
    )
    with pytest.warns(rc.MemoryWarning, match=told) as caught:
        assert rc.press(spike, 1e9, force=1e-9).contact.sum() == 1
    assert [each.filename for each in caught] == [__file__]


def test_a_press_that_fits_is_tried_in_silence(spike, machine):
    machine(free=rc.memory_needed(spike)[1])
    assert rc.press(spike, 1e9, force=1e-9).contact.sum() == 1


def test_the_memory_is_asked_once_for_each_press(spike, machine, monkeypatch):
    machine(free=1e12)
    asked = []
    monkeypatch.setattr(memory, "most_memory", lambda: asked.append(1) or 1e12)
    rc.press(spike, 1e9, force=1e-9)
    assert len(asked) == 1


@pytest.mark.parametrize("side", [32, 256])
def test_small_grids_are_not_asked_about(machine, side):
    machine(free=0)
    surface = rc.shapes.paraboloid(rc.Grid((side, side), 1e-6), 1e-3)
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
    assert most >= 9 * surface.grid.size


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
