"""Heights on springs: any density, beat waves and white heights."""

import itertools

import numpy as np
import pytest
from scipy.special import ellipkm1, gamma

from roughcontact.theory.springs import cosine, gaussian_heights, height_distribution as heights
from roughcontact.theory.springs.beat_wave import beat_wave


def arcsine(z):
    return 1 / (np.pi * np.sqrt(z * (2 - z))) if z < 2 else 0.0


class TestExponents:
    def test_both_ways(self):
        beta = np.array([-0.9, -0.5, 0.0, 0.5, 30.0])
        alpha = heights.stiffness_exponent(beta)
        np.testing.assert_allclose(alpha, [1 / 11, 1 / 3, 1 / 2, 3 / 5, 31 / 32], rtol=1e-14)
        np.testing.assert_allclose(heights.density_exponent(alpha), beta, rtol=1e-13, atol=1e-15)

    @pytest.mark.parametrize("beta", [-0.5, 0.0, 0.7])
    def test_power_law_density(self, beta):
        """Eqs 4.59 to 4.62: F = c u^(beta + 2)/((beta + 1)(beta + 2)), and its local exponent everywhere."""
        d = heights.from_density(lambda z: 3 * z**beta)
        u = np.array([1e-6, 0.01, 0.1])
        np.testing.assert_allclose(
            d.force(u, 2.0, 5.0), 30 * u ** (beta + 2) / ((beta + 1) * (beta + 2)), rtol=1e-8
        )
        np.testing.assert_allclose(d.stiffness(u, 2.0, 5.0), 30 * u ** (beta + 1) / (beta + 1), rtol=1e-8)
        law = d.law(2.0, 5.0)
        f = np.array([1e-6, 1e-2])
        k = law.predict("stiffness", f)
        alpha = np.log(k[1] / k[0]) / np.log(f[1] / f[0])
        assert alpha == pytest.approx(heights.stiffness_exponent(beta), rel=1e-8)

    def test_legacy_heuristics(self):
        np.testing.assert_allclose(
            heights.legacy_density_exponent([1, 2, 4, 8]), [-0.5, 0, 0.5, 1], rtol=1e-15
        )
        # Eq. 4.73.
        n = np.array([2.0**8, 2.0**15])
        alpha = (1 + np.log2(n)) / (3 + np.log2(n))
        np.testing.assert_allclose(heights.legacy_stiffness_exponent(n), alpha, rtol=1e-15)

    def test_refusals(self):
        with pytest.raises(ValueError, match="density_exponent must exceed -1"):
            heights.stiffness_exponent(-1.0)
        with pytest.raises(ValueError, match="at 1 there is no highest peak"):
            heights.density_exponent(1.0)
        with pytest.raises(ValueError, match="modes must be at least 1"):
            heights.legacy_density_exponent(0.5)


class TestDensity:
    U = np.array([0.0, 1e-5, 0.3, 1.0, 1.9, 2.0, 3.5])

    def test_arcsine_is_the_cosine(self):
        """Eq. 4.68 without its approximation is eq. 4.33."""
        d = heights.from_density(arcsine, breaks=[2.0])
        np.testing.assert_allclose(
            d.force(self.U, 3.0, 5.0), cosine.force(self.U, 1.0, 3.0, 5.0), rtol=1e-8, atol=0
        )
        np.testing.assert_allclose(
            d.stiffness(self.U, 3.0, 5.0), cosine.stiffness(self.U, 1.0, 3.0, 5.0), rtol=1e-8
        )

    def test_samples_are_exact_for_a_linear_density(self):
        """Phi = 2 - 2z on (0, 1): k = 2u - u^2, F = u^2 - u^3/3, and a full line beyond."""
        d = heights.from_samples([0.0, 0.2, 0.7, 1.0], 2 - 2 * np.array([0.0, 0.2, 0.7, 1.0]))
        u = np.array([0.0, 0.1, 0.5, 1.0])
        np.testing.assert_allclose(d.stiffness(u, 1.0, 1.0), 2 * u - u**2, rtol=1e-14)
        np.testing.assert_allclose(d.force(u, 1.0, 1.0), u**2 - u**3 / 3, rtol=1e-14)
        assert d.stiffness(4.0, 1.0, 1.0) == pytest.approx(1, rel=1e-14)
        assert d.force(4.0, 1.0, 1.0) == pytest.approx(2 / 3 + 3, rel=1e-14)

    def test_samples_that_start_below_the_peak(self):
        d = heights.from_samples([1.0, 3.0], [0.5, 0.5])
        np.testing.assert_allclose(
            d.force(np.array([0.5, 1.0, 2.0, 5.0]), 1.0, 1.0), [0, 0, 0.25, 3], atol=1e-15
        )

    def test_depth_of_a_force(self):
        for d in (heights.from_samples([0.0, 1e-6], [1e6, 1e6]), beat_wave(4, 1e-6)):
            u = np.array([1e-9, 3e-7, 2e-6, 1e-5])
            f = d.force(u, 1e-3, 1e11)
            np.testing.assert_allclose(d.depth(f, 1e-3, 1e11), u, rtol=1e-7)
        assert d.depth(0.0, 1.0, 1.0) == 0
        assert np.ndim(d.depth(1e-3, 1e-3, 1e11)) == 0

    def test_refusals(self):
        with pytest.raises(ValueError, match="depth must increase"):
            heights.from_samples([0.0, 1.0, 1.0], [1.0, 1.0, 1.0])
        with pytest.raises(ValueError, match="lists of one length"):
            heights.from_samples([0.0, 1.0], [1.0])
        with pytest.raises(ValueError, match=r"density .* must be finite and not negative"):
            heights.from_samples([0.0, 1.0], [1.0, -1.0])
        spike = heights.from_density(lambda z: abs(z - 0.30001) ** -0.9)
        with pytest.raises(ValueError, match="name the depths where it jumps or is singular"):
            spike.stiffness(1.0, 1.0, 1.0)
        with pytest.raises(ValueError, match="no heights near the peak"):
            heights.from_density(lambda z: 0.0).depth(1.0, 1.0, 1.0)


class TestBeatWave:
    def test_one_wave(self):
        u = np.array([0.1, 1.0, 5.0])
        np.testing.assert_allclose(
            beat_wave(1, 2.0).force(u, 3.0, 5.0), cosine.force(u, 2.0, 3.0, 5.0), rtol=1e-14
        )

    @pytest.mark.parametrize("modes", [2, 3, 4, 8])
    def test_density_exponent(self, modes):
        """Phi = u^(N/2 - 1)/(Gamma(N/2) (2 pi)^(N/2)) near the peak: beta = N/2 - 1 in eq. 4.64."""
        d = beat_wave(modes, 1.0)
        u = np.array([1e-6, 1e-5])
        exact = u ** (modes / 2) / gamma(modes / 2 + 1) / (2 * np.pi) ** (modes / 2)
        # The next term of each wave is z/4 of its first one.
        np.testing.assert_allclose(d.fraction(u), exact, rtol=modes * 1e-5 / 4)
        f, k = d.force(u, 1.0, 1.0), d.stiffness(u, 1.0, 1.0)
        alpha = np.log(k[1] / k[0]) / np.log(f[1] / f[0])
        assert heights.density_exponent(alpha) == pytest.approx(modes / 2 - 1, abs=1e-4)

    @pytest.mark.parametrize("modes", [2, 3, 4, 8])
    def test_both_ways_of_computing_meet(self, modes):
        """The series and the Fourier sum at their border, and the symmetry about the middle."""
        d, u = beat_wave(modes, 1.0), np.array([1 - 1e-9, 1 + 1e-9])
        f, k = d.excess(u), d.fraction(u)
        assert f[1] - f[0] == pytest.approx(k[0] * 2e-9, abs=2e-9)
        assert k[1] == pytest.approx(k[0], abs=2e-8)
        np.testing.assert_allclose(d.fraction(np.array([modes - 0.4, modes + 0.4])).sum(), 1, rtol=1e-14)
        np.testing.assert_allclose(
            d.excess(np.array([2.0 * modes, 2 * modes + 3])), [modes, modes + 3], rtol=1e-13
        )

    @pytest.mark.parametrize("modes", [2, 3])
    def test_phases_one_by_one(self, modes):
        """Midpoints of 240 phases each; the first wave exact. (.)+^(3/2) costs about (pi/240)^2 of the result."""
        phases = (np.arange(240) + 0.5) * np.pi / 240
        others = sum(np.meshgrid(*[1 - np.cos(phases)] * (modes - 1)))
        d = beat_wave(modes, 1.0)
        for u in (0.5, 1.3, 2.4, 2 * modes - 0.7):
            brute = cosine.force(np.maximum(u - others, 0), 1.0, 1.0, 1.0).mean()
            assert d.excess(u) == pytest.approx(brute, rel=2e-4)

    @pytest.mark.parametrize("depth", [0.4, 1.3, 1.99, 2.5])
    def test_two_waves_by_their_density(self, depth):
        """Phi = K(m)/pi^2 with m = 1 - (z - 2)^2/4: the convolution of two inverse roots."""
        d = heights.from_density(lambda z: ellipkm1((z - 2) ** 2 / 4) / np.pi**2, breaks=[2.0])
        assert beat_wave(2, 1.0).fraction(depth) == pytest.approx(d.fraction(depth), rel=2e-6)
        assert beat_wave(2, 1.0).excess(depth) == pytest.approx(d.excess(depth), rel=1e-8)

    def test_more_waves_are_more_gaussian(self):
        """32 waves: their sum has the variance 16, and fourth cumulants of 3/(8 N) of it."""
        d = beat_wave(32, 1.0)
        u = 32 - 4 * np.array([0.0, 1.0, 2.0])
        normal = gaussian_heights.force(np.array([0.0, 1.0, 2.0]), 4.0, 1.0, 1.0)
        np.testing.assert_allclose(d.excess(u), normal, rtol=0.05)

    def test_refusals(self):
        for wrong in (0, 1.5):
            with pytest.raises(ValueError, match=r"modes must be a (positive )?whole number"):
                beat_wave(wrong, 1.0)


class TestGaussianHeights:
    def test_reference(self):
        # Computed rough lines of 2^11 to 2^15 points have 0.0262 to 0.0268.
        assert gaussian_heights.stiffness(1e-2, 1.0, 1.0, 1.0) == pytest.approx(0.02629, abs=5e-6)
        known = {0.31: 0.73, 0.16: 0.80, 0.067: 0.85, 0.023: 0.886, 0.006: 0.91}
        t = np.array([0.5, 1.0, 1.5, 2.0, 2.5])
        f = gaussian_heights.force(t, 1.0, 1.0, 1.0)
        np.testing.assert_allclose(gaussian_heights.stiffness(f, 1.0, 1.0, 1.0), list(known), rtol=0.04)
        np.testing.assert_allclose(
            gaussian_heights.exponent(f, 1.0, 1.0, 1.0), list(known.values()), atol=5e-3
        )

    def test_sorted_random_heights(self):
        """The foundation itself with 2^18 drawn heights; k counts springs, so its error is about 1/sqrt(count)."""
        z = np.sort(np.random.default_rng(5).normal(size=2**18))[::-1] * 3e-6
        count = np.array([20_000, 80_000, 200_000])
        total = np.cumsum(z)
        f = 1e11 * 1e-3 * (total[count - 1] - count * z[count]) / len(z)
        k = gaussian_heights.stiffness(f, 3e-6, 1e-3, 1e11)
        np.testing.assert_allclose(k, 1e8 * count / len(z), rtol=4 / np.sqrt(20_000))

    def test_limits(self):
        assert gaussian_heights.stiffness(np.array([0.0, 50.0]), 1.0, 1.0, 1.0) == pytest.approx(
            [0, 1], abs=1e-15
        )
        f = np.geomspace(1e-9, 3, 20)
        k = gaussian_heights.stiffness(f, 2.0, 3.0, 5.0)
        h = 1e-5
        slope = [np.log(gaussian_heights.stiffness(f * (1 + s * h), 2.0, 3.0, 5.0)) for s in (-1, 1)]
        local = (slope[1] - slope[0]) / (2 * h)
        np.testing.assert_allclose(gaussian_heights.exponent(f, 2.0, 3.0, 5.0), local, rtol=1e-7)
        np.testing.assert_array_equal(gaussian_heights.law(2.0, 3.0, 5.0).predict("stiffness", f), k)
        # Beyond all heights nothing touches.
        assert gaussian_heights.force(np.array([39.0, 1e200, np.inf]), 1.0, 1.0, 1.0) == pytest.approx(
            0, abs=1e-300
        )
        # Towards 1, and slowly.
        assert (np.diff(gaussian_heights.exponent(f, 2.0, 3.0, 5.0)) < 0).all()

    def test_refusals(self):
        with pytest.raises(ValueError, match="force"):
            gaussian_heights.exponent(0.0, 1.0, 1.0, 1.0)
        with pytest.raises(ValueError, match="modulus"):
            gaussian_heights.law(1.0, 1.0, 0.0)
        with pytest.raises(ValueError, match="length"):
            beat_wave(2, 1.0).law(0.0, 1.0)
        with pytest.raises(ValueError, match="rms"):
            gaussian_heights.stiffness(1.0, 0.0, 1.0, 1.0)
        with pytest.raises(ValueError, match="level must be finite"):
            gaussian_heights.force(-np.inf, 1.0, 1.0, 1.0)


def test_from_density_takes_a_scalar_function_for_all_depths():
    calls = itertools.count()

    def density(z):
        assert isinstance(z, float)
        next(calls)
        return 1.0

    assert heights.from_density(density).fraction(np.array([0.5, 1.0])) == pytest.approx(
        [0.5, 1.0], rel=1e-14
    )
    assert next(calls) > 1
