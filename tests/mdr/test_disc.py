"""Bodies whose transform falls: discs are found where they are, and rings refused."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.indentation import indent, indentation_curve

RIPPLED = indenter.paraboloid(1.0) + indenter.ripples(6e-3, 0.25, 1.0)


def pressed(force, n=97):
    """Return the number of contact spots, the area and the depth of the rippled body on a 3-D grid."""
    grid = rc.Grid((n, n), (1.2 / n, 1.2 / n))
    y, x = (c - 0.6 for c in grid.coordinates)
    surface = rc.Surface(-RIPPLED.height(np.minimum(np.hypot(y[:, None], x), 1.0)), grid)
    solution = rc.press(surface, 1.0, force=force)
    rings = np.diff(solution.contact[n // 2].astype(int))
    return int((rings == 1).sum()), solution


def test_the_body_is_a_case():
    x = np.linspace(0, 1, 1000)
    assert np.diff(RIPPLED.transform(x)).min() < 0
    assert not RIPPLED.rises


@pytest.mark.parametrize("force", [1e-4, 0.3])
def test_a_small_and_a_large_load_make_a_disc(force):
    spots, solution = pressed(force)
    assert spots == 1
    contact = indent(RIPPLED, 1.0, force=force)
    # The tip spans a few cells of the grid at the small load.
    assert solution.depth == pytest.approx(contact.depth, rel=3e-2 if force < 0.1 else 1e-3)
    assert solution.contact_area == pytest.approx(contact.contact_area, rel=0.15 if force < 0.1 else 0.02)


def test_a_load_between_makes_a_ring_and_is_refused():
    force = 4e-3
    spots, _ = pressed(force)
    assert spots == 3
    with pytest.raises(ValueError, match=r"not one disc.*(tension|touch)"):
        indent(RIPPLED, 1.0, force=force)
    with pytest.raises(ValueError, match="not one disc"):
        indentation_curve(RIPPLED, 1.0, forces=[1e-4, force])


def test_depth_and_force_find_the_same_disc():
    by_force = indent(RIPPLED, 1.0, force=0.3)
    by_depth = indent(RIPPLED, 1.0, depth=by_force.depth)
    assert by_depth.contact_radius == pytest.approx(by_force.contact_radius, rel=1e-9)
    by_radius = indent(RIPPLED, 1.0, contact_radius=by_force.contact_radius)
    assert by_radius.force == pytest.approx(0.3, rel=1e-9)


def test_a_radius_that_no_load_has_is_refused():
    x = np.linspace(0, 0.4, 2000)
    falling = float(x[np.diff(RIPPLED.transform(x)).argmin()])
    with pytest.raises(ValueError, match=r"not one disc|no load gives"):
        indent(RIPPLED, 1.0, contact_radius=falling)


def test_a_falling_body_must_end_somewhere():
    with pytest.raises(ValueError, match="cut"):
        indent(indenter.paraboloid(1.0) - indenter.cone(0.01), 1.0, force=1.0)


def test_a_hollow_tip_touches_in_a_ring():
    hollow = (indenter.paraboloid(1.0) - indenter.cone(0.05)).cut(1.0)
    with pytest.raises(ValueError, match="not one disc"):
        indent(hollow, 1.0, depth=1e-4)


def test_a_rippled_body_that_rises_all_the_same_is_taken_at_every_load():
    gentle = indenter.paraboloid(1.0) + indenter.ripples(1e-4, 0.25, 1.0)
    curve = indentation_curve(gentle, 1.0, forces=np.geomspace(1e-6, 0.5, 10))
    assert (np.diff(curve.contact_radius) > 0).all()


def test_the_edge_of_a_falling_body_pins_its_contact():
    body = RIPPLED.cut(0.5)
    contact = indent(body, 1.0, depth=1.0)
    assert contact.contact_radius == 0.5
    assert contact.pressure(0.5) == np.inf
