"""Whole loading curves of rough lines against a foundation that is pressed spring by spring."""

import math

import numpy as np
import pytest

import roughcontact as rc
import roughcontact.mdr.lines.rough_line as rough_line
from roughcontact.mdr.foundation import foundation
from roughcontact.mdr.lines.rough_line import loading_curves

MODULUS, SPACING = 3e9, 2e-6
FORCES = np.geomspace(1e-7, 1e1, 60)  # over E* h L: from a single spring to all


def pressed(heights, force, spring):
    """Return springs in contact, depth and energy at a force, without sorting: a slow truth.

    The force is convex in the plane's height z, so that z from the springs above the plane before only rises.
    """
    heights = heights - heights.max()
    z = -math.inf
    while True:
        inside = heights > z
        rises = (math.fsum(heights[inside]) - force / spring) / inside.sum()
        if not rises > z:
            break
        z = rises
    u = heights[heights > z] - z
    return len(u), -z, spring * math.fsum(u * u) / 2


def lines(count, points, seed=0):
    """Return rough lines of rms height 1e-6 m or so."""
    rng = np.random.default_rng(seed)
    walk = rng.standard_normal((count, points)).cumsum(axis=1)
    return 1e-6 * (walk - walk.mean(axis=1, keepdims=True)) / walk.std()


def scale(heights, forces=FORCES):
    return forces * MODULUS * heights.std() * heights.shape[1] * SPACING


def assert_like_pressed(heights, forces):
    curves = loading_curves(heights, SPACING, MODULUS, forces=forces)
    for i, line in enumerate(heights):
        truth = np.array([pressed(line, force, MODULUS * SPACING) for force in forces]).T
        np.testing.assert_array_equal(curves.springs[i], truth[0])
        # Sums of n positive terms: n units in the last place at most, n up to 1000.
        np.testing.assert_allclose(curves.depth[i], truth[1], rtol=1e-11)
        np.testing.assert_allclose(curves.elastic_energy[i], truth[2], rtol=1e-11)


class TestAgainstBruteForce:
    @pytest.mark.parametrize("points", [2, 3, 17, 1000])
    def test_rough_lines(self, points):
        heights = lines(3, points)
        assert_like_pressed(heights, scale(heights))

    def test_white_heights(self):
        heights = 1e-6 * np.random.default_rng(2).standard_normal((3, 700))
        assert_like_pressed(heights, scale(heights))

    def test_plateaus(self):
        # Heights of few values, the highest of them many times.
        heights = np.round(np.random.default_rng(3).uniform(0, 5, (3, 400))) * 2.0**-20
        assert_like_pressed(heights, scale(heights))

    def test_a_flat_line(self):
        curves = loading_curves(np.full((1, 50), 4e-6), SPACING, MODULUS, forces=[1e-3, 1.0])
        np.testing.assert_array_equal(curves.springs, 50)
        np.testing.assert_allclose(
            curves.depth, [[1e-3 / curves.stiffness_scale, 1 / curves.stiffness_scale]]
        )
        assert curves.rms == 0

    def test_one_point(self):
        curves = loading_curves(np.array([3e-6]), SPACING, MODULUS, forces=[2.0])
        assert curves.depth == pytest.approx(2 / (MODULUS * SPACING))

    def test_one_high_needle(self):
        # The peak far above the rest: the springs below lose nothing to the distance.
        heights = lines(2, 300)
        heights[:, 7] = 1.0
        assert_like_pressed(heights, scale(lines(2, 300)) + 300 * MODULUS * SPACING)


def test_a_shift_of_all_heights_changes_no_digit():
    heights = np.random.default_rng(4).integers(0, 2**20, (4, 200)) * 2.0**-40
    low = loading_curves(heights, SPACING, MODULUS, forces=scale(heights))
    high = loading_curves(heights + 2.0**10, SPACING, MODULUS, forces=scale(heights))
    for name in ("depth", "springs", "elastic_energy"):
        np.testing.assert_array_equal(getattr(high, name), getattr(low, name))


def test_depths_that_belong_to_forces_give_these_forces():
    heights = lines(1, 500)
    first = loading_curves(heights, SPACING, MODULUS, forces=scale(heights))
    second = loading_curves(heights, SPACING, MODULUS, depths=first.depth[0])
    np.testing.assert_allclose(second.force[0], first.force, rtol=1e-11)
    np.testing.assert_allclose(second.elastic_energy, first.elastic_energy, rtol=1e-11)
    np.testing.assert_array_equal(second.depth, first.depth[0])


def test_a_spring_that_is_just_touched_carries_nothing():
    curves = loading_curves(np.array([0.0, -1, -1, -3]), 1.0, 1.0, depths=[0, 1, np.nextafter(1, 2), 3, 4])
    np.testing.assert_array_equal(curves.springs, [[0, 1, 3, 3, 4]])
    np.testing.assert_allclose(curves.force, [[0, 1, 1, 7, 11]], rtol=1e-15)
    np.testing.assert_allclose(curves.elastic_energy, [[0, 0.5, 0.5, (9 + 4 + 4) / 2, (16 + 9 + 9 + 1) / 2]])
    # At the force of the second touch the depth is that of the touch, and the first spring alone in contact.
    curves = loading_curves(np.array([0.0, -1, -1, -3]), 1.0, 1.0, forces=[1, np.nextafter(1, 2)])
    np.testing.assert_array_equal(curves.springs, [[1, 3]])


def test_energy_is_the_work_of_the_force():
    heights = lines(1, 40)
    touches = np.unique(heights.max() - heights)  # between them the force is linear, and the trapezoid exact
    curves = loading_curves(heights, SPACING, MODULUS, depths=np.append(touches, 2 * touches[-1]))
    force, depth = curves.force[0], curves.depth
    work = np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(depth))
    np.testing.assert_allclose(curves.elastic_energy[0, 1:], work, rtol=1e-12)
    np.testing.assert_allclose(curves.stiffness[0, 1:], np.diff(force) / np.diff(depth), rtol=1e-9)


@pytest.mark.parametrize("control", ["forces", "depths"])
def test_energy_may_be_left_out(control):
    heights = lines(3, 200)
    loads = {control: scale(heights) if control == "forces" else np.linspace(0, 1e-6, 9)}
    whole = loading_curves(heights, SPACING, MODULUS, **loads)
    rest = loading_curves(heights, SPACING, MODULUS, **loads, energy=False)
    for name in ("force", "depth", "springs", "rms"):
        np.testing.assert_array_equal(getattr(rest, name), getattr(whole, name))
    assert np.isnan(rest.elastic_energy).all()
    assert rest.elastic_energy.shape == whole.elastic_energy.shape


def test_stiffness_is_the_slope_and_contact_length_its_share():
    heights = lines(2, 500)
    curves = loading_curves(heights, SPACING, MODULUS, forces=scale(heights))
    np.testing.assert_allclose(curves.stiffness, MODULUS * SPACING * curves.springs, rtol=1e-15)
    np.testing.assert_allclose(curves.contact_length, SPACING * curves.springs, rtol=1e-15)
    assert curves.springs[:, -1].tolist() == [500, 500]
    assert (np.diff(curves.springs, axis=1) >= 0).all()


def test_heights_forces_and_lengths_scale():
    heights = lines(2, 300)
    one = loading_curves(heights, SPACING, MODULUS, forces=scale(heights))
    # Powers of two: every product is exact.
    two = loading_curves(4 * heights, 8 * SPACING, 2 * MODULUS, forces=64 * scale(heights))
    np.testing.assert_array_equal(two.springs, one.springs)
    np.testing.assert_allclose(two.depth, 4 * one.depth, rtol=1e-13)
    np.testing.assert_allclose(two.elastic_energy, 256 * one.elastic_energy, rtol=1e-13)
    np.testing.assert_allclose(two.dimensionless_force, one.dimensionless_force, rtol=1e-13)


def test_the_order_of_the_points_does_not_matter():
    heights = lines(1, 400)
    mixed = np.random.default_rng(5).permuted(heights, axis=1)
    one, two = (loading_curves(h, SPACING, MODULUS, forces=scale(heights)) for h in (heights, mixed))
    np.testing.assert_array_equal(one.depth, two.depth)


def test_lines_in_blocks_are_lines_one_by_one(monkeypatch):
    heights = lines(7, 100)
    whole = loading_curves(heights, SPACING, MODULUS, forces=scale(heights))
    monkeypatch.setattr(rough_line, "BLOCK", 300)  # blocks of 3, 3 and 1
    blocks = loading_curves(heights, SPACING, MODULUS, forces=scale(heights))
    alone = [loading_curves(line, SPACING, MODULUS, forces=scale(heights)) for line in heights]
    for name in ("depth", "springs", "elastic_energy", "rms"):
        np.testing.assert_array_equal(getattr(blocks, name), getattr(whole, name))
        np.testing.assert_array_equal(np.concatenate([getattr(c, name) for c in alone]), getattr(whole, name))
    np.testing.assert_allclose(whole.rms, heights.std(axis=1), rtol=1e-14)


def test_the_general_solver_on_the_foundation_gives_the_same_curve():
    grid = rc.Grid(256, SPACING)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    forces = scale(surface.heights[None], np.geomspace(1e-3, 2, 15))
    general = rc.loading_curve(surface, MODULUS, forces=forces, operator=foundation(grid, MODULUS))
    curves = loading_curves(surface.heights, SPACING, MODULUS, forces=forces)
    np.testing.assert_allclose(curves.depth[0], general.depth, rtol=1e-11)
    np.testing.assert_allclose(curves.stiffness[0], general.stiffness, rtol=1e-11)
    np.testing.assert_allclose(curves.elastic_energy[0], general.elastic_energy, rtol=1e-11)
    np.testing.assert_allclose(curves.contact_length[0], general.contact_area, rtol=1e-11)
    assert curves.force_scale == pytest.approx(general.force_scale, rel=1e-14)
    assert curves.stiffness_scale == pytest.approx(general.stiffness_scale, rel=1e-14)


def test_a_cosine_has_its_closed_form():
    # The thesis' eq. 4.33 as corrected: s = d/(2 h0).
    n, h0 = 2**14, 1e-6
    heights = h0 * np.cos(2 * np.pi * np.arange(n) / n)
    s = np.linspace(0.05, 1, 20)
    curves = loading_curves(heights, 1 / n, 1.0, depths=2 * h0 * s)
    force = 2 / np.pi * h0 * (np.sqrt(s * (1 - s)) - (1 - 2 * s) * np.arcsin(np.sqrt(s)))
    # A sum over points for the integral of a function with two kinks of slope h0 q each: an error of their slopes
    # times the spacing squared over 4, at most.
    np.testing.assert_allclose(curves.force[0], force, atol=2 * h0 * 2 * np.pi / n**2 / 4)
    # The ends of the contact are known to a spring each.
    np.testing.assert_allclose(curves.stiffness[0], 2 / np.pi * np.arcsin(np.sqrt(s)), atol=2 / n)


def test_white_gaussian_heights_have_their_closed_form():
    # k/(E* L) = Q(t) and F/(E* h L) = phi(t) - t Q(t) at the plane h t above the mean, whatever the number of points.
    n, count = 4000, 200
    heights = np.random.default_rng(6).standard_normal((count, n))
    curves = loading_curves(heights, 1 / n, 1.0, forces=[1e-3, 1e-2, 0.1, 0.4, 1.0])
    t = heights.max(axis=1, keepdims=True) - curves.depth
    tail = np.vectorize(lambda x: math.erfc(x / math.sqrt(2)) / 2)(t)
    density = np.exp(-(t**2) / 2) / math.sqrt(2 * math.pi)
    loads, squares = density - t * tail, (1 + t**2) * tail - t * density
    # Five standard errors of means over all springs: of being in contact, and of what a spring carries.
    springs = n * count
    stiffness_error, force_error = (5 * np.sqrt(part.mean(axis=0) / springs) for part in (tail, squares))
    assert (np.abs(curves.stiffness.mean(axis=0) - tail.mean(axis=0)) < stiffness_error).all()
    assert (np.abs(curves.force - loads.mean(axis=0)) < force_error).all()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"heights": np.zeros((2, 3, 4))}, "one line or one row per line"),
        ({"heights": np.zeros(0)}, "one line or one row per line"),
        ({"heights": np.array([1, np.nan, 2])}, "1 heights are missing"),
        ({"spacing": 0.0}, "spacing must be positive"),
        ({"modulus": -1.0}, "reduced modulus"),
        ({"forces": None}, "exactly one"),
        ({"depths": [1.0]}, "exactly one"),
        ({"forces": [0.0, 1.0]}, "above 0"),
        ({"forces": [1.0, np.inf]}, "finite"),
        ({"forces": [2.0, 1.0]}, "increase"),
        ({"forces": []}, "at least one"),
        ({"forces": None, "depths": [-1.0]}, "at least 0"),
    ],
)
def test_what_makes_no_sense_is_refused(change, says):
    arguments = {"heights": np.arange(4.0), "spacing": 1.0, "modulus": 1.0, "forces": [1.0]} | change
    given = [arguments.pop(name) for name in ("heights", "spacing", "modulus")]
    with pytest.raises(ValueError, match=says):
        loading_curves(*given, **arguments)
