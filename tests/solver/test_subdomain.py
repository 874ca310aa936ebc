"""SubdomainSolver that are lists of cells: the same certified answers as on the plane, and the box that lists share."""

from collections import Counter

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.operators import cell_list as lists
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator
from roughcontact.kernels import loader
from roughcontact.solver import tuning
from roughcontact.solver.subdomain import SubdomainSolver

MODULUS = 1e9
SOLVERS = {"default": rc.ActiveSet(), "iterative": rc.ActiveSet(dense_limit=0)}
SHAPES = [(160, 160), (230, 187)]


class Plain:
    """A half-space that has products and boxes, and states no lists, tiles or single precision."""

    def __init__(self, operator):
        self.whole = operator
        self.grid, self.weights = operator.grid, operator.weights
        self.capabilities = rc.Capabilities(
            positive=True,
            coarsened=lambda grid: Plain(operator.coarsened(grid)),
            approximate_inverse=operator.approximate_inverse,
        )

    def apply(self, pressure):
        return self.whole.apply(pressure)

    def as_matrix(self, cells=None):
        return self.whole.as_matrix(cells)

    def restrict(self, window):
        return Plain(self.whole.restrict(window))


@pytest.fixture(params=SHAPES, ids=str)
def rough(request):
    grid = rc.Grid(request.param, (1e-3, 1e-3))
    return rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=np.random.default_rng(5))


@pytest.fixture
def parts(monkeypatch, rough):
    """Take lists wherever it can be, sum tile by tile, and count on what the surface itself is solved."""
    if not loader.is_available():
        pytest.skip("no machine code here")
    monkeypatch.setattr(tuning, "LARGE_BOX", 0)
    monkeypatch.setattr(tuning, "LIST_FILLING", 1.0)
    monkeypatch.setattr(lists, "PAIRS_FOR_TILES", 0)
    found, chosen = Counter(), SubdomainSolver._subdomain

    def counted(self, region):
        place = chosen(self, region)
        if isinstance(self.operator, InfluenceOperator) and self.operator.grid == rough.grid:
            found["box" if isinstance(place, tuple) else "list"] += 1
        return place

    monkeypatch.setattr(SubdomainSolver, "_subdomain", counted)
    return found


def scale_of(surface):
    return MODULUS * surface.rms * surface.grid.lengths[0]


def holed(surface, share=0.02):
    """Some points, and a stripe, were not measured."""
    heights = surface.heights.copy()
    heights[np.random.default_rng(8).random(heights.shape) < share] = np.nan
    heights[:, 40:43] = np.nan
    return rc.Surface(heights, surface.grid)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("missing", [False, True])
@pytest.mark.parametrize("load", [{"force": 0.02}, {"force": 0.3}, {"depth": 1.5}], ids=str)
def test_the_answer_is_that_on_the_plane(rough, parts, solver, missing, load):
    surface = holed(rough) if missing else rough
    [(name, value)] = load.items()
    load = {name: value * (scale_of(rough) if name == "force" else rough.rms)}
    given = {**load, "tolerance": 1e-10, "solver": SOLVERS[solver]}
    operator = rc.half_space(rough.grid, MODULUS)
    expected = rc.press(surface, MODULUS, operator=Plain(operator), **given)
    assert not parts["list"]
    found = rc.press(surface, MODULUS, operator=operator, **given)
    assert parts["list"] >= 1
    assert not parts["box"]
    assert found.status.converged
    assert found.residual <= 1e-10
    # Both gaps are closed to 1e-10 of the largest displacement: the depths, set by them, agree as well.
    scale = float(np.abs(expected.displacement).max())
    assert found.depth == pytest.approx(expected.depth, abs=2e-10 * scale)
    np.testing.assert_array_equal(found.contact, expected.contact)
    assert not found.contact[np.isnan(surface.heights)].any()
    # The displacements agree wherever both gaps are closed, on nearly all of what carries.
    both = np.abs(found.displacement - expected.displacement)[found.contact]
    assert both.max() <= 4e-10 * scale


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("missing", [False, True])
def test_the_curve_is_that_on_the_plane(rough, parts, solver, missing):
    surface = holed(rough) if missing else rough
    forces = np.geomspace(2e-3, 0.1, 5) * scale_of(rough)
    given = {"forces": forces, "tolerance": 1e-10, "solver": SOLVERS[solver]}
    operator = rc.half_space(rough.grid, MODULUS)
    expected = rc.loading_curve(surface, MODULUS, operator=Plain(operator), **given)
    assert not parts["list"]
    found = rc.loading_curve(surface, MODULUS, operator=operator, **given)
    assert parts["list"] >= 5
    assert not parts["box"]
    assert all(status.converged for status in found.status)
    np.testing.assert_array_equal(found.contact_area, expected.contact_area)
    np.testing.assert_array_equal(found.spots, expected.spots)
    # Each unit displacement is met to 1e-7; depths are those of gaps closed to 1e-10 of a displacement, at most
    # three times the depth here.
    np.testing.assert_allclose(found.stiffness, expected.stiffness, rtol=2e-7)
    np.testing.assert_allclose(found.depth, expected.depth, rtol=1e-9)
    assert (found.stiffness_residual <= 1e-7).all()


@pytest.mark.parametrize("way", ["tiles", "plane"])
@pytest.mark.parametrize("share", [0.02, 0.1])
def test_the_stiffness_of_a_list_is_that_on_the_plane(monkeypatch, rough, share, way):
    """2 % of the cells are solved by a factorisation, 10 % are not."""
    monkeypatch.setattr(lists, "PAIRS_FOR_TILES", 0)
    monkeypatch.setattr(lists, "TILE_SUMS_PER_CELL", np.inf if way == "tiles" else -1.0)
    heights = rough.heights
    region = heights > np.quantile(heights, 1 - share)
    # A list that holds more than the region.
    cells = np.flatnonzero(heights > np.quantile(heights, 1 - 2 * share))
    operator = rc.half_space(rough.grid, MODULUS)
    part = operator.submatrix(cells)
    expected = rc.contact_stiffness(region, rough.grid, MODULUS, operator=Plain(operator))
    found = rc.contact_stiffness(region.ravel()[cells], part.grid, MODULUS, operator=part)
    assert found == pytest.approx(expected, rel=2e-7)  # each unit displacement is met to 1e-7


def test_any_displacement_of_a_list_is_that_of_the_plane(rough):
    region = rough.heights > np.quantile(rough.heights, 0.9)
    wanted = np.where(region, rough.heights, np.nan)
    cells = np.flatnonzero(rough.heights > np.quantile(rough.heights, 0.8))
    operator = rc.half_space(rough.grid, MODULUS)
    part = operator.submatrix(cells)
    found = rc.prescribed_displacement(
        region.ravel()[cells], wanted.ravel()[cells], operator=part, tolerance=1e-10
    )
    assert found.residual <= 1e-10
    whole = np.zeros(rough.grid.shape)
    whole.ravel()[cells] = found.pressure
    assert not whole[~region].any()
    error = (operator.apply(whole) - wanted)[region]
    # Beside what was asked for, what transforms round: some eps of the largest displacement of either sign.
    size = operator.apply(np.abs(whole)).max()
    assert np.abs(error).max() <= 1e-10 * np.abs(wanted[region]).max() + 1e-14 * size
    assert found.force == pytest.approx(whole.sum() * operator.weights, rel=1e-12)


class TestParts:
    GRID = rc.Grid((62, 70), (0.3, 0.5))

    def block(self, rows, columns, share=0.3, seed=0):
        """Some cells of a box, with two opposite corners of it."""
        region = np.zeros(self.GRID.shape, dtype=bool)
        part = (
            np.random.default_rng(seed).random((rows.stop - rows.start, columns.stop - columns.start)) < share
        )
        part[0, 0] = part[-1, -1] = True
        region[rows, columns] = part
        return np.flatnonzero(region)

    def test_a_list_is_a_part_of_the_plane(self):
        operator = rc.half_space(self.GRID, 2.0)
        windows = SubdomainSolver(operator)
        for rows, columns in (
            (slice(10, 20), slice(30, 50)),
            (slice(0, 7), slice(60, 70)),
            (slice(61, 62), slice(0, 1)),
            (slice(0, 62), slice(0, 70)),
        ):
            cells = self.block(rows, columns)
            part = windows.operator_on(cells)
            assert isinstance(part, CellsOperator)
            np.testing.assert_array_equal(part.as_matrix(), operator.as_matrix(cells))
            pressure = np.zeros(self.GRID.shape)
            pressure.ravel()[cells] = np.random.default_rng(1).random(len(cells))
            # The whole is transformed: some eps of a displacement that pressures of one sign add up to.
            np.testing.assert_allclose(
                part.apply(pressure.ravel()[cells]), operator.apply(pressure).ravel()[cells], rtol=1e-13
            )

    def test_all_ways_through_the_box_are_one(self, monkeypatch):
        """Cells are counted anew in the box: its products are those of the list."""
        cells = self.block(slice(10, 35), slice(30, 50))
        part = SubdomainSolver(rc.half_space(self.GRID, 2.0)).operator_on(cells)
        assert part.plane.grid.shape == (25 + 2, 20 + 2)
        pressure = np.random.default_rng(1).random(len(cells))
        exact = part.as_matrix() @ pressure
        for many, sums in ((np.inf, 0.0), (0, np.inf), (0, -1.0)):
            monkeypatch.setattr(lists, "PAIRS_FOR_TILES", many)
            monkeypatch.setattr(lists, "TILE_SUMS_PER_CELL", sums)
            np.testing.assert_allclose(part.apply(pressure), exact, rtol=1e-13)

    def test_the_box_is_kept_while_it_holds(self):
        windows = SubdomainSolver(rc.half_space(self.GRID, 2.0))
        first = windows.operator_on(self.block(slice(10, 20), slice(30, 50)))
        assert windows.operator_on(self.block(slice(10, 20), slice(30, 50), 0.6)).plane is first.plane
        # A cell of room on each side.
        assert windows.operator_on(self.block(slice(9, 21), slice(29, 51))).plane is first.plane
        second = windows.operator_on(self.block(slice(8, 21), slice(29, 51)))
        assert second.plane is not first.plane
        assert second.plane.grid.shape == (15, 24)
        # Half of the box is worth one of its own.
        assert windows.operator_on(self.block(slice(10, 16), slice(30, 40))).plane is not second.plane

    def test_the_last_list_is_kept(self):
        operator = rc.half_space(self.GRID, 2.0)
        windows = SubdomainSolver(operator)
        one, other = (self.block(slice(10, 20), slice(30, 50), seed=seed) for seed in range(2))
        assert windows.operator_on(one) is windows.operator_on(one)
        for cells in (other, one):
            np.testing.assert_array_equal(windows.operator_on(cells).as_matrix(), operator.as_matrix(cells))

    def test_the_influence_is_that_of_the_whole(self):
        """So that a table serves all windows."""
        operator = rc.half_space(self.GRID, 2.0)
        windows = SubdomainSolver(operator)
        for rows in (slice(10, 20), slice(5, 45)):
            part = windows.operator_on(self.block(rows, slice(30, 50)))
            assert part.influence is operator.influence
            assert part.plane.influence is operator.influence

    def test_where_the_box_is_the_whole(self):
        operator = rc.half_space(self.GRID, 2.0)
        assert SubdomainSolver(operator).operator_on(self.block(slice(0, 62), slice(0, 70))).plane is operator

    def test_on_a_small_grid_it_is_part_of_the_whole(self):
        """Whose kernel is at hand."""
        operator = rc.half_space(rc.Grid((64, 64), 1.0), 2.0)
        assert SubdomainSolver(operator).operator_on(np.array([70, 71, 140])).plane is operator

    def test_of_a_line(self):
        operator = rc.line(rc.Grid(300, 0.5), 2.0)
        cells = np.r_[20:50, 100:104, 299]
        part = SubdomainSolver(operator).operator_on(cells)
        np.testing.assert_array_equal(part.as_matrix(), operator.as_matrix(cells))


@pytest.mark.parametrize(
    ("shape", "share", "large", "is_list"),
    [
        ((64, 64), 0.05, 2**21, True),  # 205^2/4 look-ups are less than 1.5 x 4 x 4096
        # More than a fifth is filled, so that only look-ups decide: up to 75 cells they are less than 1.5 x 4 x 240.
        ((12, 20), 0.25, 2**21, True),
        ((12, 20), 0.4, 2**21, False),
        ((300, 300), 0.05, 2**21, False),
        ((300, 300), 0.05, 90_000 - 1, True),
        ((300, 300), 0.05, 90_000, False),
        ((300, 300), 0.3, 0, False),
    ],
)
def test_what_is_a_list(monkeypatch, shape, share, large, is_list):
    if not loader.is_available():
        pytest.skip("no machine code here")
    monkeypatch.setattr(tuning, "LARGE_BOX", large)
    region = np.random.default_rng(0).random(shape) < share
    region[0, 0] = region[-1, -1] = True
    windows = SubdomainSolver(rc.half_space(rc.Grid(shape, 1.0), 2.0))
    assert isinstance(windows._subdomain(region), np.ndarray) == is_list
