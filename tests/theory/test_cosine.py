"""One and two cosine waves on springs, and the hierarchy of waves."""

import numpy as np
import pytest
from scipy.integrate import quad

from roughcontact.theory.springs import cosine, two_cosines


class TestOneWave:
    def test_reference(self):
        f = cosine.force(np.array([0.2, 0.5, 1.0, 1.5]), 1.0, 1.0, 1.0)
        np.testing.assert_allclose(f, [0.0271197, 0.1089978, 1 / np.pi, 0.6089978], atol=5e-8)

    @pytest.mark.parametrize("depth", [1e-6, 0.3, 1.7, 2.0, 2.6])
    def test_springs_one_by_one(self, depth):
        """E* times int (d - h0 (1 - cos q x))+ dx over whole waves, and its slope."""
        edge = 2 * np.arcsin(np.sqrt(min(depth / 2, 1)))
        # 1 - cos as a square keeps its digits near the crest.
        springs = quad(lambda x: depth - 2 * np.sin(x / 2) ** 2, 0, edge, epsabs=0, epsrel=1e-12)[0] / np.pi
        assert cosine.force(0.3 * depth, 0.3, 2.0, 5.0) == pytest.approx(3 * springs, rel=1e-11)
        assert cosine.stiffness(0.3 * depth, 0.3, 2.0, 5.0) == pytest.approx(10 * edge / np.pi, rel=1e-14)

    def test_flat(self):
        # Eq. 4.35, and full contact beyond.
        assert cosine.force(2.0, 1.0, 3.0, 5.0) == pytest.approx(15, rel=1e-14)
        assert cosine.stiffness(np.array([2.0, 9.0]), 1.0, 3.0, 5.0) == pytest.approx(15, rel=1e-14)

    def test_small_depth(self):
        d = np.array([1e-9, 0.2, 1.0])
        ratio = cosine.small_force(d, 1.0, 1.0, 1.0) / cosine.force(d, 1.0, 1.0, 1.0)
        np.testing.assert_allclose(ratio, [1, 0.99, 0.943], atol=1e-3)
        assert ratio[0] == pytest.approx(1, rel=1e-9)

    def test_depth_of_a_force(self):
        d = np.concatenate([np.geomspace(1e-12, 2, 30), [2.0, 5.0]])
        f = cosine.force(d, 1.0, 3.0, 5.0)
        # Where the wave is nearly flat the force rises evenly: no digits are lost in the inverse.
        np.testing.assert_allclose(cosine.depth(f, 1.0, 3.0, 5.0), d, rtol=1e-13)
        assert cosine.depth(0.0, 1.0, 1.0, 1.0) == 0

    def test_law(self):
        law = cosine.law(0.1, 2.0, 3.0)
        f = np.array([0.0, 0.3, 0.6, 3.0])
        d = law.predict("depth", f)
        np.testing.assert_allclose(
            law.predict("stiffness", f), cosine.stiffness(d, 0.1, 2.0, 3.0), rtol=1e-15
        )

    def test_refusals(self):
        with pytest.raises(ValueError, match="depth must not exceed twice the amplitude"):
            cosine.small_force(2.1, 1.0, 1.0, 1.0)
        with pytest.raises(ValueError, match="length"):
            cosine.law(1.0, -1.0, 1.0)
        with pytest.raises(ValueError, match="amplitude"):
            cosine.force(1.0, 0.0, 1.0, 1.0)


class TestTwoWaves:
    LONG = (0.2, 7.0)

    @pytest.mark.parametrize("s", [1e-4, 0.3, 0.99, 1.0])
    def test_integral_over_the_crest(self, s):
        """Eq. 4.38 with the right one-wave law: int f(d - h1 (q1 x)^2/2) dx."""
        h2 = 1e-3
        d = 2 * h2 * s
        edge = np.sqrt(2 * d / 0.2) / 7

        def over_the_crest(one_wave):
            local = lambda x: max(d - 0.2 * (7 * x) ** 2 / 2, 0.0)  # noqa: E731
            return 2 * quad(lambda x: one_wave(local(x), h2, 1.0, 3.0), 0, edge, epsabs=0, epsrel=1e-10)[0]

        force, stiff = over_the_crest(cosine.force), over_the_crest(cosine.stiffness)
        assert two_cosines.force(d, self.LONG, h2, 3.0) == pytest.approx(force, rel=1e-8)
        assert two_cosines.stiffness(d, self.LONG, h2, 3.0) == pytest.approx(stiff, rel=1e-8)

    def test_flat_coefficients(self):
        assert pytest.approx(2.263537, abs=5e-7) == two_cosines.FLAT_FORCE
        assert pytest.approx(2.546479, abs=5e-7) == two_cosines.FLAT_STIFFNESS
        force, stiffness = two_cosines.flat((4.0, 7.0), 1e-2, 3.0)
        assert force == pytest.approx(64 / (9 * np.pi) * 3 * 1e-3 / (7 * 2), rel=1e-13)
        assert stiffness == pytest.approx(8 / np.pi * 3 / 7 * 0.05, rel=1e-13)

    def test_refusals(self):
        with pytest.raises(ValueError, match=r"depth must not exceed 2 h2"):
            two_cosines.force(2.1e-3, self.LONG, 1e-3, 1.0)
        with pytest.raises(ValueError, match=r"depth must not exceed h1/2"):
            two_cosines.force(0.11, self.LONG, 1.0, 1.0)


class TestHierarchy:
    @pytest.mark.parametrize("hurst", [0.2, 0.9, 1.9])
    def test_slope(self, hurst):
        """Eq. 4.47."""
        waves = two_cosines.Hierarchy(1e-3, 2.0, 7.0, hurst)
        force, stiffness = waves.corners(6, 3.0)
        slopes = np.diff(np.log(stiffness)) / np.diff(np.log(force))
        np.testing.assert_allclose(slopes, 1 / (hurst + 1), rtol=1e-12)

    def test_corners_are_those_of_two_waves(self):
        waves = two_cosines.Hierarchy(1e-3, 2.0, 7.0, 0.9)
        h, q = waves.amplitudes(4), waves.wavenumbers(4)
        force, stiffness = waves.corners(3, 3.0)
        for n in range(3):
            flat = two_cosines.flat((h[n], q[n]), h[n + 1], 3.0)
            assert (force[n], stiffness[n]) == pytest.approx(flat, rel=1e-13)

    def test_refusals(self):
        with pytest.raises(ValueError, match="ratio must exceed 1"):
            two_cosines.Hierarchy(1.0, 1.0, 1.0, 0.5)
        with pytest.raises(ValueError, match="hurst must exceed 0"):
            two_cosines.Hierarchy(1.0, 1.0, 2.0, 0.0)
        with pytest.raises(ValueError, match="hurst must be below 2"):
            two_cosines.Hierarchy(1.0, 1.0, 2.0, 2.0)
