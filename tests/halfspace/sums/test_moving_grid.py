"""The moving grid: the influence function shifted to every load; the contract of operators holds the rest."""

import numpy as np
import pytest

import roughcontact as rc


def test_one_load_shows_the_influence_function():
    """Eq. A.48 at every offset, with K00 = 4 ln(1 + sqrt 2), K10 and K11 (unit cells, pi E* = 1)."""
    operator = rc.half_space(rc.Grid((3, 4), 1.0), 1 / np.pi, method="moving-grid")
    p = np.zeros((3, 4))
    p[1, 2] = 1.0
    u = operator.apply(p)
    assert u[1, 2] == pytest.approx(4 * np.log(1 + np.sqrt(2)), rel=1e-14)
    assert u[1, 1] == u[1, 3] == u[0, 2] == u[2, 2] == pytest.approx(1.038049735904756, rel=1e-14)
    assert u[0, 1] == u[2, 3] == pytest.approx(0.724697438134330, rel=1e-14)
    assert u[1, 0] == pytest.approx(0.505091983075117, rel=1e-14)


@pytest.mark.parametrize("shape", [(17, 40), (40, 17)])
def test_equal_to_the_transforms(shape):
    """Pressures of either sign, on all edges, on a grid that is not square."""
    grid = rc.Grid(shape, (0.3, 0.5))
    p = np.random.default_rng(0).standard_normal(shape)
    moved, transformed = (
        rc.half_space(grid, 2.0, method=method).apply(p) for method in ("moving-grid", "fft")
    )
    np.testing.assert_allclose(moved, transformed, rtol=0, atol=1e-14 * np.abs(transformed).max())


def test_cells_without_pressure_cost_nothing():
    operator = rc.half_space(rc.Grid((300, 300), 1.0), 1.0, method="moving-grid")
    np.testing.assert_array_equal(operator.apply(np.zeros((300, 300))), 0.0)


def test_any_solver_runs_on_it():
    grid = rc.Grid((16, 16), 1.0)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.1, rng=np.random.default_rng(1))
    pressures = [
        rc.press(
            surface, 1.0, force=3.0, operator=rc.half_space(grid, 1.0, method=method), solver=solver
        ).pressure
        for method in ("dense", "moving-grid")
        for solver in (rc.ActiveSet(), rc.PolonskyKeer())
    ]
    for other in pressures[1:]:
        np.testing.assert_allclose(other, pressures[0], rtol=0, atol=1e-6 * pressures[0].max())


@pytest.mark.parametrize("method", ["moving-grid", "multilevel"])
def test_periodic_grids_are_refused(method):
    with pytest.raises(ValueError, match=f"'{method}' is for free grids"):
        rc.half_space(rc.Grid((8, 8), 1.0, True), 1.0, method=method)
    with pytest.raises(ValueError, match=f"'{method}' is for free grids"):
        rc.line(rc.Grid(8, 1.0, True), 1.0, method=method)
    with pytest.raises(ValueError, match="method must be one of"):
        rc.line(rc.Grid(8, 1.0), 1.0, method="dense")


@pytest.mark.parametrize("method", ["moving-grid", "multilevel"])
def test_arrays_of_others_are_refused_and_not_converted(method):
    with pytest.raises(TypeError, match="only arrays of NumPy"):
        rc.half_space(rc.Grid((2, 2), 1.0), 1.0, method=method).apply([[1.0, 2.0], [3.0, 4.0]])
