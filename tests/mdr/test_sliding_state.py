"""The steady state of sliding against springs that are followed in time."""

import math

import numpy as np
import pytest

from roughcontact.mdr.viscoelasticity.sliding_state import sliding_state

SUB = 3000  # steps of time a stretch


def followed(separation, spacing, length, depth):
    """Return forces over E* of one spring that is followed over three periods in small steps: a slow truth.

    Normal force from the deflection, and from the traction; friction from the traction on the flanks, and from what
    the damper dissipates; and the length in contact.
    """
    n = separation.size * SUB
    nodes = np.arange(separation.size + 1) * spacing
    x = np.arange(n + 1) * spacing / SUB
    w = depth - np.interp(x, nodes, np.append(separation, separation[0]))
    decay, u, path = math.exp(-spacing / SUB / length), 0.0, np.empty(n + 1)
    for _ in range(3):
        path[0] = u = max(u, w[0], 0.0)
        for i in range(1, n + 1):
            path[i] = u = max(u * decay, w[i])
    step, touches = spacing / SUB, (path[1:] == w[1:]) & (path[:-1] == w[:-1])
    slope, mean = np.diff(w) / step, (path[1:] + path[:-1]) / 2
    traction = np.where(touches, mean + length * slope, 0.0)
    return {
        "deflection": mean.sum() * step,
        "traction": traction.sum() * step,
        "flanks": (traction * slope).sum() * step,
        "heat": length * (np.diff(path) ** 2).sum() / step,
        "contact": touches.sum() * step,
        # What a step too many or too few may change, each time that the spring touches or lets go.
        "events": (np.diff(touches.astype(int)) != 0).sum() * step,
        "traction in a step": traction.max(),
    }


def line(seed, points=24):
    walk = np.random.default_rng(seed).standard_normal(points).cumsum()
    walk -= np.linspace(0, walk[-1], points)
    return walk.max() - walk


@pytest.mark.parametrize("length", [0.02, 0.3, 2.0, 30.0])
@pytest.mark.parametrize("depth", [0.3, 3.0])
def test_forces_are_those_of_springs_followed_in_time(length, depth):
    separation, spacing = line(3), 0.5
    state = sliding_state(separation[None], spacing, length, np.array([depth]))
    truth = followed(separation, spacing, length, depth)
    events, traction = truth["events"], truth["traction in a step"]
    steepest = np.abs(np.diff(separation)).max() / spacing
    assert state.contact_length[0] == pytest.approx(truth["contact"], abs=events)
    assert state.force[0] == pytest.approx(truth["deflection"], rel=1e-4)
    assert state.force[0] == pytest.approx(truth["traction"], abs=events * traction)
    # The traction on the flanks and the heat of the dampers are one power.
    bound = events * traction * steepest
    assert state.friction[0] == pytest.approx(truth["flanks"], abs=bound)
    assert state.friction[0] == pytest.approx(truth["heat"], abs=bound)
    assert bound < 0.1 * state.friction[0]


@pytest.mark.parametrize("length", [0.01, 0.3, 2.0, 30.0, 1e3])
def test_stiffness_is_the_derivative_of_the_force(length):
    separation, depth, step = np.stack([line(1), line(2)]), np.array([0.4, 2.0]), 1e-6
    state, up, down = (sliding_state(separation, 0.5, length, depth + s) for s in (0, step, -step))
    np.testing.assert_allclose((up.force - down.force) / (2 * step), state.stiffness, rtol=1e-5)


@pytest.mark.parametrize("ratio", [1e-6, 0.01, 0.3, 0.9, 1.0])
def test_a_triangle_has_its_closed_form(ratio):
    # Flanks of slope b, r = l b/depth <= 1: contact on the rising flank and down to w = l b on the falling one.
    b, period, depth = 0.2, 1000.0, 1.0
    length = ratio * depth / b
    separation = b * np.abs(np.arange(0.0, period) - period / 2)
    state = sliding_state(separation[None], 1.0, length, np.array([depth]))
    # What a spring remembers of the asperity before is exp(-198) and less.
    force = depth**2 / b + length**2 * b / 2
    friction = 2 * length * depth * b - (length * b) ** 2 / 2
    assert state.force[0] == pytest.approx(force, rel=1e-12)
    assert state.friction[0] == pytest.approx(friction, rel=1e-11)
    assert state.contact_length[0] == pytest.approx(2 * depth / b - length, rel=1e-12)


@pytest.mark.parametrize("ratio", [1.0, 7.0, 1e3, 1e6])
def test_on_rising_flanks_alone_friction_is_their_slope_times_the_force(ratio):
    b, period, depth = 0.2, 40.0, 1.0
    separation = b * np.abs(np.arange(0.0, period) - period / 2)
    state = sliding_state(separation[None], 1.0, ratio * depth / b, np.array([depth]))
    assert state.friction[0] == pytest.approx(b * state.force[0], rel=1e-10)


def test_slow_sliding_is_the_contact_at_rest():
    separation, depth, length = line(4), 1.5, 1e-7
    state = sliding_state(separation[None], 0.5, length, np.array([depth]))
    # Straight stretches, integrated piece by piece.
    x = np.linspace(0, 1, 200_001)
    w = depth - (separation[:, None] * (1 - x) + np.roll(separation, -1)[:, None] * x)
    inside = (w > 0).mean(axis=1)
    slope = (np.roll(separation, -1) - separation) / 0.5
    assert state.force[0] == pytest.approx(0.5 * np.maximum(w, 0).mean(axis=1).sum(), rel=1e-5)
    assert state.contact_length[0] == pytest.approx(0.5 * inside.sum(), rel=1e-4)
    assert state.friction[0] == pytest.approx(length * 0.5 * (slope**2 * inside).sum(), rel=1e-4)


def test_where_a_period_begins_does_not_matter():
    separation = line(5)
    for length in (0.1, 3.0, 100.0):
        one, two = (
            sliding_state(s[None], 0.5, length, np.array([2.0])) for s in (separation, np.roll(separation, 9))
        )
        for name in ("force", "friction", "contact_length", "stiffness"):
            assert getattr(one, name)[0] == pytest.approx(getattr(two, name)[0], rel=1e-11)


def test_two_periods_carry_twice_as_much():
    separation = line(6)
    for length in (0.1, 5.0, 200.0):
        one = sliding_state(separation[None], 0.5, length, np.array([1.0]))
        two = sliding_state(np.tile(separation, 2)[None], 0.5, length, np.array([1.0]))
        for name in ("force", "friction", "contact_length", "stiffness"):
            assert getattr(two, name)[0] == pytest.approx(2 * getattr(one, name)[0], rel=1e-11)


def test_points_on_straight_flanks_change_nothing():
    separation = line(7)
    fine = np.interp(np.arange(24 * 4) / 4, np.arange(25), np.append(separation, separation[0]))
    for length in (0.05, 0.7, 20.0):
        one = sliding_state(separation[None], 0.5, length, np.array([1.0]))
        two = sliding_state(fine[None], 0.125, length, np.array([1.0]))
        for name in ("force", "friction", "contact_length", "stiffness"):
            assert getattr(two, name)[0] == pytest.approx(getattr(one, name)[0], rel=1e-10)
