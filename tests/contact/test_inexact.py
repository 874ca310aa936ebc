"""An operator whose sum is not exact drives the iteration; the exact one certifies."""

from dataclasses import replace

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.halfspace.sums.multilevel import Multilevel

SOLVERS = {
    "active set": rc.ActiveSet(),
    "iterative": rc.ActiveSet(dense_limit=0),
    "Polonsky-Keer": rc.PolonskyKeer(),
}


@pytest.fixture(scope="module")
def rough():
    return rc.self_affine(rc.Grid((96, 80), 1e-2), hurst=0.6, rms=0.01, rng=np.random.default_rng(6))


@pytest.mark.parametrize("method", ["moving-grid", "multilevel"])
@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("load", [{"force": 4e-3}, {"depth": 0.015}], ids=str)
def test_the_certificate_is_that_of_the_exact_sum(rough, method, solver, load):
    operator = rc.half_space(rough.grid, 1.0, method=method)
    found = rc.press(rough, 1.0, **load, operator=operator, solver=SOLVERS[solver])
    assert oracles.certificate(rough, 1.0, found.pressure, found.depth) < 1.1e-8
    exact = rc.press(rough, 1.0, **load, tolerance=1e-10)
    np.testing.assert_allclose(found.pressure, exact.pressure, rtol=0, atol=1e-6 * exact.pressure.max())
    assert found.stiffness == pytest.approx(exact.stiffness, rel=1e-7)
    assert found.mean_gap == pytest.approx(exact.mean_gap, rel=1e-7)


def test_a_rough_sum_takes_more_rounds_and_ends_all_the_same(rough):
    """Order 4: wrong by a thousandth, and still certified to 1e-8."""
    operator = rc.half_space(rough.grid, 1.0, method="multilevel")
    crude = replace(operator, summation=Multilevel(order=4, near=4))
    found = rc.press(rough, 1.0, force=4e-3, operator=crude, solver=rc.ActiveSet(dense_limit=0))
    assert oracles.certificate(rough, 1.0, found.pressure, found.depth) < 1.1e-8


def test_curves_and_lines_too():
    grid = rc.Grid(3000, 1e-3)
    line = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    loads = [1e-3, 1e-2, 0.1]
    exact, found = (
        rc.loading_curve(line, 1.0, forces=loads, operator=rc.line(grid, 1.0, method=method))
        for method in ("fft", "multilevel")
    )
    np.testing.assert_allclose(found.depth, exact.depth, rtol=1e-7)
    np.testing.assert_allclose(found.stiffness, exact.stiffness, rtol=1e-6)
    assert found.residual.max() <= 1e-8
