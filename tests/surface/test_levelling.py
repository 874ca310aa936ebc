"""Polynomials and round forms: what is put in comes out, and what is left is orthogonal to it."""

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((40, 56), (1e-6, 2e-6))
Y, X = ((np.arange(n) - (n - 1) / 2) * step for n, step in zip(GRID.shape, GRID.spacing, strict=True))
Y, X = np.meshgrid(Y, X, indexing="ij")
RADIUS = 4e-4


def rough(holes=True):
    heights = 1e-7 * np.random.default_rng(4).standard_normal(GRID.shape)
    if holes:
        heights[5:12, 20:50] = heights[0] = np.nan
    return heights


def dumb_polynomial(heights, degree):
    """The fit by a matrix of points times monomials."""
    y, x = (axis / np.abs(axis).max() for axis in (Y, X))
    terms = [y**a * x**b for a in range(degree + 1) for b in range(degree + 1 - a)]
    measured = ~np.isnan(heights)
    matrix = np.stack([term[measured] for term in terms], axis=1)
    return sum(
        c * t for c, t in zip(np.linalg.lstsq(matrix, heights[measured], rcond=None)[0], terms, strict=True)
    )


@pytest.mark.parametrize("degree", [0, 1, 2, 3, 5])
def test_a_polynomial_is_taken_out_like_by_the_plain_fit(degree):
    heights = rough() + 3e-6 * (X / 1e-4) ** 2 - 1e-6 * X * Y / 1e-9
    left = rc.Surface(heights, GRID).without_form(degree)
    # Both solve the same well conditioned problem; monomials of degree 5 cost the plain one three digits.
    np.testing.assert_allclose(
        left.heights,
        heights - dumb_polynomial(heights, degree),
        rtol=0,
        atol=1e-12 * np.nanmax(np.abs(heights)),
    )
    assert left.provenance[-1] == f"form removed: polynomial of degree {degree}"
    assert left.missing == np.isnan(heights).sum()


@pytest.mark.parametrize(("kind", "degree"), [("mean", 0), ("plane", 1), ("quadratic", 2)])
@pytest.mark.parametrize("offset", [0.0, 1.0])
def test_levelling_ignores_what_it_takes_out(kind, degree, offset):
    form = {0: 0 * X, 1: 0.1 * X - 0.2 * Y, 2: 30 * X**2 - 50 * X * Y + Y**2}[degree]
    with_form = rc.Surface(rough() + form + offset, GRID).levelled(kind)
    without = rc.Surface(rough(), GRID).levelled(kind)
    # The form and the offset leave their own rounding behind.
    atol = 8 * np.finfo(float).eps * (np.abs(form).max() + offset + 1e-6)
    np.testing.assert_allclose(with_form.heights, without.heights, rtol=0, atol=atol)
    assert with_form.provenance == (f"least-squares {kind} removed",)


def test_a_high_degree_stays_exact_beside_large_gaps():
    y, x = Y / np.abs(Y).max(), X / np.abs(X).max()
    heights = x**12 + y**7 * x**5 + 100
    heights[:, :20] = np.nan
    left = rc.Surface(heights, GRID).without_form(12)
    np.testing.assert_allclose(left.heights[left.measured], 0, atol=1e-11)


def test_a_line_is_levelled_too():
    x = np.linspace(-1, 1, 101)
    line = rc.Surface(1 + x + x**2, rc.Grid(101, 1e-6))
    np.testing.assert_allclose(line.levelled("quadratic").heights, 0, atol=1e-14)
    np.testing.assert_allclose(line.levelled().heights, x**2 - np.mean(x**2), atol=1e-14)
    arc = rc.Surface(np.sqrt(4 - (x - 0.3) ** 2), rc.Grid(101, 0.02))
    np.testing.assert_allclose(arc.without_form("sphere").heights, 0, atol=1e-11)


def test_a_surface_with_too_few_points_for_its_form_is_levelled_flat():
    heights = np.full(GRID.shape, np.nan)
    heights[3, 4], heights[7, 9] = 1.0, 2.0
    np.testing.assert_allclose(rc.Surface(heights, GRID).levelled().heights[[3, 7], [4, 9]], 0, atol=1e-12)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("centre", [(0.0, 0.0), (1.5e-5, -3e-5), (2e-4, 1e-4)])
def test_a_sphere_is_taken_out_wherever_its_apex(sign, centre):
    heights = sign * np.sqrt(RADIUS**2 - (X - centre[1]) ** 2 - (Y - centre[0]) ** 2)
    left = rc.Surface(heights + np.where(np.isnan(rough()), np.nan, 0), GRID).without_form("sphere")
    # The fit ends when a step changes it by 1e-12 of itself.
    np.testing.assert_allclose(left.heights[left.measured], 0, atol=1e-11 * RADIUS)
    assert (
        left.provenance[-1]
        == f"form removed: sphere of radius 0.0004 m, {'convex' if sign > 0 else 'concave'}"
    )


@pytest.mark.parametrize("angle", [0.0, 0.4, np.pi / 2, 2.5])
def test_a_tilted_cylinder_is_taken_out(angle):
    across, along = X * np.cos(angle) + Y * np.sin(angle), Y * np.cos(angle) - X * np.sin(angle)
    heights = np.sqrt(RADIUS**2 - (across - 1e-5) ** 2) + 0.03 * along
    left = rc.Surface(heights, GRID).without_form("cylinder")
    np.testing.assert_allclose(left.heights, 0, atol=1e-11 * RADIUS)
    assert "cylinder of radius 0.0004 m, convex" in left.provenance[-1]


def test_roughness_on_a_sphere_is_left():
    ball = -np.sqrt(RADIUS**2 - X**2 - Y**2)
    left = rc.Surface(ball + rough(holes=False), GRID).without_form("sphere")
    # Four parameters of 2240 points take that share of the mean square of white noise, and it scatters as much.
    assert left.rms == pytest.approx(1e-7, rel=5 / np.sqrt(2240))


def test_a_plane_is_a_sphere_without_curvature():
    tilted = rc.Surface(0.3 * X - 0.1 * Y, GRID).without_form("sphere")
    np.testing.assert_allclose(tilted.heights, 0, atol=1e-15)


@pytest.mark.parametrize("form", [-1, 13, True, 2.0, "cone", None])
def test_a_form_that_is_none_is_refused(form):
    with pytest.raises(ValueError, match="form must be"):
        rc.Surface(rough(), GRID).without_form(form)
    with pytest.raises(ValueError, match="levelling must be"):
        rc.Surface(rough(), GRID).levelled("bowl")
