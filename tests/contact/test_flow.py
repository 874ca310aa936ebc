"""What flows under a hardness, and what of it is kept.

Solutions are compared to ten times their residual, 1e-10 of the largest displacement: pressures and depths are known no
better than a few times that.
"""

import functools
import itertools

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize

import roughcontact as rc
from libraries import LIBRARIES
from roughcontact.halfspace.influence.love import love

MODULUS = 2.0
TIGHT = {"tolerance": 1e-10}


def plane(periodic=False, shape=(24, 20), seed=3):
    grid = rc.Grid(shape, (0.05, 0.06), periodic)
    return rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(seed))


def holed():
    surface = plane()
    heights = surface.heights.copy()
    heights[3:6, 4:9] = np.nan
    return rc.Surface(heights, surface.grid)


def on_line():
    grid = rc.Grid(80, 0.02)
    return rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(5)), rc.line(grid, MODULUS)


def on_rings(shape=lambda r: r**2 / 2, n=40):
    rings = rc.RadialGrid.uniform(n, 1.0)
    return rc.RadialProfile(-shape(rings.radii), rings), rc.ring(rings, MODULUS)


BODIES = {
    "free": lambda: (plane(), None),
    "periodic": lambda: (plane(True), None),
    "singly periodic": lambda: (plane((True, False)), None),
    "missing cells": lambda: (holed(), None),
    "line": on_line,
    "sphere": on_rings,
    "cone": lambda: on_rings(lambda r: 0.3 * r),
}


def limits(body, operator):
    """Return a force under which half of the contact flows, and the hardness: half of the elastic peak."""
    sample = rc.press(body, MODULUS, depth=0.4 * spread(body), operator=operator)
    return sample.force, 0.5 * float(sample.pressure.max())


def spread(body):
    return float(np.nanmax(body.heights) - np.nanmean(body.heights))


@functools.cache
def made(name):
    body, operator = BODIES[name]()
    return body, operator, *limits(body, operator)


@pytest.fixture(params=BODIES)
def pressed(request):
    return made(request.param)


def path(body, operator, hardness, forces, **given):
    return list(
        rc.loading_path(body, MODULUS, forces=forces, operator=operator, hardness=hardness, **(TIGHT | given))
    )


def same(one, other, digits=1e-9):
    scale = max(float(one.pressure.max()), float(other.pressure.max()))
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=0, atol=30 * digits * scale)
    assert one.depth == pytest.approx(other.depth, rel=digits, abs=digits * spread(one.problem.surface))


def test_the_largest_load_is_that_of_press(pressed):
    body, operator, force, hardness = pressed
    given = {"operator": operator, "hardness": hardness, **TIGHT}
    top, below = rc.loading_path(body, MODULUS, forces=[force, force / 2], **given)
    alone = rc.press(body, MODULUS, force=force, **given)
    np.testing.assert_array_equal(top.pressure, alone.pressure)
    assert top.depth == alone.depth
    assert 0 < top.plastic.sum() < top.contact.sum()
    assert below.status.converged
    assert below.force == pytest.approx(force / 2, rel=1e-12)


def test_the_flattened_surface_is_in_elastic_contact_under_the_same_pressure(pressed):
    body, operator, force, hardness = pressed
    [top] = path(body, operator, hardness, [force])
    flat = top.flattened
    again = rc.press(flat.problem.surface, MODULUS, force=force, operator=operator, **TIGHT)
    np.testing.assert_allclose(again.pressure, top.pressure, rtol=0, atol=1e-8 * hardness)
    # Its depth counts from its own first touch.
    assert again.depth + flat.problem.first_touch == pytest.approx(top.depth, rel=1e-9)
    assert flat.stiffness == pytest.approx(again.stiffness, rel=1e-9)
    assert flat.interfacial_stiffness == pytest.approx(again.interfacial_stiffness, rel=1e-6)
    assert flat.elastic_energy == pytest.approx(top.elastic_energy, rel=1e-8)
    assert flat.stiffness > top.stiffness
    gap = flat.gap[flat.problem.measured]
    assert gap.min() > -1e-9 * spread(body)
    # What the contact lost is what the flat stood below the surface.
    assert flat.mean_gap - top.mean_gap == pytest.approx(
        top.flow.volume / flat.problem.measure.total(flat.problem.measured), rel=1e-6
    )


def test_reloading_is_unloading_and_an_elastic_cycle_leaves_no_memory(pressed):
    body, operator, force, hardness = pressed
    loads = force * np.array([0.5, 1.0, 1.0, 0.6, 0.2, 0.6, 1.0, 0.1, 1.4, 0.7])
    found = path(body, operator, hardness, loads)
    assert all(one.status.converged for one in found)
    for here, there in ((1, 2), (3, 5), (2, 6)):
        same(found[here], found[there])
    for one in found[2:8]:
        assert one.flow is found[2].flow
        assert not one.plastic.any()
        # Nothing bears more than at the turn, so nothing flows again: to the residual.
        assert (one.pressure <= found[1].pressure + 1e-8 * hardness).all()
    same(found[8], path(body, operator, hardness, [1.4 * force])[0])
    assert (found[9].flow.depth >= found[2].flow.depth - 1e-8 * spread(body)).all()


@pytest.mark.parametrize("flow", ["removed", "raised"])
def test_the_energy_of_flow_is_what_loading_takes_beside_the_elastic_energy(pressed, flow):
    """The integral of the force over the depth, by chords and the slopes at their ends.

    With a rise the energy is known to a hundredth, whatever the loads, or NaN.
    """
    body, operator, force, hardness = pressed
    given = {"operator": operator, "hardness": hardness, "flow": flow}
    plane = operator is None
    loads = force * np.linspace(0, 1, 51 if plane else 101)[1:] ** 2
    fine = rc.loading_curve(body, MODULUS, forces=loads, **given)
    columns = [np.append(0.0, values) for values in (fine.force, fine.depth, fine.stiffness)]

    def work(every):
        up, down, slope = (values[::every] for values in columns)
        return np.trapezoid(up, down) - (np.diff(slope) * np.diff(down) ** 2).sum() / 12

    spent = fine.flow.flow_energy[-1]
    # On lines and rings single cells begin to flow between two loads: what half of the loads miss is allowed too.
    missed = 0.0 if plane else 2 * abs(work(2) - work(1)) / 3
    assert work(1) - fine.elastic_energy[-1] == pytest.approx(spent, abs=missed + 1e-3 * spent)
    for count in (3, 6, 12):
        loads = np.linspace(0, force, count + 1)[1:]
        few = list(rc.loading_path(body, MODULUS, forces=[*loads, 0.5 * force], **given))
        assert few[-2].flow.energy == pytest.approx(spent, rel=1e-2, nan_ok=count < 12)
        np.testing.assert_equal(few[-1].flow.energy, few[-2].flow.energy)  # what is elastic spends nothing
        assert few[-2].elastic_energy == pytest.approx(fine.elastic_energy[-1], rel=1e-6)


@pytest.mark.parametrize("steps", [2, 7])
def test_the_number_of_steps_up_does_not_matter(pressed, steps):
    body, operator, force, hardness = pressed
    [once] = path(body, operator, hardness, [force])
    often = path(body, operator, hardness, np.linspace(0, force, steps + 1)[1:])
    same(once, often[-1])
    np.testing.assert_allclose(often[-1].flow.depth, once.flow.depth, rtol=0, atol=1e-8 * spread(body))
    for before, after in itertools.pairwise(often):
        assert (after.flow.depth >= before.flow.depth - 1e-8 * spread(body)).all()


def test_a_rise_changes_depths_and_nothing_else(pressed):
    body, operator, force, hardness = pressed
    loads = force * np.array([0.5, 1.0, 0.3])
    plain, raised = (path(body, operator, hardness, loads, flow=flow) for flow in ("removed", "raised"))
    measure, measured = plain[0].problem.measure, plain[0].problem.measured
    for one, other in zip(plain, raised, strict=True):
        rise = one.flow.volume / measure.total(measured)
        assert other.flow.rise == pytest.approx(rise, rel=1e-6)
        np.testing.assert_allclose(other.pressure, one.pressure, rtol=0, atol=1e-8 * hardness)
        assert one.depth - other.depth == pytest.approx(rise, rel=1e-6)
        assert other.mean_gap == pytest.approx(one.mean_gap, rel=1e-7)
        np.testing.assert_allclose(other.gap[measured], one.gap[measured], rtol=0, atol=1e-8 * spread(body))
    after = raised[-1].problem.surface
    volume = measure.total(np.where(measured, after.heights - body.heights, 0.0))
    assert abs(volume) < 1e-12 * raised[-1].flow.volume + 1e-15 * measure.total(measured) * spread(body)
    assert "raised by" in after.provenance[-1]


def test_work_is_elastic_energy_and_flow(pressed):
    """Force is linear in depth between one change of a cell and the next, so that a chord misses at most
    |change of slope| (step)^2/8 in each interval where a cell changes."""
    body, operator, force, hardness = pressed
    top = rc.press(body, MODULUS, force=force, operator=operator, hardness=hardness, **TIGHT)
    steps = 150
    depths = np.linspace(0, top.depth, steps + 1)[1:]
    given = {"operator": operator, "hardness": hardness, **TIGHT}
    found = list(rc.loading_path(body, MODULUS, depths=depths, **given))
    forces, slopes = ([0.0, *(getattr(one, name) for one in found)] for name in ("force", "stiffness"))
    work = np.trapezoid(forces, [0.0, *depths])
    stored = found[-1].elastic_energy + found[-1].flow.energy
    missed = np.abs(np.diff(slopes)).sum() * (depths[0]) ** 2 / 8
    assert missed < 1e-3 * stored
    assert work == pytest.approx(stored, abs=missed + 1e-8 * stored)


def test_work_to_the_last_change_of_a_cell():
    """On few rings every change of a cell is found, and with it the integral of the force."""
    body, operator = on_rings(n=12)
    force, hardness = limits(body, operator)
    problem = rc.press(body, MODULUS, force=force, operator=operator, hardness=hardness, tolerance=1e-13)

    def at(depth):
        return rc.press(body, MODULUS, depth=depth, operator=operator, hardness=hardness, tolerance=1e-13)

    def work(low, high, depth=0):
        state = [(one.force, one.contact.tobytes(), one.plastic.tobytes()) for one in (low, high)]
        if state[0][1:] == state[1][1:] or depth > 22:
            return (state[0][0] + state[1][0]) / 2 * (high.depth - low.depth)
        middle = at((low.depth + high.depth) / 2)
        return work(low, middle, depth + 1) + work(middle, high, depth + 1)

    found = work(at(1e-12), at(problem.depth))
    assert found == pytest.approx(problem.elastic_energy + problem.flow.energy, rel=1e-6)


def dense(body, hardness):
    """Return the matrix of a free plane, from Love's formula alone, and its Cholesky factor."""
    (ny, nx), (dy, dx) = body.grid.shape, body.grid.spacing
    y, x = (each.ravel() for each in np.meshgrid(np.arange(ny) * dy, np.arange(nx) * dx, indexing="ij"))
    matrix = love(np.abs(x[:, None] - x), np.abs(y[:, None] - y), dx, dy) / (np.pi * MODULUS)
    return matrix, scipy.linalg.cholesky((matrix + matrix.T) / 2)


def slow(factor, gap, hardness):
    """Return the pressure under which the plane is displaced by `-gap` where it may be: least squares in bounds."""
    target = scipy.linalg.solve_triangular(factor, -gap, trans="T")
    found = scipy.optimize.lsq_linear(
        factor, target, (0.0, hardness), method="bvls", tol=1e-14, lsq_solver="exact"
    )
    assert found.success
    return found.x


@pytest.mark.parametrize("spotty", [False, True], ids=["one hardness", "hardness by cell"])
@pytest.mark.parametrize("name", ["sphere", "cone", "rough"])
def test_against_a_dense_solution(name, spotty):
    grid = rc.Grid((11, 12), (0.1, 0.09))
    body = {
        "sphere": rc.shapes.paraboloid(grid, radius=1.0),
        "cone": rc.shapes.cone(grid, slope=0.3),
        "rough": rc.self_affine(grid, hurst=0.6, rms=0.02, rng=np.random.default_rng(8)),
    }[name]
    depth = 0.5 * spread(body)
    hardness = 0.4 * float(rc.press(body, MODULUS, depth=depth).pressure.max())
    limit = hardness * (1 + (np.arange(grid.size).reshape(grid.shape) % 3)) / 2 if spotty else hardness
    separation = (body.heights.max() - body.heights).ravel()
    matrix, factor = dense(body, hardness)
    bound = np.ravel(limit) if spotty else hardness
    p = slow(factor, separation - depth, bound)
    flow = np.where(p >= bound * (1 - 1e-9), np.maximum(depth - separation - matrix @ p, 0.0), 0.0)
    depths = depth * np.array([0.5, 1.0, 0.95, 0.8])
    found = list(rc.loading_path(body, MODULUS, depths=depths, hardness=limit, **TIGHT))
    top = found[1]
    np.testing.assert_allclose(top.pressure.ravel(), p, rtol=0, atol=1e-8 * hardness)
    np.testing.assert_allclose(top.flow.depth.ravel(), flow, rtol=0, atol=1e-8 * depth)
    assert top.flow.volume == pytest.approx(flow.sum() * grid.cell_area, rel=1e-7)
    assert top.flow.energy == pytest.approx((bound * flow).sum() * grid.cell_area, rel=1e-7)
    for here, one in zip(depths[2:], found[2:], strict=True):
        back = slow(factor, separation + flow - here, np.inf)
        np.testing.assert_allclose(one.pressure.ravel(), back, rtol=0, atol=3e-8 * hardness)
        np.testing.assert_array_equal(one.contact.ravel(), back > 1e-8 * hardness)
    residual = float((separation + flow).min())
    assert top.flattened.problem.first_touch == pytest.approx(residual, rel=1e-8)
    apart = list(rc.loading_path(body, MODULUS, depths=[depth, 0.999 * residual], hardness=limit, **TIGHT))[1]
    assert (apart.status, apart.force, apart.depth) == (rc.Status.NO_CONTACT, 0.0, 0.999 * residual)


def test_pullen_and_williamson_and_the_bearing_curve():
    """Next to no elasticity: the area is F/H, where the surface stands highest; the rest has risen by what flowed."""
    surface = plane(True, (32, 32))
    heights = np.sort(surface.heights.ravel())[::-1]
    bearing = rc.material_ratio(surface)
    hardness, count = 1e-9, 300.5
    force = hardness * count * surface.grid.cell_area
    plain, raised = (
        path(surface, None, hardness, [force], flow=flow, tolerance=1e-8)[0] for flow in ("removed", "raised")
    )
    assert raised.contact_fraction == pytest.approx(301 / surface.grid.size, rel=1e-12)
    plate = heights[0] - plain.depth  # above the same zero as the heights
    assert plate == pytest.approx(heights[300], abs=1e-7)
    assert bearing.ratio_at(plate) == pytest.approx(raised.contact_fraction, abs=1 / surface.grid.size)
    rise = np.maximum(heights - plate, 0.0).mean()
    # Displacements are of the order of the hardness times the side, over the modulus: 1e-9.
    assert raised.flow.rise == pytest.approx(rise, abs=1e-7)
    assert plain.depth - raised.depth == pytest.approx(raised.flow.rise, rel=1e-9)
    assert raised.problem.first_touch == -raised.flow.rise  # before the load, the bodies touch at depth zero
    assert plain.problem.first_touch == 0
    after = raised.flattened.problem.surface.heights
    assert after.mean() == pytest.approx(surface.heights.mean(), abs=1e-14)
    np.testing.assert_allclose(after, np.minimum(surface.heights, plate) + rise, rtol=0, atol=1e-7)


def test_a_hardness_that_is_never_reached(pressed):
    body, operator, force, _ = pressed
    loads = force * np.array([0.3, 1.0])
    plain = list(rc.loading_path(body, MODULUS, forces=loads, operator=operator, **TIGHT))
    found = path(body, operator, 1e6, [*loads, *loads[::-1]])
    for one, other in zip([*plain, *plain[::-1]], found, strict=True):
        same(one, other)
        assert other.stiffness == pytest.approx(one.stiffness, rel=1e-8)
        assert other.flow.volume == other.flow.energy == 0
    assert plain[0].flow is None
    assert plain[0].flattened is plain[0]


def test_a_cell_that_is_just_at_the_hardness_answers_on_unloading():
    """The hardness is the largest pressure of the elastic contact, but for rounding: the cell hardly flows."""
    surface = plane()
    elastic = rc.press(surface, MODULUS, force=0.01, **TIGHT)
    hardness = float(elastic.pressure.max()) * (1 - 1e-12)
    just = rc.press(surface, MODULUS, force=0.01, hardness=hardness, **TIGHT)
    assert just.plastic.sum() == 1
    assert just.flow.volume <= 1e-9 * spread(surface) * surface.grid.area
    assert just.stiffness < (1 - 1e-6) * elastic.stiffness
    assert just.flattened.stiffness == pytest.approx(elastic.stiffness, rel=1e-9)


def test_a_hardness_of_every_cell_that_is_one_number(pressed):
    body, operator, force, hardness = pressed
    [one] = path(body, operator, hardness, [force])
    [other] = path(body, operator, np.full(body.grid.shape, hardness), [force])
    same(one, other)
    assert other.plastic.sum() == one.plastic.sum()
    assert other.flow.energy == pytest.approx(one.flow.energy, rel=1e-7)


def test_deep_into_full_contact_by_depths():
    """A plastic periodic body can be pressed to any depth; what is left is in full contact, to the residual."""
    surface = plane(True)
    depths = np.array([1.0, 2.0, 2.0, 1.9]) * surface.heights.max()
    mean = float(surface.heights.max() - surface.heights.mean())
    given = {"hardness": 0.05 * MODULUS, **TIGHT}
    found = list(rc.loading_path(surface, MODULUS, depths=np.append(depths, mean), **given))
    assert all(one.status.converged or one.force == 0 for one in found)


def test_a_flattened_surface_goes_no_deeper_than_full_contact():
    """At a loose tolerance some cells overlap that have not flowed, so that it ends above the depth of the turn."""
    surface = plane(True, (12, 16), seed=2)
    deep = 1.7 * surface.heights.max()
    given = {"hardness": 0.25 * MODULUS, "tolerance": 1e-3, "solver": rc.PolonskyKeer()}
    top, again = rc.loading_path(surface, MODULUS, depths=[deep, deep], **given)
    full = again.problem.mean_separation
    assert full < deep * (1 - 1e-8)
    assert top.depth == deep
    assert again.depth == full
    assert again.mean_gap >= -1e-15 * deep


def test_the_flow_of_two_bodies_is_that_of_the_softer():
    soft, hard = plane(True, seed=1), plane(True, seed=2)
    both = rc.combined(soft, hard, turned_about=None)
    [top] = path(both, None, 0.05, [0.01])
    assert top.flow.volume > 0
    flattened = top.flow.flatten(soft) + hard
    np.testing.assert_allclose(flattened.heights, top.flattened.problem.surface.heights, rtol=0, atol=1e-15)
    with pytest.raises(ValueError, match="bring the surface onto the grid that was pressed"):
        top.flow.flatten(plane(shape=(8, 8)))


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("flow", ["removed", "raised"])
def test_arrays_of_other_libraries(library, flow):
    here = plane()
    there = rc.Surface(library.put(here.heights.copy()), here.grid)
    limit = np.linspace(0.1, 0.3, here.grid.size).reshape(here.grid.shape)
    for hardness, beside in ((0.2, 0.2), (limit, limit), (limit, library.put(limit.copy()))):
        loads = [0.005, 0.02, 0.004]
        one, other = (
            path(body, None, each, loads, flow=flow) for body, each in ((here, hardness), (there, beside))
        )
        assert library.is_there(other[-1].flow.depth)
        for a, b in zip(one, other, strict=True):
            np.testing.assert_allclose(library.get(b.pressure), a.pressure, rtol=0, atol=1e-8)
            assert b.depth == pytest.approx(a.depth, rel=1e-8)
            assert b.flow.volume == pytest.approx(a.flow.volume, rel=1e-6)
            fields = b.to_dataset()
            np.testing.assert_allclose(fields.flow_depth, a.flow.depth, rtol=0, atol=1e-9)
            assert float(fields.unloading_stiffness) == pytest.approx(a.flattened.stiffness, rel=1e-6)


def test_what_makes_no_sense_is_refused():
    surface = plane()
    for given, says in (
        ({"forces": [2e-3, 1e-3]}, "only under a hardness and in adhesive_path do loads go up and down"),
        (
            {"forces": [1e-3], "hardness": 0.1, "flow": "lost"},
            "flow must be 'removed' or 'raised', not 'lost'",
        ),
        ({"depths": [1e-3], "hardness": 0.1, "flow": "raised"}, "give forces or pressures"),
        ({"forces": [1e-3], "hardness": np.ones(3)}, "one for each cell of the grid"),
        ({"forces": [1e-3], "hardness": np.zeros(surface.grid.shape)}, "positive and finite"),
        (
            {"forces": [1e9], "hardness": np.ones(surface.grid.shape)},
            "the most that all measured cells can carry",
        ),
    ):
        with pytest.raises(ValueError, match=says):
            rc.loading_path(surface, MODULUS, **given)
