"""Near full contact: what the open cells leave of the mean gap, and of its stiffness."""

from functools import lru_cache

import numpy as np
import pytest
import scipy.linalg

import roughcontact as rc
from libraries import LIBRARIES
from roughcontact.contact import solution as solution_module
from roughcontact.halfspace.operators.build import singly_periodic
from roughcontact.halfspace.operators.layer import layer

DEPTH = 1e-3
WITHIN = 1e-6  # what is claimed of both numbers
PLACES = {"corner": (0, 0), "edge": (0, 0.5), "middle": (0.5, 0.5)}


def cell(place, n):
    """Return a plane with one cell open."""
    mask = np.zeros((n, n), bool)
    mask[tuple(int(part * n) for part in PLACES[place])] = True
    return mask


def some(share, n, seed=0):
    """Return a plane with a share of its cells open, scattered."""
    return np.random.default_rng(seed).random((n, n)) < share


OPEN = {
    "corner": lambda n: cell("corner", n),
    "edge": lambda n: cell("edge", n),
    "middle": lambda n: cell("middle", n),
    "a hundredth": lambda n: some(0.01, n),
    "half": lambda n: some(0.5, n),
}


@lru_cache
def factor(n):
    return scipy.linalg.cho_factor(rc.half_space(rc.Grid((n, n), 1 / n), 1.0).as_matrix())


def openings(mask):
    """Return by how much the cells of a mask stay behind when all others are displaced by one.

    With B the inverse matrix, B_OO v = (B 1)_O: no ones are subtracted.
    """
    cells = np.flatnonzero(mask)
    right = np.c_[np.ones(mask.size), np.eye(mask.size)[:, cells]]
    columns = scipy.linalg.cho_solve(factor(len(mask)), right)[cells]
    return np.linalg.solve(columns[:, 1:], columns[:, 0])


def pitted(grid, mask, opening):
    """Return a plane with pits that stay open by DEPTH times the opening when it is pressed by DEPTH."""
    heights = np.zeros(grid.shape)
    heights[mask] = -2 * DEPTH * opening
    return rc.Surface(heights, grid)


@pytest.mark.parametrize("name", OPEN)
@pytest.mark.parametrize("n", [32, 48])
def test_against_dense_solves(n, name):
    grid, mask = rc.Grid((n, n), 1 / n), OPEN[name](n)
    opening = openings(mask)
    solution = rc.press(pitted(grid, mask, opening), 1.0, depth=DEPTH)
    np.testing.assert_array_equal(solution.contact, ~mask)
    closing = opening.sum() / n**2
    assert solution.interfacial_stiffness == pytest.approx(solution.stiffness / closing, rel=WITHIN)
    assert solution.mean_gap == pytest.approx(DEPTH * closing, rel=WITHIN)


@pytest.fixture(scope="module")
def large():
    """A plane of 200 x 200 cells in full contact, its pressure per unit depth good to 1e-13."""
    grid = rc.Grid((200, 200), 1 / 200)
    operator = rc.half_space(grid, 1.0)
    full = rc.prescribed_displacement(np.ones(grid.shape, bool), 1.0, operator=operator, tolerance=1e-13)
    return operator, full.pressure


@pytest.mark.parametrize("place", PLACES)
def test_one_open_cell_of_a_large_plane(large, place):
    """One open cell stays behind by (B 1)_j / B_jj, with B the inverse of the operator."""
    operator, full = large
    mask = cell(place, 200)
    column = rc.prescribed_displacement(~mask | mask, mask.astype(float), operator=operator, tolerance=1e-11)
    opening = full[mask] / column.pressure[mask]
    solution = rc.press(pitted(operator.grid, mask, opening), 1.0, depth=DEPTH)
    np.testing.assert_array_equal(solution.contact, ~mask)
    closing = opening.item() / mask.size
    assert solution.interfacial_stiffness == pytest.approx(solution.stiffness / closing, rel=WITHIN)
    assert solution.mean_gap == pytest.approx(DEPTH * closing, rel=WITHIN)
    resistance = rc.conductance(solution, resistivities=(1e-8, 1e-8), of="interface")
    expected = 1e-8 * closing / solution.stiffness  # rho E*/K
    assert resistance["electrical_resistance"] == pytest.approx(expected, rel=WITHIN)


@pytest.mark.parametrize("share", [0.001, 0.5])
def test_many_open_cells_of_a_large_plane(large, share):
    operator, _ = large
    mask = some(share, 200)
    tangent = rc.prescribed_displacement(~mask, 1.0, operator=operator, tolerance=1e-13)
    opening = 1 - operator.apply(tangent.pressure)[mask]
    solution = rc.press(pitted(operator.grid, mask, opening), 1.0, depth=DEPTH)
    np.testing.assert_array_equal(solution.contact, ~mask)
    assert solution.interfacial_stiffness == pytest.approx(
        tangent.force * mask.size / opening.sum(), rel=WITHIN
    )
    assert solution.mean_gap == pytest.approx(DEPTH * opening.sum() / mask.size, rel=WITHIN)


def frozen(solution):
    """Return by how much the mean gap closes per unit depth, and the mean gap itself, by a dense solve."""
    problem = solution.problem
    matrix = problem.operator.as_matrix()
    pressure, separation = (np.array(field.ravel()) for field in (solution.pressure, problem.separation))
    inside = (pressure > 0) & (pressure < problem.hardness)
    tangent = np.zeros(inside.size)
    tangent[inside] = np.linalg.solve(matrix[np.ix_(inside, inside)], np.ones(inside.sum()))
    pressure[inside] = 0.0
    wanted = solution.depth - separation - matrix @ pressure
    pressure[inside] = np.linalg.solve(matrix[np.ix_(inside, inside)], wanted[inside])
    outside = problem.measured.ravel() & ~inside
    weights = np.broadcast_to(problem.operator.weights, problem.grid.shape).ravel()

    def mean(field):
        return (weights * field)[outside].sum() / weights[problem.measured.ravel()].sum()

    return mean(1 - matrix @ tangent), mean(matrix @ pressure + separation - solution.depth)


@pytest.mark.parametrize("solver", [rc.ActiveSet(dense_limit=0), rc.PolonskyKeer()], ids=repr)
def test_the_mean_gap_does_not_take_over_what_the_solver_left_in_contact(solver):
    """A pressure good to 1e-6 of the largest displacement; the mean gap is 2e-5 of that."""
    grid, mask = rc.Grid((32, 32), 1 / 32), cell("middle", 32)
    x = 2 * np.pi * np.arange(32) / 32
    wave = 0.03 * DEPTH * np.cos(x)[:, None] * np.cos(2 * x)
    heights = pitted(grid, mask, openings(mask)).heights + wave
    solution = rc.press(rc.Surface(heights, grid), 1.0, depth=DEPTH, tolerance=1e-6, solver=solver)
    np.testing.assert_array_equal(solution.contact, ~mask)
    assert solution.mean_gap == pytest.approx(frozen(solution)[1], rel=WITHIN)


RADII = np.r_[0, np.cumsum(np.linspace(1.0, 0.2, 80))]  # ring widths that differ
SQUARE = rc.Grid((24, 24), 1 / 24)
BODIES = {
    "free": lambda: rc.half_space(SQUARE, 1.0),
    "periodic": lambda: rc.half_space(rc.Grid((24, 24), 1 / 24, True), 1.0),
    "periodic along one axis": lambda: singly_periodic(rc.Grid((24, 24), 1 / 24, (True, False)), 1.0),
    "layer": lambda: layer(SQUARE, rc.Solid(1.0, 0.3), 0.2, base="bonded"),
    "line": lambda: rc.line(rc.Grid(300, 1 / 300), 1.0),
    "rings": lambda: rc.ring(rc.RadialGrid(RADII / RADII[-1]), 1.0),
    "springs": lambda: rc.foundation(rc.Grid(50, 1 / 50), 1.0),
}


@pytest.mark.parametrize("missing", [0, 5])
@pytest.mark.parametrize("name", BODIES)
def test_every_body(name, missing):
    """Missing cells may bulge and do not count; on a whole periodic plane the mean of the displacement is zero."""
    operator = BODIES[name]()
    grid = operator.grid
    heights = np.zeros(grid.shape)
    at, hole = heights.size // 2, heights.size // 4
    heights.ravel()[at] = -1.0
    heights.ravel()[hole : hole + missing] = np.nan
    body = rc.RadialProfile(heights, grid) if name == "rings" else rc.Surface(heights, grid)
    solution = rc.press(body, 1.0, force=1e-3 * grid.area, operator=operator, tolerance=1e-10)
    assert solution.contact.sum() == heights.size - 1 - solution.missing
    closing, gap = frozen(solution)
    if name == "periodic" and not missing:  # the dense solve knows only about that its mean is zero
        assert closing == pytest.approx(1, rel=1e-9)
    assert solution.interfacial_stiffness == pytest.approx(solution.stiffness / closing, rel=WITHIN)
    assert solution.mean_gap == pytest.approx(gap, rel=WITHIN)


@pytest.mark.parametrize("periodic", [False, True])
def test_nothing_is_closed_at_first_touch(periodic):
    heights = np.sin(np.arange(64)).reshape(8, 8)
    heights[3, 3] = np.nan
    solution = rc.press(rc.Surface(heights, rc.Grid((8, 8), 1.0, periodic)), 1.0, depth=0.0)
    assert solution.mean_gap == pytest.approx(np.nanmax(heights) - np.nanmean(heights), rel=1e-14)
    assert solution.interfacial_stiffness == 0


def test_cells_under_the_hardness_count():
    """They are not closed: the mean gap has them below zero, and the frozen region does not hold them."""
    heights = np.zeros((24, 24))
    heights[12, 12] = -1.0
    solution = rc.press(rc.Surface(heights, SQUARE), 1.0, force=1e-2, hardness=0.016)
    assert (solution.pressure == 0.016).any()
    closing, gap = frozen(solution)
    assert solution.interfacial_stiffness == pytest.approx(solution.stiffness / closing, rel=WITHIN)
    assert solution.mean_gap == pytest.approx(gap, rel=WITHIN)
    assert (solution.gap[solution.pressure == 0.016] < 0).all()


def test_along_a_curve():
    """From half of the cells to all of them."""
    grid = rc.Grid((24, 24), 1 / 24)
    rough = rc.self_affine(grid, hurst=1.2, rms=1e-3, rng=np.random.default_rng(2))
    loads = {"forces": np.geomspace(3e-3, 5e-2, 8), "tolerance": 1e-10}
    curve = rc.loading_curve(rough, 1.0, **loads)
    path = list(rc.loading_path(rough, 1.0, **loads))
    cells = [int(solution.contact.sum()) for solution in path]
    assert cells[0] < 0.6 * 24**2
    assert max(count for count in cells if count < 24**2) > 0.95 * 24**2
    assert cells[-1] == 24**2
    for i, solution in enumerate(path):
        if solution.contact.all():
            assert (curve.interfacial_stiffness[i], curve.mean_gap[i]) == (np.inf, 0)
            continue
        closing, gap = frozen(solution)
        assert curve.interfacial_stiffness[i] == pytest.approx(curve.stiffness[i] / closing, rel=WITHIN)
        assert curve.mean_gap[i] == pytest.approx(gap, rel=WITHIN)


def test_far_from_full_contact_no_product_is_taken(monkeypatch):
    """The mean displacement follows from reciprocity, over the loads that are suggested."""
    monkeypatch.setattr(solution_module, "mean_opening", None)
    grid = rc.Grid((48, 48), 1 / 48)
    rough = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    curve = rc.loading_curve(rough, 1.0)
    assert np.isfinite(curve.interfacial_stiffness).all()
    assert (curve.mean_gap > 0).all()


@pytest.mark.parametrize("library", LIBRARIES)
def test_where_the_arrays_are(library):
    grid, mask = rc.Grid((16, 16), 1 / 16), cell("middle", 16)
    opening = openings(mask)
    heights = pitted(grid, mask, opening).heights
    solution = rc.press(rc.Surface(library.put(heights.copy()), grid), 1.0, depth=DEPTH)
    closing = opening.item() / mask.size
    assert solution.interfacial_stiffness == pytest.approx(solution.stiffness / closing, rel=WITHIN)
    assert solution.mean_gap == pytest.approx(DEPTH * closing, rel=WITHIN)
