"""The small language: what tiny functions written in it do, against NumPy."""

from threading import Thread
from types import SimpleNamespace

import numpy as np
import pytest

from roughcontact.kernels import loader
from roughcontact.kernels.constants import APART, WIDTH

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@pytest.fixture(params=["float32", "float64"])
def precision(request):
    return request.param


@pytest.fixture
def lanes(precision):
    return WIDTH // np.dtype(precision).itemsize


def made(precision, **bodies):
    """Return functions whose bodies write themselves; each is preceded by the kinds of its parameters."""
    from roughcontact.kernels.code import Code

    def write(module, precision):
        for name, (kinds, body) in bodies.items():
            with Code(module, name, precision, kinds) as code:
                body(code, *code.arguments)

    kinds = {name: kinds for name, (kinds, _) in bodies.items()}
    module = SimpleNamespace(__name__="tiny", write=write)
    loaded = loader._loaded(loader._translated(module, precision), kinds, precision)

    def call(name):
        return lambda *given: loaded[name](
            *(loader.address(a) if isinstance(a, np.ndarray) else a for a in given)
        )

    return SimpleNamespace(**{name: call(name) for name in bodies})


def numbers(precision, size, seed=0):
    return np.random.default_rng(seed).standard_normal(size).astype(precision)


def test_numbers_one_at_a_time(precision):
    def body(code, a, b, answer):
        results = [
            a + b, a - b, a * b, -a, a.larger(b), b.larger(a), a + 2.0, a * 0.5 - 1.0,
            a.where_not(a.is_below(0.25)), a.where_not(b.is_below(0.25)),
            a.sign(), (a - a).sign(), b.sign(), code.one(7.0),
        ]  # fmt: skip
        for k, result in enumerate(results):
            answer.put(code.index(k), result)

    run = made(precision, tiny=("real real reals", body)).tiny
    for a, b in ((3.0, -1.5), (-0.75, 0.25), (0.25, 8.0)):
        found = np.full(14, np.nan, precision)
        run(a, b, found)
        cut = [a if a >= 0.25 else 0.0, a if b >= 0.25 else 0.0, float(a > 0), 0.0, float(b > 0), 7.0]
        wanted = [a + b, a - b, a * b, -a, max(a, b), max(a, b), a + 2, a / 2 - 1, *cut]
        np.testing.assert_array_equal(found, np.array(wanted, precision))  # all of them are exact


def test_numbers_in_lanes(precision, lanes):
    def body(code, a, b, factor, answer):
        first = code.index(0)
        x, y, f = a.take(first), b.take(first), code.for_all(factor)
        results = [
            x + y, x - y, x * y, -x, x.larger(y), x.sign(), x.where_not(y.is_below(0.0)), x * f,
            x + code.zero(), a.take_for_all(code.index(1)),
        ]  # fmt: skip
        for k, result in enumerate(results):
            answer.put(code.index(k * code.count), result)

    run = made(precision, tiny=("reals reals real reals", body)).tiny
    a, b = numbers(precision, (2, lanes))
    a[0], factor = 0.0, 0.75
    found = np.full((10, lanes), np.nan, precision)
    run(a, b, factor, found)
    kept = np.where(b < 0, 0, a)
    wanted = [a + b, a - b, a * b, -a, np.maximum(a, b), a > 0, kept, a * np.array(factor, precision)]
    np.testing.assert_array_equal(found, [*wanted, a, np.full(lanes, a[1])])


def test_a_product_and_a_sum_round_once_or_twice(precision, lanes):
    """They may be one instruction: between the two, the answer is off by no more than a rounding of the product."""

    def body(code, a, b, c):
        first = code.index(0)
        c.put(first, a.take(first) * b.take(first) + c.take(first))

    run = made(precision, tiny=("reals reals reals", body)).tiny
    a, b, c = numbers(precision, (3, lanes))
    exact = a.astype(np.longdouble) * b + c
    size = np.abs(a.astype(np.float64) * b) + np.abs(exact)
    run(a, b, c)
    assert (np.abs(c - exact) <= np.finfo(precision).eps * size).all()


def test_whole_numbers(precision):
    def body(code, a, b, answer):
        results = [
            a + b, a - b, a * b, a // b, a.smaller(b), b.smaller(a), a + 3, a // 4 * 4,
            code.choose(a <= b, 1, 2), code.choose(a.equals(b), a, code.index(-5)), code.choose(a.equals(5), 1, b),
        ]  # fmt: skip
        for k, result in enumerate(results):
            answer.put(code.index(k), result)

    run = made(precision, tiny=("index index indices", body)).tiny
    for a, b in ((17, 5), (5, 5), (2, 9), (2**40, 3)):
        found = np.zeros(11, np.int64)
        run(a, b, found)
        wanted = [a + b, a - b, a * b, a // b, min(a, b), min(a, b), a + 3, a // 4 * 4]
        wanted += [1 if a <= b else 2, a if a == b else -5, 1 if a == 5 else b]
        np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize(
    ("start", "stop", "step"),
    [(0, 5, 1), (3, 20, 4), (3, 19, 4), (0, 0, 1), (5, 5, 2), (7, 3, 1), (-4, 3, 3), (0, 1, 100)],
)
def test_a_range_is_that_of_python(start, stop, step):
    def body(code, start, stop, step, answer):
        count = code.variable(code.index(0))
        for at in code.range(start, stop, step):
            answer.put(count.get() + 1, at)
            count.set(count.get() + 1)
        answer.put(code.index(0), count.get())

    found = np.full(20, -99, np.int64)
    made("float64", tiny=("index index index indices", body)).tiny(start, stop, step, found)
    wanted = list(range(start, stop, step))
    assert found[: found[0] + 1].tolist() == [len(wanted), *wanted]
    assert (found[len(wanted) + 1 :] == -99).all()


def test_ranges_within_ranges_and_conditions(precision):
    """The sum of i j over all j < i < n where i + j is even, and how often the inner loop ran."""

    def body(code, n, answer, times):
        total, count = code.variable(code.one(0.0)), code.variable(code.index(0))
        for i in code.range(0, n):
            one = code.variable(code.one(0.0))
            for _ in code.range(0, i):
                one.set(one.get() + 1.0)
            for j in code.range(0, i):
                count.set(count.get() + 1)
                with code.when(((i + j) // 2 * 2).equals(i + j)):
                    for _ in code.range(0, j):
                        total.set(total.get() + one.get())
        answer.put(code.index(0), total.get())
        times.put(code.index(0), count.get())

    run = made(precision, tiny=("index reals indices", body)).tiny
    for n in (0, 1, 7):
        total, times = np.full(1, np.nan, precision), np.zeros(1, np.int64)
        run(n, total, times)
        assert total[0] == sum(i * j for i in range(n) for j in range(i) if (i + j) % 2 == 0)
        assert times[0] == n * (n - 1) // 2


def test_what_is_done_only_when(precision):
    def body(code, n, answer):
        with code.when(n.equals(3)):
            answer.put(code.index(0), code.one(1.0))
        with code.when(n <= 3), code.when(n.equals(2)):
            answer.put(code.index(1), code.one(1.0))

    run = made(precision, tiny=("index reals", body)).tiny
    for n, wanted in ((2, [0, 1]), (3, [1, 0]), (4, [0, 0])):
        found = np.zeros(2, precision)
        run(n, found)
        assert found.tolist() == wanted


def test_a_place_is_chosen(precision, lanes):
    def body(code, n, one, other):
        code.choose(n.equals(0), one, other).at(code.index(1)).put(code.index(0), code.zero())

    run = made(precision, tiny=("index reals reals", body)).tiny
    for n in (0, 1):
        fields = np.ones((2, lanes + 2), precision)
        run(n, *fields)
        assert fields[n].tolist() == [1, *[0] * lanes, 1]
        assert fields[1 - n].tolist() == [1] * (lanes + 2)


def test_variables_keep_what_they_are_made(precision, lanes):
    def body(code, n, a, answer):
        sums, largest = code.variable(code.zero()), code.variable(a.take_one(code.index(0)))
        for at in code.range(0, n, code.count):
            sums.set(sums.get() + a.take(at))
        for at in code.range(0, n):
            largest.set(largest.get().larger(a.take_one(at)))
        answer.put(code.index(0), sums.get())
        answer.put(code.index(code.count), largest.get())

    a = numbers(precision, (9, lanes))
    found = np.full(lanes + 2, np.nan, precision)
    made(precision, tiny=("index reals reals", body)).tiny(a.size, a, found)
    total = np.zeros(lanes, precision)
    for row in a:
        total += row
    np.testing.assert_array_equal(found[:lanes], total)
    assert found[lanes] == a.max()
    assert np.isnan(found[lanes + 1])


def test_transpose(precision, lanes):
    def body(code, a, at, down, answer, to, across):
        code.transpose(a, at, down, answer, to, across)

    run = made(precision, tiny=("reals index index reals index index", body)).tiny
    a = numbers(precision, (lanes + 3, lanes + 5))
    found = np.full((lanes + 2, lanes + 1), 7.0, precision)
    run(a, 2 * a.shape[1] + 4, a.shape[1], found, found.shape[1] + 1, found.shape[1])
    wanted = np.full_like(found, 7.0)
    wanted[1 : lanes + 1, 1:] = a[2 : lanes + 2, 4 : lanes + 4].T
    np.testing.assert_array_equal(found, wanted)
    square = numbers(precision, (lanes, lanes), 1)
    turned = square.T.copy()
    run(square, 0, lanes, square, 0, lanes)  # all is read before any is written
    np.testing.assert_array_equal(square, turned)


def test_what_all_lanes_make_together(precision, lanes):
    def body(code, a, answer):
        x = a.take(code.index(0))
        answer.put(code.index(0), code.across(x, lambda one, other: one + other))
        answer.put(code.index(1), code.across(x, lambda one, other: one.larger(other)))

    run = made(precision, tiny=("reals reals", body)).tiny
    for k in range(lanes):
        a = np.roll(np.arange(lanes, dtype=precision) - lanes, k)
        found = np.full(2, np.nan, precision)
        run(a, found)
        assert found.tolist() == [a.sum(), -1.0]


def test_any_that_is_not_zero(precision, lanes):
    def body(code, a, answer):
        found = code.any_not_zero(a.take(code.index(0)))
        answer.put(code.index(0), code.choose(found, 1, 0))

    run = made(precision, tiny=("reals indices", body)).tiny

    def said(a):
        found = np.full(1, -1, np.int64)
        run(np.asarray(a, precision), found)
        return found[0]

    assert said(np.zeros(lanes)) == 0
    assert said(-np.zeros(lanes)) == 0
    for k in range(lanes):
        for value in (1.0, -1e-30, np.nan):
            assert said(np.where(np.arange(lanes) == k, value, 0.0)) == 1


def test_in_double_precision(precision, lanes):
    """One is added to what single precision would lose beside it."""

    def body(code, a, answer):
        first, after = code.index(0), code.index(code.count)
        x, y = a.take(first).in_double() + 1.0, a.take_one(after).in_double() + 1.0
        assert x.in_double() is x
        assert y.in_double() is y
        answer.put(first, code.across(x, lambda one, other: one + other))
        answer.put(code.index(1), y)

    a = (numbers(precision, lanes + 1) * 1e-9).astype(precision)
    found = np.full(2, np.nan)
    made(precision, tiny=("reals doubles", body)).tiny(a, found)
    assert found[0] - lanes == pytest.approx(a[:lanes].astype(np.float64).sum(), abs=1e-14)
    assert found[1] == 1 + np.float64(a[lanes])


def test_functions_call_each_other(precision, lanes):
    from roughcontact.kernels.code import Code

    def write(module, precision):
        with Code(module, "twice", precision, "index reals real indices") as twice:
            n, a, by, calls = twice.arguments
            for at in twice.range(0, n):
                a.put(at, a.take_one(at) * by)
            calls.put(twice.index(0), calls[twice.index(0)] + 1)
        with Code(module, "outer", precision, "index reals real indices") as code:
            n, a, by, calls = code.arguments
            code.call(twice, n, a, by, calls)
            code.call(twice, n - 1, a.at(code.index(1)), by, calls)

    kinds = {"outer": "index reals real indices"}
    object_file = loader._translated(SimpleNamespace(__name__="tiny", write=write), precision)
    a, calls = np.ones(3, precision), np.zeros(1, np.int64)
    loader._loaded(object_file, kinds, precision)["outer"](3, loader.address(a), 2.0, loader.address(calls))
    assert a.tolist() == [2.0, 4.0, 4.0]
    assert calls[0] == 2


def test_numbers_need_not_begin_anywhere_in_particular(precision, lanes):
    """NumPy's arrays begin at any number, and so do the lanes that are taken of them."""

    def body(code, a, answer):
        answer.put(code.index(0), a.take(code.index(0)))

    run = made(precision, tiny=("reals reals", body)).tiny
    room, answer = numbers(precision, 3 * lanes), np.zeros(3 * lanes, precision)
    for start in range(2 * lanes):
        part = answer[start : start + lanes]
        run(room[start : start + lanes], part)
        np.testing.assert_array_equal(part, room[start : start + lanes])


@pytest.mark.parametrize("readable", ["written", "read only", "empty", "not contiguous"])
def test_where_an_array_begins(readable):
    array = np.arange(12.0).reshape(3, 4)
    if readable == "read only":
        array.flags.writeable = False
    part = {"empty": array[:0], "not contiguous": array[1:, 1::2]}.get(readable, array[1:])
    assert loader.address(part) == part.__array_interface__["data"][0]


@pytest.mark.parametrize("workers", [1, 2, 4])
def test_parts_are_shared_between_threads_and_phases_wait_for_each_other(precision, workers):
    """Each number is written once in the first phase; the second reads what others wrote, the other way round."""
    parts = 1000

    def body(code, counters, taken, first, second):
        for part in code.shared(counters, 0, code.index(parts)):
            taken.put(part, taken[part] + 1)
            first.put(part, part + 1)
        for part in code.shared(counters, 1, code.index(parts)):
            second.put(part, first[code.index(parts - 1) - part])

    run = made(precision, tiny=("indices indices indices indices", body)).tiny
    for _ in range(20):
        counters, (taken, first, second) = np.zeros(4 * APART, np.int64), np.zeros((3, parts), np.int64)
        team = [Thread(target=run, args=(counters, taken, first, second)) for _ in range(workers)]
        for one in team:
            one.start()
        for one in team:
            one.join()
        np.testing.assert_array_equal(taken, 1)
        np.testing.assert_array_equal(second, np.arange(parts, 0, -1))
        run(counters, taken, first, second)  # who comes late finds nothing left
        np.testing.assert_array_equal(taken, 1)


@pytest.mark.parametrize("size", [0, 1, 3, 4, 7, 8, 9, 23])
def test_conditions_in_lanes_and_one_by_one(precision, size):
    """Whichever takes them, each number is written once, from numbers of both precisions and truth values."""

    def body(code, n, a, wide, given, limit, least, answers, rounded, flags):
        for at, take in code.each(n):
            x, y, flag = take(a, at), take(wide, at), take(given, at)
            more = y.is_more_than(take.alike(limit))
            both, either = code.both(more, flag), code.either(more, flag)
            results = [
                x.where(flag, -7.0),
                x.where(code.opposite(flag)),
                x.replaced(2.5),
                x.larger(take.alike(least)),
            ]
            for k, result in enumerate(results):
                answers.put(at + n * k, result)
            for k, result in enumerate([more, both, either, y.is_below(0.0)]):
                flags.put(at + n * k, result)
            rounded.put(at, y.rounded_to(x.value.type.element if take.lanes else x.value.type))

    kinds = "index reals doubles flags double real reals reals flags"
    run = made(precision, tiny=(kinds, body)).tiny
    a, wide = numbers(precision, size), numbers("float64", size, 1)
    given = numbers("float64", size, 2) > 0
    wide[1:2], limit, least = 0.1, 0.1, 0.25
    answers, flags = np.full((5, size), np.nan, precision), np.full((5, size), 9, np.uint8)
    rounded = np.full(size + 1, np.nan, precision)
    seen = np.where(given, np.uint8(255), np.uint8(0))  # whatever is not zero is true
    run(size, a, wide, seen, limit, least, answers, rounded, flags)
    more = wide > limit
    wanted = [np.where(given, a, -7), np.where(given, 0, a), np.full(size, 2.5), np.maximum(a, least)]
    np.testing.assert_array_equal(answers, [*wanted, np.full(size, np.nan)])
    np.testing.assert_array_equal(rounded, [*wide.astype(precision), np.nan])
    np.testing.assert_array_equal(flags, [more, more & given, more | given, wide < 0, np.full(size, 9)])
