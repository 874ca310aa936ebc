import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.parameters.profile import profile_parameters


def line(heights, spacing=0.1):
    return rc.Surface(np.asarray(heights, dtype=float), rc.Grid(len(heights), spacing))


def test_a_sine_has_its_closed_values():
    n, amplitude = 640, 3.0
    found = profile_parameters(line(amplitude * np.sin(2 * np.pi * np.arange(n) / 64)))
    assert found.sections == 5
    assert found.section_length == pytest.approx(12.8)
    assert found.evaluation_length == pytest.approx(64.0)
    assert found.Rq == pytest.approx(amplitude / math.sqrt(2), rel=1e-12)
    assert found.Ra == pytest.approx(
        2 * amplitude / math.pi * (math.pi / 64) / math.tan(math.pi / 64), rel=1e-12
    )
    assert (found.Rsk, found.Rku) == pytest.approx((0, 1.5), abs=1e-12)
    assert (found.Rp, found.Rv, found.Rz, found.Rt) == pytest.approx((3, 3, 6, 6), rel=1e-12)


def test_the_gradient_of_a_sine():
    """The seven-point formula sees of a wave q the share (45 sin t - 9 sin 2t + sin 3t)/(30 t), t = q D."""
    n, spacing, period = 6406, 0.1, 32
    t = 2 * math.pi / period
    found = profile_parameters(line(np.sin(t * np.arange(n)), spacing), section_length=n * spacing)
    share = (45 * math.sin(t) - 9 * math.sin(2 * t) + math.sin(3 * t)) / (30 * t)
    # 6400 points have six neighbours: 200 whole waves. Their mean height is subtracted, which has no gradient.
    assert found.Rdq == pytest.approx(t / spacing / math.sqrt(2) * share, rel=1e-12)
    assert found.sections == 1


def test_sections_are_looked_at_one_by_one():
    heights = np.zeros(23)
    heights[[2, 7, 12]] = [4.0, 2.0, 3.0]
    heights[[3, 8, 22]] = [-1.0, -5.0, 99.0]  # the last one is beyond the fourth section
    found = profile_parameters(line(heights), section_length=0.5)
    mean = heights[:20].mean()  # above zero: the flat parts are dales
    assert found.sections == 4
    assert found.Rp == pytest.approx((4 + 2 + 3 + 0 - 3 * mean) / 4)
    # The last dale has its (first) lowest point in the third section, so the fourth has none.
    assert found.Rv == pytest.approx((1 + 5 + 0 + 3 * mean) / 4)
    assert found.Rz == pytest.approx(found.Rp + found.Rv)
    assert found.Rt == pytest.approx(9)


def test_a_flank_is_no_peak():
    """A hill across the border of two sections has one peak; ISO 4287 saw its flank in the other section, too."""
    heights = np.array([-2.0, -1, 3, 4, 6, 5, -1, -3, -9, -2])
    found = profile_parameters(line(heights), section_length=0.5)
    assert (found.sections, found.Rt) == (2, 15)
    assert found.Rp == pytest.approx((6 + 0) / 2)
    assert found.Rv == pytest.approx((2 + 9) / 2)


@pytest.mark.parametrize("seed", range(3))
def test_peaks_and_pits_hill_by_hill(seed):
    """Slowly, by walking from crossing to crossing."""
    rng = np.random.default_rng(seed)
    z = rng.standard_normal(600).cumsum()
    h = z - z.mean()
    peaks, pits = np.zeros(5), np.zeros(5)
    start = 0
    for stop in range(1, 601):
        if stop == 600 or (h[stop] > 0) != (h[start] > 0):
            place = max(range(start, stop), key=lambda i: abs(h[i]))
            kind = peaks if h[start] > 0 else pits
            kind[place // 120] = max(kind[place // 120], abs(h[place]))
            start = stop
    found = profile_parameters(line(z))
    assert (found.Rp, found.Rv) == pytest.approx((peaks.mean(), pits.mean()), rel=1e-12)
    assert found.Rz == pytest.approx((peaks + pits).mean(), rel=1e-12)


def test_rq_is_that_of_the_evaluation_length_and_not_a_mean_over_sections():
    """ISO 4287 takes the mean over sampling lengths: the same Ra, another Rq."""
    wave = np.sin(2 * np.pi * np.arange(640) / 64)
    heights = np.concatenate([math.sqrt(2) * wave, 3 * math.sqrt(2) * wave])
    found = profile_parameters(line(heights), section_length=64.0)
    apart = [profile_parameters(line(part), section_length=64.0) for part in np.split(heights, 2)]
    assert found.sections == 2
    assert found.Rq == pytest.approx(math.sqrt((1 + 9) / 2), rel=1e-12)
    assert np.mean([each.Rq for each in apart]) == pytest.approx(2, rel=1e-12)
    assert np.mean([each.Ra for each in apart]) == pytest.approx(found.Ra, rel=1e-12)


def test_no_filter_is_applied_and_the_recipe_gives_r_parameters():
    """A short wave upon a long one and a tilt: P-parameters see all of it, R-parameters the short wave."""
    n, spacing = 16000, 0.5e-6
    x = np.arange(n) * spacing
    short = 0.2e-6 * np.sin(2 * np.pi * x / 50e-6)
    whole = line(short + 5e-6 * np.sin(2 * np.pi * x / 8e-3) + 1e-3 * x, spacing)
    assert profile_parameters(whole).Rq > 10 * short.std()
    roughness = whole.levelled("plane").filtered(short_cutoff=2.5e-6, long_cutoff=0.8e-3)
    inside = roughness.cropped(slice(1600, 14400))
    found = profile_parameters(inside, section_length=0.8e-3)
    assert found.sections == 8
    # Of the long wave, and of the straight line that levelling sees in it, 1 - 2^-(0.8/8)^2 = 0.7 % stays: 0.035 um.
    assert found.Rq == pytest.approx(
        short.std() * 2 ** -((2.5 / 50) ** 2), rel=0.5 * (0.035 / 0.2) ** 2 + 5e-3
    )


def test_any_profile_against_sums():
    z = np.random.default_rng(0).standard_normal(503) ** 3
    found = profile_parameters(line(z))
    h = z[:500] - math.fsum(z[:500]) / 500
    rq = math.sqrt(math.fsum(h**2) / 500)
    assert found.Ra == pytest.approx(math.fsum(abs(h)) / 500, rel=1e-12)
    assert found.Rsk == pytest.approx(math.fsum(h**3) / 500 / rq**3, rel=1e-11)
    assert found.Rku == pytest.approx(math.fsum(h**4) / 500 / rq**4, rel=1e-12)
    weights = {1: 45, 2: -9, 3: 1}
    slopes = [sum(w * (h[i + k] - h[i - k]) for k, w in weights.items()) / 6.0 for i in range(3, 497)]
    assert found.Rdq == pytest.approx(math.sqrt(math.fsum(s * s for s in slopes) / 494), rel=1e-12)


def test_what_is_no_profile_is_refused():
    with pytest.raises(ValueError, match="need a line"):
        profile_parameters(rc.Surface(np.zeros((5, 5)), rc.Grid((5, 5), 1.0)))
    with pytest.raises(ValueError, match="1 points are missing"):
        profile_parameters(line([1.0, np.nan, *range(20)]))
    with pytest.raises(ValueError, match="do not fit"):
        profile_parameters(line(range(20)), section_length=9.0)
    with pytest.raises(ValueError, match="all heights are equal"):
        profile_parameters(line([2.0] * 30))
