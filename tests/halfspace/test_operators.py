"""The contract of every operator."""

import functools
import gc
from dataclasses import replace
from weakref import ref

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.halfspace.influence.tables import Periodic
from roughcontact.halfspace.operators import build
from roughcontact.halfspace.operators.build import singly_periodic
from roughcontact.halfspace.operators.layer import layer
from roughcontact.halfspace.operators.line_contact import LineOperator
from roughcontact.halfspace.operators.operator import Operator, capabilities, is_semidefinite, self_influence
from roughcontact.halfspace.sums.multilevel import Multilevel

SHAPES = [(1, 1), (1, 6), (7, 5), (8, 8), (13, 2), (33, 20), (6, 75)]  # the last: several slabs of columns
PLANES = [
    (shape, periodic, method) for shape in SHAPES for periodic in (False, True) for method in ("fft", "dense")
]
EDGES = np.r_[0.2, 0.2 + np.cumsum(np.linspace(0.1, 0.6, 40))]  # widths that differ by six
RUBBER = rc.Solid(1.5, 0.5)  # bonded and periodic, a constant pressure moves nothing
OTHERS = {
    "disc": lambda: rc.ring(rc.RadialGrid.uniform(1, 0.7), 2.0),
    "rings": lambda: rc.ring(rc.RadialGrid.uniform(33, 3.0), 2.0),
    "rings of any width about a hole": lambda: rc.ring(rc.RadialGrid(EDGES), 2.0),
    "a cell of a line": lambda: rc.line(rc.Grid(1, 0.5), 2.0),
    "line": lambda: rc.line(rc.Grid(75, 0.5), 2.0),
    "line in a large body": lambda: rc.line(rc.Grid(75, 0.5), 2.0, reference_length=1e3),
    "periodic line": lambda: rc.line(rc.Grid(76, 0.5, True), 2.0),
    **{
        f"periodic along one axis {shape}, {along}": lambda shape=shape, along=along: singly_periodic(
            rc.Grid(shape, (0.3, 0.5), [axis == along for axis in (0, 1)]), 2.0
        )
        for shape in ((1, 1), (1, 6), (7, 5), (33, 20))
        for along in (0, 1)
    },
    **{
        f"{'periodic' if periodic else 'free'} layer {shape}, base {base}": (
            lambda shape=shape, periodic=periodic, base=base: layer(
                rc.Grid(shape, (0.3, 0.5), periodic), RUBBER, 0.8, base=base
            )
        )
        for shape, periodic in (((33, 20), False), ((7, 5), True), ((8, 6), True))
        for base in ("rigid-frictionless", "bonded", rc.Solid(3.0, 0.1), rc.Solid(0.1, 0.4))
    },
    **{
        f"moving grid {shape}": lambda shape=shape: rc.half_space(
            rc.Grid(shape, (0.3, 0.5)), 2.0, method="moving-grid"
        )
        for shape in SHAPES
    },
    "moving grid along a line": lambda: rc.line(rc.Grid(75, 0.5), 2.0, method="moving-grid"),
    "multilevel, too small for levels": lambda: rc.half_space(
        rc.Grid((13, 20), 0.5), 2.0, method="multilevel"
    ),
    # Where all pairs are near, all are corrected, and the sum is exact.
    "multilevel": lambda: replace(
        rc.half_space(rc.Grid((33, 20), (0.3, 0.5)), 2.0), summation=Multilevel(near=80)
    ),
    "multilevel along a line": lambda: LineOperator(
        replace(rc.line(rc.Grid(601, 0.5), 2.0).plane, summation=Multilevel(near=600))
    ),
    "foundation": lambda: rc.foundation(rc.Grid(20, 0.5), 2.0),
    "foundation of a periodic line": lambda: rc.foundation(rc.Grid(20, 0.5, True), 2.0),
}


@functools.cache
def made(which):
    if which in OTHERS:
        return OTHERS[which]()
    shape, periodic, method = which
    return rc.half_space(rc.Grid(shape, (0.3, 0.5), periodic), 2.0, method=method)


@pytest.fixture(params=PLANES, ids=str)
def plane(request):
    return made(request.param)


@pytest.fixture(params=[*PLANES, *OTHERS], ids=str)
def operator(request):
    return made(request.param)


def fields(operator, count=2, seed=0):
    return np.random.default_rng(seed).standard_normal((count, *operator.grid.shape))


def close(a, b, scale=1.0):
    """Equal up to the rounding of a transform: some ten units in the last place of the largest value."""
    np.testing.assert_allclose(a, b, rtol=0, atol=1e-14 * scale)


def test_it_is_an_operator(operator):
    assert isinstance(operator, Operator)
    np.testing.assert_allclose(np.sum(operator.weights * np.ones(operator.grid.shape)), operator.grid.area)


def test_linear(operator):
    p, q = fields(operator)
    close(operator.apply(2 * p - 3 * q), 2 * operator.apply(p) - 3 * operator.apply(q), 10)


def test_symmetric(operator):
    p, q = fields(operator)
    there, back = (
        np.vdot(operator.weights * operator.apply(p), q),
        np.vdot(operator.weights * p, operator.apply(q)),
    )
    assert there == pytest.approx(back, abs=1e-13 * p.size)


def test_definite(operator):
    """Free: positive definite. Periodic: semidefinite, and only a constant pressure moves nothing."""
    root = np.sqrt(operator.weights * np.ones(operator.grid.size))
    values = np.linalg.eigvalsh(root[:, None] * operator.as_matrix() / root)
    if is_semidefinite(operator):
        assert abs(values[0]) < 1e-14
        assert operator.grid.size == 1 or values[1] > 0.01
        close(operator.apply(np.ones(operator.grid.shape)), 0.0)
    else:
        assert values[0] > 0.01


def test_equal_to_its_matrix(operator):
    p = fields(operator)[0]
    close(operator.apply(p).ravel(), operator.as_matrix() @ p.ravel(), 3)
    cells = np.flatnonzero(np.random.default_rng(1).random(p.size) < 0.4)
    np.testing.assert_array_equal(operator.as_matrix(cells), operator.as_matrix()[np.ix_(cells, cells)])


def test_positive_where_it_says_so(operator):
    if capabilities(operator).positive:
        assert operator.as_matrix().min() >= 0


def test_equal_to_the_plain_product(plane):
    p = fields(plane)[0]
    close(plane.apply(p), oracles.displacement(plane.grid, 2.0, p), 3)


def test_equal_to_its_restriction(operator):
    p = fields(operator)[0]
    window = tuple(slice(n // 3, n) for n in operator.grid.shape)
    inside = np.zeros_like(p)
    inside[window] = p[window]
    close(operator.restrict(window).apply(p[window]), operator.apply(inside)[window], 3)


def test_the_whole_is_not_a_part(operator):
    """A restriction to all cells keeps what the boundary condition says."""
    whole = operator.restrict(tuple(slice(0, n) for n in operator.grid.shape))
    p = fields(operator)[0]
    assert whole.grid.shape == operator.grid.shape
    assert whole.grid.periodic == operator.grid.periodic
    np.testing.assert_array_equal(whole.apply(p), operator.apply(p))


def test_loads_in_corners_meet(operator):
    """The wrap-around that a missing padding would make."""
    p = np.zeros(operator.grid.shape)
    p.flat[0] = 1.0
    assert operator.apply(p).flat[-1] == pytest.approx(operator.as_matrix()[-1, 0], abs=3e-15)


@pytest.mark.parametrize("method", ["fft", "dense"])
@pytest.mark.parametrize("periodic", [False, True])
def test_scale_laws(method, periodic):
    """Cells larger by a factor move by that factor; a stiffer body moves less."""
    p = np.random.default_rng(0).standard_normal((12, 9))
    base = rc.half_space(rc.Grid((12, 9), (0.3, 0.5), periodic), 2.0, method=method).apply(p)
    large = rc.half_space(rc.Grid((12, 9), (3e-7, 5e-7), periodic), 2.0, method=method).apply(p)
    stiff = rc.half_space(rc.Grid((12, 9), (0.3, 0.5), periodic), 2e11, method=method).apply(p)
    np.testing.assert_allclose(large, base * 1e-6, rtol=0, atol=1e-20)
    np.testing.assert_allclose(stiff, base * 1e-11, rtol=0, atol=1e-25)


def test_far_field_is_a_point_load():
    """u = F / (pi E* r), to the order (h/r)^2 of the cell's extent."""
    operator = rc.half_space(rc.Grid((1, 400), (1.0, 1.0)), 2.0)
    p = np.zeros((1, 400))
    p[0, 0] = 3.0
    r = 399.0
    assert operator.apply(p)[0, -1] == pytest.approx(3.0 / (np.pi * 2.0 * r), rel=1 / (12 * r**2))


def test_periodic_waves_answer_with_two_over_q():
    grid = rc.Grid((16, 24), (0.5, 0.25), True)
    y, x = np.mgrid[:16, :24] * np.array([0.5, 0.25])[:, None, None]
    qy, qx = 2 * np.pi * 2 / 8.0, 2 * np.pi * 3 / 6.0
    wave = np.cos(qy * y + qx * x)
    close(rc.half_space(grid, 5.0).apply(wave), wave * 2 / (5.0 * np.hypot(qy, qx)))


@pytest.mark.parametrize(
    ("grid", "more", "message"),
    [
        (rc.Grid(8, 1.0), {}, "two axes"),
        (rc.Grid((8, 8), 1.0), {"method": "magic"}, "method must be"),
        (rc.Grid((8, 8), 1.0), {"modulus": 0.0}, "modulus must be positive"),
    ],
)
def test_nonsense_is_refused(grid, more, message):
    with pytest.raises(ValueError, match=message):
        rc.half_space(grid, **({"modulus": 1.0} | more))


def test_an_operator_of_another_modulus_is_refused():
    surface = rc.shapes.paraboloid(rc.Grid((8, 8), 1e-6), radius=1e-4)
    body = rc.half_space(surface.grid, 2e9)
    assert rc.press(surface, 2e9, force=1e-4, operator=body).status.converged
    with pytest.raises(ValueError, match=r"a reduced modulus of 2e\+09 Pa, and 1e\+09 Pa is asked for"):
        rc.press(surface, 1e9, force=1e-4, operator=body)


class Asked:
    """A body that counts how often it is asked for its matrix."""

    def __init__(self, own=2.0):
        self.own, self.times = own, 0

    def as_matrix(self, cells=None):
        self.times += 1
        assert cells.tolist() == [0]
        return np.full((1, 1), self.own)


class Unhashable(Asked):
    __hash__ = None

    def __eq__(self, other):
        raise AssertionError("never compared")


class WithoutReferences:
    __slots__ = ("asked",)

    def __init__(self):
        self.asked = Asked()

    def as_matrix(self, cells=None):
        return self.asked.as_matrix(cells)


def test_what_a_cell_does_to_itself(operator):
    own = operator.as_matrix(np.zeros(1, np.intp))
    for _ in range(2):
        found = self_influence(operator)
        assert type(found) is float
        assert found == own[0, 0]
    close(found, operator.as_matrix()[0, 0])


def test_it_is_asked_once():
    """Of each: others are asked by themselves, even when one has gone and another lies where it was."""
    one, two = Asked(), Asked(3.0)
    assert [self_influence(body) for body in (one, two, one, two)] == [2.0, 3.0, 2.0, 3.0]
    assert (one.times, two.times) == (1, 1)
    for own in (4.0, 5.0, 6.0):
        assert self_influence(Asked(own)) == own


@pytest.mark.parametrize("kind", [Unhashable, WithoutReferences])
def test_it_is_told_by_what_cannot_be_remembered(kind):
    body = kind()
    assert [self_influence(body) for _ in range(2)] == [2.0, 2.0]
    assert getattr(body, "asked", body).times == 2


def test_what_was_asked_is_not_kept_alive():
    body = Asked()
    self_influence(body)
    gone = ref(body)
    del body
    gc.collect()
    assert gone() is None


def test_what_has_no_matrix_is_asked_again():
    """What went wrong is heard of, and not remembered."""
    body = Asked()
    body.as_matrix = lambda cells: {}["no matrix"]
    with pytest.raises(KeyError, match="no matrix"):
        self_influence(body)
    del body.as_matrix
    assert self_influence(body) == 2.0


@pytest.mark.parametrize("periodic", [False, True, (True, False)], ids=str)
def test_a_small_half_space_is_made_once(periodic):
    """A load on a small surface takes no longer than its operator; what it finds does not depend on earlier loads."""
    grid = rc.Grid((24, 30), 0.5, periodic)
    body = rc.half_space(grid, 2.0)
    assert rc.half_space(rc.Grid((24, 30), 0.5, periodic), 2.0) is body
    assert rc.half_space(grid, 2.5) is not body
    assert rc.half_space(rc.Grid((24, 30), 0.25, periodic), 2.0) is not body
    assert rc.half_space(grid, 2.0, method="dense") is not body
    large = rc.Grid((64, 65), 0.5)
    assert rc.half_space(large, 2.0) is not rc.half_space(large, 2.0)  # its tables are not held

    surface = rc.Surface(0.1 * np.random.default_rng(0).random(grid.shape), grid)
    loads: list[dict] = [{"depth": 0.01}, {"depth": 0.04}, {"force": 0.5}]
    fresh = []
    for load in loads:
        build._small_body.cache_clear()
        fresh.append(rc.press(surface, 2.0, **load))
    for first, load in reversed([*zip(fresh, loads, strict=True)]):  # in another order, by one operator
        again = rc.press(surface, 2.0, **load)
        np.testing.assert_array_equal(again.pressure, first.pressure)
        assert (again.depth, again.residual, again.steps) == (first.depth, first.residual, first.steps)


def test_the_table_of_a_small_half_space_is_made_once(monkeypatch):
    made = []
    table = Periodic.table
    monkeypatch.setattr(Periodic, "table", lambda self, shape: made.append(shape) or table(self, shape))
    grid = rc.Grid((64, 64), 0.5, True)
    build._small_body.cache_clear()
    for seed in range(3):
        rc.press(rc.Surface(np.random.default_rng(seed).random(grid.shape), grid), 2.0, force=0.5)
    assert made == [(64, 64)]
