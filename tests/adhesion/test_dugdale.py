"""Dugdale's law: its numbers, and a sphere beside Maugis' equations."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.dugdale_law import DugdaleLaw
from roughcontact.theory.adhesive.maugis import DugdaleSphere
from sticking import rough, sticky

LAW = DugdaleLaw(0.05, 2e-9, np.array([1e-9]))


def test_the_attraction_is_the_slope_of_its_energy_and_does_the_work_of_adhesion():
    gap, step = np.linspace(0, 4e-9, 4001), 1e-13
    slope = (LAW.energy(gap + step) - LAW.energy(gap - step)) / (2 * step)
    # Third derivative of the energy, at most 2 pi s/spread^2, times step^2/6, and rounding of the difference.
    np.testing.assert_allclose(slope, LAW.traction(gap), atol=LAW.strength * (2e-8 + 1e-16 * 2e4))
    fall = -(LAW.traction(gap + step) - LAW.traction(gap - step)) / (2 * step)
    np.testing.assert_allclose(fall, LAW.curvature(gap), atol=LAW.steepest * (1e-6 + 1e-16 * 1e4))
    assert math.isclose(LAW.energy(np.zeros(1))[0], -0.05, rel_tol=1e-15)
    assert LAW.traction(np.array([0.0, 1.4e-9, 2e-9, 2.6e-9])).tolist() == [2.5e7, 2.5e7, 1.25e7, 0.0]
    assert math.isclose(float(LAW.curvature(np.array([2e-9]))[0]), LAW.steepest)


def test_the_largest_curvature_between_two_gaps_is_that_of_the_samples_between_them():
    rng = np.random.default_rng(0)
    for low, high in np.sort(rng.uniform(0, 4e-9, (200, 2)), axis=1):
        most = LAW.curvature(np.linspace(low, high, 2000)).max()
        # Of a maximum missed by half a sample: curvature of the curvature, at most 4 pi^2 s/spread^3.
        missed = 4 * math.pi**2 * LAW.strength / 1e-27 * ((high - low) / 4000) ** 2 / 2
        found = float(LAW.curvature_between(np.array([low]), np.array([high]))[0])
        assert most <= found * (1 + 1e-12) <= most + missed + 1e-12 * LAW.steepest


def test_small_changes_of_the_energy_keep_their_digits():
    gap = np.array([0.0, 1.7e-9, 2.2e-9])
    np.testing.assert_allclose(
        LAW.energy_change(gap, np.full(3, -1e-25)), -1e-25 * LAW.traction(gap), rtol=1e-13
    )
    assert LAW.energy_change(np.array([np.inf]), np.array([1.0]))[0] == 0
    for step in np.logspace(-13, -8, 60):
        for sign in (1, -1):
            start = gap + (step if sign < 0 else 0)
            told = LAW.energy(start + sign * step) - LAW.energy(start)
            # What Simpson's rule leaves, 1e-10 of the step, and the rounding of the difference.
            assert np.allclose(
                LAW.energy_change(start, np.full(3, sign * step)),
                told,
                rtol=1e-9,
                atol=1e-10 * step * LAW.strength + 4e-16 * 0.05,
            )


def ball(number, rings):
    theory = DugdaleSphere.of_number(number)
    grid = rc.RadialGrid.uniform(rings, 1.25 * float(theory.zone_radius(2.5)))
    return (
        theory,
        rc.RadialProfile(-(grid.radii**2) / 2, grid),
        rc.Adhesion(1.0, 1 / theory.strength, "dugdale"),
    )


def pull_off_error(number, rings):
    theory, profile, adhesion = ball(number, rings)
    loads = [0.0, -1.1 * theory.pull_off_force]
    _, off = rc.adhesive_path(profile, 1.0, adhesion, forces=loads)
    return abs(-off.jumps[-1].force_before / theory.pull_off_force - 1)


@pytest.mark.parametrize("number", [0.01, 0.3])
def test_the_pull_off_is_that_of_maugis_equations(number):
    coarse, fine = pull_off_error(number, 40), pull_off_error(number, 160)
    assert fine <= max(
        coarse / 4, 2e-4
    )  # of first order at least, and to the digits of docs/evidence/adhesion-evidence.md
    assert fine <= 1e-3


def test_a_sphere_that_is_pulled_off_leaves_in_one_jump():
    """The last cells attract evenly: no curvature of the law tells the flow how far to go."""
    theory, profile, adhesion = ball(5, 60)
    unresolved = rc.Adhesion(1.0, adhesion.range, "dugdale", allow_unresolved=True)
    loads = [0.0, -1.3 * theory.pull_off_force]
    _, off = rc.adhesive_path(profile, 1.0, unresolved, forces=loads)
    lost = np.array([jump.lost for jump in off.jumps])
    assert off.status is rc.Status.NO_CONTACT
    assert np.isinf(lost[-1])
    assert np.isfinite(lost[:-1]).all()
    assert (lost[:-1] > 0).all()
    # It leaves from contact, not from a state that it fell into before.
    assert abs(off.jumps[-1].depth - off.jumps[-2].depth_after) < adhesion.range


def test_a_sphere_goes_back_on_the_way_it_came():
    """The edge of the zone passes over the cells without a jump."""
    theory, profile, adhesion = ball(0.5, 120)
    radii = np.linspace(1.6, 2.4, 9)
    depths = np.asarray(theory.depth(radii)) - profile.grid.radii[0] ** 2 / 2
    first, *rest = rc.adhesive_path(profile, 1.0, adhesion, depths=[*depths, *depths[-2::-1]])
    states = [first, *rest]
    assert not any(state.jumps for state in rest)
    forces = np.array([state.force for state in states])
    np.testing.assert_allclose(forces, forces[::-1], atol=1e-7 * theory.pull_off_force)
    # Table of benchmarks/adhesive_laws.py: 4e-4 of the pull-off on rings of this width.
    assert np.abs(forces[:9] - theory.force(radii)).max() <= 1e-3 * theory.pull_off_force


def test_on_a_plane_it_agrees_with_maugis_equations():
    theory = DugdaleSphere.of_number(0.5)
    grid = rc.Grid((48, 48), 2.5 * float(theory.zone_radius(2.0)) / 48)
    surface, tip = rc.shapes.paraboloid(grid, 1.0), grid.spacing[0] ** 2 / 4
    adhesion = rc.Adhesion(1.0, 1 / theory.strength, "dugdale")
    radii = np.array([1.9, 1.7])
    for state, force in zip(
        rc.adhesive_path(surface, 1.0, adhesion, depths=np.asarray(theory.depth(radii)) - tip),
        np.asarray(theory.force(radii)),
        strict=True,
    ):
        assert state.residual <= 1e-8
        assert abs(state.force - force) <= 0.01 * theory.pull_off_force


@pytest.mark.parametrize("periodic", [False, True])
def test_states_on_a_rough_surface_do_not_depend_on_the_step(periodic):
    surface = rough(24, periodic=periodic, slope=0.1, seed=0)
    exponential = sticky(2.5)
    adhesion = rc.Adhesion(exponential.work, exponential.range, "dugdale")
    deepest = 0.4 * float(surface.heights.max() - surface.heights.mean())
    up = np.linspace(-2 * adhesion.range, deepest, 25)
    found = [
        list(rc.adhesive_path(surface, 1.0, adhesion, depths=np.r_[way, way[-2::-1]]))
        for way in (up[::4], up)
    ]
    forces = [np.array([state.force for state in states]) for states in found]
    jumps = [[jump.depth for state in states for jump in state.jumps] for states in found]
    largest = np.abs(forces[1]).max()
    np.testing.assert_allclose(forces[0], forces[1][::4], atol=1e-6 * largest)
    np.testing.assert_allclose(*jumps, atol=2e-6 * (deepest + 40 * adhesion.range))
    assert max(state.residual for state in found[1]) <= 1e-8


def test_an_attraction_that_no_cell_resolves_is_refused():
    grid = rc.Grid((16, 16), 1e-6)
    surface = rc.shapes.paraboloid(grid, 1e-5)
    with pytest.raises(ValueError, match="Irwin's length"):
        rc.adhesive_state(surface, 1e9, rc.Adhesion(0.05, 2e-9, "dugdale"), depth=1e-9)


@pytest.mark.parametrize("law", ["exponential", "dugdale"])
def test_without_work_it_is_contact_that_does_not_stick(law):
    surface = rough(24, periodic=False, slope=0.1, seed=3)
    plain = rc.press(surface, 1.0, depth=0.5)
    sticking = rc.adhesive_state(surface, 1.0, rc.Adhesion(1e-12, 0.3, law), depth=0.5)
    # The attraction, 3e-12 of the modulus on all cells, is 1e-9 of the force.
    assert sticking.force == pytest.approx(plain.force, rel=1e-8)
    assert (sticking.contact == plain.contact).all()
    np.testing.assert_allclose(sticking.pressure, plain.pressure, atol=1e-8 * plain.pressure.max())


def test_under_a_force_a_small_sphere_is_where_its_depth_says():
    """In metres: the approach begins at a gap within the range."""
    rings = rc.RadialGrid.uniform(45, radius=6e-7)
    ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    law = rc.Adhesion(10e-3, 6e-9, "dugdale")
    by_depth = rc.adhesive_state(ball, 1e8, law, depth=15e-9)
    by_force = rc.adhesive_state(ball, 1e8, law, force=by_depth.force)
    assert by_force.status.converged
    assert by_force.depth == pytest.approx(15e-9, rel=1e-8)
