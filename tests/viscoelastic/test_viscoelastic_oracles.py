"""Viscoelastic contact in time against closed forms: Lee and Radok, Ting, a punch, a wave.

The material is E_inf = 1, E_0 = 3, tau = 1, so that theta = 3; the closed forms are integrals of its E(t) and J(t).
"""

import numpy as np
import pytest
from scipy.integrate import quad, simpson
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

import roughcontact as rc
from roughcontact.mdr import indenter, viscoelastic_history

SOLID = rc.viscoelastic.standard_solid(1.0, 3.0, 1.0)
CREEP = SOLID.creep()


def rings(count, radius):
    grid = rc.RadialGrid.uniform(count, radius)
    return rc.RadialProfile(-(grid.radii**2) / 2, grid)


BALL = rings(120, 0.5)  # of radius 1
SMALL = rings(100, 0.12)


def last(surface, **history):
    *_, state = rc.viscoelastic_path(surface, SOLID, tolerance=1e-10, **history)
    return state


def given(surface, **history):
    return [state for state in rc.viscoelastic_path(surface, SOLID, **history) if state.prescribed]


def test_a_sphere_under_a_held_force_sinks_by_the_creep_function():
    times = [0.0, 1.0, 3.0, 10.0]
    states = given(BALL, times=times, forces=[0.1] * 4, time_tolerance=1e-4)
    for state, d, p in zip(
        states,
        (0.085498797334, 0.115343847208, 0.147426352575, 0.175013622171),
        (0.558446252070, 0.389250197162, 0.288947620418, 0.268540798981),
        strict=True,
    ):
        elastic = rc.press(BALL, 1 / float(CREEP(state.time)), force=0.1)
        assert state.depth == pytest.approx(elastic.depth, rel=1e-4)  # the tolerance of time
        assert state.depth == pytest.approx(
            d, rel=3e-4
        )  # and that of the rings, at most one ring in ninety: squared
        assert state.max_pressure == pytest.approx(p, rel=1e-3)
        assert np.array_equal(state.contact, elastic.contact)


def test_a_small_tolerance_is_met_on_rings():
    few = rings(24, 0.5)
    for state in given(few, times=[0.0, 1.0, 3.0], forces=[0.1] * 3, time_tolerance=1e-5):
        elastic = rc.press(few, 1 / float(CREEP(state.time)), force=0.1, tolerance=1e-10)
        assert state.depth == pytest.approx(elastic.depth, rel=1e-5)
        assert np.array_equal(state.contact, elastic.contact)


def test_the_error_in_time_is_of_second_order():
    truth = rc.press(BALL, 1 / float(CREEP(1.0)), force=0.1)
    errors = [
        abs(last(BALL, times=[0, 1], forces=[0.1, 0.1], steps=n).depth / truth.depth - 1) for n in (8, 16, 32)
    ]
    assert errors[0] < 1e-4
    # The quotients are 4 up to terms of third order.
    assert np.divide(errors[:-1], errors[1:]) == pytest.approx(4, rel=0.03)


def ting(force, rise, fall, time):
    """Return t_1 and F of Ting (1966) while the depth falls: `force` is that of the elastic contact with E* = 1.

    The depth is rise * t up to t = 1, then falls at the rate `fall`.
    """

    def remembered(first):  # integral of E(t - s) d'(s) from t_1 to t, whose zero is t_1
        up = quad(lambda s: SOLID.relaxation(time - s), first, 1, epsabs=1e-13)[0]
        return rise * up - fall * quad(lambda s: SOLID.relaxation(time - s), 1, time, epsabs=1e-13)[0]

    first = brentq(remembered, 0, 1, xtol=1e-13) if time > 1 else time
    # By parts: E(t - t_1) F(d(t_1)) less the integral of F dE(t - s)/ds.
    places = np.linspace(0, first, 4001)
    part = simpson(
        2 * np.exp(places - time) * force(rise * places), x=places
    )  # E(t - s) = 1 + 2 exp(-(t - s))
    return first, SOLID.relaxation(time - first) * force(rise * first) - part


def test_the_formula_of_ting_gives_the_digits_of_the_note():
    def hertz(d):
        return 4 / 3 * d**1.5

    first, force = ting(hertz, 0.01, 0.01, 1.4)
    assert (first, force) == pytest.approx((0.482359372269, 7.432398878284e-4), rel=1e-7)  # Simpson's rule


def test_a_sphere_that_is_pressed_and_withdrawn():
    times = [0.0, 0.5, 1.0, 1.2, 1.4, 1.6, 1.670127397036 + 1e-2]
    depths = [0.01 * min(t, 2 - t) for t in times]
    states = given(SMALL, times=times, depths=depths, time_tolerance=5e-4)
    forces = [1.249848592650e-3, 3.181015305682e-3, 1.786363157339e-3, 7.432398878284e-4, 9.371300393370e-5]
    # 5e-4 of the largest force by time; 2e-3 of its own by the rings, of which 30 at the smallest radius in contact.
    for state, force in zip(states[1:], forces, strict=False):
        assert state.force == pytest.approx(force, rel=2e-3, abs=5e-4 * 3.2e-3)
    assert states[-1].force == 0
    assert states[2].work == pytest.approx(1.352318027651e-5, rel=2e-3)
    # The work of the whole cycle is the loss.
    assert states[-1].work == pytest.approx(5.3556e-6, rel=3e-3)


def test_the_contact_recedes_at_once_if_the_force_falls():
    times = [0.0, 1.0, 1.25, 1.5, 1.75]
    forces = [0.1 * min(t, 2 - t) for t in times]
    states = given(BALL, times=times, forces=forces, time_tolerance=5e-4)
    # The rings are 0.004 wide: 2e-4 of the depth.
    depths = [0.319058746419**2, 0.0946466787, 0.0842749644, 0.0696751423]
    assert [state.depth for state in states[1:]] == pytest.approx(depths, rel=5e-4)
    radii = [0.319058746419, 0.306234376258, 0.282009751525, 0.235044661520]
    found = [np.sqrt(state.contact_area / np.pi) for state in states[1:]]
    assert found == pytest.approx(radii, abs=0.5 / 120)


def wavy(count):
    """Return a random periodic surface."""
    grid = rc.Grid((count, count), 1 / count, periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=0.01, rng=3, rolloff=0.5, short_cutoff=8 / count)


ROUGH = wavy(64)


def test_a_rough_surface_in_and_out_follows_from_its_elastic_curve():
    rate = 0.6 * ROUGH.heights.max()
    depths = np.linspace(0, rate, 81)[1:]
    curve = rc.loading_curve(ROUGH, 1.0, depths=depths)
    force = PchipInterpolator(np.r_[0, depths], np.r_[0, curve.force])
    states = given(
        ROUGH, times=[0, 1, 1.2, 1.4], depths=[0, rate, 0.8 * rate, 0.6 * rate], time_tolerance=5e-4
    )
    for state in states[2:]:
        first, expected = ting(force, rate, rate, state.time)
        assert state.force == pytest.approx(float(expected), abs=1e-3 * float(force(rate)))
        elastic = rc.press(ROUGH, 1.0, depth=rate * first)
        assert np.array_equal(state.contact, elastic.contact)
    growing = rc.press(ROUGH, 1.0, depth=rate)
    assert np.array_equal(states[1].contact, growing.contact)


def test_a_body_returns_to_a_surface_that_recovers():
    times = [0.0, 1.0, 2.0, 2.2, 3.0, 5.0]
    depths = [0.0, 0.01, 0.01, 0.003, 0.003, 0.003]
    states = given(SMALL, times=times, depths=depths, time_tolerance=4e-4)
    force = [state.force for state in states]
    springs = viscoelastic_history.depth_history(indenter.paraboloid(1.0), SOLID, times, depths, springs=400)
    assert force[3] == force[4] == springs.force[3] == 0
    assert force[1:3] == pytest.approx([3.18102e-3, 2.01306e-3], rel=2e-3)  # by the rings
    # The largest force, 30 times this one, sets the scale of the error of time.
    assert force[5] == pytest.approx(1.1086e-4, rel=5e-3)


def test_a_punch_under_a_held_force():
    grid = rc.RadialGrid.uniform(60, 1.0)
    punch = rc.RadialProfile(np.zeros(60), grid)
    states = given(punch, times=[0, 1], forces=[1.0, 1.0], time_tolerance=1e-5)
    # The contact is fixed, so that depths are proportional; on the grid the disc is somewhat stiffer.
    assert states[1].depth / states[0].depth == pytest.approx(float(CREEP(1.0) / CREEP(0.0)), rel=1e-5)
    assert states[1].depth == pytest.approx(0.261156229809, rel=2e-2)


def test_a_held_depth():
    states = given(SMALL, times=[0, 0, 1], depths=[0, 0.01, 0.01], tolerance=1e-10)
    assert states[-1].force / states[1].force == pytest.approx(float(SOLID.relaxation(1.0)) / 3, rel=1e-8)
    assert states[-1].force == pytest.approx(2.314345176457e-3, rel=2e-3)  # rings
    assert np.array_equal(states[-1].contact, states[1].contact)
    assert states[-1].gap == pytest.approx(states[1].gap, abs=1e-8 * 0.01)


def test_a_wave_under_a_held_pressure_closes():
    grid = rc.Grid((2, 256), (1 / 256, 1 / 256), periodic=True)
    wave = rc.Surface(0.01 * np.tile(np.cos(2 * np.pi * grid.coordinates[1]), (2, 1)), grid)
    most = np.pi * 0.01
    times = [0.0, 1.0, 4.15, 4.165, 8.0]
    states = given(wave, times=times, pressures=[1.2 * most] * 5)
    widths = [state.contact_fraction / 2 for state in states]
    assert widths[:2] == pytest.approx(
        [0.217952891576, 0.290799102998], abs=1 / 256
    )  # of cells on both sides
    elastic = rc.press(wave, 1 / float(CREEP(1.0)), pressure=1.2 * most)
    assert np.array_equal(states[1].contact, elastic.contact)
    assert [fraction < 0.5 for fraction in widths] == [True, True, True, False, False]  # full at 4.1589
    # In full contact the amplitude of the pressure relaxes to E_inf p*, of which 0.02 are left at 8 s.
    assert np.ptp(states[-1].pressure) / 2 < 1.04 * most
    assert states[-1].stiffness == np.inf
