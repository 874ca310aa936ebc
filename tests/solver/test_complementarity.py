"""Cells with neither pressure nor gap: what rounding leaves open is told in the same way by every path to an answer.

Each problem is made from its answer: a pressure, zero on some cells whose gap is zero too. Stored separations are
rounded to half a unit in the last place of the largest displacement, so that the stored problem has these cells on
either side.
"""

import functools
from copy import copy

import numpy as np
import pytest

import roughcontact as rc
from libraries import LIBRARIES
from roughcontact.contact.press import solve
from roughcontact.contact.problem import ContactProblem
from roughcontact.solver.complementarity import FINEST, MANY, NEAR, _pressed_by_rounding, added_stiffness

MODULUS = 3e9
STEP = 2e-7


def smooth_noise(shape, seed):
    """Return a random field whose level sets are islands."""
    noise = np.fft.fftn(np.random.default_rng(seed).standard_normal(shape))
    q = np.sqrt(sum(np.meshgrid(*[np.fft.fftfreq(n) ** 2 for n in shape], indexing="ij")))
    return np.real(np.fft.ifftn(noise / (q + 1 / max(shape)) ** 1.5))


class Degenerate:
    """A problem with a known contact, and cells that touch without pressure."""

    def __init__(self, operator, seed, least=0.0):
        shape = operator.grid.shape
        h = smooth_noise(shape, seed)
        above, beside = (np.quantile(h, 1 - part) for part in (0.2, 0.22))
        pressure = 1e6 * np.where(h > above, (h - above) / (h.max() - above) + least, 0.0)
        self.contact, self.touching = h > above, (h > beside) & (h <= above)
        u = operator.apply(pressure)
        gap = np.where(h > beside, 0.0, (beside - h) * (u.max() / np.ptp(h)))
        self.separation = gap - u - (gap - u).min()
        self.depth = -float((gap - u).min())
        self.force = float(np.sum(operator.weights * pressure))
        self.operator = operator

    def control(self, by):
        return rc.Force(self.force) if by == "force" else rc.Depth(self.depth)

    def solved(self, control, solver=None, tolerance=1e-8):
        return solve(ContactProblem(self.separation, self.operator, control, tolerance), solver=solver)


def square(n, periodic):
    return rc.half_space(rc.Grid((n, n), STEP, periodic), MODULUS)


def rings(n):
    widths = np.random.default_rng(3).uniform(0.1, 2, n)
    return rc.ring(rc.RadialGrid(STEP * np.concatenate([[0.0], np.cumsum(widths)])), MODULUS)


def line(n):
    return rc.line(rc.Grid((n,), STEP), MODULUS, reference_length=4 * n * STEP)


OPERATORS = {
    "free": lambda: square(32, False),
    "periodic": lambda: square(32, True),
    "free, iterated": lambda: square(112, False),
    "periodic, iterated": lambda: square(112, True),
    "rings": lambda: rings(300),
    "line": lambda: line(500),
    "singly periodic": lambda: rc.singly_periodic(rc.Grid((24, 24), STEP, (True, False)), MODULUS),
    "layer": lambda: rc.layer(rc.Grid((32, 32), STEP), rc.Solid(MODULUS, 0.3), 10 * STEP, base="bonded"),
}


@functools.cache
def degenerate(name):
    return Degenerate(OPERATORS[name](), 7)


SOLVERS = {
    "default": None,
    "iterative": rc.ActiveSet(dense_limit=0),
    "Polonsky and Keer": rc.PolonskyKeer(),
}


FEW = ["free", "periodic", "rings", "singly periodic", "layer"]  # cells, for the slow method
PAIRS = [
    (name, solver) for name in OPERATORS for solver in SOLVERS if solver in list(SOLVERS)[:2] or name in FEW
]


@pytest.mark.parametrize(("name", "solver"), PAIRS)
@pytest.mark.parametrize("by", ["force", "depth"])
def test_the_contact_is_that_of_the_cells_that_press(name, solver, by):
    problem = degenerate(name)
    solution = problem.solved(problem.control(by), SOLVERS[solver])
    assert solution.status is rc.Status.CONVERGED
    np.testing.assert_array_equal(solution.contact, problem.contact)
    np.testing.assert_array_equal(solution.touching, problem.touching)


@pytest.mark.parametrize("name", ["free", "periodic, iterated", "rings", "line"])
def test_the_stiffness_has_two_sides_and_each_has_a_name(name):
    problem = degenerate(name)
    solution = problem.solved(rc.Force(problem.force))
    grid, body = problem.operator.grid, {"operator": problem.operator}
    reduced, grown = (
        rc.contact_stiffness(region, grid, MODULUS, **body)
        for region in (problem.contact, problem.contact | problem.touching)
    )
    assert grown > 1.002 * reduced
    # To the square of the tolerance of a tangent, 1e-7, and what is made of it by hundreds of cells.
    assert solution.stiffness == pytest.approx(reduced, rel=1e-10)
    assert solution.loading_stiffness == pytest.approx(grown, rel=1e-10)
    # The slopes of the force to both sides, by a step of the depth that few cells answer to; the force is convex.
    step = 1e-4 * problem.depth
    below, above = (problem.solved(rc.Depth(problem.depth + sign * step)).force for sign in (-1, 1))
    assert (problem.force - below) / step <= reduced * (1 + 1e-6)
    assert (above - problem.force) / step >= grown * (1 - 1e-6)
    [note] = [note for note in solution.notes if "touch" in note]
    assert f"{problem.touching.sum()} cells touch" in note


@pytest.mark.parametrize("name", ["free", "free, iterated"])
def test_a_curve_and_a_single_load_take_the_same_side(name):
    problem = degenerate(name)
    surface = rc.Surface(problem.separation.max() - problem.separation, problem.operator.grid)
    forces = problem.force * np.array([0.5, 1.0, 1.5])
    curve = rc.loading_curve(surface, MODULUS, forces=forces)
    alone = rc.press(surface, MODULUS, force=problem.force)
    assert curve.stiffness[1] == pytest.approx(alone.stiffness, rel=1e-10)
    assert curve.contact_area[1] == pytest.approx(alone.contact_area, rel=1e-12)
    np.testing.assert_array_equal(alone.contact, problem.contact)


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("name", ["free", "periodic", "rings"])
def test_arrays_of_other_libraries(name, library):
    problem = copy(degenerate(name))
    problem.separation = library.put(problem.separation)
    solution = problem.solved(rc.Force(problem.force))
    np.testing.assert_array_equal(library.get(solution.contact), problem.contact)
    np.testing.assert_array_equal(library.get(solution.touching), problem.touching)
    assert solution.loading_stiffness > 1.001 * solution.stiffness
    assert any("touch" in note for note in solution.notes)


@pytest.mark.parametrize("solver", list(SOLVERS)[:2])
def test_on_a_window(solver):
    # The same contact on the plane, and where the solver looks at the cells that overlap alone.
    problem = Degenerate(OPERATORS["free"](), 7)
    large = rc.half_space(rc.Grid((128, 128), STEP), MODULUS)
    inside = np.s_[40:72, 50:82]
    far = np.full((128, 128), 2 * problem.separation.max())
    far[inside] = problem.separation
    solution = solve(ContactProblem(far, large, rc.Force(problem.force)), solver=SOLVERS[solver])
    np.testing.assert_array_equal(solution.contact[inside], problem.contact)
    np.testing.assert_array_equal(solution.touching[inside], problem.touching)
    assert solution.contact.sum() == problem.contact.sum()


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
def test_the_floor_goes_with_the_units(unit):
    operator = rc.half_space(rc.Grid((24, 24), STEP * unit), MODULUS / unit**2)
    problem = Degenerate(operator, 3)
    solution = problem.solved(rc.Force(problem.force))
    np.testing.assert_array_equal(solution.contact, problem.contact)
    np.testing.assert_array_equal(solution.touching, problem.touching)


@pytest.mark.parametrize("name", ["free", "periodic", "rings"])
def test_a_cell_that_carries_little_stays(name):
    operator = OPERATORS[name]()
    whole = Degenerate(operator, 7)
    # One cell of those that touch is given 1e-12 of the largest pressure. It is known to 3e-13: the largest
    # displacement is some 20 times what the largest pressure does to its own cell, and 20 * 4 * 16 units in the last
    # place are that.
    pressure = np.where(whole.contact, whole.solved(rc.Force(whole.force)).pressure, 0.0)
    cell = np.unravel_index(np.argmax(whole.touching), whole.touching.shape)
    pressure[cell] = 1e-12 * pressure.max()
    u = operator.apply(pressure)
    whole.separation = np.where(
        whole.contact | whole.touching, u.max() - u, whole.separation + (u.max() - whole.depth)
    )
    whole.separation[whole.touching] += 1e-6 * u.max()
    whole.separation[cell] = u.max() - u[cell]
    force = float(np.sum(operator.weights * pressure))
    solution = whole.solved(rc.Force(force))
    assert solution.contact[cell]
    assert solution.pressure[cell] == pytest.approx(pressure[cell], rel=0.5)
    assert not solution.touching.any()
    assert solution.contact.sum() == whole.contact.sum() + 1


@pytest.mark.parametrize(("place", "told"), [(100, False), (200, True)])
def test_a_note_only_where_the_sides_differ(place, told):
    # A ring of a hundredth of a width just outside the contact adds a ten thousandth to its radius; one far out, much.
    grid = rc.RadialGrid(np.concatenate([np.arange(101.0), [100.01], np.arange(101.0, 221.0)]))
    operator, cells = rc.ring(grid, 1.0), np.arange(grid.size)
    u = operator.apply(np.where(cells < 100, np.sqrt(np.maximum(1 - (cells / 100.5) ** 2, 0)), 0.0))
    gap = np.where(cells < 100, 0.0, 1e-3 * u.max())
    gap[place] = 0.0
    solution = solve(ContactProblem(u.max() - u + gap, operator, rc.Depth(float(u.max()))))
    assert np.flatnonzero(solution.touching).tolist() == [place]
    assert (solution.loading_stiffness > 1.001 * solution.stiffness) == told
    assert any("touches" in note for note in solution.notes) == told


def test_ordinary_contacts_are_not_solved_twice():
    asked = []

    class Spied:
        def run(self, operator, separation, spec, initial):
            asked.append(spec.tolerance)
            return rc.ActiveSet(dense_limit=0).run(operator, separation, spec, initial)

    for seed in range(3):
        surface = rc.self_affine(rc.Grid((128, 128), 1.0), 0.8, 1.0, np.random.default_rng(seed))
        rc.press(surface, 1.0, force=30.0, solver=Spied())
    assert asked
    assert FINEST not in asked


def test_first_touch_has_two_sides_too():
    surface = rc.self_affine(rc.Grid((16, 16), 1.0), 0.8, 1.0, np.random.default_rng(0))
    solution = rc.press(surface, 1.0, depth=0.0)
    highest = surface.heights == surface.heights.max()
    assert solution.stiffness == 0
    np.testing.assert_array_equal(solution.touching, highest)
    assert solution.loading_stiffness == pytest.approx(rc.contact_stiffness(highest, surface.grid, 1.0))
    assert not any("touch" in note for note in solution.notes)


def test_pressures_that_rounding_makes_are_small_and_not_none():
    """4 m/Pa times what is allowed over the cell's own influence of 2 m/Pa: 2e-3."""
    found = _pressed_by_rounding(np.array([0.0, 1e-3, 2e-3, 2.1e-3]), 2.0, 1e-3)
    np.testing.assert_array_equal(found, [False, True, True, False])


@pytest.mark.parametrize("axis", [0, 1])
def test_what_a_cell_adds_is_bounded_by_pressed_cells_as_near_on_either_side(axis):
    """Those of up to five cells away take from it, as much before as behind it; beyond, it adds what it has alone."""
    operator, place = rc.half_space(rc.Grid((21, 23), 0.5), 2.0), (10, 11)
    weak = np.zeros((21, 23), bool)
    weak[place] = True

    def added(away):
        pressed, beside = np.zeros((21, 23)), list(place)
        beside[axis] += away
        pressed[tuple(beside)] = 1.0
        return added_stiffness(operator, pressed, weak)

    alone = added_stiffness(operator, np.zeros((21, 23)), weak)
    for away in range(1, NEAR + 1):
        assert added(away) == pytest.approx(added(-away), rel=1e-12)
        assert added(away) < alone
    assert added(NEAR + 1) == added(-NEAR - 1) == alone


def test_more_than_three_hundred_cells_matter_unasked():
    operator, pressed = rc.half_space(rc.Grid((18, 18), 1.0), 2.0), np.zeros((18, 18))
    for number, infinite in ((MANY, False), (MANY + 1, True)):
        weak = np.arange(18 * 18).reshape(18, 18) < number
        assert np.isinf(added_stiffness(operator, pressed, weak)) == infinite
