"""Ultrasound at a joint: against the equations of both bodies, energy, derivatives, and a wave in time."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import roughcontact as rc
from roughcontact.theory import ultrasound

STEEL, ALUMINIUM = 46.2e6, 17.1e6
LIKE, UNLIKE = (STEEL, STEEL), (STEEL, ALUMINIUM)
# K/A0 of the worked joint of docs/concepts/joints.md at 10 and 100 MPa.
WORKED = np.array([2.51e13, 2.255e14])


@pytest.mark.parametrize("impedances", [LIKE, UNLIKE, UNLIKE[::-1]])
@pytest.mark.parametrize("mass", [0.0, 0.3])
def test_both_waves_fulfil_the_equations_of_both_bodies_and_keep_the_energy(impedances, mass):
    frequency = np.array([1e5, 1e6, 1e7])
    r = ultrasound.reflection(WORKED[1], frequency, impedances, mass)
    t = ultrasound.transmission(WORKED[1], frequency, impedances, mass)
    first, second = impedances
    # Stress and displacement from both waves: force on the mass, and stretch of the springs. A few roundings.
    i_w = 2j * math.pi * frequency
    s1, s2, u1, u2 = -i_w * first * (1 - r), -i_w * second * t, 1 + r, t
    scale = np.abs(s1) + np.abs(s2) + np.abs(i_w**2 * mass)
    assert np.abs(s2 - s1 - i_w**2 * mass * (u1 + u2) / 2).max() < 1e-14 * scale.max()
    assert (np.abs((s1 + s2) / 2 - WORKED[1] * (u2 - u1)) < 1e-14 * (scale + WORKED[1])).all()
    assert np.abs(r) ** 2 + second / first * np.abs(t) ** 2 == pytest.approx(np.ones(3), abs=1e-15)


def test_the_phase_gives_the_same_stiffness_as_the_size():
    r = complex(ultrasound.reflection(WORKED[0], 2e5, LIKE))
    assert math.tan(np.angle(r)) * 2 * math.pi * 2e5 * STEEL / 2 == pytest.approx(WORKED[0], rel=1e-14)


@pytest.mark.parametrize("impedances", [LIKE, UNLIKE, UNLIKE[::-1]])
def test_the_reflection_gives_back_the_stiffness_and_its_derivative(impedances):
    frequency = np.array([2e5, 1e6])
    size = np.abs(ultrasound.reflection(WORKED, frequency, impedances))
    k, error = ultrasound.stiffness_from_reflection(size, frequency, impedances, error=1e-3)
    assert k == pytest.approx(WORKED, rel=1e-13)
    # A central difference: its errors are about step^2 and 1e-16/step, for a step in units of the curve's own scale.
    least = abs(impedances[0] - impedances[1]) / sum(impedances)
    step = 1e-5 * np.minimum(1 - size, size - least)
    above, below = (
        ultrasound.stiffness_from_reflection(size + e * step, frequency, impedances)[0] for e in (1, -1)
    )
    assert error / 1e-3 == pytest.approx((below - above) / (2 * step), rel=1e-9)
    assert error / 1e-3 == pytest.approx(ultrasound.amplification(size, impedances) * k / size, rel=1e-14)


def test_the_worked_joint_is_measured_at_another_frequency_than_5_mhz():
    size = np.abs(ultrasound.reflection(WORKED, 5e6, LIKE))
    assert size == pytest.approx([0.99940, 0.95496], abs=5e-6)
    assert ultrasound.amplification(size, LIKE) == pytest.approx([837, 11], rel=0.05)
    assert ultrasound.amplification(size[0], LIKE) == pytest.approx(837, abs=0.5)
    best = ultrasound.best_frequency(WORKED, LIKE)
    assert best == pytest.approx([0.12e6, 1.10e6], abs=5e3)
    with pytest.raises(rc.InputError, match="837 times less certain") as caught:
        ultrasound.stiffness_from_reflection(size, 5e6, LIKE)
    asked = float(caught.value.remedy.removeprefix("measure at about ").removesuffix(" MHz"))
    assert asked * 1e6 == pytest.approx(best[0], rel=0.05)  # two digits are printed
    followed = np.abs(ultrasound.reflection(WORKED[0], asked * 1e6, LIKE))
    assert ultrasound.stiffness_from_reflection(followed, asked * 1e6, LIKE)[0] == pytest.approx(WORKED[0])


@pytest.mark.parametrize("impedances", [LIKE, UNLIKE, UNLIKE[::-1]])
def test_the_amplification_is_known_before_the_measurement(impedances):
    """1 - |r|^2 is at least 1e-3 here, and loses at most three of sixteen digits."""
    size = np.abs(ultrasound.reflection(WORKED, 5e6, impedances))
    wanted = ultrasound.amplification(size, impedances)
    assert ultrasound.expected_amplification(WORKED, 5e6, impedances) == pytest.approx(wanted, rel=1e-12)


def test_the_amplification_of_a_soft_joint_does_not_round():
    """|r| rounds to 1, which no stiffness reflects; for like bodies the factor is 1 + (w z/2K)^2."""
    ratio = 2 * math.pi * 5e6 * STEEL / 2 / 1e4
    assert np.abs(ultrasound.reflection(1e4, 5e6, LIKE)) == 1
    assert ultrasound.expected_amplification(1e4, 5e6, LIKE) == pytest.approx(1 + ratio**2, rel=1e-14)


@pytest.mark.parametrize("impedances", [LIKE, UNLIKE])
def test_no_other_frequency_makes_the_stiffness_less_uncertain(impedances):
    best = ultrasound.best_frequency(WORKED, impedances)
    errors = []
    for factor in (0.999, 1.0, 1.001):
        frequency = factor * best
        size = np.abs(ultrasound.reflection(WORKED, frequency, impedances))
        errors.append(ultrasound.stiffness_from_reflection(size, frequency, impedances, 1e-3)[1] / WORKED)
    assert (errors[1] < errors[0]).all()
    assert (errors[1] < errors[2]).all()
    if impedances == LIKE:
        assert size == pytest.approx(np.full(2, 3**-0.5), rel=1e-3)  # at 1.001 of the frequency
        assert errors[1] / 1e-3 == pytest.approx(np.full(2, 2.598), abs=1e-3)


def test_a_reflection_that_no_stiffness_explains_is_refused():
    least = (STEEL - ALUMINIUM) / (STEEL + ALUMINIUM)
    for wrong in (least * 0.99, least, 1.0, 1.2):
        with pytest.raises(rc.InputError, match=r"above 0\.4597"):
            ultrasound.stiffness_from_reflection(wrong, 1e6, UNLIKE)
    assert ultrasound.stiffness_from_reflection(0.4, 1e6, LIKE)[0] > 0  # like bodies have no least reflection


def test_two_frequencies_give_one_stiffness_or_an_error():
    mean, error = ultrasound.combined([[2.0e14, 2.1e14], [1.0e14, 1.0e14]], [1e13, 1e13])
    assert mean == pytest.approx([2.05e14, 1.0e14])
    assert error == pytest.approx([1e13 / math.sqrt(2)] * 2)
    # Differences of two values beyond 2.576 sd of the difference have a chance of 1 %.
    for size, agrees in ((2.57, True), (2.58, False)):
        values = np.array([2e14, 2e14 + size * math.sqrt(2) * 1e13])
        if agrees:
            ultrasound.combined(values, 1e13)
        else:
            with pytest.raises(rc.InputError, match="the frequencies give different stiffnesses"):
                ultrasound.combined(values, 1e13)
    with pytest.raises(rc.InputError, match="one frequency"):
        ultrasound.combined([2e14], [1e13])


@pytest.mark.parametrize("ratio", [1.0, 0.4])
def test_the_second_harmonic_is_that_of_a_wave_in_time(ratio):
    """Springs whose stiffness is K + K' p, between bodies of z = 1 and `ratio`; K'A = 1e-3, so 1e-3 is neglected^2."""
    k, slope, amplitude, angular = 1.3, 1e-3, 1.0, 1.0

    def closing_rate(time, closing):
        pressure = k / slope * np.expm1(slope * closing)
        return 2 * amplitude * angular * np.cos(angular * time) - pressure * (1 + 1 / ratio)

    times = 2 * math.pi * np.arange(20 * 64, 21 * 64) / 64
    closing = solve_ivp(
        closing_rate, (0, times[-1]), [0.0], method="DOP853", t_eval=times, rtol=1e-12, atol=1e-13
    ).y[0]
    pressure = k / slope * np.expm1(slope * closing)
    second = 2 * np.abs(np.fft.rfft(pressure)[2]) / 64  # velocities p/z at 2 w
    found = ultrasound.second_harmonic(amplitude, k, slope, angular / (2 * math.pi), (1.0, ratio))
    # The next order of the series is K'A squared, and the integration adds 1e-12/1e-3.
    assert found.reflected == pytest.approx(second / 2, rel=5e-6)
    assert found.transmitted == pytest.approx(second / (2 * ratio), rel=5e-6)
    assert found.opening == pytest.approx(-closing.mean(), rel=5e-6)


def test_a_strong_wave_has_no_series():
    with pytest.raises(rc.InputError, match="more than 10%"):
        ultrasound.second_harmonic(1e-7, 2.255e14, 2e6, 5e6, LIKE)


def test_the_impedance_of_steel():
    # Density times the longitudinal speed sqrt((lambda + 2 mu)/density).
    shear = 206e9 / 2.6
    lame = 2 * shear * 0.3 / 0.4
    assert ultrasound.impedance(206e9, 0.3, 7850) == pytest.approx(
        7850 * math.sqrt((lame + 2 * shear) / 7850)
    )
    with pytest.raises(rc.InputError, match=r"below 0\.5"):
        ultrasound.impedance(1e6, 0.5, 1000)
