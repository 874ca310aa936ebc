"""The sharp law: Johnson, Kendall and Roberts, Kendall, and what is refused."""

import math
from copy import copy

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion.detachment import StuckContact, mean_compliance
from roughcontact.contact.problem import separation_of
from sticking import rough, sticky

SHARP = rc.Adhesion(1.0, law="sharp")


def largest_tension(surface, depth, adhesion=SHARP, modulus=1.0):
    _, off = rc.adhesive_path(surface, modulus, adhesion, depths=[depth, -100.0])
    assert not off.contact.any()
    return max(-event.force_before for event in off.detachments)


def ball(rings):
    grid = rc.RadialGrid.uniform(rings, 3.2)
    return rc.RadialProfile(-(grid.radii**2) / 2, grid)


def test_on_rings_it_converges_to_johnson_kendall_and_roberts():
    errors = [abs(largest_tension(ball(rings), 4.0) / (1.5 * math.pi) - 1) for rings in (50, 100, 200)]
    # Of first order in the width of a ring over the radius: the edge is known to a ring.
    assert errors[1] <= 0.55 * errors[0]
    assert errors[2] <= 0.55 * errors[1]
    assert errors[2] <= 0.0125


def test_under_a_force_the_pull_off_is_the_largest_tension_under_depths():
    # The force is the same function of the depth, and its smallest value lies at an event.
    *_, off = rc.adhesive_path(ball(100), 1.0, SHARP, forces=[8.0, -10.0])
    assert off.jumps[0].force_before == pytest.approx(-largest_tension(ball(100), 4.0), rel=1e-9)
    assert off.jumps[0].lost == math.inf
    assert off.depth == -math.inf


def test_on_a_plane_the_pull_off_is_too_large_and_depends_on_the_start_only_if_that_is_small():
    grid = rc.Grid((24, 24), 6.0 / 24)
    x = (np.arange(24) - 11.3) * grid.spacing[0]
    sphere = rc.Surface(-(x[:, None] ** 2 + x**2) / 2, grid)
    # The contact at the pull-off has a radius of 1.52, and without attraction one of the root of the depth.
    small, large, larger = (largest_tension(sphere, depth) for depth in (1.0, 3.0, 5.0))
    assert larger == pytest.approx(large, rel=1e-9)
    assert small < 0.9 * large
    # benchmarks/adhesive_laws.py: 18 % on 6 cells in the radius, with a scatter of 3 % over positions in a cell.
    assert 0.09 <= large / (1.5 * math.pi) - 1 <= 0.27


def test_a_ring_that_lets_go_alone_loses_nothing():
    _, off = rc.adhesive_path(ball(60), 1.0, SHARP, depths=[4.0, -100.0])
    *alone, last = off.detachments
    area = math.pi * 3.2**2
    for event in alone:
        assert event.cells == 1
        assert abs(event.lost) <= 1e-9 * area  # of the work of adhesion, by which its tension is found
    assert last.lost > 0
    assert off.jumps[0].lost == last.lost


def test_energy_and_work_balance():
    """What the force does on the way is what the elastic energy and the work of adhesion take, and what is lost."""
    path = list(rc.adhesive_path(ball(40), 1.0, SHARP, depths=np.linspace(4.0, -2.0, 4001)))
    lost = math.fsum(event.lost for state in path for event in state.detachments)
    forces = [state.force for state in path]
    work = -float(np.trapezoid(forces, [state.depth for state in path]))
    assert lost > 0.5
    # The force is linear between events; where it drops the rule errs by at most a step times the drop.
    drops = [abs(event.force_after - event.force_before) for state in path for event in state.detachments]
    missed = 1.5e-3 * math.fsum(drops)
    assert path[0].energy - path[-1].energy == pytest.approx(work + lost, abs=missed)
    assert missed < 0.03 * lost


@pytest.mark.parametrize("by_force", [False, True])
def test_what_an_event_loses_is_what_the_energy_falls_by(by_force):
    """The elastic energy, the work of adhesion of the cells that hold and, under a force, the energy of its weight."""
    surface = rough(16, periodic=False, slope=0.2, seed=0)
    separation, work = separation_of(surface), np.full(surface.grid.shape, 1e-4)
    deep = 0.4 * float(separation.mean())
    stuck = StuckContact(
        rc.half_space(surface.grid, 1.0),
        separation,
        rc.press(surface, 1.0, depth=deep).contact,
        work,
        mean_compliance(surface.grid, 1.0),
    )

    def energy(held, depth, force):
        pressure, contact = held.pressure(depth)
        elastic = 0.5 * float((pressure * np.where(contact, depth - separation, 0.0)).sum())
        return elastic - float(work[contact].sum()) - (force * depth if by_force else 0.0)

    start = stuck.force(deep) if by_force else deep
    seen, before = 0, copy(stuck)
    for event in stuck.drawn_back(start, -1e3, by_force):
        if math.isinf(event.lost):
            break
        fall = energy(before, event.depth, event.force_before) - energy(
            stuck, event.depth_after, event.force_before
        )
        # Rounding of energies that are thousands of times what is lost.
        assert event.lost == pytest.approx(fall, rel=1e-6, abs=1e-12)
        seen, before = seen + 1, copy(stuck)
    assert seen > 5


@pytest.mark.parametrize("cells", [24, 40])
def test_kendalls_disc_comes_off_as_one(cells):
    disc = rc.shapes.flat_disc(rc.Grid((cells + 2, cells + 2), 2 / cells), radius=1.0)
    # benchmarks/adhesive_laws.py: within 3 % for 32 cells and more.
    assert largest_tension(disc, 0.1) == pytest.approx(math.sqrt(8 * math.pi), rel=0.05)


def test_the_tension_that_a_cell_bears_falls_with_the_root_of_its_side():
    assert mean_compliance(rc.Grid((4, 4), 2.0), 5.0) == pytest.approx(2 * 0.473201 * 2.0 / 5.0, rel=1e-6)
    grids = [rc.Grid((4, 4), side) for side in (1e-9, 1e-6)]
    small, large = (math.sqrt(2 / mean_compliance(grid, 1.0)) for grid in grids)
    assert small / large == pytest.approx(math.sqrt(1e3), rel=1e-12)


def test_the_constant_of_a_rectangle_by_quadrature():
    sides = (1.0, 2.5)
    # Twice over both sides of the distance's inverse; the singular side by Duffy's substitution in polar angles.
    angle, weight = np.polynomial.legendre.leggauss(200)

    def wedge(a, b):
        t = 0.5 * math.atan2(b, a) * (angle + 1)
        w = 0.5 * math.atan2(b, a) * weight
        reach = a / np.cos(t)
        # The distances that a vector of length r along t leaves to move in: (a - r cos)(b - r sin).
        x, y = np.cos(t), np.sin(t)
        return float(np.sum(w * (a * b * reach - (a * y + b * x) * reach**2 / 2 + x * y * reach**3 / 3)))

    a, b = sides
    mutual = 4 * (wedge(a, b) + wedge(b, a))
    assert mean_compliance(rc.Grid((4, 4), sides), 1.0) == pytest.approx(
        mutual / (math.pi * a * b), rel=1e-10
    )
    assert mean_compliance(rc.Grid((4, 4), sides[::-1]), 1.0) == pytest.approx(mutual / (math.pi * a * b))


@pytest.mark.parametrize("periodic", [False, True])
def test_a_rough_surface_lets_go_at_the_same_depths_whatever_the_steps(periodic):
    surface = rough(24, periodic=periodic, slope=0.2, seed=0)
    deep, sharp = 0.3 * float(separation_of(surface).mean()), rc.Adhesion(0.01, law="sharp")
    few, many = (
        list(rc.adhesive_path(surface, 1.0, sharp, depths=np.linspace(deep, -4 * deep, n))) for n in (3, 21)
    )
    events = [[event for state in path for event in state.detachments] for path in (few, many)]
    assert [event.cells for event in events[0]] == [event.cells for event in events[1]]
    np.testing.assert_allclose(*([event.depth for event in found] for found in events), rtol=1e-9, atol=1e-12)
    assert len(events[0]) > 5
    for state in many:
        assert state.status.converged or not state.contact.any()
        assert state.residual <= 1e-8
        assert state.directional
        if state.contact.any():
            tension = math.sqrt(2 * 0.01 / mean_compliance(surface.grid, 1.0))
            assert state.pressure.min() >= -tension * (1 + 1e-9)


def test_only_on_a_plane_the_criterion_depends_on_the_direction():
    for state in rc.adhesive_path(ball(20), 1.0, SHARP, depths=[1.0, 0.5]):
        assert not state.directional
    smooth = rc.adhesive_state(rough(16, periodic=True, slope=0.2, seed=0), 1.0, sticky(2.0), depth=0.3)
    assert not smooth.directional


@pytest.mark.parametrize("depths", [[1.0], [0.5, 1.0], [0.0, -1.0]])
def test_an_approach_is_refused(depths):
    with pytest.raises(ValueError, match="falling"):
        rc.adhesive_path(ball(20), 1.0, SHARP, depths=depths)


def test_a_range_of_the_sharp_law_is_refused():
    with pytest.raises(ValueError, match="no range"):
        rc.Adhesion(1.0, 1e-9, law="sharp")
    assert SHARP.strength == math.inf
    assert SHARP.process_zone(1.0) == 0
