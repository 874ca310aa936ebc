"""What makes no sense is refused with its value and a remedy; what should be known is said."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.friction.slide import slide, slide_path
from roughcontact.halfspace.shear.shear_operator import shear_half_space

BODY = rc.Solid(1.0, 0.3)


def wave(periodic=False, n=16):
    grid = rc.Grid((n, n), 1.0, periodic)
    y, x = np.meshgrid(*grid.coordinates, indexing="ij")
    return rc.Surface(0.2 * np.cos(2 * np.pi * x / n) * np.cos(2 * np.pi * y / n), grid)


@pytest.fixture(scope="module")
def solution():
    return rc.press(wave(), BODY, force=1.0)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"friction": 0.0}, "friction coefficient must be positive and finite, not 0.0"),
        ({"friction": -0.3}, "friction"),
        ({"friction": np.nan}, "friction must be a number"),
        ({"friction": np.inf}, "friction coefficient"),
        ({"force": 0.31}, "holds at most mu P = 0.3 N: under 0.31 N the bodies slide away"),
        ({"force": (0.25, 0.25)}, "slide away"),
        ({"force": np.nan}, "finite"),
        ({"force": (1.0, 2.0, 3.0)}, "two \\(x, y\\)"),
        ({"force": "10N"}, "SI units, not '10N'"),
        ({"force": None}, "exactly one"),
        ({"displacement": 1.0}, "exactly one"),
        ({"force": None, "displacement": 1e300}, "at most 1e\\+50"),
        ({"tolerance": 0.0}, "tolerance must lie"),
        ({"bodies": 1.0}, "E\\* does not determine"),
        ({"bodies": rc.Solid(2.0, 0.3)}, "use the same bodies for both"),
        ({"along": (0, 0)}, "a direction"),
        ({"along": (1, 2, 3)}, "a direction"),
        ({"along": (1, 0), "force": (0.1, 0.01)}, "omit `along`"),
        ({"operator": shear_half_space(rc.Grid((4, 4), 1.0), BODY)}, "is not the contact's"),
        ({"solution": wave()}, "solution must be a Solution, as rc.press returns it, not a Surface"),
    ],
)
def test_nonsense_is_refused(solution, more, message):
    arguments = {"solution": solution, "bodies": BODY, "friction": 0.3, "force": 0.1} | more
    with pytest.raises(ValueError, match=message):
        slide(arguments.pop("solution"), arguments.pop("bodies"), **arguments)


def test_contacts_of_other_kinds_are_refused():
    line = rc.Grid(32, 1.0)
    heights = rc.Surface(-0.01 * (np.arange(32) - 15.5) ** 2, line)
    for operator, kind in ((rc.line(line, 1.0), "line"), (rc.foundation(line, 1.0), "foundation")):
        pressed = rc.press(heights, 1.0, force=0.1, operator=operator)
        with pytest.raises(ValueError, match=f"not for a {kind}"):
            slide(pressed, rc.Solid(1.0, 0.0), friction=0.3, force=0.01)
    rings = rc.RadialGrid.uniform(20, 0.1)
    ball = rc.RadialProfile(-(rings.radii**2) / 2, rings)
    with pytest.raises(ValueError, match="not for a ring"):
        slide(rc.press(ball, 1.0, force=1e-5), rc.Solid(1.0, 0.0), friction=0.3, force=1e-6)


def test_bodies_that_do_not_touch():
    apart = rc.press(wave(), BODY, depth=0.0)
    with pytest.raises(ValueError, match="do not touch"):
        slide(apart, BODY, friction=0.3, force=0.0)


def test_full_contact_of_a_period_has_no_displacement():
    full = rc.press(wave(True), BODY, pressure=1.0)
    with pytest.raises(ValueError, match="give a force"):
        slide(full, BODY, friction=0.3, displacement=0.1)


def test_a_state_of_another_contact_is_no_start(solution):
    state = slide(solution, BODY, friction=0.3, force=0.1)
    again = rc.press(wave(), BODY, force=1.0)
    with pytest.raises(ValueError, match="another contact"):
        slide(again, BODY, friction=0.3, force=0.1, initial=state)
    with pytest.raises(ValueError, match="continue with the same"):
        slide(solution, BODY, friction=0.2, force=0.1, initial=state)
    with pytest.raises(ValueError, match="continue with the same"):
        slide(solution, BODY, friction=0.3, force=0.1, initial=state, along=(1, 0))
    other = shear_half_space(solution.problem.grid, BODY, method="dense")
    with pytest.raises(ValueError, match="another operator"):
        slide(solution, BODY, friction=0.3, force=0.1, initial=state, operator=other)
    with pytest.raises(ValueError, match="tolerance must lie"):
        slide(solution, BODY, friction=0.3, force=0.1, initial=state, tolerance=1.0)


@pytest.mark.parametrize(
    ("loads", "message"),
    [
        ({"forces": []}, "at least one load"),
        ({"displacements": 0.1}, "in a row, not 0.1"),
        ({}, "exactly one of forces and displacements"),
        ({"forces": [0.1], "displacements": [0.1]}, "exactly one of forces and displacements"),
        ({"forces": [0.1, 0.4]}, "slide away"),
        ({"forces": [0.1, "0.2"]}, "SI units"),
        ({"forces": [[0.1, 0.1, 0.1]]}, "two"),
        ({"forces": [0.1, np.nan]}, "finite"),
    ],
)
def test_a_path_is_refused_before_its_first_load(solution, loads, message):
    with pytest.raises(ValueError, match=message):
        slide_path(solution, BODY, friction=0.3, **loads)


def test_nothing_is_no_load(solution):
    """Without force nothing moves, and there is nothing to warn of."""
    for rest in ({"force": 0.0}, {"displacement": (0, 0)}):
        answer = slide(solution, BODY, friction=0.3, **rest)
        assert not answer.traction.any()
        assert answer.residual == 0
        assert answer.dissipated == 0
        assert not answer.slipping.any()
        assert repr(answer).startswith(
            "TangentialSolution(converged, force (0, 0) N, displacement (0, 0) m, 0 of "
        )


def test_unlike_bodies_are_told(solution):
    """One against a rigid body couples pressure and shear; equal ones, or both incompressible, do not."""
    assert "Dundurs's parameter 0.29" in slide(solution, BODY, friction=0.3, force=0.1).notes[0]
    for pair in ((rc.Solid(1.0, 0.3),) * 2, (rc.Solid(1.0, 0.5), rc.Solid(4.0, 0.5))):
        pressed = rc.press(wave(), pair, force=1.0)
        assert slide(pressed, pair, friction=0.3, force=0.1).notes == ()


def test_what_is_returned_is_not_to_be_written_to(solution):
    answer = slide(solution, BODY, friction=0.3, force=0.1)
    for field in (answer.traction, answer.slip):
        with pytest.raises(ValueError, match="read-only"):
            field[:] = 0


def test_a_number_for_the_modulus_is_taken_at_its_word():
    """Bodies must have the E* that the contact was pressed with; a contact that keeps it to itself says nothing."""
    modulus = rc.reduced_modulus(BODY)
    pressed = rc.press(wave(), modulus, force=1.0)
    assert slide(pressed, BODY, friction=0.3, force=0.1).status.converged
