"""Machine code on fields in slabs: what it finds is that of one process, on any number of them."""

from types import SimpleNamespace

import numpy as np
import pytest

import roughcontact as rc
from regions import PRECISIONS, eighths
from roughcontact.halfspace.sums import local_inverse
from roughcontact.halfspace.sums.local_inverse import LocalInverse
from roughcontact.kernels import active_cells, loader, planes
from roughcontact.kernels.active_cells import ActiveCells, mask_above, with_margins
from roughcontact.kernels.constants import REACH
from roughcontact.slabs import levels_of_slabs
from roughcontact.slabs.passes import passes_over
from roughcontact.solver import inner_operator, vectors
from roughcontact.solver.inner_operator import FullGrid
from roughcontact.solver.rows_operator import RowsInverse, on_own_rows
from slabs.test_slabs import SIZES, in_slabs, rough
from slabs.together import together

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

# On four processes some have less than REACH rows, or none.
SHAPES = [(16, 24), (15, 9), (6, 2), (3, 8), (2, 5)]


def on_region(inside, answer):
    """What is found on a region: what is left elsewhere means nothing."""
    whole = answer if isinstance(answer, np.ndarray) else answer.gathered()
    return np.where(inside > 0, whole, 0.0)


def dealt(communicator, *wholes):
    slabs = rc.Slabs(communicator)
    return [slabs.array(whole[slabs.rows(len(whole))]) for whole in wholes]


def rows_of(inverse, field):
    """Return a truncated inverse on the rows of this process, None where blocks do not fit."""
    inner = SimpleNamespace(local_inverse=inverse)
    return on_own_rows(inner, field).local_inverse


@pytest.fixture(autouse=True, params=[None, 3], ids=["one part", "many parts"])
def part(request, monkeypatch):
    """So few cells at a time that slabs come in different numbers of parts."""
    if request.param:
        monkeypatch.setattr(active_cells, "PART", request.param)
        monkeypatch.setattr(planes, "CELLS", 32)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_planes(size, shape):
    """Eighths, of which sums are exact in any order; some pressures are zero."""
    rng = np.random.default_rng(3)
    p, u, f = (eighths(rng, shape, np.float64) for _ in range(3))
    p = np.maximum(p, 0.0)
    region = p > 0
    region[-1, -1] = True
    extremes, levels = planes.extremes(p, u, f), planes.level_range(f, u, region)
    total, part = planes.positive_total(p, f), planes.positive_part(p, f, 0.25)
    allowed = {"depth": 0.25, "least": -0.125, "a_ii": 0.5}
    cells, *counts = planes.predict_active(p, u, f, **allowed)

    def scaled(zeros, *fields):
        into = tuple(zeros() for _ in range(3))
        planes.scale_down(*fields, into, depth=0.5, unit=2.0)
        return *into, planes.add_scaled(fields[0], into[1], into[0], 0.25)

    whole = scaled(lambda: np.zeros(shape), p, u, f, region)

    def work(communicator):
        there = dealt(communicator, p, u, f, region)
        xp, (first, *_, last) = there[0].functions, there
        passes = passes_over(first)
        assert passes.fit(*there[:3])
        assert passes.extremes(*there[:3]) == extremes
        assert passes.positive_total(first, there[2]) == total
        np.testing.assert_array_equal(passes.positive_part(first, there[2], 0.25).gathered(), part)
        found, *how_many = passes.predict_active(*there[:3], **allowed)
        np.testing.assert_array_equal(found.gathered(), cells)
        assert how_many == counts
        here = [field.local for field in there]
        assert planes.level_range(here[2], here[1], last.local, xp.combined) == levels
        for mine, its in zip(scaled(lambda: np.zeros(last.local.shape), *here), whole, strict=True):
            np.testing.assert_array_equal(first.like(mine).gathered(), its)
        broken = xp.where(first == xp.max(first), np.nan, first)
        assert passes.extremes(broken, *there[1:3]) is None

    together(size, work)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("precision", PRECISIONS)
def test_totals_on_a_region(size, shape, precision):
    """Sums of eighths, a largest one, and the largest cell outside a mask, wherever it lies.

    Which groups of cells there are depends on the dealing, and with them what is summed beside the region: nothing.
    """
    rng = np.random.default_rng(5)
    inside = (rng.random(shape) < 0.4).astype(precision)
    t, v, r = (eighths(rng, shape, precision) for _ in range(3))
    t *= inside
    sums = ActiveCells(inside).run("dot_products", 6, t, v, inside, r)
    most = ActiveCells(inside, (t, v)).run("max_violation", 1, t, v, inside, largest=True)
    mask = inside.copy()
    worst = mask_above(mask, r, 0.125)

    def work(communicator):
        there = dealt(communicator, inside, t, v, r)
        (cells, t_, v_, r_), combine = (field.local for field in there), there[0].functions.combined
        assert ActiveCells(cells, combine=combine).run("dot_products", 6, t_, v_, cells, r_) == sums
        pressed = ActiveCells(cells, (t_, v_), combine)
        assert pressed.run("max_violation", 1, t_, v_, cells, largest=True) == most
        assert mask_above(cells, r_, 0.125, combine) == worst
        np.testing.assert_array_equal(there[0].gathered(), mask)

    together(size, work)


@pytest.mark.parametrize("size", [*SIZES, 7])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("precision", PRECISIONS)
def test_stencil(size, shape, precision):
    """To the last bit: the rows of the neighbours are there, once more after they have changed."""
    rng = np.random.default_rng(1)
    inside = (rng.random(shape) < 0.7).astype(precision)
    fields = [rng.standard_normal(shape).astype(precision) for _ in range(2)]
    weights = rng.standard_normal((REACH + 1, REACH + 1)).astype(precision)
    one, inverse = ActiveCells(inside), LocalInverse(weights, None)
    wanted = [on_region(inside, inverse.on(one, with_margins(field))) for field in fields]

    def work(communicator):
        cells, *there = dealt(communicator, inside, *fields)
        region, field = ActiveCells(cells.local), with_margins(there[0].local)
        rows = RowsInverse(inverse, cells.edges, cells.functions)
        for values, sums in zip(there, wanted, strict=True):
            field[...] = values.local
            found = on_region(inside, cells.like(rows.on(region, field)))
            np.testing.assert_array_equal(found, sums)

    together(size, work)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("filled", [0.02, 0.7], ids=["group by group", "all of the plane"])
def test_inverse_with_blocks(size, filled, monkeypatch):
    """Sums over blocks of eighths are exact. What a transform of a hundred blocks rounds is let go of."""
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", 1)
    shape = (48, 24)
    inverse = LocalInverse.of(2.0, shape, (1.0, 1.5))
    rng = np.random.default_rng(1)
    inside = (rng.random(shape) < filled).astype(float)
    field = eighths(rng, shape, np.float64) * inside
    wanted = on_region(inside, inverse.on(ActiveCells(inside), with_margins(field)))

    def work(communicator):
        cells, there = dealt(communicator, inside, field)
        found = rows_of(inverse, there).on(ActiveCells(cells.local), with_margins(there.local))
        return on_region(inside, there.like(found))

    for found in together(size, work):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-13 * np.abs(wanted).max())


def test_where_blocks_do_not_fit(monkeypatch):
    """Rows of a block on two processes, and more blocks than there are; without blocks nothing can misfit."""
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", 300)

    def work(communicator):
        for shape, fits in [((15, 24), False), ((44, 24), False), ((10, 4), True), ((16, 24), True)]:
            [field] = dealt(communicator, np.zeros(shape))
            rows = rows_of(LocalInverse.of(2.0, shape, (1.0, 1.0)), field)
            assert (rows is not None) == fits

    together(2, work)


def test_all_agree_on_machine_code():
    """Rows that lie in another order on one process only."""

    def work(communicator):
        [field] = dealt(communicator, np.ones((8, 6)))
        other = field.like(field.local if communicator.rank else np.asfortranarray(field.local))
        passes = passes_over(field)
        assert passes.fit(field, field, field)
        assert not passes.fit(field, other, field)
        mixed = field.like(field.local.astype("f4" if communicator.rank else "f2"))
        inner = FullGrid(rc.half_space(rc.Grid((8, 6), 1.0, periodic=True), 1.0))
        assert passes_over(mixed) is None
        assert on_own_rows(inner, mixed) is inner

    together(2, work)


@pytest.mark.parametrize(
    ("size", "shape", "large", "fits"),
    [
        (1, (128, 128), 2**19, True),
        (2, (128, 128), 2**12, True),  # with blocks
        (3, (96, 64), 2**12, True),
        (4, (256, 64), 2**19, True),
        (2, (104, 64), 2**12, False),  # of which 26 rows are no length of a fast transform
        (4, (3, 80), 2**19, True),  # on a process without rows
    ],
    ids=str,
)
@pytest.mark.parametrize("load", [{"pressure": 1e6}, {"depth": 1.5e-7}], ids=str)
def test_press(size, shape, large, fits, load, monkeypatch):
    """All in machine code, by as many products as one process takes that has no tiles and factorises nothing.

    One of twenty more or less: rounding decides them. Pressures as in `test_slabs.test_press`.
    """
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", large)
    monkeypatch.setattr(levels_of_slabs, "SMALL", 2**10)
    monkeypatch.setattr(inner_operator, "_tiles_of", lambda *_: None)
    monkeypatch.setattr(vectors, "ArrayVectors", None)
    surface = rough(shape)
    asked = {**load, "tolerance": 1e-12, "solver": rc.ActiveSet(dense_limit=0)}
    with monkeypatch.context() as patch:
        if not fits:
            patch.setattr(FullGrid, "local_inverse", None)
        here = rc.press(surface, 1e9, **asked)

    def work(communicator):
        there = rc.press(in_slabs(surface, communicator), 1e9, **asked)
        return there.pressure.gathered(), there.steps, there.stiffness

    for pressure, steps, stiffness in together(size, work):
        np.testing.assert_allclose(pressure, here.pressure, rtol=0, atol=1e-10 * here.pressure.max())
        assert steps == pytest.approx(here.steps, rel=0.05, abs=1)
        assert stiffness == pytest.approx(here.stiffness, rel=1e-6)
