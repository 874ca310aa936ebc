"""The kernel language: what tiny kernels written in it do, against NumPy."""

from threading import Thread

import numpy as np
import pytest

pytest.importorskip("llvmlite")

from roughcontact.kernels import loader
from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import WIDTH
from roughcontact.kernels.signature import Double, Doubles, Flags, Indices, Scalar, Vector, kernel
from roughcontact.kernels.values import Index, maximum, where

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@pytest.fixture(params=["float32", "float64"])
def precision(request):
    return request.param


@pytest.fixture
def lanes(precision):
    return WIDTH // np.dtype(precision).itemsize


def made(precision, body):
    """Return a kernel in machine code."""
    kernels = {body.__name__: kernel(body)}
    return loader._loaded(loader._translated(kernels, precision), kernels, precision)[body.__name__]


def numbers(precision, size, seed=0):
    return np.random.default_rng(seed).standard_normal(size).astype(precision)


def test_numbers_one_at_a_time(precision):
    def tiny(code: Code, a: Scalar, b: Scalar, answer: Vector):
        results = [
            a + b, a - b, a * b, -a, maximum(a, b), maximum(b, a), a + 2.0, a * 0.5 - 1.0,
            where(a < 0.25, a.filled(0.0), a), where(~(b < 0.25), a, 0.0),
            a.heaviside(), (a - a).heaviside(), b.heaviside(), code.number(7.0), abs(a),
        ]  # fmt: skip
        for k, result in enumerate(results):
            answer[code.index(k)] = result

    run = made(precision, tiny)
    for a, b in ((3.0, -1.5), (-0.75, 0.25), (0.25, 8.0)):
        found = np.full(15, np.nan, precision)
        run(a, b, found)
        cut = [a if a >= 0.25 else 0.0, a if b >= 0.25 else 0.0, float(a > 0), 0.0, float(b > 0), 7.0, abs(a)]
        wanted = [a + b, a - b, a * b, -a, max(a, b), max(a, b), a + 2, a / 2 - 1, *cut]
        np.testing.assert_array_equal(found, np.array(wanted, precision))  # all of them are exact


def test_numbers_in_lanes(precision, lanes):
    """A single number beside lanes is broadcast."""

    def tiny(code: Code, a: Vector, b: Vector, factor: Scalar, answer: Vector):
        first = code.index(0).lanes
        x, y = a[first], b[first]
        results = [
            x + y, x - y, x * y, -x, maximum(x, y), x.heaviside(), where(~(y < 0.0), x, 0.0), x * factor,
            factor + x, x + code.lanes(0.0), code.lanes(a[code.index(1)]), factor, 3.0,
        ]  # fmt: skip
        for k, result in enumerate(results):
            answer[first + k * code.count] = result

    run = made(precision, tiny)
    a, b = numbers(precision, (2, lanes))
    a[0], factor = 0.0, 0.75
    found = np.full((13, lanes), np.nan, precision)
    run(a, b, factor, found)
    kept, scaled = np.where(b < 0, 0, a), a * np.array(factor, precision)
    wanted = [
        a + b,
        a - b,
        a * b,
        -a,
        np.maximum(a, b),
        a > 0,
        kept,
        scaled,
        np.array(factor, precision) + a,
        a,
    ]
    np.testing.assert_array_equal(found, [*wanted, *(np.full(lanes, k) for k in (a[1], factor, 3.0))])


def test_a_product_and_a_sum_round_once_or_twice(precision, lanes):
    """They may be one instruction: between the two, the answer is off by no more than a rounding of the product."""

    def tiny(code: Code, a: Vector, b: Vector, c: Vector):
        i = code.index(0).lanes
        c[i] = a[i] * b[i] + c[i]

    a, b, c = numbers(precision, (3, lanes))
    exact = a.astype(np.longdouble) * b + c
    size = np.abs(a.astype(np.float64) * b) + np.abs(exact)
    made(precision, tiny)(a, b, c)
    assert (np.abs(c - exact) <= np.finfo(precision).eps * size).all()


def test_indices(precision):
    def tiny(code: Code, a: Index, b: Index, answer: Indices):
        results = [
            a + b, a - b, a * b, a // b, a % b, a.min(b), b.min(a), a + 3, a // 4 * 4, abs(b - a), -a,
            where(a <= b, code.index(1), 2), where(a.equals(b), a, -5), where(a.equals(5), code.index(1), b),
            where(a < b, a, b),
        ]  # fmt: skip
        for k, result in enumerate(results):
            answer[code.index(k)] = result

    run = made(precision, tiny)
    for a, b in ((17, 5), (5, 5), (2, 9), (2**40, 3)):
        found = np.zeros(15, np.int64)
        run(a, b, found)
        wanted = [a + b, a - b, a * b, a // b, a % b, min(a, b), min(a, b), a + 3, a // 4 * 4, abs(b - a), -a]
        wanted += [1 if a <= b else 2, a if a == b else -5, 1 if a == 5 else b, min(a, b)]
        np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize(
    ("start", "stop", "step"),
    [(0, 5, 1), (3, 20, 4), (3, 19, 4), (0, 0, 1), (5, 5, 2), (7, 3, 1), (-4, 3, 3), (0, 1, 100)],
)
def test_a_range_is_that_of_python(start, stop, step):
    def tiny(code: Code, start: Index, stop: Index, step: Index, answer: Indices):
        count = code.variable(code.index(0))
        for at in code.range(start, stop, step):
            answer[count.get() + 1] = at
            count.set(count.get() + 1)
        answer[code.index(0)] = count.get()

    found = np.full(20, -99, np.int64)
    made("float64", tiny)(start, stop, step, found)
    wanted = list(range(start, stop, step))
    assert found[: found[0] + 1].tolist() == [len(wanted), *wanted]
    assert (found[len(wanted) + 1 :] == -99).all()


def test_ranges_within_ranges_and_conditions(precision):
    """The sum of i j over all j < i < n where i + j is even, and how often the inner loop ran."""

    def tiny(code: Code, n: Index, answer: Vector, times: Indices):
        total, count = code.variable(code.number(0.0)), code.variable(code.index(0))
        for i in code.range(0, n):
            one = code.variable(code.number(0.0))
            for _ in code.range(0, i):
                one.set(one.get() + 1.0)
            for j in code.range(0, i):
                count.set(count.get() + 1)
                with code.when(((i + j) // 2 * 2).equals(i + j)):
                    for _ in code.range(0, j):
                        total.set(total.get() + one.get())
        answer[code.index(0)] = total.get()
        times[code.index(0)] = count.get()

    run = made(precision, tiny)
    for n in (0, 1, 7):
        total, times = np.full(1, np.nan, precision), np.zeros(1, np.int64)
        run(n, total, times)
        assert total[0] == sum(i * j for i in range(n) for j in range(i) if (i + j) % 2 == 0)
        assert times[0] == n * (n - 1) // 2


def test_what_is_done_only_when(precision):
    def tiny(code: Code, n: Index, answer: Vector):
        with code.when(n.equals(3)):
            answer[code.index(0)] = 1.0
        with code.when(n <= 3), code.when(n.equals(2)):
            answer[code.index(1)] = 1.0

    run = made(precision, tiny)
    for n, wanted in ((2, [0, 1]), (3, [1, 0]), (4, [0, 0])):
        found = np.zeros(2, precision)
        run(n, found)
        assert found.tolist() == wanted


def test_memory_is_chosen(precision, lanes):
    def tiny(code: Code, n: Index, one: Vector, other: Vector):
        (where(n.equals(0), one, other) + code.index(1))[code.index(0).lanes] = 0.0

    run = made(precision, tiny)
    for n in (0, 1):
        fields = np.ones((2, lanes + 2), precision)
        run(n, *fields)
        assert fields[n].tolist() == [1, *[0] * lanes, 1]
        assert fields[1 - n].tolist() == [1] * (lanes + 2)


def test_variables_keep_what_they_are_made(precision, lanes):
    def tiny(code: Code, n: Index, a: Vector, answer: Vector):
        sums, largest = code.variable(code.lanes(0.0)), code.variable(a[code.index(0)])
        for at in code.range(0, n, code.count):
            sums.set(sums.get() + a[at.lanes])
        for at in code.range(0, n):
            largest.set(maximum(largest.get(), a[at]))
        answer[code.index(0).lanes] = sums.get()
        answer[code.index(code.count)] = largest.get()

    a = numbers(precision, (9, lanes))
    found = np.full(lanes + 2, np.nan, precision)
    made(precision, tiny)(a.size, a, found)
    total = np.zeros(lanes, precision)
    for row in a:
        total += row
    np.testing.assert_array_equal(found[:lanes], total)
    assert found[lanes] == a.max()
    assert np.isnan(found[lanes + 1])


def test_transpose(precision, lanes):
    def tiny(code: Code, a: Vector, at: Index, down: Index, answer: Vector, to: Index, across: Index):
        code.transpose(a, at, down, answer, to, across)

    run = made(precision, tiny)
    a = numbers(precision, (lanes + 3, lanes + 5))
    found = np.full((lanes + 2, lanes + 1), 7.0, precision)
    run(a, 2 * a.shape[1] + 4, a.shape[1], found, found.shape[1] + 1, found.shape[1])
    wanted = np.full_like(found, 7.0)
    wanted[1 : lanes + 1, 1:] = a[2 : lanes + 2, 4 : lanes + 4].T
    np.testing.assert_array_equal(found, wanted)
    square = numbers(precision, (lanes, lanes), 1)
    transposed = square.T.copy()
    run(square, 0, lanes, square, 0, lanes)  # all is read before any is written
    np.testing.assert_array_equal(square, transposed)


def test_what_all_lanes_make_together(precision, lanes):
    def tiny(code: Code, a: Vector, answer: Vector):
        x = a[code.index(0).lanes]
        answer[code.index(0)] = code.across(x, lambda one, other: one + other)
        answer[code.index(1)] = code.across(x, maximum)

    run = made(precision, tiny)
    for k in range(lanes):
        a = np.roll(np.arange(lanes, dtype=precision) - lanes, k)
        found = np.full(2, np.nan, precision)
        run(a, found)
        assert found.tolist() == [a.sum(), -1.0]


def test_any_that_is_not_zero(precision, lanes):
    def tiny(code: Code, a: Vector, answer: Indices):
        first = code.index(0)
        for k, at in enumerate((first, first.lanes)):
            answer[code.index(k)] = where(code.any(a[at].is_nonzero()), code.index(1), 0)

    run = made(precision, tiny)

    def said(a):
        found = np.full(2, -1, np.int64)
        run(np.asarray(a, precision), found)
        return found.tolist()

    assert said(np.zeros(lanes)) == said(-np.zeros(lanes)) == [0, 0]
    for k in range(lanes):
        for value in (1.0, -1e-30, np.nan):
            assert said(np.where(np.arange(lanes) == k, value, 0.0)) == [k == 0, 1]


def test_in_double_precision(precision, lanes):
    """One is added to what single precision would lose beside it; numbers are rounded where they are written."""

    def tiny(code: Code, a: Vector, answer: Doubles, rounded: Vector):
        first, after = code.index(0), code.index(code.count)
        x, y = a[first.lanes].double() + 1.0, a[after].double() + 1.0
        assert x.double() is x
        assert y.double() is y
        answer[first] = code.across(x, lambda one, other: one + other)
        answer[code.index(1)] = y
        rounded[first.lanes], rounded[after] = x, y

    a = (numbers(precision, lanes + 1) * 1e-9).astype(precision)
    found, rounded = np.full(2, np.nan), np.full(lanes + 1, np.nan, precision)
    made(precision, tiny)(a, found, rounded)
    assert found[0] - lanes == pytest.approx(a[:lanes].astype(np.float64).sum(), abs=1e-14)
    assert found[1] == 1 + np.float64(a[lanes])
    np.testing.assert_array_equal(rounded, (1 + a.astype(np.float64)).astype(precision))


def test_two_precisions_do_not_meet_unseen():
    def tiny(code: Code, a: Scalar, b: Double, answer: Doubles):
        answer[code.index(0)] = a + b

    with pytest.raises(TypeError, match="float meets double in a kernel: convert one"):
        made("float32", tiny)


def test_kernels_call_each_other(precision):
    @kernel
    def _twice(code: Code, n: Index, a: Vector, by: Scalar, calls: Indices):
        for i in code.range(0, n):
            a[i] = a[i] * by
        calls[code.index(0)] = calls[code.index(0)] + 1

    def outer(code: Code, n: Index, a: Vector, by: Scalar, calls: Indices):
        code.call(_twice, n, a, by, calls)
        code.call(_twice, n - 1, a + code.index(1), by, calls)

    a, calls = np.ones(3, precision), np.zeros(1, np.int64)
    made(precision, outer)(3, a, 2.0, calls)
    assert a.tolist() == [2.0, 4.0, 4.0]
    assert calls[0] == 2


def test_numbers_need_not_begin_anywhere_in_particular(precision, lanes):
    """NumPy's arrays begin at any number, and so do the lanes that are taken of them."""

    def tiny(code: Code, a: Vector, answer: Vector):
        answer[code.index(0).lanes] = a[code.index(0).lanes]

    run = made(precision, tiny)
    given, answer = numbers(precision, 3 * lanes), np.zeros(3 * lanes, precision)
    for start in range(2 * lanes):
        part = answer[start : start + lanes]
        run(given[start : start + lanes], part)
        np.testing.assert_array_equal(part, given[start : start + lanes])


@pytest.mark.parametrize("workers", [1, 2, 4])
def test_parts_are_shared_between_threads_and_phases_wait_for_each_other(precision, workers):
    """Each number is written once in the first phase; the second reads what others wrote, the other way round."""
    parts = 1000

    def tiny(code: Code, taken: Indices, first: Indices, second: Indices, by: Indices):
        for part in code.shared(0, code.index(parts)):
            taken[part] = taken[part] + 1
            first[part] = part + 1
            by[part] = code.thread
        for part in code.shared(1, code.index(parts)):
            second[part] = first[code.index(parts - 1) - part]

    run = made(precision, tiny)
    for _ in range(200):
        taken, first, second, by = np.zeros((4, parts), np.int64)
        run(taken, first, second, by, workers=workers)
        np.testing.assert_array_equal(taken, 1)
        np.testing.assert_array_equal(second, np.arange(parts, 0, -1))
        assert 0 <= by.min() <= by.max() < workers


def test_threads_that_lead_at_once_each_do_their_own(precision):
    """One is served, the others do all alone, and nobody's work is mixed with another's."""
    parts, rounds, threads = 500, 200, 4

    def tiny(code: Code, number: Index, taken: Indices):
        for part in code.shared(0, code.index(parts)):
            taken[part] = taken[part] + number

    run, wrong = made(precision, tiny), []

    def lead(number):
        for _ in range(rounds):
            taken = np.zeros(parts, np.int64)
            run(number, taken, workers=3)
            wrong.extend(taken[taken != number].tolist())

    team = [Thread(target=lead, args=(k + 1,)) for k in range(threads)]
    for one in team:
        one.start()
    for one in team:
        one.join()
    assert wrong == []


@pytest.mark.parametrize("size", [0, 1, 3, 4, 7, 8, 9, 23])
def test_conditions_in_lanes_and_one_by_one(precision, size):
    """Whichever takes them, each number is written once, from numbers of both precisions and truth values."""

    def tiny(
        code: Code, n: Index, a: Vector, wide: Doubles, given: Flags, limit: Double, least: Scalar,
        answers: Vector, rounded: Vector, flags: Flags,
    ):  # fmt: skip
        for i in code.each(n):
            x, y, flag = a[i], wide[i], given[i]
            above = y > limit
            results = [
                where(flag, x, -7.0),
                where(~flag, x, 0.0),
                x.filled(2.5),
                maximum(code.number(0.0) + least, x),
            ]
            for k, result in enumerate(results):
                answers[i + n * k] = result
            for k, result in enumerate([above, above & flag, above | flag, y < 0.0]):
                flags[i + n * k] = result
            rounded[i] = y

    run = made(precision, tiny)
    a, wide = numbers(precision, size), numbers("float64", size, 1)
    given = numbers("float64", size, 2) > 0
    wide[1:2], limit, least = 0.1, 0.1, 0.25
    answers, flags = np.full((5, size), np.nan, precision), np.full((5, size), 9, np.uint8)
    rounded = np.full(size + 1, np.nan, precision)
    seen = np.where(given, np.uint8(255), np.uint8(0)).view(bool)  # whatever is not zero is true
    run(size, a, wide, seen, limit, least, answers, rounded, flags.view(bool))
    above = wide > limit
    wanted = [np.where(given, a, -7), np.where(given, 0, a), np.full(size, 2.5), np.maximum(a, least)]
    np.testing.assert_array_equal(answers, [*wanted, np.full(size, np.nan)])
    np.testing.assert_array_equal(rounded, [*wide.astype(precision), np.nan])
    np.testing.assert_array_equal(flags, [above, above & given, above | given, wide < 0, np.full(size, 9)])
