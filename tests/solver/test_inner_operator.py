"""Solves that inexact operators drive: the same certified answers, and none the worse where these are wrong."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.sums import particle_mesh as patches
from roughcontact.halfspace.sums.particle_mesh import ListParticleMesh, ParticleMesh, TileOperator
from roughcontact.kernels import loader
from roughcontact.solver import inner_operator as drivers, tuning
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.conjugate_gradients import conjugate_gradients
from roughcontact.solver.inner_operator import FullGrid, InnerOperator, first_product, inner_operator_on
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.vectors import vectors_on

ITERATIVE = ActiveSet(dense_limit=0)
needs_machine_code = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


class Plain:
    """An operator that says nothing of what could stand in for it."""

    def __init__(self, operator):
        self._operator = operator

    def __getattr__(self, name):
        return getattr(self._operator, name)

    @property
    def capabilities(self):
        given = self._operator.capabilities
        return replace(
            given,
            single_precision=False,
            coarsened=lambda grid: plain(given.coarsened(grid)),
            particle_mesh=rc.Capabilities().particle_mesh,
        )

    def restrict(self, window):
        return plain(self._operator.restrict(window))


def plain(operator):
    return None if operator is None else Plain(operator)


@pytest.fixture(params=["free", "free, any shape", "periodic"])
def rough(request):
    shape = (230, 187) if request.param == "free, any shape" else (160, 160)
    grid = rc.Grid(shape, (1e-3, 1e-3), request.param == "periodic")
    return rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(5))


TILES = pytest.param(TileOperator, marks=needs_machine_code)


@pytest.fixture(params=[TILES, FullGrid])
def used(request, monkeypatch):
    """Let one kind of driver stand in wherever it can, and count its products."""
    kind = request.param
    for part in ("cover", "filled"):
        monkeypatch.setattr(ParticleMesh, part, 2.0 if kind is TileOperator else 0.0)
    monkeypatch.setattr(patches, "LEAST_PLANE", 0)
    if kind is FullGrid:
        monkeypatch.setattr(ListParticleMesh, "tiles", lambda *_: None)
        monkeypatch.setattr(tuning, "LIST_FILLING", 0.0)  # planes, not lists
    counts = [0]
    apply = kind.apply

    def counted(self, pressure):
        counts[0] += kind is TileOperator or self.single
        return apply(self, pressure)

    monkeypatch.setattr(kind, "apply", counted)
    return counts


def pressed(surface, operator, part=0.3):
    force = part * 1e9 * surface.rms * surface.grid.lengths[0]
    return rc.press(surface, 1e9, force=force, operator=operator, solver=ITERATIVE, tolerance=1e-10)


def test_the_answer_is_that_of_the_exact_operator(rough, used):
    operator = rc.half_space(rough.grid, 1e9)
    expected = pressed(rough, plain(operator))
    assert not used[0]
    found = pressed(rough, operator)
    assert used[0] > 5
    assert found.residual <= 1e-10
    # Both gaps are closed to 1e-10 of the largest displacement: the depths, set by them, agree as well.
    scale = float(np.abs(expected.displacement).max())
    assert found.depth == pytest.approx(expected.depth, abs=2e-10 * scale)
    np.testing.assert_array_equal(found.contact, expected.contact)


def test_the_stiffness_is_that_of_the_exact_operator(rough, used):
    mask = pressed(rough, None).contact
    operator = rc.half_space(rough.grid, 1e9)
    left = np.arange(rough.grid.shape[1]) < 40  # a part of the tiles, and more cells than are factorised
    region = mask | (left & (rough.heights > np.quantile(rough.heights[:, left], 0.4)))
    expected = rc.contact_stiffness(region, rough.grid, 1e9, operator=plain(operator))
    before = used[0]
    found = rc.contact_stiffness(region, rough.grid, 1e9, operator=operator)
    if not all(rough.grid.periodic):  # a window of a period has no tiles
        assert used[0] > before
    # Each unit displacement is met to 1e-7.
    assert found == pytest.approx(expected, rel=2e-7)


@pytest.mark.parametrize(("modulus", "spacing"), [(1e11, 1e-10), (1e-12, 1e3), (1e28, 1e-3), (1e-28, 1e3)])
def test_units_are_no_matter(used, modulus, spacing):
    """Single precision ends at 1e38: where it would not do, the operator itself drives."""
    grid = rc.Grid((128, 128), spacing)
    rough = rc.self_affine(grid, hurst=0.8, rms=spacing, rng=np.random.default_rng(5))
    force = 40 * modulus * spacing**2
    found = rc.press(rough, modulus, force=force, solver=ITERATIVE)
    assert found.status.converged
    assert (used[0] > 5) == (1e-25 < spacing / modulus < 1e25)
    one = rc.Surface(rough.heights / spacing, rc.Grid((128, 128), 1.0))
    assert found.depth / spacing == pytest.approx(rc.press(one, 1.0, force=40.0).depth, rel=1e-7)


@dataclass(frozen=True)
class Wrong:
    """A driver that is none of the body's."""

    true: InnerOperator
    factor: float

    def __getattr__(self, name):
        return getattr(self.true, name)

    def apply(self, pressure):
        return self.factor * self.true.apply(pressure)


@pytest.mark.parametrize("factor", [-1.0, 0.05, 20.0, np.nan])
def test_wrong_drivers_cost_time_and_no_more(monkeypatch, used, factor):
    grid = rc.Grid((128, 128), (1e-3, 1e-3))
    rough = rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(5))
    operator = rc.half_space(grid, 1e9)
    expected = pressed(rough, plain(operator))

    def lying(operator, region, previous=None):
        driver = inner_operator_on(
            operator, region, previous.true if isinstance(previous, Wrong) else previous
        )
        return driver if type(driver) is FullGrid else Wrong(driver, factor)

    monkeypatch.setattr("roughcontact.solver.active_set.inner_operator_on", lying)
    monkeypatch.setattr("roughcontact.solver.prescribed.inner_operator_on", lying)
    found = pressed(rough, operator)
    assert found.residual <= 1e-10
    assert found.depth == pytest.approx(expected.depth, rel=1e-8)
    region = rough.heights > np.quantile(rough.heights, 0.85)
    assert rc.contact_stiffness(region, grid, 1e9, operator=operator) == pytest.approx(
        rc.contact_stiffness(region, grid, 1e9, operator=plain(operator)), rel=2e-7
    )


@needs_machine_code
def test_who_drives():
    def single(operator, region):
        inner = inner_operator_on(operator, region)
        assert isinstance(inner, FullGrid)
        return inner.single

    tiny = rc.half_space(rc.Grid((32, 32), 1.0), 1.0)
    assert not single(tiny, np.eye(32, dtype=bool))
    small = rc.half_space(rc.Grid((64, 64), 1.0), 1.0)
    assert single(small, np.eye(64, dtype=bool))
    assert not single(plain(small), np.eye(64, dtype=bool))
    large = rc.half_space(rc.Grid((512, 512), 1.0), 1.0)
    assert single(large, np.ones((512, 512), dtype=bool))
    few = np.zeros((512, 512), dtype=bool)
    few[40:60, 100:130] = True
    tiles = inner_operator_on(large, few)
    assert type(tiles) is TileOperator
    assert inner_operator_on(large, few, tiles) is tiles
    assert inner_operator_on(large, few[::-1], tiles) is not tiles


@needs_machine_code
def test_one_driver_takes_off_what_it_says(rough):
    """`gain`: a change of pressure that one makes leaves this of an error, and what its products get wrong."""
    operator = rc.half_space(rough.grid, 1e9)
    region = rough.heights > np.quantile(rough.heights, 0.8)
    patch = operator.particle_mesh.on(drivers.Tiles.of(region))
    for driver in (FullGrid(operator, single=True), patch):
        lacking = np.where(region, rough.heights, 0.0)
        unit = float(np.abs(lacking).max())
        part = driver.scaled(driver.gather(lacking / unit))
        measure, kept = Measure(driver.weights), driver.gather(region)
        fields = vectors_on(driver, measure, kept, part, np.zeros_like(part))
        conjugate_gradients(driver, fields, limit=driver.contraction, max_steps=200)
        change = unit * driver.scatter(fields.correction).astype(float)
        left = np.where(region, lacking - operator.apply(change), 0.0)
        # As far as it was solved, and what the product gets wrong of pressures of both signs (test_patches.py).
        wrong = 1.5e-4 * operator.apply(np.abs(change)).max()
        assert np.abs(left).max() <= driver.contraction * unit + wrong


def test_only_a_truncated_inverse_is_corrected_for_its_edges():
    plane, ring = (
        rc.half_space(rc.Grid((8, 6), 1.0), 2.0),
        rc.ring(rc.RadialGrid.uniform(8, 1.0), 2.0),
    )
    assert FullGrid(plane).diagonal_correction > 0
    assert FullGrid(ring).local_inverse is None
    assert FullGrid(ring).diagonal_correction == 0


@pytest.mark.parametrize(
    ("make", "exact"), [(lambda body: body, False), (Plain, True)], ids=["single", "plain"]
)
def test_the_first_product_is_in_single_precision_where_the_operator_allows_it(make, exact):
    """Many cells, which no tiles replace: the difference is that of single precision."""
    body = make(rc.half_space(rc.Grid((70, 70), 1.0), 2.0))
    pressure = np.random.default_rng(3).random((70, 70))
    found, is_exact = first_product(body, pressure)
    assert is_exact == exact
    expected = body.apply(pressure)
    off = np.abs(found - expected).max() / np.abs(expected).max()
    assert (off == 0) == exact
    assert off < 1e-6
