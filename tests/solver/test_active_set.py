"""What becomes of a first prediction of the free set: three ways, one answer (docs/concepts/method.md, A7 to A9)."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.kernels import loader
from roughcontact.solver import active_set
from roughcontact.solver.control import Force, Specification
from roughcontact.solver.optimality import Iterate, Optimality, PredictedSet, Quality

GRID = rc.Grid((40, 40), 1.0)
BODY = rc.half_space(GRID, 1.0)
GAP = -rc.shapes.paraboloid(GRID, radius=200.0).heights
GAP -= GAP.min()
TERMS = Specification(Force(12.0))  # of which some 450 cells come into contact
LIMIT = 300  # cells up to which any prediction is good, and which are always factorised
STARTS = {
    Quality.GOOD: lambda solved: solved**0.95,  # as of a similar load
    Quality.GUESSED: lambda solved: np.where(GAP == 0, 1.0, 0.0),  # one cell, which goes too deep
    Quality.BAD: lambda solved: np.ones(GRID.shape),  # all cells, of which many have far too large a gap
}


@pytest.fixture(scope="module")
def solved():
    return rc.ActiveSet(dense_limit=0).run(BODY, GAP, TERMS, np.zeros(GRID.shape)).pressure


@pytest.fixture
def followed(monkeypatch):
    """Return what the outer iteration does: the cells of each direct solve, and of each that is screened."""
    seen = []

    def noting(name, cells_of):
        function = getattr(active_set, name)

        def noted(*given, **named):
            seen.append((name, cells_of(*given)))
            return function(*given, **named)

        monkeypatch.setattr(active_set, name, noted)

    noting("press_cells", lambda operator, separation, control, cells: len(cells))
    noting("_screened", lambda operator, iterate, conditions, predicted, limit: predicted.count)
    return seen


def first(quality, solved):
    p = STARTS[quality](solved)
    conditions = Optimality.of(BODY, TERMS, GAP)
    iterate = Iterate(
        p * (TERMS.control.value / p.sum()), BODY.apply(p * (TERMS.control.value / p.sum())), GAP
    )
    found = conditions.evaluate(iterate)
    allowed = 0.5 * TERMS.tolerance * found.scale
    return [
        conditions.predict_free_set(iterate, depth=found.depth, allowed=allowed, first=first)
        for first in (True, False)
    ]


@pytest.mark.parametrize("quality", Quality)
def test_the_quality_of_a_first_prediction(quality, solved):
    predicted, later = first(quality, solved)
    assert predicted.quality is quality
    assert later.quality is Quality.GOOD
    assert predicted.count > LIMIT


@pytest.mark.parametrize("quality", Quality)
@pytest.mark.parametrize("cheap", [True, False], ids=["cheap steps", "dear steps"])
def test_each_way_leads_to_the_same_answer(quality, cheap, solved, followed, monkeypatch):
    if cheap and not loader.is_available():
        pytest.skip("no machine code here")
    monkeypatch.setattr(active_set.tuning, "DIRECT_BESIDE_TILES", GRID.size)  # beside which tiles cost less
    if not cheap:
        monkeypatch.setattr(active_set.tuning, "SCREENING_GRID", 0)
    state = rc.ActiveSet().run(BODY, GAP, TERMS, STARTS[quality](solved))
    assert state.status.converged
    # Both displacements meet the tolerance, so that pressures differ by a few times that, see method.md, section 1.
    assert np.abs(state.pressure - solved).max() * Optimality.of(BODY, TERMS, GAP).self_influence <= 10 * (
        TERMS.tolerance * BODY.apply(solved).max()
    )
    predicted = first(quality, solved)[0].count
    direct = [count for name, count in followed if name == "press_cells"]
    screened = [count for name, count in followed if name == "_screened"]
    if cheap and quality is not Quality.GOOD:  # solved roughly, and then by a matrix of few cells alone
        assert not screened
        assert max(direct, default=0) <= LIMIT
    elif quality is Quality.BAD:  # made smaller on its matrix
        assert screened == [predicted]
        assert direct[0] < predicted
    else:
        assert not screened
        assert direct[0] == predicted


def test_a_matrix_that_is_not_definite_is_left_for_steps(solved, monkeypatch):
    def failing(*given):
        raise np.linalg.LinAlgError

    monkeypatch.setattr(active_set, "press_cells", failing)
    state = rc.ActiveSet().run(BODY, GAP, TERMS, solved)
    assert state.status.converged
    assert state.tangent is None
    assert math.isclose(state.pressure.sum(), TERMS.control.value, rel_tol=1e-12)


@dataclass
class Counted:
    """A body that states nothing about itself and counts its products."""

    body: object
    products: int = 0
    grid, weights = BODY.grid, BODY.weights

    def apply(self, pressure):
        self.products += 1
        return self.body.apply(pressure)

    def as_matrix(self, cells=None):
        return self.body.as_matrix(cells)


PEAK = 0.04  # of the elastic pressure about
EVEN = np.full(GRID.shape, 0.9 * PEAK)


@pytest.mark.parametrize(
    ("hardness", "solves", "by_depth"),
    [
        (math.inf, 1, False),
        (0.2, 1, False),
        (0.9 * PEAK, 2, False),
        (0.25 * PEAK, 1, True),
        (EVEN, 1, True),
    ],
    ids=["no hardness", "beyond all pressures", "little flows", "most of it flows", "a hardness by cell"],
)
@pytest.mark.parametrize("most", [5000, 3], ids=["to the end", "three products"])
def test_every_product_is_counted(hardness, solves, by_depth, most, monkeypatch):
    """Bounds from above cost one more solve where they are one number and few cells reach it; others the depth."""
    seen = []

    def noting(owner, name):
        function = getattr(owner, name)
        monkeypatch.setattr(owner, name, lambda *given: (seen.append(name), function(*given))[1])

    noting(active_set._Outer, "run")
    noting(active_set, "press_plastic")
    body = Counted(BODY)
    spec = Specification(TERMS.control, hardness=hardness)
    state = rc.ActiveSet(max_steps=most, dense_limit=0).run(body, GAP, spec, np.zeros(GRID.shape))
    assert state.steps == body.products
    if most > 3:
        assert state.status.converged
        assert (state.pressure <= hardness).all()
        assert seen == ["run"] * solves + ["press_plastic"] * by_depth


@pytest.mark.parametrize("hardness", [math.inf, 0.9 * PEAK], ids=["elastic", "plastic"])
def test_units_that_are_powers_of_two_change_nothing(hardness):
    """Of a body without an inverse, whose steps are made of its displacements: their first size is that of a cell."""
    lengths, moduli = 2.0**-20, 2.0**30
    fine = Counted(rc.half_space(rc.Grid(GRID.shape, lengths), moduli))
    fine.grid, fine.weights = fine.body.grid, fine.body.weights
    solver, nothing = rc.ActiveSet(dense_limit=0), np.zeros(GRID.shape)
    one = solver.run(Counted(BODY), GAP, Specification(TERMS.control, hardness=hardness), nothing)
    force = Force(TERMS.control.value * lengths**2 * moduli)
    other = solver.run(fine, GAP * lengths, Specification(force, hardness=hardness * moduli), nothing)
    assert one.status.converged
    assert other.steps == one.steps
    np.testing.assert_array_equal(other.pressure, one.pressure * moduli)


def test_a_periodic_surface_up_to_its_mean_leaves_the_cell_of_least_pressure():
    everything = np.ones((2, 3), bool)
    pressure = np.array([[3.0, 2.0, 5.0], [4.0, 1.0, 6.0]])
    left = active_set._all_but_one(PredictedSet(everything, 6, 0, everything), pressure, np)
    assert left.count == 5
    np.testing.assert_array_equal(left.free, pressure > 1)
