"""The height that blocks of cells have: slopes do not count, summits do, and what is missing is left out."""

from typing import ClassVar

import numpy as np
import pytest

import roughcontact as rc
from libraries import Strict
from roughcontact.arrays import namespace
from roughcontact.kernels import loader
from roughcontact.solver import nested_iteration, tuning
from roughcontact.solver.control import Depth, Force, State, Status
from roughcontact.solver.nested_iteration import (
    block_minimum,
    block_separation,
    coarse_operator,
    nested_start,
)
from roughcontact.threads import limit_threads

SHAPES = [(8, 6), (7, 6), (8, 5), (9, 7), (1, 8), (2, 2)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("factors", [(2, 2), (1, 2), (2, 1)])
def test_lowest(shape, factors):
    field = np.random.default_rng(0).random(shape)
    found = block_minimum(field, factors)
    assert found.shape == tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    for (i, j), value in np.ndenumerate(found):
        block = field[i * factors[0] : (i + 1) * factors[0], j * factors[1] : (j + 1) * factors[1]]
        assert value == block.min()


@pytest.mark.parametrize("shape", SHAPES)
def test_a_block_lies_between_its_mean_and_its_lowest_separation(shape):
    field = np.random.default_rng(1).random(shape)
    found, low = block_separation(field, (2, 2)), block_minimum(field, (2, 2))
    assert (found >= low).all()
    whole = field[: shape[0] // 2 * 2, : shape[1] // 2 * 2]
    mean = whole.reshape(shape[0] // 2, 2, shape[1] // 2, 2).mean(axis=(1, 3))
    assert (found[: shape[0] // 2, : shape[1] // 2] <= mean * (1 + 1e-15)).all()


def test_a_plane_has_its_mean():
    y, x = np.indices((8, 6)).astype(float)
    field = 3.0 + 2.0 * y - 0.5 * x
    np.testing.assert_allclose(
        block_separation(field, (2, 2)), field.reshape(4, 2, 3, 2).mean(axis=(1, 3)), rtol=1e-15
    )


@pytest.mark.parametrize("rows", [1, 2, 7, 20, 21, 45])
def test_rows_are_worked_on_in_slabs(rows, monkeypatch):
    """Of 20 here: none of them, some, whole ones, and an odd row at last; machine code needs none."""
    field = np.random.default_rng(5).random((rows, 10))
    field[rows // 2, 3] = np.inf
    monkeypatch.setattr(nested_iteration, "passes_over", lambda field: None)
    whole = block_separation(field, (2, 2))
    monkeypatch.setattr(tuning, "SLAB", 20)
    np.testing.assert_array_equal(block_separation(field, (2, 2)), whole)


@pytest.mark.skipif(not loader.is_available(), reason="no machine code here")
@pytest.mark.parametrize("shape", [(2, 2), (6, 10), (260, 130), (512, 512)])
@pytest.mark.parametrize("missing", [0.0, 0.2, 1.0])
def test_machine_code_raises_blocks_as_arrays_do(shape, missing, monkeypatch):
    """Up to rounding: it takes a product and a sum at once."""
    rng = np.random.default_rng(6)
    field = rng.standard_normal(shape)
    field[rng.random(shape) < missing] = np.inf
    with limit_threads(2):
        found = block_separation(field, (2, 2))
    monkeypatch.setattr(nested_iteration, "passes_over", lambda field: None)
    wanted = block_separation(field, (2, 2))
    np.testing.assert_array_equal(np.isinf(found), np.isinf(wanted))
    there = np.isfinite(wanted)
    size = np.abs(field).reshape(shape[0] // 2, 2, shape[1] // 2, 2).sum(axis=(1, 3))
    # The sum and what stands out of it: no number is larger than three times the sum of the sizes.
    assert (np.abs(found[there] - wanted[there]) <= 6 * np.finfo(float).eps * size[there]).all()


@pytest.mark.parametrize("out", [1.0, -1.0])
def test_cells_that_stand_out_of_their_plane_raise_the_block(out):
    """By twice as far, unless its highest cell is less high."""
    saddle = 5.0 + out * np.array([[1.0, -1.0], [-1.0, 1.0]])
    assert block_separation(saddle, (2, 2)) == 4.0
    tilted = saddle + np.array([[0.0, 0.0], [10.0, 10.0]])
    assert block_separation(tilted, (2, 2)) == pytest.approx(10.0 - 2.0)


def test_blocks_with_missing_cells_have_the_lowest_of_the_rest():
    field = np.random.default_rng(2).random((6, 6))
    field[0, 0] = field[2:4, 2:4] = np.inf
    found = block_separation(field, (2, 2))
    assert found[0, 0] == field[:2, :2].min()
    assert found[1, 1] == np.inf
    assert np.isfinite(found).sum() == 8


@pytest.mark.parametrize("factors", [(2,), (1, 2)])
def test_without_blocks_of_two_by_two_it_is_the_lowest(factors):
    field = np.random.default_rng(3).random((6, 6)[: len(factors)])
    np.testing.assert_array_equal(block_separation(field, factors), block_minimum(field, factors))


@pytest.mark.parametrize("shape", [(8, 12), (9, 7), (5, 16), (4, 4), (3, 2)])
@pytest.mark.parametrize("factors", [(4, 4), (4, 2), (2, 4), (4, 1)])
def test_blocks_of_four_are_blocks_of_blocks(shape, factors):
    field = np.random.default_rng(4).random(shape)
    found, halves = block_separation(field, factors), tuple(min(f, 2) for f in factors)
    assert found.shape == tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    rest = tuple(f // half for f, half in zip(factors, halves, strict=True))
    np.testing.assert_array_equal(found, block_separation(block_separation(field, halves), rest))


@pytest.mark.parametrize(
    ("shape", "factors"),
    [
        ((65, 65), (2, 2)),
        ((255, 255), (2, 2)),
        ((256, 256), (4, 4)),
        ((512, 512), (4, 4)),
        ((513, 513), (2, 2)),
        ((512, 100), (4, 2)),
        ((512, 32), (4, 1)),
        ((2048, 512), (2, 2)),
    ],
    ids=str,
)
def test_up_to_512_cells_levels_are_four_times_as_coarse(shape, factors):
    operator = rc.half_space(rc.Grid(shape, 1.0), 1.0)
    coarse, found = coarse_operator(operator, shape)
    assert found == factors
    assert coarse.grid.shape == tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    assert coarse.grid.spacing == factors


def test_64_cells_are_the_coarsest():
    assert coarse_operator(rc.half_space(rc.Grid((64, 64), 1.0), 1.0), (64, 64)) is None


def test_a_smooth_surface_takes_fewer_products_than_from_its_summits(monkeypatch):
    """Slopes do not count: the summits of a sphere's blocks would put its contact too high by what they rise."""
    x = (np.arange(256) + 0.5) / 256 - 0.5
    sphere = rc.Surface(-(x[:, None] ** 2 + x**2) / 2, rc.Grid((256, 256), 1 / 256))
    steps = rc.press(sphere, 1.0, force=0.01).steps
    monkeypatch.setattr(nested_iteration, "block_separation", block_minimum)
    assert steps < 0.75 * rc.press(sphere, 1.0, force=0.01).steps


@pytest.mark.parametrize("hurst", [-0.5, 0.8])
def test_a_rough_surface_takes_few_products_from_its_coarse_guess(hurst):
    """Both where long waves carry the contact and where short ones do; cold starts take 30 to 60."""
    rough = rc.self_affine(rc.Grid((256, 256), 1 / 256), hurst, 0.01, np.random.default_rng(0))
    solution = rc.press(rough, 1.0, force=3e-5)
    assert solution.status.converged
    assert solution.steps < 10


def blocks(coarse, factors, separation):
    """Return the pressure of each cell's block, none where the cell is missing."""
    wanted = np.zeros(separation.shape)
    for at in np.ndindex(separation.shape):
        block = tuple(k // factor for k, factor in zip(at, factors, strict=True))
        wanted[at] = coarse[block] if np.isfinite(separation[at]) else 0.0
    return wanted


@pytest.mark.parametrize("shape", [*SHAPES, (13,), (16,)])
@pytest.mark.parametrize("factors", [(2, 2), (1, 2), (4, 4), (4, 1)])
@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 1.0])
@pytest.mark.parametrize("elsewhere", [False, True])
def test_cells_have_the_pressure_of_their_block(shape, factors, share, elsewhere):
    factors, rng = factors[: len(shape)], np.random.default_rng(6)
    many = tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    coarse = rng.random(many) * (rng.random(many) < share)
    for missing in (0.0, 0.3):
        separation = np.where(rng.random(shape) < missing, np.inf, 1.0)
        given = [Strict.put(f) if elsewhere else f for f in (coarse, separation)]
        found = nested_iteration._interpolated(given[0], factors, given[1], namespace(given[0]))
        np.testing.assert_array_equal(
            Strict.get(found) if elsewhere else found, blocks(coarse, factors, separation)
        )


class Corner:
    """A window that is the whole, and a solution with some pressure in its corner, or none."""

    strength: ClassVar[float] = 0.0
    answers: ClassVar[list] = []

    def __init__(self, operator):
        pass

    def solve(self, solver, separation, spec, guess):
        p = np.zeros(separation.shape)
        p[-3:, -2:] = self.strength * (1 + np.arange(6).reshape(3, 2))
        self.answers.append(p)
        return State(p, 0.25, 0.0, 1, Status.CONVERGED), tuple(slice(0, n) for n in p.shape)


@pytest.mark.parametrize("shape", [(66, 70), (65, 67), (130, 75)])
@pytest.mark.parametrize("strength", [0.0, 3.0])
def test_a_guess_is_the_coarse_answer_on_the_cells(shape, strength, monkeypatch):
    monkeypatch.setattr(nested_iteration, "SubdomainSolver", Corner)
    monkeypatch.setattr(Corner, "strength", strength)
    rng, operator = np.random.default_rng(7), rc.half_space(rc.Grid(shape, 1.0), 1.0)
    separation = np.where(rng.random(shape) < 0.1, np.inf, rng.random(shape))
    _, factors = coarse_operator(operator, shape)
    found, depth = nested_start(operator, separation, Depth(5.0), rc.ActiveSet())
    assert depth == 0.25
    np.testing.assert_array_equal(found, blocks(Corner.answers[-1], factors, separation))
    assert found.any() == (strength > 0)


def test_where_lines_have_no_coarser_cells_a_guess_is_no_pressure():
    separation = np.random.default_rng(7).random(64)
    body = rc.line(rc.Grid((64,), 1.0), 1.0)
    found, depth = nested_start(body, separation, Depth(0.5), rc.ActiveSet())
    assert (found.shape, found.any(), depth) == ((64,), False, 0.0)


def test_on_coarse_cells_a_depth_is_as_far_from_full_contact():
    """Blocks of cells stand higher: at the depth that is given they would be in full contact, or beyond it."""
    grid = rc.Grid((64, 96), 1.0, periodic=True)
    surface = rc.self_affine(grid, hurst=0.5, rms=0.3, rng=np.random.default_rng(1))
    mean, parts, coarse = float(surface.heights.max() - surface.heights.mean()), [], []

    class Watched:
        def run(self, operator, separation, spec, initial):
            parts.append(spec.depth / separation.mean())
            coarse.append(0.999 * mean / separation.mean())
            return rc.ActiveSet().run(operator, separation, spec, initial)

    rc.press(surface, 1.0, depth=0.999 * mean, solver=Watched())
    assert len(parts) > 1
    assert parts == pytest.approx([0.999] * len(parts), rel=1e-12)
    assert max(coarse) > 1


def test_coarse_cells_of_which_none_is_missing_go_no_deeper_than_full_contact():
    """A missing cell is lost in its block: where the cells bulge, the blocks may lie beyond full contact."""
    grid, rng = rc.Grid((74, 122), 1.0, periodic=True), np.random.default_rng(1)
    heights = rc.self_affine(grid, hurst=0.5, rms=0.3, rng=rng).heights.copy()
    heights[rng.random(grid.shape) < 0.03] = np.nan
    surface, coarse = rc.Surface(heights, grid), []

    class Watched:
        def run(self, operator, separation, spec, initial):
            state = rc.ActiveSet().run(operator, separation, spec, initial)
            if np.isfinite(separation).all():
                coarse.append((spec.depth <= separation.mean(), state.status.converged, state.steps < 200))
            return state

    rc.press(surface, 1.0, depth=0.999 * float(np.nanmax(heights) - np.nanmean(heights)), solver=Watched())
    assert coarse == [(True, True, True)]


@pytest.mark.parametrize(
    ("control", "periodic"), [(Depth(0.4), False), (Force(50.0), True), (Force(50.0), False)], ids=str
)
def test_elsewhere_coarse_cells_carry_the_same_load(control, periodic):
    grid = rc.Grid((64, 96), 1.0, periodic)
    surface = rc.self_affine(grid, hurst=0.5, rms=0.3, rng=np.random.default_rng(1))
    seen = []

    class Watched:
        def run(self, operator, separation, spec, initial):
            seen.append(spec.control)
            return rc.ActiveSet().run(operator, separation, spec, initial)

    separation = surface.heights.max() - surface.heights
    nested_start(rc.half_space(grid, 1.0), separation, control, Watched())
    assert seen == [control]
