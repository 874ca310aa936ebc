"""Memory to work in: where it begins, whose it is, and how much is kept."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

from roughcontact.kernels import buffers
from roughcontact.kernels.buffers import (
    FITTING,
    LARGE,
    LINE,
    MOST,
    SMALL,
    aligned,
    empty,
    keep_large_buffers,
    zeros,
)
from roughcontact.kernels.calls import address

COUNT = SMALL // 4  # numbers of which some memory is kept


@pytest.fixture(autouse=True)
def nothing_kept(monkeypatch):
    monkeypatch.setattr(buffers, "_kept", {})
    monkeypatch.setattr(buffers, "_total", [0])


def where(array):
    return address(array)


def kept():
    """Return the bytes that are kept, as they are counted."""
    sizes = [memory.nbytes - LINE for blocks in buffers._kept.values() for _, memory in blocks]
    assert buffers._total[0] == sum(sizes)
    return buffers._total[0]


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


def large(size=LARGE):
    return empty((size,), "bool")


def test_a_large_one_is_kept_within_a_loop():
    with keep_large_buffers():
        first = large()
        place = where(first)
        assert place % LINE == 0
        del first
        second, third = large(), large()
        assert place == where(second) != where(third)
        del second
        assert where(aligned(LARGE // 4, "float32")) == place
        assert kept() == 0


@pytest.mark.parametrize(
    ("part", "taken"), [(0.5 * (1 + 1 / FITTING), True), (0.9 / FITTING, False), (1.1, False)]
)
def test_a_smaller_one_takes_the_piece_of_a_larger_one_if_that_fits(part, taken):
    with keep_large_buffers():
        first = large(2 * LARGE)
        place, end = where(first), where(first) + first.nbytes
        del first
        second = large(round(2 * LARGE * part))
        assert (place <= where(second) < end) is taken
        second[:] = True


def test_the_smallest_piece_that_fits_is_taken():
    with keep_large_buffers():
        pieces = [large(size) for size in (LARGE + 2000, LARGE + 1000, LARGE + 3000)]
        places = [where(piece) for piece in pieces]
        pieces.clear()
        assert [where(large(LARGE + k)) for k in (900, 1900, 2900)] == [places[k] for k in (1, 0, 2)]


def test_a_loop_keeps_nothing_beyond_its_end(monkeypatch):
    ended = []
    monkeypatch.setattr(buffers._LoopPool, "end", lambda loop: ended.append(loop))

    def interrupted():
        with keep_large_buffers():
            large()
            raise KeyError

    with pytest.raises(KeyError):
        interrupted()
    assert buffers._loop.get() is None
    (loop,) = ended
    monkeypatch.undo()
    assert len(loop._left) == 1
    loop.end()
    assert loop._left is None
    array = loop.block(((LARGE,), "|b1"), LARGE)
    loop.keep(array)
    assert loop._left is None


def test_an_array_outlives_its_loop():
    with keep_large_buffers():
        array = zeros((2, LARGE), "bool")
        array[1] = True
        part = array[1]
        del array
    with keep_large_buffers():
        other = large(2 * LARGE)
        assert not np.shares_memory(other, part)
        other[:] = False
    assert part.all()


def test_each_loop_has_its_own():
    with keep_large_buffers():
        outer = large()
        place = where(outer)
        del outer
        with keep_large_buffers():
            assert where(large()) != place
        assert where(large()) == place
