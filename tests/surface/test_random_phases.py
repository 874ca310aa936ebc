"""Waves as a function of a key and a wave vector: their definition, their parts, and that they are random."""

import math
from itertools import pairwise

import numpy as np
import pytest

from roughcontact.surface.generation.random_phases import draw_keys, unit_waves

WORD = 2**64
KEYS = draw_keys(np.random.default_rng(20))
EPS = np.finfo(float).eps


def philox(counter, key):
    """Return the block of Philox4x64-10 in whole numbers (Salmon et al. 2011, section 3.3)."""
    c, k = list(counter), list(key)
    for _ in range(10):
        high0, low0 = divmod(0xD2E7470EE14C6C93 * c[0], WORD)
        high1, low1 = divmod(0xCA5A826395121157 * c[2], WORD)
        c = [high1 ^ c[1] ^ k[0], low1, high0 ^ c[3] ^ k[1], low0]
        k = [(k[0] + 0x9E3779B97F4A7C15) % WORD, (k[1] + 0xBB67AE8584CAA73B) % WORD]
    return c


def test_the_oracle_is_philox():
    """The known answers that come with its authors' Random123: of zeros, and of ones in every bit."""
    zeros = [0x16554D9ECA36314C, 0xDB20FE9D672D0FDC, 0xD7E772CEE186176B, 0x7E68B68AEC7BA23B]
    ones = [0x87B092C3013FE90B, 0x438C3C67BE8D0224, 0x9CC7D7C69CD777B6, 0xA09CAEBF594F0BA0]
    assert philox([0] * 4, [0] * 2) == zeros
    assert philox([WORD - 1] * 4, [WORD - 1] * 2) == ones


@pytest.mark.parametrize("ky", [0, 3, -3, 2**40, -(2**40)])
@pytest.mark.parametrize("kx", [0, 1, 6, 2**33 + 1])
def test_a_wave_is_what_the_format_says(kx, ky):
    """Phase and modulus word by word; the errors of a tangent and of four operations are below 8 eps."""
    back = kx == 0 and ky < 0
    words = philox([kx // 2 + 1, (-ky if back else ky) % WORD, 0, 0], [int(word) for word in KEYS[0]])
    phase, size = (word >> 11 for word in words[2 * (kx % 2) : 2 * (kx % 2) + 2])
    expected = np.exp(2j * math.pi * (-1 if back else 1) * (phase / 2**53))
    assert abs(unit_waves(KEYS, ky, (kx, kx + 1)).item() - expected) < 8 * EPS
    modulus = math.sqrt(-math.log((size + 1) / 2**53))
    found = unit_waves(KEYS, ky, (kx, kx + 1), "gaussian").item()
    assert abs(found - modulus * expected) < 8 * EPS * modulus


def test_the_tangent_of_half_the_angle_keeps_modulus_and_phase():
    waves = unit_waves(KEYS, np.arange(-100, 100), (0, 500))
    assert np.abs(np.abs(waves) - 1).max() < 8 * EPS


@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
def test_any_part_can_be_made_alone_in_any_order(amplitudes):
    ky = np.arange(-20, 20)
    whole = unit_waves(KEYS, ky, (0, 31), amplitudes)
    rng = np.random.default_rng(0)
    for first, end in [(0, 1), (1, 2), (0, 31), (5, 5), (7, 12), (8, 13)]:
        some = rng.permutation(40)[:17]
        part = unit_waves(KEYS, ky[some], (first, end), amplitudes)
        np.testing.assert_array_equal(part, whole[some, first:end])


def test_opposite_waves_are_conjugate_on_the_axis():
    waves = unit_waves(KEYS, np.arange(-9, 10), (0, 1), "gaussian")[:, 0]
    np.testing.assert_array_equal(waves[:9], waves[:9:-1].conj())


def test_amplitudes_do_not_touch_the_phases():
    ky, kx = np.arange(-9, 10), (0, 50)
    exact, gaussian = (unit_waves(KEYS, ky, kx, amplitudes) for amplitudes in ("exact", "gaussian"))
    assert np.abs(gaussian / np.abs(gaussian) - exact).max() < 8 * EPS
    with pytest.raises(ValueError, match="'exact' or 'gaussian'"):
        unit_waves(KEYS, ky, kx, "loud")


def test_rows_may_have_keys_of_their_own():
    keys = draw_keys(np.random.default_rng(1), 3)
    together = unit_waves(keys, 0, (0, 20))
    for key, row in zip(keys, together, strict=True):
        np.testing.assert_array_equal(unit_waves(key[np.newaxis], [0], (0, 20))[0], row)


def test_a_generator_moves_on_by_the_key_alone():
    one, other = np.random.default_rng(5), np.random.default_rng(5)
    keys = draw_keys(one, 2)
    np.testing.assert_array_equal(keys.ravel(), other.bit_generator.random_raw(4))
    assert one.bit_generator.state == other.bit_generator.state
    np.testing.assert_array_equal(draw_keys(5, 2), keys)
    with pytest.raises(ValueError, match="rng must be"):
        draw_keys(5.5)


def kuiper(values):
    """Return how likely uniform values are as uneven as these (Kuiper 1960; Stephens 1970 for finite samples)."""
    n, ordered = len(values), np.sort(values)
    steps = np.arange(n + 1) / n
    most = (steps[1:] - ordered).max() + (ordered - steps[:-1]).max()
    x = (math.sqrt(n) + 0.155 + 0.24 / math.sqrt(n)) * most
    j = np.arange(1, 50)
    return float((2 * (4 * j**2 * x**2 - 1) * np.exp(-2 * j**2 * x**2)).sum())


def test_phases_and_moduli_are_uniform_and_exponential():
    """One in ten thousand samples of either would fail; a phase off by 2 % of a turn in one half of them would, too."""
    waves = unit_waves(KEYS, np.arange(-150, 150), (1, 300), "gaussian").ravel()
    turns, shares = np.angle(waves) / (2 * np.pi) + 0.5, np.exp(-(np.abs(waves) ** 2))
    assert kuiper(turns) > 1e-4
    assert kuiper(shares) > 1e-4
    assert kuiper(np.where(turns < 0.5, turns + 0.02, turns)) < 1e-4


def normal(products):
    """Return the mean of complex products of unit mean square over its standard error, two parts of N(0, 1)."""
    mean = products.mean() * math.sqrt(2 * products.size)
    return np.array([mean.real, mean.imag])


@pytest.mark.parametrize("amplitudes", ["exact", "gaussian"])
def test_neighbouring_waves_are_not_correlated(amplitudes):
    """Of waves one or two steps apart, and of mirror images: 4.5 standard errors, seldom exceeded by one in 40."""
    waves = unit_waves(KEYS, np.arange(-150, 151), (1, 302), amplitudes)
    pairs = [
        *((waves[:, :-step], waves[:, step:]) for step in (1, 2)),
        *((waves[:-step], waves[step:]) for step in (1, 2)),
        (waves[:-1, :-1], waves[1:, 1:]),
        (waves[:-1, 1:], waves[1:, :-1]),
        (waves[:150], waves[:150:-1]),
    ]
    for one, other in pairs:
        assert np.abs(normal(one * other.conj())).max() < 4.5
        assert np.abs(normal(one * other)).max() < 4.5
        if (
            amplitudes == "gaussian"
        ):  # powers are exponential: products of what is beyond their mean have variance 1
            powers = (np.abs(one) ** 2 - 1) * (np.abs(other) ** 2 - 1)
            assert abs(powers.mean()) * math.sqrt(powers.size) < 4.5


@pytest.mark.parametrize("how", ["drawn", "bits", "numbers"])
def test_keys_do_not_know_each_other(how):
    """Correlations of 1000 pairs of keys: their squares sum to chi^2 of 2000 degrees, 4 standard deviations.

    Keys as generators draw them, keys that differ in one bit, and keys that are numbers in a row.
    """
    if how == "drawn":
        keys = np.concatenate([draw_keys(np.random.default_rng(seed)) for seed in range(1001)])
        pairs = pairwise(keys)
    elif how == "bits":
        flips = [
            np.array([1 << bit if word == 0 else 0, 1 << bit if word else 0], np.uint64)
            for word in range(2)
            for bit in range(64)
        ]
        keys = draw_keys(np.random.default_rng(0), 1000)
        pairs = ((key, key ^ flips[number % 128]) for number, key in enumerate(keys))
    else:
        pairs = (
            (np.array([number, 0], np.uint64), np.array([number + 1, 0], np.uint64)) for number in range(1000)
        )
    ky, kx = np.arange(-8, 8), (1, 33)
    found = np.array(
        [
            normal(unit_waves(a[np.newaxis], ky, kx) * unit_waves(b[np.newaxis], ky, kx).conj())
            for a, b in pairs
        ]
    )
    assert found.shape == (1000, 2)
    assert abs((found**2).sum() - 2000) < 4 * math.sqrt(2 * 2000)
    assert np.abs(found).max() < 5.0  # of 2000 normal numbers, one in a thousand sets has one beyond
