"""A curve says first what makes it doubtful: a contact that does not change, loads that follow no power law."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((64, 64), 1e-6)
FORCES = np.geomspace(1e-3, 1e-2, 9)


@pytest.fixture(scope="module")
def hertz():
    return rc.loading_curve(rc.shapes.paraboloid(GRID, radius=1e-4), 1e9, forces=10 * FORCES)


def streaked(height):
    """Return a rough map of rms height 100 nm with four flat streaks of 80 cells."""
    grid = rc.Grid((128, 128), 1e-6)
    heights = rc.self_affine(grid, 0.8, 1e-7, np.random.default_rng(3)).heights.copy()
    heights[20::30, 10:90] = height
    return rc.Surface(heights, grid)


def with_area(curve, exponent, span):
    """Return the curve with an area that grows as a power of the force, from the smallest to `span` times as much."""
    force = np.geomspace(0.05, 0.05 * span, len(curve))
    return replace(curve, force=force, contact_area=1e-10 * (force / force[0]) ** exponent)


def test_loads_on_the_same_streaks_are_named_first():
    """Flat punches, whose stiffness is that of any load; without them it grows with the load."""
    surface = streaked(5e-6)
    curve, clean = (rc.loading_curve(each, 1e9, forces=FORCES) for each in (surface, surface.despiked()))
    assert np.ptp(curve.contact_area) == 0
    np.testing.assert_allclose(curve.stiffness, curve.stiffness[0], rtol=1e-6)
    note = curve.notes[0]
    assert note.startswith("The contact does not change from 1 mN to 10 mN: the same 4 spots carry all")
    assert "despiked() or masked()" in note
    assert repr(curve).endswith("; The contact does not change from 1 mN to 10 mN)")
    assert "The contact does not change" in curve._repr_html_()
    assert clean.resolved.all()
    assert clean.notes == ()


def test_the_range_of_fixed_loads_is_named_where_others_reach_further():
    """The rest of the map is touched from a force of 0.03 N on."""
    curve = rc.loading_curve(streaked(6e-7), 1e9, forces=10 * FORCES)
    assert (curve.contact_area > 1.05 * curve.contact_area[0]).tolist() == [False] * 4 + [True] * 5
    assert curve.notes[0].startswith("The contact does not change from 10 mN to 23.7 mN: the same 4 spots")


def test_bodies_whose_contact_grows_are_not_doubtful(hertz):
    """A Hertz sphere on its one spot, a blunt body z ~ r^8, whose area grows as F^(2/9), and a rough map."""
    assert hertz.notes == ()
    assert repr(hertz).endswith(" N)")
    y, x = np.meshgrid(*GRID.coordinates, indexing="ij")
    radius = np.hypot(y - y.mean(), x - x.mean())
    blunt = rc.Surface(-1e-6 * (radius / 2e-5) ** 8, GRID)
    assert rc.loading_curve(blunt, 1e9, forces=10 * FORCES).notes == ()
    rough = rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(3))
    assert rc.loading_curve(rough, 1e9).notes == ()


@pytest.mark.parametrize(
    ("exponent", "span", "doubtful"),
    [(0.0, 10, True), (0.04, 10, True), (0.06, 10, False), (0.0, 2.1, True), (0.0, 1.9, False)],
)
def test_a_fixed_contact_is_one_that_grows_by_less_than_the_twentieth_power(hertz, exponent, span, doubtful):
    fixed = [note for note in with_area(hertz, exponent, span).notes if "does not change" in note]
    assert bool(fixed) == doubtful


def test_nearly_all_in_contact_is_no_doubt(hertz):
    for share, doubtful in ((0.49, True), (0.51, False)):
        curve = replace(hertz, contact_area=np.full(len(hertz), share * hertz.nominal_area))
        assert any("does not change" in note for note in curve.notes) == doubtful


@pytest.mark.parametrize(("size", "doubtful"), [(0.08, False), (0.13, True)])
def test_a_power_law_that_scatters_by_more_than_a_tenth_is_named(hertz, size, doubtful):
    """Of nine points above and below the law in turn the mean is a ninth of their size; Hertz scatters by 0.02."""
    ripple = size * (-1.0) ** np.arange(len(hertz))
    curve = replace(hertz, stiffness=hertz.stiffness * np.exp(ripple))
    assert curve.fit().scatter == pytest.approx(size, abs=0.02)
    assert [note.partition(" by ")[0] for note in curve.notes] == ["The power law scatters"] * doubtful
