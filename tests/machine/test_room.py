"""Room to work in: where it begins, and whose it is."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

from roughcontact.machine import loader, room
from roughcontact.machine.room import MOST, room_for

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@pytest.fixture(autouse=True)
def empty(monkeypatch):
    monkeypatch.setattr(room, "_kept", [])


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("numbers", [1, 7, 1000])
def test_it_begins_with_a_line_of_the_cache_and_is_as_large_as_asked(precision, numbers):
    for _ in range(3):
        with room_for(numbers, precision) as found:
            assert found.shape == (numbers,)
            assert found.dtype == precision
            assert loader.address(found) % 64 == 0
            found[:] = 1.0


def test_it_is_kept_for_the_next_and_for_less():
    with room_for(1000, "float64") as first:
        where = loader.address(first)
    with room_for(300, "float32") as second:
        assert loader.address(second) == where
    with room_for(5000, "float64"):
        pass
    assert len(room._kept) == 1


def test_whoever_works_has_his_own():
    with room_for(100, "float64") as one, room_for(100, "float64") as two:
        assert not np.shares_memory(one, two)
    ready = Barrier(4)

    def work(k):
        with room_for(10_000, "float64") as found:
            ready.wait(10)
            found[:] = k
            ready.wait(10)
            return bool((found == k).all())

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(4)))


def test_what_is_large_is_not_kept():
    with room_for(MOST // 8, "float64"):
        pass
    assert not room._kept


def test_after_a_failure_it_is_left_to_those_who_may_still_work_in_it():
    with pytest.raises(KeyboardInterrupt), room_for(10, "float64"):
        raise KeyboardInterrupt
    assert not room._kept


def test_what_is_large_takes_nothing_from_the_small():
    with room_for(100, "float64") as small:
        where = loader.address(small)
    with room_for(MOST, "float32"):
        pass
    with room_for(100, "float64") as small:
        assert loader.address(small) == where
