"""Full sliding, by a kernel of its own: what is the law's, what is the convention's, and what the answer says of it."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.friction.contact_cells import ContactCells

MU = 0.3
E = np.array([0.8, 0.6])
ROUNDING = 1e-13  # of the largest displacement: a product of 300 cells rounds by less than so many units


def pressed(nu):
    """A rough contact of some 300 cells, a third of a free square."""
    grid = rc.Grid((24, 24), (1e-6, 1.5e-6))
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
    body = rc.Solid(1e11, nu)
    return rc.press(surface, body, pressure=0.02 * rc.reduced_modulus(body)), body


@pytest.fixture(scope="module", params=[-0.5, 0.3, 0.5])
def case(request):
    return pressed(request.param)


@pytest.fixture(scope="module")
def slid(case):
    solution, body = case
    return rc.slide(solution, body, friction=MU, force=MU * solution.force * E)


def moved(answer):
    """Displacement of the cells by Johnson's equations 3.91, 3.92, as logarithms: shares no code with the library."""
    contact = answer.problem.pressed.contact
    body, (dy, dx) = answer.problem.bodies, answer.problem.pressed.problem.grid.spacing
    rows, columns = np.nonzero(contact)
    x, y = dx * (columns[:, None] - columns), dy * (rows[:, None] - rows)

    def over_cell(corner):
        right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
        return corner(right, top) - corner(left, top) - corner(right, bottom) + corner(left, bottom)

    xx = over_cell(lambda x, y: y * np.log(x + np.hypot(x, y)))  # of x^2/r^3
    yy = over_cell(lambda x, y: x * np.log(y + np.hypot(x, y)))
    xy = over_cell(lambda x, y: -np.hypot(x, y))
    love, nu = (1 - body.poisson_ratio) * (xx + yy), body.poisson_ratio
    qx, qy = answer.traction[:, contact] * (1 + nu) / (np.pi * body.young_modulus)
    return np.stack([(love + nu * xx) @ qx + nu * xy @ qy, nu * xy @ qx + (love + nu * yy) @ qy])


def misses(traction, slip):
    """By how much slip misses the ray opposed to the traction, cell by cell [m]."""
    unit = traction / np.hypot(*traction)
    return np.hypot(*(slip - np.minimum((slip * unit).sum(axis=0), 0) * unit))


def test_traction_is_all_that_friction_holds_along_the_force(case, slid):
    solution, _ = case
    exact = MU * solution.pressure * E[:, None, None]
    np.testing.assert_allclose(slid.traction, exact, rtol=1e-14)
    assert slid.status.converged


def test_every_cell_has_slipped_forward_and_the_last_just_so(slid):
    """The displacement is the least of such: to the rounding of the logarithms."""
    u = moved(slid)
    forward = E @ (u - slid.displacement[:, None])
    assert abs(forward.max()) <= 1e-12 * np.hypot(*u).max()
    assert slid.residual <= ROUNDING


def test_slip_of_the_step_is_not_all_opposed_and_the_answer_says_by_how_much(slid):
    """For nu = 0 alone it is: else no finite displacement meets the law under this force."""
    contact, u = slid.problem.pressed.contact, moved(slid)
    worst = misses(slid.traction[:, contact], u - slid.displacement[:, None]).max() / np.hypot(*u).max()
    assert worst > 0.02
    assert slid.step_residual == pytest.approx(worst, rel=1e-9)
    assert f"up to {slid.step_residual:.1e} of the largest displacement" in slid.notes[-1]


def test_as_the_slide_goes_on_slip_is_opposed_to_the_traction(case, slid):
    """What the residual is about: the next step slips along the force in every cell, under the same traction."""
    solution, body = case
    way = 1e-7 * E
    onward = rc.slide(solution, body, friction=MU, displacement=slid.displacement + way, initial=slid)
    np.testing.assert_allclose(onward.traction, slid.traction, rtol=1e-14)
    contact = solution.contact
    slip = (moved(onward) - onward.displacement[:, None]) - (moved(slid) - slid.displacement[:, None])
    assert misses(onward.traction[:, contact], slip).max() <= 1e-13 * np.hypot(*moved(slid)).max()
    assert onward.step_residual == onward.residual <= ROUNDING


def test_from_another_slide(case, slid):
    """Slip of the step counts from where the one before has left the cells."""
    solution, body = case
    back = rc.slide(solution, body, friction=MU, force=(-MU * solution.force, 0.0), initial=slid)
    u, contact = moved(back), solution.contact
    slip = (u - back.displacement[:, None]) - (moved(slid) - slid.displacement[:, None])
    scale = max(np.hypot(*u).max(), np.hypot(*moved(slid)).max())
    worst = misses(back.traction[:, contact], slip).max() / scale
    assert back.step_residual == pytest.approx(worst, rel=1e-9)
    assert back.residual <= ROUNDING
    assert slip[0].min() >= -1e-12 * scale


@pytest.mark.parametrize(("nu", "along"), [(0.0, None), (0.4, tuple(E))])
def test_where_nothing_slips_across_the_step_itself_meets_the_law(nu, along):
    solution, body = pressed(nu)
    force = MU * solution.force * (E if along is None else 1.0)
    answer = rc.slide(solution, body, friction=MU, force=force, along=along)
    assert answer.step_residual <= ROUNDING
    assert answer.notes[-1] == "Every cell slips: the bodies slide."


def test_below_full_sliding_the_law_is_the_steps(case):
    solution, body = case
    answer = rc.slide(solution, body, friction=MU, force=0.9 * MU * solution.force * E)
    assert answer.step_residual == answer.residual <= 1e-8


def test_the_slide_is_the_limit_of_partial_slip(case, slid):
    """Traction turned by a small angle costs its square in force: both angle and 1/displacement go as the root."""
    solution, body = case
    displacements, angles = [], []
    for left in (1e-6, 1e-8):
        answer = rc.slide(solution, body, friction=MU, force=(1 - left) * MU * solution.force * E)
        displacements.append(E @ answer.displacement)
        angles.append(np.abs(answer.traction - slid.traction).max() / slid.traction.max())
    # The angle is that of the slip, whose elastic part along the force is at most the displacement of the slide.
    part = E @ slid.displacement / displacements[0]
    assert part < 0.15
    assert displacements[1] / displacements[0] == pytest.approx(10, rel=part)
    assert angles[0] / angles[1] == pytest.approx(10, rel=part)


def test_a_slide_is_certified_by_its_product(monkeypatch):
    solution, body = pressed(0.3)
    monkeypatch.setattr(ContactCells, "apply", lambda self, traction: np.nan * traction)
    with pytest.raises(rc.ConvergenceError):
        rc.slide(solution, body, friction=MU, force=MU * solution.force)
