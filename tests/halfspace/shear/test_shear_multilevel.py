"""Tangential traction summed on ever coarser grids: its error, its symmetry, and whose matrix it has."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.sums.multilevel import Multilevel
from roughcontact.kernels import loader

# What is said of order 8 with near 10, of the largest displacement: under tractions whose components are nowhere
# negative, and under noise, whose displacements cancel.
OF_THE_LARGEST, OF_NOISE = 5e-6, 2e-5
# Between any two cells, of the tensor's trace: the remainder of Lagrange's interpolation between the nodes at -7, -5,
# ..., 7, at 0, (7 * 5 * 3)^2 f^(8)/8!, for f = 1/r at r = 10, where the nearest pair lies that is not corrected.
OF_THE_TRACE = 105**2 / 10.0**8
GRIDS = {
    "square": ((129, 129), (1.0, 1.0)),
    "oblong cells": ((100, 150), (0.3, 0.5)),
    "cells nearly square": ((90, 110), (1.0, 1.4)),
    "slender cells": ((300, 40), (0.05, 1.0)),
    "needles": ((24, 400), (1.0, 0.01)),
    "a strip too narrow to coarsen": ((13, 300), (1.0, 1.0)),
    "a row": ((1, 2000), (1.0, 1.0)),
}


def tractions(shape):
    rng = np.random.default_rng(0)
    y, x = (np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in shape)
    nothing, one = np.zeros(shape), np.ones(shape)
    edges = np.zeros((2, *shape))
    edges[:, 0], edges[:, -1], edges[:, :, 0], edges[:, :, -1] = 1.0, 2.0, 3.0, 4.0
    corner = np.zeros((2, *shape))
    corner[0, -1, 0] = 1.0
    return {
        "along x": np.stack([one, nothing]),
        "along y": np.stack([nothing, one]),
        "aslant": np.stack([one, 2 * one]),
        "random": rng.random((2, *shape)),
        "scattered": np.where(rng.random((2, *shape)) < 0.01, rng.random((2, *shape)), 0.0),
        "edges": edges,
        "a corner": corner,
        "a twist": np.stack([np.broadcast_to(-y[:, None], shape), np.broadcast_to(x, shape)]),
        "noise": rng.standard_normal((2, *shape)),
    }


@pytest.mark.parametrize("nu", [-0.9, 0.5])
@pytest.mark.parametrize("name", GRIDS)
def test_error(name, nu):
    shape, spacing = GRIDS[name]
    operator = rc.shear_half_space(rc.Grid(shape, spacing), rc.Solid(2.0, nu), method="multilevel")
    assert all(len(hierarchy.levels) >= 2 for hierarchy in operator._sum.components)
    for kind, traction in tractions(shape).items():
        exact = operator.exact.apply(traction)
        error = np.abs(operator.apply(traction) - exact).max()
        largest = np.hypot(*exact).max()
        assert error <= (OF_NOISE if kind == "noise" else OF_THE_LARGEST) * largest, kind


@pytest.mark.parametrize(
    ("shape", "spacing", "nu"), [((36, 30), (1.0, 1.2), 0.5), ((40, 24), (1.0, 2.0), -0.9)]
)
def test_error_of_every_entry(shape, spacing, nu):
    """Against the full matrix: from it follows an error under any traction."""
    operator = rc.shear_half_space(rc.Grid(shape, spacing), rc.Solid(2.0, nu), method="multilevel")
    n = operator.grid.size
    loads = np.eye(n).reshape(n, *shape)
    exact = operator.as_matrix()
    blocks = {"xx": exact[:n, :n], "xy": exact[:n, n:], "yy": exact[n:, n:]}
    trace = blocks["xx"] + blocks["yy"]
    for hierarchy, block in zip(operator._sum.components, blocks.values(), strict=True):
        assert len(hierarchy.levels) == 2
        found = np.array([hierarchy.product(load).ravel() for load in loads]).T
        assert (np.abs(found - block) <= OF_THE_TRACE * trace).all()
        np.testing.assert_allclose(found, found.T, rtol=0, atol=1e-15 * trace.max())


def test_error_falls_with_order_and_reach():
    exact = rc.shear_half_space(rc.Grid((140, 90), 1.0), rc.Solid(1.0, 0.3))
    traction = tractions((140, 90))["random"]
    u = exact.apply(traction)
    settings = [(4, 4), (6, 6), (8, 10), (10, 14), (12, 30)]
    errors = [
        np.abs(replace(exact, summation=Multilevel(*chosen)).apply(traction) - u).max() / np.hypot(*u).max()
        for chosen in settings
    ]
    # About three times what benchmarks/operators.py finds of pressure at 512 x 512, and for the last the same.
    np.testing.assert_array_less(errors, [1e-3, 1e-4, 1.7e-6, 4e-8, 1e-10])


@pytest.mark.parametrize("shape", [(90, 70), (40, 300)])
def test_symmetric_and_linear_to_rounding(shape):
    operator = rc.shear_half_space(rc.Grid(shape, (0.3, 0.5)), rc.Solid(2.0, 0.4), method="multilevel")
    p, q = np.random.default_rng(0).standard_normal((2, 2, *shape))
    u, v = operator.apply(p), operator.apply(q)
    size = np.linalg.norm(p) * np.linalg.norm(u)
    assert abs(np.vdot(u, q) - np.vdot(p, v)) <= 1e-14 * size
    np.testing.assert_allclose(
        operator.apply(2 * p - 3 * q), 2 * u - 3 * v, rtol=0, atol=1e-13 * np.abs(u).max()
    )


def test_what_else_it_can_do_is_exact():
    operator = rc.shear_half_space(rc.Grid((40, 30), (0.3, 0.5)), rc.Solid(2.0, 0.3), method="multilevel")
    cells = np.array([3, 77, 500, 1199])
    np.testing.assert_array_equal(operator.as_matrix(cells), operator.exact.as_matrix(cells))
    u = np.random.default_rng(0).random((2, 40, 30))
    np.testing.assert_array_equal(operator.approximate_inverse(u), operator.exact.approximate_inverse(u))
    coarse = replace(operator, summation=Multilevel(4, 5)).restrict((slice(0, 30), slice(3, 30)))
    assert (coarse.summation, coarse.exact.grid.shape) == (Multilevel(4, 5), (30, 27))


def test_the_same_without_machine_code(monkeypatch):
    operator = rc.shear_half_space(rc.Grid((80, 60), 1.0), rc.Solid(1.0, 0.3), method="multilevel")
    traction = np.random.default_rng(0).random((2, 80, 60))
    with_code = operator.apply(traction)
    monkeypatch.setattr(loader, "is_available", lambda: False)
    np.testing.assert_allclose(operator.apply(traction), with_code, rtol=1e-12)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"order": 7}, "even, from 2 to 16, not 7"),
        ({"order": 18, "near": 40}, "even, from 2 to 16, not 18"),
        ({"order": 8, "near": 6}, "at least 7, .* not 6"),
    ],
)
def test_nonsense_is_refused(settings, message):
    with pytest.raises(ValueError, match=message):
        Multilevel(**settings)


def test_a_window_of_a_periodic_body_is_summed_too():
    periodic = rc.shear_half_space(rc.Grid((8, 8), 1.0, True), rc.Solid(1.0, 0.3))
    part = periodic.restrict((slice(0, 4), slice(0, 4)))
    traction = np.random.default_rng(0).standard_normal((2, 4, 4))
    found = replace(part, summation=Multilevel()).apply(traction)
    np.testing.assert_allclose(found, part.apply(traction), rtol=0, atol=1e-14)
