"""Rings about an axis: closed forms, and what the three-dimensional operator says."""

import math

import numpy as np
import pytest
from scipy.special import ellipe

import hats
import roughcontact as rc
from roughcontact.halfspace.operators.geometry import Geometry, length_scale

MODULUS = 2.0


def hertz(rings, depth=0.25, radius=1.0):
    grid = rc.RadialGrid.uniform(rings, 1.0)
    return rc.press(rc.RadialProfile(-(grid.radii**2) / (2 * radius), grid), MODULUS, depth=depth)


def test_one_disc():
    """Mean displacement 16 p a/(3 pi E*) of a uniformly loaded disc."""
    matrix = rc.ring(rc.RadialGrid([0.0, 0.7]), MODULUS).as_matrix()
    assert matrix[0, 0] == pytest.approx(16 * 0.7 / (3 * np.pi * MODULUS), rel=1e-15)


def test_uniform_pressure_on_all_rings():
    """u(r) = 4 p a E(r^2/a^2)/(pi E*), averaged over each ring by Gauss's rule (twelve points: to rounding)."""
    grid = rc.RadialGrid(np.r_[0, np.cumsum(np.linspace(0.02, 0.1, 20))])
    a = grid.edges[-1]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    inside = slice(0, 19)  # at the rim the slope is infinite, and Gauss's rule slow
    r = grid.radii[:, None] + nodes * np.diff(grid.edges)[:, None] / 2
    mean = (ellipe((r / a) ** 2) * r) @ weights / (r @ weights)
    found = rc.ring(grid, MODULUS).apply(np.ones(20))
    np.testing.assert_allclose(found[inside], (4 * a / (np.pi * MODULUS) * mean)[inside], rtol=1e-12)


def test_a_far_thin_ring_is_a_circle_of_point_loads():
    """The centre moves by 2 pi a da p/(pi E* a): a small disc inside a thin ring, to (r/a)^2 and (da/a)^2."""
    grid = rc.RadialGrid([0.0, 1e-3, 1.0, 1.001])
    assert rc.ring(grid, MODULUS).as_matrix()[0, 2] == pytest.approx(2 * 1e-3 / MODULUS, rel=2e-6)


def test_rings_of_any_width_add_up():
    """Two rings under one pressure are one ring; its mean displacement is the mean of theirs."""
    fine, coarse = rc.RadialGrid([0.1, 0.4, 0.5, 0.9]), rc.RadialGrid([0.1, 0.5, 0.9])
    matrix, areas = rc.ring(fine, MODULUS).as_matrix(), fine.cell_area
    joined = areas[:2] @ matrix[:2, :2].sum(axis=1) / areas[:2].sum()
    assert rc.ring(coarse, MODULUS).as_matrix()[0, 0] == pytest.approx(joined, rel=1e-13)


def test_hertz_at_given_depth_has_order_two_in_force():
    exact = 4 / 3 * MODULUS * 0.25**1.5
    errors = [abs(hertz(n).force / exact - 1) for n in (50, 100, 200)]
    assert errors[-1] < 6e-5
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2, atol=0.1)


def test_hertz_pressure():
    """Inside half the radius, where the edge of the contact is not felt: order two as well."""
    a, p0 = 0.5, 2 * 0.5 * MODULUS / np.pi

    def error(n):
        solution = hertz(n)
        r = solution.problem.grid.radii
        return np.abs(solution.pressure - p0 * np.sqrt(np.maximum(1 - (r / a) ** 2, 0)))[r < a / 2].max() / p0

    assert error(200) < 1e-4
    assert error(50) / error(200) > 8


def test_annulus_by_extrapolation():
    """A flat annulus of inner radius one half: 0.981017896923 of the disc's 2 E* a.

    Sharp edges make the error go with 1/n, and the next terms with 1/n^2 and 1/n^3: three steps of Richardson's
    extrapolation. The error that is left falls by a factor of sixteen with the next doubling, if they are right.
    """

    def stiffness(n):
        grid = rc.RadialGrid(np.linspace(0.5, 1.0, n + 1))
        return rc.contact_stiffness(np.ones(n, bool), grid, 1.0) / 2

    k = np.array([stiffness(n) for n in (16, 32, 64, 128, 256)])
    for order in (1, 2, 3):
        k = k[1:] + (k[1:] - k[:-1]) / (2**order - 1)
    assert k[-1] == pytest.approx(0.981017896923, abs=1e-8)


def test_annulus_by_extrapolation_with_hats():
    """The thesis' own discretisation, half hats at both edges, gives the same number."""

    def stiffness(n):
        matrix, w = hats.hat_matrix(n, n // 2)[n // 2 :, n // 2 :], hats.hat_weights(n, n // 2)[n // 2 :]
        p = np.linalg.solve(matrix / (np.pi * n), np.ones(n // 2 + 1))
        return w @ p / n**2 / 2

    k = np.array([stiffness(n) for n in (32, 64, 128, 256)])
    for order in (1, 2, 3):
        k = k[1:] + (k[1:] - k[:-1]) / (2**order - 1)
    assert k[-1] == pytest.approx(0.981017896923, abs=1e-8)


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6, 1e-9, 1e-12])
def test_a_narrow_ring_on_itself(width):
    """Width h at radius R: 2 h (ln(8 R/h) + 3/2) over pi E*.

    What follows is of the order (h/R)^2 ln(R/h) of it, less than (h/R)^1.5; the rules are good to 1e-12.
    """
    grid = rc.RadialGrid([1.0 - width / 2, 1.0 + width / 2])
    h = grid.edges[1] - grid.edges[0]  # the circles are numbers of sixteen digits
    exact = 2 * h * (math.log(8 / h) + 1.5) / (np.pi * MODULUS)
    assert rc.ring(grid, MODULUS).as_matrix()[0, 0] == pytest.approx(exact, rel=width**1.5 + 1e-12, abs=0)


def mixed(widths, rings):
    return np.cumsum(10 ** np.random.default_rng(rings).uniform(*np.log10(widths), rings + 1))


RINGS = {
    "of one width": np.linspace(0.0, 1.0, 41),
    "of 1e-2": 1 + 1e-2 * np.arange(41),
    "of 1e-5": 1 + 1e-5 * np.arange(41),
    "of 1e-9": np.r_[0.0, 1 + 1e-9 * np.arange(41)],
    "of 1e-9 to 1e-1": mixed((1e-9, 1e-1), 40),
    "wide and narrow": np.r_[0.0, np.cumsum(np.tile([0.1, 1e-9, 1e-5, 0.02, 1e-3], 8))],
    "toward an edge": 1 - np.r_[np.geomspace(1.0, 1e-10, 40), 0.0],
    "away from a hole": 1 + np.r_[0.0, np.geomspace(1e-10, 3.0, 40)],
}


def exact_means(edges, pairs):
    """Differences of discs, in arithmetic of sixty digits."""
    import mpmath

    def discs(b, a):
        b, a = sorted((mpmath.mpf(b), mpmath.mpf(a)))
        m = (b / a) ** 2 if a else 0
        second = (1 - m) * mpmath.ellipk(m) if m < 1 else 0
        return 8 * mpmath.pi / 3 * a**3 * ((1 + m) * mpmath.ellipe(m) - second)

    e = edges.tolist()
    with mpmath.workdps(60):
        for j, i in pairs:
            energy = (
                discs(e[j + 1], e[i + 1]) - discs(e[j], e[i + 1]) - discs(e[j + 1], e[i]) + discs(e[j], e[i])
            )
            area = mpmath.pi * (mpmath.mpf(e[j + 1]) ** 2 - mpmath.mpf(e[j]) ** 2)
            yield float(energy / area / mpmath.pi)


@pytest.mark.parametrize("edges", RINGS.values(), ids=RINGS)
def test_rings_of_any_widths_against_sixty_digits(edges):
    """Where discs are subtracted, 1e-3 of their product of widths leaves 1e-12; rules of integration lose less."""
    n = len(edges) - 1
    matrix = rc.ring(rc.RadialGrid(edges), 1.0).as_matrix()
    near = [(j, i) for j in range(0, n, 4) for i in range(max(0, j - 2), min(n, j + 3))]
    pairs = near + [(j, (7 * j + 3) % n) for j in range(0, n, 2)]
    found = [matrix[j, i] for j, i in pairs]
    np.testing.assert_allclose(found, list(exact_means(edges, pairs)), rtol=1e-12)


@pytest.mark.parametrize("edges", RINGS.values(), ids=RINGS)
def test_rings_of_any_widths_keep_the_contract(edges):
    """Symmetric under the areas, to rounding, and positive definite: smallest widths have smallest energies."""
    grid = rc.RadialGrid(edges)
    energy = rc.ring(grid, 1.0).as_matrix() * grid.cell_area[:, None]
    np.testing.assert_allclose(energy, energy.T, rtol=4e-15)
    scale = np.sqrt(np.diag(energy))
    np.linalg.cholesky(energy / np.outer(scale, scale))  # refuses what is not positive definite


def test_a_narrow_ring_beside_wide_ones_carries_its_part():
    """A flat disc, one of whose rings is split at 1e-9 of its radius: as stiff as before, to that, and no less."""
    edges = np.linspace(0.0, 1.0, 21)
    split = np.sort(np.r_[edges, 0.6 + 1e-9])
    whole, parts = (
        rc.contact_stiffness(np.ones(len(e) - 1, bool), rc.RadialGrid(e), 1.0) for e in (edges, split)
    )
    assert parts == pytest.approx(whole, rel=1e-8)


def test_toroid_touches_on_a_ring():
    """f = (r - R)^2/(2 rho): thin ring, d = P (2 ln(16 R/c) + 1)/(pi E*), c^2 = 4 P rho/(pi E*), F = 2 pi R P.

    The theory is the first term in c/R, here 0.02.
    """
    big, rho, line = 1.0, 1.0, MODULUS * np.pi * 1e-4
    c = math.sqrt(4 * line * rho / (np.pi * MODULUS))
    grid = rc.RadialGrid(np.r_[0.0, np.linspace(big - 3 * c, big + 3 * c, 401)])
    heights = -((grid.radii - big) ** 2) / (2 * rho)
    solution = rc.press(rc.RadialProfile(heights, grid), MODULUS, force=2 * np.pi * big * line)
    depth = line / (np.pi * MODULUS) * (2 * math.log(16 * big / c) + 1)
    assert solution.depth == pytest.approx(depth, rel=c / big)
    assert solution.spots.count == 1
    assert not solution.contact[0]
    assert solution.contact_area == pytest.approx(4 * np.pi * big * c, rel=2 * c / big)


def test_two_separate_rings_against_the_surface():
    """A wavy body of revolution on rings, and the same on a square grid: one stands on two rings.

    The staircase of the square cells limits the agreement: force and depth to a per cent at 40 cells a radius.
    """

    def profile(r):
        return 0.01 * (1 - np.cos(4 * np.pi * (r - 0.3))) / 2

    rings = rc.RadialGrid.uniform(400, 1.0)
    square = rc.Grid((240, 240), 2.0 / 240)
    y, x = (c - 1.0 for c in square.coordinates)
    r = np.hypot(y[:, None], x)
    heights = np.where(r < 1.0, -profile(r), np.nan)
    radial = rc.press(rc.RadialProfile(-profile(rings.radii), rings), MODULUS, depth=2e-3)
    plane = rc.press(rc.Surface(heights, square), MODULUS, depth=2e-3)
    assert radial.spots.count == 2
    assert plane.force == pytest.approx(radial.force, rel=0.01)
    assert plane.stiffness == pytest.approx(radial.stiffness, rel=0.01)
    assert plane.contact_area == pytest.approx(radial.contact_area, rel=0.05)


def test_a_curve_on_rings():
    """Sneddon's cone: F = (2/pi) E* d^2/tan, k = (4/pi) E* d/tan, to the order of the ring (the rim moves by one)."""
    grid = rc.RadialGrid.uniform(400, 1.0)
    curve = rc.loading_curve(rc.RadialProfile(-0.1 * grid.radii, grid), MODULUS, depths=[0.03, 0.06, 0.09])
    np.testing.assert_allclose(curve.force, 2 / np.pi * MODULUS * curve.depth**2 / 0.1, rtol=1e-2)
    np.testing.assert_allclose(curve.stiffness, 4 / np.pi * MODULUS * curve.depth / 0.1, rtol=2e-2)
    assert curve.resolved.all()


@pytest.mark.parametrize(
    "edges", [[0.0], [1.0, 0.5], [-1.0, 1.0], [0.0, np.inf], [0.0, 0.0, 1.0], [[0.0, 1.0]]], ids=str
)
def test_edges_that_are_none_are_refused(edges):
    with pytest.raises(ValueError, match="edges"):
        rc.RadialGrid(edges)


def test_what_is_no_profile_is_refused():
    grid = rc.RadialGrid.uniform(4, 1.0)
    with pytest.raises(ValueError, match=r"do not fit the grid of shape \(4,\)"):
        rc.RadialProfile(np.zeros(5), grid)
    with pytest.raises(ValueError, match="RadialGrid"):
        rc.RadialProfile(np.zeros(5), rc.Grid(5, 1.0))
    with pytest.raises(ValueError, match="RadialGrid"):
        rc.ring(rc.Grid(5, 1.0), 1.0)
    with pytest.raises(ValueError, match="operator's grid"):
        rc.press(rc.RadialProfile(np.zeros(4), grid), 1.0, force=1.0, operator=rc.line(rc.Grid(4, 1.0), 1.0))


def test_a_small_ring_in_a_large_one_keeps_its_digits():
    """Rings over six decades against sixty digits; their widths are a fifth of their radius, which costs 5^2 ulp."""
    import mpmath

    edges = np.r_[0.0, np.geomspace(1e-6, 1.0, 61)]
    matrix = rc.ring(rc.RadialGrid(edges), 1.0).as_matrix()

    def discs(b, a):
        b, a = sorted((mpmath.mpf(b), mpmath.mpf(a)))
        m = (b / a) ** 2
        second = (1 - m) * mpmath.ellipk(m) if m < 1 else 0
        return 8 * mpmath.pi / 3 * a**3 * ((1 + m) * mpmath.ellipe(m) - second)

    with mpmath.workdps(60):
        for j, i in ((1, 60), (1, 2), (5, 40), (30, 60), (60, 60)):
            energy = discs(edges[j + 1], edges[i + 1]) - discs(edges[j], edges[i + 1])
            energy -= discs(edges[j + 1], edges[i]) - discs(edges[j], edges[i])
            area = mpmath.pi * (mpmath.mpf(edges[j + 1]) ** 2 - mpmath.mpf(edges[j]) ** 2)
            assert matrix[j, i] == pytest.approx(float(energy / area / mpmath.pi), rel=2e-14)


def test_what_is_no_profile_of_numbers_is_refused():
    grid = rc.RadialGrid.uniform(3, 1.0)
    with pytest.raises(ValueError, match="real numbers"):
        rc.RadialProfile(np.zeros(3) * 1j, grid)
    assert rc.RadialProfile(np.ma.masked_array(np.zeros(3), [0, 1, 0]), grid).missing == 1


@pytest.mark.parametrize("body", [rc.line, rc.foundation, rc.half_space])
def test_rings_are_no_line_and_no_plane(body):
    with pytest.raises(ValueError, match=r"axis|axes"):
        body(rc.RadialGrid.uniform(3, 1.0), 1.0)


def test_rings_count_by_their_area():
    """Densities of the pressure: the force is the mean pressure times the area, the gap's mean that of the rings."""
    grid = rc.RadialGrid(np.r_[0, np.cumsum(np.linspace(0.001, 0.02, 90))])
    solution = rc.press(rc.RadialProfile(-(grid.radii**2) / 2, grid), MODULUS, depth=0.1)
    for histogram, mean in (
        (solution.pressure_histogram, solution.force / solution.contact_area),
        (solution.gap_histogram, solution.mean_gap / (1 - solution.contact_fraction)),
    ):
        density, edges = histogram(2000)
        middle, width = (edges[1:] + edges[:-1]) / 2, np.diff(edges)
        # Within half a bar of 1/2000 of the largest.
        assert (middle * density * width).sum() == pytest.approx(mean, abs=width[0] / 2)


def test_the_length_of_rings_is_the_side_of_a_square_of_their_area():
    assert length_scale(Geometry.RING, (3.0,)) == pytest.approx(3 * math.sqrt(math.pi), rel=1e-15)
