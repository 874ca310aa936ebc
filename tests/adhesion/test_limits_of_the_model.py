"""Notes on surfaces that stick where linear elasticity, the preload, the loads or the range decide on the numbers."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

import roughcontact as rc
from roughcontact.adhesion.model_limits import SHALLOW, SHORT_RANGE, SPHERE, HighestSummit, highest_summit
from roughcontact.contact.problem import separation_of
from roughcontact.theory import maugis

R, W, SOFT, STIFF = 20e-9, 50e-3, 2.67e6, 1e9  # of an AFM tip on a sample of 2 and 750 MPa
RINGS = rc.RadialGrid.uniform(40, 6e-7)
BALL = rc.RadialProfile(-(RINGS.radii**2) / 2e-5, RINGS)
STRONG = rc.Adhesion(work=10e-3, range=4e-9, allow_unresolved=True)


def summit(surface, modulus, work=W):
    grid = surface.grid
    makers = {rc.RadialGrid: rc.ring, rc.Grid: rc.half_space if len(grid.shape) == 2 else rc.line}
    return highest_summit(makers[type(grid)](grid, modulus), separation_of(surface), modulus, work)


def about(notes, words):
    return sum(words in each for each in notes)


@pytest.mark.parametrize("modulus", [SOFT, STIFF])
@pytest.mark.parametrize("cells", [63, 64])
def test_the_radius_of_a_paraboloid_is_found_where_its_apex_lies_between_cells_too(cells, modulus):
    tip = rc.shapes.paraboloid(rc.Grid((cells, cells), 2e-9), radius=R)
    assert summit(tip, modulus).radius == pytest.approx(R, rel=1e-9)
    ridge = rc.shapes.paraboloid(rc.Grid(cells, 2e-9), radius=R)
    assert summit(ridge, modulus).radius == pytest.approx(R, rel=1e-9)
    rings = rc.RadialGrid.uniform(cells, 6e-8)
    assert summit(rc.RadialProfile(-(rings.radii**2) / (2 * R), rings), modulus).radius == pytest.approx(R)


def test_the_radius_of_a_rough_tip_is_that_of_the_tip_and_of_a_sphere_that_of_the_sphere():
    grid = rc.Grid((64, 64), 1e-9)
    roughness = rc.self_affine(grid, 0.8, rms=0.3e-9, rng=np.random.default_rng(1))
    # Over 0.53 of the radius or more the tip falls by at least 2.8 nm; roughness changes that by twice its rms height.
    assert summit(rc.shapes.paraboloid(grid, R) + roughness, SOFT).radius == pytest.approx(R, rel=0.6 / 2.8)
    # A sphere falls by 1 - sqrt(1 - u), u being (r/R)^2; least squares over all u up to 0.75^2, the largest distance.
    u = np.linspace(0, 0.75**2, 10_001)
    slope = np.polyfit(u, 1 - np.sqrt(1 - u), 1)[0]
    assert 1 - 0.5 / slope == pytest.approx(SPHERE, abs=0.005)
    assert summit(rc.shapes.sphere(grid, R), SOFT).radius == pytest.approx(R, rel=SPHERE)
    disc = rc.shapes.flat_disc(grid, 2e-8)
    assert summit(disc, SOFT).radius == math.inf
    assert summit(disc, SOFT).shallow


def test_the_radius_is_the_same_in_any_unit():
    """Of a rough tip, in metres and in nanometres."""
    grid = rc.Grid((64, 64), 1e-9)
    roughness = rc.self_affine(grid, 0.8, rms=0.3e-9, rng=np.random.default_rng(1))
    tip = rc.shapes.paraboloid(grid, 4 * R) + roughness
    large = rc.Surface(1e9 * tip.heights, rc.Grid((64, 64), 1.0))
    for modulus in (SOFT, STIFF):
        found = summit(large, modulus, 1e9 * W).radius
        assert found == pytest.approx(1e9 * summit(tip, modulus).radius, rel=1e-9)


@pytest.mark.parametrize("line", [False, True])
def test_contacts_and_preloads_are_those_of_the_curve_of_force_against_radius(line):
    def hertz(a):
        return math.pi * SOFT * a**2 / (4 * R) if line else 4 * SOFT * a**3 / (3 * R)

    def force(a):
        tension = 2 * math.pi * SOFT * W * a if line else 8 * math.pi * SOFT * W * a**3
        return hertz(a) - math.sqrt(tension)

    found = HighestSummit(R, SOFT, W, line)
    least = minimize_scalar(force, bounds=(0, 5 * R), method="bounded", options={"xatol": 1e-9 * R})
    assert found.unloaded_radius == pytest.approx(brentq(force, least.x, 20 * R), rel=1e-9)
    assert found.least_preload == pytest.approx(
        hertz(least.x), rel=1e-6
    )  # of a root of the precision at an extremum
    assert found.least_preload == pytest.approx(-least.fun / (3 if line else 1), rel=1e-6)


def test_at_the_bound_of_small_contacts_a_sphere_bears_a_tenth_more_than_a_paraboloid():
    a = SHALLOW  # of the radius 1; the modulus is 1
    sphere = (1 + a**2) / 2 * math.log((1 + a) / (1 - a)) - a  # Sneddon
    assert sphere / (4 * a**3 / 3) - 1 == pytest.approx(
        0.1, abs=0.02
    )  # the next term is a^4 3/7 of the first
    bound = a**3 / (4.5 * math.pi)  # w/(E* R)
    assert HighestSummit(1.0, 1.0, 0.99 * bound, False).shallow
    assert not HighestSummit(1.0, 1.0, 1.01 * bound, False).shallow


@pytest.mark.parametrize(("modulus", "expected"), [(SOFT, True), (STIFF, False)])
def test_a_contact_that_is_not_small_against_the_tip_is_noted(modulus, expected):
    rings = rc.RadialGrid.uniform(40, 8e-8)
    tip = rc.RadialProfile(-(rings.radii**2) / (2 * R), rings)
    adhesion = rc.Adhesion(W, range=5e-9, allow_unresolved=True)
    state = rc.adhesive_state(tip, modulus, adhesion, force=1e-9)
    curve = rc.adhesive_curve(tip, modulus, adhesion, forces=[1e-9])
    off = rc.detachment_curve(rc.press(tip, modulus, force=20e-9), W)
    for notes in (
        state.notes,
        curve.notes,
        off.notes,
        state.to_record()["notes"],
        curve.to_record()["notes"],
    ):
        assert about(notes, "The contact is not small against the body") == expected
    # (9 pi 50 mJ/m^2/(2 2.67 MPa 20 nm))^(1/3) = 2.37
    assert (
        about(state.notes, "2.4 times the radius of the highest summit, 20 nm (w/(E* R) is 0.94)") == expected
    )
    assert state.summit_radius == curve.summit_radius == pytest.approx(R)
    assert ("not small against the body" in state._repr_html_()) == expected
    assert ("not small against the body" in curve._repr_html_()) == expected


@pytest.mark.parametrize(("part", "expected"), [(0.2, True), (0.9, True), (2.0, False)])
def test_a_preload_below_the_pull_off_force_is_noted_on_a_rough_tip(part, expected):
    """Of the pull-off force of a smooth one: what held was less than four fifths of the contact in one of the cases."""
    grid = rc.Grid((40, 40), 0.55e-9)
    roughness = rc.self_affine(grid, 0.8, rms=0.3e-9, rng=np.random.default_rng(3))
    pressed = rc.press(rc.shapes.paraboloid(grid, R) + roughness, STIFF, force=part * 1.5 * math.pi * W * R)
    curve = rc.detachment_curve(pressed, W)
    assert curve.preload_too_small is expected
    assert about(curve.notes, "for which a sphere needs") == expected


@pytest.mark.parametrize(("part", "expected"), [(0.7, True), (3.0, False)])
def test_a_preload_below_a_third_of_the_pull_off_force_is_noted_on_a_cylinder(part, expected):
    grid = rc.Grid(120, 0.5e-9)
    operator, least = rc.line(grid, STIFF), HighestSummit(R, STIFF, W, True).least_preload
    pressed = rc.press(rc.shapes.paraboloid(grid, R), STIFF, force=part * least, operator=operator)
    *_, off = rc.detachment_path(pressed, W)
    assert about(off.notes, "for which a cylinder needs") == expected


def test_a_retreat_that_ends_before_the_pull_off_is_noted_and_goes_on():
    short = rc.adhesive_curve(BALL, 1e8, STRONG, depths=[10e-9, 2e-9])
    assert about(short.notes, "Continue to lower depths until they are apart") == 1
    whole = rc.adhesive_curve(BALL, 1e8, STRONG, depths=[10e-9, 2e-9, -20e-9])
    assert about(whole.notes, "retreat") == 0
    assert whole.pull_off_force > short.pull_off_force
    by_force = rc.adhesive_curve(BALL, 1e8, STRONG, forces=[1e-7, -1e-7])
    assert about(by_force.notes, "Continue to lower forces") == 1
    off = rc.adhesive_curve(BALL, 1e8, STRONG, forces=[1e-7, -1e-7, -1e-6])
    assert about(off.notes, "retreat") == 0
    pressed = rc.press(BALL, 1e8, depth=2e-8)
    assert (
        about(rc.detachment_curve(pressed, 10e-3, depths=[1e-8, 5e-9]).notes, "Continue to lower depths") == 1
    )
    assert about(rc.detachment_curve(pressed, 10e-3).notes, "retreat") == 0


def test_a_retreat_that_begins_before_the_contact_is_noted():
    """Where the attraction has not pulled the bodies together, the largest tension is that of the nearest depth."""
    weak = rc.Adhesion(work=10e-3, range=40e-9)
    shy = rc.adhesive_curve(BALL, 1e8, weak, depths=[-60e-9, -40e-9, -60e-9])
    assert about(shy.notes, "The retreat begins at its lowest force") == 1
    deep = rc.adhesive_curve(BALL, 1e8, weak, depths=[-60e-9, 40e-9, -60e-9, -200e-9])
    assert about(deep.notes, "retreat") == 0


@pytest.mark.parametrize("factor", [0.97, 1.03])
def test_a_range_on_which_the_pull_off_force_depends_is_noted(factor):
    """The bound is that of Maugis' equations, at which a sphere's pull-off force is 1.65 pi w R."""
    sphere = maugis.DugdaleSphere.of_number(1.127 * SHORT_RANGE)
    assert sphere.pull_off_force / (math.pi * sphere.work * sphere.radius) == pytest.approx(1.65, abs=0.002)
    # Tabor's number is one at this range, on a radius of 10 um.
    range_ = math.cbrt(1e-5 * 10e-3**2 / 1e8**2) / (factor * SHORT_RANGE)
    adhesion = rc.Adhesion(work=10e-3, range=range_)
    there_and_back = rc.adhesive_curve(BALL, 1e8, adhesion, depths=[10e-9, 0.0])
    assert about(there_and_back.notes, "Tabor's number of the highest summit is 0.6") == (factor < 1)
    assert not about(rc.adhesive_curve(BALL, 1e8, adhesion, depths=[10e-9]).notes, "Tabor's number")


def test_notes_stand_in_the_order_of_their_rank():
    """What makes a number wrong comes first, though it is found last."""
    weak = rc.Adhesion(work=10e-3, range=40e-9)
    short = rc.adhesive_curve(BALL, 1e8, weak, depths=[10e-9, 2e-9])
    missed = replace(short, status=(rc.Status.STAGNATED, rc.Status.CONVERGED), summit_radius=5e-9)
    expected = ["1 of 2 loads missed", "The retreat ends at its lowest force", "The contact is not small"]
    assert [words in note for words, note in zip(expected, missed.notes, strict=False)] == [True] * 3
    assert about(short.notes, "missed") == 0
    assert "N (tension is negative)" in short.notes[0]
    off = list(rc.detachment_path(rc.press(BALL, 1e8, depth=5e-9), 10e-3))[-1]
    stalled = replace(off, residual=1e-3, solution=replace(off.solution, status=rc.Status.MAX_STEPS))
    first, second, last = stalled.notes
    assert first.startswith("Residual 1.0e-03: ")
    assert second.startswith("The preload missed the tolerance, residual ")
    assert last.startswith("The preload was too small")
    assert off.notes == (last,)


@pytest.mark.slow
@pytest.mark.parametrize(("cells", "noted"), [(10, True), (22, False)])
def test_the_error_of_the_grid_on_the_pull_off_force_is_noted(cells, noted):
    """A sphere with so many cells in its contact radius at the pull-off by Johnson, Kendall and Roberts."""
    radius, work, modulus = 1e-5, 10e-3, 1e8
    narrow = (9 * math.pi * work * radius**2 / (2 * modulus) / 4) ** (1 / 3)
    grid = rc.Grid((5 * cells, 5 * cells), narrow / cells)
    pressed = rc.press(rc.shapes.paraboloid(grid, radius=radius), modulus, force=2 * math.pi * work * radius)
    curve = rc.detachment_curve(pressed, work)
    error = curve.pull_off_force / (1.5 * math.pi * work * radius) - 1
    found = [
        re.search(r"radius of ([\d.]+) cells.*too large by about ([\d.]+) %", note) for note in curve.notes
    ]
    (match,) = [each for each in found if each] or [None]
    assert bool(match) == noted
    if match:
        assert 0.9 * cells < float(match[1]) < 1.3 * cells
        assert 0.5 < float(match[2]) / (100 * error) < 2
