"""Printed equations of appendix A on the sums that are wrong, and the right ones."""

import numpy as np
import oracles
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipk

import hats
import roughcontact as rc

N = 40


def test_a_1_3_step_of_conjugate_gradients():
    """alpha = r.r/(d.q) with q = A d. Printed: r.r/(d.d), and r - alpha d: it "converges" to p0 + r0 in one step."""

    def printed(matrix, right, start):
        p, r = start.copy(), right - matrix @ start
        d = r.copy()
        for _ in range(100):
            alpha = (r @ r) / (d @ d)
            p, following = p + alpha * d, r - alpha * d
            if np.abs(following).max() < 1e-12:
                return p
            d = following + (following @ following) / (r @ r) * d
            r = following
        return p

    matrix = rc.half_space(rc.Grid((5, 5), 1.0), 1.0).as_matrix()
    right, start = np.ones(25), np.zeros(25)
    wrong = printed(matrix, right, start)
    np.testing.assert_allclose(wrong, start + right)  # whatever the matrix is, and in units of a length
    assert np.abs(matrix @ wrong - right).max() > 1
    found = rc.prescribed_displacement(
        np.ones((5, 5), bool), 1.0, operator=rc.half_space(rc.Grid((5, 5), 1.0), 1.0), tolerance=1e-12
    )
    assert np.abs(matrix @ found.pressure.ravel() - right).max() < 1e-11


def test_a_26_argument_of_the_elliptic_integral():
    """K(2 sqrt(r/a)/(1 + r/a)); printed 2 sqrt(r/(1 + r/a)), which has a unit and exceeds one."""

    def printed(r, a):
        return 2 * np.sqrt(r / (1 + r / a))

    a, r = 3.0, 2.0
    ring = quad(lambda phi: a / np.sqrt(a * a + r * r - 2 * a * r * np.cos(phi)), 0, 2 * np.pi)[0]
    assert hats.u0(r, a) == pytest.approx(ring, rel=1e-10)
    right = 2 * np.sqrt(r / a) / (1 + r / a)
    assert 4 / (1 + r / a) * ellipk(right**2) == pytest.approx(ring, rel=1e-10)
    assert printed(r, a) > 1
    assert printed(10 * r, 10 * a) != pytest.approx(printed(r, a))


def row_sums(matrix):
    """Error of the displacement under a uniform pressure on [0, N], 4 N E(m = (j/N)^2) in units of the step."""
    exact = 4 * N * ellipe((np.arange(N + 1) / N) ** 2)
    return np.abs(matrix.sum(axis=1) / exact - 1)


def test_a_36_uniform_pressure():
    assert row_sums(hats.hat_matrix(N)).max() < 1e-12


def test_a_27_a_30_to_a_32_have_a_step_too_many():
    """u = (1/pi E*) int P u0 da. Printed with a further step D: it then scales with the square of the size."""
    for step in (0.5, 1.0, 2.0):
        u = step / np.pi * hats.hat_matrix(N).sum(axis=1)
        exact = 4 * N * step * ellipe((np.arange(N + 1) / N) ** 2) / np.pi
        np.testing.assert_allclose(u, exact, rtol=1e-12)
        printed = step * u
        assert step == 1 or np.abs(printed / exact - 1).min() > 0.4


def test_a_31_to_a_35_the_sum_starts_at_zero():
    """Printed from i = 1: the hat at the centre is lost, 1.25 % of the displacement there with 40 nodes."""
    printed = hats.hat_matrix(N)
    printed[:, 0] = 0
    assert row_sums(printed)[0] == pytest.approx(np.pi / (2 * np.pi * N), rel=1e-9)


def test_a_36_the_limits_are_exchanged():
    """At i = 0 the lower limit becomes 0, at i = N the upper one N. The text exchanges the two.

    With the upper limit of the last hat at N + 1 the uniform pressure reaches beyond the disc.
    """
    wider = hats.hat_matrix(N + 1)[: N + 1, : N + 1]  # the whole hat at N
    assert row_sums(wider).max() > 0.01
    assert row_sums(hats.hat_matrix(N)).max() < 1e-12


def test_a_36_is_no_symmetric_matrix():
    """Nor under its weights: B[j, i] of the thesis is the transpose of what acts on the pressure."""
    matrix = hats.hat_matrix(N)
    assert row_sums(matrix.T).max() > 0.5
    first = [1.1680688116, 7.0027856405, 6.8780313525, 6.4829419450, 6.3886068239, 6.3488688118, 3.1666295057]
    np.testing.assert_allclose(hats.hat_matrix(6)[1], first, rtol=1e-10)


def line_by_quadrature(pressure, x, a):
    """-2 int p ln|x - s| ds over [-a, a], split at x."""
    f = lambda s: -2 * pressure(s) * np.log(abs(x - s))  # noqa: E731
    return quad(f, -a, x, limit=200)[0] + quad(f, x, a, limit=200)[0]


def test_a_40_to_a_42_have_a_step_too_many():
    """u = -(2/pi E*) int p ln|x - s| ds + C: twice the size, twice the difference of displacements, not four times."""

    def difference(scale):
        grid = rc.Grid(200, 0.01 * scale)
        p = np.sqrt(np.maximum(1 - (grid.coordinates[0] / scale - 1) ** 2, 0))
        u = rc.line(grid, 1.0).apply(p)
        return u[100] - u[0]

    assert difference(2.0) == pytest.approx(2 * difference(1.0), rel=1e-12)
    printed = [scale * difference(scale) for scale in (1.0, 2.0)]
    assert printed[1] == pytest.approx(4 * printed[0], rel=1e-12)


def test_a_45_and_a_46_lost_a_factor_minus_two():
    """As printed a load lifts the surface, by half. Under Hertz's pressure u(0) - u(a) is +1 in units of p0 a/E*."""

    def printed(k):
        squares = [
            (k + s) ** 2 * np.log(np.abs(k + s), where=k + s != 0, out=np.zeros(len(k))) for s in (1, 0, -1)
        ]
        return (squares[0] - 2 * squares[1] + squares[2] - 3) / 2

    grid = rc.Grid(401, 2.0 / 400)
    x = grid.coordinates[0] - grid.lengths[0] / 2
    p = np.sqrt(np.maximum(1 - x**2, 0))
    u = rc.line(grid, 1.0).apply(p)
    offsets = np.abs(np.arange(401)[:, None] - np.arange(401)).astype(float)
    wrong = grid.spacing[0] / np.pi * printed(offsets.ravel()).reshape(401, 401) @ p
    exact = (
        line_by_quadrature(lambda s: np.sqrt(1 - s * s), 0.0, 1)
        - line_by_quadrature(lambda s: np.sqrt(1 - s * s), 0.5, 1)
    ) / np.pi
    assert u[200] - u[300] == pytest.approx(exact, abs=1e-4)
    assert wrong[200] - wrong[300] == pytest.approx(-exact / 2, abs=1e-4)
    assert u[200] - u[0] == pytest.approx(1.0, abs=1e-3)


def test_a_59_needs_the_cell_and_the_padding():
    """Printed: the transform of sampled 1/R, without its factor. It is infinite at zero, and wraps round unpadded."""
    rng = np.random.default_rng(0)
    grid = rc.Grid((24, 30), 0.5)
    p = rng.random(grid.shape)
    exact = (rc.half_space(grid, 1.0, method="dense").as_matrix() @ p.ravel()).reshape(grid.shape)
    np.testing.assert_allclose(rc.half_space(grid, 1.0).apply(p), exact, rtol=1e-12)
    np.testing.assert_allclose(oracles.displacement(grid, 1.0, p), exact, rtol=1e-12)

    def printed(padded, step):
        (my, mx) = padded
        y, x = np.minimum(np.arange(my), my - np.arange(my)), np.minimum(np.arange(mx), mx - np.arange(mx))
        with np.errstate(divide="ignore"):
            kernel = 1 / np.hypot(y[:, None], x)
        kernel[0, 0] = 4 * np.log(1 + np.sqrt(2))  # the one value that has to be replaced
        product = np.fft.irfft2(np.fft.rfft2(p, padded) * np.fft.rfft2(kernel), padded)
        return step * product[: p.shape[0], : p.shape[1]]

    factor = grid.spacing[0] / np.pi
    assert np.abs(printed((48, 60), 1.0) / exact - 1).min() > 1  # the factor
    assert np.abs(printed((24, 30), factor) / exact - 1).max() > 0.3  # the padding
    assert 1e-3 < np.abs(printed((48, 60), factor) / exact - 1).max() < 0.03  # point values in place of cells


def test_hats_and_rings_agree():
    """Two discretisations of one body: Hertz at given depth, both within their order of the closed form."""
    force = 4 / 3 * 0.25**1.5
    _, _, by_hats = hats.press(lambda r: r**2 / 2, 100, 0.25)
    grid = rc.RadialGrid.uniform(100, 1.0)
    by_rings = rc.press(rc.RadialProfile(-(grid.radii**2) / 2, grid), 1.0, depth=0.25).force
    assert by_hats == pytest.approx(force, rel=5e-4)
    assert by_rings == pytest.approx(force, rel=5e-4)
