"""Tangential stiffness of regions that stick, against Mindlin, and what it must be by symmetry."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.friction.tangential_stiffness import tangential_stiffness
from roughcontact.halfspace.shear.shear_operator import shear_half_space


def disc(n):
    x = np.arange(n) - (n - 1) / 2
    return np.hypot(x[:, None], x) < n / 2


def both(region, body, spacing=1.0):
    """Return the normal and the tangential stiffness."""
    grid = rc.Grid(region.shape, spacing)
    return rc.contact_stiffness(region, grid, body), tangential_stiffness(region, grid, body)


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_mindlins_ratio_on_a_disc_by_refinement(nu):
    """The ratio is off by the first power of the cell, and much less than either stiffness: 1e-4 at 128 cells."""
    body = rc.Solid(1.0, nu)
    errors = []
    for n in (32, 64, 128):
        normal, shear = both(disc(n), body)
        errors.append(abs(normal / shear.matrix[0, 0] / rc.theory.mindlin.ratio(nu) - 1))
    assert errors[2] < 1e-4 * rc.theory.mindlin.ratio(nu)
    assert errors[0] > 1.3 * errors[1] > 1.69 * errors[2]


def test_the_stiffness_of_a_disc():
    """2 G* a. Errors of the first order in the cell leave by extrapolation; the staircase leaves 2e-4."""
    body = rc.Solid(1.0, 0.3)
    ratios = []
    for n in (64, 128):
        region = disc(n)
        radius = math.sqrt(region.sum() / math.pi)
        ratios.append(both(region, body)[1].matrix[0, 0] / (2 * rc.reduced_shear_modulus(body) * radius))
    assert 2 * ratios[1] - ratios[0] == pytest.approx(1, abs=2e-4)
    assert ratios[1] == pytest.approx(1, abs=2e-3)


@pytest.mark.parametrize("region", [disc(24), np.ones((20, 50), bool), np.eye(30, dtype=bool)])
def test_without_poissons_ratio_it_is_the_normal_one(region):
    """To the square of the tolerance of either."""
    normal, shear = both(region, rc.Solid(1.0, 0.0), (0.5, 0.3))
    np.testing.assert_allclose(shear.matrix, normal * np.eye(2), rtol=0, atol=1e-9 * normal)


@pytest.mark.parametrize(
    ("nu", "sides", "along", "across"),
    [
        (0.3, (1, 1), 1.2128, 1.2128),
        (0.3, (1, 2), 1.2437, 1.1821),
        (0.3, (1, 4), 1.2721, 1.1541),
        (0.5, (1, 1), 1.4934, 1.4934),
        (0.5, (1, 2), 1.5655, 1.4220),
        (0.5, (1, 4), 1.6322, 1.3574),
    ],
)
def test_rectangles_are_softer_along_their_longer_side(nu, sides, along, across):
    """Ratios by Richardson from 16, 32 and 64 cells along the shorter side, where 16 cells are 1e-3 off."""
    normal, shear = both(np.ones((16 * sides[0], 16 * sides[1]), bool), rc.Solid(1.0, nu))
    assert normal / shear.matrix[0, 0] == pytest.approx(along, abs=2e-3)
    assert normal / shear.matrix[1, 1] == pytest.approx(across, abs=2e-3)
    assert abs(shear.matrix[0, 1]) < 1e-12 * normal  # a wrong parity would show here


def test_a_region_that_is_turned():
    """A strip along the diagonal: its principal axes are the diagonals, and along it is the softer."""
    rows, columns = np.indices((60, 60))
    strip = np.abs(rows - columns) < 4
    shear = both(strip, rc.Solid(1.0, 0.5))[1]
    values, axes = shear.principal
    assert values[0] < values[1]
    np.testing.assert_allclose(np.abs(axes @ [1, 1]), [math.sqrt(2), 0], atol=1e-9)
    np.testing.assert_allclose(shear.matrix @ axes[0], values[0] * axes[0])
    mirrored = both(strip[::-1], rc.Solid(1.0, 0.5))[1]
    np.testing.assert_allclose(mirrored.matrix, shear.matrix * [[1, -1], [-1, 1]], rtol=1e-9)


def test_two_bodies_are_in_series_with_one_of_their_compliance():
    """Equal bodies are half as stiff as one against a rigid one."""
    body, region = rc.Solid(2.0, 0.3), disc(20)
    grid = rc.Grid(region.shape, 1.0)
    one, two = (tangential_stiffness(region, grid, bodies).matrix for bodies in (body, (body, body)))
    np.testing.assert_allclose(one, 2 * two, rtol=1e-9)


def test_few_cells_far_apart_go_by_a_matrix():
    """Which changes nothing: against the same region by a plain solve."""
    rng = np.random.default_rng(0)
    region = rng.random((90, 70)) < 0.01
    grid, body = rc.Grid(region.shape, (0.5, 0.3)), rc.Solid(1.0, 0.3)
    matrix = shear_half_space(grid, body).as_matrix(np.flatnonzero(region))
    count = region.sum()
    displaced = np.repeat(np.eye(2), count, axis=1)
    truth = displaced @ np.linalg.solve(matrix, displaced.T) * grid.cell_area
    np.testing.assert_allclose(
        tangential_stiffness(region, grid, body).matrix, truth, rtol=0, atol=1e-10 * truth.max()
    )


def test_a_cell_none_and_all():
    grid, body = rc.Grid((8, 8), 0.5, True), rc.Solid(1.0, 0.3)
    empty, full = np.zeros((8, 8), bool), np.ones((8, 8), bool)
    np.testing.assert_array_equal(tangential_stiffness(empty, grid, body).matrix, 0)
    whole = tangential_stiffness(full, grid, body)
    np.testing.assert_array_equal(np.diag(whole.matrix), np.inf)
    np.testing.assert_array_equal(whole.principal[0], np.inf)
    cell = empty.copy()
    cell[3, 5] = True
    influence = shear_half_space(grid, body).as_matrix(np.flatnonzero(cell))
    np.testing.assert_allclose(
        tangential_stiffness(cell, grid, body).matrix, grid.cell_area * np.linalg.inv(influence)
    )


def test_another_operator_may_be_named():
    region, grid, body = disc(12), rc.Grid((12, 12), 1.0), rc.Solid(1.0, 0.3)
    dense = shear_half_space(grid, body, method="dense")
    np.testing.assert_allclose(
        tangential_stiffness(region, grid, body, operator=dense).matrix,
        tangential_stiffness(region, grid, body).matrix,
        rtol=0,
        atol=1e-11,
    )


@pytest.mark.parametrize(
    ("region", "bodies", "message"),
    [
        (np.ones((3, 4), bool), rc.Solid(1.0, 0.3), "does not fit the grid"),
        (np.full((4, 4), np.nan), rc.Solid(1.0, 0.3), "truth values"),
        (np.ones((4, 4), bool), 1e9, "E\\* does not determine"),
        (np.ones((4, 4), bool), (rc.Solid(1.0, 0.3),), "pair of Solids"),
    ],
)
def test_nonsense_is_refused(region, bodies, message):
    with pytest.raises(ValueError, match=message):
        tangential_stiffness(region, rc.Grid((4, 4), 1.0), bodies)


def test_a_grid_of_its_own():
    operator = shear_half_space(rc.Grid((4, 4), 2.0), rc.Solid(1.0, 0.3))
    with pytest.raises(ValueError, match="is not the contact's"):
        tangential_stiffness(
            np.ones((4, 4), bool), rc.Grid((4, 4), 1.0), rc.Solid(1.0, 0.3), operator=operator
        )


def test_a_tolerance_that_was_missed_is_said_to_be(monkeypatch):
    monkeypatch.setattr("roughcontact.friction.tangential_stiffness.MAX_STEPS", 2)
    with pytest.raises(RuntimeError, match="larger tolerance"):
        tangential_stiffness(disc(60), rc.Grid((60, 60), 1.0), rc.Solid(1.0, 0.3))


@pytest.mark.parametrize("tolerance", [1e-18, 1.0, math.nan])
def test_a_tolerance_that_says_nothing_is_refused(tolerance):
    with pytest.raises(ValueError, match="between 1e-14 and 1e-2"):
        tangential_stiffness(disc(8), rc.Grid((8, 8), 1.0), rc.Solid(1.0, 0.3), tolerance=tolerance)
