"""Holm's spots: one, many, their cluster, and computed contact regions."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.joints import holm


def test_one_spot():
    assert holm.spot_resistance(2e-6, (1e-8, 3e-8)) == pytest.approx(4e-8 / 8e-6, rel=1e-14)
    assert holm.contact_length(np.array([3.0]), np.zeros((1, 2))) == 6
    one = holm.spots_resistance(np.array([2e-6]), np.zeros((1, 2)), (1e-8, 3e-8))
    assert one == pytest.approx(float(holm.spot_resistance(2e-6, (1e-8, 3e-8))), rel=1e-14)


def test_spots_far_apart_are_parallel():
    radii, far = np.array([1.0, 2.0, 0.5]), 1e9 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    assert holm.contact_length(radii, far) == pytest.approx(2 * radii.sum(), rel=1e-8)


def test_two_equal_spots_in_closed_form():
    # Each is raised by the other: d = F_1/(2 E* a) + F_1/(pi E* s), F = 2 F_1.
    a, s = 1.0, 7.0
    exact = 2 / (1 / (2 * a) + 1 / (math.pi * s))
    assert holm.contact_length(np.array([a, a]), np.array([[0.0, 0.0], [s, 0.0]])) == pytest.approx(
        exact, rel=1e-14
    )


def test_computed_spots():
    # Two discs of 9 cells across, 30 apart, k by the half-space. A disc of pixels counts with the radius of its area.
    n, grid = 48, rc.Grid((48, 48), 1.0)
    y, x = np.mgrid[:n, :n]
    centres = np.array([[24.0, 9.0], [24.0, 39.0]])
    disc = [np.hypot(y - cy, x - cx) <= 4.6 for cy, cx in centres]
    radius = math.sqrt(disc[0].sum() / math.pi)
    whole = rc.contact_stiffness(disc[0] | disc[1], grid, 1.0)
    alone = rc.contact_stiffness(disc[0], grid, 1.0)
    assert alone == pytest.approx(2 * radius, rel=0.03)
    # What the spots take from each other does not hang on the pixels; of it the formula leaves out parts of (a/s)^2.
    lost = 2 / whole - 1 / alone
    assert lost == pytest.approx(1 / (math.pi * 30), rel=2 * (radius / 30) ** 2)
    assert whole == pytest.approx(holm.contact_length(np.full(2, radius), centres), rel=0.03)


def test_radius_of_a_stiffness():
    assert holm.holm_radius(2 * 7e10 * 3e-4, 7e10) == pytest.approx(3e-4, rel=1e-14)


def test_cluster_of_many_spots_is_its_disc():
    # Small spots spread over a disc of radius 1 share the load evenly: 1/s averaged over pairs is 16/(3 pi),
    # and 1/(2 alpha) = 16/(3 pi^2); with equal potential it would be alpha = 1.
    rng = np.random.default_rng(1)
    spots = rng.uniform(-1, 1, (3000, 2))
    spots = spots[np.hypot(*spots.T) < 1][:1500]
    radii = np.full(len(spots), 1e-6)
    length = holm.contact_length(radii, spots)
    alpha = holm.cluster_radius(length, 2 * radii.sum(), 1.0)
    # The mean over N points scatters by about 1/sqrt(N) of itself times the spread of 1/s from place to place, 0.2.
    assert alpha == pytest.approx(3 * math.pi**2 / 32, rel=0.02)


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="overlaps"):
        holm.contact_length(np.ones(2), np.array([[0.0, 0.0], [1.5, 0.0]]))
    with pytest.raises(ValueError, match="positions"):
        holm.contact_length(np.ones(2), np.zeros((3, 2)))
    with pytest.raises(ValueError, match="radii must be positive"):
        holm.contact_length(np.array([1.0, 0.0]), np.array([[0.0, 0.0], [5.0, 0.0]]))
    with pytest.raises(ValueError, match="softer than its"):
        holm.cluster_radius(2.0, 1.0, 1.0)
