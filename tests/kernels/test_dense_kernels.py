"""Small dense systems in machine code, against LAPACK and NumPy."""

import numpy as np
import pytest
import scipy.linalg

pytest.importorskip("llvmlite")

import roughcontact as rc
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.kernels import loader
from roughcontact.solver import direct, tuning
from roughcontact.solver.control import Depth, Force

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")
GRID = rc.Grid((23, 31), (0.5, 0.25))


def both(monkeypatch, *problem):
    """Return the answers of machine code and of LAPACK."""
    compiled = direct.press_cells(*problem)
    monkeypatch.setattr(tuning, "COMPILED_CELLS", 0)
    return compiled, direct.press_cells(*problem)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 13, 17, 40, 131, 300])  # with and without numbers left over
@pytest.mark.parametrize("control", [Force(0.3), Depth(0.4)], ids=["force", "depth"])
def test_cells_are_pressed_as_by_lapack(monkeypatch, count, control):
    rng = np.random.default_rng(count)
    cells = np.sort(rng.choice(GRID.size, count, replace=False))
    body, rough = rc.half_space(GRID, 2.0), rng.random(GRID.shape)
    found, expected = both(monkeypatch, body, rough, control, cells)
    np.testing.assert_array_equal(found.cells, expected.cells)
    # Two eliminations of a matrix: each is off by its condition, below 200 here, times some roundings of a row.
    allowed = 200 * 10 * np.finfo(float).eps
    for name in ("pressure", "tangent"):
        ours, theirs = getattr(found, name), getattr(expected, name)
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=allowed * np.abs(theirs).max(initial=0))
    assert found.depth == pytest.approx(expected.depth, rel=allowed)
    assert found.error < allowed
    if count > 10:
        assert len(found.cells) < count


def test_where_all_cells_are_tensile_none_is_left_out(monkeypatch):
    cells = np.arange(0, GRID.size, 40)
    body, apart = rc.half_space(GRID, 2.0), np.ones(GRID.shape)
    for found in both(monkeypatch, body, apart, Depth(0.5), cells):
        np.testing.assert_array_equal(found.cells, cells)
        assert not found.pressure.any()


def test_a_deviation_is_that_of_the_answer():
    """Hilbert's matrix has a condition of 1e13, so that its residual is far above rounding; LAPACK has the same."""
    matrix, cells = scipy.linalg.hilbert(10), np.arange(10)
    body = DenseOperator(rc.Grid(10, 1.0), matrix)
    found = direct.press_cells(body, 1 - matrix.sum(axis=1), Depth(1.0), cells)
    # A sum of ten products, each rounded, in another order.
    rounding = 10 * np.finfo(float).eps * np.abs(matrix @ np.diag(np.abs(found.tangent))).sum(axis=1).max()
    assert found.error == pytest.approx(np.abs(matrix @ found.tangent - 1).max(), rel=0, abs=rounding)
    assert found.error > 1e-12


@pytest.mark.parametrize("matrix", [np.diag([1.0, -1.0, 1.0]), np.ones((3, 3)), np.full((3, 3), np.nan)])
def test_what_is_not_definite_is_an_error(matrix):
    body = DenseOperator(rc.Grid(3, 1.0), matrix)
    with pytest.raises(np.linalg.LinAlgError, match="definite"):
        direct.press_cells(body, np.zeros(3), Force(1.0), np.arange(3))


def test_a_matrix_of_any_order_and_kind_is_taken():
    """Rows that lie apart, single precision, and what must not be written to."""
    body, cells = rc.half_space(GRID, 2.0), np.arange(0, GRID.size, 40)
    rough = np.random.default_rng(0).random(GRID.shape)
    expected = direct.press_cells(body, rough, Force(0.3), cells)

    class Other:
        grid, weights = GRID, body.weights

        def as_matrix(self, cells):
            matrix = np.asfortranarray(body.as_matrix(cells))
            matrix.flags.writeable = False
            return matrix

    found = direct.press_cells(Other(), rough, Force(0.3), cells)
    np.testing.assert_array_equal(found.pressure, expected.pressure)
    single = direct.press_cells(body, rough.astype(np.float32), Force(0.3), cells)
    assert single.pressure.dtype == np.float64


@pytest.mark.parametrize("periodic", [False, True, (True, False)])
def test_matrices_are_those_of_single_values(monkeypatch, periodic):
    body = rc.half_space(rc.Grid(GRID.shape, GRID.spacing, periodic), 2.0)
    cells = np.random.default_rng(1).choice(GRID.size, 50, replace=False)
    found = body.as_matrix(cells)
    monkeypatch.setattr("roughcontact.halfspace.influence.tables.is_available", lambda: False)
    np.testing.assert_array_equal(found, body.as_matrix(cells))
