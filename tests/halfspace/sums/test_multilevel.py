"""Multi-level multi-integration: its error, its symmetry, and what it is made of."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.sums import near_sum
from roughcontact.halfspace.sums.levels import Kernel, LevelSum, coarsen
from roughcontact.halfspace.sums.multilevel import Multilevel
from roughcontact.halfspace.sums.transfer import NodeGrid, coarse_count, interpolation, offset_weights
from roughcontact.kernels import loader

# What is said of order 8 with near 10: of the largest displacement, and of every displacement by itself under a
# pressure that is nowhere negative.
OF_THE_LARGEST, OF_EACH = 5e-6, 5e-5
GRIDS = {
    "square": ((129, 129), (1.0, 1.0)),
    "oblong cells": ((100, 150), (0.3, 0.5)),
    "cells nearly square": ((90, 110), (1.0, 1.4)),
    "slender cells": ((300, 40), (0.05, 1.0)),
    "needles": ((24, 400), (1.0, 0.01)),
    "a strip too narrow to coarsen": ((13, 300), (1.0, 1.0)),
    "a row": ((1, 2000), (1.0, 1.0)),
}


def pressures(shape):
    """Pressures that do not vanish at the edges, and two that do."""
    rng = np.random.default_rng(0)
    y, x = (np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in shape)
    edges = np.zeros(shape)
    edges[0], edges[-1], edges[:, 0], edges[:, -1] = 1.0, 2.0, 3.0, 4.0
    corner = np.zeros(shape)
    corner[-1, 0] = 1.0
    return {
        "uniform": np.ones(shape),
        "tilted": 3 + 2 * y[:, None] + x,
        "random": rng.random(shape),
        "scattered": np.where(rng.random(shape) < 0.01, rng.random(shape), 0.0),
        "edges": edges,
        "a corner": corner,
        "of both signs": rng.standard_normal(shape),
        "Hertz": np.sqrt(np.maximum(0.0, 1 - y[:, None] ** 2 - x**2)),
    }


@pytest.mark.parametrize("name", GRIDS)
def test_error(name):
    shape, spacing = GRIDS[name]
    operator = rc.half_space(rc.Grid(shape, spacing), 2.0, method="multilevel")
    assert len(operator._sum.components[0].levels) >= 2
    for pressure in pressures(shape).values():
        exact = operator.exact.apply(pressure)
        error = np.abs(operator.apply(pressure) - exact)
        assert error.max() <= OF_THE_LARGEST * np.abs(exact).max()
        if (pressure >= 0).all():
            assert (error <= OF_EACH * exact).all()


def test_error_on_a_line():
    """Also the one that a longer reference makes: a constant, which interpolation keeps."""
    grid = rc.Grid(3000, 0.5)
    operator = rc.line(grid, 2.0, method="multilevel")
    large = rc.line(grid, 2.0, method="multilevel", reference_length=1e6 * 1500)
    assert len(operator.plane._sum.components[0].levels) >= 2
    assert rc.line(grid, 2.0).capabilities.exact is None
    for pressure in pressures((1, 3000)).values():
        exact = operator.capabilities.exact.apply(pressure[0])
        found = operator.apply(pressure[0])
        assert np.abs(found - exact).max() <= 1e-6 * np.abs(exact).max()
        shift = 2 * np.log(1e6) * pressure.sum() * 0.5 / (np.pi * 2.0)
        np.testing.assert_allclose(
            large.apply(pressure[0]) - found, shift, rtol=0, atol=1e-11 * np.abs(shift)
        )


def test_error_of_every_entry():
    """The whole matrix: every displacement under every pressure that is nowhere negative is as exact as its entries.

    That they are positive, too, is what the window of contact rests on.
    """
    operator = rc.half_space(rc.Grid((36, 30), (1.0, 1.2)), 2.0, method="multilevel")
    assert len(operator._sum.components[0].levels) == 2
    loads = np.eye(operator.grid.size).reshape(-1, *operator.grid.shape)
    matrix = np.array([operator.apply(load).ravel() for load in loads])
    np.testing.assert_allclose(matrix, operator.as_matrix(), rtol=OF_EACH, atol=0)
    np.testing.assert_allclose(matrix, matrix.T, rtol=0, atol=1e-15 * matrix.max())


def test_error_falls_with_order_and_reach():
    operator = rc.half_space(rc.Grid((140, 90), 1.0), 1.0)
    pressure = pressures((140, 90))["random"]
    exact = operator.apply(pressure)

    def error(order, near):
        return (
            np.abs(replace(operator, summation=Multilevel(order, near)).apply(pressure) - exact).max()
            / exact.max()
        )

    # About twice what benchmarks/operators.py finds at 512 x 512.
    errors = [error(4, 4), error(6, 6), error(8, 10), error(10, 14), error(12, 30)]
    np.testing.assert_array_less(errors, [1e-3, 1e-4, 1.2e-6, 2e-8, 1e-10])


@pytest.mark.parametrize("shape", [(90, 70), (40, 300)])
def test_symmetric_and_linear_to_rounding(shape):
    operator = rc.half_space(rc.Grid(shape, (0.3, 0.5)), 2.0, method="multilevel")
    p, q = np.random.default_rng(0).standard_normal((2, *shape))
    u, v = operator.apply(p), operator.apply(q)
    size = np.linalg.norm(p) * np.linalg.norm(u)
    assert abs(np.vdot(u, q) - np.vdot(p, v)) <= 1e-14 * size
    np.testing.assert_allclose(
        operator.apply(2 * p - 3 * q), 2 * u - 3 * v, rtol=0, atol=1e-13 * np.abs(u).max()
    )


def test_equal_to_its_restriction():
    operator = rc.half_space(rc.Grid((80, 90), (0.3, 0.5)), 2.0, method="multilevel")
    window = (slice(20, 80), slice(5, 71))
    inside = np.zeros((80, 90))
    inside[window] = np.random.default_rng(0).random((60, 66))
    part, whole = operator.restrict(window).apply(inside[window]), operator.apply(inside)[window]
    np.testing.assert_allclose(part, whole, rtol=0, atol=2 * OF_THE_LARGEST * whole.max())


def test_what_else_it_can_do_is_exact():
    """Matrices, lists of cells and inverses are those of the transforms; coarser cells are summed the same way."""
    operator = rc.half_space(rc.Grid((40, 30), (0.3, 0.5)), 2.0, method="multilevel")
    cells = np.array([3, 77, 500, 1199])
    np.testing.assert_array_equal(operator.as_matrix(cells), operator.exact.as_matrix(cells))
    np.testing.assert_array_equal(operator.submatrix(cells).as_matrix(), operator.exact.as_matrix(cells))
    u = np.random.default_rng(0).random((40, 30))
    np.testing.assert_array_equal(operator.approximate_inverse(u), operator.exact.approximate_inverse(u))
    coarse = operator.coarsened(rc.Grid((20, 15), (0.6, 1.0)))
    assert coarse.summation == Multilevel()
    np.testing.assert_array_equal(coarse.as_matrix(), rc.half_space(coarse.grid, 2.0).as_matrix())


def test_scale_laws():
    p = np.random.default_rng(0).random((40, 30))
    base = rc.half_space(rc.Grid((40, 30), (0.3, 0.5)), 2.0, method="multilevel").apply(p)
    small = rc.half_space(rc.Grid((40, 30), (3e-7, 5e-7)), 2e11, method="multilevel").apply(p)
    np.testing.assert_allclose(small, 1e-17 * base, rtol=1e-12)


def operations(n, shape):
    """Multiplications of a product: of the near pairs and of the coarsest matrix."""
    nodes, kernel, count = NodeGrid(shape(n), (1.0, 1.0)), Kernel(lambda y, x: 1 / np.hypot(y, x + 0.5)), 0
    while nodes.size > 512:
        level, coarser, kernel = coarsen(nodes, kernel, 8, 10)
        count += nodes.size * np.count_nonzero(level.taps) / 2
        nodes = coarser
    return count + nodes.size**2


@pytest.mark.parametrize("shape", [lambda n: (n, n), lambda n: (n, 2 * n), lambda n: (1, 32 * n)])
def test_work_grows_as_the_number_of_cells(shape):
    work = operations(2048, shape) / operations(256, shape)
    cells = np.prod(shape(2048)) / np.prod(shape(256))
    assert np.log(work) / np.log(cells) < 1.02


class TestTransfer:
    @pytest.mark.parametrize("count", [1, 2, 9, 10])
    @pytest.mark.parametrize("order", [2, 4, 8])
    def test_polynomials_are_kept(self, count, order):
        """Below the order; and every node of the ring is needed, none is missing."""
        matrix = interpolation(count, order).toarray()
        assert matrix.shape == (count, coarse_count(count, order))
        coarse = 2.0 * (np.arange(matrix.shape[1]) + 1) - order
        for power in range(order):
            scale = np.abs(coarse).max() ** power
            np.testing.assert_allclose(
                matrix @ coarse**power, np.arange(count) ** power, rtol=0, atol=1e-13 * scale
            )
        assert count < 3 or matrix.any(axis=0).all()

    @pytest.mark.parametrize("sign", [1, -1])
    def test_offsets(self, sign):
        """Both indices of a kernel interpolated, against the matrices written out."""
        order, reach = 4, 7
        matrix = interpolation(2 * reach + 4, order).toarray()
        lag = np.subtract.outer(np.arange(matrix.shape[1]), np.arange(matrix.shape[1])).T
        values = np.random.default_rng(0).random(matrix.shape[1]) * (np.arange(matrix.shape[1]) > (sign < 0))
        both = matrix @ (values[abs(lag)] * np.where(lag < 0, sign, 1)) @ matrix.T
        weights = offset_weights(reach, order, sign)
        for parity in range(2):
            target = reach + 1 + parity  # an even one
            smooth = weights[parity] @ values[: weights.shape[2]]
            np.testing.assert_allclose(both[target, target : target + reach + 1], smooth, atol=1e-14)
            np.testing.assert_allclose(
                both[target, target - reach : target + 1][::-1], sign * smooth, atol=1e-14
            )

    def test_the_finer_axis_goes_first(self):
        nodes = NodeGrid((100, 100), (0.3, 1.0))
        assert nodes.steps(8) == (2, 1)
        assert nodes.coarsened((2, 1), 8) == NodeGrid((57, 100), (0.6, 1.0))
        assert NodeGrid((57, 100), (0.6, 1.0)).steps(8) == (2, 1)
        assert NodeGrid((35, 100), (1.2, 1.0)).steps(8) == (2, 2)
        assert NodeGrid((14, 100), (0.3, 1.0)).steps(8) == (1, 2)
        assert NodeGrid((14, 1), (0.3, 1.0)).steps(8) == (1, 1)


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (0.3, 0.5)])
def test_kernels_that_are_odd_along_both_axes(spacing):
    """As the coupling of the components of a tangential traction is: here x y/r^3 of point loads."""

    def at(rows, columns):
        y, x = rows * spacing[0], columns * spacing[1]
        return x * y / np.maximum(np.hypot(x, y), spacing[0]) ** 3

    nodes, kernel = NodeGrid((40, 50), spacing), Kernel(at, sign=-1)
    y, x = np.divmod(np.arange(2000), 50)
    rows, columns = y[:, None] - y, x[:, None] - x
    matrix = at(abs(rows), abs(columns)) * np.sign(rows) * np.sign(columns)
    np.testing.assert_array_equal(kernel.matrix(nodes.shape), matrix)
    hierarchy = LevelSum.of(kernel, nodes, order=8, near=10)
    assert len(hierarchy.levels) >= 2
    for load in np.random.default_rng(0).random((2, 40, 50)):
        exact = (matrix @ load.ravel()).reshape(40, 50)
        np.testing.assert_allclose(hierarchy.product(load), exact, rtol=0, atol=1e-5 * np.abs(exact).max())


class TestNearField:
    CASES = (
        ((17, 23), (2, 2, 5, 7)),
        ((8, 9), (2, 2, 11, 21)),  # reaches beyond all edges
        ((1, 50), (1, 2, 1, 21)),
        ((30, 3), (2, 1, 4, 3)),
        ((3, 1100), (2, 2, 4, 9)),  # several portions of a row
    )

    @pytest.mark.parametrize("sign", [1, -1])
    @pytest.mark.parametrize(("shape", "taps"), CASES)
    @pytest.mark.parametrize("way", ["compiled", "products"])
    def test_against_the_sum_written_out(self, shape, taps, way, sign):
        rng = np.random.default_rng(0)
        field, weights, total = rng.random(shape), rng.random(taps), rng.random(shape)
        weights[rng.random(taps) < 0.2] = 0.0
        reach, side = taps[2] - 1, taps[3] // 2
        expected = total.copy()
        padded = np.pad(field, ((reach, reach), (side, side)))
        for y, x in np.ndindex(shape):
            box = padded[y : y + 2 * reach + 1, x : x + 2 * side + 1]
            down = weights[y % taps[0], x % taps[1]]
            expected[y, x] += (down * box[reach:]).sum() + sign * (down[1:] * box[:reach][::-1]).sum()
        if way == "compiled":
            if not loader.is_available():
                pytest.skip("no machine code here")
            near_sum.add_near(field, weights, sign, total)
        else:
            near_sum.add_near_by_products(field, weights, sign, total)
        np.testing.assert_allclose(total, expected, rtol=0, atol=1e-14 * weights.sum())


def test_rows_in_several_portions_are_summed_as_in_one(monkeypatch):
    rng = np.random.default_rng(0)
    field, weights = rng.random((70, 45)), rng.random((2, 2, 5, 7))
    totals = np.zeros((2, 70, 45))
    near_sum.add_near(field, weights, -1, totals[0])
    monkeypatch.setattr(near_sum, "CELLS", 1)
    near_sum.add_near(field, weights, -1, totals[1])
    np.testing.assert_array_equal(*totals)


def test_the_same_without_machine_code(monkeypatch):
    operator = rc.half_space(rc.Grid((80, 60), 1.0), 1.0, method="multilevel")
    pressure = np.random.default_rng(0).random((80, 60))
    with_code = operator.apply(pressure)
    monkeypatch.setattr(loader, "is_available", lambda: False)
    np.testing.assert_allclose(operator.apply(pressure), with_code, rtol=1e-13)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"order": 7}, "even, from 2 to 16, not 7"),
        ({"order": 0}, "even, from 2 to 16, not 0"),
        ({"order": 18, "near": 40}, "even, from 2 to 16, not 18"),
        ({"order": 8, "near": 6}, "at least 7, .* not 6"),
    ],
)
def test_nonsense_is_refused(settings, message):
    with pytest.raises(ValueError, match=message):
        Multilevel(**settings)
