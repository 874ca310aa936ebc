import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.generation.midpoint import midpoint_line, midpoint_surface


def line(n=9, hurst=0.7, seed=0, **more):
    more = more or {"displacement": 1.0}
    return midpoint_line(rc.Grid(2**n + 1, 0.1), hurst, np.random.default_rng(seed), **more)


def plane(n=5, hurst=0.7, seed=0, **more):
    if "rms" not in more:
        more = {"displacement": 1.0, **more}
    return midpoint_surface(rc.Grid((2**n + 1,) * 2, 0.1), hurst, np.random.default_rng(seed), **more)


def hats(n):
    """Every displacement's share in the line: hat functions, (2^n - 1, 2^n + 1), and their levels."""
    x, rows, levels = np.arange(2**n + 1), [], []
    for level in range(n):
        half = 2 ** (n - level - 1)
        for k in range(2**level):
            rows.append(np.maximum(0, 1 - np.abs(x - (2 * k + 1) * half) / half))
            levels.append(level)
    return np.array(rows), np.array(levels)


def second_differences(z, lag):
    return z[..., 2 * lag :] - 2 * z[..., lag:-lag] + z[..., : -2 * lag]


def test_a_line_is_the_sum_of_its_hats():
    """Independent of the recursion: the displacements, drawn level by level, times their hat functions."""
    rng, shares, levels = np.random.default_rng(0), *hats(9)
    drawn = np.concatenate([rng.uniform(-1, 1, 2**level) for level in range(9)])
    expected = (drawn * 2 ** (-0.7 * levels)) @ shares
    np.testing.assert_allclose(line().heights, expected, rtol=0, atol=1e-14)
    assert line().heights[0] == line().heights[-1] == 0


def test_a_finer_grid_refines_the_same_line_and_surface():
    np.testing.assert_array_equal(line(7, seed=3).heights, line(9, seed=3).heights[::4])
    np.testing.assert_array_equal(plane(4, seed=3).heights, plane(6, seed=3).heights[::4, ::4])


@pytest.mark.parametrize("distribution", ["uniform", "gaussian"])
@pytest.mark.parametrize(("hurst", "exponent"), [(0.2, 0.258), (0.5, 0.5), (0.8, 0.786)])
def test_exponent_by_second_differences(hurst, exponent, distribution):
    """Their mean square over all positions follows from the hats: over 200 lines, within 4 standard errors.

    The exponent between lags of 8 and 16 cells is near H, not H itself, but at H = 1/2.
    """
    shares, levels = hats(9)
    lags = (1, 2, 4, 8, 16)
    variance = 4 ** (-hurst * levels) / 3  # of uniform displacements in +-2^(-H level)
    exact = np.array([(variance @ second_differences(shares, lag) ** 2).mean() for lag in lags])
    lines = np.array(
        [line(9, hurst, seed, displacement=1.0, distribution=distribution).heights for seed in range(200)]
    )
    measured = np.array([(second_differences(lines, lag) ** 2).mean(axis=1) for lag in lags])
    error = measured.std(axis=1, ddof=1) / np.sqrt(200)
    assert (np.abs(measured.mean(axis=1) - exact) < 4 * error).all()
    assert (error < 0.05 * exact).all()  # else the line above says nothing
    assert np.log2(exact[-1] / exact[-2]) / 2 == pytest.approx(exponent, abs=5e-4)


def by_hand(n, hurst, seed, half_steps, wrap):
    """Diamonds and squares one node at a time, from the same numbers in the same order."""
    rng, size = np.random.default_rng(seed), 2**n
    z, d = np.zeros((size + 1, size + 1)), 1.0

    def neighbour(i, j):
        if wrap:
            return z[i % size, j % size]
        return z[i, j] if 0 <= i <= size and 0 <= j <= size else np.nan

    for level in range(n):
        m, step = 2**level, size >> level
        half = step // 2
        moved = rng.uniform(-d, d, (m, m))
        for a in range(m):
            for b in range(m):
                i, j = a * step, b * step
                corners = z[i, j] + z[i, j + step] + z[i + step, j] + z[i + step, j + step]
                z[i + half, j + half] = corners / 4 + moved[a, b]
        e = d * 2 ** (-hurst / 2) if half_steps == "saupe" else d
        for transposed in (False, True):
            moved = rng.uniform(-e, e, (m + 1, m))
            for a in range(m + 1):
                for b in range(m):
                    i, j = (a * step, b * step + half)
                    i, j = (j, i) if transposed else (i, j)
                    four = [
                        neighbour(i + di, j + dj) for di, dj in ((half, 0), (-half, 0), (0, half), (0, -half))
                    ]
                    z[i, j] = (
                        np.nanmean(four) + moved[0 if wrap else a, b]
                        if a == m
                        else np.nanmean(four) + moved[a, b]
                    )
        d *= 2**-hurst
    return z


@pytest.mark.parametrize("half_steps", ["same", "saupe"])
@pytest.mark.parametrize("borders", ["three", "wrap"])
def test_a_surface_against_one_made_node_by_node(half_steps, borders):
    made = plane(4, 0.6, 7, half_steps=half_steps, borders=borders)
    expected = by_hand(4, 0.6, 7, half_steps, borders == "wrap")
    np.testing.assert_allclose(made.heights, expected, rtol=0, atol=1e-14)


def test_half_steps_and_borders():
    """Saupe's edges move by 2^(-H/2) less; wrapped surfaces repeat themselves, others do not."""
    same, saupe = (plane(1, 0.6, half_steps=rule).heights for rule in ("same", "saupe"))
    assert same[1, 1] == saupe[1, 1]
    assert (saupe[0, 1] - saupe[1, 1] / 3) / (same[0, 1] - same[1, 1] / 3) == pytest.approx(
        2**-0.3, rel=1e-12
    )
    wrapped, three = plane(borders="wrap").heights, plane().heights
    np.testing.assert_array_equal(wrapped[0], wrapped[-1])
    np.testing.assert_array_equal(wrapped[:, 0], wrapped[:, -1])
    assert (three[0, 1:-1] != three[-1, 1:-1]).all()


@pytest.mark.parametrize(("half_steps", "ratio"), [("same", 1), ("saupe", 2**-0.6)])
def test_displacements_of_a_surface_follow_the_law(half_steps, ratio):
    """Centres less their corners: variance 4^(-H level)/3; edges less their neighbours: times `ratio`.

    64^2 and 32^2 centres of uniform numbers: the mean square has a relative standard error of 0.9/n, asked for 4.
    """
    z, hurst = plane(7, 0.6, 1, half_steps=half_steps).heights, 0.6
    for level in (5, 6):
        half = 2 ** (6 - level)
        corners, centres = z[:: 2 * half, :: 2 * half], z[half :: 2 * half, half :: 2 * half]
        moved = centres - (corners[1:, 1:] + corners[1:, :-1] + corners[:-1, 1:] + corners[:-1, :-1]) / 4
        law, count = 4 ** (-hurst * level) / 3, 2**level
        assert (moved**2).mean() == pytest.approx(law, rel=4 * 0.9 / count)
        edges = z[2 * half : -2 * half : 2 * half, half :: 2 * half]
        inner = corners[1:-1]
        moved = edges - (inner[:, 1:] + inner[:, :-1] + centres[1:] + centres[:-1]) / 4
        assert (moved**2).mean() == pytest.approx(law * ratio, rel=4 * 0.9 / count)


@pytest.mark.parametrize("made", [line(7, rms=0.3), plane(rms=0.3), plane(rms=0.3, distribution="gaussian")])
def test_rms_height(made):
    assert made.rms == pytest.approx(0.3, rel=1e-12)
    assert "rms = 0.3 m" in made.provenance[0]
    assert not any(made.grid.periodic)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: midpoint_line(rc.Grid(64, 1.0), 0.5, np.random.default_rng(0), rms=1.0), "for example 65"),
        (lambda: midpoint_line(rc.Grid((65, 65), 1.0), 0.5, np.random.default_rng(0), rms=1.0), "a line of"),
        (
            lambda: midpoint_line(rc.Grid(65, 1.0, True), 0.5, np.random.default_rng(0), rms=1.0),
            "periodic=False",
        ),
        (lambda: midpoint_line(rc.Grid(65, 1.0), 0.5, "3", rms=1.0), "rng must be"),
        (
            lambda: midpoint_surface(rc.Grid((9, 17), 1.0), 0.5, np.random.default_rng(0), rms=1.0),
            "a square of",
        ),
        (
            lambda: midpoint_surface(rc.Grid((9, 9), (1.0, 2.0)), 0.5, np.random.default_rng(0), rms=1.0),
            "same spac",
        ),
        (lambda: line(hurst=1.5), "self_affine takes"),
        (lambda: line(hurst=np.nan), "hurst must be a number"),
        (lambda: line(rms=1.0, displacement=1.0), "give either"),
        (lambda: line(distribution="uniform"), "give either"),
        (lambda: line(rms=0.0), "rms must be positive"),
        (lambda: line(displacement=np.inf), "displacement must be positive"),
        (lambda: line(rms=1.0, distribution="cauchy"), "distribution must be"),
        (lambda: plane(half_steps="other"), "half_steps must be"),
        (lambda: plane(borders="two"), "borders must be"),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
