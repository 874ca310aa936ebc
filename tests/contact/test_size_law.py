"""A hardness by the size of the spots: spots and hardness agree, whatever the loads before, or the status says not."""

import numpy as np
import pytest

import roughcontact as rc
from libraries import LIBRARIES

MODULUS = 2.0


@pytest.fixture(params=["free", "periodic", "line", "rings"])
def pressed(request):
    if request.param == "rings":
        rings = rc.RadialGrid.uniform(40, 1.0)
        return rc.RadialProfile(-(rings.radii**2) / 2, rings), None, 0.2, np.sqrt(rings.cell_area / np.pi)
    if request.param == "line":
        grid = rc.Grid(80, 0.02)
        line = rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(5))
        return line, rc.line(grid, MODULUS), 0.05, 0.01
    grid = rc.Grid((24, 20), 0.05, request.param == "periodic")
    surface = rc.self_affine(grid, hurst=0.8, rms=0.02, rng=np.random.default_rng(3))
    return surface, None, 0.02, 0.05 / np.sqrt(np.pi)


def spots_and_hardness(solution):
    """Return the radius of the spot of each cell in contact, and the hardness there."""
    spots = solution.spots
    line = solution.problem.grid.ndim == 1 and isinstance(solution.problem.grid, rc.Grid)
    radii = spots.areas / 2 if line else np.sqrt(spots.areas / np.pi)
    return radii[spots.labels[solution.contact] - 1], solution.problem.hardness[solution.contact]


def test_spots_and_hardness_agree(pressed):
    body, operator, force, cell = pressed
    law = rc.NixGao(hardness=0.15, radius=0.1)
    solution = rc.press(body, MODULUS, force=force, operator=operator, hardness=law)
    radii, hardness = spots_and_hardness(solution)
    np.testing.assert_array_equal(hardness, law(radii))
    np.testing.assert_allclose(
        solution.problem.hardness[~solution.contact],
        law(np.broadcast_to(cell, body.grid.shape))[~solution.contact],
    )
    assert solution.plastic.any()
    assert (solution.pressure <= solution.problem.hardness).all()
    assert solution.force == pytest.approx(force, rel=1e-12)


def test_it_does_not_depend_on_the_steps(pressed):
    body, operator, force, _ = pressed
    given = {"operator": operator, "hardness": rc.NixGao(hardness=0.15, radius=0.1), "tolerance": 1e-10}
    once = rc.press(body, MODULUS, force=force, **given)
    often = list(rc.loading_path(body, MODULUS, forces=force * np.array([0.2, 0.5, 0.8, 1.0, 0.4]), **given))
    np.testing.assert_array_equal(often[3].problem.hardness, once.problem.hardness)
    assert often[3].depth == pytest.approx(once.depth, rel=1e-9)
    assert often[4].status.converged
    assert often[4].flow.volume == pytest.approx(once.flow.volume, rel=1e-7)


def test_a_law_that_is_one_number_is_that_number(pressed):
    body, operator, force, _ = pressed
    given = {"force": force, "operator": operator, "tolerance": 1e-10}
    one, law = (rc.press(body, MODULUS, hardness=h, **given) for h in (0.15, lambda a: 0.15 + 0 * a))
    assert law.depth == pytest.approx(one.depth, rel=1e-9)
    np.testing.assert_array_equal(law.contact, one.contact)


def test_depths_from_the_first_touch_on(pressed):
    body, operator, _, cell = pressed
    depths = 0.4 * (body.heights.max() - body.heights.mean()) * np.array([0.0, 1.0, 0.0])
    law = rc.NixGao(hardness=0.02, radius=0.1)
    curve = rc.loading_curve(body, MODULUS, depths=depths, operator=operator, hardness=law)
    assert curve.flow.flow_volume[0] == 0 < curve.flow.flow_volume[1] == curve.flow.flow_volume[2]
    assert curve.status[0] is curve.status[2] is rc.Status.NO_CONTACT
    touch = rc.press(body, MODULUS, depth=0.0, operator=operator, hardness=law)
    np.testing.assert_allclose(touch.problem.hardness, law(np.broadcast_to(cell, body.grid.shape)))


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda kind: kind.__name__)
def test_spots_elsewhere_than_on_the_host_are_refused(library):
    ball = rc.shapes.paraboloid(rc.Grid((9, 9), 0.1), radius=3.0)
    there = rc.Surface(library.put(ball.heights.copy()), ball.grid)
    with pytest.raises(ValueError, match="labelled on the host"):
        rc.press(there, MODULUS, force=0.01, hardness=rc.NixGao(0.1, 1.0))


def test_large_spots_of_the_law_have_its_hardness():
    law = rc.NixGao(hardness=3.0, radius=2.0)
    assert law(2.0) == 3.0 * np.sqrt(2)
    assert law(2e12) == pytest.approx(3.0, rel=1e-12)
    assert (np.diff(law(np.geomspace(1e-3, 1e3, 50))) < 0).all()


def test_a_law_that_hardens_may_find_no_end_and_says_so():
    """A ball whose spot flows while it is small, and is hard when it is large: neither is its own hardness."""
    ball = rc.shapes.paraboloid(rc.Grid((21, 21), 0.1), radius=3.0)
    force = 0.1
    soft, hard = (rc.press(ball, MODULUS, force=force, hardness=h) for h in (0.16, 50.0))
    assert soft.contact_area > hard.contact_area
    between = np.sqrt((soft.contact_area + hard.contact_area) / 2 / np.pi)

    def law(radius):
        return np.where(radius > between, 50.0, 0.16)

    with pytest.raises(rc.ConvergenceError) as caught:
        rc.press(ball, MODULUS, force=force, hardness=law)
    assert caught.value.solution.status is rc.Status.UNSETTLED
    assert "did not settle" in rc.Status.UNSETTLED.message
    curve = rc.loading_curve(ball, MODULUS, forces=[force, force / 2], hardness=law)
    # What was not known at the turn is not known on the way back.
    assert curve.status == (rc.Status.UNSETTLED, rc.Status.AFTER_MISSED)


@pytest.mark.parametrize("law", [lambda a: -a, lambda a: 1.0, lambda a: np.full_like(a, np.nan)])
def test_a_law_that_gives_no_hardness_is_refused(law):
    ball = rc.shapes.paraboloid(rc.Grid((9, 9), 0.1), radius=3.0)
    with pytest.raises(ValueError, match="by the size of spots must be positive and finite"):
        rc.press(ball, MODULUS, force=0.01, hardness=law)


@pytest.mark.parametrize("given", [{"hardness": 0.0, "radius": 1.0}, {"hardness": 1.0, "radius": -1.0}])
def test_what_is_no_law_of_nix_and_gao_is_refused(given):
    with pytest.raises(ValueError, match="must be"):
        rc.NixGao(**given)
