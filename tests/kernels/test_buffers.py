"""Memory to work in: where it begins, whose it is, and how much is kept."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

from roughcontact.kernels import buffers as room
from roughcontact.kernels.buffers import LARGE, LINE, MOST, SMALL, aligned, empty, zeros
from roughcontact.kernels.calls import address

COUNT = SMALL // 4  # numbers of which some memory is kept


@pytest.fixture(autouse=True)
def nothing_kept(monkeypatch):
    monkeypatch.setattr(room, "_kept", {})
    monkeypatch.setattr(room, "_total", [0])


def where(array):
    return address(array)


def kept():
    """Return the bytes that are kept, as they are counted."""
    sizes = [memory.nbytes - LINE for blocks in room._kept.values() for _, memory in blocks]
    assert room._total[0] == sum(sizes)
    return room._total[0]


@pytest.mark.parametrize("make", [empty, zeros])
@pytest.mark.parametrize("precision", ["float32", "float64", "bool"])
@pytest.mark.parametrize("shape", [(1,), (7, 3), (200, 333), (LARGE // 8 + 1,), (0,)])
def test_it_is_as_asked(make, precision, shape):
    for _ in range(3):
        found = make(shape, precision)
        assert found.shape == shape
        assert found.dtype == precision
        assert found.flags.c_contiguous
        assert found.flags.writeable
        if make is zeros:
            assert not found.any()
        found[...] = 1


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("numbers", [1, 7, COUNT, 3 * COUNT + 1, LARGE // 4])
def test_it_begins_with_a_line_of_the_cache(precision, numbers):
    for _ in range(3):
        found = aligned(numbers, precision)
        assert found.shape == (numbers,)
        assert found.dtype == precision
        assert where(found) % LINE == 0
        found[:] = 1.0


def test_it_is_kept_for_the_next_like_it():
    first = empty((COUNT,), "float64")
    place = where(first)
    del first
    assert kept() == 8 * COUNT
    others = [empty(*like) for like in (((COUNT + 1,), "float64"), ((2, COUNT), "float32"))]
    assert kept() == 8 * COUNT
    second = empty((COUNT,), "float64")
    assert place == where(second) != where(empty((COUNT,), "float64"))
    assert place not in map(where, others)


def test_whoever_looks_at_it_holds_it():
    whole = empty((2, COUNT), "float64")
    part = whole[1, 5:].reshape(-1, 1).T
    part[...] = 3.0
    del whole
    assert kept() == 0
    other = zeros((2, COUNT), "float64")
    assert not np.shares_memory(other, part)
    assert (part == 3).all()
    del part
    assert kept() == 16 * COUNT


def test_whoever_works_has_his_own():
    ready = Barrier(4)

    def work(k):
        found = empty((COUNT,), "float64")
        ready.wait(10)
        found[:] = k
        ready.wait(10)
        return bool((found == k).all())

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(4)))


def test_what_is_large_or_small_is_not_kept():
    for size in (LARGE, SMALL - 8):
        array = empty((size // 8,), "float64")
        del array
        assert kept() == 0


def test_no_more_is_kept_than_allowed():
    size = LARGE - 64
    many = [empty((size,), "bool") for _ in range(MOST // size + 3)]
    many.clear()
    assert MOST - size < kept() <= MOST


def test_what_is_used_now_takes_the_place_of_what_was():
    size = LARGE - 64
    many = [empty((size,), "bool") for _ in range(MOST // size)]
    del many
    new = empty((size - 64,), "bool")
    place = where(new)
    del new
    assert kept() <= MOST
    assert where(empty((size - 64,), "bool")) == place
