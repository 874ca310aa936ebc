"""Convolutions in machine code against sums written out, and against SciPy's transforms."""

import numpy as np
import pytest
import scipy.fft
from hypothesis import given, settings, strategies as st

from roughcontact.kernels import buffers, loader
from roughcontact.kernels.compiled_convolution import LARGE, CompiledConvolution
from roughcontact.kernels.constants import HALF
from roughcontact.kernels.plane_plan import _plan, fits
from roughcontact.threads import limit_threads

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

PRECISIONS = ("float32", "float64")
SMOOTH = [n for n in range(2, 151) if all(n % p for p in range(7, n + 1) if all(p % k for k in range(2, p)))]
EVEN = [n for n in SMOOTH if n > 2 and n % 2 == 0]
HOWS = ("not at all", "a little", "by two", "by more")


def filled(length, how, spare):
    """Return how many numbers of a transform are none of its padding."""
    return {
        "not at all": length,
        "a little": max(1, length - spare),
        "by two": max(1, length // 2),
        "by more": max(1, length // 3),
    }[how]


@st.composite
def sizes(draw):
    """Return a shape of at most 40 rows and 50 columns, and lengths that are there for it."""
    axes = []
    for lengths, most in ((SMOOTH, 40), (EVEN, 50)):
        how, spare = draw(st.sampled_from(HOWS)), draw(st.integers(1, 4))
        length = draw(st.sampled_from([n for n in lengths if filled(n, how, spare) <= most]))
        axes.append((filled(length, how, spare), length))
    (ny, my), (nx, mx) = axes
    return (ny, nx), (my, mx)


def kernel(lengths, seed=0):
    """Return an even kernel on a whole plane, and its transform, by sums of cosines."""
    offsets = [np.minimum(np.arange(n), n - np.arange(n)) for n in lengths]
    table = np.random.default_rng(seed).standard_normal([n // 2 + 1 for n in lengths])
    whole = table[np.ix_(*offsets)]
    rows, columns = (
        np.cos(2 * np.pi * (np.outer(np.arange(n // 2 + 1), np.arange(n)) % n) / n) for n in lengths
    )
    return whole, rows @ whole @ columns.T


def written_out(field, whole):
    """Return the sum over all pairs of cells."""
    (ny, nx), (my, mx) = field.shape, whole.shape
    rows = (np.arange(ny)[:, None] - np.arange(ny)) % my
    columns = (np.arange(nx)[:, None] - np.arange(nx)) % mx
    return np.einsum("yvxw,vw->yx", whole[rows[:, :, None, None], columns], field)


def by_scipy(field, multiplier, lengths):
    (ny, nx), my = field.shape, lengths[0]
    rows = np.minimum(np.arange(my), my - np.arange(my))
    spectrum = scipy.fft.rfft2(np.asarray(field, np.float64), s=lengths) * multiplier[rows]
    return scipy.fft.irfft2(spectrum, s=lengths)[:ny, :nx]


def rounding(field, multiplier, lengths):
    """Return what rounding may do to a number of the answer.

    Each sweep of a transform rounds every number a few times, and there are at most log2(length) sweeps, there and
    back: so the error of all numbers together, in the 2-norm, is some eps log2(length) of the largest answer that such
    a field may have.
    """
    norm = np.linalg.norm(np.asarray(field, np.float64))
    sweeps = np.log2(lengths[0] * lengths[1]) + 1
    return 3 * np.finfo(field.dtype).eps * sweeps * np.abs(multiplier).max() * norm


def noise(shape, precision, seed=1):
    return np.random.default_rng(seed).standard_normal(shape).astype(precision)


def large(shape, lengths, precision, seed=0):
    """Return a convolution with a smooth positive multiplier, and that multiplier."""
    y, x = (np.arange(n // 2 + 1) for n in lengths)
    ripple = np.random.default_rng(seed).uniform(0.5, 1.5, (len(y), len(x)))
    multiplier = ripple / (1 + np.hypot(y[:, None], x))
    return CompiledConvolution.of(multiplier, shape, lengths, precision), multiplier


@settings(max_examples=150, deadline=None, derandomize=True)
@given(sizes(), st.sampled_from(PRECISIONS), st.integers(0, 99))
def test_the_same_as_the_sum_written_out(size, precision, seed):
    shape, lengths = size
    assert fits(lengths)
    whole, multiplier = kernel(lengths, seed)
    field = noise(shape, precision, seed + 1)
    found = CompiledConvolution.of(multiplier, shape, lengths, precision).apply(field)
    assert found.shape == shape
    assert found.dtype == precision
    wanted = written_out(field.astype(np.float64), whole)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding(field, multiplier, lengths))


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("length", [4, 6, 8, 10, 12, 18, 24, 50, 54, 60, 64, 90, 96, 100, 128, 150])
def test_each_length_along_rows_and_along_columns(length, precision):
    """Whole, and with the last half and the last three quarters empty."""
    for part in (1, 2, 4):
        cells = max(1, length // part)
        for shape, lengths in (((cells, 5), (length, 10)), ((5, cells), (10, length))):
            whole, multiplier = kernel(lengths)
            field = noise(shape, precision)
            found = CompiledConvolution.of(multiplier, shape, lengths, precision).apply(field)
            wanted = written_out(field.astype(np.float64), whole)
            np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding(field, multiplier, lengths))


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize(
    ("shape", "lengths"),
    [
        ((256, 256), (512, 512)),
        ((243, 250), (243, 250)),
        ((301, 203), (600, 432)),
        ((128, 384), (128, 768)),
        ((300, 75), (640, 150)),
        ((9, 1999), (16, 4000)),
    ],
)
def test_large_planes(shape, lengths, precision):
    convolution, multiplier = large(shape, lengths, precision)
    field = noise(shape, precision)
    wanted = by_scipy(field, multiplier, lengths)
    atol = rounding(field, multiplier, lengths)
    np.testing.assert_allclose(convolution.apply(field), wanted, rtol=0, atol=atol)
    assert atol < 0.1 * np.abs(wanted).max()


@settings(max_examples=40, deadline=None, derandomize=True)
@given(sizes(), st.integers(0, 99))
def test_linear_and_symmetric(size, seed):
    shape, lengths = size
    multiplier = kernel(lengths, seed)[1]
    convolution = CompiledConvolution.of(multiplier, shape, lengths, "float64")
    p, q = (noise(shape, "float64", seed + k) for k in (1, 2))
    close = 10 * rounding(np.abs(p) + np.abs(q), multiplier, lengths)
    both = convolution.apply(2 * p - 3 * q)
    apart = 2 * convolution.apply(p) - 3 * convolution.apply(q)
    np.testing.assert_allclose(both, apart, rtol=0, atol=close)
    there, back = np.vdot(convolution.apply(p), q), np.vdot(p, convolution.apply(q))
    assert there == pytest.approx(back, rel=0, abs=close * np.linalg.norm(p + q))


@pytest.mark.parametrize("precision", PRECISIONS)
def test_nothing_comes_round_where_there_is_room(precision):
    """A load in a corner, and a kernel that reaches no cell but its own and the next."""
    shape, lengths = (20, 23), (40, 48)
    table = np.zeros((21, 25))
    table[:2, :2] = [[1.0, 0.5], [0.25, 0.125]]
    multiplier = scipy.fft.dctn(table, type=1)
    for corner in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        field = np.zeros(shape, precision)
        field[corner] = 1.0
        found = CompiledConvolution.of(multiplier, shape, lengths, precision).apply(field)
        atol = rounding(field, multiplier, lengths)
        square = found[::-1] if corner[0] else found
        square = square[:, ::-1] if corner[1] else square
        np.testing.assert_allclose(square[:2, :2], table[:2, :2], rtol=0, atol=atol)
        assert np.abs(square[2:]).max() < atol
        assert np.abs(square[:, 2:]).max() < atol


@pytest.mark.parametrize(
    ("precision", "shape", "lengths"),
    [
        ("float32", (601, 1003), (1250, 2000)),
        ("float32", (600, 2000), (600, 2000)),
        ("float64", (301, 990), (640, 2000)),
        ("float64", (270, 2000), (270, 2000)),
    ],
)
def test_answers_do_not_hang_on_the_number_of_threads(precision, shape, lengths):
    assert shape[0] * lengths[1] * np.dtype(precision).itemsize >= LARGE
    convolution, multiplier = large(shape, lengths, precision)
    field = noise(shape, precision)
    answers = []
    for count in (1, 2, 3):
        with limit_threads(count):
            answers.append(convolution.apply(field))
    for other in answers[1:]:
        np.testing.assert_array_equal(other, answers[0])
    wanted = by_scipy(field, multiplier, lengths)
    np.testing.assert_allclose(answers[0], wanted, rtol=0, atol=rounding(field, multiplier, lengths))


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("lengths", [(20, 30), (24, 54), (40, 60), (48, 100)], ids=str)
def test_memory_is_kept_to(precision, lengths, monkeypatch):
    """All room is no numbers at first (bytes of all ones are none either), with as many before and behind."""

    def nothing(dtype):
        return 255 if np.dtype(dtype).kind == "u" else np.nan

    def untouched(numbers):
        return numbers == 255 if numbers.dtype.kind == "u" else np.isnan(numbers)

    shape = (19, 27)
    whole, multiplier = kernel(lengths)
    convolution, field = (
        CompiledConvolution.of(multiplier, shape, lengths, precision),
        noise(shape, precision),
    )
    rooms = []

    def surrounded(shape, dtype):
        size, margin = int(np.prod(shape)), 1024
        rooms.append((np.full(size + 2 * margin, nothing(dtype), dtype), margin))
        return rooms[-1][0][margin : margin + size].reshape(shape)

    monkeypatch.setattr(buffers, "_kept", [])
    monkeypatch.setattr(np, "empty", surrounded)
    found = convolution.apply(field)
    monkeypatch.undo()
    wanted = written_out(field.astype(np.float64), whole)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding(field, multiplier, lengths))
    assert len(rooms) == 2  # for the answer, and to work in
    for numbers, margin in rooms:
        assert untouched(numbers[:margin]).all()
        assert untouched(numbers[-margin:]).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_fields_that_lie_otherwise_in_memory(precision):
    shape, lengths = (19, 26), (40, 54)
    convolution = CompiledConvolution.of(kernel(lengths)[1], shape, lengths, precision)
    field = noise(shape, precision)
    wanted = convolution.apply(field)
    every_other = np.zeros((38, 52), precision)
    every_other[::2, 1::2] = field
    read_only = field.copy()
    read_only.flags.writeable = False
    for same in (np.asfortranarray(field), every_other[::2, 1::2], field[::-1].copy()[::-1], read_only):
        np.testing.assert_array_equal(convolution.apply(same), wanted)


@pytest.mark.parametrize("lengths", [(24, 30), (48, 60)])
@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_field_is_left_as_it_is(precision, lengths):
    shape = (24, 30)
    field = noise(shape, precision)
    before = field.copy()
    answer = CompiledConvolution.of(kernel(lengths)[1], shape, lengths, precision).apply(field)
    np.testing.assert_array_equal(field, before)
    assert not np.shares_memory(answer, field)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("lengths", [(12, 20), (15, 18), (27, 50)])
def test_it_gives_its_kernel_back(precision, lengths):
    """Divided by a number and multiplied by it again: two roundings."""
    multiplier = kernel(lengths)[1]
    found = CompiledConvolution.of(multiplier, (5, 7), lengths, precision).kernel()
    assert found.shape == multiplier.shape
    np.testing.assert_allclose(found, multiplier, rtol=2 * np.finfo(precision).eps)


@pytest.mark.parametrize("length", range(2, 70))
def test_lengths_that_fit(length):
    smooth = length in SMOOTH
    assert fits((length, 8)) == smooth
    assert fits((8, length)) == (smooth and length in EVEN)


@pytest.mark.parametrize("lengths", [(8, 9), (8, 14), (14, 8), (7, 8), (8, 22), (26, 8), (49, 50), (1, 8)])
def test_lengths_that_do_not_fit(lengths):
    assert not fits(lengths)


def test_empty_halves_are_left_out():
    """A transform whose last half is padding begins with the butterfly that knows it."""
    assert _plan(64, 32, "float64").radices[0] == HALF
    assert HALF not in _plan(64, 33, "float64").radices
    assert HALF not in _plan(50, 25, "float64").radices  # no whole quarters
