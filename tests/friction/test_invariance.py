"""Scales, turns, windows and sums that must not matter, or matter in a known way."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.friction.slide import slide
from roughcontact.friction.slip_curve import slide_curve
from roughcontact.friction.tangential_stiffness import tangential_stiffness
from roughcontact.halfspace.shear.shear_operator import shear_half_space

BODIES = (rc.Solid(1e11, 0.3), rc.Solid(3e11, 0.4))
MU = 0.4


def surface(scale=1.0, periodic=False):
    grid = rc.Grid((20, 28), (1.2e-6 * scale, 1e-6 * scale), periodic)
    base = rc.self_affine(
        rc.Grid((20, 28), (1.2e-6, 1e-6), periodic), hurst=0.7, rms=1e-7, rng=np.random.default_rng(5)
    )
    return rc.Surface(base.heights * scale, grid)


def pressed(body=None, bodies=BODIES, force=1.0, **more):
    return rc.press(surface() if body is None else body, bodies, force=force, **more)


@pytest.fixture(scope="module")
def solution():
    return pressed()


@pytest.fixture(scope="module")
def answer(solution):
    return slide(solution, BODIES, friction=MU, force=0.6 * MU * solution.force, tolerance=1e-10)


def same(traction, expected, tolerance=1e-6):
    np.testing.assert_allclose(traction, expected, rtol=0, atol=tolerance * np.abs(expected).max())


def test_twice_the_friction_and_twice_the_force_is_twice_the_traction(solution, answer):
    twice = slide(solution, BODIES, friction=2 * MU, force=2 * answer.force, tolerance=1e-10)
    same(twice.traction, 2 * answer.traction)
    np.testing.assert_allclose(twice.displacement, 2 * answer.displacement, rtol=1e-7)
    np.testing.assert_array_equal(twice.slipping, answer.slipping)


def test_a_stiffer_pair_moves_less(answer):
    hard = tuple(rc.Solid(100 * b.young_modulus, b.poisson_ratio) for b in BODIES)
    stiff = slide(
        pressed(bodies=hard, force=100.0), hard, friction=MU, force=100 * answer.force, tolerance=1e-10
    )
    same(stiff.traction, 100 * answer.traction)
    np.testing.assert_allclose(stiff.displacement, answer.displacement, rtol=1e-7)
    assert stiff.dissipated == pytest.approx(100 * answer.dissipated, rel=1e-6)


def test_larger_bodies_have_the_same_tractions(answer):
    large = pressed(surface(1e3), force=1e6)
    grown = slide(large, BODIES, friction=MU, force=1e6 * answer.force, tolerance=1e-10)
    same(grown.traction, answer.traction)
    np.testing.assert_allclose(grown.displacement, 1e3 * answer.displacement, rtol=1e-7)


def test_mirrored_and_turned(solution, answer):
    """A surface that is turned and pulled the other way answers the same, turned."""
    heights, grid = surface().heights, surface().grid
    force = answer.force[0]
    mirrored = slide(
        pressed(rc.Surface(heights[:, ::-1], grid)), BODIES, friction=MU, force=(-force, 0), tolerance=1e-10
    )
    same(mirrored.traction[:, :, ::-1], answer.traction * np.array([-1, 1])[:, None, None])
    turned_grid = rc.Grid(grid.shape[::-1], grid.spacing[::-1])
    turned = slide(
        pressed(rc.Surface(heights.T, turned_grid)), BODIES, friction=MU, force=(0, force), tolerance=1e-10
    )
    same(turned.traction[::-1].transpose(0, 2, 1), answer.traction)
    np.testing.assert_allclose(
        turned.displacement[::-1], answer.displacement, rtol=0, atol=1e-7 * answer.displacement[0]
    )


def test_which_body_is_first_makes_no_difference(solution, answer):
    other = slide(solution, BODIES[::-1], friction=MU, force=answer.force, tolerance=1e-10)
    same(other.traction, answer.traction)


def test_room_around_the_contact_makes_no_difference(answer):
    heights = np.pad(surface().heights, ((7, 4), (2, 9)), constant_values=np.nan)
    grid = rc.Grid(heights.shape, surface().grid.spacing)
    roomy = slide(
        pressed(rc.Surface(heights, grid)), BODIES, friction=MU, force=answer.force, tolerance=1e-10
    )
    same(roomy.traction[:, 7:-4, 2:-9], answer.traction)


@pytest.mark.parametrize("periodic", [False, True])
def test_the_sum_makes_no_difference(periodic):
    solution = pressed(surface(periodic=periodic))
    dense = shear_half_space(solution.problem.grid, BODIES, method="dense")
    load = {
        "friction": MU,
        "force": (0.3 * MU * solution.force, 0.4 * MU * solution.force),
        "tolerance": 1e-10,
    }
    one, other = slide(solution, BODIES, **load), slide(solution, BODIES, operator=dense, **load)
    same(other.traction, one.traction)


def test_a_shift_of_a_period_makes_no_difference():
    solution = pressed(surface(periodic=True))
    rolled = rc.Surface(np.roll(surface().heights, (5, 9), (0, 1)), surface(periodic=True).grid)
    force = 0.6 * MU * solution.force
    one = slide(solution, BODIES, friction=MU, force=force, tolerance=1e-10)
    other = slide(pressed(rolled), BODIES, friction=MU, force=force, tolerance=1e-10)
    same(np.roll(other.traction, (-5, -9), (1, 2)), one.traction)


def test_along_one_direction_only(solution):
    """The traction keeps it, whatever it is; and as displacement across it is left out, none is stated."""
    force = 0.5 * MU * solution.force
    along = slide(solution, BODIES, friction=MU, force=force, along=(3, 4))
    assert along.force == pytest.approx([0.6 * force, 0.8 * force])
    same(0.6 * along.traction[1], 0.8 * along.traction[0], 1e-12)
    assert along.displacement[1] == pytest.approx(along.displacement[0] * 4 / 3)
    back = slide(solution, BODIES, friction=MU, force=-force, along=(-3, -4))
    same(back.traction, along.traction)


def test_a_little_force_slips_nowhere(solution):
    """On a grid the first cell slips at a force of its own; before, the contact is as stiff as in full stick."""
    stick = slide(solution, BODIES, friction=1e9, force=1.0, tolerance=1e-12)  # [N]
    assert not stick.slipping.any()
    inside = solution.contact
    first = (MU * solution.pressure[inside] / np.hypot(*stick.traction)[inside]).min()
    assert slide(solution, BODIES, friction=MU, force=1.01 * first, tolerance=1e-12).slipping.any()
    answer = slide(solution, BODIES, friction=MU, force=0.99 * first, tolerance=1e-12)
    assert not answer.slipping.any()
    assert answer.dissipated == pytest.approx(0, abs=1e-10 * answer.elastic_energy)
    matrix = tangential_stiffness(solution.contact, solution.problem.grid, BODIES).matrix
    np.testing.assert_allclose(
        matrix @ answer.displacement, answer.force, rtol=0, atol=1e-10 * answer.force[0]
    )
    np.testing.assert_array_equal(answer.stiffness, matrix)
    assert answer.elastic_energy == pytest.approx(answer.force @ answer.displacement / 2)


def test_full_contact_of_a_periodic_surface():
    """Uniform traction moves nothing: a force that nowhere exceeds mu p is carried evenly, without displacement."""
    grid = rc.Grid((16, 16), 1.0, True)
    y, x = np.meshgrid(*grid.coordinates, indexing="ij")
    wave = rc.Surface(0.03 * np.cos(2 * np.pi * x / 16) * np.cos(2 * np.pi * y / 16), grid)
    body = rc.Solid(1.0, 0.3)
    solution = rc.press(wave, body, pressure=0.02)
    assert solution.contact.all()
    least = MU * solution.pressure.min() * grid.area
    even = slide(solution, body, friction=MU, force=0.9 * least)
    np.testing.assert_allclose(even.traction[0], 0.9 * least / grid.area)
    np.testing.assert_allclose(even.displacement, 0, atol=1e-12)
    assert not even.slipping.any()
    np.testing.assert_array_equal(np.diag(even.stiffness), np.inf)
    beyond = slide(solution, body, friction=MU, force=1.2 * least)
    assert beyond.slipping.any()
    assert beyond.displacement[0] > 0


def test_one_cell(solution):
    """A single cell sticks, rigidly with its own influence, until all of it slides."""
    body = rc.Solid(1.0, 0.3)
    heights = np.zeros((5, 5))
    heights[2, 2] = 1.0
    pressed_cell = rc.press(rc.Surface(heights, rc.Grid((5, 5), 0.1)), body, force=1e-3)
    curve = slide_curve(pressed_cell, body, friction=MU, forces=[2e-4, 4e-4, -4e-4, 0.0])
    np.testing.assert_allclose(curve.stick_area, [0.01, 0, 0, 0.01])
    # Forces of +-mu P slide; of the last one the cell has gone back by mu P times its compliance.
    np.testing.assert_allclose(curve.displacement[:, 1], 0, atol=1e-12)
    np.testing.assert_allclose(curve.dissipated, 0, atol=1e-12)
    np.testing.assert_allclose(curve.displacement[:, 0] / curve.displacement[0, 0], [1, 2, -2, 0], atol=1e-9)
