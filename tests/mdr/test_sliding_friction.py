"""Friction of rough lines over speed: its limits, its power and its scales."""

import math

import numpy as np
import pytest

import roughcontact as rc
import roughcontact.mdr.lines.rough_line as rough_line
import roughcontact.mdr.viscoelasticity.sliding_friction as module
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.viscoelasticity.sliding_friction import sliding_friction
from roughcontact.mdr.viscoelasticity.sliding_state import sliding_state

N, SPACING, MODULUS, TIME = 256, 1e-5, 4e6, 1e-3
SPEEDS = np.geomspace(1e-4, 1e6, 11) * SPACING / TIME


@pytest.fixture(scope="module")
def heights():
    spectrum = rc.SelfAffineSpectrum(0.8, dimension=1)
    [lines] = rough_lines(rc.Grid(N, SPACING), spectrum, np.random.default_rng(0), 20, rms=1e-5)
    return lines


FORCE = 0.02 * MODULUS * 1e-5 * N * SPACING


def slide(heights, **changes):
    arguments = {"relaxation_time": TIME, "force": FORCE, "speeds": SPEEDS} | changes
    return sliding_friction(
        heights, arguments.pop("spacing", SPACING), arguments.pop("modulus", MODULUS), **arguments
    )


def test_the_force_is_kept_up_at_every_speed(heights):
    curves = slide(heights)
    for column, speed in enumerate(SPEEDS):
        state = sliding_state(
            heights.max(axis=1, keepdims=True) - heights, SPACING, speed * TIME, curves.depth[:, column]
        )
        np.testing.assert_allclose(MODULUS * state.force, FORCE, rtol=1e-12)
        np.testing.assert_allclose(MODULUS * state.friction, curves.friction_force[:, column], rtol=1e-12)


def test_slow_friction_is_proportional_to_the_speed(heights):
    curves = slide(heights, speeds=SPEEDS[0] * np.array([1e-3, 2e-3]))
    # The next order in l over the spacing, 1e-7, is smaller than this.
    np.testing.assert_allclose(curves.friction_force[:, 1], 2 * curves.friction_force[:, 0], rtol=1e-5)
    assert (curves.friction_coefficient < 1e-6).all()


def test_fast_friction_is_the_slope_in_front_of_the_highest_point(heights):
    # The spring falls by a part L/l = 2.6e-4 from one period to the next, less than the step up to the highest point.
    curves = slide(heights, speeds=[1e6 * SPACING / TIME])
    rows, top = np.arange(len(heights)), heights.argmax(axis=1)
    slope = (heights[rows, top] - heights[rows, top - 1]) / SPACING
    # What is left of a rising stretch is found to rounding over that part.
    np.testing.assert_allclose(curves.friction_coefficient[:, 0], slope, rtol=1e-9)
    # It has hardly time to relax: deflected by the depth everywhere, less half of that part.
    np.testing.assert_allclose(curves.depth[:, 0], FORCE / (MODULUS * N * SPACING), rtol=2e-4)


def test_between_there_is_a_plateau_of_the_order_of_the_rms_slope():
    spectrum = rc.SelfAffineSpectrum(0.3, dimension=1)
    [lines] = rough_lines(rc.Grid(1024, SPACING), spectrum, np.random.default_rng(1), 20, rms=1e-5)
    gradient = np.sqrt((np.diff(lines, axis=1, append=lines[:, :1]) ** 2).mean()) / SPACING
    force = 0.3 * MODULUS * 1e-5 * 1024 * SPACING
    curves = slide(lines, force=force, speeds=np.geomspace(30, 1000, 4) * SPACING / TIME)
    mu = curves.friction_coefficient.mean(axis=0) / gradient
    # Gaussian slopes on rising flanks under a traction that grows with the slope would give sqrt(pi/2) = 1.25.
    assert (mu > 1).all()
    assert (mu < 1.6).all()


def test_depth_and_contact_decrease_with_the_speed(heights):
    curves = slide(heights)
    assert (np.diff(curves.depth, axis=1) < 0).all()
    assert (np.diff(curves.contact_length.mean(axis=0)) < 0).all()
    at_rest = rough_line.loading_curves(heights, SPACING, MODULUS, forces=[FORCE]).depth[:, 0]
    # Springs at the points and a line that is straight between them differ by the square of a spacing over a contact.
    np.testing.assert_allclose(curves.depth[:, 0], at_rest, rtol=0.05)


def test_power_is_friction_times_speed(heights):
    curves = slide(heights)
    np.testing.assert_array_equal(curves.dissipated_power, curves.friction_force * SPEEDS)
    np.testing.assert_array_equal(curves.friction_coefficient, curves.friction_force / FORCE)


def test_only_the_relaxation_length_counts(heights):
    one, two = slide(heights[:3]), slide(heights[:3], relaxation_time=8 * TIME, speeds=SPEEDS / 8)
    np.testing.assert_allclose(two.friction_force, one.friction_force, rtol=1e-12)


def test_friction_scales(heights):
    # Heights by 2 at equal lengths: slopes, depths and forces by 2. Lengths by 4: slopes by 1/4, l by 4.
    one = slide(heights[:3])
    two = slide(
        2 * heights[:3], spacing=4 * SPACING, modulus=3 * MODULUS, force=24 * FORCE, speeds=4 * SPEEDS
    )
    np.testing.assert_allclose(two.friction_coefficient, one.friction_coefficient / 2, rtol=1e-10)
    np.testing.assert_allclose(two.depth, 2 * one.depth, rtol=1e-10)
    np.testing.assert_allclose(two.contact_length, 4 * one.contact_length, rtol=1e-10)


def test_lines_in_blocks_are_lines_one_by_one(heights, monkeypatch):
    whole = slide(heights[:5])
    monkeypatch.setattr(module, "BLOCK", 2 * N)
    blocks = slide(heights[:5])
    alone = np.concatenate([slide(line).friction_force for line in heights[:5]])
    # Newton's method goes on for a line until the others of its block have converged.
    np.testing.assert_allclose(blocks.friction_force, whole.friction_force, rtol=1e-10)
    np.testing.assert_allclose(alone, whole.friction_force, rtol=1e-10)


def test_a_depth_that_is_not_found_is_not_returned(heights, monkeypatch):
    monkeypatch.setattr(module, "STEPS", 2)
    with pytest.raises(ArithmeticError, match="after 2 steps"):
        slide(heights)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"heights": np.full(8, 2.0)}, "without asperities"),
        ({"heights": np.array([1, np.nan])}, "missing"),
        ({"spacing": -1.0}, "spacing"),
        ({"modulus": 0.0}, "reduced modulus"),
        ({"relaxation_time": 0.0}, "relaxation_time"),
        ({"force": 0.0}, "above 0"),
        ({"speeds": [0.0, 1.0]}, "positive and finite"),
        ({"speeds": [2.0, 1.0]}, "increase"),
        ({"speeds": []}, "at least one"),
        ({"speeds": [math.inf]}, "finite"),
    ],
)
def test_what_makes_no_sense_is_refused(change, says):
    arguments = {"heights": np.array([0.0, 1.0, 0.3])} | change
    with pytest.raises(ValueError, match=says):
        slide(arguments.pop("heights"), **arguments)
