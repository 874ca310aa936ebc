"""The leak of a joint from rim to rim: between circles, closed, and bounds where the transmissivity is not known."""

import math

import numpy as np
import pytest

import roughcontact as rc
from made_laws import law

WATER = rc.Liquid(1e-3)
KAPPA = np.array([4e-20, 1e-20, 0.25e-20])  # at 1, 2 and 4 MPa: kappa ~ p^-2


def joint(pressure, kappa=KAPPA, spacing=1e-4):
    p = np.geomspace(1e6, 4e6, len(kappa))
    made = law(p, -np.log(p), p, 0.0, transmissivity=np.asarray(kappa, float))
    return rc.joint(made, rc.PressureField(pressure, spacing))


def ring(n, inner=0.4, outer=0.9, pressure=2e6):
    at = 2 * (np.arange(n) + 0.5) / n - 1
    radius = np.hypot(at[:, None], at)
    p = np.where((radius >= inner) & (radius < outer), pressure, 0.0)
    p[radius < inner] = np.nan
    return p


def per_square(kappa, drop=1e5):
    """Return the flow through a square of a transmissivity."""
    return kappa / (12 * 1e-3) * drop


def test_between_circles_the_leak_is_that_of_the_closed_form_at_first_order_of_the_cells():
    """2 pi T/ln(r2/r1). A rim in steps of cells is off by a part of a cell: of ln(r2/r1) = 0.81, h (1/r1 + 1/r2)/2."""
    exact = 2 * math.pi * per_square(1e-20) / math.log(0.9 / 0.4)
    for n in (50, 100, 200):
        low, high = rc.joint_leak(joint(ring(n)), WATER, drop=1e5)
        assert high == pytest.approx(low, rel=1e-6)  # the tolerance of the flow
        assert low == pytest.approx(exact, rel=(2 / n) * (1 / 0.4 + 1 / 0.9) / 2 / math.log(0.9 / 0.4))


def test_even_strips_in_series_are_exact():
    """A hole as a slot across the face between two strips: pressures of the loads and between them, in log-log."""
    p = np.zeros((1, 9))
    p[0, 1:4], p[0, 5:8] = [1e6, 2e6, 2e6 * math.sqrt(2)], [4e6, 4e6, 4e6]
    p = np.repeat(p, 3, 0)
    p[[0, -1], 1:8] = 4e6  # closed: see the law below
    closing = joint(p, [4e-20, 1e-20, 0.0])
    low, high = rc.joint_leak(closing, WATER, drop=1e5)
    assert low == 0  # between 2 MPa and the closed 4 MPa the law does not tell
    series = 1 / (1 / 4e-20 + 1 / 1e-20 + 1 / 1e-20)
    assert high == pytest.approx(
        per_square(series), rel=1e-5
    )  # one cell wide; open cells conduct 1e6 times as well


def test_a_closed_ring_holds():
    assert rc.joint_leak(joint(ring(20, pressure=4e6), [4e-20, 1e-20, 0.0]), WATER, drop=1e5) == (0.0, 0.0)


def test_below_the_lowest_load_the_leak_has_bounds():
    p = ring(60, pressure=2e6)
    rim = (p > 0) & np.isnan(ring(60, inner=0.6))  # the inner part of the ring
    p[rim] = 0.5e6
    low, high = rc.joint_leak(joint(p), WATER, drop=1e5)
    assert low < 0.95 * high
    wide, _ = rc.joint_leak(joint(ring(60, inner=0.6)), WATER, drop=1e5)
    assert high == pytest.approx(wide, rel=1e-4)
    p[rim] = 1e6  # the lowest load
    assert low == pytest.approx(rc.joint_leak(joint(p), WATER, drop=1e5)[0], rel=1e-6)


def test_a_drop_above_the_contact_pressure_may_open_the_joint():
    low, high = rc.joint_leak(joint(ring(20)), WATER, drop=3e6)
    assert low == pytest.approx(30 * rc.joint_leak(joint(ring(20)), WATER, drop=1e5)[0])
    assert high == math.inf


def test_patches_leak_as_their_mean():
    first = rc.joint(
        [joint(ring(20), KAPPA).normal[0], joint(ring(20), 3 * KAPPA).normal[0]],
        rc.PressureField(ring(20), 1e-4),
    )
    mean = rc.joint_leak(joint(ring(20), 2 * KAPPA), WATER, drop=1e5)
    assert rc.joint_leak(first, WATER, drop=1e5) == pytest.approx(mean, rel=1e-5)


def test_the_transmissivity_is_that_of_the_computed_curve():
    """At a load of the curve, the ring leaks as by the transmissivity of that load."""
    grid = rc.Grid((64, 64), 1e-6, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    curve = rc.loading_curve(surface, 1e9, pressures=[1e6, 2e6], measures=[rc.Transmissivity(axis=0)])
    found = rc.joint(rc.normal_law(curve), rc.PressureField(ring(40), 1e-4))
    kappa = float(curve.measured["transmissivity"][1])
    same = rc.joint_leak(joint(ring(40), [kappa] * 3), WATER, drop=1e5)
    assert rc.joint_leak(found, WATER, drop=1e5) == pytest.approx(same, rel=1e-5)
