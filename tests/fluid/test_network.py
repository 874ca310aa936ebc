"""Flow through given gaps, against closed forms, bounds and an independent solution."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.fluid import network as networks, solve as solving
from roughcontact.fluid.gap_flow import GapFlow
from roughcontact.fluid.interval import bilinear_bound, flux_bound
from roughcontact.fluid.network import faces_of, flow_network, winding_network
from roughcontact.fluid.solve import solve


def through(gap, grid, axis=None, **given):
    """Return the flow through a given gap, with the contact of a flat surface as its bearer."""
    flat = rc.press(rc.Surface(np.eye(*grid.shape), grid), 1.0, depth=1e-3)
    return GapFlow(flat, np.asarray(gap, float), axis, **{"slip_length": 0.0, "tolerance": 1e-9, **given})


def period(shape, lengths=(1.0, 1.0)):
    return rc.Grid(shape, tuple(length / n for length, n in zip(lengths, shape, strict=True)), periodic=True)


def free(shape, lengths=(1.0, 1.0)):
    return replace_periodic(period(shape, lengths))


def replace_periodic(grid):
    return rc.Grid(grid.shape, grid.spacing)


def middles(n):
    return (np.arange(n) + 0.5) / n


@pytest.mark.parametrize("axis", [0, 1])
def test_gaps_in_series_and_in_parallel(axis):
    """In series the resistances of cells add, in parallel their conductances, on cells that are not square."""
    shape, lengths = (12, 7), (3.0, 1.0)
    gaps = np.random.default_rng(1).uniform(0.5, 2, shape[axis])
    field = np.broadcast_to(np.expand_dims(gaps, 1 - axis), shape)
    along, across = (
        through(field, free(shape, lengths), each).transmissivity[0, 0] for each in (axis, 1 - axis)
    )
    assert along == pytest.approx(1 / np.mean(gaps**-3.0), rel=1e-12)
    assert across == pytest.approx(np.mean(gaps**3), rel=1e-12)
    tensor = through(field, period(shape, lengths)).transmissivity
    assert tensor[axis, axis] == pytest.approx(along, rel=1e-12)
    assert tensor[1 - axis, 1 - axis] == pytest.approx(across, rel=1e-12)
    assert abs(tensor[0, 1]) < 1e-12 * along


def test_a_wave_of_the_gap():
    """Across, the mean of 1/g^3 has a closed form, to which the rectangle rule converges faster than any power."""
    eps, n = 0.5, 64
    gap = np.broadcast_to((1 + eps * np.cos(2 * np.pi * middles(n)))[:, None], (n, 4))
    tensor = through(gap, period((n, 4))).transmissivity
    assert tensor[0, 0] == pytest.approx((1 - eps**2) ** 2.5 / (1 + eps**2 / 2), rel=1e-9)
    assert tensor[1, 1] == pytest.approx(1 + 1.5 * eps**2, rel=1e-12)


def test_a_wedge_converges_with_the_square_of_the_cells():
    errors = []
    for n in (16, 64, 256):
        gap = np.broadcast_to((1 + 2 * middles(n))[:, None], (n, 3))
        errors.append(through(gap, free((n, 3)), 0).transmissivity[0, 0] / 4.5 - 1)
    assert errors[-1] == pytest.approx(1.7e-5, rel=0.05)  # 2 g1^2 g2^2/(g1 + g2) = 4.5
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])) / 2, 2, atol=0.02)


def test_a_ring_of_cells_is_of_first_order():
    """Between two circles, 2 pi/ln(r2/r1): a rim of cells is a staircase, off by less than a cell at each circle."""
    errors, counts = [], np.array([48, 96, 192])
    for n in counts:
        x = middles(n) * 2 - 1
        r = np.hypot(*np.meshgrid(x, x, indexing="ij"))
        flow = through(np.ones((n, n)), rc.Grid((n, n), 2 / n), between=(r < 0.5, r > 1 - 1e-9))
        errors.append(flow.transmissivity[0, 0] / (2 * np.pi / np.log(2)) - 1)
    assert np.all(np.abs(errors) < (1 / 0.5 + 1 / 1) * (2 / counts) / np.log(2))
    np.testing.assert_allclose(np.divide(errors[:-1], errors[1:]), 2, rtol=0.1)


def ringed(gap, rings):
    """Return the flow through a given gap of rings."""
    cone = rc.press(rc.RadialProfile(-rings.radii, rings), 1.0, depth=0.0)
    return GapFlow(cone, np.asarray(gap, float), None, slip_length=0.0, tolerance=1e-9)


def test_rings_of_constant_gap_add_their_resistances():
    """Of any widths; of equal gap they are one ring, and the pressure falls with the logarithm of the radius."""
    rng = np.random.default_rng(4)
    rings = rc.RadialGrid(np.cumsum(rng.uniform(0.5, 2, 9)))
    gap, logs = rng.uniform(0.5, 2, 8), np.diff(np.log(rings.edges))
    flow, even = ringed(gap, rings), ringed(np.full(8, 2.0), rings)
    assert flow.transmissivity[0, 0] == pytest.approx(logs.sum() / np.sum(logs / gap**3), rel=1e-12)
    assert flow.residual < 1e-12
    assert flow.interval == (flow.lower_transmissivity, flow.transmissivity)
    assert even.hydraulic_gap == pytest.approx(2, rel=1e-12)
    expected = np.log(rings.edges[-1] / rings.radii) / logs.sum()
    np.testing.assert_allclose(even.pressure(), expected, rtol=1e-12)


def test_a_ring_whose_gap_grows_converges_with_the_square_of_the_rings():
    """The integral of 1/(r g^3) from 1 to 4 for g = 1 + r^2/4 has a closed form in s = r^2/4."""
    s = np.array([0.25, 4.0])
    exact = np.log(4) / np.diff(0.5 * (np.log(s / (1 + s)) + 1 / (1 + s) + 0.5 / (1 + s) ** 2))[0]
    errors = []
    for n in (16, 64, 256):
        rings = rc.RadialGrid(np.linspace(1, 4, n + 1))
        errors.append(ringed(1 + rings.radii**2 / 4, rings).transmissivity[0, 0] / exact - 1)
    assert 0 < errors[-1] < 3e-5
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])) / 2, 2, atol=0.02)


def test_one_closed_ring_seals():
    gap = np.ones(8)
    gap[3] = 0
    flow = ringed(gap, rc.RadialGrid(np.linspace(1, 2, 9)))
    assert not flow.percolates
    assert flow.transmissivity.tolist() == [[0]]
    assert np.isnan(flow.pressure()).all()
    assert any("No open path" in note for note in flow.notes)


@pytest.mark.parametrize("contrast", [10, 100])
def test_a_checkerboard_lies_in_the_interval(contrast):
    """Exactly the geometric mean of both conductances (Keller)."""
    n = 32
    board = np.add.outer(np.arange(n) // 8, np.arange(n) // 8) % 2
    flow = through(np.where(board, 1.0, contrast) ** (1 / 3), period((n, n)))
    low, high = (np.trace(each) / 2 for each in flow.interval)
    assert np.trace(flow.transmissivity) / 2 < low < np.sqrt(contrast) < high


def test_duality():
    """The tensor of m is that of 1/m turned by a quarter and inverted, to the error of the grid."""
    errors = []
    for n in (16, 32, 64):
        x, y = np.meshgrid(middles(n), middles(n), indexing="ij")
        m = np.exp(np.sin(2 * np.pi * (x + 2 * y)) + np.cos(2 * np.pi * x))
        a, b = (through(each ** (1 / 3), period((n, n))).transmissivity for each in (m, 1 / m))
        turn = np.array([[0.0, -1.0], [1.0, 0.0]])
        dual = turn @ np.linalg.inv(b) @ turn.T
        errors.append(np.linalg.norm(a - dual) / np.linalg.norm(a))
    assert errors[2] < errors[1] / 3 < errors[0] / 9


def test_a_quarter_turn_of_the_map_turns_the_tensor():
    gap = np.exp(np.random.default_rng(2).normal(size=(20, 14)))
    gap[gap < 0.5] = 0
    here = through(gap, period((20, 14))).transmissivity
    turned = through(np.rot90(gap), period((14, 20))).transmissivity
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    np.testing.assert_allclose(turned, turn @ here @ turn.T, atol=1e-10 * np.trace(here))


def test_a_diagonal_channel_winds_along_both_axes():
    n = 24
    i, j = np.indices((n, n))
    gap = np.where((i - j) % n < 3, 1.0, 0.0)
    flow = through(gap, period((n, n)))
    assert flow.windings.tolist() in ([[1, 1]], [[-1, -1]])
    assert any("percolate along" in note for note in flow.notes)
    values, vectors = np.linalg.eigh(flow.transmissivity)
    assert abs(values[0]) < 1e-12 * values[1]
    np.testing.assert_allclose(np.abs(vectors[:, 1]), np.sqrt(0.5), rtol=1e-9)
    assert flow.residual < 1e-9


def test_cells_that_touch_at_a_corner_do_not_join():
    gap = np.kron([[1, 0], [0, 1]], np.ones((4, 4)))
    flow = through(gap, period((8, 8)))
    assert not flow.percolates
    assert flow.transmissivity.tolist() == [[0, 0], [0, 0]]
    assert flow.residual == 0
    assert flow.constriction is None
    assert flow.hydraulic_gap == 0
    assert any("No open path" in note for note in flow.notes)


def test_two_rows_of_cells_on_a_period():
    """The faces within and across the border join the same cells."""
    gap = np.ones((2, 2))
    np.testing.assert_allclose(through(gap, period((2, 2))).transmissivity, np.eye(2), rtol=1e-12)


def dense(gap, grid):
    """Return the tensor by a dense pseudo-inverse, face by face."""
    n, m, size = *grid.shape, grid.size
    laplacian, drive = np.zeros((size, size)), np.zeros((size, 2))
    energy = np.zeros((2, 2))
    conductance = gap**3
    for i in range(n):
        for j in range(m):
            for axis, (k, o) in enumerate((((i + 1) % n, j), (i, (j + 1) % m))):
                a, b = conductance[i, j], conductance[k, o]
                if a * b == 0:
                    continue
                t = 2 * a * b / (a + b) * grid.spacing[1 - axis] / grid.spacing[axis]
                p, q, h = i * m + j, k * m + o, grid.spacing[axis]
                laplacian[p, p] += t
                laplacian[q, q] += t
                laplacian[p, q] -= t
                laplacian[q, p] -= t
                drive[p, axis] += t * h
                drive[q, axis] -= t * h
                energy[axis, axis] += t * h * h
    return (energy - drive.T @ np.linalg.pinv(laplacian, rcond=1e-11) @ drive) / grid.area


@pytest.mark.parametrize("seed", range(12))
def test_random_gaps_against_a_dense_solution(seed):
    rng = np.random.default_rng(seed)
    shape = tuple(rng.integers(3, 9, 2))
    grid = period(shape, tuple(rng.uniform(0.5, 2, 2)))
    gap = np.exp(rng.normal(size=shape))
    gap[rng.random(shape) < rng.uniform(0, 0.5)] = 0
    expected = dense(gap, grid)
    found = through(gap, grid).transmissivity
    np.testing.assert_allclose(found, expected, atol=1e-9 * max(1, np.abs(expected).max()))


def both_bounds(gap, grid, axis=None):
    flow = through(gap, grid, axis)
    if not flow.percolates:
        return None
    return flow.lower_transmissivity, flow.transmissivity, *flow.interval


def holds(lower, upper, slack=1e-9):
    return np.linalg.eigvalsh(upper - lower)[0] >= -slack * np.linalg.norm(upper)


def interval_of(gap, grid):
    """Return the network of a period, its flow, and both bounds of the gap that is constant in each cell."""
    network, _ = flow_network(gap**3, grid, None, None)
    if network is None:
        return None
    flow = solve(network, 1e-9)
    return network, flow, flux_bound(network, flow.flow, gap**3, grid), bilinear_bound(gap**3, grid, None)


def test_both_brackets_contain_the_truth_in_random_gaps():
    """The dense solution lies between the bounds from a poor potential, the finer cells' bounds in the interval."""
    rng, flows = np.random.default_rng(5), 0
    for k in range(500):
        shape, sides = rng.integers(2, 7, 2), rng.uniform(0.5, 2, 2)
        grid = period(tuple(shape), tuple(sides))
        gap = np.exp(rng.normal(size=shape))
        gap[rng.random(shape) < rng.uniform(0, 0.6)] = 0
        truth, found = dense(gap, grid) * grid.area, interval_of(gap, grid)
        if found is None:
            assert np.abs(truth).max() <= 1e-9 * gap.max() ** 3
            continue
        flows += 1
        network, flow, low, high = found
        poor = flow.potential + 0.1 * rng.normal(size=flow.potential.shape)
        bounds = solving._between_bounds(network, poor, solving._Repair(network))
        assert bounds.gap > 1e-4
        # The dense solution is a difference of numbers of the size of the largest conductance.
        rounding = 1e-10 * gap.max() ** 3 * np.eye(2)
        assert holds(bounds.lower, truth + rounding)
        assert holds(truth, bounds.upper + rounding)
        assert holds(flow.lower, flow.upper)
        assert holds(flow.upper, low)
        assert holds(low, high)
        if k % 10 == 0:
            finer = interval_of(np.kron(gap, np.ones((3, 3))), period(tuple(3 * shape), tuple(sides)))
            assert holds(low, finer[2])
            assert holds(finer[2], finer[3])
            assert holds(finer[3], high)
    assert flows > 250


@pytest.mark.parametrize("axis", [0, 1])
def test_bounds_from_side_to_side(axis):
    rng = np.random.default_rng(6)
    for _ in range(50):
        shape = tuple(rng.integers(2, 8, 2))
        gap = np.exp(rng.normal(size=shape))
        gap[rng.random(shape) < 0.3] = 0
        found = both_bounds(gap, free(shape, (1.0, 2.0)), axis)
        if found is not None:
            lower, upper, flux, bilinear = found
            assert holds(lower, upper)
            assert holds(upper, lower)
            assert holds(upper, flux)
            assert holds(flux, bilinear)


CAUGHT = (
    *(lambda axis=axis: test_gaps_in_series_and_in_parallel(axis) for axis in (0, 1)),
    *(lambda seed=seed: test_random_gaps_against_a_dense_solution(seed) for seed in range(4)),
)


@pytest.mark.parametrize("wrong", ["arithmetic", "of the mean gap", "sides", "one per mille", "border"])
def test_a_wrong_conductance_is_found(monkeypatch, wrong):
    """Planted: another mean, sides of cells exchanged, all faces along x or across the border off by 0.1 %."""
    right = networks.faces_of

    def planted(conductance, grid):
        if wrong == "sides":
            return right(conductance, replace_sides(grid))
        faces = right(conductance, grid)
        a, b = conductance.ravel()[faces.first], conductance.ravel()[faces.second]
        wide = np.where(faces.axis == 0, grid.spacing[1] / grid.spacing[0], grid.spacing[0] / grid.spacing[1])
        found = {
            "arithmetic": 0.5 * (a + b) * wide,
            "of the mean gap": (0.5 * (np.cbrt(a) + np.cbrt(b))) ** 3 * wide,
            "one per mille": faces.conductance * np.where(faces.axis == 1, 1.001, 1),
            "border": faces.conductance * np.where(faces.wraps, 1.001, 1),
        }
        return replace(faces, conductance=found[wrong])

    for test in CAUGHT:
        test()
    monkeypatch.setattr("roughcontact.fluid.network.faces_of", planted)
    found = 0
    for test in CAUGHT:
        try:
            test()
        except AssertionError:
            found += 1
    assert found >= 4


def replace_sides(grid):
    return rc.Grid(grid.shape, grid.spacing[::-1], periodic=all(grid.periodic))


def test_an_unfinished_potential_is_bounded():
    """Bounds from any potential enclose the solution: a repaired flow has no sources."""
    rng = np.random.default_rng(7)
    grid = period((16, 12))
    gap = np.exp(rng.normal(size=grid.shape))
    network, _ = winding_network(faces_of(gap**3, grid), grid)
    exact = solve(network, 1e-12)
    repair = solving._Repair(network)
    for scale in (1.0, 1e-2, 1e-5):
        guess = exact.potential + scale * rng.normal(size=exact.potential.shape)
        found = solving._between_bounds(network, guess, repair)
        assert holds(exact.upper, found.upper)
        assert holds(found.lower, exact.upper)
        assert np.abs(network.surplus(found.flow)).max() < 1e-12 * np.abs(found.flow).max()
    assert found.gap < 1e-6
