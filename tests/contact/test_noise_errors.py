"""Noise of the heights: its draws, its share of the errors, and whether the truth lies within them."""

import functools
import json
import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.evaluation.error_noise import TOO_MUCH, errors_of_noise
from roughcontact.evaluation.error_numbers import NUMBERS, number_table
from roughcontact.evaluation.noise import between_neighbours, require_fits

RMS = 1e-7
GAP, AREA, STIFFNESS = (NUMBERS.index(name) for name in ("mean_gap", "contact_area", "interfacial_stiffness"))


def rough(n=32, *, periodic=True, seed=1):
    waves = {"hurst": 0.8, "rms": RMS, "rolloff": n / 4 * 1e-6, "short_cutoff": 6e-6}
    return rc.self_affine(rc.Grid((n, n), 1e-6, periodic=periodic), rng=np.random.default_rng(seed), **waves)


def noisy(surface, noise, seed=1):
    draw = noise.draw(surface.grid, np.random.default_rng([seed, 1]))
    return rc.Surface(surface.heights + draw, surface.grid)


def pressed(surface, **load):
    return rc.press(surface, 1e9, **(load or {"pressure": 4e6}))


def covariance(noise, grid):
    """The covariance of the heights of all cells, from its definition; images as far as they are seen."""
    total = np.ones((1, 1))
    for n, spacing, periodic in zip(grid.shape, grid.spacing, grid.periodic, strict=True):
        lags = (np.arange(n)[:, None] - np.arange(n)) * spacing
        images = [k * n * spacing for k in ((-2, -1, 0, 1, 2) if periodic else (0,))]
        length = noise.correlation_length
        part = sum(np.exp(-(((lags + image) / length) ** 2)) for image in images) if length else lags == 0
        total = np.kron(total, part)
    return noise.rms**2 * total


@pytest.mark.parametrize("periodic", [True, False, (False, True)])
@pytest.mark.parametrize("length", [0.0, 1e-6, 4e-6])
def test_spread_is_that_of_the_covariance(periodic, length):
    grid = rc.Grid((16, 20), (1e-6, 1.5e-6), periodic=periodic)
    noise, derivative = rc.Noise(3e-9, length), np.random.default_rng(0).standard_normal((16, 20)) + 0.3
    row = derivative.ravel()
    expected = math.sqrt(row @ covariance(noise, grid) @ row)
    # On a free map the images of the padded grid are 4 correlation lengths away: exp(-16).
    assert noise.spread(derivative, grid) == pytest.approx(expected, rel=1e-6)
    drawn = [float(np.sum(derivative * noise.draw(grid, (2, seed)))) for seed in range(400)]
    # The standard deviation of 400 draws has a standard error of 3.5 %.
    assert np.std(drawn) == pytest.approx(expected, rel=0.14)


def test_the_difference_of_neighbours():
    grid = rc.Grid((64, 64), 1e-6, periodic=True)
    for length in (0.0, 1e-6, 4e-6):
        noise = rc.Noise(3e-9, length)
        steps = [np.diff(noise.draw(grid, seed), axis=1).std() for seed in range(8)]
        assert np.mean(steps) == pytest.approx(between_neighbours(noise, grid), rel=0.03)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("length", [0.0, 1.5e-6, 4e-6])
def test_repeats_show_their_noise(periodic, length):
    surface, noise = rough(64, periodic=periodic), rc.Noise(3e-9, length)
    tilt = 0.0 if periodic else np.linspace(0, 1e-7, 64)
    repeats = [noisy(surface, noise, seed) for seed in range(4)]
    repeats = [each.with_heights(each.heights + k * (tilt + 1e-8), "") for k, each in enumerate(repeats)]
    found = rc.Noise.from_repeats(repeats)
    # Three free repeats of (64/4)^2 independent patches at least: 2.6 % of the rms, and the length to about 5 %.
    assert found.rms == pytest.approx(noise.rms, rel=0.1)
    assert found.correlation_length == pytest.approx(noise.correlation_length, rel=0.15)


def test_identical_repeats_have_no_noise():
    surface = rough()
    assert rc.Noise.from_repeats([surface, surface]) == rc.Noise(0.0)


def test_missing_cells_of_repeats_do_not_count():
    surface = rough(64)
    repeats = [noisy(surface, rc.Noise(3e-9), seed) for seed in range(4)]
    holes = [each.with_heights(np.where(surface.heights > RMS, np.nan, each.heights), "") for each in repeats]
    assert rc.Noise.from_repeats(holes).rms == pytest.approx(3e-9, rel=0.05)


def test_parts_of_the_budget():
    solution, noise = pressed(noisy(rough(), rc.Noise(3e-9))), rc.Noise(3e-9)
    budget, plain = rc.error_budget(solution, noise=noise), rc.error_budget(solution)
    assert [(each.name, each.kind) for each in budget.sources[-2:]] == [
        ("noise", "standard error"),
        ("noise bias", "bias"),
    ]
    assert "% of the height differences" in budget.sources[-2].how
    derivatives = rc.sensitivity(solution)
    gap = budget["mean_gap"]
    assert gap.parts[-2] == pytest.approx(3e-9 * np.linalg.norm(derivatives.mean_gap_at_force), rel=1e-9)
    assert budget["depth"].parts[-2] == pytest.approx(3e-9, rel=0.1)  # that of the highest cell
    assert set(budget.corrections) == {
        each.name for each in budget.numbers if each.value != plain[each.name].value
    }
    for each in budget.numbers:
        assert each.parts[:-2] == plain[each.name].parts
        assert each.value - budget.corrections.get(each.name, 0.0) == pytest.approx(plain[each.name].value)
    assert "mean_gap" in budget.corrections
    [words] = [words for name, words in budget.facts() if name == "corrected"]
    assert "mean gap by -" in words
    assert not [words for name, words in plain.facts() if name == "corrected"]
    record = json.loads(json.dumps(budget.to_record()))
    assert record["corrections"] == pytest.approx(budget.corrections)
    assert record["mean_gap"]["noise_bias"] == gap.parts[-1]
    assert plain.corrections == {}


def test_without_noise_nothing_changes():
    found = errors_of_noise([pressed(rough())], rc.Noise(0.0))
    assert not found.correction.any()
    assert np.abs(found.parts).max(axis=0) == pytest.approx(0, abs=1e-6)


def test_the_scatter_of_patches_contains_their_noise():
    noise = rc.Noise(3e-9)
    budget = rc.error_budget([pressed(noisy(rough(seed=k), noise, k)) for k in (1, 2)], noise=noise)
    assert [each.name for each in budget.sources] == ["grid", "short cut-off", "patches", "noise bias"]
    assert "mean_gap" in budget.corrections


def test_a_map_that_cannot_hold_the_noise():
    solution = pressed(rough())
    assert TOO_MUCH in errors_of_noise([solution], rc.Noise(RMS)).notes
    assert errors_of_noise([solution], rc.Noise(RMS, 8e-6)).notes == ()


def test_a_hardness_leaves_the_energy_to_the_draws():
    solution = pressed(noisy(rough(), rc.Noise(3e-9)), pressure=4e6)
    soft = rc.press(solution.problem.surface, 1e9, pressure=4e6, hardness=3e7)
    assert soft.problem.plastic
    elastic, plastic = (errors_of_noise([each], rc.Noise(3e-9)).parts[0] for each in (solution, soft))
    gap = 3e-9 * np.linalg.norm(rc.sensitivity(soft).mean_gap_at_force)
    assert plastic[GAP] == pytest.approx(gap, rel=1e-9)
    energy = NUMBERS.index("elastic_energy")
    assert 0.1 * elastic[energy] < plastic[energy] < 10 * elastic[energy]


@functools.cache
def without_noise(seed):
    return pressed(rough(seed=seed))


@pytest.mark.parametrize(("part", "biased"), [(0.01, False), (0.1, True)])
def test_the_truth_lies_within_the_errors(part, biased):
    """benchmarks/noise_coverage.py has 100 surfaces; of 16, binomial shares are within three standard errors."""
    noise, found, many = rc.Noise(part * RMS), [], 16
    for seed in range(many):
        exact = without_noise(seed)
        solutions = [exact, pressed(noisy(exact.problem.surface, noise, seed))]
        errors = errors_of_noise(solutions[1:], noise)
        found.append([*number_table(solutions).T, errors.correction, *errors.parts])
    truth, value, correction, spread, left = np.moveaxis(found, 0, -1)
    within = np.abs(value + correction - truth) / np.hypot(spread, left)
    for row in (GAP, STIFFNESS, AREA):
        assert np.mean(within[row] < 1) > 0.683 - 3 * math.sqrt(0.683 * 0.317 / many)
        assert np.mean(within[row] < 2) > 0.954 - 3 * math.sqrt(0.954 * 0.046 / many)
    raw = np.mean(np.abs(value - truth)[GAP] / spread[GAP] < 1)
    assert (raw < 0.3) == biased  # what the correction is for
    assert not biased or np.mean(correction[GAP] != 0) == 1


@pytest.mark.parametrize("value", [-1e-9, math.nan, math.inf])
def test_noise_is_a_size(value):
    with pytest.raises(rc.InputError, match="rms"):
        rc.Noise(value)
    with pytest.raises(rc.InputError, match="correlation_length"):
        rc.Noise(1e-9, value)


def test_refusals():
    solution = pressed(rough())
    for call, words in (
        (lambda: rc.error_budget(solution, noise=3e-9), "noise is a Noise"),
        (lambda: rc.error_budget(solution, noise=rc.Noise(3e-9, 9e-6)), "at most a quarter of the map"),
        (lambda: rc.error_budget(pressed(rough(), depth=1e-7), noise=rc.Noise(3e-9)), "highest cell"),
        (lambda: rc.Noise.from_repeats([rough()]), "two or more surfaces"),
        (lambda: rc.Noise.from_repeats([rough(), rough(16)]), "one grid"),
    ):
        with pytest.raises(rc.InputError, match=words):
            call()
    require_fits(rc.Noise(3e-9, 8e-6), rough().grid)
