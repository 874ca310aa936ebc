"""Partial slip against Cattaneo and Mindlin on a sphere, and Ciavarella and Jaeger on anything."""

import numpy as np
import oracles
import pytest

import roughcontact as rc
from roughcontact.friction.slide import slide

MU = 0.5


def sphere(n, nu):
    """A sphere of radius 1 pressed until the contact is 0.7 of the grid wide, and its closed form."""
    bodies = (rc.Solid(2.0, nu), rc.Solid(2.0, nu))
    modulus = rc.reduced_modulus(*bodies)
    surface = rc.Surface(oracles.paraboloid(n, 1.0, side=0.1), rc.Grid((n, n), 0.1 / n))
    solution = rc.press(surface, bodies, force=4 / 3 * modulus * 0.035**3)
    ratio = modulus / rc.reduced_shear_modulus(*bodies)
    theory = rc.theory.cattaneo.SlippingSphere(solution.force, 1.0, modulus, MU, ratio)
    return solution, bodies, theory


def distance(solution):
    y, x = (c - c.mean() for c in solution.problem.grid.coordinates)
    return np.hypot(y[:, None], x)


def rough(periodic, nu=0.0, n=64):
    grid = rc.Grid((n, n + 8), 1e-6, periodic)
    surface = rc.self_affine(
        grid,
        hurst=0.8,
        rms=1e-7,
        rolloff=3e-5,
        short_cutoff=4e-6,
        rng=np.random.default_rng(4),
    )
    bodies = (rc.Solid(2e11, nu), rc.Solid(1e11, nu))
    pressure = 0.004 * rc.reduced_modulus(*bodies)
    return surface, bodies, rc.press(surface, bodies, pressure=pressure, tolerance=1e-12)


@pytest.fixture(scope="module")
def fine():
    """A sphere at 256^2 and nu = 0, under half the force that would make it slide."""
    solution, bodies, theory = sphere(256, 0.0)
    force = 0.5 * MU * solution.force
    return solution, theory, force, slide(solution, bodies, friction=MU, force=force)


@pytest.fixture(scope="module", params=[False, True], ids=["free", "periodic"])
def case(request):
    return rough(request.param)


class TestCattaneo:
    def test_traction(self, fine):
        """Within 1 % of the largest but in the cells that touch an edge, where its slope is infinite."""
        solution, theory, force, answer = fine
        r, cell = distance(solution), solution.problem.grid.spacing[0]
        expected = theory.traction(r, force)
        error = np.abs(answer.traction[0] - expected) / expected.max()
        edges = theory.stick_radius(force), theory.contact_radius
        inside = np.all([np.abs(r - edge) > cell for edge in edges], axis=0)
        assert error[inside].max() < 0.01
        assert np.sqrt(np.mean(error[r < edges[1]] ** 2)) < 0.003  # the cells at the edges are few
        assert not answer.traction[1].any()

    def test_displacement(self, fine):
        _, theory, force, answer = fine
        assert answer.displacement[0] == pytest.approx(theory.displacement(force), rel=2e-3)
        assert answer.displacement[1] == 0

    def test_stick_radius(self, fine):
        """To the half of a cell by which a staircase may be off."""
        _, theory, force, answer = fine
        cell = answer.problem.pressed.problem.grid.spacing[0]
        assert np.sqrt(answer.stick_area / np.pi) == pytest.approx(theory.stick_radius(force), abs=cell / 2)
        assert answer.stick_area + answer.slip_area == pytest.approx(answer.problem.pressed.contact_area)

    def test_stiffness(self, fine):
        """2 G* c, to the half cell of the stick radius."""
        _, theory, force, answer = fine
        cell = answer.problem.pressed.problem.grid.spacing[0]
        expected = theory.stiffness(force)
        allowed = expected * cell / 2 / theory.stick_radius(force)
        np.testing.assert_allclose(answer.stiffness, expected * np.eye(2), rtol=0, atol=allowed)

    @pytest.mark.parametrize("part", [0.1, 0.9, 0.99])
    def test_other_forces(self, part):
        """The displacement is good to 2e-3 of the largest on 64 cells."""
        solution, bodies, theory = sphere(64, 0.0)
        force = part * MU * solution.force
        answer = slide(solution, bodies, friction=MU, force=force)
        assert answer.displacement[0] == pytest.approx(
            theory.displacement(force), abs=2e-3 * theory.gross_slip
        )

    @pytest.mark.parametrize("nu", [0.3, 0.5])
    def test_along_the_force_only_poissons_ratio_is_but_a_factor(self, nu):
        """Cattaneo's traction moves a sphere's surface along the force as one for any nu, times E*/G*."""
        (one, bodies, theory), (other, _, _) = sphere(64, nu), sphere(64, 0.0)
        part = 0.5 * MU
        answer = slide(one, bodies, friction=MU, force=part * one.force, along=(1, 0))
        plain = slide(other, rc.Solid(1.0, 0.0), friction=MU, force=part * other.force)
        scale = one.force / other.force
        # The two differ by the pixels of the edges alone.
        error = np.abs(answer.traction / scale - plain.traction)
        assert np.sqrt(np.mean(error[0][one.contact] ** 2)) < 0.003 * plain.traction.max()
        ratio = answer.displacement[0] / plain.displacement[0]
        assert ratio == pytest.approx(theory.ratio, rel=2e-3)

    def test_traction_that_may_turn_does_so_a_little(self):
        """Of the order nu/(2 - nu) of the slip, and so of mu p (Johnson, section 7.2)."""
        solution, bodies, theory = sphere(64, 0.3)
        force = 0.5 * MU * solution.force
        answer = slide(solution, bodies, friction=MU, force=force)
        sideways = np.abs(answer.traction[1]).max() / answer.traction[0].max()
        assert 0.01 < sideways < 0.3 / 1.7
        assert answer.force[1] == pytest.approx(0, abs=1e-12 * force)
        assert answer.displacement[0] == pytest.approx(theory.displacement(force), rel=2e-3)
        straight = slide(solution, bodies, friction=MU, force=force, along=(1, 0))
        assert answer.displacement[0] < straight.displacement[0]  # more freedom, less energy


class TestCiavarellaAndJaeger:
    """With Love's influence for both directions the rule holds cell by cell, to the tolerance of the solves."""

    @pytest.mark.parametrize("part", [0.2, 0.7, 0.95])
    def test_traction_displacement_and_stick_area(self, case, part):
        surface, bodies, solution = case
        less = rc.press(surface, bodies, force=(1 - part) * solution.force, tolerance=1e-12)
        answer = slide(solution, bodies, friction=MU, force=part * MU * solution.force, tolerance=1e-10)
        expected = MU * (solution.pressure - less.pressure)
        np.testing.assert_allclose(answer.traction[0], expected, rtol=0, atol=1e-6 * expected.max())
        assert answer.displacement[0] == pytest.approx(MU * (solution.depth - less.depth), rel=1e-8)
        np.testing.assert_array_equal(answer.sticking, less.contact)
        assert answer.stiffness[0, 0] == pytest.approx(less.stiffness, rel=1e-9)

    def test_where_the_force_goes_makes_no_difference(self, case):
        _, bodies, solution = case
        force = 0.6 * MU * solution.force
        along = slide(solution, bodies, friction=MU, force=force, tolerance=1e-10)
        turned = slide(
            solution,
            bodies,
            friction=MU,
            force=(0.6 * force, -0.8 * force),
            tolerance=1e-10,
        )
        np.testing.assert_allclose(
            turned.traction,
            along.traction[0] * np.array([0.6, -0.8])[:, None, None],
            rtol=0,
            atol=1e-6 * along.traction.max(),
        )

    def test_sliding(self, case):
        _, bodies, solution = case
        answer = slide(solution, bodies, friction=MU, force=MU * solution.force)
        np.testing.assert_allclose(answer.traction[0], MU * solution.pressure)
        assert answer.sliding
        assert answer.stick_area == 0
        # All of the depth, to the residual of the pressure where it touches last.
        assert answer.displacement[0] == pytest.approx(MU * solution.depth, rel=1e-8)
        assert "slide" in answer.notes[-1]
        beyond = slide(solution, bodies, friction=MU, displacement=2 * answer.displacement)
        np.testing.assert_allclose(beyond.traction, answer.traction, rtol=1e-12)
