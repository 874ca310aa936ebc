"""Thesis, eqs 4.33 to 4.46 and 4.72: cosine waves pressed on springs, spring by spring."""

import numpy as np
import pytest

from roughcontact.theory.springs import cosine, height_distribution, two_cosines
from roughcontact.theory.springs.beat_wave import beat_wave


def printed_4_33(depth, amplitude, length, modulus):
    """F = (2/pi) L E* h0 (asin sqrt s - sqrt(s (1 - s))), s = d/(2 h0)."""
    s = depth / (2 * amplitude)
    return 2 / np.pi * length * modulus * amplitude * (np.arcsin(np.sqrt(s)) - np.sqrt(s * (1 - s)))


def printed_4_34_first(depth, amplitude, length, modulus):
    """F = (2/pi) L E* h0 (2/3) (d/(2 h0))^(3/2)."""
    return 2 / np.pi * length * modulus * amplitude * 2 / 3 * (depth / (2 * amplitude)) ** 1.5


def printed_4_34_second(depth, amplitude, length, modulus):
    """F = (2^(1/2)/pi) L E* h0^(-1/2) d^(3/2)."""
    return np.sqrt(2) / np.pi * length * modulus * depth**1.5 / np.sqrt(amplitude)


def printed_4_40(modulus, long_wave, short_amplitude):
    """F = 16/(3 pi) E* h2^(3/2)/(q1 h1^(1/2))."""
    h1, q1 = long_wave
    return 16 / (3 * np.pi) * modulus * short_amplitude**1.5 / (q1 * np.sqrt(h1))


def printed_4_41(modulus, long_wave, short_amplitude):
    """k = E* (4/q1) (h2/h1)^(1/2)."""
    h1, q1 = long_wave
    return 4 * modulus / q1 * np.sqrt(short_amplitude / h1)


def printed_4_72(modes):
    """beta = -1/2 + (1/2) log2 N."""
    return -0.5 + 0.5 * np.log2(modes)


def pressed(line, highest, depth, width):
    """Return force and stiffness of springs (E* = 1) under a line of a width, sampled in the middles of equal parts."""
    overlap = line - highest + depth
    inside = overlap > 0
    step = width / len(line)
    return step * overlap[inside].sum(), step * inside.sum()


def one_wave(depth, n=2**20):
    return pressed(np.cos(2 * np.pi * (np.arange(n) + 0.5) / n), 1.0, depth, 1.0)


@pytest.mark.parametrize("depth", [0.02, 0.2, 0.5, 1.0, 1.5])
def test_4_33_one_wave(depth):
    # 2^20 parts of a period: the ends of the contact cost one of them in k, and in F where the overlap is 0.
    force, stiffness = one_wave(depth)
    assert cosine.force(depth, 1.0, 1.0, 1.0) == pytest.approx(force, rel=1e-8)
    assert cosine.stiffness(depth, 1.0, 1.0, 1.0) == pytest.approx(stiffness, abs=2e-6)
    # Half the truth at small depths; it catches up only where the wave is flat.
    assert abs(printed_4_33(depth, 1.0, 1.0, 1.0) / force - 1) > 0.1
    if depth == 0.02:
        assert printed_4_33(depth, 1.0, 1.0, 1.0) / force == pytest.approx(0.5, abs=0.01)


def test_4_33_printed_stiffness_has_no_bound():
    # All springs together have E* L; the printed slope is infinite at d = 2 h0.
    d = np.array([2 - 1e-4, 2 - 1e-6])
    slope = np.diff(printed_4_33(d, 1.0, 1.0, 1.0)) / np.diff(d)
    assert slope[0] > 10
    assert np.diff(cosine.force(d, 1.0, 1.0, 1.0)) / np.diff(d) <= 1


def test_4_34_small_depths():
    """A parabola of radius R1 = 1/(h0 q^2) on springs has (4 sqrt 2/3) E* sqrt(R1) d^(3/2), L q/(2 pi) of them."""
    h0, length, modulus, q, d = 0.2, 3.0, 5.0, 40.0, 1e-7
    crest = 4 * np.sqrt(2) / 3 * modulus * np.sqrt(1 / (h0 * q**2)) * d**1.5
    force = crest * length * q / (2 * np.pi)
    assert cosine.small_force(d, h0, length, modulus) == pytest.approx(force, rel=1e-13)
    assert cosine.force(d, h0, length, modulus) == pytest.approx(force, rel=1e-6)
    assert printed_4_34_first(d, h0, length, modulus) == pytest.approx(force / 2, rel=1e-13)
    assert printed_4_34_second(d, h0, length, modulus) == pytest.approx(force * 3 / 2, rel=1e-13)


LONG, SHORT, RATIO = (1.0, 1.0), 1e-3, 3000


def crest(depth):
    """Return force and stiffness of one crest of the long wave under many short ones.

    The long wave is a cosine, not a parabola: up to q1 x = 0.063 it falls less by (q1 x)^2/12, 3.3e-4. The contact
    holds 60 short waves; their sum differs from the integral by the parts of a wave at its ends, which carry little.
    """
    n, width = 2**21, 0.2
    x = (np.arange(n) + 0.5) / n * width - width / 2
    line = LONG[0] * np.cos(x) + SHORT * np.cos(RATIO * x)
    return pressed(line, LONG[0] + SHORT, depth, width)


@pytest.mark.parametrize("depth", [0.5e-3, 1e-3, 2e-3])
def test_4_38_two_waves(depth):
    force, stiffness = crest(depth)
    assert two_cosines.force(depth, LONG, SHORT, 1.0) == pytest.approx(force, rel=5e-4)
    assert two_cosines.stiffness(depth, LONG, SHORT, 1.0) == pytest.approx(stiffness, rel=5e-3)
    # Eq. 4.38 with the printed eq. 4.33 in it.
    edge = np.sqrt(2 * depth)
    x = (np.arange(10_000) + 0.5) / 10_000 * 2 * edge - edge
    printed = np.mean(printed_4_33(depth - x**2 / 2, SHORT, 1.0, 1.0)) * 2 * edge
    assert printed < 0.8 * force


def test_4_39_and_4_40_force_where_the_short_wave_is_flat():
    force, _ = crest(2 * SHORT)
    assert two_cosines.flat(LONG, SHORT, 1.0)[0] == pytest.approx(force, rel=5e-4)
    # 4/3 lies between 64/(9 pi) and 16/(3 pi).
    assert force / printed_4_40(1.0, LONG, SHORT) == pytest.approx(4 / 3, rel=5e-4)
    # The bracket of eq. 4.39 in xi, right and printed.
    xi = (np.arange(10_000) + 0.5) / 10_000
    root, angle = xi * np.sqrt(1 - xi**2), np.arccos(xi)
    assert np.mean(root + (1 - 2 * xi**2) * angle) == pytest.approx(8 / 9, rel=1e-6)
    assert np.mean(angle - root) == pytest.approx(2 / 3, rel=1e-6)


def test_4_41_stiffness_where_the_short_wave_is_flat():
    d, step = 2 * SHORT, 2e-5
    (below, _), (above, _) = crest(d - 2 * step), crest(d)
    k = (above - below) / (2 * step)
    # A secant over two per cent of the depth lies between the tangents at its ends; the errors of the forces, some
    # 1e-4 each, are 4 % apart.
    ends = two_cosines.stiffness(np.array([d - 2 * step, d]), LONG, SHORT, 1.0)
    assert ends[0] * (1 - 5e-3) < k < ends[1] * (1 + 5e-3)
    # The contact is not the whole width of the overlap, which is the printed value, but 2/pi of it.
    right = two_cosines.flat(LONG, SHORT, 1.0)[1]
    assert right / printed_4_41(1.0, LONG, SHORT) == pytest.approx(2 / np.pi, rel=1e-13)
    assert 0.6 < k / printed_4_41(1.0, LONG, SHORT) < 0.65


def test_4_45_and_4_46_hierarchy_of_waves():
    # h1/h0 = C^-H = 1e-3 at C = 3000: the two waves of `crest`.
    hurst = np.log(1e3) / np.log(RATIO)
    waves = two_cosines.Hierarchy(LONG[0], LONG[1], float(RATIO), hurst)
    (force,), (stiffness,) = waves.corners(1, 1.0)
    computed, _ = crest(2 * SHORT)
    assert force == pytest.approx(computed, rel=5e-4)
    assert force / printed_4_40(1.0, LONG, SHORT) == pytest.approx(4 / 3, rel=1e-13)
    assert stiffness / printed_4_41(1.0, LONG, SHORT) == pytest.approx(2 / np.pi, rel=1e-13)


@pytest.mark.parametrize("modes", [1, 2, 4, 8])
def test_4_72_waves_of_independent_phases(modes):
    """Near the common peak N parabolas fill an N-ball: its volume goes as u^(N/2), so beta = N/2 - 1."""
    d, u = beat_wave(modes, 1.0), np.array([1e-5, 1e-4])
    below = d.fraction(u)
    beta = np.log(below[1] / below[0]) / np.log(10) - 1
    assert beta == pytest.approx(modes / 2 - 1, abs=1e-3)
    assert printed_4_72(modes) == height_distribution.legacy_density_exponent(modes)
    assert (abs(printed_4_72(modes) - beta) < 1e-2) == (modes <= 2)
