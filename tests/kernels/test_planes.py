"""What machine code does to whole fields, against plain NumPy; and that it writes nowhere else."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from regions import PRECISIONS
from roughcontact.kernels import loader, planes
from roughcontact.kernels.constants import NEVER, WIDTH
from roughcontact.kernels.planes import (
    Extremes,
    add_scaled,
    extremes,
    fit,
    level_range,
    positive_part,
    positive_total,
    predict_active,
    scale_down,
)
from roughcontact.threads import limit_threads

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

EPS = np.finfo(np.float64).eps
MANY = 2 * WIDTH  # cells of a part, so that small fields have many
BEYOND = 37  # cells before and behind a field, an odd number
many = settings(max_examples=60, deadline=None, derandomize=True)


@st.composite
def shapes(draw):
    """Return a shape of one or two axes, and what makes random fields of it."""
    shape = draw(
        st.one_of(
            st.tuples(st.integers(1, 400)),
            st.tuples(st.integers(1, 20), st.integers(1, 40)),
            st.sampled_from(
                [(1,), (1, 1), (WIDTH,), (MANY,), (MANY + 1,), (8, MANY // 8), (3, 4 * MANY), (5, 1)]
            ),
        )
    )
    return shape, np.random.default_rng(draw(st.integers(0, 2**32 - 1)))


@pytest.fixture(autouse=True, params=[planes.CELLS, MANY], ids=["one part", "many parts"])
def part(request):
    """So many cells at a time, on two threads where they are in many parts."""
    before, planes.CELLS = planes.CELLS, request.param
    with limit_threads(2):
        yield
    planes.CELLS = before


def amid(field):
    """Return a copy that lies in a larger array, and what tells whether others in that are as they were."""
    whole = np.full(field.size + 2 * BEYOND, True if field.dtype == bool else 77, field.dtype)
    inner = whole[BEYOND : BEYOND + field.size].reshape(field.shape)
    inner[...] = field
    return inner, lambda: (whole[:BEYOND] == whole[0]).all() and (whole[-BEYOND:] == whole[0]).all()


def given_to(rng, shape, share=0.5, missing=0.2):
    """Return a pressure, on a share of the cells, a displacement and a separation; infinite where cells are missing."""
    there = rng.random(shape) >= missing
    pressure = np.abs(rng.standard_normal(shape)) * (rng.random(shape) < share) * there
    separation = np.where(there, np.abs(rng.standard_normal(shape)), math.inf)
    return pressure, rng.standard_normal(shape), separation


def read_only(*fields):
    for field in fields:
        field.flags.writeable = False


def close(found, terms):
    """Equal to the sum of terms up to the rounding of each sum on the way."""
    terms = np.asarray(terms, np.float64).ravel()
    assert found == pytest.approx(math.fsum(terms), rel=0, abs=terms.size * EPS * np.abs(terms).sum())


@many
@given(shapes(), st.sampled_from([0.0, 0.05, 0.5, 1.0]), st.sampled_from([0.0, 0.2, 1.0]))
def test_extremes(sized, share, missing):
    shape, rng = sized
    p, u, s = given_to(rng, shape, share, missing)
    if missing == 0.0:
        p -= 0.25  # some pull
    read_only(p, u, s)
    seen, level, carries = extremes(p, u, s), u + s, p > 0
    assert seen.highest == (level[carries].max() if carries.any() else -math.inf)
    assert seen.lowest == level.min()
    assert (seen.strongest, seen.weakest) == (p.max(), p.min())
    assert seen.displacement == np.abs(u).max()
    assert (seen.count, type(seen.count)) == (carries.sum(), int)
    close(seen.level, level[carries])


@many
@given(shapes(), st.data(), st.sampled_from([math.nan, math.inf, -math.inf]))
def test_what_is_no_number_is_never_overlooked(sized, data, wrong):
    """Wherever it is: in whole lanes, in what is left after them, in any part, or beside another."""
    shape, rng = sized
    fields = given_to(rng, shape, missing=0.0)
    at = data.draw(st.integers(0, fields[0].size - 1))
    for k in data.draw(st.sampled_from([[0], [1], [0, 1]])):
        fields[k].ravel()[at] = wrong
    assert extremes(*fields) is None
    for field in fields:
        field.ravel()[at] = 0.0
    assert isinstance(extremes(*fields), Extremes)


@many
@given(shapes(), st.sampled_from([0.0, 0.05, 0.5, 1.0]), st.sampled_from([math.inf, 0.75, 0.0]))
def test_predict_active(sized, share, own):
    shape, rng = sized
    p, u, s = given_to(rng, shape, share)
    read_only(p, u, s)
    depth, least = 0.5, -0.25
    region, count, wrong = predict_active(p, u, s, depth=depth, least=least, a_ii=own)
    gap = u + s - depth
    asked = (p > 0) | (gap < least)
    pulls = asked & (p * own < gap) if own < math.inf else np.zeros(shape, bool)
    assert region.dtype == bool
    assert set(region.view(np.uint8).ravel()) <= {0, 1}
    np.testing.assert_array_equal(region, asked & ~pulls)
    assert (count, wrong) == (region.sum(), pulls.sum())
    assert (type(count), type(wrong)) == (int, int)
    assert not region[np.isinf(s)].any()


def test_limits_of_a_prediction_are_not_in_it():
    """What stands at the least gap stays out; what moves as far as its gap stays in."""
    p, u, s = np.array([0.0, 0.0, 2.0, 2.0]), np.zeros(4), np.array([1.0, 0.875, 2.5, 2.75])
    region, count, wrong = predict_active(p, u, s, depth=1.5, least=-0.5, a_ii=0.5)
    assert region.tolist() == [False, True, True, False]
    assert (count, wrong) == (2, 1)


@many
@given(shapes(), st.sampled_from([0.02, 0.5, 1.0]))
def test_level_range(sized, share):
    shape, rng = sized
    _, u, s = given_to(rng, shape)
    region = (rng.random(shape) < share) & np.isfinite(s)
    region.ravel()[rng.integers(region.size)] = True
    s[region & np.isinf(s)] = 3.0
    read_only(u, s, region)
    found, level = level_range(s, u, region), (s + u)[region]
    assert (found.highest, found.lowest) == (level.max(), level.min())
    close(found.mean * level.size, level)


@many
@given(shapes(), st.sampled_from([0.0, 0.05, 1.0]), st.sampled_from([0.0, 0.2, 1.0]))
def test_the_positive_part(sized, share, missing):
    shape, rng = sized
    p, u, s = given_to(rng, shape, share, missing)
    p += np.where(np.isinf(s), 5.0, 0.0) + np.minimum(u, 0.0)  # some on missing cells, and some that pull
    read_only(p, s)
    wanted = np.where((p > 0) & np.isfinite(s), p, 0.0)
    close(positive_total(p, s), wanted)
    found = positive_part(p, s, 0.7)
    assert (found.dtype, found.shape) == (np.float64, shape)
    np.testing.assert_array_equal(found, wanted * 0.7)


def test_fields_that_fit_are_of_double_precision_and_one_shape_and_lie_row_by_row():
    field = np.zeros((4, 6))
    assert fit(field)
    assert fit(field, field.copy())
    for other in (field.astype(np.float32), field.astype(">f8"), field[:, ::2], field.T, field[:3], field[0]):
        assert not fit(field, other)
        assert not fit(other, field)
    assert not fit("field")


@many
@given(shapes(), st.sampled_from(PRECISIONS), st.sampled_from([0.0, 0.5, 1.0]))
def test_scale_down(sized, precision, share):
    shape, rng = sized
    p, u, s = given_to(rng, shape)
    region, depth, unit = rng.random(shape) < share, 0.375, 0.7
    read_only(p, u, s, region)
    (inside, lacking, base), kept = zip(
        *(amid(np.full(shape, np.nan, precision)) for _ in range(3)), strict=True
    )
    scale_down(p, u, s, region, (inside, lacking, base), depth=depth, unit=unit)
    np.testing.assert_array_equal(inside, region)
    there = np.isfinite(s)
    assert (lacking[~there] == np.array(NEVER, precision)).all()
    # A unit is turned over, and each number multiplied, both in double precision; then it is rounded.
    rounding = 3 * EPS + np.finfo(precision).eps
    level = (s + u)[there]
    np.testing.assert_allclose(
        lacking[there], (depth - level) / unit, rtol=rounding, atol=rounding * np.finfo(precision).tiny
    )
    np.testing.assert_allclose(base, p / unit, rtol=rounding, atol=0)
    assert all(one() for one in kept)


@many
@given(shapes(), st.sampled_from(PRECISIONS), st.sampled_from([0.0, 0.5, 1.0]))
def test_add_scaled(sized, precision, share):
    shape, rng = sized
    p, unit = np.abs(rng.standard_normal(shape)), 0.3
    change, kept = rng.standard_normal(shape).astype(precision) * 5, rng.random(shape) < share
    inside = kept.astype(precision)
    read_only(p, change, inside)
    found = add_scaled(p, change, inside, unit)
    assert (found.dtype, found.shape) == (np.float64, shape)
    wanted = p + change.astype(np.float64) * unit
    # A product and a sum are rounded.
    error = np.abs(found - np.where(kept & (wanted > 0), wanted, 0.0))
    assert (error <= 2 * EPS * (p + np.abs(change * unit))).all()
    assert (found[~kept] == 0).all()
    assert (found >= 0).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_what_comes_out_negative_is_nothing(precision):
    """Nothing at all, in lanes and by itself: not a negative number, and not what is no number."""
    p = np.full(WIDTH + 1, 2.0)
    change = np.where(np.arange(WIDTH + 1) % 3 == 0, -5.0, -4.0).astype(precision)
    change[[4, -1]] = np.nan
    assert not add_scaled(p, change, np.ones_like(change), 0.5).any()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_totals_do_not_hang_on_the_number_of_threads(precision):
    rng, shape, answers = np.random.default_rng(5), (61, 103), []
    p, u, s = given_to(rng, shape)
    region = np.isfinite(s) & (rng.random(shape) < 0.5)
    change, inside = rng.standard_normal(shape).astype(precision), region.astype(precision)
    for count in (1, 2, 3):
        written = [np.zeros(shape, precision) for _ in range(3)]
        with limit_threads(count):
            totals = [
                extremes(p, u, s),
                predict_active(p, u, s, depth=0.5, least=-0.25, a_ii=0.75)[1:],
                level_range(s, u, region),
            ]
            scale_down(p, u, s, region, tuple(written), depth=0.5, unit=0.3)
            written.append(add_scaled(p, change, inside, 0.3))
            written.append(predict_active(p, u, s, depth=0.5, least=-0.25, a_ii=0.75)[0])
        answers.append((totals, written))
    for totals, written in answers[1:]:
        assert totals == answers[0][0]
        for one, other in zip(answers[0][1], written, strict=True):
            np.testing.assert_array_equal(one, other)


def test_sums_of_many_cells_are_sums_of_parts():
    """A million tenths, each a little too large; one by one their sum would be off by more."""
    tenths, zeros = np.full(10**6, 0.1), np.zeros(10**6)
    seen = extremes(tenths, tenths, zeros)
    assert seen.count == 10**6
    assert seen.level == pytest.approx(math.fsum(tenths), rel=1e-12)
